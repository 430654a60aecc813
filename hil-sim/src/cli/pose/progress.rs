//! A count on standard error, once something takes longer than two seconds.

use std::time::{Duration, Instant};

use indicatif::ProgressBar;

/// Looking at the clock this seldom costs nothing.
const STEPS_PER_LOOK: u64 = 1024;

pub(super) struct Progress {
    what: &'static str,
    started: Instant,
    steps: u64,
    bar: Option<ProgressBar>,
}

impl Progress {
    pub(super) fn new(what: &'static str) -> Self {
        Self { what, started: Instant::now(), steps: 0, bar: None }
    }

    pub(super) fn step(&mut self) {
        self.steps += 1;
        if self.steps.is_multiple_of(STEPS_PER_LOOK) && self.started.elapsed() > Duration::from_secs(2) {
            let bar = self.bar.get_or_insert_with(ProgressBar::new_spinner);
            bar.set_message(format!("{} {}", self.steps, self.what));
            bar.tick();
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

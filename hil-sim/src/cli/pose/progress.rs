//! A count on standard error, once something takes longer than two seconds.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::ProgressBar;

/// Looking at the clock this seldom costs nothing.
const STEPS_PER_LOOK: u64 = 1024;

/// Before the first word, and between two lines where there is no terminal.
const PAUSE: Duration = Duration::from_secs(2);

pub(super) struct Progress {
    what: &'static str,
    started: Instant,
    steps: u64,
    bar: Option<ProgressBar>,
    terminal: bool,
    last_line: Instant,
}

impl Progress {
    pub(super) fn new(what: &'static str) -> Self {
        Self {
            what,
            started: Instant::now(),
            steps: 0,
            bar: None,
            terminal: std::io::stderr().is_terminal(),
            last_line: Instant::now(),
        }
    }

    pub(super) fn step(&mut self) {
        self.steps += 1;
        if self.steps.is_multiple_of(STEPS_PER_LOOK) && self.started.elapsed() > PAUSE {
            let said = format!("{} {}", self.steps, self.what);
            if self.terminal {
                let bar = self.bar.get_or_insert_with(ProgressBar::new_spinner);
                bar.set_message(said);
                bar.tick();
            } else if self.last_line.elapsed() > PAUSE {
                self.last_line = Instant::now();
                eprintln!("{said}");
            }
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

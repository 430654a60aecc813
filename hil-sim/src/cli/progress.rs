//! Progress on standard error: a bar on a terminal, a line now and then elsewhere.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Between two lines where there is no terminal.
const PAUSE: Duration = Duration::from_secs(2);

/// Progress of one piece of work.
pub(crate) struct Progress {
    what: String,
    bar: ProgressBar,
    terminal: bool,
    last: Instant,
    steps: u64,
    done: u64,
    scale: f64,
    unit: &'static str,
}

impl Progress {
    /// Of `what`, counted in steps of which `per_unit` make one `unit`.
    pub(crate) fn new(what: &str, steps: u64, per_unit: f64, unit: &'static str) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let bar = if terminal { ProgressBar::new(steps) } else { ProgressBar::hidden() };
        bar.set_style(
            ProgressStyle::with_template("{msg} [{bar:40}] {percent:>3} %")
                .unwrap_or_else(|_| ProgressStyle::default_bar()),
        );
        bar.set_message(what.to_owned());
        Self { what: what.to_owned(), bar, terminal, last: Instant::now(), steps, done: 0, scale: per_unit, unit }
    }

    /// `done` of `all` steps are done.
    pub(crate) fn at(&mut self, done: u32, all: u32) {
        // A look at the clock every step would cost more than the step.
        if !done.is_multiple_of(256) && done != all {
            return;
        }
        if self.terminal {
            self.bar.set_position(done.into());
        } else if self.last.elapsed() >= PAUSE {
            self.last = Instant::now();
            let (is, of) = (f64::from(done) / self.scale, f64::from(all) / self.scale);
            eprintln!("{}: {is:.1} of {of:.1} {}", self.what, self.unit);
        }
    }

    /// One more step, a long one, is done.
    pub(crate) fn step(&mut self) {
        self.done += 1;
        self.bar.set_position(self.done);
        if !self.terminal && self.last.elapsed() >= PAUSE {
            self.last = Instant::now();
            let (is, of) = (self.done as f64 / self.scale, self.steps as f64 / self.scale);
            eprintln!("{}: {is:.1} of {of:.1} {}", self.what, self.unit);
        }
    }

    /// Takes the bar away.
    pub(crate) fn finish(self) {
        self.bar.finish_and_clear();
    }
}

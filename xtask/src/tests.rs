//! The whole suite: host tests, ARM images, the tests that wait for emulator, cantools or Chromium, one closing line.

use std::collections::BTreeSet;
use std::fmt;
use std::io;

use crate::arm::{self, Toolchain};
use crate::process::{Outcome, announce, cargo, line, stream};
use crate::tally::Tally;
use crate::{browser, cantools, emulator, image};

/// `cargo xtask test`: false when anything failed, was missing or did not run.
pub(crate) fn command() -> Outcome<bool> {
    let toolchain = arm::ensure()?;
    emulator::ensure()?;
    cantools::ensure()?;
    browser::ensure()?;

    let mut problems = Vec::new();
    announce("host tests");
    let host = run(&[], &toolchain, &mut problems)?;
    if host.passed + host.failed == 0 {
        problems.push("no host test ran".into());
    }
    // A failure so far does not keep the rest from being tried: the closing line is about all of it.
    let on_emulator = match image::build(&[], &toolchain) {
        Ok(_) => emulator_tests(&host, &toolchain, &mut problems)?,
        Err(problem) => {
            problems.push(format!("the emulator tests did not run: {problem}"));
            Tally::default()
        }
    };

    let closing = Closing::new(&host, &on_emulator);
    if closing.failed > 0 {
        problems.push(format!("{} of the tests above failed", closing.failed));
    }
    for problem in &problems {
        eprintln!("error: {problem}");
    }
    println!("{closing}");
    Ok(problems.is_empty())
}

/// Runs what the host run left to emulator, cantools and Chromium, by name, and insists that all of it ran.
fn emulator_tests(host: &Tally, toolchain: &Toolchain, problems: &mut Vec<String>) -> Outcome<Tally> {
    announce(&format!("emulator, cantools and Chromium tests ({})", host.for_emulator.len()));
    if host.for_emulator.is_empty() {
        problems.push("there is no emulator test to run; the suite is not complete without any".into());
        return Ok(Tally::default());
    }
    let names: BTreeSet<&str> = host.for_emulator.iter().map(String::as_str).collect();
    let mut selection = vec!["--lib", "--bins", "--tests", "--", "--ignored", "--exact"];
    selection.extend(names);
    let ran = run(&selection, toolchain, problems)?;
    if ran.passed + ran.failed != host.for_emulator.len() as u64 {
        let (count, expected) = (ran.passed + ran.failed, host.for_emulator.len());
        problems.push(format!("{count} emulator tests ran instead of {expected}"));
    }
    Ok(ran)
}

/// One run of `cargo test` over the workspace, its output passed on as it comes.
fn run(selection: &[&str], toolchain: &Toolchain, problems: &mut Vec<String>) -> Outcome<Tally> {
    let mut tests = cargo();
    tests.args(["test", "--workspace", "--no-fail-fast"]).args(selection);
    // A test that builds an image uses the compiler chosen here, without looking for it again.
    tests.env(arm::CHOICE, toolchain.name());
    let mut tally = Tally::default();
    let succeeded = stream(&mut tests, &mut io::stdout().lock(), |text| tally.read(text))?;
    if !succeeded && tally.failed == 0 {
        // A test binary that does not build or dies prints no result.
        problems.push(format!("`{}` failed", line(&tests)));
    }
    Ok(tally)
}

/// The closing line. What the host run ignored counts as skipped unless it ran on the emulator.
#[derive(Debug, PartialEq, Eq)]
struct Closing {
    passed: u64,
    failed: u64,
    skipped: u64,
}

impl Closing {
    fn new(host: &Tally, emulator: &Tally) -> Self {
        Self {
            passed: host.passed + emulator.passed,
            failed: host.failed + emulator.failed,
            skipped: host.ignored.saturating_sub(emulator.passed + emulator.failed),
        }
    }
}

impl fmt::Display for Closing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} passed, {} failed, {} skipped", self.passed, self.failed, self.skipped)
    }
}

#[cfg(test)]
mod closing_line {
    use super::Closing;
    use crate::tally::Tally;

    fn ran(passed: u64, failed: u64, ignored: u64) -> Tally {
        Tally { passed, failed, ignored, ..Tally::default() }
    }

    #[test]
    fn ignored_tests_that_ran_on_the_emulator_are_not_skipped() {
        let closing = Closing::new(&ran(40, 1, 6), &ran(3, 2, 0));
        assert_eq!(closing.to_string(), "43 passed, 3 failed, 1 skipped");
    }

    #[test]
    fn emulator_tests_that_never_ran_are_skipped() {
        assert_eq!(Closing::new(&ran(40, 0, 6), &Tally::default()).to_string(), "40 passed, 0 failed, 6 skipped");
    }
}

//! Reads what the test harness prints: the counts, and which tests wait for what this task installs: the emulator, cantools, Chromium.

/// The reasons that mark a test as one for this task, such as `#[ignore = "needs the emulator: run cargo xtask test"]`.
const REASONS: [&str; 3] = ["needs the emulator", "needs cantools", "needs Chromium"];

/// The sums of all `test result:` lines of one run, and the tests it left to the second run.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    pub(crate) passed: u64,
    pub(crate) failed: u64,
    pub(crate) ignored: u64,
    /// Full names, in the order seen; a name may stand in two test binaries and then comes twice.
    pub(crate) for_emulator: Vec<String>,
}

impl Tally {
    /// Takes in one line of the harness's output.
    pub(crate) fn read(&mut self, line: &str) {
        let line = plain(line);
        if let Some([passed, failed, ignored]) = result(&line) {
            self.passed += passed;
            self.failed += failed;
            self.ignored += ignored;
        } else if let Some((name, reason)) = ignored_test(&line)
            && REASONS.iter().any(|known| reason.starts_with(known))
        {
            self.for_emulator.push(name.to_owned());
        }
    }
}

/// `test result: ok. 3 passed; 0 failed; 1 ignored; 0 measured; …`
fn result(line: &str) -> Option<[u64; 3]> {
    let counts = line.strip_prefix("test result: ")?;
    let counts = counts.strip_prefix("ok. ").or_else(|| counts.strip_prefix("FAILED. "))?;
    let mut parts = counts.split("; ");
    let mut count = |what: &str| parts.next()?.strip_suffix(what)?.trim_end().parse().ok();
    Some([count("passed")?, count("failed")?, count("ignored")?])
}

/// `test module::name ... ignored, reason`
fn ignored_test(line: &str) -> Option<(&str, &str)> {
    let (name, reason) = line.strip_prefix("test ")?.split_once(" ... ignored, ")?;
    Some((name.strip_suffix(" - should panic").unwrap_or(name), reason))
}

/// The line without colour codes (`ESC [ … letter`) and without the end of line.
fn plain(line: &str) -> String {
    let mut text = String::with_capacity(line.len());
    let mut characters = line.trim_end().chars();
    while let Some(character) = characters.next() {
        if character == '\u{1b}' {
            characters.by_ref().find(char::is_ascii_alphabetic);
        } else {
            text.push(character);
        }
    }
    text
}

#[cfg(test)]
mod counting {
    use super::Tally;

    fn tally(output: &str) -> Tally {
        let mut tally = Tally::default();
        output.lines().for_each(|line| tally.read(line));
        tally
    }

    #[test]
    fn results_of_all_binaries_are_added() {
        let sum = tally(
            "running 3 tests\n\
             test a ... ok\n\
             test result: ok. 3 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.00s\n\n\
             test result: FAILED. 10 passed; 2 failed; 0 ignored; 0 measured; 5 filtered out; finished in 1.23s\n",
        );
        assert_eq!((sum.passed, sum.failed, sum.ignored), (13, 2, 1));
    }

    #[test]
    fn only_tests_that_wait_for_this_task_are_remembered() {
        let names = tally(
            "test poses::host_equals_emulator ... ignored, needs the emulator: run cargo xtask test\n\
             test frames::decode ... ignored, needs cantools: run cargo xtask test\n\
             test pages::play ... ignored, needs Chromium: run cargo xtask test\n\
             test slow ... ignored, takes an hour\n\
             test plain ... ignored\n\
             test overflow - should panic ... ignored, needs the emulator: run cargo xtask test\n\
             test needs the emulator ... ok\n",
        );
        assert_eq!(names.for_emulator, ["poses::host_equals_emulator", "frames::decode", "pages::play", "overflow"]);
    }

    #[test]
    fn colours_and_line_ends_do_not_matter() {
        let sum = tally(
            "test x ... \u{1b}[33mignored, needs the emulator: y\u{1b}(B\u{1b}[m\r\n\
             test result: \u{1b}[32mok\u{1b}(B\u{1b}[m. 4 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out\r\n",
        );
        assert_eq!((sum.passed, sum.ignored), (4, 1));
        assert_eq!(sum.for_emulator, ["x"]);
    }

    #[test]
    fn text_that_only_looks_like_a_result_is_not_counted() {
        let sum = tally(
            "the line was `test result: ok. 3 passed; 0 failed; 0 ignored`\n\
             test result: ok. many passed; 0 failed; 0 ignored\n\
             test result: maybe. 3 passed; 0 failed; 0 ignored\n",
        );
        assert_eq!(sum, Tally::default());
    }
}

//! Mutation testing by cargo-mutants: each mutant of `kinematics-core` or of the supervisor has to fail a test (`docs/mutation.md`).

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::process::{Outcome, announce, capture, cargo, line, root, run};

/// The version tried.
const VERSION: &str = "27.1.0";
/// Of the mutants that build, so much has to be caught, per cent.
const WANTED_PERCENT: usize = 90;
/// Where the results go.
const FOLDER: &str = "target/mutants";
/// An endless loop is ended after so long, on a machine that does other work besides; whole sweeps take longer.
const TIMEOUT_S: [&str; 2] = ["150", "900"];

/// What may be mutated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Subject {
    Kinematics,
    Supervisor,
}

impl Subject {
    pub(crate) const ALL: [Self; 2] = [Self::Kinematics, Self::Supervisor];

    /// What is mutated, and which tests are built for it.
    const fn arguments(self) -> &'static [&'static str] {
        match self {
            Self::Kinematics => &["--package=kinematics-core", "-C=--lib", "-C=--test=kinematics"],
            Self::Supervisor => {
                &["--file=firmware/src/supervisor/**", "-C=--features=reference/supervisor", "-C=--test=supervisor"]
            }
        }
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Kinematics => "kinematics",
            Self::Supervisor => "supervisor",
        }
    }
}

/// Tests of seconds where nothing is optimised: only what the others do not catch is tried by them, optimised.
const SLOW: [&str; 13] = [
    "accuracy::",
    "errors::an_angle_gets",
    "isotropy::newton_finds",
    "joint_limits::joints_stay",
    "least_effort::a_path_never",
    "random_search",
    "rates_floor::",
    "rates_jacobians::jacobians_in",
    "rates_search::",
    "time_scaling::curved_moves",
    "time_scaling::in_f32",
    "time_scaling::less_speed",
    "time_scaling::no_bound",
];

/// Mutants by what became of them, each by its name.
#[derive(Debug, Default, PartialEq, Eq)]
struct Results {
    caught: Vec<String>,
    missed: Vec<String>,
    timed_out: Vec<String>,
    unviable: Vec<String>,
}

impl Results {
    fn read(folder: &Path) -> Self {
        // A list that was not written is empty.
        let list = |name: &str| {
            let text = fs::read_to_string(folder.join("mutants.out").join(name)).unwrap_or_default();
            text.lines().map(str::to_owned).collect()
        };
        Self {
            caught: list("caught.txt"),
            missed: list("missed.txt"),
            timed_out: list("timeout.txt"),
            unviable: list("unviable.txt"),
        }
    }

    /// What a second pass over the missed ones found, put in their place; cargo-mutants adds deleted fields whatever the names asked for.
    fn then(mut self, second: Self) -> Self {
        let asked = core::mem::take(&mut self.missed);
        let of_these = |names: Vec<String>| names.into_iter().filter(|name| asked.contains(name)).collect::<Vec<_>>();
        self.caught.extend(of_these(second.caught));
        self.timed_out.extend(of_these(second.timed_out));
        self.missed = of_these(second.missed);
        self
    }

    /// Whether enough were caught. An endless loop is noticed, too.
    fn enough(&self) -> bool {
        let noticed = self.caught.len() + self.timed_out.len();
        noticed * 100 >= (noticed + self.missed.len()) * WANTED_PERCENT
    }
}

/// `cargo xtask mutants SUBJECT [K/N]`: false when less than nine in ten are caught.
pub(crate) fn command(subject: Subject, shard: Option<&str>) -> Outcome<bool> {
    ensure()?;
    let folder = format!("{FOLDER}/{}", subject.name());
    announce(&format!("mutants of {}", subject.name()));
    let shard = shard.map(|shard| vec!["--sharding=round-robin".to_owned(), format!("--shard={shard}")]);
    let mut results = pass(subject, &folder, "mutants", TIMEOUT_S[0], &shard.unwrap_or_default(), &SLOW)?;
    if subject == Subject::Kinematics && !results.missed.is_empty() {
        announce(&format!("the {} missed ones by the sweeps", results.missed.len()));
        let names: Vec<String> = results.missed.iter().map(|name| format!("--re=^{}$", escaped(name))).collect();
        let second = pass(subject, &format!("{folder}-sweeps"), "mutants-sweeps", TIMEOUT_S[1], &names, &[])?;
        results = results.then(second);
    }
    for name in &results.missed {
        println!("missed   {name}");
    }
    for name in &results.timed_out {
        println!("time out {name}");
    }
    let Results { caught, missed, timed_out, unviable } = &results;
    let [caught, missed, timed_out, unviable] = [caught, missed, timed_out, unviable].map(Vec::len);
    println!("{caught} caught, {missed} missed, {timed_out} timed out, {unviable} do not build");
    Ok(results.enough())
}

/// One run of cargo-mutants, in a copy of the repository.
fn pass(
    subject: Subject,
    folder: &str,
    profile: &str,
    timeout: &str,
    which: &[String],
    skipped: &[&str],
) -> Outcome<Results> {
    let results = root().join(folder);
    fs::create_dir_all(&results).map_err(|error| format!("{folder} cannot be made: {error}"))?;
    let mut mutants = cargo();
    mutants.args(["mutants", "--no-shuffle", "-C=--package=reference", "--output", folder]);
    mutants.args([format!("--profile={profile}"), format!("--timeout={timeout}")]);
    mutants.args(subject.arguments()).args(which);
    mutants.args(["--", "--", "--test-threads=1", "-Zunstable-options", "--fail-fast"]);
    mutants.args(skipped.iter().flat_map(|name| ["--skip", name]));
    // The first failure is enough, which the stable harness does not know.
    mutants.env("RUSTC_BOOTSTRAP", "1").env("PROPTEST_CASES", "32").env_remove("CARGO_TARGET_DIR");
    status(&mut mutants)?;
    Ok(Results::read(&results))
}

/// Runs cargo-mutants, which tells missed mutants (2) and time outs (3) from what keeps it from working.
fn status(mutants: &mut Command) -> Outcome<()> {
    let status = mutants.status().map_err(|error| format!("`{}` does not start: {error}", line(mutants)))?;
    match status.code() {
        Some(0 | 2 | 3) => Ok(()),
        _ => Err(format!("cargo-mutants failed ({status})")),
    }
}

/// Finds cargo-mutants or installs it.
fn ensure() -> Outcome<()> {
    if capture(cargo().args(["mutants", "--version"])).is_err() {
        announce("installing cargo-mutants");
        run(cargo().args(["install", "--locked", "cargo-mutants", "--version", VERSION]))?;
    }
    Ok(())
}

/// The name as a regular expression that means itself.
fn escaped(name: &str) -> String {
    let mut text = String::with_capacity(2 * name.len());
    for character in name.chars() {
        if r"\.+*?()|[]{}^$#&-~".contains(character) {
            text.push('\\');
        }
        text.push(character);
    }
    text
}

#[cfg(test)]
mod counting {
    use super::{Results, escaped};

    fn names(names: &[&str]) -> Vec<String> {
        names.iter().map(|name| (*name).to_owned()).collect()
    }

    #[test]
    fn nine_in_ten_are_enough_and_an_endless_loop_counts_as_noticed() {
        let of = |caught: usize, missed: usize, timed_out: usize| Results {
            caught: vec![String::new(); caught],
            missed: vec![String::new(); missed],
            timed_out: vec![String::new(); timed_out],
            unviable: vec![String::new(); 50],
        };
        assert!(of(8, 1, 1).enough() && of(9, 1, 0).enough() && of(0, 0, 0).enough());
        assert!(!of(8, 1, 0).enough() && !of(89, 10, 0).enough());
    }

    #[test]
    fn what_the_sweeps_found_takes_the_place_of_what_was_missed() {
        let first = Results { caught: names(&["a"]), missed: names(&["b", "c", "d"]), ..Results::default() };
        let second =
            Results { caught: names(&["b"]), missed: names(&["c"]), timed_out: names(&["d"]), ..Results::default() };
        let both = first.then(second);
        let counts = [both.caught.len(), both.missed.len(), both.timed_out.len()];
        assert_eq!((counts, both.missed), ([2, 1, 1], names(&["c"])));
    }

    #[test]
    fn a_name_as_a_pattern_means_itself() {
        assert_eq!(escaped("a.rs:1:2: replace + with - in f<T>"), r"a\.rs:1:2: replace \+ with \- in f<T>");
    }
}

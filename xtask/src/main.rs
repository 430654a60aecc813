//! Project tasks that need more than one cargo command: the whole test suite with the emulator, the ARM images,
//! the lints. Only std, so that `cargo xtask` builds in a second on a fresh machine.
//!
//! - [`arm`] finds or installs a compiler for the ECU, [`emulator`] QEMU and [`browser`] Chromium, all through [`packages`];
//!   [`cantools`] installs the DBC parser;
//! - [`image`] builds the images and has [`elf`] look at what was linked;
//! - [`tests`] runs the suite and counts with [`tally`];
//! - [`mod@mutants`] has cargo-mutants look for changes that no test notices;
//! - [`lint`] is formatting, clippy and rustdoc; [`process`] runs the children of all of them.

mod arm;
mod browser;
mod cantools;
mod elf;
mod emulator;
mod image;
mod lint;
mod mutants;
mod packages;
mod process;
mod tally;
mod tests;

use std::process::ExitCode;

use crate::mutants::Subject;

const USAGE: &str = "\
Usage: cargo xtask COMMAND

Commands:
  test            host tests, then the ARM images, then the tests that run them in the emulator or look at a page;
                  installs the ARM target, qemu-system-arm, Chromium and Python's cantools where they are missing.
                  Closing line: N passed, N failed, N skipped
  image [NAME…]   build the ARM images (default: all) and print the path of each ELF on standard output
  lint            formatting, clippy and rustdoc, warnings are errors
  mutants SUBJECT [K/N]
                  change kinematics or the supervisor (SUBJECT: kinematics, supervisor) one place at a time and see
                  whether a test notices: of every N mutants the K-th, from 0. Takes hours; installs cargo-mutants
  help            this text

Environment:
  XTASK_ARM_TOOLCHAIN=rustup|debian   use this compiler for the ARM images instead of the first that works

Exit status: 0 done, 1 failed, 2 wrong usage";

/// What the command line asks for.
#[derive(Debug, PartialEq, Eq)]
enum Task {
    Test,
    Image(Vec<String>),
    Lint,
    Mutants(Subject, Option<String>),
    Help,
}

fn parse(arguments: &[String]) -> Result<Task, String> {
    let (command, rest) = arguments.split_first().ok_or("no command given")?;
    let task = match command.as_str() {
        "test" => Task::Test,
        "image" => {
            return match rest.iter().find(|name| name.starts_with('-') || name.is_empty()) {
                Some(option) => Err(format!("image takes names of images only, not `{option}`")),
                None => Ok(Task::Image(rest.to_vec())),
            };
        }
        "lint" => Task::Lint,
        "mutants" => return mutants(rest),
        "help" | "--help" | "-h" => Task::Help,
        other => return Err(format!("unknown command `{other}`")),
    };
    match rest.first() {
        Some(extra) => Err(format!("`{command}` takes no argument, but got `{extra}`")),
        None => Ok(task),
    }
}

/// What follows `mutants`: a subject, and which part of its mutants.
fn mutants(rest: &[String]) -> Result<Task, String> {
    let (name, rest) = rest.split_first().ok_or("mutants needs a subject: kinematics or supervisor")?;
    let subject = Subject::ALL.into_iter().find(|subject| subject.name() == name);
    let subject = subject.ok_or_else(|| format!("mutants knows kinematics and supervisor, not `{name}`"))?;
    let numbers = |part: &str| {
        let (k, n) = part.split_once('/')?;
        Some((k.parse::<u32>().ok()?, n.parse::<u32>().ok()?))
    };
    match rest {
        [] => Ok(Task::Mutants(subject, None)),
        [part] if numbers(part).is_some_and(|(k, n)| k < n) => Ok(Task::Mutants(subject, Some(part.clone()))),
        [part, ..] => Err(format!("mutants takes a part such as 0/32, not `{part}`")),
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args_os().skip(1).map(|a| a.to_string_lossy().into_owned()).collect();
    let outcome = match parse(&arguments) {
        Ok(Task::Test) => tests::command(),
        Ok(Task::Image(names)) => image::command(&names),
        Ok(Task::Lint) => lint::command(),
        Ok(Task::Mutants(subject, part)) => mutants::command(subject, part.as_deref()),
        Ok(Task::Help) => {
            println!("{USAGE}");
            Ok(true)
        }
        Err(message) => {
            eprintln!("error: {message}\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        // The command has said what was wrong.
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
mod command_line {
    use super::{Subject, Task, parse};

    fn parsed(line: &str) -> Result<Task, String> {
        parse(&line.split_whitespace().map(String::from).collect::<Vec<_>>())
    }

    #[test]
    fn commands_are_told_apart() {
        assert_eq!(parsed("test"), Ok(Task::Test));
        assert_eq!(parsed("lint"), Ok(Task::Lint));
        assert_eq!(parsed("--help"), Ok(Task::Help));
        assert_eq!(parsed("image"), Ok(Task::Image(vec![])));
        assert_eq!(parsed("mutants supervisor"), Ok(Task::Mutants(Subject::Supervisor, None)));
        assert_eq!(parsed("mutants kinematics 3/32"), Ok(Task::Mutants(Subject::Kinematics, Some("3/32".into()))));
        assert_eq!(parsed("image one two"), Ok(Task::Image(vec!["one".into(), "two".into()])));
    }

    #[test]
    fn what_is_not_understood_is_named() {
        for (line, named) in [
            ("", "no command"),
            ("tset", "`tset`"),
            ("test --fast", "`--fast`"),
            ("image --release", "`--release`"),
            ("mutants", "subject"),
            ("mutants firmware", "`firmware`"),
            ("mutants kinematics 3", "`3`"),
            ("mutants kinematics 32/32", "`32/32`"),
        ] {
            let message = parsed(line).expect_err(line);
            assert!(message.contains(named), "{line}: {message}");
        }
    }
}

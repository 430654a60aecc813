//! Child processes: never with a standard input, always from the top of the repository, streamed or captured.

use std::env;
use std::io::{self, Read, Write};
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// The result of a step; the error is a message for the user.
pub(crate) type Outcome<T> = Result<T, String>;

/// Says on standard error what is done next: standard output carries results alone.
pub(crate) fn announce(step: &str) {
    eprintln!("==> {step}");
}

/// The top of the repository. Cargo sets the variable when it runs the task, so a moved clone is found too.
pub(crate) fn root() -> PathBuf {
    let package = env::var_os("CARGO_MANIFEST_DIR").unwrap_or_else(|| env!("CARGO_MANIFEST_DIR").into());
    PathBuf::from(package).join("..")
}

/// A command of the repository: runs at its top, with an empty standard input.
pub(crate) fn command(program: impl AsRef<std::ffi::OsStr>) -> Command {
    let mut command = Command::new(program);
    command.current_dir(root()).stdin(Stdio::null());
    command
}

/// The cargo that runs this task.
pub(crate) fn cargo() -> Command {
    command(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// The compiler that cargo uses for the host.
pub(crate) fn rustc() -> Command {
    command(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// Runs to the end with all output on standard error.
pub(crate) fn run(command: &mut Command) -> Outcome<()> {
    let status = command.stdout(io::stderr()).status().map_err(|error| cannot_start(command, &error))?;
    if status.success() { Ok(()) } else { Err(format!("`{}` failed ({status})", line(command))) }
}

/// Runs to the end and returns standard output; standard error is part of the message when it fails.
pub(crate) fn capture(command: &mut Command) -> Outcome<String> {
    let output = command.output().map_err(|error| cannot_start(command, &error))?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        let said = String::from_utf8_lossy(&output.stderr);
        Err(format!("`{}` failed ({}): {}", line(command), output.status, said.trim()))
    }
}

/// Runs to the end, hands every line of standard output to `each` and the bytes, as they come, to `copy`.
/// True when the child succeeded.
pub(crate) fn stream(command: &mut Command, copy: &mut dyn Write, mut each: impl FnMut(&str)) -> Outcome<bool> {
    let mut child = command.stdout(Stdio::piped()).spawn().map_err(|error| cannot_start(command, &error))?;
    let mut pipe = child.stdout.take().ok_or("a child without standard output")?;
    let mut chunk = [0_u8; 8192];
    let mut rest = Vec::new();
    loop {
        let read = match pipe.read(&mut chunk) {
            Ok(0) => break,
            Ok(read) => read,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(format!("reading from `{}`: {error}", line(command))),
        };
        // A reader that went away (`| head`) must not stop the count.
        let _ = copy.write_all(&chunk[..read]).and_then(|()| copy.flush());
        rest.extend_from_slice(&chunk[..read]);
        while let Some(end) = rest.iter().position(|&byte| byte == b'\n') {
            each(&String::from_utf8_lossy(&rest[..end]));
            rest.drain(..=end);
        }
    }
    if !rest.is_empty() {
        each(&String::from_utf8_lossy(&rest));
    }
    let status = child.wait().map_err(|error| format!("waiting for `{}`: {error}", line(command)))?;
    Ok(status.success())
}

/// The command as one would type it.
pub(crate) fn line(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}

fn cannot_start(command: &Command, error: &io::Error) -> String {
    format!("`{}` does not start: {error}", line(command))
}

#[cfg(all(test, unix))]
mod streaming {
    use super::{capture, command, run, stream};

    fn shell(script: &str) -> std::process::Command {
        let mut sh = command("sh");
        sh.args(["-c", script]);
        sh
    }

    #[test]
    fn every_line_is_seen_and_every_byte_copied() {
        let (mut copy, mut lines) = (Vec::new(), Vec::new());
        let succeeded = stream(&mut shell("printf 'one\\ntwo\\nno end'"), &mut copy, |l| lines.push(l.to_owned()));
        assert_eq!(succeeded, Ok(true));
        assert_eq!(lines, ["one", "two", "no end"]);
        assert_eq!(copy, b"one\ntwo\nno end");
    }

    #[test]
    fn a_failing_child_is_reported() {
        assert_eq!(stream(&mut shell("echo x; exit 3"), &mut Vec::new(), |_| ()), Ok(false));
        assert!(run(&mut shell("exit 3")).is_err());
        let message = capture(&mut shell("echo why >&2; exit 3")).expect_err("a failure");
        assert!(message.contains("why"), "{message}");
    }

    #[test]
    fn a_program_that_does_not_exist_is_named() {
        let message = capture(&mut command("no-such-program-here")).expect_err("a failure");
        assert!(message.contains("no-such-program-here"), "{message}");
    }
}

//! Runs the real `hil pose`.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::Value;

pub(crate) struct Answer {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Answer {
    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.out).unwrap_or_else(|e| panic!("{e}: {}", self.out))
    }

    /// Kind and message of a refusal, which is exit code 2 and one JSON object on standard output.
    pub(crate) fn refusal(&self) -> (String, String) {
        assert_eq!(self.code, Some(2), "{}", self.out);
        let json = self.json();
        let text = |key: &str| json["error"][key].as_str().expect("a string").to_owned();
        (text("kind"), text("message"))
    }
}

pub(crate) fn hil_in(folder: Option<&Path>, args: &[&str], input: &[u8]) -> Answer {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hil"));
    command.arg("pose").args(args).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    if let Some(folder) = folder {
        command.current_dir(folder);
    }
    let mut child = command.spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_vec();
    // A command that refuses its header leaves the rest unread.
    let feeder = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = child.wait_with_output().unwrap();
    feeder.join().unwrap();
    Answer {
        code: output.status.code(),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

pub(crate) fn pose(args: &[&str]) -> Answer {
    hil_in(None, args, b"")
}

//! Why there is no pose: a kind for programs, a message for people.

use serde::Serialize;

/// What kind of error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A cylinder would be longer or shorter than its stroke allows.
    OutOfStroke,
    /// The tip lies where boom and arm do not reach.
    Unreachable,
    /// A linkage does not close, or not in the way the machine is assembled.
    NoAssembly,
    /// The input itself: not a number, a wrong option, file, column.
    InvalidInput,
}

impl Kind {
    /// The kind's name in JSON and CSV.
    pub const fn name(self) -> &'static str {
        match self {
            Self::OutOfStroke => "out_of_stroke",
            Self::Unreachable => "unreachable",
            Self::NoAssembly => "no_assembly",
            Self::InvalidInput => "invalid_input",
        }
    }
}

/// An error of the command.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Failure {
    /// For programs.
    pub kind: Kind,
    /// For people.
    pub message: String,
}

#[derive(Serialize)]
struct Envelope<'a> {
    error: &'a Failure,
}

impl Failure {
    /// An error of the input itself.
    pub const fn invalid_input(message: String) -> Self {
        Self { kind: Kind::InvalidInput, message }
    }

    /// `{"error":{"kind":…,"message":…}}`
    pub fn to_json(&self) -> String {
        serde_json::to_string(&Envelope { error: self }).expect("strings always serialise")
    }
}

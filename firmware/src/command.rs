//! Third stage: what the operator asks for, from the messages received.

use crate::can::command::Mode;
use crate::can::inbox::Inbox;
use crate::io::Request;

/// What the operator wants now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Intent {
    /// The request.
    pub request: Request,
    /// The levers, read with [`Request::Levers`]: swing, boom, arm, bucket; ±32767 asks for full speed, extending positive.
    pub levers: [i16; 4],
}

impl Intent {
    /// Levers in neutral.
    pub const NEUTRAL: Self = Self { request: Request::Neutral, levers: [0; 4] };

    /// What the operator asks for; `None` unless every message it needs is fresh. Levers are believed together or not at all.
    pub fn of(inbox: &Inbox) -> Option<Self> {
        let still = |request| Some(Self { request, levers: [0; 4] });
        match inbox.mode().value? {
            Mode::Neutral | Mode::Hold => still(Request::Neutral),
            Mode::Dig => still(Request::Dig),
            Mode::Reach => still(Request::Reach),
            Mode::Move => still(Request::Move),
            // Not a motion of this controller yet: like silence, so that it ends in a named fault.
            Mode::TipVelocity => None,
            Mode::Levers => {
                let mut levers = [0; 4];
                for (lever, valve) in levers.iter_mut().zip(inbox.valves()) {
                    *lever = valve.value?.lever()?;
                }
                Some(Self { request: Request::Levers, levers })
            }
        }
    }
}

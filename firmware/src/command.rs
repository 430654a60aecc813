//! Third stage: what the operator asks for, from the messages received.

use crate::can::command::{Mode, TipVelocity};
use crate::can::inbox::Inbox;
use crate::io::Request;

/// What the operator wants now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intent {
    /// The request.
    pub request: Request,
    /// The levers, read with [`Request::Levers`] and [`Request::Grade`]: swing, boom, arm, bucket; ±32767 asks for full speed, extending positive.
    pub levers: [i16; 4],
    /// The tip's velocity, read with [`Request::TipVelocity`].
    pub tip: TipVelocity,
}

impl Intent {
    /// Levers in neutral.
    pub const NEUTRAL: Self = Self { request: Request::Neutral, levers: [0; 4], tip: TipVelocity::ZERO };

    /// What the operator asks for; `None` unless every message it needs is fresh. Levers are believed together or not at all.
    pub fn of(inbox: &Inbox) -> Option<Self> {
        let still = |request| Some(Self { request, ..Self::NEUTRAL });
        let levers = |request| {
            let mut levers = [0; 4];
            for (lever, valve) in levers.iter_mut().zip(inbox.valves()) {
                *lever = valve.value?.lever()?;
            }
            Some(Self { request, levers, ..Self::NEUTRAL })
        };
        match inbox.mode().value? {
            Mode::Neutral | Mode::Hold => still(Request::Neutral),
            Mode::Dig => still(Request::Dig),
            Mode::Reach => still(Request::Reach),
            Mode::Move => still(Request::Move),
            Mode::Path => still(Request::Path),
            Mode::TipVelocity => {
                let tip = inbox.tip_velocity().value?;
                Some(Self { request: Request::TipVelocity, tip, ..Self::NEUTRAL })
            }
            Mode::Levers => levers(Request::Levers),
            Mode::Grade => levers(Request::Grade),
        }
    }
}

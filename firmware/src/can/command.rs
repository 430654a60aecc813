//! What the messages received say, as values.

use kinematics_core::Rotor;

use super::signal::Unusable;
use super::table::received::{BOOM_COMMAND, BOOM_PRESSURES, MODE, SLOPE, TIP_VELOCITY};

/// What a valve shall do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValveState {
    /// Hold.
    Blocked,
    /// Extend the cylinder.
    Extend,
    /// Retract it.
    Retract,
    /// Let it float.
    Floating,
}

/// One function's command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValveCommand {
    /// What to do.
    pub state: ValveState,
    /// How fast, 0 to 1 of full flow.
    pub flow: f32,
}

impl ValveCommand {
    /// As a lever for [`crate::Intent::levers`]: ±32767 at full flow, extending positive, 0 when blocked; `None` for floating, which
    /// no lever says.
    pub fn lever(&self) -> Option<i16> {
        let deflection = (self.flow * f32::from(i16::MAX) + 0.5) as i16;
        match self.state {
            ValveState::Blocked => Some(0),
            ValveState::Extend => Some(deflection),
            ValveState::Retract => Some(-deflection),
            ValveState::Floating => None,
        }
    }

    /// All four commands have one layout; the boom's stands for it.
    pub(crate) fn of(payload: u64) -> Result<Self, Unusable> {
        let [flow, state, _, _] = BOOM_COMMAND.decode(payload);
        let [_, state_code, _, _] = BOOM_COMMAND.unpack(payload);
        let percent = flow?;
        state?;
        let state = match state_code {
            0 => ValveState::Blocked,
            1 => ValveState::Extend,
            2 => ValveState::Retract,
            3 => ValveState::Floating,
            _ => return Err(Unusable::OutOfRange),
        };
        Ok(Self { state, flow: percent / 100.0 })
    }
}

/// The wanted velocity of the bucket tip in the swing plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipVelocity {
    /// Outward, m/s.
    pub x_mps: f32,
    /// Up, m/s.
    pub z_mps: f32,
    /// Bucket pitch, counter-clockwise with x to the right, rad/s.
    pub pitch_radps: f32,
}

impl TipVelocity {
    /// Standstill.
    pub const ZERO: Self = Self { x_mps: 0.0, z_mps: 0.0, pitch_radps: 0.0 };

    pub(crate) fn of(payload: u64) -> Result<Self, Unusable> {
        let [x, z, pitch, _, _] = TIP_VELOCITY.decode(payload);
        Ok(Self { x_mps: x?, z_mps: z?, pitch_radps: pitch? })
    }
}

/// What the operator wants done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Levers in neutral.
    Neutral,
    /// The four valve commands.
    Levers,
    /// The tip velocity command.
    TipVelocity,
    /// Follow the dig.
    Dig,
    /// Reach for a point.
    Reach,
    /// Move to a pose.
    Move,
    /// Hold still.
    Hold,
    /// The arm's valve command; boom and bucket hold the plane.
    Grade,
    /// Follow the path.
    Path,
}

impl Mode {
    /// Every mode, in the order of its codes.
    pub const ALL: [Self; 9] = [
        Self::Neutral,
        Self::Levers,
        Self::TipVelocity,
        Self::Dig,
        Self::Reach,
        Self::Move,
        Self::Hold,
        Self::Grade,
        Self::Path,
    ];

    /// As on the bus.
    pub const fn code(self) -> u32 {
        self as u32
    }

    pub(crate) fn of(payload: u64) -> Result<Self, Unusable> {
        let [mode, _, _] = MODE.decode(payload);
        let [code, _, _] = MODE.unpack(payload);
        mode?;
        Self::ALL.into_iter().find(|mode| mode.code() == code).ok_or(Unusable::OutOfRange)
    }
}

/// How the chassis stands, in the signs of [`kinematics_core::world::BasePlacement`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    /// Positive to the right.
    pub roll: Rotor<f32>,
    /// Positive nose down; on the bus it is nose up.
    pub pitch: Rotor<f32>,
}

impl Slope {
    pub(crate) fn of(payload: u64) -> Result<Self, Unusable> {
        let [pitch_deg, roll_deg, _, pitch_merit, _, roll_merit, _] = SLOPE.decode(payload);
        for merit in [pitch_merit, roll_merit] {
            match merit {
                // A sensor that does not rate itself is judged by its angle alone.
                Ok(0.0) | Err(Unusable::NotAvailable) => {}
                _ => return Err(Unusable::Error),
            }
        }
        let rotor = |deg: f32| Rotor::from_turns(deg * (1.0 / 360.0));
        Ok(Self { roll: rotor(roll_deg?), pitch: rotor(0.0 - pitch_deg?) })
    }
}

/// A cylinder's pressures, Pa above ambient, each on its own: one sensor's failure is not the other's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressures {
    /// Head (piston) side.
    pub head_pa: Result<f32, Unusable>,
    /// Rod side.
    pub rod_pa: Result<f32, Unusable>,
}

impl Pressures {
    /// All three messages have one layout; the boom's stands for it.
    pub(crate) fn of(payload: u64) -> Self {
        let [head_pa, rod_pa, _, _] = BOOM_PRESSURES.decode(payload);
        Self { head_pa, rod_pa }
    }
}

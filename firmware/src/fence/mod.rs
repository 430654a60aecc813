//! Between motion and valve: the fence. Speeds that would carry any part of the linkage past a limit are reduced, none is added.
//!
//! What was commanded within the dead time, and what the spools' lag still gives, is to come whatever is decided now:
//! `to_come` knows it from the valves' own model. The limits are weighed where that will have carried the machine
//! ([`kinematics_core::planning::fence`]), so that no command is judged before the one ahead of it has been counted.
//!
//! Ticks take turns: in one, what is wanted is kept within the approaches that are near; in the next, some more of the linkage and its
//! limits is weighed (`sweep`), what both ticks have commanded is counted, and no actuator gets more than it was let through before.
//! What recedes makes up for what approaches only as far as its spool has opened, and that takes many ticks to close: one tick of less
//! of it takes nothing away.

mod parameters;
mod sweep;
mod to_come;

use kinematics_core::swing::SwingCylinder;
use kinematics_core::{Cylinders, Machine, PoseError, Rotor};

use crate::fault::Fault;
use crate::io::{Speeds, limited};
use crate::parameters::{ParameterError, ValveDirection};
use crate::sensing::Sensed;

pub use parameters::{BallParameters, FenceParameters, Guards, PlaneParameters, SwingRangeParameters};
use sweep::{Ahead, Sweep};
use to_come::ToCome;

/// What the fence hands on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fenced {
    /// The speeds let through.
    pub speeds: Speeds,
    /// The smallest clearance of a guarded part to a plane or ball, where everything commanded has arrived, m, as weighed last;
    /// [`NO_CLEARANCE`] without any.
    pub clearance_m: f32,
}

/// The clearance where there is nothing to be clear of, m.
pub const NO_CLEARANCE: f32 = f32::MAX;

/// Nearer to a stop than this, m, noise may hide that an actuator stands at it.
const NEAR_STOP: f32 = 0.001;

/// The travel of a swing motor, rad: more than any that is under way at once.
const ENDLESS: [f32; 2] = [-1000.0, 1000.0];

/// How the swing's position adds up.
#[derive(Clone, Copy, Debug)]
enum Swing {
    Motor,
    Cylinder { cylinder: SwingCylinder<f32>, stroke: [f32; 2] },
}

/// The rotor of an angle, rad, as what turns within a dead time is: by its half's tangent, whose series leaves 1e-4 at one radian and 1e-6 at
/// a half. It is of unit length whatever the angle.
#[inline(always)]
fn turned_by(angle: f32) -> Rotor<f32> {
    let half = 0.5 * angle;
    let square = half * half;
    let tangent = half * (1.0 + square * (1.0 / 3.0 + square * (2.0 / 15.0 + square * (17.0 / 315.0))));
    let square = tangent * tangent;
    let reciprocal = 1.0 / (1.0 + square);
    Rotor { cos: (1.0 - square) * reciprocal, sin: (tangent + tangent) * reciprocal }
}

/// The fence stage.
#[derive(Clone, Debug)]
pub struct Fence {
    sweep: Sweep,
    swing: Swing,
    /// Swing, boom, arm, bucket.
    to_come: [ToCome; 4],
    /// Where the actuators were measured last, and between which ends; a motor counts from wherever it is.
    positions: [f32; 4],
    travels: [[f32; 2]; 4],
    /// Commanded in the tick before and not counted yet: it kept within limits, this one weighs.
    sent: Option<[f32; 4]>,
    /// What a tick that weighs lets through at most.
    most: [f32; 4],
}

impl Fence {
    pub(crate) fn new(
        p: &FenceParameters,
        geometry: &kinematics_core::PinGeometry,
        machine: &Machine<f32>,
        valves: &[[ValveDirection; 2]; 4],
    ) -> Result<Self, ParameterError> {
        let g = geometry;
        let range = |stroke: kinematics_core::geometry::Stroke| [stroke.min_m as f32, stroke.max_m as f32];
        let swing = match (machine.swing_cylinder(), g.swing) {
            (Some(&cylinder), Some(pins)) => Swing::Cylinder { cylinder, stroke: range(pins.stroke) },
            _ => Swing::Motor,
        };
        let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(range);
        let [boom, arm, bucket] = strokes;
        let of_swing = match &swing {
            Swing::Motor => ENDLESS,
            Swing::Cylinder { stroke, .. } => *stroke,
        };
        Ok(Self {
            sweep: Sweep::new(p, geometry, valves)?,
            swing,
            positions: [0.0; 4],
            travels: [of_swing, boom, arm, bucket],
            to_come: valves.map(|valve| ToCome::new(&valve, p.dead_time_s, p.lag_s)),
            sent: None,
            most: [0.0; 4],
        })
    }

    /// The wanted speeds, reduced where a limit asks for it.
    ///
    /// # Errors
    /// [`Fault::Geometry`] where the pose ahead does not exist.
    #[inline]
    pub fn limit(&mut self, machine: &Machine<f32>, sensed: &Sensed, wanted: &Speeds) -> Result<Fenced, Fault> {
        self.weigh(machine, sensed, wanted).ok_or(Fault::Geometry)
    }

    /// Forgets what was near: nothing passes until every limit has been weighed again.
    #[inline]
    pub fn reset(&mut self) {
        self.sweep.reset();
        self.most = [0.0; 4];
    }

    #[inline]
    fn weigh(&mut self, machine: &Machine<f32>, sensed: &Sensed, wanted: &Speeds) -> Option<Fenced> {
        let wanted = wanted.to_array();
        let speeds = if self.sent.is_none() {
            let (ahead, positions) = self.ahead(sensed)?;
            let within = self.sweep.limit(&ahead, wanted, &self.receding(wanted, positions));
            self.most = within.most;
            within.speeds
        } else {
            if self.sweep.begins() {
                let (ahead, _) = self.ahead(sensed)?;
                self.sweep.begin(machine, &ahead, wanted)?;
            } else {
                self.sweep.go_on(machine)?;
            }
            held(wanted, &self.most)
        };
        Some(Fenced { speeds: Speeds::from_array(speeds), clearance_m: self.sweep.closest_m() })
    }

    /// Where the machine will be once everything commanded has arrived, and its actuators there.
    #[inline]
    fn ahead(&mut self, sensed: &Sensed) -> Option<(Ahead, [f32; 4])> {
        let measured = sensed.lengths;
        let of_swing = match &self.swing {
            Swing::Motor => 0.0,
            Swing::Cylinder { cylinder, .. } => cylinder.length(sensed.swing).ok()?,
        };
        self.positions = [of_swing, measured.boom, measured.arm, measured.bucket];
        let [turning, boom, arm, bucket] = self.to_come.each_ref().map(ToCome::travel);
        let [_, of_boom, of_arm, of_bucket] = self.travels;
        let at = |length: f32, travel: f32, [low, high]: [f32; 2]| limited(length + travel, low, high);
        let lengths = Cylinders {
            boom: at(measured.boom, boom, of_boom),
            arm: at(measured.arm, arm, of_arm),
            bucket: at(measured.bucket, bucket, of_bucket),
        };
        let (swing, per_swing) = self.swing_ahead(sensed.swing, turning).ok()?;
        let positions = [of_swing + turning, lengths.boom, lengths.arm, lengths.bucket];
        Some((Ahead { lengths, swing, per_swing }, positions))
    }

    /// Which part of its wanted speed each actuator has reached at its position ahead.
    #[inline(always)]
    fn receding(&self, wanted: [f32; 4], positions: [f32; 4]) -> [f32; 4] {
        let mut receding = [0.0; 4];
        let actuators = self.to_come.iter().zip(positions.into_iter().zip(self.travels));
        for ((part, wanted), (to_come, (position, [low, high]))) in receding.iter_mut().zip(wanted).zip(actuators) {
            // At its stop, or before its spool has opened, an actuator makes up for no other's approach.
            let moves = if wanted > 0.0 { position < high - NEAR_STOP } else { position > low + NEAR_STOP };
            if moves && wanted != 0.0 {
                *part = limited(to_come.speed() / wanted, 0.0, 1.0);
            }
        }
        receding
    }

    /// The swing this travel of its actuator further, and dθ1 by that travel there.
    #[inline]
    fn swing_ahead(&self, swing: Rotor<f32>, travel: f32) -> Result<(Rotor<f32>, f32), PoseError<f32>> {
        match &self.swing {
            Swing::Motor => Ok((swing * turned_by(travel), 1.0)),
            Swing::Cylinder { cylinder, stroke: [low, high] } => {
                let length = limited(cylinder.length(swing)? + travel, *low, *high);
                Ok((cylinder.rotor(length)?, 1.0 / cylinder.moment_arm(length)?))
            }
        }
    }

    /// Counts what was really commanded this tick: with the tick before, if that kept within limits.
    #[inline]
    pub fn sent(&mut self, speeds: &Speeds) {
        let speeds = speeds.to_array();
        let Some(before) = self.sent.take() else {
            self.sent = Some(speeds);
            return;
        };
        let speeds = self.to_come.iter_mut().zip(before.into_iter().zip(speeds));
        for ((to_come, (before, speed)), (position, travel)) in speeds.zip(self.positions.into_iter().zip(self.travels))
        {
            to_come.command([before, speed], position, travel);
        }
    }
}

/// Each speed between 0 and the most of it.
#[inline(always)]
fn held(mut speeds: [f32; 4], most: &[f32; 4]) -> [f32; 4] {
    for (speed, &most) in speeds.iter_mut().zip(most) {
        *speed = if most > 0.0 { limited(*speed, 0.0, most) } else { limited(*speed, most, 0.0) };
    }
    speeds
}

//! Speed → current of one direction: the jump over the dead band, then the linearised flow curve.

use serde::{Deserialize, Serialize};

use crate::constants::Constant;
use crate::parameters::{Coil, ParameterError, ValveDirection, ordered, within};

/// Points of a flow curve.
pub const KNOTS: usize = 9;

/// Halves of halves of halves: the pieces between the points.
type Halves<T> = [[[T; 2]; 2]; 2];
const _: () = assert!(KNOTS == 9);

/// One direction of a spool, as its calibration leaves it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FlowParameters {
    /// Current at which the actuator just begins to move, A.
    pub min_current_a: f32,
    /// Current of the full speed, A.
    pub max_current_a: f32,
    /// Speed at the largest current, m/s or rad/s.
    pub full_speed: f32,
    /// The jump to the smallest current happens above this speed, m/s or rad/s.
    pub on_above: f32,
    /// The current goes back to zero at this speed or below, m/s or rad/s; at most `on_above`.
    pub off_at: f32,
    /// Share of the full speed at evenly spaced currents from the smallest to the largest: 0 first, 1 last, rising.
    pub flow_table: [f32; KNOTS],
}

impl FlowParameters {
    /// The straight line from the dead band to the full speed.
    #[inline]
    pub fn linear(valve: &ValveDirection, coil: &Coil) -> Self {
        Self {
            min_current_a: valve.dead_band * coil.full_scale_a,
            max_current_a: coil.full_scale_a,
            full_speed: valve.full_speed,
            on_above: 0.0,
            off_at: 0.0,
            flow_table: [0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0],
        }
    }

    /// Its ends alone.
    #[inline]
    pub fn direction(&self) -> ValveDirection {
        ValveDirection { dead_band: self.min_current_a / self.max_current_a, full_speed: self.full_speed }
    }

    /// Checks every value.
    ///
    /// # Errors
    /// The first at fault, by name and range.
    pub fn validate(&self) -> Result<(), ParameterError> {
        within("valve.max_current_a", self.max_current_a, [0.05, 5.0])?;
        within("valve.min_current_a", self.min_current_a, [0.0, 0.9 * f64::from(self.max_current_a)])?;
        within("valve.full_speed", self.full_speed, [0.001, 5.0])?;
        within("valve.on_above", self.on_above, [0.0, 0.1 * f64::from(self.full_speed)])?;
        within("valve.off_at", self.off_at, [0.0, self.on_above.into()])?;
        let (first, last) = (self.flow_table.iter().take(1), self.flow_table.iter().skip(KNOTS - 1));
        for (&end, exact) in first.chain(last).zip([0.0, 1.0]) {
            within("valve.flow_table", end, [exact; 2])?;
        }
        for (below, above) in self.flow_table.iter().zip(self.flow_table.iter().skip(1)) {
            // A flatter piece would turn a little speed into a leap of current.
            let least = f64::from(*below) + 0.001;
            ordered(("valve.flow_table", least), ("its next point by 0.001", (*above).into()))?;
        }
        Ok(())
    }
}

/// A piece of the curve, from its slow end on.
#[derive(Clone, Copy, Debug)]
struct Piece {
    from: f32,
    from_a: f32,
    amperes_per_speed: f32,
}

/// The map of one direction, and whether it is beyond the jump.
#[derive(Clone, Copy, Debug)]
pub struct FlowMap {
    pieces: Halves<Piece>,
    max_a: f32,
    on_above: f32,
    off_at: f32,
    flowing: bool,
}

/// The second half if it begins at or below the speed, else the first.
#[inline(always)]
fn later<T>(halves: &[T; 2], from: impl Fn(&T) -> f32, speed: f32) -> &T {
    let [first, second] = halves;
    if speed >= from(second) { second } else { first }
}

impl FlowMap {
    /// Where its curve lies.
    pub(super) const fn constant(&self) -> Constant {
        Constant::of(&self.pieces)
    }

    /// From valid parameters.
    pub fn new(parameters: &FlowParameters) -> Self {
        let p = parameters;
        let step_a = (p.max_current_a - p.min_current_a) / (KNOTS - 1) as f32;
        let mut pieces = [[[Piece { from: 0.0, from_a: 0.0, amperes_per_speed: 0.0 }; 2]; 2]; 2];
        let ends = p.flow_table.iter().zip(p.flow_table.iter().skip(1));
        for ((index, piece), (below, above)) in pieces.iter_mut().flatten().flatten().enumerate().zip(ends) {
            *piece = Piece {
                from: below * p.full_speed,
                from_a: p.min_current_a + step_a * index as f32,
                amperes_per_speed: step_a / ((above - below) * p.full_speed),
            };
        }
        let (on_above, off_at) = (p.on_above, p.off_at);
        Self { pieces, max_a: p.max_current_a, on_above, off_at, flowing: false }
    }

    /// Current (A) for a speed (m/s, a swing motor rad/s) in this direction; a speed the other way gives none. The curve is inverted by linear interpolation.
    #[inline]
    pub fn current_a(&mut self, speed: f32) -> f32 {
        let threshold = if self.flowing { self.off_at } else { self.on_above };
        self.flowing = speed > threshold;
        if self.flowing { self.beyond(speed) } else { 0.0 }
    }

    /// Beyond the jump, and stays there at this speed.
    #[inline(always)]
    pub(super) fn stays_on(&self, speed: f32) -> bool {
        self.flowing && speed > self.off_at
    }

    /// Current (A) for a speed beyond the jump.
    #[inline(always)]
    pub(super) fn beyond(&self, speed: f32) -> f32 {
        // The last piece that begins at or below the speed, by halving.
        let half = later(&self.pieces, |[[piece, _], _]| piece.from, speed);
        let quarter = later(half, |[piece, _]| piece.from, speed);
        let piece = later(quarter, |piece| piece.from, speed);
        let current = piece.from_a + piece.amperes_per_speed * (speed - piece.from);
        if current < self.max_a { current } else { self.max_a }
    }

    /// Back before the jump: the solenoid is off.
    #[inline]
    pub fn rest(&mut self) {
        self.flowing = false;
    }

    /// Before the jump.
    #[inline]
    pub(super) fn rests(&self) -> bool {
        !self.flowing
    }

    /// The jump happens above this speed.
    #[inline]
    pub(super) fn on_above(&self) -> f32 {
        self.on_above
    }

    /// The smallest current that moves anything, A.
    #[inline(always)]
    pub fn min_a(&self) -> f32 {
        let [[[first, _], _], _] = &self.pieces;
        first.from_a
    }
}

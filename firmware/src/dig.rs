//! Frankel's dig (`dig.m`) as a function of time: reach out along the ground, plunge, scoop back in an arc.
//!
//! Two readings of the paper's program. *As meant*: the plunge goes straight down at the reach, the scoop is an arc of radius
//! `scoop`. *As published*: during the plunge x stays at the last sample of the reach (`hold_lead_s`), and `scoop` is never
//! used, the arc's radius following from reach and plunge ([`DigParameters::published_scoop_radius_m`]).

use kinematics_core::{PlaneTip, Real, Rotor, Vec2};
use serde::{Deserialize, Serialize};

use crate::TICKS_PER_S;

/// The control period, s; rounded to f32 it is [`crate::TICK_S`].
const TICK: f64 = 0.001;

/// A dig. Positions in the boom's plane of the base frame (origin on the swing axis at boom-pin height), m; pitches are
/// continuous angles in degrees, not wrapped (`dig.m`'s φ + 180°).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DigParameters {
    /// Tip at the start, reach, m.
    pub start_x_m: f64,
    /// Tip at the start, height, m.
    pub start_z_m: f64,
    /// Height of the ground, where the reach ends, m.
    pub ground_z_m: f64,
    /// Reach where the tip enters the ground, m.
    pub reach_m: f64,
    /// Depth of the plunge below the base frame's origin, m.
    pub plunge_m: f64,
    /// Radius of the scoop's arc, m.
    pub scoop_radius_m: f64,
    /// Direction from the arc's centre to the tip at the end, degrees, reached clockwise.
    pub scoop_end_deg: f64,
    /// Pitch at the start and after reach, plunge and scoop, degrees.
    pub pitch_deg: [f64; 4],
    /// End times of reach, plunge and scoop, s.
    pub until_s: [f64; 3],
    /// How long before the end of the reach x stops (one sample of `dig.m`; 0 as meant), s.
    pub hold_lead_s: f64,
}

impl DigParameters {
    /// From the arc's centre to the tip where the scoop begins, as `dig.m` has it: (0.4·reach, −0.7·plunge), m.
    fn scoop_start(&self) -> Vec2<f64> {
        Vec2::new(0.4 * self.reach_m, -0.7 * self.plunge_m)
    }

    /// The radius the published program uses whatever `scoop` says, m.
    pub fn published_scoop_radius_m(&self) -> f64 {
        self.scoop_start().norm()
    }
}

/// A value that changes evenly over a time span.
#[derive(Clone, Copy, Debug)]
struct Ramp<T> {
    from: T,
    rate: T,
}

impl<T: Real> Ramp<T> {
    fn new(from: f64, to: f64, duration: f64) -> Self {
        Self { from: T::from_f64(from), rate: T::from_f64((to - from) / duration) }
    }

    fn at(&self, elapsed: T) -> T {
        self.from + self.rate * elapsed
    }
}

/// The dig's constants, ready for the loop: no trigonometry from here on.
#[derive(Clone, Copy, Debug)]
pub struct Dig<T> {
    until: [T; 3],
    x_until: T,
    x: Ramp<T>,
    z: [Ramp<T>; 2],
    pitch_turns: [Ramp<T>; 3],
    centre: Vec2<T>,
    radius: T,
    scoop_turns: Ramp<T>,
}

impl<T: Real> Dig<T> {
    /// The constants of validated parameters.
    pub fn new(p: &DigParameters) -> Self {
        let [reached, plunged, end] = p.until_s;
        let [pitch0, pitch1, pitch2, pitch3] = p.pitch_deg.map(|degrees| degrees / 360.0);
        let start = p.scoop_start();
        let radial = start.direction().unwrap_or(Rotor::IDENTITY);
        let start_turns = radial.angle() / core::f64::consts::TAU;
        let offset = radial.to_vec().scale(p.scoop_radius_m);
        Self {
            until: p.until_s.map(T::from_f64),
            x_until: T::from_f64(reached - p.hold_lead_s),
            x: Ramp::new(p.start_x_m, p.reach_m, reached),
            z: [Ramp::new(p.start_z_m, p.ground_z_m, reached), Ramp::new(p.ground_z_m, -p.plunge_m, plunged - reached)],
            pitch_turns: [
                Ramp::new(pitch0, pitch1, reached),
                Ramp::new(pitch1, pitch2, plunged - reached),
                Ramp::new(pitch2, pitch3, end - plunged),
            ],
            centre: Vec2::new(T::from_f64(p.reach_m - offset.x), T::from_f64(-p.plunge_m - offset.z)),
            radius: T::from_f64(p.scoop_radius_m),
            scoop_turns: Ramp::new(start_turns, p.scoop_end_deg / 360.0, end - plunged),
        }
    }

    /// When it ends, s.
    pub fn duration(&self) -> T {
        self.until[2]
    }

    /// Tip and pitch at a control tick after the start: the one way from ticks to time, so that what is checked before
    /// motion is to the bit what motion follows.
    pub fn at_tick(&self, tick: u32) -> PlaneTip<T> {
        self.tip(Self::time_of(tick))
    }

    /// The time of a control tick, s.
    pub fn time_of(tick: u32) -> T {
        // Digs last minutes: far from i32's end.
        T::from_i32(tick as i32) * T::from_f64(TICK)
    }

    /// Control ticks until the end, to the nearest.
    pub fn ticks(&self) -> u32 {
        let ticks = (self.duration() * T::from_i32(TICKS_PER_S as i32)).nearest_i32();
        // Saturated at zero: a dig lasts longer.
        u32::try_from(ticks).unwrap_or(0)
    }

    /// Tip and pitch at `time` (s); before the start and after the end it rests.
    pub fn tip(&self, time: T) -> PlaneTip<T> {
        let [reached, plunged, end] = self.until;
        let time = if time < T::ZERO {
            T::ZERO
        } else if time > end {
            end
        } else {
            time
        };
        let [reach_pitch, plunge_pitch, scoop_pitch] = &self.pitch_turns;
        let (reach, height, pitch_turns) = if time < plunged {
            let x = self.x.at(if time < self.x_until { time } else { self.x_until });
            if time < reached {
                (x, self.z[0].at(time), reach_pitch.at(time))
            } else {
                (x, self.z[1].at(time - reached), plunge_pitch.at(time - reached))
            }
        } else {
            let elapsed = time - plunged;
            let arc = Rotor::from_turns(self.scoop_turns.at(elapsed)).to_vec().scale(self.radius);
            (self.centre.x + arc.x, self.centre.z + arc.z, scoop_pitch.at(elapsed))
        };
        PlaneTip { reach, height, pitch: Rotor::from_turns(pitch_turns) }
    }
}

//! Follows a path of straight segments. The segment's own clock slows where an actuator or the pump cannot keep up.

use kinematics_core::jacobian::Twist;
use kinematics_core::{Cylinders, Machine, PlaneTip, Pose, Real, Rotor};

use super::Wanted;
use super::coordinated::{Ahead, Coordination};
use super::delays::Delays;
use super::profile::Profile;
use super::resolve::resolve;
use super::sum::Sum;
use crate::fault::Fault;
use crate::path::{KNOTS, Knot, PathParameters, PathViolation};
use crate::pose::cylinders_once;
use crate::{TICK_S, TICKS_PER_S};

/// Places of a segment that are tried before anything moves.
const TRIED: i32 = 64;

/// Corrections go on for so long after the path's end.
const SETTLE_TICKS: u32 = TICKS_PER_S;

/// A path may end where a stroke does: before ends it slows to this share and no further.
const SLOWEST: f32 = 0.05;

const TURN: f32 = core::f32::consts::TAU;

/// Reach and height, m; pitch and swing, turns.
type Place = [f32; 4];

#[derive(Clone, Copy, Debug)]
struct Segment {
    from: Place,
    change: Place,
    profile: Profile,
}

impl Segment {
    fn new(from: [f64; 4], to: [f64; 4], p: &PathParameters) -> Self {
        let mut change = to;
        for (to, from) in change.iter_mut().zip(from) {
            *to -= from;
        }
        let [x, z, pitch, swing] = change;
        let turn = |turns: f64| if turns < 0.0 { -360.0 * turns } else { 360.0 * turns };
        // The slowest of the three decides; 1 s and 1 s² for a segment that goes nowhere.
        let (mut speed, mut acceleration) = (1.0, 1.0);
        for (way, fastest, steepest) in [
            (Real::sqrt(x * x + z * z), p.speed_mps, p.acceleration_mps2),
            (turn(pitch), p.pitch_speed_deg_s, p.pitch_acceleration_deg_s2),
            (turn(swing), p.swing_speed_deg_s, p.swing_acceleration_deg_s2),
        ] {
            if speed * way > fastest {
                speed = fastest / way;
            }
            if acceleration * way > steepest {
                acceleration = steepest / way;
            }
        }
        Self {
            from: from.map(|x| x as f32),
            change: change.map(|x| x as f32),
            profile: Profile::new(speed, acceleration),
        }
    }

    #[inline]
    fn place(&self, share: f32) -> Place {
        let mut place = self.from;
        for (place, change) in place.iter_mut().zip(self.change) {
            *place += change * share;
        }
        place
    }
}

#[inline]
fn tip([reach, height, pitch, _]: Place) -> PlaneTip<f32> {
    PlaneTip { reach, height, pitch: Rotor::from_turns(pitch) }
}

#[derive(Clone, Copy, Debug)]
enum Phase {
    Before,
    /// On the segment of this number.
    Under(usize),
    /// Ticks since the last segment ended.
    Ended(u32),
    /// Hold until asked anew.
    Done,
}

/// The follower of one path.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathFollower {
    segments: [Option<Segment>; KNOTS - 1],
    /// Some knot has another swing than the first.
    swings: bool,
    phase: Phase,
    time_s: Sum,
    elapsed: u32,
    start: Cylinders<f32>,
}

impl PathFollower {
    /// Of a valid path.
    pub(super) fn new(p: &PathParameters, machine: &Machine<f32>) -> Result<Self, PathViolation> {
        let mut segments = [None; KNOTS - 1];
        let knots = || p.knots.iter().flatten().map(Knot::place);
        for (segment, (from, to)) in segments.iter_mut().zip(knots().zip(knots().skip(1))) {
            *segment = Some(Segment::new(from, to, p));
        }
        let mut start = crate::io::NO_LENGTHS;
        for (number, segment) in segments.iter().flatten().enumerate() {
            for i in 0..=TRIED {
                let place = segment.place(i as f32 / TRIED as f32);
                let lengths = cylinders_once(machine, &tip(place));
                let lengths = lengths.map_err(|error| PathViolation { segment: number, error })?;
                if (number, i) == (0, 0) {
                    start = lengths;
                }
            }
        }
        let swings = segments.iter().flatten().any(|segment| {
            let [.., swing] = segment.change;
            swing != 0.0
        });
        Ok(Self { segments, swings, phase: Phase::Before, time_s: Sum::new(0.0), elapsed: 0, start })
    }

    pub(super) fn reset(&mut self) {
        self.phase = Phase::Before;
        self.elapsed = 0;
    }

    /// One tick of the path; at its end it holds.
    #[inline(always)]
    pub(super) fn follow(
        &mut self,
        machine: &Machine<f32>,
        (shared, delays): (&mut Coordination, &mut Delays),
        pose: &Pose<f32>,
        lengths: &Cylinders<f32>,
    ) -> Result<Wanted, Fault> {
        let number = match self.phase {
            Phase::Done => return Ok(Wanted::hold(lengths)),
            Phase::Before => {
                self.begin(shared, pose, lengths)?;
                0
            }
            Phase::Under(number) => number,
            Phase::Ended(ticks) if ticks > shared.law.preview_ticks() + SETTLE_TICKS => {
                self.phase = Phase::Done;
                return Ok(Wanted::hold(lengths));
            }
            Phase::Ended(ticks) => {
                self.phase = Phase::Ended(ticks + 1);
                KNOTS
            }
        };
        self.elapsed = self.elapsed.saturating_add(1);
        let last = || self.segments.iter().flatten().last();
        let at = self.segments.get(number).and_then(Option::as_ref);
        let under = at.is_some();
        let segment = at.or_else(last).ok_or(Fault::NotConfigured)?;
        let (share, rate) = if under { segment.profile.at(self.time_s.value()) } else { (1.0, 0.0) };
        let duration_s = segment.profile.duration_s();
        let place = segment.place(share);
        let [x, z, pitch, swing] = segment.change.map(|change| change * rate);
        let twist = Twist { reach: x, height: z, pitch: pitch * TURN };
        let (ahead, [boom, arm, bucket]) = resolve(machine, &tip(place), &twist)?;
        let swing_lever = if self.swings { shared.swing_lever(machine, pose)? } else { 0.0 };
        let rates = [swing * TURN, boom, arm, bucket];
        let mut factor = shared.factor(rates, swing_lever, &ahead);
        if factor < SLOWEST {
            factor = SLOWEST;
        }
        if under {
            self.advance(number, duration_s, factor);
        }
        let [.., first_swing] = self.first_place();
        let [.., swing_turns] = place;
        let ahead = Ahead {
            start: self.start,
            lengths: ahead,
            feed_forward: rates.map(|rate| rate * factor),
            swing: self.swings.then_some([first_swing, swing_turns - first_swing]),
        };
        let mut wanted = shared.close(delays, (&ahead, swing_lever), pose, lengths)?;
        wanted.dig_tick = self.elapsed.saturating_sub(shared.law.preview_ticks());
        Ok(wanted)
    }

    #[inline]
    fn first_place(&self) -> Place {
        let [first, ..] = &self.segments;
        first.map_or([0.0; 4], |segment| segment.from)
    }

    #[inline(never)]
    fn begin(&mut self, shared: &mut Coordination, pose: &Pose<f32>, lengths: &Cylinders<f32>) -> Result<(), Fault> {
        let [.., swing] = self.first_place();
        // Of a path that does not swing any swing will do.
        let off = if self.swings { pose.swing.to_vec().cross(Rotor::from_turns(swing).to_vec()) } else { 0.0 };
        let start = self.start;
        let errors = [off, start.boom - lengths.boom, start.arm - lengths.arm, start.bucket - lengths.bucket];
        shared.law.check_start(errors)?;
        shared.law.begin(0);
        self.phase = Phase::Under(0);
        self.time_s = Sum::new(0.0);
        Ok(())
    }

    #[inline]
    fn advance(&mut self, number: usize, duration_s: f32, factor: f32) {
        self.time_s.add(TICK_S * factor);
        if self.time_s.value() >= duration_s {
            self.time_s = Sum::new(0.0);
            let more = self.segments.get(number + 1).is_some_and(Option::is_some);
            self.phase = if more { Phase::Under(number + 1) } else { Phase::Ended(0) };
        }
    }
}

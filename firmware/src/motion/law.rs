//! The control law of trajectory, grade and tip velocity.
//!
//! A mode says where the actuators shall be a preview (dead time and lag) from now, and how fast they go there: the feed-forward.
//! What is measured now is compared with where the reference was a preview ago, less the corrections given since, whose effect is
//! still to come (a Smith predictor of an integrator behind a dead time). So the gain need not be low for the dead time's sake:
//!
//! ```text
//! lacking = (reference − measured) − ∫ corrections of the last preview
//! speed   = feed-forward + gain · lacking + what this direction of the spool has been found to lack
//! ```
//!
//! `lacking` is a mean over the feedback's time: at the frequency a machine rings with on its oil, the gain is low.
//!
//! The last term is learnt from `lacking` while the actuator moves; it is an error of the valve map, kept for each direction, and not
//! among the corrections under way: at a steady speed the error itself goes to zero.

use super::creep::Creep;
use super::delays::{Delays, preview_ticks};
use crate::TICK_S;
use crate::fault::Fault;
use crate::io::limited;
use crate::law::LawParameters;
use crate::parameters::MotionParameters;

/// An error is left alone up to the rest zone, and from then on up to so many of it.
const LEAVES_REST: f32 = 3.0;

/// `x` within this of zero, where it mostly is.
#[inline(always)]
fn within(x: f32, most: f32) -> f32 {
    if x.abs() > most { end(x, most) } else { x }
}

/// Not inlined: the compiler would compute both ends and choose, which takes longer than to see that neither is wanted.
#[cold]
#[inline(never)]
fn end(x: f32, most: f32) -> f32 {
    if x > 0.0 { most } else { -most }
}

/// One actuator.
#[derive(Clone, Copy, Debug)]
struct Channel {
    /// What extending and retracting lack, m/s: both positive where the valve gives too little.
    bias: [f32; 2],
    /// Sum of the corrections since the start, m.
    given: f32,
    /// The same a preview ago.
    given_then: f32,
    /// Not left alone within the rest zone.
    awake: bool,
    creep: Creep,
    /// What has been lacking, over the feedback's time.
    lacked: f32,
    /// One over the lag that all but stops the clock.
    per_lag: f32,
}

impl Channel {
    const fn new(bias: [f32; 2], per_lag: f32) -> Self {
        Self { bias, given: 0.0, given_then: 0.0, awake: false, creep: Creep::REST, lacked: 0.0, per_lag }
    }
}

/// The law's state. Swing, boom, arm, bucket in every array.
#[derive(Clone, Copy, Debug)]
pub(super) struct Law {
    feed_forward: f32,
    gain_per_s: f32,
    integral_per_tick: f32,
    bias_limit: f32,
    correction_limit: f32,
    rest_zone: f32,
    smallest_speed: f32,
    following_errors: [f32; 4],
    start_tolerance_m: f32,
    preview_ticks: u32,
    /// Until this tick nothing is corrected.
    quiet_until: u32,
    tick: u32,
    channels: [Channel; 4],
    /// Share of what is lacking now.
    feedback_share: f32,
    /// The largest lag in the direction of motion, as a share of its own.
    lag: f32,
}

/// Up to this share of the lag that all but stops the clock it keeps its pace.
const PATIENCE: f32 = 0.25;

/// The slowest pace of the clock for the sake of a lag.
const SLOWEST: f32 = 0.05;

impl Law {
    pub(super) fn new(motion: &MotionParameters, p: &LawParameters) -> Self {
        let cylinder = motion.following_error_m;
        let per_lag = 1.0 / p.lag_m;
        let of_swing = 1.0 / p.swing_following_error_rad * (cylinder / p.lag_m);
        Self {
            feed_forward: p.feed_forward,
            gain_per_s: motion.gain_per_s,
            integral_per_tick: p.integral_per_s2 * TICK_S,
            bias_limit: p.bias_limit_mps,
            correction_limit: p.correction_limit_mps,
            rest_zone: p.rest_zone_m,
            smallest_speed: motion.smallest_speed_mps,
            following_errors: [p.swing_following_error_rad, cylinder, cylinder, cylinder],
            start_tolerance_m: motion.start_tolerance_m,
            preview_ticks: preview_ticks(motion),
            quiet_until: 0,
            tick: 0,
            channels: [of_swing, per_lag, per_lag, per_lag].map(|per_lag| Channel::new([0.0; 2], per_lag)),
            feedback_share: if p.feedback_lag_s > TICK_S { TICK_S / p.feedback_lag_s } else { 1.0 },
            lag: 0.0,
        }
    }

    /// The pace at which whatever lags can catch up: a valve that gets too little oil is seen in no other way.
    #[inline(always)]
    pub(super) fn pace(&self) -> f32 {
        limited(1.0 + PATIENCE - self.lag, SLOWEST, 1.0)
    }

    /// How far ahead modes have to look, ticks.
    #[inline]
    pub(super) fn preview_ticks(&self) -> u32 {
        self.preview_ticks
    }

    /// Starts over; what the valves were found to lack is kept. Nothing is corrected for `quiet` ticks after the preview.
    pub(super) fn begin(&mut self, quiet: u32) {
        self.tick = 0;
        self.lag = 0.0;
        self.quiet_until = self.preview_ticks.saturating_add(quiet);
        for channel in &mut self.channels {
            *channel = Channel::new(channel.bias, channel.per_lag);
        }
    }

    /// Whether every cylinder is near enough to where a path starts.
    #[inline]
    pub(super) fn check_start(&self, errors: [f32; 4]) -> Result<(), Fault> {
        let [_, cylinders @ ..] = errors;
        let near = |error: f32| error >= -self.start_tolerance_m && error <= self.start_tolerance_m;
        if cylinders.into_iter().all(near) { Ok(()) } else { Err(Fault::NotAtStart) }
    }

    /// Takes this tick's place ahead, relative to the start, and tells that of a preview ago: the reference of now. Without `turned`
    /// the swing stays as it is.
    #[inline(always)]
    pub(super) fn reference(
        &mut self,
        delays: &mut Delays,
        [a, b, c]: [f32; 3],
        turned: Option<f32>,
    ) -> (f32, [f32; 3]) {
        self.tick = self.tick.saturating_add(1);
        let [swing, boom, arm, bucket] = &mut self.channels;
        let ahead = [a, b, c, boom.given, arm.given, bucket.given, turned.unwrap_or(0.0), swing.given];
        let [a, b, c, boom_then, arm_then, bucket_then, turned_then, swing_then] = delays.modes(self.tick, ahead);
        (boom.given_then, arm.given_then, bucket.given_then) = (boom_then, arm_then, bucket_then);
        let turned = turned.map_or(0.0, |_| {
            swing.given_then = swing_then;
            turned_then
        });
        (turned, [a, b, c])
    }

    /// Speeds, from the feed-forward and reference − measured; the swing stands still unless it `swings`.
    #[inline]
    pub(super) fn speeds(&mut self, feed_forward: [f32; 4], errors: [f32; 4], swings: bool) -> Result<[f32; 4], Fault> {
        self.lag = 0.0;
        // One after the other, not in a loop: chained iterators take twice the instructions.
        let ([of_swing, of_boom, of_arm, of_bucket], [swing, boom, arm, bucket]) = (feed_forward, errors);
        Ok([
            if swings { self.checked(0, of_swing, swing)? } else { 0.0 },
            self.checked(1, of_boom, boom)?,
            self.checked(2, of_arm, arm)?,
            self.checked(3, of_bucket, bucket)?,
        ])
    }

    /// One actuator's speed, as long as it does not stray.
    #[inline(always)]
    fn checked(&mut self, index: usize, feed: f32, error: f32) -> Result<f32, Fault> {
        let quiet = self.tick <= self.quiet_until;
        let limit = self.following_errors.get(index).copied().unwrap_or(0.0);
        if error.abs() > limit && !quiet {
            return Err(Fault::FollowingError);
        }
        Ok(self.speed(index, self.feed_forward * feed, if quiet { 0.0 } else { error }))
    }

    #[inline(always)]
    fn speed(&mut self, index: usize, feed: f32, error: f32) -> f32 {
        let Some(channel) = self.channels.get_mut(index) else { return 0.0 };
        let lacking = error - (channel.given - channel.given_then);
        if feed == 0.0 {
            let zone = if channel.awake { self.rest_zone } else { LEAVES_REST * self.rest_zone };
            channel.awake = lacking < -zone || lacking > zone;
            if !channel.awake {
                (channel.creep, channel.lacked) = (Creep::REST, 0.0);
                return 0.0;
            }
        } else {
            channel.awake = true;
        }
        channel.lacked += (lacking - channel.lacked) * self.feedback_share;
        let lacking = channel.lacked;
        let correction = within(self.gain_per_s * lacking, self.correction_limit);
        let asked = feed + correction;
        let lag = if feed < 0.0 { -lacking } else { lacking } * channel.per_lag;
        if feed != 0.0 && lag > self.lag {
            self.lag = lag;
        }
        let [extend, retract] = &mut channel.bias;
        let (bias, asked_forward, feed_forward, lacking_forward) =
            if asked >= 0.0 { (extend, asked, feed, lacking) } else { (retract, -asked, -feed, -lacking) };
        // An error of the map shows only where the actuator really moves.
        if feed_forward > self.smallest_speed {
            *bias = within(*bias + self.integral_per_tick * lacking_forward, self.bias_limit);
        }
        // What is lacking less may stop the actuator but not turn it round.
        let forward = asked_forward + *bias;
        let forward = if forward > 0.0 { forward } else { 0.0 };
        let speed = channel.creep.pass(if asked >= 0.0 { forward } else { -forward }, self.smallest_speed);
        channel.given += (if speed == 0.0 { 0.0 - feed } else { correction }) * TICK_S;
        speed
    }
}

//! What trajectory, grade and tip velocity share: from a place ahead to speeds that follow it, within every limit.

use kinematics_core::jacobian::Twist;
use kinematics_core::{Cylinders, Machine, PlaneTip, Pose, Rotor};

use super::Wanted;
use super::delays::Delays;
use super::law::Law;
use super::limits::Limits;
use super::overrun::Overrun;
use crate::fault::Fault;
use crate::io::{Speeds, limited};
use crate::law::LawParameters;

/// Where a mode wants the actuators a preview from now.
pub(super) struct Ahead {
    /// Where it began.
    pub(super) start: Cylinders<f32>,
    pub(super) lengths: Cylinders<f32>,
    /// Speeds of swing (rad/s), boom, arm, bucket.
    pub(super) feed_forward: [f32; 4],
    /// Swing at the start and turned since, turns; `None` where the swing stays as it is.
    pub(super) swing: Option<[f32; 2]>,
}

/// The law and the limits it coordinates within.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coordination {
    pub(super) law: Law,
    pub(super) limits: Limits,
    pub(super) overrun: Overrun,
    share: f32,
    /// What stopping takes, s²/m: half over the acceleration.
    stopping: [f32; 3],
    /// What the actuators were told in the last tick.
    pub(super) speeds: [f32; 4],
}

// Not inlined: taking over asks for it four times.
#[inline(never)]
fn tip_of(machine: &Machine<f32>, lengths: &Cylinders<f32>) -> Result<PlaneTip<f32>, Fault> {
    Ok(machine.cylinders_to_tip(lengths, Rotor::IDENTITY).map_err(|_| Fault::Geometry)?.plane)
}

/// How far a cylinder still goes while it loses this speed, m, by half the acceleration's inverse; the longest time that takes. Inlined:
/// compiled for size, three calls would go through a register, and the image must show where calls lead.
#[inline(always)]
fn stopping(speed: f32, half: f32, longest_s: &mut f32) -> f32 {
    let size = if speed < 0.0 { -speed } else { speed };
    let stopping_s = 2.0 * half * size;
    if stopping_s > *longest_s {
        *longest_s = stopping_s;
    }
    speed * (half * size)
}

/// Of the velocity under way what the new mode asks for as well: with it the mode begins, and no motion both want is interrupted.
#[inline]
pub(super) fn kept(under_way: f32, asked: f32) -> f32 {
    if asked > 0.0 { limited(under_way, 0.0, asked) } else { limited(under_way, asked, 0.0) }
}

/// Half the time over which a velocity of the tip is looked at, s: long enough for f32, short against a turn of the way.
const LOOK_S: f32 = 0.02;

impl Coordination {
    pub(super) fn new(law: Law, limits: Limits, p: &LawParameters) -> Self {
        let [_, boom, arm, bucket] = p.acceleration;
        let stopping = [boom, arm, bucket].map(|acceleration| 0.5 / acceleration);
        Self { law, limits, overrun: Overrun::new(p), share: 1.0 - p.reserve, stopping, speeds: [0.0; 4] }
    }

    /// Speed of the swing's actuator for a rad/s of swing: 1 of a motor, the moment arm of a cylinder.
    #[inline]
    pub(super) fn swing_lever(&self, machine: &Machine<f32>, pose: &Pose<f32>) -> Result<f32, Fault> {
        let Some(cylinder) = machine.swing_cylinder() else { return Ok(1.0) };
        let length = cylinder.length(pose.swing).map_err(|_| Fault::Geometry)?;
        cylinder.moment_arm(length).map_err(|_| Fault::Geometry)
    }

    /// One factor for all speeds (swing rad/s): within full speeds, pump flow, and what stops before the ends of the strokes.
    #[inline]
    pub(super) fn factor(&self, [swing, boom, arm, bucket]: [f32; 4], lever: f32, ahead: &Cylinders<f32>) -> f32 {
        let speeds = [swing * lever, boom, arm, bucket];
        let factor = self.limits.factor(&speeds, self.share);
        let before_ends = self.limits.before_ends(ahead, &speeds);
        let factor = if before_ends < factor { before_ends } else { factor };
        let pace = self.law.pace();
        if pace < factor { pace } else { factor }
    }

    /// The first of the two ticks in which a mode takes over: where the cylinders will be when what is under way has its effect, and the tip's
    /// place and velocity there. Not inlined: it is for changes of mode.
    #[inline(never)]
    pub(super) fn take_over(
        &self,
        machine: &Machine<f32>,
        lengths: &Cylinders<f32>,
        preview_s: f32,
    ) -> Result<(PlaneTip<f32>, Twist<f32>), Fault> {
        let tip_after = |time_s: f32| tip_of(machine, &self.ahead(lengths, time_s));
        let place = tip_after(preview_s)?;
        let (from, to) = (tip_after(preview_s - LOOK_S)?, tip_after(preview_s + LOOK_S)?);
        let per_s = 0.5 / LOOK_S;
        let velocity = Twist {
            reach: (to.reach - from.reach) * per_s,
            height: (to.height - from.height) * per_s,
            pitch: from.pitch.to_vec().cross(to.pitch.to_vec()) * per_s,
        };
        Ok((place, velocity))
    }

    /// Where what the actuators were told last will have brought them after this time.
    #[inline]
    pub(super) fn ahead(&self, lengths: &Cylinders<f32>, time_s: f32) -> Cylinders<f32> {
        let [boom, arm, bucket] = self.meant();
        self.within_strokes(Cylinders {
            boom: lengths.boom + boom * time_s,
            arm: lengths.arm + arm * time_s,
            bucket: lengths.bucket + bucket * time_s,
        })
    }

    /// The speeds of the cylinders that are meant by what they were told last.
    #[inline]
    fn meant(&self) -> [f32; 3] {
        let [_, cylinders @ ..] = self.speeds;
        self.overrun.meant(cylinders)
    }

    /// The end of the first tick: the law is begun from where the cylinders will be when what they lose of their speeds is lost, from `lengths`
    /// on where they go on at `rates`. Tells the tip there; speeds stay as they are for this tick.
    #[inline(never)]
    pub(super) fn begin(
        &mut self,
        machine: &Machine<f32>,
        lengths: &Cylinders<f32>,
        [_, boom, arm, bucket]: [f32; 4],
    ) -> Result<(Cylinders<f32>, PlaneTip<f32>), Fault> {
        let mut longest_s = 0.0;
        let [boom_now, arm_now, bucket_now] = self.meant();
        let [of_boom, of_arm, of_bucket] = self.stopping;
        let start = self.within_strokes(Cylinders {
            boom: lengths.boom + stopping(boom_now - boom, of_boom, &mut longest_s),
            arm: lengths.arm + stopping(arm_now - arm, of_arm, &mut longest_s),
            bucket: lengths.bucket + stopping(bucket_now - bucket, of_bucket, &mut longest_s),
        });
        self.law.begin((longest_s * crate::TICKS_PER_S as f32) as u32);
        Ok((start, tip_of(machine, &start)?))
    }

    /// Between the ends of the strokes.
    #[inline]
    fn within_strokes(&self, lengths: Cylinders<f32>) -> Cylinders<f32> {
        let [[boom_long, boom_short], [arm_long, arm_short], [bucket_long, bucket_short]] = self.limits.ends_m();
        Cylinders {
            boom: limited(lengths.boom, boom_short, boom_long),
            arm: limited(lengths.arm, arm_short, arm_long),
            bucket: limited(lengths.bucket, bucket_short, bucket_long),
        }
    }

    /// For one more tick whatever goes on goes on.
    #[inline]
    pub(super) fn goes_on(&self, lengths: &Cylinders<f32>) -> Wanted {
        Wanted { speeds: Speeds::from_array(self.speeds), ..Wanted::hold(lengths) }
    }

    /// Closes the loop: speeds that bring the actuators to where `ahead` was a preview ago.
    #[inline]
    pub(super) fn close(
        &mut self,
        delays: &mut Delays,
        (ahead, lever): (&Ahead, f32),
        pose: &Pose<f32>,
        lengths: &Cylinders<f32>,
    ) -> Result<Wanted, Fault> {
        let Ahead { start, lengths: then, feed_forward, swing } = ahead;
        let [turning, ..] = feed_forward;
        let [first, turned] = swing.unwrap_or([0.0; 2]);
        let moved = [then.boom - start.boom, then.arm - start.arm, then.bucket - start.bucket];
        let (turned, [boom, arm, bucket]) = self.law.reference(delays, moved, swing.map(|_| turned));
        let reference = Cylinders { boom: start.boom + boom, arm: start.arm + arm, bucket: start.bucket + bucket };
        let off = match swing {
            // The sine stands for the angle.
            Some(_) => pose.swing.to_vec().cross(Rotor::from_turns(first + turned).to_vec()),
            None => 0.0,
        };
        let errors =
            [off, reference.boom - lengths.boom, reference.arm - lengths.arm, reference.bucket - lengths.bucket];
        let [swing, boom, arm, bucket] = self.law.speeds(*feed_forward, errors, ahead.swing.is_some())?;
        let [boom, arm, bucket] = self.overrun.told([boom, arm, bucket]);
        let swing = if ahead.swing.is_some() { self.overrun.told_swing(*turning, swing) } else { 0.0 };
        let speeds = [swing * lever, boom, arm, bucket];
        let factor = self.limits.factor(&speeds, 1.0);
        Ok(Wanted { speeds: Speeds::from_array(speeds.map(|speed| speed * factor)), reference, dig_tick: 0 })
    }
}

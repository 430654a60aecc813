//! What trajectory, grade and tip velocity share: from a place ahead to speeds that follow it, within every limit.

use kinematics_core::{Cylinders, Machine, Pose, Rotor};

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
    /// Speeds of the last tick.
    pub(super) speeds: [f32; 4],
}

/// Where a cylinder of this length and speed will stand when the preview and half its stopping time have passed, between its ends; the
/// longest stopping time. Inlined: compiled for size, three calls would go through a register, and the image must show where calls lead.
#[inline(always)]
fn stands(
    (length, speed): (f32, f32),
    preview_s: f32,
    stopping: f32,
    [longest, shortest]: [f32; 2],
    longest_s: &mut f32,
) -> f32 {
    let size = if speed < 0.0 { -speed } else { speed };
    let stopping_s = 2.0 * stopping * size;
    if stopping_s > *longest_s {
        *longest_s = stopping_s;
    }
    limited(length + speed * (preview_s + stopping * size), shortest, longest)
}

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

    /// Where the cylinders will stand when what is under way and slowing down is done; the law is begun from there.
    #[inline]
    pub(super) fn begin(&mut self, lengths: &Cylinders<f32>, preview_s: f32) -> Cylinders<f32> {
        let [_, boom, arm, bucket] = self.speeds;
        let mut longest_s = 0.0;
        let [of_boom, of_arm, of_bucket] = self.stopping;
        let [boom_ends, arm_ends, bucket_ends] = self.limits.ends_m();
        let start = Cylinders {
            boom: stands((lengths.boom, boom), preview_s, of_boom, boom_ends, &mut longest_s),
            arm: stands((lengths.arm, arm), preview_s, of_arm, arm_ends, &mut longest_s),
            bucket: stands((lengths.bucket, bucket), preview_s, of_bucket, bucket_ends, &mut longest_s),
        };
        self.law.begin((longest_s * crate::TICKS_PER_S as f32) as u32);
        start
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

//! Grade: the operator moves the arm, boom and bucket keep the tip on a plane and the bucket's angle.

use kinematics_core::jacobian::Twist;
use kinematics_core::{Cylinders, Machine, PlaneTip, Pose, Rotor, Vec2};

use super::Wanted;
use super::coordinated::{Ahead, Coordination, kept};
use super::delays::Delays;
use super::resolve::resolve;
use super::sum::Sum;
use crate::TICK_S;
use crate::can::command::Slope;
use crate::fault::Fault;
use crate::grade::GradeParameters;
use crate::io::limited;
use crate::law::LawParameters;

/// Off the plane the tip comes nearer by this share of its way per metre it is off, and by no more than the steepest share.
const APPROACH_PER_M: f32 = 4.0;
const STEEPEST_APPROACH: f32 = 0.2;

/// The tip as it is led along the plane.
#[derive(Clone, Copy, Debug)]
struct Led {
    start: Cylinders<f32>,
    pitch: Rotor<f32>,
    /// Outwards along the plane.
    along: Rotor<f32>,
    /// From the plane's point, along it and off it, m.
    way: Sum,
    off: Sum,
    speed: f32,
    elapsed: u32,
}

/// The follower of the arm's lever.
#[derive(Clone, Copy, Debug)]
pub(super) struct GradeFollower {
    preview_s: f32,
    point: Vec2<f32>,
    slope: Rotor<f32>,
    speed_mps: f32,
    tolerance_m: f32,
    step_mps: f32,
    led: Option<Led>,
}

impl GradeFollower {
    pub(super) fn new(p: &GradeParameters, preview_s: f32, law: &LawParameters) -> Self {
        Self {
            preview_s,
            point: Vec2::new(p.point_x_m as f32, p.point_z_m as f32),
            slope: Rotor::from_turns((p.slope_deg / 360.0) as f32),
            speed_mps: p.speed_mps as f32,
            tolerance_m: p.tolerance_m as f32,
            step_mps: law.tip_acceleration_mps2 * TICK_S,
            led: None,
        }
    }

    pub(super) fn reset(&mut self) {
        self.led = None;
    }

    /// Outwards and level in the boom's plane, as the chassis stands: perpendicular to the world's up in it.
    #[inline]
    fn level(slope: Option<Slope>, swing: Rotor<f32>) -> Rotor<f32> {
        let Some(Slope { roll, pitch }) = slope else { return Rotor::IDENTITY };
        let up = roll.sin * pitch.cos * swing.sin - pitch.sin * swing.cos;
        Vec2::new(roll.cos * pitch.cos, 0.0 - up).direction().unwrap_or(Rotor::IDENTITY)
    }

    /// Where on the plane the tip will be, and how fast along it.
    #[inline(never)]
    fn take_over(
        &self,
        machine: &Machine<f32>,
        shared: &mut Coordination,
        slope: Option<Slope>,
        swing: Rotor<f32>,
        lengths: &Cylinders<f32>,
    ) -> Result<Led, Fault> {
        let (tip, velocity) = shared.take_over(machine, lengths, self.preview_s)?;
        let along = Self::level(slope, swing) * self.slope;
        let speed = along.to_vec().dot(Vec2::new(velocity.reach, velocity.height));
        let led = self.led_at(*lengths, &tip, along, speed);
        let off = led.off.value();
        if off > self.tolerance_m || off < -self.tolerance_m { Err(Fault::NotAtStart) } else { Ok(led) }
    }

    fn led_at(&self, start: Cylinders<f32>, tip: &PlaneTip<f32>, along: Rotor<f32>, speed: f32) -> Led {
        let from = Vec2::new(tip.reach, tip.height) - self.point;
        let [way, off] = [along.to_vec().dot(from), along.to_vec().cross(from)].map(Sum::new);
        Led { start, pitch: tip.pitch, along, way, off, speed, elapsed: 0 }
    }

    /// One tick; `arm_mps` is the speed the lever asks of the arm's cylinder. The chassis' slope counts when grading begins.
    #[inline(always)]
    pub(super) fn follow(
        &mut self,
        machine: &Machine<f32>,
        (shared, delays): (&mut Coordination, &mut Delays),
        (arm_mps, slope): (f32, Option<Slope>),
        pose: &Pose<f32>,
        lengths: &Cylinders<f32>,
    ) -> Result<Wanted, Fault> {
        let mut led = match self.led {
            Some(led) => led,
            None => self.take_over(machine, shared, slope, pose.swing, lengths)?,
        };
        let taken_over = self.led.is_none();
        let (along, off) = (led.along.to_vec(), led.off.value());
        let up = Vec2::new(0.0 - along.z, along.x);
        let place = self.point + along.scale(led.way.value()) + up.scale(off);
        // Nearer to the plane whichever way the tip goes.
        let approach = limited(off * APPROACH_PER_M, -STEEPEST_APPROACH, STEEPEST_APPROACH);
        let approach = if led.speed < 0.0 { approach } else { 0.0 - approach };
        let direction = along + up.scale(approach);
        let tip = PlaneTip { reach: place.x, height: place.z, pitch: led.pitch };
        let a_metre = Twist { reach: direction.x, height: direction.z, pitch: 0.0 };
        let (ahead, [boom, arm, bucket]) = resolve(machine, &tip, &a_metre)?;
        // Where the arm hardly moves the tip along the plane the largest speed is the limit; without a lever there is none.
        let asked = if arm_mps == 0.0 { 0.0 } else { limited(arm_mps / arm, -self.speed_mps, self.speed_mps) };
        let speed = if taken_over {
            kept(led.speed, asked)
        } else {
            limited(asked, led.speed - self.step_mps, led.speed + self.step_mps)
        };
        let rates = [0.0, boom * speed, arm * speed, bucket * speed];
        if taken_over {
            let (start, tip) = shared.begin(machine, &ahead, rates)?;
            self.led = Some(self.led_at(start, &tip, led.along, speed));
            return Ok(shared.goes_on(lengths));
        }
        let factor = shared.factor(rates, 1.0, &ahead);
        led.speed = speed * factor;
        led.way.add(led.speed * TICK_S);
        led.off.add(approach * led.speed * TICK_S);
        led.elapsed = led.elapsed.saturating_add(1);
        self.led = Some(led);
        let feed_forward = rates.map(|rate| rate * factor);
        let ahead = Ahead { start: led.start, lengths: ahead, feed_forward, swing: None };
        let mut wanted = shared.close(delays, (&ahead, 1.0), pose, lengths)?;
        wanted.dig_tick = led.elapsed.saturating_sub(shared.law.preview_ticks());
        Ok(wanted)
    }
}

//! Tip velocity: the operator says how fast the tip goes outward, up, and turns.

use kinematics_core::jacobian::Twist;
use kinematics_core::{Cylinders, Machine, PlaneTip, Pose, Rotor};

use super::Wanted;
use super::coordinated::{Ahead, Coordination, kept};
use super::delays::Delays;
use super::resolve::resolve;
use super::sum::Sum;
use crate::TICK_S;
use crate::can::command::TipVelocity;
use crate::fault::Fault;
use crate::io::limited;
use crate::law::LawParameters;

const ONE_OVER_TURN: f32 = 1.0 / core::f32::consts::TAU;

/// The tip as it is led.
#[derive(Clone, Copy, Debug)]
struct Led {
    start: Cylinders<f32>,
    pitch: Rotor<f32>,
    x: Sum,
    z: Sum,
    /// Turned since the start.
    pitch_turns: Sum,
    velocity: Twist<f32>,
    elapsed: u32,
}

impl Led {
    fn at(start: Cylinders<f32>, tip: &PlaneTip<f32>, velocity: Twist<f32>) -> Self {
        let [x, z, pitch_turns] = [tip.reach, tip.height, 0.0].map(Sum::new);
        Self { start, pitch: tip.pitch, x, z, pitch_turns, velocity, elapsed: 0 }
    }
}

/// The follower of the operator's velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct TipFollower {
    preview_s: f32,
    step_mps: f32,
    step_radps: f32,
    led: Option<Led>,
}

impl TipFollower {
    pub(super) fn new(preview_s: f32, p: &LawParameters) -> Self {
        Self {
            preview_s,
            step_mps: p.tip_acceleration_mps2 * TICK_S,
            step_radps: p.pitch_acceleration_radps2 * TICK_S,
            led: None,
        }
    }

    pub(super) fn reset(&mut self) {
        self.led = None;
    }

    /// The velocity under way, as far as it is wanted too.
    fn take_over(
        &self,
        machine: &Machine<f32>,
        shared: &mut Coordination,
        wanted: &TipVelocity,
        lengths: &Cylinders<f32>,
    ) -> Result<Led, Fault> {
        let (tip, velocity) = shared.take_over(machine, lengths, self.preview_s)?;
        let velocity = Twist {
            reach: kept(velocity.reach, wanted.x_mps),
            height: kept(velocity.height, wanted.z_mps),
            pitch: kept(velocity.pitch, wanted.pitch_radps),
        };
        Ok(Led::at(*lengths, &tip, velocity))
    }

    /// One tick towards the wanted velocity.
    #[inline(always)]
    pub(super) fn follow(
        &mut self,
        machine: &Machine<f32>,
        (shared, delays): (&mut Coordination, &mut Delays),
        wanted: &TipVelocity,
        pose: &Pose<f32>,
        lengths: &Cylinders<f32>,
    ) -> Result<Wanted, Fault> {
        let mut led = match self.led {
            Some(led) => led,
            None => self.take_over(machine, shared, wanted, lengths)?,
        };
        let v = led.velocity;
        let taken_over = self.led.is_none();
        let velocity = if taken_over {
            v
        } else {
            Twist {
                reach: limited(wanted.x_mps, v.reach - self.step_mps, v.reach + self.step_mps),
                height: limited(wanted.z_mps, v.height - self.step_mps, v.height + self.step_mps),
                pitch: limited(wanted.pitch_radps, v.pitch - self.step_radps, v.pitch + self.step_radps),
            }
        };
        let pitch = led.pitch * Rotor::from_turns(led.pitch_turns.value());
        let tip = PlaneTip { reach: led.x.value(), height: led.z.value(), pitch };
        let (ahead, [boom, arm, bucket]) = resolve(machine, &tip, &velocity)?;
        let rates = [0.0, boom, arm, bucket];
        if taken_over {
            let (start, tip) = shared.begin(machine, &ahead, rates)?;
            self.led = Some(Led::at(start, &tip, velocity));
            return Ok(shared.goes_on(lengths));
        }
        let factor = shared.factor(rates, 1.0, &ahead);
        let [reach, height, pitch] = [velocity.reach, velocity.height, velocity.pitch].map(|v| v * factor);
        led.velocity = Twist { reach, height, pitch };
        led.x.add(reach * TICK_S);
        led.z.add(height * TICK_S);
        led.pitch_turns.add(pitch * (TICK_S * ONE_OVER_TURN));
        led.elapsed = led.elapsed.saturating_add(1);
        self.led = Some(led);
        let feed_forward = rates.map(|rate| rate * factor);
        let ahead = Ahead { start: led.start, lengths: ahead, feed_forward, swing: None };
        let mut wanted = shared.close(delays, (&ahead, 1.0), pose, lengths)?;
        wanted.dig_tick = led.elapsed.saturating_sub(shared.law.preview_ticks());
        Ok(wanted)
    }
}

//! A load that pulls where the actuator goes: what leaves it through the outlet edge, and not the inlet, sets its speed.
//!
//! Inlet and outlet edge of a spool open together. While the inlet sets the speed, the outlet's pressure is the same at every opening; it
//! balances one load, the *overrun* ([`LawParameters::overrun_n`]). A load beyond it empties the outlet faster, by the square root of their
//! ratio (orifice flow), and the inlet cavitates. So the speed told to the valve is less by that root.

//!
//! A swing's load is its own inertia while it brakes: known from what is asked of it, without pressures.

use kinematics_core::Real;

use crate::TICK_S;
use crate::diagnosis::Pressures;
use crate::law::LawParameters;

/// Loads are taken as their mean over about this time, so that ringing does not open and close the spool, s.
const MEAN_S: f32 = 0.2;

/// A tick weighs one load: each is weighed every so many.
const LOADS: u32 = 3;

/// Of what is weighed now in the mean.
const SHARE: f32 = LOADS as f32 * TICK_S / MEAN_S;

/// Of the trend of the boom's load nothing counts: it rings on its oil, and a trend is the ringing, larger.
const OF_BOOM: f32 = 0.0;

/// The same of braking, s.
const BRAKING_MEAN_S: f32 = 0.1;

/// A cylinder.
#[derive(Clone, Copy, Debug)]
struct Load {
    areas_m2: [f32; 2],
    overrun_n: [f32; 2],
    /// What it pushes with, N, against a load that shortens it positive: its mean, and the mean of that. `None` while a pressure is
    /// unknown.
    push_n: Option<[f32; 2]>,
    /// Share of the trend that counts.
    trend: f32,
    /// What the valve is told of a speed, extending and retracting: 1 but where the load runs ahead.
    told: [f32; 2],
}

impl Load {
    const UNKNOWN: (Option<[f32; 2]>, [f32; 2]) = (None, [1.0; 2]);

    /// Of a cylinder with these areas and overruns, of which nothing is known yet.
    const fn new(areas_m2: [f32; 2], overrun_n: [f32; 2], trend: f32) -> Self {
        let (push_n, told) = Self::UNKNOWN;
        Self { areas_m2, overrun_n, push_n, trend, told }
    }

    #[inline(always)]
    fn weigh(&mut self, sides: &[Option<f32>; 2]) {
        let [Some(head), Some(rod)] = *sides else {
            (self.push_n, self.told) = Self::UNKNOWN;
            return;
        };
        let [head_m2, rod_m2] = self.areas_m2;
        let push = head * head_m2 - rod * rod_m2;
        let [mean, of_means] = self.push_n.unwrap_or([push; 2]);
        let mean = mean + (push - mean) * SHARE;
        let of_means = of_means + (mean - of_means) * SHARE;
        self.push_n = Some([mean, of_means]);
        // Of a load that changes steadily either mean is as late as the other: what lies between them is what the first has missed.
        let push = mean + (mean - of_means) * self.trend;
        let [extend, retract] = self.overrun_n;
        self.told = if push < -extend {
            [Real::sqrt(extend / -push), 1.0]
        } else if push > retract {
            [1.0, Real::sqrt(retract / push)]
        } else {
            [1.0; 2]
        };
    }
}

/// The swing.
#[derive(Clone, Copy, Debug)]
struct Inertia {
    /// rad/s².
    overrun: f32,
    /// The feed-forward of the last tick, rad/s.
    speed: f32,
    /// What it slows down by, mean, rad/s².
    braking: f32,
}

/// The loads of swing, boom, arm and bucket.
#[derive(Clone, Copy, Debug)]
pub(super) struct Overrun {
    swing: Inertia,
    loads: [Load; LOADS as usize],
    /// The load weighed last.
    turn: u32,
}

impl Overrun {
    pub(super) fn new(p: &LawParameters) -> Self {
        let [boom, arm, bucket] = p.areas_m2;
        let [of_boom, of_arm, of_bucket] = p.overrun_n;
        let loads = [Load::new(boom, of_boom, OF_BOOM), Load::new(arm, of_arm, 1.0), Load::new(bucket, of_bucket, 1.0)];
        let swing = Inertia { overrun: p.swing_overrun_radps2, speed: 0.0, braking: 0.0 };
        Self { swing, loads, turn: 0 }
    }

    /// Another mode begins: loads stay what they are.
    pub(super) fn start_over(&mut self) {
        (self.swing.speed, self.swing.braking) = (0.0, 0.0);
    }

    /// Nothing is known yet.
    pub(super) fn reset(&mut self) {
        self.start_over();
        self.loads.iter_mut().for_each(|load| (load.push_n, load.told) = Load::UNKNOWN);
    }

    /// One tick's pressures, of which those of one cylinder are looked at.
    #[inline(always)]
    pub(super) fn weigh(&mut self, pressures_pa: &Pressures) {
        self.turn = if self.turn + 1 < LOADS { self.turn + 1 } else { 0 };
        let turn = self.turn as usize;
        if let (Some(load), Some(sides)) = (self.loads.get_mut(turn), pressures_pa.get(turn)) {
            load.weigh(sides);
        }
    }

    /// What the swing's valve is told, so that the swing goes at `speed` where `feed_forward` is asked of it, rad/s.
    #[inline(always)]
    pub(super) fn told_swing(&mut self, feed_forward: f32, speed: f32) -> f32 {
        let swing = &mut self.swing;
        let slower = if feed_forward > 0.0 || swing.speed > 0.0 {
            swing.speed - feed_forward
        } else {
            feed_forward - swing.speed
        };
        swing.speed = feed_forward;
        swing.braking += slower / BRAKING_MEAN_S - swing.braking * (TICK_S / BRAKING_MEAN_S);
        // Only what goes the way the swing goes runs ahead.
        if swing.braking > swing.overrun && speed * feed_forward > 0.0 {
            speed * Real::sqrt(swing.overrun / swing.braking)
        } else {
            speed
        }
    }

    /// The speeds that are meant by what the valves are told.
    #[inline]
    pub(super) fn meant(&self, [boom, arm, bucket]: [f32; 3]) -> [f32; 3] {
        let [of_boom, of_arm, of_bucket] = &self.loads;
        let meant = |told: f32, load: &Load| told / if told > 0.0 { load.told[0] } else { load.told[1] };
        [meant(boom, of_boom), meant(arm, of_arm), meant(bucket, of_bucket)]
    }

    /// What the valves are told, so that boom, arm and bucket go at these speeds.
    #[inline(always)]
    pub(super) fn told(&self, [boom, arm, bucket]: [f32; 3]) -> [f32; 3] {
        let [of_boom, of_arm, of_bucket] = &self.loads;
        let told = |speed: f32, load: &Load| speed * if speed > 0.0 { load.told[0] } else { load.told[1] };
        [told(boom, of_boom), told(arm, of_arm), told(bucket, of_bucket)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cylinder that extending runs ahead above 1 kN and retracting above 4 kN, with these sides.
    fn told(head_pa: Option<f32>, rod_pa: Option<f32>, speed: f32) -> f32 {
        let load = Load::new([0.01, 0.005], [1e3, 4e3], 1.0);
        let swing = Inertia { overrun: 0.02, speed: 0.0, braking: 0.0 };
        let mut overrun = Overrun { swing, loads: [load; 3], turn: 0 };
        (0..LOADS).for_each(|_| overrun.weigh(&[[head_pa, rod_pa]; 3]));
        let [first, second, third] = overrun.told([speed; 3]);
        assert_eq!([first, second], [third; 2]);
        first
    }

    #[test]
    fn a_load_four_times_the_overrun_halves_what_the_valve_is_told() {
        assert_eq!(told(Some(1.6e6), Some(0.0), -0.2), -0.1);
        assert_eq!(told(Some(0.0), Some(0.8e6), 0.2), 0.1);
    }

    #[test]
    fn a_smaller_load_one_against_the_motion_and_an_unknown_one_change_nothing() {
        for (head, rod, speed) in [
            (Some(0.39e6), Some(0.0), -0.2),
            (Some(1.6e6), Some(0.0), 0.2),
            (Some(0.0), Some(0.8e6), -0.2),
            (Some(1.6e6), None, -0.2),
            (Some(1.6e6), Some(0.0), 0.0),
        ] {
            assert_eq!(told(head, rod, speed), speed);
        }
    }

    #[test]
    fn of_a_load_that_changes_steadily_its_value_of_now_counts() {
        let mut load = Load::new([0.01, 0.005], [1e3, 4e3], 1.0);
        let mut head_pa = 0.8e6;
        for _ in 0..1000 {
            head_pa += 1e3;
            load.weigh(&[Some(head_pa), Some(0.0)]);
        }
        let [extending, retracting] = load.told;
        assert_eq!(extending, 1.0);
        assert!((4e3 / (retracting * retracting) - head_pa * 0.01).abs() < 20.0, "{retracting}");
    }

    #[test]
    fn a_swing_runs_ahead_while_it_brakes_and_only_then() {
        let swing = Inertia { overrun: 0.02, speed: 0.0, braking: 0.0 };
        let load = Load::new([0.01, 0.005], [1e3; 2], 1.0);
        let mut overrun = Overrun { swing, loads: [load; 3], turn: 0 };
        for sign in [1.0, -1.0] {
            overrun.reset();
            let mut speed = 0.0;
            for _ in 0..1000 {
                speed += 0.0005;
                assert_eq!(overrun.told_swing(sign * speed, sign * speed), sign * speed);
            }
            let mut told = 0.0;
            for _ in 0..800 {
                speed -= 0.0005;
                told = overrun.told_swing(sign * speed, sign * speed);
            }
            // Braking by 0.5 rad/s², twenty-five times the overrun.
            assert!((told / (sign * speed) - 0.2).abs() < 1e-3, "{told}");
            assert_eq!(overrun.told_swing(sign * speed, -sign * 0.1), -sign * 0.1);
        }
    }
}

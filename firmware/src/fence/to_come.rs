//! How far an actuator will still move when its command goes to zero now: what is under way within the dead time, and the way
//! its spool needs to close.
//!
//! The valve's model runs here without its dead time: it is where the actuator will be a dead time later. What it moved within
//! the last dead time the machine has not done yet. A travel stop takes moves away for good, so they are cut as they are counted.
//! Two ticks are counted at once.

use crate::io::limited;
use crate::parameters::ValveDirection;
use crate::{TICK_S, TICKS_PER_S};

/// What is counted at once.
const PERIOD_S: f32 = 2.0 * TICK_S;
const PERIODS_PER_S: f32 = TICKS_PER_S as f32 / 2.0;

/// The longest dead time, periods.
const LONGEST: usize = 256;

/// Moves are counted in 2⁻²¹ of a metre or radian, so that what is added and later taken off again is exact; 16 bits hold the move
/// of one period up to 7.8 m/s.
const UNITS: f32 = 2_097_152.0;

/// One direction of a valve.
#[derive(Clone, Copy, Debug)]
struct Opening {
    dead_band: f32,
    /// Beyond the dead band, by speed; and the other way round.
    per_speed: f32,
    speed_per: f32,
}

impl Opening {
    fn new(valve: &ValveDirection) -> Self {
        let left = 1.0 - valve.dead_band;
        Self { dead_band: valve.dead_band, per_speed: left / valve.full_speed, speed_per: valve.full_speed / left }
    }
}

/// One actuator.
#[derive(Clone, Copy, Debug)]
pub(super) struct ToCome {
    valve: [Opening; 2],
    lag_s: f32,
    /// The spool's share of the way to its command, a period.
    spool_step: f32,
    spool: f32,
    /// At the spool's opening, a dead time ahead; and what is still to come when it closes.
    speed: f32,
    closing: f32,
    /// Moves of the last dead time, oldest at `next`.
    moves: [i16; LONGEST],
    delay: usize,
    next: usize,
    under_way: i32,
}

impl ToCome {
    pub(super) fn new(valve: &[ValveDirection; 2], dead_time_s: f32, lag_s: f32) -> Self {
        let delay = (dead_time_s * PERIODS_PER_S + 0.5) as usize;
        Self {
            valve: valve.each_ref().map(Opening::new),
            lag_s,
            // 1 − exp(−x) to its third order.
            spool_step: limited(PERIOD_S / (lag_s + 0.5 * PERIOD_S), 0.0, 1.0),
            spool: 0.0,
            speed: 0.0,
            closing: 0.0,
            moves: [0; LONGEST],
            delay: core::cmp::min(delay, LONGEST),
            next: 0,
            under_way: 0,
        }
    }

    /// Two ticks at these speeds, of an actuator measured at `position` between these ends of its travel, m or rad.
    #[inline]
    pub(super) fn command(&mut self, [first, second]: [f32; 2], position: f32, [low, high]: [f32; 2]) {
        let target =
            if first == second { self.opening(first) } else { 0.5 * (self.opening(first) + self.opening(second)) };
        self.spool += (target - self.spool) * self.spool_step;
        let before = self.speed;
        (self.speed, self.closing) = self.at_spool();
        let ahead = position + self.under_way as f32 * (1.0 / UNITS);
        // Up to the stop it goes towards, and never back from there.
        let way = (before + self.speed) * (0.5 * PERIOD_S);
        let way = if way > 0.0 { limited(high - ahead, 0.0, way) } else { limited(low - ahead, way, 0.0) };
        // The cast saturates.
        let moved = (way * UNITS) as i16;
        self.under_way += i32::from(moved);
        if let Some(slot) = self.moves.get_mut(self.next).filter(|_| self.delay > 0) {
            self.under_way -= i32::from(*slot);
            *slot = moved;
            self.next += 1;
        } else {
            self.under_way = 0;
        }
        if self.next >= self.delay {
            self.next = 0;
        }
    }

    /// The spool's opening for a speed, retracting negative.
    #[inline(always)]
    fn opening(&self, speed: f32) -> f32 {
        let [extend, retract] = &self.valve;
        let of = |valve: &Opening, speed: f32| {
            let opening = valve.dead_band + speed * valve.per_speed;
            if opening < 1.0 { opening } else { 1.0 }
        };
        if speed > 0.0 {
            of(extend, speed)
        } else if speed < 0.0 {
            -of(retract, -speed)
        } else {
            0.0
        }
    }

    /// The speed at the spool's opening, and the way until it has closed. From s to its dead band d it closes as s·exp(−t/τ),
    /// which moves the actuator by `v·τ·(1 − d/(s − d)·ln(s/d))`; `ln x ≥ 3(x² − 1)/(x² + 4x + 1)` (its Padé approximant) bounds it
    /// by `v·τ·(s − d)(s + 2d)/(s² + 4sd + d²)`.
    #[inline]
    fn at_spool(&self) -> (f32, f32) {
        let [extend, retract] = &self.valve;
        let (valve, opening) = if self.spool > 0.0 { (extend, self.spool) } else { (retract, -self.spool) };
        let (d, s) = (valve.dead_band, opening);
        let beyond = s - d;
        if beyond > 0.0 {
            let speed = beyond * if self.spool > 0.0 { valve.speed_per } else { -valve.speed_per };
            (speed, speed * self.lag_s * beyond * (s + d + d) / (s * (s + 4.0 * d) + d * d))
        } else {
            (0.0, 0.0)
        }
    }

    /// The speed at the spool's opening, a dead time ahead.
    #[inline]
    pub(super) fn speed(&self) -> f32 {
        self.speed
    }

    /// What is still to come, m or rad.
    #[inline]
    pub(super) fn travel(&self) -> f32 {
        self.under_way as f32 * (1.0 / UNITS) + self.closing
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VALVE: [ValveDirection; 2] =
        [ValveDirection { dead_band: 0.15, full_speed: 0.4 }, ValveDirection { dead_band: 0.2, full_speed: 0.3 }];

    /// The same valve with its dead time, followed step by step until it rests.
    #[inline]
    fn really_to_come(commands: &[f32], delay: usize) -> f32 {
        let mut real = ToCome::new(&VALVE, 0.0, 0.05);
        let travel = [-10.0, 10.0];
        let mut moved = [0.0_f32; 2];
        for tick in (0..commands.len() + 2000).step_by(2) {
            let at = |tick: usize| tick.checked_sub(delay).and_then(|at| commands.get(at)).copied().unwrap_or(0.0);
            let before = real.speed();
            real.command([at(tick), at(tick + 1)], 0.0, travel);
            // What is moved after the last command is decided.
            moved[usize::from(tick >= commands.len())] += (before + real.speed()) * TICK_S;
        }
        moved[1]
    }

    #[test]
    fn what_is_to_come_is_what_the_valve_still_does_after_its_command_went_to_zero() {
        let programs: [&dyn Fn(usize) -> f32; 4] = [
            &|_| 0.4,
            &|tick| if tick < 60 { -0.3 } else { 0.0 },
            &|tick| if tick % 120 < 50 { 0.4 } else { -0.2 },
            &|tick| 0.3 - 0.001 * tick as f32,
        ];
        for program in programs {
            for length in [2, 30, 100, 140, 400] {
                let mut commands = [0.0; 400];
                let commands = &mut commands[..length];
                let mut to_come = ToCome::new(&VALVE, 0.1, 0.05);
                for (period, pair) in commands.chunks_exact_mut(2).enumerate() {
                    let both = [program(2 * period), program(2 * period + 1)];
                    pair.copy_from_slice(&both);
                    to_come.command(both, 0.0, [-10.0, 10.0]);
                }
                let (told, real) = (to_come.travel(), really_to_come(commands, 100));
                // The bound of the logarithm errs to the far side: by 0.09·d/(1 − d)·v·τ = 0.3 mm at full speed
                // here; a period's sum and its integral differ by half a tick's move, 0.2 mm.
                assert!((told - real).abs() < 6e-4, "{told} {real} after {length}");
            }
        }
    }

    #[test]
    fn what_a_travel_stop_takes_away_does_not_come_back() {
        let mut to_come = ToCome::new(&VALVE, 0.1, 0.05);
        for _ in 0..250 {
            to_come.command([0.4; 2], 2.0, [1.0, 2.0]);
        }
        assert_eq!(to_come.under_way, 0);
        for _ in 0..40 {
            to_come.command([-0.3; 2], 2.0, [1.0, 2.0]);
        }
        // All of the way back is to come, nothing of what pressed against the stop.
        assert!(to_come.travel() < -0.005, "{}", to_come.travel());
    }

    #[test]
    fn nothing_is_left_to_come_after_a_dead_time_at_rest() {
        let mut to_come = ToCome::new(&VALVE, 0.1, 0.05);
        for _ in 0..500_000 {
            to_come.command([0.31; 2], 0.0, [-10.0, 10.0]);
        }
        assert!((to_come.travel() - (0.031 + 0.31 * 0.05 * 0.65)).abs() < 2e-3);
        for _ in 0..300 {
            to_come.command([0.0; 2], 0.0, [-10.0, 10.0]);
        }
        assert_eq!(to_come.under_way, 0);
        assert_eq!(to_come.travel(), 0.0);
    }
}

//! From two solenoid currents to a spool's place: dead time, hysteresis, a critically damped lag.
//!
//! The hysteresis is a play between current and spool, so a dither wider than the play takes it away, as on a real valve.

use libm::exp;

/// What a spool is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpoolModel {
    /// Current at full stroke, A.
    pub full_scale_a: f64,
    /// From the current to the spool's first move, s.
    pub dead_time_s: f64,
    /// Natural frequency, Hz.
    pub natural_hz: f64,
    /// Width of the play, share of full stroke.
    pub hysteresis: f64,
}

/// A spool in motion; its place is −1…1, extending positive.
#[derive(Clone, Debug)]
pub(super) struct Spool {
    full_scale_a: f64,
    half_play: f64,
    /// ω·h and e^(−ωh) of a sub-step.
    turn: f64,
    decay: f64,
    /// Commands under way, the next to arrive at `head`.
    under_way: Vec<f64>,
    head: usize,
    command: f64,
    place: f64,
    /// Its rate over ω.
    rate: f64,
}

impl Spool {
    /// In neutral; commands come every `tick_s`, sub-steps are `step_s`.
    pub(super) fn new(model: &SpoolModel, tick_s: f64, step_s: f64) -> Self {
        let turn = core::f64::consts::TAU * model.natural_hz * step_s;
        Self {
            full_scale_a: model.full_scale_a,
            half_play: 0.5 * model.hysteresis,
            turn,
            decay: exp(-turn),
            under_way: vec![0.0; (model.dead_time_s / tick_s + 0.5) as usize],
            head: 0,
            command: 0.0,
            place: 0.0,
            rate: 0.0,
        }
    }

    /// The currents of a tick, extend and retract, A.
    pub(super) fn command(&mut self, [extend_a, retract_a]: [f64; 2]) {
        let asked = ((extend_a - retract_a) / self.full_scale_a).clamp(-1.0, 1.0);
        let arrived = match self.under_way.get_mut(self.head) {
            Some(slot) => std::mem::replace(slot, asked),
            None => asked,
        };
        self.head = if self.head + 1 < self.under_way.len() { self.head + 1 } else { 0 };
        self.command = self.command.clamp(arrived - self.half_play, arrived + self.half_play);
    }

    /// One sub-step, solved exactly; returns the mean of the places before and after.
    pub(super) fn advance(&mut self) -> f64 {
        let before = self.place;
        let off = self.place - self.command;
        let slope = (self.rate + off) * self.turn;
        self.place = self.command + (off + slope) * self.decay;
        self.rate = (self.rate - slope) * self.decay;
        0.5 * (before + self.place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: SpoolModel = SpoolModel { full_scale_a: 1.2, dead_time_s: 0.05, natural_hz: 10.0, hysteresis: 0.0 };

    fn run(spool: &mut Spool, amperes: f64, ticks: u32) -> f64 {
        let mut place = spool.place;
        for _ in 0..ticks {
            spool.command([amperes, 0.0]);
            (0..4).for_each(|_| place = 2.0 * spool.advance() - place);
        }
        place
    }

    #[test]
    fn it_waits_out_the_dead_time_and_then_follows_without_overshoot() {
        let mut spool = Spool::new(&MODEL, 0.001, 0.000_25);
        assert_eq!(run(&mut spool, 0.6, 50), 0.0);
        // 1 − (1 + ωt)e^(−ωt) of the half stroke after 20 ms.
        let wt = core::f64::consts::TAU * 10.0 * 0.02;
        let expected = 0.5 * (1.0 - (1.0 + wt) * exp(-wt));
        assert!((run(&mut spool, 0.6, 20) - expected).abs() < 1e-12);
        assert!((run(&mut spool, 0.6, 300) - 0.5).abs() < 1e-6);
    }

    #[test]
    fn half_the_sub_step_gives_the_same_place() {
        let (mut coarse, mut fine) = (Spool::new(&MODEL, 0.001, 0.001), Spool::new(&MODEL, 0.001, 0.0005));
        for _ in 0..80 {
            coarse.command([1.0, 0.0]);
            fine.command([1.0, 0.0]);
            coarse.advance();
            fine.advance();
            fine.advance();
            assert!((coarse.place - fine.place).abs() < 1e-13);
        }
    }

    #[test]
    fn play_keeps_the_spool_behind_unless_dither_shakes_it() {
        let model = SpoolModel { hysteresis: 0.06, dead_time_s: 0.0, ..MODEL };
        let mut spool = Spool::new(&model, 0.001, 0.001);
        let mut settle = |of: &dyn Fn(u32) -> f64| {
            let mut mean = 0.0;
            for tick in 0..1000 {
                spool.command([of(tick), 0.0]);
                let place = spool.advance();
                mean += if tick >= 500 { place / 500.0 } else { 0.0 };
            }
            mean
        };
        let up = settle(&|_| 0.6);
        let peak = settle(&|_| 1.2);
        let down = settle(&|_| 0.6);
        assert!((down - up - 0.06).abs() < 1e-9 && peak < 0.98, "{up} {down}");
        let square = |tick: u32| if tick % 20 < 10 { 0.06 } else { -0.06 };
        let shaken = settle(&|tick| 0.6 + square(tick));
        assert!((shaken - 0.5).abs() < 0.002, "{shaken}");
    }
}

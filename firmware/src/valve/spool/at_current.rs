//! A spool driven by a current instead of a speed, for calibration and jogging: the same interlock, loop, dither and watches, but no
//! flow map and no ramp.

use super::{CurrentLoop, Now, Outputs, Shared, Side, Spool};
use crate::io::Solenoids;
use crate::supervisor::Gate;
use crate::valve::coil_fault::CoilFault;
use crate::valve::coil_watch::CoilWatch;

impl Spool {
    /// One tick, as [`Spool::tick`]; `current_a` is signed, extending positive, 0 or NaN for off.
    pub(in crate::valve) fn tick_at_current(
        &mut self,
        shared: &Shared,
        now: &Now,
        current_a: f32,
        codes: Solenoids<u16>,
        outputs: Outputs<'_>,
    ) -> Option<(Side, CoilFault)> {
        let fault = self.judge(shared, codes);
        let (asked, wanted_a) = if current_a < 0.0 { (Side::Retract, -current_a) } else { (Side::Extend, current_a) };
        let on = now.gate == Gate::Open && wanted_a > 0.0;
        if self.interlock.holder().is_some_and(|holder| holder != asked || !on) {
            self.close();
        }
        if on && self.interlock.holder().is_none() {
            let measured_a = codes.map(|code| shared.measured_a(code));
            self.interlock.request(asked, measured_a);
            if self.interlock.holder().is_none() {
                // The other solenoid's current dies away first.
                return fault;
            }
            self.current = CurrentLoop::start(asked.split(measured_a).0);
            self.dither.reset();
            (self.other_calm, self.asleep) = (false, false);
            let [extend, retract] = &mut self.watches;
            asked.split([extend, retract]).0.wake();
        }
        if self.interlock.holder().is_some() {
            let own_a = shared.measured_a(asked.split(codes).0);
            self.give(shared, now, asked, wanted_a, own_a, outputs);
        }
        fault
    }

    /// Both solenoids' faults.
    fn judge(&mut self, shared: &Shared, codes: Solenoids<u16>) -> Option<(Side, CoilFault)> {
        let Some(side) = self.interlock.holder() else { return self.judge_off(shared, codes) };
        let own_a = shared.measured_a(side.split(codes).0);
        let [extend, retract] = &mut self.watches;
        let own: &mut CoilWatch = side.split([extend, retract]).0;
        let fault = own.judge(&shared.limits, &self.given, own_a);
        self.judge_other(shared, codes, side, fault)
    }
}

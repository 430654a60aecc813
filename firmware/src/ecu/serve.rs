//! A tick in service: sensing, pose and supervisor as ever; instead of motion and fence the service's current of one solenoid.

use core::borrow::BorrowMut;

use super::Ecu;
use crate::fault::{Fault, State};
use crate::fence::{Fenced, NO_CLEARANCE};
use crate::fitted::Fitted;
use crate::io::{Inputs, Outputs, Speeds};
use crate::motion::Wanted;
use crate::pose::find_pose;
use crate::service::Answer;
use crate::service::stage::Situation;
use crate::supervisor::Watched;

impl<F: BorrowMut<Fitted>> Ecu<F> {
    /// What the service stage has to say.
    pub fn answer(&self) -> &Answer {
        self.service.answer()
    }

    /// Hears the service tool; the tick's outputs when it is the service's. Not inlined: nothing of it is for a machine at work.
    #[inline(never)]
    pub(super) fn serve(&mut self, inputs: &Inputs) -> Option<Outputs> {
        let joints = self.pose.joints;
        let parts = self.fitted.as_mut().and_then(|fitted| fitted.borrow_mut().parts());
        let wrist = parts.map(|(machine, ..)| machine.chain().wrist(&joints));
        let now = Situation { state: self.supervisor.state(), wrist, joints };
        if self.service.hear(inputs, &now) { Some(self.service_tick(inputs)) } else { None }
    }

    fn service_tick(&mut self, inputs: &Inputs) -> Outputs {
        let mut seen = *inputs;
        let drives = self.service.before(&mut seen);
        let supply_v = self.sensing.supply_v(&seen);
        let sensor_supply_v = self.sensing.sensor_supply_v(&seen);
        let jumped = self.diagnosis.in_service(&inputs.codes);
        let sensed = self.sense(&seen);
        // While an errand is away ticks may be missed, and what drifted meanwhile has not jumped.
        let stage_fault = jumped.filter(|_| !self.service.is_away()).or(sensed.err());
        // A calibration may stand still for long; a jog ends by itself.
        let watched = Watched { supply_v, sensor_supply_v, coil: self.coil_fault, stage_fault, moving: true };
        let (state, known) = (self.supervisor.state(), self.supervisor.fault());
        let gate = self.supervisor.judge(&seen, &watched);
        if let (None, Some(fault)) = (known, self.supervisor.fault()) {
            self.freeze_frame = Some(self.freeze(inputs, &watched, state, fault));
        }
        self.service.after(gate, self.supervisor.state());

        let driven = self.valve.drive_at_current(gate, drives.unwrap_or((0, 0.0)), supply_v, &seen.coil_codes);
        self.coil_fault = driven.fault;
        let fenced = Fenced { speeds: Speeds::ZERO, clearance_m: NO_CLEARANCE };
        // Beyond a known end the length is not measured, and so the pose is none; nor is it while the maps are lent.
        let unknown = (sensed == Ok(false) || seen.codes != inputs.codes).then_some(Fault::Geometry);
        self.outputs((gate, seen.overrun), stage_fault.or(unknown), &Wanted::hold(&self.lengths), &fenced, &driven)
    }

    /// Sensing and, unless the maps are lent, pose; motion and fence start over when service ends.
    fn sense(&mut self, inputs: &Inputs) -> Result<bool, Fault> {
        self.motion.reset();
        let sensed = self.sensing.read(inputs).map_err(Fault::Sensor)?;
        let Some(fitted) = self.fitted.as_mut().map(F::borrow_mut) else { return Ok(false) };
        fitted.reset();
        let (machine, ..) = fitted.parts().ok_or(Fault::NotConfigured)?;
        find_pose(machine, &sensed, &mut self.pose)?;
        self.lengths = sensed.lengths;
        Ok(true)
    }

    /// The supervisor's state.
    pub fn state(&self) -> State {
        self.supervisor.state()
    }
}

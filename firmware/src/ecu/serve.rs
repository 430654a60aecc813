//! A tick in service: sensing, pose and supervisor as ever; instead of motion and fence the service's current of one solenoid.

use core::borrow::BorrowMut;

use super::Ecu;
use crate::fault::{Fault, State};
use crate::fence::{Fenced, NO_CLEARANCE};
use crate::io::{Inputs, Outputs, Speeds};
use crate::motion::{Followers, Wanted};
use crate::pose::pose;
use crate::service::stage::{Run, Situation};
use crate::service::{Answer, Found, Service};
use crate::supervisor::Watched;

impl<F: BorrowMut<Followers>> Ecu<F> {
    /// What the service stage has to say.
    pub fn answer(&self) -> &Answer {
        self.service.answer()
    }

    /// What the service tool wants kept, until [`Self::kept`].
    pub fn to_keep(&self) -> Option<&Found> {
        self.service.to_keep()
    }

    /// What was to be kept is in the store, or is not.
    pub fn kept(&mut self, stored: bool) {
        self.service.kept(stored);
    }

    pub(super) fn service(&mut self) -> &mut Service {
        &mut self.service
    }

    /// Hears the service tool; the tick's outputs when it is the service's. Not inlined: nothing of it is for a machine at work.
    #[inline(never)]
    pub(super) fn serve(&mut self, inputs: &Inputs) -> Option<Outputs> {
        let has_bucket = inputs.service.is_some_and(|request| self.has_bucket(request.number));
        let joints = self.pose.joints;
        let wrist = self.machine.chain().wrist(&joints);
        let now = Situation { state: self.supervisor.state(), wrist, joints, has_bucket };
        if self.service.hear(inputs, &now) { Some(self.service_tick(inputs)) } else { None }
    }

    fn service_tick(&mut self, inputs: &Inputs) -> Outputs {
        let mut seen = *inputs;
        let drives = self.service.before(&mut seen);
        if self.service.run() == Run::Mounting {
            self.mount_on();
        }
        let supply_v = self.sensing.supply_v(&seen);
        let sensor_supply_v = self.sensing.sensor_supply_v(&seen);
        let jumped = self.diagnosis.in_service(&inputs.codes);
        let stage_fault = jumped.or(self.sense(&seen).err());
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
        // Beyond a known end the length is not measured, and so the pose is none.
        let beyond = (seen.codes != inputs.codes).then_some(Fault::Geometry);
        self.outputs((gate, seen.overrun), stage_fault.or(beyond), &Wanted::hold(&self.lengths), &fenced, &driven)
    }

    /// Sensing and pose; motion and fence start over when service ends.
    fn sense(&mut self, inputs: &Inputs) -> Result<(), Fault> {
        self.motion.reset();
        if let Some(fence) = &mut self.fence {
            fence.reset();
        }
        let sensed = self.sensing.read(inputs).map_err(Fault::Sensor)?;
        let pose = pose(&self.machine, &sensed).map_err(|_| Fault::Geometry)?;
        (self.lengths, self.pose) = (sensed.lengths, pose);
        Ok(())
    }

    /// The supervisor's state.
    pub fn state(&self) -> State {
        self.supervisor.state()
    }
}

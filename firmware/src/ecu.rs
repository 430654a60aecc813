//! The whole application: one tick from inputs to outputs. `serve` is a tick in service, `errand` what is done beside the ticks.

mod errand;
mod serve;

use core::borrow::BorrowMut;

use kinematics_core::{Cylinders, Pose};

use crate::command::Intent;
use crate::constants::{Constant, Constants};
use crate::diagnosis::Diagnosis;
use crate::fault::{Fault, State};
use crate::fence::{Fenced, NO_CLEARANCE};
use crate::fitted::Fitted;
use crate::freeze_frame::FreezeFrame;
use crate::io::{Inputs, NO_LENGTHS, NO_POSE, Outputs, Speeds};
use crate::motion::{Motion, Wanted};
use crate::near::near;
use crate::parameters::{ParameterError, Parameters};
use crate::pose::find_pose;
use crate::sensing::Sensing;
use crate::service::Service;
use crate::supervisor::{Gate, SelfTest, Supervisor, Watched};
use crate::valve::coil_fault::FaultyCoil;
use crate::valve::coil_stage::{CoilStage, CoilsDriven};

/// The controller: stages, the supervisor, and the last valid pose. `F` holds what is fitted to the bucket, by value or, as in an image,
/// by reference.
#[derive(Clone, Debug)]
pub struct Ecu<F = Fitted> {
    /// `None` while it is lent to have another bucket fitted.
    fitted: Option<F>,
    sensing: Sensing,
    diagnosis: Diagnosis,
    motion: Motion,
    supervisor: Supervisor,
    valve: CoilStage,
    /// What the coils' currents showed in the last tick.
    coil_fault: Option<FaultyCoil>,
    tick: u32,
    freeze_frame: Option<FreezeFrame>,
    lengths: Cylinders<f32>,
    pose: Pose<f32>,
    service: Service,
}

impl Ecu {
    /// [`Ecu::with`] a memory of its own.
    ///
    /// # Errors
    /// As there.
    pub fn new(parameters: &Parameters) -> Result<Self, ParameterError> {
        Self::with(parameters, Fitted::new())
    }
}

impl<F: BorrowMut<Fitted>> Ecu<F> {
    /// Validates the parameters, the dig's travel included, plans the move, and builds every stage.
    ///
    /// # Errors
    /// The first parameter at fault, by name and range, the dig's first violation, or why the move has no plan.
    pub fn with(parameters: &Parameters, mut fitted: F) -> Result<Self, ParameterError> {
        let p = parameters;
        p.validate()?;
        fitted.borrow_mut().fit(p)?;
        let supplies = [&p.supply, &p.sensor_supply];
        let parts = fitted.borrow_mut().parts();
        let sensing = parts
            .and_then(|(machine, ..)| Sensing::new(&p.swing_sensor, &p.cylinder_sensors, supplies, machine))
            .ok_or(ParameterError::NoSwingCylinder)?;
        Ok(Self {
            diagnosis: Diagnosis::new(&p.diagnosis, sensing.views()),
            sensing,
            motion: Motion::new(p),
            fitted: Some(fitted),
            supervisor: Supervisor::new(&p.supply, &p.sensor_supply),
            valve: CoilStage::new(&p.coils)?,
            coil_fault: None,
            tick: 0,
            freeze_frame: None,
            lengths: NO_LENGTHS,
            pose: NO_POSE,
            service: Service::new(p),
        })
    }

    /// Takes the board's start-up report; before every step of it has passed nothing is enabled.
    pub fn self_tested(&mut self, report: &SelfTest) {
        self.supervisor.self_tested(report);
    }

    /// Where everything lies that is not written any more; `None` while a bucket is being mounted, which derives some of it anew.
    // Not inlined: it is for the start.
    #[inline(never)]
    pub fn constants(&mut self) -> Option<Constants> {
        if self.is_rebuilt() {
            return None;
        }
        let (machine, fence, _) = self.fitted.as_mut()?.borrow_mut().parts()?;
        let fence = fence.map_or([Constant::NOWHERE; 2], |fence| fence.constants());
        let parts = [Constant::of(machine), Constant::of(&self.sensing), self.motion.constant()];
        let parts = parts.into_iter().chain(self.supervisor.constants()).chain(self.diagnosis.constants());
        let mut parts = parts.chain(self.valve.constants()).chain(fence);
        Some([(); _].map(|()| parts.next().unwrap_or(Constant::NOWHERE)))
    }

    /// An errand is about to begin, under way or just over: it may fit another bucket.
    #[inline(always)]
    pub fn is_rebuilt(&self) -> bool {
        self.service.runs_errand()
    }

    /// What was known at the first latched fault.
    pub fn freeze_frame(&self) -> Option<&FreezeFrame> {
        self.freeze_frame.as_ref()
    }

    /// One control period: everything from the sensors' codes to the coils' duties.
    pub fn tick(&mut self, inputs: &Inputs) -> Outputs {
        if self.service.attends(inputs)
            && let Some(outputs) = self.serve(inputs)
        {
            return outputs;
        }
        let supply_v = self.sensing.supply_v(inputs);
        let sensor_supply_v = self.sensing.sensor_supply_v(inputs);
        near(&mut self.diagnosis).judge(&inputs.codes, &inputs.pressures_pa);

        let wanted = self.sense_and_follow(inputs);
        let stage_fault = wanted.as_ref().err().copied();
        let (coil, supplies) = (self.coil_fault, (supply_v, sensor_supply_v));
        let gate = if near(&mut self.supervisor).goes_on(inputs, supplies, coil.is_some() || stage_fault.is_some()) {
            Gate::Open
        } else {
            self.decide(inputs, supplies, stage_fault)
        };

        // Whatever motion wanted, behind a closed gate nothing is wanted.
        let nothing;
        let (wanted, fenced) = match (gate, &wanted) {
            (Gate::Open, Ok(wanted)) => wanted,
            _ => {
                nothing = (Wanted::hold(&self.lengths), Fenced { speeds: Speeds::ZERO, clearance_m: NO_CLEARANCE });
                &nothing
            }
        };
        if let Some((_, Some(fence), _)) = self.fitted.as_mut().and_then(|fitted| fitted.borrow_mut().parts()) {
            near(fence).sent(&fenced.speeds);
        }
        self.diagnosis.sent(&fenced.speeds);
        let driven = self.valve.drive(gate, &fenced.speeds, supply_v, &inputs.coil_codes);
        self.coil_fault = driven.fault;
        self.outputs((gate, inputs.overrun), stage_fault, wanted, fenced, &driven)
    }

    /// What the supervisor says of a tick that is not simply another one at work; what was known at the first fault is kept. Not inlined:
    /// what costs most is a machine at work.
    #[inline(never)]
    fn decide(&mut self, inputs: &Inputs, (supply_v, sensor_supply_v): (f32, f32), stage_fault: Option<Fault>) -> Gate {
        let (coil, moving) = (self.coil_fault, self.diagnosis.moving());
        let watched = Watched { supply_v, sensor_supply_v, coil, stage_fault, moving };
        let (state, known) = (self.supervisor.state(), self.supervisor.fault());
        let gate = self.supervisor.judge(inputs, &watched);
        if let (None, Some(fault)) = (known, self.supervisor.fault()) {
            self.freeze_frame = Some(self.freeze(inputs, &watched, state, fault));
        }
        gate
    }

    #[inline(always)]
    fn outputs(
        &mut self,
        (gate, late): (Gate, bool),
        stage_fault: Option<Fault>,
        wanted: &Wanted,
        fenced: &Fenced,
        driven: &CoilsDriven,
    ) -> Outputs {
        let outputs = Outputs {
            tick: self.tick,
            state: self.supervisor.state(),
            fault: self.supervisor.fault(),
            late,
            cut_off_closed: gate == Gate::Open,
            pose_valid: !stage_fault.is_some_and(Fault::hides_pose),
            lengths: self.lengths,
            pose: self.pose,
            dig_tick: wanted.dig_tick,
            reference: wanted.reference,
            asked: wanted.speeds,
            clearance_m: fenced.clearance_m,
            speeds: fenced.speeds,
            currents: driven.coils.currents,
            duties: driven.coils.duties,
        };
        self.tick = self.tick.wrapping_add(1);
        outputs
    }

    // Not inlined: it is for faults.
    #[inline(never)]
    fn freeze(&self, inputs: &Inputs, watched: &Watched, state: State, fault: Fault) -> FreezeFrame {
        FreezeFrame {
            tick: self.tick,
            fault,
            state,
            codes: inputs.codes,
            lengths: self.lengths,
            speeds: self.diagnosis.speeds(),
            supply_v: watched.supply_v,
            command: inputs.command,
            sent: self.diagnosis.last_sent(),
        }
    }

    /// Sensing → diagnosis → pose → motion → fence; the first stage at fault ends it.
    fn sense_and_follow(&mut self, inputs: &Inputs) -> Result<(Wanted, Fenced), Fault> {
        let running = self.supervisor.state() == State::Running;
        // Without a fresh command nothing is wanted, and the supervisor stops what runs.
        let intent = inputs.command.as_ref().unwrap_or(&Intent::NEUTRAL);
        // Nothing is lent but in service.
        let fitted = self.fitted.as_mut().map(F::borrow_mut).ok_or(Fault::NotConfigured)?;
        let (machine, mut fence, followers) = fitted.parts().ok_or(Fault::NotConfigured)?;
        let machine = near(machine);
        let result = near(&self.sensing).read(inputs).map_err(Fault::Sensor).and_then(|sensed| {
            let suspected = self.diagnosis.fault();
            if let Some(fault) = suspected.filter(|fault| fault.hides_pose()) {
                return Err(fault);
            }
            find_pose(machine, &sensed, &mut self.pose)?;
            self.lengths = sensed.lengths;
            suspected.map_or(Ok(()), Err)?;
            let wanted = {
                let asked = (intent, inputs.slope, &inputs.pressures_pa);
                near(&mut self.motion).follow((machine, followers), running, asked, &self.pose, &sensed.lengths)?
            };
            let fenced = match &mut fence {
                Some(fence) => near(fence).limit(machine, &sensed, &wanted.speeds)?,
                None => Fenced { speeds: wanted.speeds, clearance_m: NO_CLEARANCE },
            };
            Ok((wanted, fenced))
        });
        if result.is_err() {
            self.motion.reset();
            fitted.reset();
        }
        result
    }
}

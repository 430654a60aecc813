//! The whole application: one tick from inputs to outputs. `serve` is a tick in service, `mount` the change of the bucket.

mod mount;
mod serve;

use core::borrow::BorrowMut;

use kinematics_core::{Cylinders, Machine, Pose};

use crate::command::Intent;
use crate::diagnosis::Diagnosis;
use crate::dig::Dig;
use crate::fault::{Fault, State};
use crate::fence::{Fence, Fenced, NO_CLEARANCE};
use crate::freeze_frame::FreezeFrame;
use crate::io::{Inputs, NO_LENGTHS, NO_POSE, Outputs, Speeds};
use crate::motion::{Followers, Motion, Wanted};
use crate::parameters::{ParameterError, Parameters};
use crate::pose::{maps, pose};
use crate::sensing::Sensing;
use crate::service::Service;
use crate::supervisor::{Gate, SelfTest, Supervisor, Watched};
use crate::travel::first_violation;
use crate::valve::coil_fault::FaultyCoil;
use crate::valve::coil_stage::{CoilStage, CoilsDriven};

use mount::Buckets;

/// The controller: stages, the supervisor, and the last valid pose. `F` holds what planned motion needs of memory, by value or, as
/// in an image, by reference.
#[derive(Clone, Debug)]
pub struct Ecu<F = Followers> {
    machine: Machine<f32>,
    sensing: Sensing,
    diagnosis: Diagnosis,
    motion: Motion<F>,
    fence: Option<Fence>,
    supervisor: Supervisor,
    valve: CoilStage,
    /// What the coils' currents showed in the last tick.
    coil_fault: Option<FaultyCoil>,
    tick: u32,
    freeze_frame: Option<FreezeFrame>,
    lengths: Cylinders<f32>,
    pose: Pose<f32>,
    service: Service,
    buckets: Option<Buckets>,
}

impl Ecu {
    /// [`Ecu::with`] followers of its own.
    ///
    /// # Errors
    /// As there.
    pub fn new(parameters: &Parameters) -> Result<Self, ParameterError> {
        Self::with(parameters, Followers::new())
    }
}

impl<F: BorrowMut<Followers>> Ecu<F> {
    /// Validates the parameters, the dig's travel included, plans the move, and builds every stage.
    ///
    /// # Errors
    /// The first parameter at fault, by name and range, the dig's first violation, or why the move has no plan.
    pub fn with(parameters: &Parameters, followers: F) -> Result<Self, ParameterError> {
        let p = parameters;
        p.validate()?;
        let machine = maps(&p.geometry)?;
        let sensing = Sensing::new(&p.swing_sensor, &p.cylinder_sensors, [&p.supply, &p.sensor_supply], &machine)
            .ok_or(ParameterError::NoSwingCylinder)?;
        let dig = p.dig.as_ref().map(Dig::new);
        if let Some(violation) = dig.as_ref().and_then(|dig| first_violation(&machine, dig)) {
            return Err(ParameterError::Dig(violation));
        }
        let fence =
            p.fence.as_ref().map(|fence| Fence::new(fence, &p.geometry, &machine, &p.coils.valves())).transpose()?;
        Ok(Self {
            diagnosis: Diagnosis::new(&p.diagnosis, sensing.views()),
            sensing,
            motion: Motion::new(p, &machine, dig, followers)?,
            fence,
            machine,
            supervisor: Supervisor::new(&p.supply, &p.sensor_supply),
            valve: CoilStage::new(&p.coils)?,
            coil_fault: None,
            tick: 0,
            freeze_frame: None,
            lengths: NO_LENGTHS,
            pose: NO_POSE,
            service: Service::new(p),
            buckets: None,
        })
    }

    /// Takes the board's start-up report; before every step of it has passed nothing is enabled.
    pub fn self_tested(&mut self, report: &SelfTest) {
        self.supervisor.self_tested(report);
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
        self.diagnosis.judge(&inputs.codes, &inputs.pressures_pa);

        let wanted = self.sense_and_follow(inputs);
        let (coil, moving) = (self.coil_fault, self.diagnosis.moving());
        let watched = Watched { supply_v, sensor_supply_v, coil, stage_fault: wanted.err(), moving };
        let (state, known) = (self.supervisor.state(), self.supervisor.fault());
        let gate = self.supervisor.judge(inputs, &watched);
        if let (None, Some(fault)) = (known, self.supervisor.fault()) {
            self.freeze_frame = Some(self.freeze(inputs, &watched, state, fault));
        }

        // Whatever motion wanted, behind a closed gate nothing is wanted.
        let nothing = (Wanted::hold(&self.lengths), Fenced { speeds: Speeds::ZERO, clearance_m: NO_CLEARANCE });
        let (wanted, fenced) = match (gate, wanted) {
            (Gate::Open, Ok(wanted)) => wanted,
            _ => nothing,
        };
        if let Some(fence) = &mut self.fence {
            fence.sent(&fenced.speeds);
        }
        self.diagnosis.sent(&fenced.speeds);
        let driven = self.valve.drive(gate, &fenced.speeds, supply_v, &inputs.coil_codes);
        self.coil_fault = driven.fault;
        self.outputs((gate, inputs.overrun), watched.stage_fault, &wanted, &fenced, &driven)
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
        let intent = inputs.command.unwrap_or(Intent::NEUTRAL);
        let result = self.sensing.read(inputs).map_err(Fault::Sensor).and_then(|sensed| {
            let suspected = self.diagnosis.fault();
            if let Some(fault) = suspected.filter(|fault| fault.hides_pose()) {
                return Err(fault);
            }
            let pose = pose(&self.machine, &sensed).map_err(|_| Fault::Geometry)?;
            (self.lengths, self.pose) = (sensed.lengths, pose);
            suspected.map_or(Ok(()), Err)?;
            let wanted = {
                let asked = (&intent, inputs.slope);
                self.motion.follow(&self.machine, running, asked, &pose, &sensed.lengths)?
            };
            let fenced = match &mut self.fence {
                Some(fence) => fence.limit(&self.machine, &sensed, &wanted.speeds)?,
                None => Fenced { speeds: wanted.speeds, clearance_m: NO_CLEARANCE },
            };
            Ok((wanted, fenced))
        });
        if result.is_err() {
            self.motion.reset();
            if let Some(fence) = &mut self.fence {
                fence.reset();
            }
        }
        result
    }
}

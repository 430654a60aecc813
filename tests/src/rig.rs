//! A controller on a bench: inputs set by hand, one tick at a time.

use std::path::{Path, PathBuf};

use firmware::can::command::TipVelocity;
use firmware::io::Solenoids;
use firmware::{Ecu, Inputs, Intent, Outputs, Parameters, Request, SelfTest, State};
use hil_sim::coil_trial::REFERENCE;
use hil_sim::plant::STEP_S;
use hil_sim::plant::coil::{CurrentAdc, Drive, Solenoid};
use hil_sim::plant::sensors::{Noise, code};
use hil_sim::scenario::Scenario;
use kinematics_core::{Cylinders, Machine};

/// The workspace's root.
pub fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A scenario of this repository.
pub fn scenario(name: &str) -> Scenario {
    let file = workspace().join("scenarios").join(name).with_extension("toml");
    Scenario::load(&file).unwrap_or_else(|error| panic!("{error}"))
}

/// Every scenario file of this repository that has a machine, by name.
pub fn scenario_names() -> Vec<String> {
    let folder = workspace().join("scenarios");
    let files = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut names: Vec<String> = files
        .map(|file| file.expect("a readable folder").path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .filter(|path| !std::fs::read_to_string(path).is_ok_and(|text| hil_sim::planar_arm::is_planar_arm(&text)))
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    assert!(!names.is_empty(), "no scenario in {}", folder.display());
    names
}

/// A controller with the inputs it will get next.
#[derive(Clone, Debug)]
pub struct Rig {
    /// The controller.
    pub ecu: Ecu,
    /// What the next tick reads; command, coil currents and the cut-off's contact are put in by [`Rig::tick`].
    pub inputs: Inputs,
    /// What the operator asks for.
    pub request: Request,
    /// The levers.
    pub levers: [i16; 4],
    /// The tip's velocity.
    pub tip: TipVelocity,
    /// The operator's messages are fresh.
    pub sending: bool,
    /// The solenoids.
    pub solenoids: [Solenoids<Solenoid>; 4],
    adc: CurrentAdc,
    /// The sensors have noise.
    pub noisy: bool,
    ticked: u16,
}

/// Supply of the rig, V.
const SUPPLY_V: f64 = 24.0;
/// Its code, and that of the sensors' 10 V.
const SUPPLY_CODES: [u16; 2] = [39321, 63999];

impl Rig {
    /// At the start of the dig scenario, everything healthy, enable off, levers in neutral.
    pub fn new() -> Self {
        let scenario = scenario("dig");
        Self::with(&scenario.parameters)
    }

    /// The same with other parameters that hold a dig.
    pub fn with(parameters: &Parameters) -> Self {
        let machine = Machine::<f64>::new(&parameters.geometry).expect("a valid geometry");
        let dig = firmware::dig::Dig::<f64>::new(parameters.dig.as_ref().expect("a dig"));
        let Cylinders { boom, arm, bucket } = machine.tip_to_cylinders(&dig.tip(0.0)).expect("a start within reach");
        Self::standing(parameters, &[boom, arm, bucket])
    }

    /// Anywhere: lengths of boom, arm and bucket cylinder, m.
    pub fn standing(parameters: &Parameters, &[boom, arm, bucket]: &[f64; 3]) -> Self {
        let sense = parameters.coils.sense;
        let mut ecu = Ecu::new(parameters).unwrap_or_else(|error| panic!("{error}"));
        ecu.self_tested(&SelfTest::PASSED);
        let mut rig = Self {
            ecu,
            inputs: Inputs {
                codes: [32768; 4],
                supply_code: SUPPLY_CODES[0],
                sensor_supply_code: SUPPLY_CODES[1],
                coil_codes: [[0; 2]; 4],
                command: None,
                slope: None,
                pressures_pa: [[None; 2]; 3],
                enable: false,
                converters_sound: [true; 2],
                cut_off_closed: false,
                emergency_stop: false,
                overrun: false,
            },
            request: Request::Neutral,
            levers: [0; 4],
            tip: TipVelocity::ZERO,
            sending: true,
            solenoids: [[Solenoid::new(REFERENCE, 20.0); 2]; 4],
            adc: CurrentAdc { full_scale_a: sense.full_scale_a.into(), zero_code: sense.zero_code, noise_a: 0.0 },
            noisy: true,
            ticked: 0,
        };
        rig.stand_at(parameters, &Cylinders { boom, arm, bucket });
        rig
    }

    /// Sets the sensors' codes to these lengths, m.
    pub fn stand_at(&mut self, parameters: &Parameters, lengths: &Cylinders<f64>) {
        let [boom, arm, bucket] = &parameters.cylinder_sensors;
        self.inputs.codes[1] = code(boom, lengths.boom, 0.0);
        self.inputs.codes[2] = code(arm, lengths.arm, 0.0);
        self.inputs.codes[3] = code(bucket, lengths.bucket, 0.0);
    }

    /// One tick.
    pub fn tick(&mut self) -> Outputs {
        self.inputs.command =
            self.sending.then_some(Intent { request: self.request, levers: self.levers, tip: self.tip });
        self.inputs.coil_codes = self.coil_codes();
        let inputs = self.with_noise();
        let outputs = self.ecu.tick(&inputs);
        self.drive(&outputs);
        outputs
    }

    /// A living sensor is never quite still; a broken wire is, and so is one at the end of its range.
    fn with_noise(&mut self) -> Inputs {
        self.ticked = if self.noisy { self.ticked.wrapping_add(1) } else { 0 };
        let noise = |code: u16| if (2000..63_000).contains(&code) { code + self.ticked % 5 } else { code };
        Inputs { codes: self.inputs.codes.map(noise), ..self.inputs }
    }

    /// What the coils' converter says.
    pub fn coil_codes(&self) -> [Solenoids<u16>; 4] {
        let mut silent = Noise::new(1);
        self.solenoids.map(|spool| spool.map(|solenoid| self.adc.code(&solenoid, &mut silent)))
    }

    /// The cut-off's contact and the solenoids follow the outputs.
    pub fn drive(&mut self, outputs: &Outputs) {
        let cut_off_closed = outputs.cut_off_closed;
        self.inputs.cut_off_closed = cut_off_closed;
        for (solenoid, duty) in self.solenoids.iter_mut().flatten().zip(outputs.duties.into_iter().flatten()) {
            let drive = Drive { duty: f64::from(duty) / 65535.0, supply_v: SUPPLY_V, cut_off_closed };
            solenoid.step(&drive, STEP_S);
        }
    }

    /// Several ticks; gives the last outputs.
    pub fn ticks(&mut self, count: u32) -> Outputs {
        (0..count).map(|_| self.tick()).last().expect("at least one tick")
    }

    /// Neutral, then enable: the controller runs.
    pub fn start(&mut self) -> Outputs {
        self.inputs.enable = false;
        self.request = Request::Neutral;
        self.ticks(5);
        self.inputs.enable = true;
        let outputs = self.tick();
        assert_eq!(outputs.state, State::Running, "{:?}", outputs.fault);
        outputs
    }

    /// Running, and digging for so many ticks with the machine standing still.
    pub fn dig(&mut self, ticks: u32) -> Outputs {
        self.start();
        self.request = Request::Dig;
        self.ticks(ticks)
    }
}

impl Default for Rig {
    fn default() -> Self {
        Self::new()
    }
}

/// No current anywhere and the cut-off open.
pub fn is_safe(outputs: &Outputs) -> bool {
    !outputs.cut_off_closed
        && outputs.currents.iter().flatten().all(|&current| current == 0.0)
        && outputs.duties.iter().flatten().all(|&duty| duty == 0)
}

/// Some coil carries current.
pub fn drives(outputs: &Outputs) -> bool {
    outputs.cut_off_closed && outputs.duties.iter().flatten().any(|&duty| duty > 0)
}

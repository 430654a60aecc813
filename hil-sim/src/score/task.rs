//! What is to be done: paths of straight segments, and the scenario of each.

use firmware::parameters::Parameters;
use serde::Serialize;

use crate::machine_file::MachineFile;
use crate::plant::hydraulic::HydraulicModel;
use crate::scenario::Scenario;

/// A task of the score.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// Level ground, towards the machine.
    Level,
    /// A slope of 1 : 3, downwards and towards the machine.
    Slope,
    /// A trench's wall, straight down.
    VerticalCut,
    /// In, along, and out, the bucket curling: through soil.
    Dig,
    /// A square in the air.
    Square,
}

/// A knot: reach (m), height over the boom pin (m), bucket pitch (degrees).
type Place = [f64; 3];

impl Task {
    /// All tasks.
    pub const ALL: [Self; 5] = [Self::Level, Self::Slope, Self::VerticalCut, Self::Dig, Self::Square];

    /// Name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Level => "level",
            Self::Slope => "slope",
            Self::VerticalCut => "vertical_cut",
            Self::Dig => "dig",
            Self::Square => "square",
        }
    }

    /// Grading: what the wanted bounds are for.
    pub const fn is_grading(self) -> bool {
        matches!(self, Self::Level | Self::Slope)
    }

    /// Its knots on a machine of the 20 t class.
    fn knots(self) -> &'static [Place] {
        const PIN: f64 = 1.9573;
        match self {
            Self::Level => &[[7.5, -PIN, 240.0], [4.5, -PIN, 240.0]],
            Self::Slope => &[[7.5, -1.2, 240.0], [4.8, -2.1, 240.0]],
            Self::VerticalCut => &[[6.2, -1.0, 250.0], [6.2, -3.0, 250.0]],
            Self::Dig => &[[7.4, -1.5, 250.0], [7.0, -2.25, 240.0], [5.2, -2.35, 215.0], [4.6, -1.5, 180.0]],
            Self::Square => {
                &[[5.6, -1.2, 240.0], [7.1, -1.2, 240.0], [7.1, 0.3, 240.0], [5.6, 0.3, 240.0], [5.6, -1.2, 240.0]]
            }
        }
    }

    /// Corners of the path: reach and height, m.
    pub(super) fn corners(self) -> Vec<[f64; 2]> {
        self.knots().iter().map(|&[x, z, _]| [x, z]).collect()
    }

    /// Length of the path, m.
    pub(super) fn length_m(self) -> f64 {
        self.corners().windows(2).map(|pair| libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1])).sum()
    }

    /// The scenario on the nominal plant, the controller's map that of the nominal plant.
    pub(super) fn scenario(self, machine: &MachineFile, speed_mps: f64, law: &str) -> Result<Scenario, String> {
        let segments = self.knots().len() as f64 - 1.0;
        // The way, the speed-ups and brakings, twice as much for a path that must slow down, and a rest to be looked at.
        let duration_s = 1.0 + 2.0 * (self.length_m() / speed_mps + segments * 2.0 * speed_mps) + 4.0;
        let knots: String = self
            .knots()
            .iter()
            .map(|[x, z, pitch]| format!("[[knot]]\nx_m = {x}\nz_m = {z}\npitch_deg = {pitch}\nswing_deg = 0.0\n"))
            .collect();
        let soil = if self == Self::Dig { "soil = \"loam\"\n" } else { "" };
        let text = format!(
            "name = \"score\"\ndescription = \"score\"\nmachine = \"zx200\"\nduration_s = {duration_s}\n\
             [operator]\nenable_s = 0.3\nbegin_s = 0.5\n\
             [path]\nspeed_mps = {speed_mps}\nacceleration_mps2 = 0.5\npitch_speed_deg_s = 30.0\n\
             pitch_acceleration_deg_s2 = 60.0\nswing_speed_deg_s = 45.0\nswing_acceleration_deg_s2 = 30.0\n{knots}{law}\n\
             [plant]\nmodel = \"hydraulic\"\npayload_kg = 0.0\n{soil}coil_full_scale_a = 1.2\n\
             coil_resistance_ohm = 5.3\ncoil_inductance_h = 0.1\nsupply_v = 24.0\nsensor_noise_m = 0.0001\n"
        );
        // The path says where it starts.
        Scenario::of_text(&text, machine.clone(), None)
    }
}

/// The tuning under test, the same for every task and plant: found on plants that the score never draws.
pub const LAW: &str = include_str!("law.toml");

/// How the controller of a case differs from the one under test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Controller {
    /// As it is, its valve map nearly that of the plant.
    Ours,
    /// As it is, its valve map that of the nominal plant.
    Uncalibrated,
    /// Feed-forward alone.
    OpenLoop,
    /// Error times gain, without feed-forward, preview and learning.
    Proportional,
    /// As it is, with half the pump, and told so.
    HalfFlow,
}

impl Controller {
    pub(super) const ALL: [Self; 5] =
        [Self::Ours, Self::Uncalibrated, Self::OpenLoop, Self::Proportional, Self::HalfFlow];

    /// Changes the controller's parameters, and the plant where it has half the flow.
    pub(super) fn apply(self, parameters: &mut Parameters, plant: &mut HydraulicModel) {
        if matches!(self, Self::OpenLoop | Self::Proportional) {
            // What ours is compared with shall not stop on the way.
            parameters.motion.following_error_m = 0.5;
        }
        let Some(law) = &mut parameters.motion.law else { return };
        match self {
            Self::Ours | Self::Uncalibrated => {}
            Self::OpenLoop => {
                parameters.motion.gain_per_s = 0.0;
                law.integral_per_s2 = 0.0;
            }
            Self::Proportional => {
                law.feed_forward = 0.0;
                law.integral_per_s2 = 0.0;
                law.correction_limit_mps = 1.0;
                parameters.motion.preview_s = 0.0;
                // As high as the slowest drawn valve allows without ringing.
                parameters.motion.gain_per_s = 2.0;
            }
            Self::HalfFlow => {
                law.flow_m3ps *= 0.5;
                plant.pump.flow_m3ps *= 0.5;
            }
        }
    }
}

//! Random operators before random fences: a machine of any file at a random pose, limits around it, levers that ask for anything.

use firmware::fence::{BallParameters, FenceParameters, Guards, PlaneParameters, SwingRangeParameters};
use kinematics_core::geometry::Stroke;
use kinematics_core::planning::limits::{HALF_SPACES, Limits, SPHERES};
use kinematics_core::planning::outline::Outline;
use kinematics_core::world::BasePlacement;
use kinematics_core::{Cylinders, Machine, Rotor};

use super::Kind;
use crate::dice::Dice;
use crate::machine_file::MachineFile;
use crate::plant::SwingDrive;
use crate::scenario::{LeverMove, Scenario, Start, Task};

/// Each run, s.
const DURATION_S: f64 = 8.15;
/// When the levers first move, s.
const BEGIN_S: f64 = 0.25;

/// One random run, to be tried under each kind of fence.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The run with its fence.
    pub(super) scenario: Scenario,
    /// Of the sensors' noise.
    pub(super) seed: u64,
    fence: FenceParameters,
}

impl Trial {
    /// The run under this kind of fence.
    pub fn with(&self, kind: Kind) -> Scenario {
        let mut scenario = self.scenario.clone();
        scenario.parameters.fence = match kind {
            Kind::Linkage => Some(self.fence),
            Kind::Tip => Some(FenceParameters { guards: Guards::Tip, ..self.fence }),
            Kind::None => None,
        };
        scenario
    }

    /// Its limits.
    pub fn fence(&self) -> &FenceParameters {
        &self.fence
    }
}

/// What all trials of a machine share.
#[derive(Clone, Debug)]
pub(super) struct Trials {
    base: Scenario,
    machine: Machine<f64>,
    outline: Outline<f64>,
    /// Between which swings a trial starts.
    swing_deg: [f64; 2],
}

/// Full speeds of a 20 t excavator, as the time a whole stroke takes, s.
const STROKE_TIMES_S: [f64; 3] = [4.3, 3.4, 1.75];

fn base(machine: &MachineFile) -> Result<Scenario, String> {
    let g = &machine.geometry;
    let speed = |stroke: Stroke, time_s: f64| (stroke.max_m - stroke.min_m) / time_s;
    let [boom_s, arm_s, bucket_s] = STROKE_TIMES_S;
    let middle = |stroke: Stroke| 0.5 * (stroke.min_m + stroke.max_m);
    // The machine is put in afterwards: any shipped one will do to read the text.
    let text = format!(
        "name = \"fence\"\ndescription = \"random operator\"\nmachine = \"exact-mini\"\nduration_s = {DURATION_S}\n\
         [operator]\nenable_s = 0.15\nbegin_s = {BEGIN_S}\n\
         [start]\nswing_deg = 0.0\nboom_m = 1.1\narm_m = 1.3\nbucket_m = 1.0\n\
         [[lever]]\nat_s = 0.0\nuntil_s = 1.0\nswing = 0.0\nboom = 0.0\narm = 0.0\nbucket = 0.0\n\
         [motion]\npreview_s = 0.15\ngain_per_s = 2.0\nsmallest_speed_mps = 0.002\nstart_tolerance_m = 0.02\n\
         following_error_m = 0.1\n\
         [plant]\ndead_time_s = 0.1\nspool_lag_s = 0.05\ndead_band_extend = 0.15\ndead_band_retract = 0.20\n\
         swing_speed_rad_s = 1.2\nboom_speed_mps = {}\narm_speed_mps = {}\nbucket_speed_mps = {}\n\
         retract_speed_ratio = 0.8\ncoil_full_scale_a = 1.2\ncoil_resistance_ohm = 5.3\ncoil_inductance_h = 0.1\nsupply_v = 24.0\n\
         sensor_noise_m = 0.0001\n[fence]\n",
        speed(g.boom.stroke, boom_s),
        speed(g.arm.stroke, arm_s),
        speed(g.bucket.stroke, bucket_s),
    );
    let start = Start {
        swing_deg: 0.0,
        boom_m: middle(g.boom.stroke),
        arm_m: middle(g.arm.stroke),
        bucket_m: middle(g.bucket.stroke),
    };
    Scenario::of_machine(&text, machine.clone(), start)
}

impl Trials {
    pub(super) fn new(file: &MachineFile) -> Result<Self, String> {
        let base = base(file)?;
        let machine = Machine::new(&file.geometry).map_err(|error| error.to_string())?;
        let outline = Outline::new(&file.geometry, &file.outline).map_err(|error| error.to_string())?;
        // Half of a swing cylinder's range, away from its stops.
        let swing_deg = match (SwingDrive::of(&machine), file.geometry.swing) {
            (drive @ SwingDrive::Cylinder(_), Some(pins)) => {
                let Stroke { min_m, max_m } = pins.stroke;
                let quarter = 0.25 * (max_m - min_m);
                let at = |length| drive.rotor(length).map(|swing| swing.angle().to_degrees());
                let ends = at(min_m + quarter).zip(at(max_m - quarter)).ok_or("the swing cylinder does not close")?;
                [ends.0, ends.1]
            }
            _ => [-30.0, 30.0],
        };
        Ok(Self { base, machine, outline, swing_deg })
    }

    /// The trial of this index: a pose, a fence around it that it is clear of, and eight seconds of levers.
    pub(super) fn trial(&self, seed: u64, index: u32) -> Result<Trial, String> {
        let mut dice = Dice::new(seed ^ (u64::from(index) << 32));
        let mut scenario = self.base.clone();
        let (start, swing_range) = self.start(&mut dice);
        let moves = moves(&mut dice);
        let mut fence = self.base.parameters.fence.ok_or("the fence is missing")?;
        self.limit(&mut fence, &start, &mut dice)?;
        fence.swing = swing_range.filter(|_| dice.with_chance(0.5));
        scenario.task = Task::Levers { start, moves };
        Ok(Trial { scenario, seed: u64::from(index), fence })
    }

    fn start(&self, dice: &mut Dice) -> (Start, Option<SwingRangeParameters>) {
        let g = &self.base.machine.geometry;
        let mut length = |stroke: Stroke| dice.within(stroke.min_m, stroke.max_m);
        let (boom_m, arm_m, bucket_m) = (length(g.boom.stroke), length(g.arm.stroke), length(g.bucket.stroke));
        let [right, left] = self.swing_deg;
        let swing_deg = dice.within(right, left);
        let range = SwingRangeParameters {
            right_deg: swing_deg - dice.within(5.0, 40.0),
            left_deg: swing_deg + dice.within(5.0, 40.0),
        };
        (Start { swing_deg, boom_m, arm_m, bucket_m }, Some(range))
    }

    /// Planes and balls that the start is clear of by up to a fifth of the reach.
    fn limit(&self, fence: &mut FenceParameters, start: &Start, dice: &mut Dice) -> Result<(), String> {
        let lengths = Cylinders { boom: start.boom_m, arm: start.arm_m, bucket: start.bucket_m };
        let joints = self.machine.cylinders_to_joints(&lengths).map_err(|error| error.to_string())?;
        let placed = self.outline.place(&self.machine, &joints).map_err(|error| error.to_string())?;
        let swing = Rotor::from_degrees(start.swing_deg);
        let world = BasePlacement::level(Rotor::IDENTITY, [0.0, 0.0, fence.boom_pin_height_m]);
        let reach = self.base.machine.geometry.reach_m();
        let closest = |fence: &FenceParameters| {
            let limits: Limits<f64> = fence.limits();
            limits.closest(&placed.strips, swing, &world).unwrap_or(f64::INFINITY)
        };
        let slant = dice.within(0.0, 1.0);
        let sloped = [libm::cos(slant * 6.0) * 0.6, libm::sin(slant * 6.0) * 0.6, 0.8];
        let normals = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], sloped];
        for (slot, normal) in normals.into_iter().enumerate() {
            let room = dice.within(0.02, 0.2) * reach;
            if dice.with_chance(0.6) {
                let mut alone = FenceParameters { planes: [None; HALF_SPACES], balls: [None; SPHERES], ..*fence };
                alone.planes[0] = Some(PlaneParameters { normal, offset_m: 0.0 });
                // The clearance to the plane through the origin tells where the linkage ends.
                fence.planes[slot] = Some(PlaneParameters { normal, offset_m: room - closest(&alone) });
            }
        }
        for slot in 0..SPHERES {
            let centre_m =
                [dice.within(-0.3, 1.0) * reach, dice.within(-0.6, 0.6) * reach, dice.within(-0.4, 0.7) * reach];
            let before = fence.balls;
            fence.balls[slot] = Some(BallParameters { centre_m, radius_m: dice.within(0.0, 0.05) * reach });
            // A ball the start already touches is left out.
            if closest(fence) < 0.02 * reach {
                fence.balls = before;
            }
        }
        Ok(())
    }
}

/// Levers held for random times at random deflections, half of them full; often several at once, often reversed.
fn moves(dice: &mut Dice) -> Vec<LeverMove> {
    let mut moves = Vec::new();
    let mut at_s = BEGIN_S;
    while at_s < DURATION_S {
        let until_s = at_s + dice.within(0.05, 1.5);
        let mut lever = || {
            let deflection = dice.within(-1.0, 1.0);
            if dice.with_chance(0.35) {
                0.0
            } else if dice.with_chance(0.5) {
                deflection.signum()
            } else {
                deflection
            }
        };
        let (swing, boom, arm, bucket) = (lever(), lever(), lever(), lever());
        moves.push(LeverMove { at_s, until_s, swing, boom, arm, bucket });
        at_s = until_s;
    }
    moves
}

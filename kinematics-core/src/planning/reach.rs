//! The way to a target: which of the poses that reach it, which way round the obstacles, and the step along it.
//!
//! Planning is bounded and spread over ticks: every call of [`Reach::tick`] does one piece of about half an [`Avoid::step`]'s cost.
//! 1. *Poses*: [`PITCHES`] bucket pitches at the target, before the swing axis and behind it, each by the closed-form inverse; kept are the nearest clear one and
//!    the clearest. None clear is [`Progress::Blocked`].
//! 2. *Postures*: a grid of [`GRID`] postures, tried at every obstacle's bearing, one a tick; kept is the nearest clear one of each arm angle.
//! 3. *Routes*: all of `route.rs`, by their time at the speed limits, the direct one first.
//! 4. *Rehearsal*: the steps along a route, at a coarse time step, before anything moves; the first that arrives is taken.
//!    None is [`Progress::NoRoute`].
//!
//! Then the same step follows it, one in three ticks: the first looks where everything is, the second and the third choose the rates, which hold
//! for three ticks. At 1 kHz that is a step every 3 ms, against time constants of a quarter of a second and more. A step that gets stuck all the same plans anew from where it stands and takes
//! the next route that arrives, [`REPLANS`] times at most: [`Progress::NotConverged`].

use super::avoid::{Aim, Avoid, Choosing, Step, Survey, advanced};
use super::hull::Sphere;
use super::route::{Bearing, Map, POSTURES, ROUTES, Route};
use crate::chain::Chain;
use crate::{PlaneTip, Real, Rotor, Vec2};

/// Bucket pitches tried at the target, and as many times more where none of them was clear.
pub const PITCHES: usize = 64;
const FINER: usize = 24;
/// Postures tried for passing.
pub const GRID: usize = 5 * POSTURES * 3;
/// Plannings after the first.
pub const REPLANS: u8 = 4;
/// Steps of one rehearsal at most, and their length, s.
const REHEARSED_STEPS: u32 = 2000;
const REHEARSED_STEP_S: f64 = 0.02;
/// A pace below which a step away from its aim counts as stuck, and for how long, s.
const STUCK_PACE: f64 = 0.02;
const STUCK_S: f64 = 0.4;
/// An aim on the way is passed so near, s at the speed limits.
const PASSED_S: f64 = 0.15;
/// The target's pose is reached so near, s at the speed limits: in rehearsal.
const ARRIVED_S: f64 = 0.05;

/// Where the tip shall go, in the base frame, m.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Target<T> {
    /// Forward at zero swing.
    pub x: T,
    /// To the left.
    pub y: T,
    /// Above the boom pin.
    pub z: T,
}

/// How far it has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// Thinking; the machine stands.
    Planning,
    /// On the way.
    Moving,
    /// The tip is at the target to the tolerance.
    Reached,
    /// No pose within the travel reaches the target clear of the obstacles.
    Blocked,
    /// Such a pose exists, but no route was found.
    NoRoute,
    /// Stuck on the way once too often.
    NotConverged,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Pose<T> {
    aim: Aim<T>,
    /// Time from the start, s, or the clearance, m: what it was chosen by.
    worth: T,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Along<T> {
    route: Route<T>,
    passed: usize,
    /// s below the stuck pace.
    stuck: T,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase<T, const N: usize> {
    Poses {
        pitch: usize,
        of: usize,
    },
    /// Obstacles before `tried` leave posture `index` clear.
    Postures {
        index: usize,
        tried: usize,
        best: [Option<Pose<T>>; POSTURES],
    },
    Rank {
        number: usize,
    },
    Rehearse {
        along: Along<T>,
        joints: [Rotor<T>; 4],
        steps: u32,
    },
    Follow {
        along: Along<T>,
    },
    End {
        progress: Progress,
    },
}

/// One target, its obstacles, and how far the way to it has come.
///
/// ```
/// use kinematics_core::planning::avoid::{Avoid, AvoidParameters, advanced};
/// use kinematics_core::planning::hull::{Flesh, Hull, Sphere};
/// use kinematics_core::planning::reach::{Progress, Reach, Target};
/// use kinematics_core::{Machine, PinGeometry, Rotor};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let g = PinGeometry::EXACT_MINI;
/// let hull = Hull::<f32>::new(&g, Flesh::of_reach(g.reach_m()))?;
/// let avoid = Avoid::new(&g, hull, &AvoidParameters::of_reach(g.reach_m(), [1.1, 0.45, 1.1, 1.1]))?;
/// let chain = *Machine::new(&g)?.chain();
/// // From straight ahead to the left, a ball between.
/// let target = Target { x: 0.0, y: 2.5, z: 0.2 };
/// let ball = Sphere { x: 1.8, y: 1.8, z: 0.0, radius: 0.3 };
/// let mut reach = Reach::new(avoid, chain, target, [ball], 0.01);
/// let mut joints = [0.0, 20.0, -80.0, -30.0].map(Rotor::from_degrees);
/// let ended = (0..20_000).find_map(|_| {
///     let told = reach.tick(&joints, 0.001);
///     joints = advanced(&joints, &told.rates, 0.001);
///     assert!(told.clearance.is_none_or(|clearance| clearance > 0.03));
///     (!matches!(told.progress, Progress::Planning | Progress::Moving)).then_some(told.progress)
/// });
/// assert_eq!(ended, Some(Progress::Reached));
/// // From where it stands now it has nothing left to do.
/// reach.restart();
/// let again = (0..20_000).map(|_| reach.tick(&joints, 0.001)).find(|told| told.progress == Progress::Reached);
/// assert!(again.is_some());
/// // Inside a ball there is no pose to reach.
/// let around = Sphere { x: 0.0, y: 2.5, z: 0.2, radius: 0.3 };
/// let mut reach = Reach::new(avoid, chain, target, [around], 0.01);
/// let told = (0..4000).map(|_| reach.tick(&joints, 0.001)).last();
/// assert!(told.is_some_and(|told| told.progress == Progress::Blocked));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Reach<T, const N: usize> {
    avoid: Avoid<T>,
    chain: Chain<T>,
    target: Target<T>,
    obstacles: [Sphere<T>; N],
    tolerance: T,
    phase: Phase<T, N>,
    start: [Rotor<T>; 4],
    nearest: Option<Pose<T>>,
    clearest: Option<Pose<T>>,
    second_pose: bool,
    map: Option<Map<T, N>>,
    /// Times of all routes, s; negative for none.
    times: [T; ROUTES],
    replans: u8,
    /// Routes that arrived in rehearsal and are yet passed over: as many as got stuck before.
    passed_over: u8,
    /// The first half of a step; whether it was done in the tick before.
    survey: Survey<T, N>,
    surveyed: bool,
    /// On the way, the first part of the choice.
    chosen: Option<Choosing<T>>,
    /// The rates until the next step is complete.
    rates: [T; 4],
}

/// What a tick says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Told<T> {
    /// How far it has come.
    pub progress: Progress,
    /// Rates of swing, boom, arm, bucket, rad/s: zeros unless moving.
    pub rates: [T; 4],
    /// The smallest distance between hull and obstacles, m, where this tick looked.
    pub clearance: Option<T>,
}

impl<T: Real, const N: usize> Reach<T, N> {
    /// Begins planning from the joints of the first tick. `tolerance_m` is how near the tip must come, m.
    pub fn new(avoid: Avoid<T>, chain: Chain<T>, target: Target<T>, obstacles: [Sphere<T>; N], tolerance_m: T) -> Self {
        Self {
            avoid,
            chain,
            target,
            obstacles,
            tolerance: tolerance_m,
            phase: Phase::Poses { pitch: 0, of: PITCHES },
            start: [Rotor::IDENTITY; 4],
            nearest: None,
            clearest: None,
            second_pose: false,
            map: None,
            times: [-T::ONE; ROUTES],
            replans: 0,
            passed_over: 0,
            survey: Survey::none(),
            surveyed: false,
            chosen: None,
            rates: [T::ZERO; 4],
        }
    }

    /// Back to the first tick: another start, the same target.
    pub fn restart(&mut self) {
        self.phase = Phase::Poses { pitch: 0, of: PITCHES };
        self.replans = 0;
    }

    /// One tick of `dt` s at these joints (swing, boom, arm, bucket).
    #[inline(never)]
    pub fn tick(&mut self, joints: &[Rotor<T>; 4], dt: T) -> Told<T> {
        // The larger phases are worked on where they lie.
        match self.phase {
            Phase::Poses { pitch, of } => {
                if pitch == 0 {
                    self.begin(joints);
                }
                self.try_pitch(pitch, of);
                self.planning()
            }
            Phase::Postures { .. } => {
                self.try_posture();
                self.planning()
            }
            Phase::Rank { number } => {
                self.rank(number);
                self.planning()
            }
            Phase::Rehearse { .. } => {
                self.rehearse();
                self.planning()
            }
            Phase::Follow { .. } => self.follow(joints, dt),
            Phase::End { progress } => Told { progress, rates: [T::ZERO; 4], clearance: None },
        }
    }

    fn planning(&self) -> Told<T> {
        let progress = match self.phase {
            Phase::End { progress } => progress,
            _ => Progress::Planning,
        };
        Told { progress, rates: [T::ZERO; 4], clearance: None }
    }

    fn end(&mut self, progress: Progress) {
        self.phase = Phase::End { progress };
    }

    fn begin(&mut self, joints: &[Rotor<T>; 4]) {
        self.start = *joints;
        (self.nearest, self.clearest, self.second_pose) = (None, None, false);
        self.passed_over = self.replans;
        (self.surveyed, self.chosen, self.rates) = (false, None, [T::ZERO; 4]);
    }

    fn try_pitch(&mut self, pitch: usize, of: usize) {
        let radial = Vec2::new(self.target.x, self.target.y);
        let Some(ahead) = radial.direction() else { return self.end(Progress::Blocked) };
        let turns = T::from_i32(pitch as i32) / T::from_i32(of as i32);
        // In the second round with the tip behind the swing axis.
        let (swing, reach) = if pitch < of {
            (ahead, radial.norm())
        } else {
            (Rotor { cos: -ahead.cos, sin: -ahead.sin }, -radial.norm())
        };
        let tip = PlaneTip { reach, height: self.target.z, pitch: Rotor::from_turns(turns) };
        if let Ok(found) = self.chain.joints(&tip) {
            let joints = [swing, found.boom, found.arm, found.bucket];
            let aim = self.avoid.aim(&joints);
            let clearance = self.avoid.clearance(&joints, &self.obstacles);
            if self.avoid.within_travel(&aim) && is_clear(&self.avoid, clearance) {
                let time = self.avoid.time(&self.avoid.lack(&self.avoid.aim(&self.start), &aim));
                if self.nearest.is_none_or(|best| time < best.worth) {
                    self.nearest = Some(Pose { aim, worth: time });
                }
                if self.clearest.is_none_or(|best| clearance > best.worth) {
                    self.clearest = Some(Pose { aim, worth: clearance });
                }
            }
        }
        if pitch + 1 < 2 * of {
            self.phase = Phase::Poses { pitch: pitch + 1, of };
        } else if self.nearest.is_some() {
            self.phase = Phase::Postures { index: 0, tried: 0, best: [None; POSTURES] };
        } else if of == PITCHES {
            self.phase = Phase::Poses { pitch: 0, of: FINER * PITCHES };
        } else {
            self.end(Progress::Blocked);
        }
    }

    /// The pose now planned for.
    fn goal(&self) -> Option<Aim<T>> {
        let pose = if self.second_pose { self.clearest } else { self.nearest };
        pose.map(|pose| pose.aim)
    }

    fn try_posture(&mut self) {
        let Some(goal) = self.goal() else { return self.end(Progress::Blocked) };
        let Phase::Postures { index: at, tried, best } = &mut self.phase else { return };
        let index = *at;
        let start = self.avoid.aim(&self.start);
        let share = |n: usize, spacing: f64| T::from_i32(n as i32) * T::from_f64(spacing) - T::from_f64(0.95);
        let (kind, rest) = (index % POSTURES, index / POSTURES);
        let [boom, arm, bucket] = &self.avoid.travels;
        let planar = [
            boom.at(share(rest % 5, 1.9 / 4.0)),
            arm.at(share(kind, 1.9 / (POSTURES - 1) as f64)),
            bucket.at(share(rest / 5, 1.9 / 2.0)),
        ];
        let [b, a, k] = planar;
        let (thickest, keep) = (self.avoid.hull.thickest_m(), self.avoid.stop);
        let mut clear = true;
        if let Some(obstacle) = self.obstacles.get(*tried) {
            // At its own bearing a sphere is nearest: clear there is clear at every swing.
            let bearing = Bearing::of(obstacle, thickest, keep);
            clear = is_clear(&self.avoid, self.avoid.clearance(&[bearing.direction, b, a, k], &[*obstacle]));
            if clear && *tried + 1 < N {
                *tried += 1;
                return;
            }
        }
        *tried = 0;
        if clear {
            let posture = self.avoid.aim(&[start.swing, b, a, k]);
            let over = Aim { swing: goal.swing, places: posture.places };
            let time =
                self.avoid.time(&self.avoid.lack(&start, &posture)) + self.avoid.time(&self.avoid.lack(&over, &goal));
            if let Some(best) = best.get_mut(kind).filter(|best| best.is_none_or(|best| time < best.worth)) {
                *best = Some(Pose { aim: posture, worth: time });
            }
        }
        if index + 1 < GRID {
            *at = index + 1;
        } else {
            let postures = best.map(|best| best.map(|pose| pose.aim.places));
            let bearings = self.obstacles.each_ref().map(|o| Bearing::of(o, thickest, keep));
            self.map = Some(Map { start, goal, bearings, postures });
            self.phase = Phase::Rank { number: 0 };
        }
    }

    fn rank(&mut self, number: usize) {
        let Some(map) = &self.map else { return self.end(Progress::NoRoute) };
        let time = map.route(&self.avoid, number).map(|route| route.time(&self.avoid, &map.start));
        if let Some(entry) = self.times.get_mut(number) {
            *entry = time.unwrap_or(-T::ONE);
        }
        if number + 1 < ROUTES {
            self.phase = Phase::Rank { number: number + 1 };
        } else {
            self.next_route();
        }
    }

    /// The quickest route not yet rehearsed; the other pose's when there is none.
    fn next_route(&mut self) {
        let mut quickest: Option<(usize, T)> = None;
        for (number, &time) in self.times.iter().enumerate() {
            if time >= T::ZERO && quickest.is_none_or(|(_, best)| time < best) {
                quickest = Some((number, time));
            }
        }
        let Some((number, _)) = quickest else { return self.next_pose() };
        if let Some(entry) = self.times.get_mut(number) {
            *entry = -T::ONE;
        }
        let Some(route) = self.map.as_ref().and_then(|map| map.route(&self.avoid, number)) else {
            return self.end(Progress::NoRoute);
        };
        let along = Along { route, passed: 0, stuck: T::ZERO };
        self.phase = Phase::Rehearse { along, joints: self.start, steps: 0 };
    }

    fn next_pose(&mut self) {
        let same = self.nearest.map(|pose| pose.aim) == self.clearest.map(|pose| pose.aim);
        if self.second_pose || same {
            self.end(Progress::NoRoute);
        } else {
            self.second_pose = true;
            self.phase = Phase::Postures { index: 0, tried: 0, best: [None; POSTURES] };
        }
    }

    fn rehearse(&mut self) {
        let dt = T::from_f64(REHEARSED_STEP_S);
        let Phase::Rehearse { along, joints, steps } = &mut self.phase else { return };
        if !self.surveyed {
            self.avoid.survey(joints, &self.obstacles, &mut self.survey);
            self.surveyed = true;
            return;
        }
        self.surveyed = false;
        let Some(aim) = along.route.aim(along.passed) else { return self.next_route() };
        let step = self.avoid.choose(&self.survey, &aim);
        let last = along.route.is_last(along.passed);
        if along.stuck_after(&step, dt) || *steps >= REHEARSED_STEPS {
            self.next_route();
        } else if last && step.to_go_s < T::from_f64(ARRIVED_S) {
            if self.passed_over > 0 {
                self.passed_over -= 1;
                return self.next_route();
            }
            let along = Along { route: along.route, passed: 0, stuck: T::ZERO };
            self.phase = Phase::Follow { along };
        } else {
            if !last && step.to_go_s < T::from_f64(PASSED_S) {
                along.passed += 1;
            }
            *joints = advanced(joints, &step.rates, dt);
            *steps += 1;
        }
    }

    fn follow(&mut self, joints: &[Rotor<T>; 4], dt: T) -> Told<T> {
        let on = Told { progress: Progress::Moving, rates: self.rates, clearance: None };
        if !self.surveyed {
            self.avoid.survey(joints, &self.obstacles, &mut self.survey);
            self.surveyed = true;
            return on;
        }
        let Phase::Follow { along } = &mut self.phase else { return self.planning() };
        let Some(chosen) = self.chosen.take() else {
            let Some(aim) = along.route.aim(along.passed) else { return self.stuck() };
            self.chosen = Some(self.avoid.head(&self.survey, &aim));
            return on;
        };
        self.surveyed = false;
        let step = self.avoid.settle(&self.survey, chosen);
        let told = Told { progress: Progress::Moving, rates: step.rates, clearance: Some(step.clearance) };
        let last = along.route.is_last(along.passed);
        if !last && step.to_go_s < T::from_f64(PASSED_S) {
            along.passed += 1;
        }
        let stuck = along.stuck_after(&step, dt + dt + dt);
        if last && self.miss_square(joints) <= self.tolerance * self.tolerance {
            self.end(Progress::Reached);
            return Told { progress: Progress::Reached, rates: [T::ZERO; 4], ..told };
        }
        if stuck {
            return self.stuck();
        }
        self.rates = step.rates;
        told
    }

    fn stuck(&mut self) -> Told<T> {
        if self.replans < REPLANS {
            self.replans += 1;
            self.phase = Phase::Poses { pitch: 0, of: PITCHES };
        } else {
            self.end(Progress::NotConverged);
        }
        self.planning()
    }

    /// |tip − target|², m².
    fn miss_square(&self, joints: &[Rotor<T>; 4]) -> T {
        let [swing, boom, arm, bucket] = *joints;
        let tip = self.chain.tip(&crate::Joints { boom, arm, bucket });
        let flat = Vec2::new(tip.reach * swing.cos - self.target.x, tip.reach * swing.sin - self.target.y);
        let up = tip.height - self.target.z;
        flat.norm_squared() + up * up
    }
}

/// Clear by a little more than the step's own stop, so that it arrives.
fn is_clear<T: Real>(avoid: &Avoid<T>, clearance: T) -> bool {
    clearance > avoid.stop * T::from_f64(1.02)
}

impl<T: Real> Along<T> {
    fn stuck_after(&mut self, step: &Step<T>, dt: T) -> bool {
        let stands = step.pace < T::from_f64(STUCK_PACE) && step.to_go_s > T::from_f64(STUCK_PACE);
        self.stuck = if stands { self.stuck + dt } else { T::ZERO };
        self.stuck > T::from_f64(STUCK_S)
    }
}

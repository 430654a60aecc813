//! The cheapest pitches along a tip's path, by dynamic programming over a fixed grid that closes in on the best profile.
//!
//! At each of K knots the pitch is one of M candidates; the cheapest way to each, stroke, allowed configurations and the turn
//! between neighbouring knots respected, needs only those of the knot before (Bellman). The first pass spans all pitches of
//! the rule that turning reaches; each further pass lays a finer grid, a quarter as wide, about the profile of the last, which stays on the grid: it
//! never gets worse. P passes are P·(K−1) steps of the same work ([`PitchPlanner::step`]), M maps and M² comparisons.
//!
//! Cylinders that only move one way cost the same however they share the way. Among such, the planner wants even
//! steps: it adds [`EVENNESS_PER_M`]·wᵢ·(K−1)·ΔLᵢ² to the functional; the cost of the plan is told without it.

use core::fmt;

use crate::planning::effort::Effort;
use crate::planning::minimum_norm::minimum_norm_pitches;
use crate::planning::pitch_rule::{PitchRule, within};
use crate::planning::tip_path::TipPath;
use crate::{Cylinders, Joints, Machine, PlaneTip, Real, Rotor};

/// Candidates for the pitch at a knot; odd, so that the last profile is among them.
const M: usize = 65;

/// Candidates on either side of the middle.
const SIDE: i32 = (M / 2) as i32;

/// Passes, the first included: a free pitch ends on a grid of 1/64/4⁵ turns, 0.005°.
const PASSES: u8 = 6;

/// How far to either side the search about the minimum-norm profile begins, turns.
const ABOUT_TURNS: f64 = 0.05;

/// The weight of even steps against the functional, 1/m.
pub const EVENNESS_PER_M: f64 = 0.002;

/// A path move, as asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathMove<T, const K: usize> {
    /// Where the tip goes.
    pub path: TipPath<T, K>,
    /// The pitch at the first knot, where the machine stands, turns.
    pub start_pitch_turns: T,
    /// What the pitch may do.
    pub rule: PitchRule<T>,
    /// The largest change of pitch from knot to knot, turns: a tip at v m/s turns the bucket by no more than this times
    /// v·(K−1)/length a second.
    pub turn_per_knot: T,
}

/// A planned path move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PitchPlan<T, const K: usize> {
    /// Pitch at each knot, turns, continuous.
    pub pitch_turns: [T; K],
    /// Cylinder lengths at each knot, m.
    pub cylinders: [Cylinders<T>; K],
    /// The functional along the knots.
    pub cost: T,
}

/// Why there is no plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlanError {
    /// The start is out of reach or stroke, not allowed, or its pitch breaks the rule.
    Start,
    /// No candidate at this knot can be reached from the knot before.
    NoWay {
        /// Counted from 0.
        knot: usize,
    },
    /// The largest change of pitch is not above zero, or the rule's bounds are in the wrong order.
    Question,
}

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Start => {
                f.write_str("the start is out of reach or stroke, not allowed, or its pitch breaks the rule")
            }
            Self::NoWay { knot } => write!(f, "no pitch at knot {knot} is within reach, stroke, fence and turning"),
            Self::Question => f.write_str("the turn per knot must be above 0 and the pitch's bounds in order"),
        }
    }
}

impl core::error::Error for PlanError {}

/// The cheapest way found to a candidate.
#[derive(Clone, Copy, Debug)]
struct Reached<T> {
    cylinders: Cylinders<T>,
    pitch: T,
    cost: T,
}

/// The planner, a knot a step, K = 2…33: about K·M bytes for the ways back and 5·M + 3·K numbers.
///
/// ```
/// use kinematics_core::planning::effort::Effort;
/// use kinematics_core::planning::pitch_plan::{PathMove, PitchPlanner};
/// use kinematics_core::planning::pitch_rule::PitchRule;
/// use kinematics_core::planning::tip_path::TipPath;
/// use kinematics_core::{Machine, PinGeometry, Vec2};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let machine = Machine::<f32>::new(&PinGeometry::EXACT_MINI)?;
/// let request = PathMove {
///     path: TipPath::<f32, 17>::line(Vec2::new(2.6, -0.5), Vec2::new(1.8, -0.5)),
///     start_pitch_turns: -0.3,
///     rule: PitchRule::Free,
///     turn_per_knot: 0.02,
/// };
/// let mut planner = PitchPlanner::new(&machine, &request, Effort::travel([1.0; 3])?, |_| true)?;
/// let mut steps = 0;
/// let plan = loop {
///     steps += 1;
///     if let Some(plan) = planner.step(&machine, |_| true)? {
///         break plan;
///     }
/// };
/// assert_eq!(steps, PitchPlanner::<f32, 17>::STEPS);
/// assert_eq!(plan.pitch_turns[0], -0.3);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct PitchPlanner<T, const K: usize> {
    request: PathMove<T, K>,
    effort: Effort<T>,
    range: [T; 2],
    /// The profile the grid stands about, and half the grid's width.
    centres: [T; K],
    half_width: T,
    front: [Option<Reached<T>>; M],
    came_from: [[u8; M]; K],
    start: Reached<T>,
    pass: u8,
    knot: usize,
}

/// The configuration with the tip at this place, if reach, stroke and `allowed` let it.
pub(crate) fn place<T: Real>(
    machine: &Machine<T>,
    at: crate::Vec2<T>,
    pitch: T,
    allowed: impl Fn(&Joints<T>) -> bool,
) -> Option<Cylinders<T>> {
    let tip = PlaneTip { reach: at.x, height: at.z, pitch: Rotor::from_turns(pitch) };
    let joints = machine.tip_to_joints(&tip).ok()?;
    let cylinders = machine.joints_to_cylinders(&joints).ok()?;
    allowed(&joints).then_some(cylinders)
}

impl<T: Real, const K: usize> PitchPlanner<T, K> {
    /// Steps to the plan.
    pub const STEPS: usize = (K - 1) * PASSES as usize;

    /// Checks the request.
    ///
    /// # Errors
    /// [`PlanError::Question`], [`PlanError::Start`].
    pub fn new(
        machine: &Machine<T>,
        request: &PathMove<T, K>,
        effort: Effort<T>,
        allowed: impl Fn(&Joints<T>) -> bool,
    ) -> Result<Self, PlanError> {
        // The first grid reaches as far as turning does, and its spacing is not above the turn per knot.
        const { assert!(K >= 2 && 2 * K <= M + 1, "a path has 2 to 33 knots") };
        let pitch = request.start_pitch_turns;
        let [lower, upper] = request.rule.range(pitch);
        if !(request.turn_per_knot > T::ZERO && upper >= lower) {
            return Err(PlanError::Question);
        }
        let [first, ..] = request.path.knots().as_slice() else { return Err(PlanError::Question) };
        let cylinders = place(machine, *first, pitch, allowed).ok_or(PlanError::Start)?;
        if !request.rule.allows(pitch, pitch) {
            return Err(PlanError::Start);
        }
        let wanted = if upper - pitch > pitch - lower { upper - pitch } else { pitch - lower };
        // Less by a thousandth, so that a turn of one candidate is no longer than allowed after rounding.
        let reachable = request.turn_per_knot * T::from_f64(0.999 * (K - 1) as f64);
        let mut planner = Self {
            request: *request,
            effort,
            range: [lower, upper],
            centres: [pitch; K],
            half_width: if wanted < reachable { wanted } else { reachable },
            front: [None; M],
            came_from: [[0; M]; K],
            start: Reached { cylinders, pitch, cost: T::ZERO },
            pass: 0,
            knot: 0,
        };
        planner.begin_pass();
        Ok(planner)
    }

    fn begin_pass(&mut self) {
        self.front = [None; M];
        if let [first, ..] = self.front.as_mut_slice() {
            *first = Some(self.start);
        }
        self.knot = 1;
    }

    /// Starts over with the finer passes about another profile.
    fn begin_about(&mut self, pitch_turns: &[T; K]) {
        self.centres = *pitch_turns;
        self.half_width = T::from_f64(ABOUT_TURNS);
        self.pass = 1;
        self.begin_pass();
    }

    /// Candidate `j` (counted from the middle) about `centre`.
    fn candidate(&self, centre: T, j: i32) -> T {
        let offset = T::from_i32(j) * self.half_width * T::from_f64(1.0 / f64::from(SIDE));
        let [lower, upper] = self.range;
        within(centre + offset, lower, upper)
    }

    /// One knot of one pass; `Ok(None)` until the last.
    ///
    /// # Errors
    /// [`PlanError::NoWay`].
    pub fn step(
        &mut self,
        machine: &Machine<T>,
        allowed: impl Fn(&Joints<T>) -> bool,
    ) -> Result<Option<PitchPlan<T, K>>, PlanError> {
        let no_way = PlanError::NoWay { knot: self.knot };
        let (Some(&at), Some(&centre)) = (self.request.path.knots().get(self.knot), self.centres.get(self.knot)) else {
            return Err(no_way);
        };
        let mut next = [None; M];
        let mut ways = [0; M];
        for (j, (slot, way)) in (-SIDE..).zip(next.iter_mut().zip(&mut ways)) {
            let pitch = self.candidate(centre, j);
            let Some(cylinders) = place(machine, at, pitch, &allowed) else { continue };
            if let Some((index, cost)) = self.cheapest_way(&cylinders, pitch) {
                *way = index;
                *slot = Some(Reached { cylinders, pitch, cost });
            }
        }
        if next.iter().all(Option::is_none) {
            return Err(no_way);
        }
        self.front = next;
        if let Some(kept) = self.came_from.get_mut(self.knot) {
            *kept = ways;
        }
        self.knot += 1;
        if self.knot < K {
            return Ok(None);
        }
        self.trace_back();
        self.pass += 1;
        if self.pass == PASSES {
            return self.plan(machine).map(Some).ok_or(no_way);
        }
        self.half_width = self.half_width * T::from_f64(0.25);
        self.begin_pass();
        Ok(None)
    }

    /// From which candidate of the knot before, and the cost so far.
    fn cheapest_way(&self, cylinders: &Cylinders<T>, pitch: T) -> Option<(u8, T)> {
        let evenness = T::from_f64(EVENNESS_PER_M * (K - 1) as f64);
        let mut best: Option<(u8, T)> = None;
        for (index, from) in (0..).zip(&self.front) {
            let Some(from) = from else { continue };
            let turn = pitch - from.pitch;
            if turn > self.request.turn_per_knot || turn < -self.request.turn_per_knot {
                continue;
            }
            let [boom, arm, bucket] = self.effort.shares(&from.cylinders, cylinders);
            let uneven = |cost: T, by: T| cost * (if by < T::ZERO { -by } else { by });
            let squares = uneven(boom, cylinders.boom - from.cylinders.boom)
                + uneven(arm, cylinders.arm - from.cylinders.arm)
                + uneven(bucket, cylinders.bucket - from.cylinders.bucket);
            let cost = from.cost + (boom + (arm + bucket)) + evenness * squares;
            if best.is_none_or(|(_, least)| cost < least) {
                best = Some((index, cost));
            }
        }
        best
    }

    /// The cheapest end's profile becomes the next grid's middle.
    fn trace_back(&mut self) {
        let mut best: Option<(u8, T)> = None;
        for (index, end) in (0..).zip(&self.front) {
            if let Some(end) = end
                && best.is_none_or(|(_, least)| end.cost < least)
            {
                best = Some((index, end.cost));
            }
        }
        let Some((mut index, _)) = best else { return };
        let old = self.centres;
        for knot in (1..K).rev() {
            let (Some(&centre), Some(ways)) = (old.get(knot), self.came_from.get(knot)) else { return };
            let pitch = self.candidate(centre, i32::from(index) - SIDE);
            if let Some(slot) = self.centres.get_mut(knot) {
                *slot = pitch;
            }
            index = ways.get(usize::from(index)).copied().unwrap_or(0);
        }
    }

    fn plan(&self, machine: &Machine<T>) -> Option<PitchPlan<T, K>> {
        profile(machine, &self.request, &self.effort, &self.centres, |_| true)
    }
}

/// A given profile of pitches as a plan; `None` where it leaves reach, stroke, `allowed`, the rule or the turn per knot.
///
/// ```
/// # use kinematics_core::planning::effort::Effort;
/// # use kinematics_core::planning::pitch_plan::{PathMove, profile};
/// # use kinematics_core::planning::pitch_rule::PitchRule;
/// # use kinematics_core::planning::tip_path::TipPath;
/// # use kinematics_core::{Machine, PinGeometry, Vec2};
/// let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI).unwrap();
/// let path = TipPath::<f64, 5>::line(Vec2::new(2.6, -0.5), Vec2::new(2.2, -0.5));
/// let request = PathMove { path, start_pitch_turns: -0.3, rule: PitchRule::Free, turn_per_knot: 0.02 };
/// let effort = Effort::travel([1.0; 3]).unwrap();
/// let kept = profile(&machine, &request, &effort, &[-0.3; 5], |_| true).unwrap();
/// assert_eq!(kept.cost, effort.along(&kept.cylinders));
/// assert!(profile(&machine, &request, &effort, &[-0.3, -0.3, -0.2, -0.3, -0.3], |_| true).is_none());
/// ```
pub fn profile<T: Real, const K: usize>(
    machine: &Machine<T>,
    request: &PathMove<T, K>,
    effort: &Effort<T>,
    pitch_turns: &[T; K],
    allowed: impl Fn(&Joints<T>) -> bool,
) -> Option<PitchPlan<T, K>> {
    let mut cylinders = [Cylinders { boom: T::ZERO, arm: T::ZERO, bucket: T::ZERO }; K];
    let mut last = request.start_pitch_turns;
    for ((&at, &pitch), slot) in request.path.knots().iter().zip(pitch_turns).zip(&mut cylinders) {
        let turn = pitch - last;
        let turns = turn <= request.turn_per_knot && turn >= -request.turn_per_knot;
        if !(turns && request.rule.allows(pitch, request.start_pitch_turns)) {
            return None;
        }
        *slot = place(machine, at, pitch, &allowed)?;
        last = pitch;
    }
    let cost = effort.along(&cylinders);
    Some(PitchPlan { pitch_turns: *pitch_turns, cylinders, cost })
}

/// Plans in one go. Where the minimum-norm profile keeps to everything too and costs less than the planner's, the finer passes are
/// done about that one as well, and the cheapest of the three is taken.
///
/// ```
/// # use kinematics_core::planning::effort::Effort;
/// # use kinematics_core::planning::pitch_plan::{PathMove, PlanError, plan_path};
/// # use kinematics_core::planning::pitch_rule::PitchRule;
/// # use kinematics_core::planning::tip_path::TipPath;
/// # use kinematics_core::{Machine, PinGeometry, Vec2};
/// let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI).unwrap();
/// let path = TipPath::<f64, 17>::line(Vec2::new(2.6, -0.5), Vec2::new(1.8, -0.5));
/// let request = PathMove { path, start_pitch_turns: -0.3, rule: PitchRule::Free, turn_per_knot: 0.02 };
/// let effort = Effort::travel([1.0; 3]).unwrap();
/// let free = plan_path(&machine, &request, &effort, |_| true).unwrap();
/// let fixed = PathMove { rule: PitchRule::Fixed(-0.3), ..request };
/// assert!(free.cost < plan_path(&machine, &fixed, &effort, |_| true).unwrap().cost);
/// assert_eq!(plan_path(&machine, &request, &effort, |_| false), Err(PlanError::Start));
/// ```
///
/// # Errors
/// [`PlanError`].
pub fn plan_path<T: Real, const K: usize>(
    machine: &Machine<T>,
    request: &PathMove<T, K>,
    effort: &Effort<T>,
    allowed: impl Fn(&Joints<T>) -> bool,
) -> Result<PitchPlan<T, K>, PlanError> {
    // By reference from where it was made: moved out, the stack may hold it twice.
    let mut planner = PitchPlanner::new(machine, request, *effort, &allowed);
    let planner = planner.as_mut().map_err(|error| *error)?;
    let mut found = None;
    for _ in 0..PitchPlanner::<T, K>::STEPS {
        found = planner.step(machine, &allowed)?;
    }
    let found = found.ok_or(PlanError::NoWay { knot: K - 1 })?;
    let usual = minimum_norm_pitches(machine, &request.path, request.start_pitch_turns)
        .and_then(|pitches| profile(machine, request, effort, &pitches, &allowed));
    let Some(usual) = usual.filter(|usual| usual.cost < found.cost) else { return Ok(found) };
    planner.begin_about(&usual.pitch_turns);
    let mut refined = None;
    for _ in 0..PitchPlanner::<T, K>::STEPS - (K - 1) {
        // Out of the rule by rounding it may lead nowhere; then it stands as it is.
        let Ok(step) = planner.step(machine, &allowed) else { return Ok(usual) };
        refined = step;
    }
    Ok(refined.filter(|refined| refined.cost < usual.cost).unwrap_or(usual))
}

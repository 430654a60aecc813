//! Point to point: of all pitches at the goal, the one that costs the machine least to get there.
//!
//! Every path on which no cylinder turns back costs the same ([`crate::planning::effort`]), so the way is the straight line in cylinder
//! space, which stays within the strokes, and what is left is one number, the pitch at the end: G pitches over the rule's
//! range, then a golden-section search about the best of them, in a fixed number of steps. The cost has kinks where a
//! cylinder need not move, and the minimum often stands on one; golden section asks for no slope.

use crate::planning::effort::Effort;
use crate::planning::pitch_plan::{PlanError, place};
use crate::planning::pitch_rule::PitchRule;
use crate::{Cylinders, Joints, Machine, Real, Vec2};

/// Pitches tried over the rule's range.
const GRID: i32 = 128;

/// Steps of the golden section: each leaves 0.618 of the bracket, 28 leave 1.4e-6.
const SECTIONS: u32 = 28;

/// Configurations tried on the way.
const ON_THE_WAY: i32 = 16;

/// The cheapest end of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeastEffort<T> {
    /// Pitch at the end, turns.
    pub pitch_turns: T,
    /// Cylinder lengths at the end, m.
    pub cylinders: Cylinders<T>,
    /// The functional on the straight way there.
    pub cost: T,
}

/// A configuration on the straight way from one to another; `share` 0 at the start, 1 at the end.
///
/// ```
/// use kinematics_core::Cylinders;
/// use kinematics_core::planning::least_effort::on_the_way;
/// let at = |boom| Cylinders { boom, arm: 1.0, bucket: 1.0 };
/// assert_eq!(on_the_way(&at(1.0), &at(2.0), 0.25), at(1.25));
/// ```
pub fn on_the_way<T: Real>(from: &Cylinders<T>, to: &Cylinders<T>, share: T) -> Cylinders<T> {
    let between = |from: T, to: T| from + share * (to - from);
    Cylinders {
        boom: between(from.boom, to.boom),
        arm: between(from.arm, to.arm),
        bucket: between(from.bucket, to.bucket),
    }
}

/// The end configuration with the tip at `goal` (reach, height) that costs least from `from`, of those whose straight way is
/// `allowed` at 16 places along it, the end among them.
///
/// ```
/// use kinematics_core::planning::effort::Effort;
/// use kinematics_core::planning::least_effort::least_effort;
/// use kinematics_core::planning::pitch_plan::PlanError;
/// use kinematics_core::planning::pitch_rule::PitchRule;
/// use kinematics_core::{Cylinders, Machine, PinGeometry, Vec2};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
/// let from = Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 };
/// let goal = Vec2::new(2.4, 0.2);
/// let effort = Effort::travel([1.0; 3])?;
/// let free = least_effort(&machine, &from, goal, PitchRule::Free, &effort, |_| true)?;
/// let fixed = least_effort(&machine, &from, goal, PitchRule::Fixed(-0.25), &effort, |_| true)?;
/// assert!(free.cost < fixed.cost);
/// assert_eq!(free.cost, effort.between(&from, &free.cylinders));
/// let refused = least_effort(&machine, &from, goal, PitchRule::Free, &effort, |_| false);
/// assert_eq!(refused, Err(PlanError::NoWay { knot: 1 }));
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// [`PlanError::Start`] for a start outside its stroke, [`PlanError::Question`] for bounds in the wrong order,
/// [`PlanError::NoWay`] with `knot: 1` where no pitch reaches the goal.
pub fn least_effort<T: Real>(
    machine: &Machine<T>,
    from: &Cylinders<T>,
    goal: Vec2<T>,
    rule: PitchRule<T>,
    effort: &Effort<T>,
    allowed: impl Fn(&Joints<T>) -> bool,
) -> Result<LeastEffort<T>, PlanError> {
    machine.check_strokes(from).map_err(|_| PlanError::Start)?;
    // Any whole turn does for a free pitch.
    let [lower, upper] = match rule {
        PitchRule::Free => [T::ZERO, T::ONE],
        bounded => bounded.range(T::ZERO),
    };
    let in_order = upper >= lower;
    if !in_order {
        return Err(PlanError::Question);
    }
    let search = Search { machine, from, goal, effort };
    let mut best: Option<LeastEffort<T>> = None;
    let spacing = (upper - lower) * T::from_f64(1.0 / f64::from(GRID));
    for i in 0..=GRID {
        better(&mut best, search.end(lower + T::from_i32(i) * spacing, &allowed));
    }
    let coarse = best.ok_or(PlanError::NoWay { knot: 1 })?;
    let ends = [coarse.pitch_turns - spacing, coarse.pitch_turns + spacing];
    let [mut low, mut high] = ends.map(|x| super::pitch_rule::within(x, lower, upper));
    let golden = T::from_f64(0.618_033_988_749_894_9);
    for _ in 0..SECTIONS {
        let reach = golden * (high - low);
        let [left, right] = [high - reach, low + reach].map(|pitch| search.end(pitch, &allowed));
        // A place that is not allowed costs more than any that is; where neither is, towards the best known.
        let towards_left = match (&left, &right) {
            (Some(left), Some(right)) => left.cost < right.cost,
            (Some(_), None) => true,
            (None, Some(_)) => false,
            (None, None) => best.is_some_and(|best| best.pitch_turns < T::from_f64(0.5) * (low + high)),
        };
        if towards_left {
            high = low + reach
        } else {
            low = high - reach
        }
        better(&mut best, left);
        better(&mut best, right);
    }
    best.ok_or(PlanError::NoWay { knot: 1 })
}

fn better<T: Real>(best: &mut Option<LeastEffort<T>>, found: Option<LeastEffort<T>>) {
    if let Some(found) = found
        && best.is_none_or(|best| found.cost < best.cost)
    {
        *best = Some(found);
    }
}

struct Search<'a, T> {
    machine: &'a Machine<T>,
    from: &'a Cylinders<T>,
    goal: Vec2<T>,
    effort: &'a Effort<T>,
}

impl<T: Real> Search<'_, T> {
    /// The end at this pitch, if it and the way there are allowed.
    fn end(&self, pitch_turns: T, allowed: impl Fn(&Joints<T>) -> bool) -> Option<LeastEffort<T>> {
        let cylinders = place(self.machine, self.goal, pitch_turns, &allowed)?;
        for i in 1..ON_THE_WAY {
            let share = T::from_i32(i) * T::from_f64(1.0 / f64::from(ON_THE_WAY));
            let joints = self.machine.cylinders_to_joints(&on_the_way(self.from, &cylinders, share)).ok()?;
            if !allowed(&joints) {
                return None;
            }
        }
        Some(LeastEffort { pitch_turns, cylinders, cost: self.effort.between(self.from, &cylinders) })
    }
}

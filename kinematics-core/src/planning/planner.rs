//! Park 2008 (12) as an iteration from a pose to a point: one step, and a bounded run of them.

use core::fmt;

use super::obstacle::{Critical, Obstacle, critical_points, nearest};
use super::park::{Direction, link_jacobian, link_velocities, moved, null_term};
use crate::chain_n::PlanarChain;
use crate::redundancy::{damped_rates, null_projector};
use crate::{Real, Rotor, Vec2};

/// How often a step that would come too near the obstacle is halved before it is not taken.
const HALVINGS: u32 = 6;
/// The rates are turned aside a little before `keep_m`, so that a finite step that touches does not enter.
const ASIDE: f64 = 1.05;
/// Passes over the links while their rates give way: two links may touch at once.
const PASSES: u32 = 8;

/// The gains of Park (12) and what the iteration needs beside them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannerParameters<T, const N: usize> {
    /// s_e of the end effector's task, above 0, at most 1: the part of the way to the target taken in one iteration.
    pub end_effector: T,
    /// s_o of the obstacle's task, 0…1; at 0 the obstacle is not there.
    pub obstacle: T,
    /// s_k of each link's task, 0…1.
    pub links: [T; N],
    /// D of each link.
    pub directions: [Direction; N],
    /// Singular values are inverted as they stand from this on, m, above 0.
    pub trusted_m: T,
    /// The most a joint turns in one iteration, rad, above 0, at most 1.
    pub turn_rad: T,
    /// The target is reached within this, m, above 0.
    pub tolerance_m: T,
}

/// The first parameter out of its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlannerError {
    /// s_e.
    EndEffector,
    /// s_o.
    Obstacle,
    /// s_k.
    Links,
    /// `trusted_m`.
    Trusted,
    /// `turn_rad`.
    Turn,
    /// `tolerance_m`.
    Tolerance,
}

impl fmt::Display for PlannerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::EndEffector => "`end_effector` must be above 0 and at most 1",
            Self::Obstacle => "`obstacle` must be within 0…1",
            Self::Links => "every one of `links` must be within 0…1",
            Self::Trusted => "`trusted_m` must be within 1e-6…1e6",
            Self::Turn => "`turn_rad` must be above 0 and at most 1",
            Self::Tolerance => "`tolerance_m` must be above 0 and finite",
        })
    }
}

impl core::error::Error for PlannerError {}

/// One iteration's result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<T, const N: usize> {
    /// The pose after it.
    pub joints: [Rotor<T>; N],
    /// What it turned each joint by, rad.
    pub change: [T; N],
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome<T> {
    /// From this iteration on the tip stayed within the tolerance of the target.
    Reached {
        /// Counted from 1; 0 when it began there.
        iterations: u32,
    },
    /// After the last iteration the tip was outside the tolerance.
    NotReached {
        /// Its distance from the target, m.
        distance_m: T,
    },
}

/// Park 2008 (12) on a planar chain.
///
/// ```
/// use kinematics_core::chain_n::PlanarChain;
/// use kinematics_core::planning::park::Direction;
/// use kinematics_core::planning::planner::{Outcome, Planner, PlannerParameters};
/// use kinematics_core::{Rotor, Vec2};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let planner = Planner::new(PlanarChain::new([1.0f64, 1.0, 1.0, 1.0]), PlannerParameters {
///     end_effector: 0.3, obstacle: 0.0, links: [0.0; 4], directions: [Direction::Add; 4],
///     trusted_m: 0.05, turn_rad: 0.3, tolerance_m: 0.01,
/// })?;
/// let start = [30.0, 30.0, 30.0, 30.0].map(Rotor::from_degrees);
/// let target = Vec2::new(1.5, 1.5);
/// assert!(matches!(planner.run(&start, target, None, 50, |_, _| ()), Outcome::Reached { .. }));
/// let after = planner.step(&start, target, None);
/// let distance = |joints| (planner.chain().tip(joints) - target).norm();
/// assert!(distance(&after.joints) < distance(&start));
/// // Beyond reach is a value.
/// let far = planner.run(&start, Vec2::new(5.0, 0.0), None, 50, |_, _| ());
/// assert!(matches!(far, Outcome::NotReached { distance_m } if distance_m > 0.99));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planner<T, const N: usize> {
    chain: PlanarChain<T, N>,
    parameters: PlannerParameters<T, N>,
}

impl<T: Real, const N: usize> Planner<T, N> {
    /// Checks the parameters once.
    ///
    /// # Errors
    /// The first one out of its range.
    pub fn new(chain: PlanarChain<T, N>, parameters: PlannerParameters<T, N>) -> Result<Self, PlannerError> {
        let p = &parameters;
        // Written so that NaN fails.
        let gain = |s: T| s >= T::ZERO && s <= T::ONE;
        let checks = [
            (gain(p.end_effector) && p.end_effector > T::ZERO, PlannerError::EndEffector),
            (gain(p.obstacle), PlannerError::Obstacle),
            (p.links.iter().all(|&s| gain(s)), PlannerError::Links),
            (p.trusted_m >= T::from_f64(1e-6) && p.trusted_m <= T::from_f64(1e6), PlannerError::Trusted),
            (gain(p.turn_rad) && p.turn_rad > T::ZERO, PlannerError::Turn),
            (p.tolerance_m > T::ZERO && p.tolerance_m * T::ZERO == T::ZERO, PlannerError::Tolerance),
        ];
        match checks.into_iter().find(|(good, _)| !good) {
            Some((_, error)) => Err(error),
            None => Ok(Self { chain, parameters }),
        }
    }

    /// The chain.
    pub fn chain(&self) -> &PlanarChain<T, N> {
        &self.chain
    }

    /// One iteration from `joints` towards `target` (m).
    ///
    /// The sum of (12), scaled so that no joint turns more than `turn_rad`; then the obstacle goes first: where a link would come
    /// nearer by more than half of what is left to `keep_m` (and a twentieth more), the smallest change of the rates prevents it. All
    /// terms but s_e's own leave the tip where it is, so (12) alone would take the tip through the obstacle. A step that would still
    /// enter `keep_m` is halved, at most five times; then, as where a rate is not finite, the arm stays.
    pub fn step(&self, joints: &[Rotor<T>; N], target: Vec2<T>, obstacle: Option<&Obstacle<T>>) -> Step<T, N> {
        let obstacle = obstacle.filter(|_| self.parameters.obstacle > T::ZERO);
        let ends = self.chain.ends(joints);
        let critical = obstacle.map(|obstacle| (obstacle, nearest(&ends, obstacle.position)));
        let mut change = self.sum(joints, &ends, target, critical.as_ref());
        self.limit(&mut change);
        if let Some((obstacle, _)) = critical {
            give_way(&mut change, &ends, obstacle);
        }
        let finite = change.iter().all(|&c| c * T::ZERO == T::ZERO);
        for _ in (0..HALVINGS).filter(|_| finite) {
            let next = turned(joints, &change);
            let free = critical.is_none_or(|(obstacle, before)| {
                let after = nearest(&self.chain.ends(&next), obstacle.position).distance_m;
                after >= obstacle.keep_m || after > before.distance_m
            });
            if free {
                return Step { joints: next, change };
            }
            change = change.map(|c| T::from_f64(0.5) * c);
        }
        Step { joints: *joints, change: [T::ZERO; N] }
    }

    /// `iterations` of [`Planner::step`]; `each` sees every step and its number, from 1.
    pub fn run(
        &self,
        start: &[Rotor<T>; N],
        target: Vec2<T>,
        obstacle: Option<&Obstacle<T>>,
        iterations: u32,
        mut each: impl FnMut(u32, &Step<T, N>),
    ) -> Outcome<T> {
        let away = |joints: &[Rotor<T>; N]| (target - self.chain.tip(joints)).norm();
        let mut joints = *start;
        let mut distance_m = away(&joints);
        let mut since = 0;
        for iteration in 1..=iterations {
            let step = self.step(&joints, target, obstacle);
            each(iteration, &step);
            joints = step.joints;
            let before = distance_m;
            distance_m = away(&joints);
            if distance_m <= self.parameters.tolerance_m && before > self.parameters.tolerance_m {
                since = iteration;
            }
        }
        if distance_m <= self.parameters.tolerance_m {
            Outcome::Reached { iterations: since }
        } else {
            Outcome::NotReached { distance_m }
        }
    }

    /// Park (12), rad.
    fn sum(
        &self,
        joints: &[Rotor<T>; N],
        ends: &[Vec2<T>; N],
        target: Vec2<T>,
        critical: Option<&(&Obstacle<T>, Critical<T>)>,
    ) -> [T; N] {
        let p = &self.parameters;
        let (tip, jacobian) = self.chain.tip_and_jacobian(joints);
        let way = target - tip;
        let own = damped_rates(&jacobian, way, &[T::ZERO; N], &[T::ONE; N], p.trusted_m).joints;
        let mut sum = own.map(|rate| p.end_effector * rate);
        // A stretched arm has no null space to speak of.
        let Some(projector) = null_projector(&jacobian) else { return sum };
        let mut add = |gain: T, term: [T; N]| {
            for (sum, rate) in sum.iter_mut().zip(term) {
                *sum = *sum + gain * rate;
            }
        };
        if let Some((obstacle, critical)) = critical.filter(|(o, c)| c.distance_m < o.acts_m) {
            let jo = link_jacobian(ends, critical.link, critical.point);
            add(p.obstacle, null_term(&jo, obstacle.escape(critical), &projector, &own, p.trusted_m));
        }
        let velocities = link_velocities(ends, way, &own, &p.directions);
        for (k, ((&velocity, &gain), &end)) in velocities.iter().zip(&p.links).zip(ends).enumerate() {
            if gain > T::ZERO {
                add(gain, null_term(&link_jacobian(ends, k, end), velocity, &projector, &own, p.trusted_m));
            }
        }
        sum
    }

    fn limit(&self, change: &mut [T; N]) {
        let most = change.iter().fold(T::ZERO, |most, &c| {
            let size = if c < T::ZERO { -c } else { c };
            if size > most { size } else { most }
        });
        if most > self.parameters.turn_rad {
            *change = change.map(|c| c * (self.parameters.turn_rad / most));
        }
    }
}

/// Takes out of `change`, by the smallest correction link after link, what brings a link too near.
fn give_way<T: Real, const N: usize>(change: &mut [T; N], ends: &[Vec2<T>; N], obstacle: &Obstacle<T>) {
    let wall = T::from_f64(ASIDE) * obstacle.keep_m;
    let links = critical_points(ends, obstacle.position);
    for _ in 0..PASSES {
        for critical in &links {
            let jacobian = link_jacobian(ends, critical.link, critical.point);
            let away = critical.away.to_vec();
            let allowed = T::from_f64(0.5) * (wall - critical.distance_m);
            let speed = moved(&jacobian, change).dot(away);
            let [reach, height] = jacobian;
            let mut row = [T::ZERO; N];
            for ((row, x), z) in row.iter_mut().zip(reach).zip(height) {
                *row = x * away.x + z * away.z;
            }
            let square = row.iter().fold(T::ZERO, |sum, &r| sum + r * r);
            let by = (allowed - speed) / square;
            // A link that cannot turn its point away has no say.
            if speed < allowed && by * T::ZERO == T::ZERO {
                for (change, r) in change.iter_mut().zip(row) {
                    *change = *change + r * by;
                }
            }
        }
    }
}

/// The pose with every joint turned on, rad.
fn turned<T: Real, const N: usize>(joints: &[Rotor<T>; N], change: &[T; N]) -> [Rotor<T>; N] {
    let mut out = *joints;
    for (joint, &by) in out.iter_mut().zip(change) {
        *joint = (*joint * Rotor::from_angle(by)).renormalised();
    }
    out
}

//! One planning step past obstacles: joint rates towards an aim, within speed limits and travel, closing in on no sphere faster
//! than the distance allows. Park 2008 (12) for the whole backhoe, swing included, with its gains by rule.
//!
//! Park adds `s_e·J⁺ẋ`, `s_o·H_o` and `Σ s_k·H_k` with gains chosen by hand. Here, in the space of the joints divided by their speed limits:
//! - *End effector and directionality* (s_e, s_k): every joint goes straight to its aim, all at once: `θ̇ = Δ/max(t, settle)`, t the longest
//!   joint's time at its limit. Which aim is the choice of [`super::reach`]: that is where a joint's direction is decided.
//! - *Obstacle* (s_o): the smallest change of θ̇ that leaves `r·θ̇ ≥ −(d − stop)/approach` for the critical point's row r and
//!   distance d: nothing while far, stopped at `stop`, driven back inside. Maciejewski's term without a gain.
//! - *Singularity*: the point's largest possible speed is σ = √(r·V·rᵀ), V the squared speed limits. Below the trusted speed s the
//!   quotient is damped by λ² = s² − σ², so that a point that joints can hardly move asks for no more than they can.
//! - *Speed and travel*: one common factor for all joints; a joint closes in on its limit no faster than on an obstacle.
//!
//! Last a common factor sees to the distance again, whatever the changes before it did: the step keeps away or stands still.

use core::fmt;

use super::hull::{Hull, Near, Placed, SEGMENTS, Sphere};
use super::joint_line::{Travel, turn, turned};
use crate::error::Cylinder;
use crate::geometry::{BoomCylinder, PinGeometry, Stroke};
use crate::linkages::Linkages;
use crate::sector::Sector;
use crate::{Real, Rotor};

/// Changes for every obstacle, one after the other, so often.
const PASSES: usize = 3;

/// What is wrong with the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AvoidError {
    /// A speed limit is not above 0 or not finite.
    Speed {
        /// The joint, swing first, counted from 0.
        joint: usize,
    },
    /// A distance or time is not above 0 or not finite.
    NotPositive {
        /// The field.
        field: &'static str,
    },
    /// A joint's travel is empty or a full turn.
    Travel,
}

impl fmt::Display for AvoidError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Speed { joint } => write!(f, "`speeds_rad_s` of joint {joint} must be finite and above 0"),
            Self::NotPositive { field } => write!(f, "`{field}` must be finite and above 0"),
            Self::Travel => f.write_str("a joint's travel must be more than nothing and less than a full turn"),
        }
    }
}

impl core::error::Error for AvoidError {}

/// Parameters of [`Avoid`]: what the machine and its valves can, not what a scene needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AvoidParameters {
    /// Speed limits of swing, boom, arm, bucket, rad/s.
    pub speeds_rad_s: [f64; 4],
    /// The distance at which an approach has come to rest, m.
    pub stop_m: f64,
    /// Time constant of an approach, s: several times the actuators' lag.
    pub approach_s: f64,
    /// Time constant of the arrival at an aim, s.
    pub settle_s: f64,
    /// The speed of a critical point below which it is taken for hardly movable, m/s.
    pub trusted_mps: f64,
}

impl AvoidParameters {
    /// The rule: lengths from the machine's reach, times from the actuators (0.1 s of lag), nothing from the scene.
    ///
    /// ```
    /// use kinematics_core::planning::avoid::AvoidParameters;
    /// assert_eq!(AvoidParameters::of_reach(10.0, [1.0; 4]).stop_m, 0.1);
    /// ```
    pub fn of_reach(reach_m: f64, speeds_rad_s: [f64; 4]) -> Self {
        Self { speeds_rad_s, stop_m: 0.01 * reach_m, approach_s: 0.3, settle_s: 0.25, trusted_mps: 0.02 * reach_m }
    }
}

impl AvoidParameters {
    /// For actuators that follow so late, s (dead time and lag), if that is more than the tenth of a second of
    /// [`AvoidParameters::of_reach`]. A first-order approach seen τ late overshoots unless its time constant is at least e·τ: here 3·τ.
    ///
    /// ```
    /// use kinematics_core::planning::avoid::AvoidParameters;
    /// let late = AvoidParameters::of_reach(10.0, [1.0; 4]).with_delay(0.2);
    /// assert!((late.approach_s - 0.6).abs() < 1e-12 && (late.settle_s - 0.6).abs() < 1e-12);
    /// ```
    pub fn with_delay(self, delay_s: f64) -> Self {
        if delay_s > 0.1 { Self { approach_s: 3.0 * delay_s, settle_s: 3.0 * delay_s, ..self } } else { self }
    }
}

/// The step's constants for one machine.
///
/// ```
/// use kinematics_core::planning::avoid::{Avoid, AvoidParameters, advanced};
/// use kinematics_core::planning::hull::{Flesh, Hull, Sphere};
/// use kinematics_core::{PinGeometry, Rotor};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let g = PinGeometry::EXACT_MINI;
/// let hull = Hull::<f64>::new(&g, Flesh::of_reach(g.reach_m()))?;
/// let avoid = Avoid::new(&g, hull, &AvoidParameters::of_reach(g.reach_m(), [1.1, 0.45, 1.1, 1.1]))?;
/// // Swing a quarter turn to the left; a ball stands half-way.
/// let pose = |swing| [swing, 20.0, -80.0, -30.0].map(Rotor::from_degrees);
/// let aim = avoid.aim(&pose(90.0));
/// assert!(avoid.within_travel(&aim));
/// let ball = Sphere { x: 1.8, y: 1.8, z: 0.3, radius: 0.3 };
/// let (mut joints, mut last) = (pose(0.0), None);
/// for _ in 0..3000 {
///     let step = avoid.step(&joints, &aim, &[ball]);
///     joints = advanced(&joints, &step.rates, 0.001);
///     assert!(avoid.clearance(&joints, &[ball]) > 0.03);
///     last = Some(step);
/// }
/// // It stands still before the ball: the way round it is the choice of `reach`.
/// assert!(last.is_some_and(|step| step.to_go_s > 0.3));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Avoid<T> {
    pub(crate) hull: Hull<T>,
    pub(crate) travels: [Travel<T>; 3],
    /// `None` turns all round.
    pub(crate) swing: Option<Travel<T>>,
    pub(crate) speeds: [T; 4],
    pub(crate) stop: T,
    per_approach: T,
    settle: T,
    trusted_square: T,
}

/// Where the joints shall go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim<T> {
    pub(crate) swing: Rotor<T>,
    /// Places of boom, arm, bucket on their travel.
    pub(crate) places: [T; 3],
}

/// Where the joints and the obstacles are at one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Survey<T, const N: usize> {
    joints: [Rotor<T>; 4],
    near: [[Near<T>; SEGMENTS]; N],
}

impl<T: Real, const N: usize> Survey<T, N> {
    /// Of nothing yet.
    pub(crate) const fn none() -> Self {
        let zero = Near { distance: T::ZERO, row: [T::ZERO; 4] };
        Self { joints: [Rotor::IDENTITY; 4], near: [[zero; SEGMENTS]; N] }
    }
}

/// Rates on their way to what a step says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Choosing<T> {
    here: Aim<T>,
    rates: [T; 4],
    to_go_s: T,
}

/// What one step says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<T> {
    /// Rates of swing, boom, arm, bucket, rad/s.
    pub rates: [T; 4],
    /// The longest joint's time to the aim at its speed limit, s.
    pub to_go_s: T,
    /// The smallest distance between hull and obstacles, m; without obstacles a kilometre.
    pub clearance: T,
    /// The fastest joint's rate as a share of its limit: near 0 away from the aim the step is stuck.
    pub pace: T,
}

fn dot<T: Real>([a, b, c, d]: &[T; 4], [x, y, z, w]: &[T; 4]) -> T {
    (*a * *x + *b * *y) + (*c * *z + *d * *w)
}

fn magnitude<T: Real>(x: T) -> T {
    if x < T::ZERO { -x } else { x }
}

impl<T: Real> Avoid<T> {
    /// The step of a validated machine. Its swing turns all round unless the machine has a swing cylinder.
    ///
    /// # Errors
    /// The first parameter out of its range.
    pub fn new(geometry: &PinGeometry, hull: Hull<T>, p: &AvoidParameters) -> Result<Self, AvoidError> {
        let usable = |x: f64| x > 0.0 && x < 1e6;
        if let Some(joint) = p.speeds_rad_s.iter().position(|&s| !usable(s)) {
            return Err(AvoidError::Speed { joint });
        }
        let named = [
            ("stop_m", p.stop_m),
            ("approach_s", p.approach_s),
            ("settle_s", p.settle_s),
            ("trusted_mps", p.trusted_mps),
        ];
        if let Some((field, _)) = named.into_iter().find(|&(_, x)| !usable(x)) {
            return Err(AvoidError::NotPositive { field });
        }
        let (travels, swing) = travels(geometry).ok_or(AvoidError::Travel)?;
        Ok(Self {
            hull,
            travels: travels.map(rounded),
            swing: swing.map(rounded),
            speeds: p.speeds_rad_s.map(T::from_f64),
            stop: T::from_f64(p.stop_m),
            per_approach: T::from_f64(1.0 / p.approach_s),
            settle: T::from_f64(p.settle_s),
            trusted_square: T::from_f64(p.trusted_mps * p.trusted_mps),
        })
    }

    /// The aim at these joints: swing, boom, arm, bucket.
    #[inline]
    pub fn aim(&self, joints: &[Rotor<T>; 4]) -> Aim<T> {
        let [swing, planar @ ..] = joints;
        Aim { swing: *swing, places: self.places(planar) }
    }

    #[inline(always)]
    fn places(&self, planar: &[Rotor<T>; 3]) -> [T; 3] {
        let [boom, arm, bucket] = &self.travels;
        let [b, a, k] = planar;
        [boom.place(*b), arm.place(*a), bucket.place(*k)]
    }

    /// Whether boom, arm and bucket lie within their travel, and the swing within its own.
    #[inline]
    pub fn within_travel(&self, aim: &Aim<T>) -> bool {
        let planar = self.travels.iter().zip(aim.places).all(|(travel, place)| travel.contains(place));
        planar && self.swing.is_none_or(|travel| travel.contains(travel.place(aim.swing)))
    }

    /// What each joint lacks of its aim, rad.
    #[inline(always)]
    pub(crate) fn lack(&self, from: &Aim<T>, to: &Aim<T>) -> [T; 4] {
        let swing = match self.swing {
            // Between stops there is one way only.
            Some(travel) => travel.place(to.swing) - travel.place(from.swing),
            None => turn(to.swing * from.swing.inverse()),
        };
        let ([b, a, k], [boom, arm, bucket]) = (from.places, to.places);
        [swing, boom - b, arm - a, bucket - k]
    }

    /// The longest joint's time at its limit, s.
    #[inline(always)]
    pub(crate) fn time(&self, lack: &[T; 4]) -> T {
        lack.iter().zip(&self.speeds).fold(T::ZERO, |longest, (&lack, &speed)| {
            let time = magnitude(lack) / speed;
            if time > longest { time } else { longest }
        })
    }

    /// The hull's smallest distance from the obstacles, m.
    #[inline(never)]
    pub fn clearance<const N: usize>(&self, joints: &[Rotor<T>; 4], obstacles: &[Sphere<T>; N]) -> T {
        smallest(&nearest(&self.hull.place(joints), obstacles))
    }

    /// One step from `joints` (swing, boom, arm, bucket) towards the aim.
    pub fn step<const N: usize>(&self, joints: &[Rotor<T>; 4], aim: &Aim<T>, obstacles: &[Sphere<T>; N]) -> Step<T> {
        // All in one piece: half again as quick as the two halves the loop shares with rehearsal.
        let placed = self.hull.place(joints);
        let near = obstacles.each_ref().map(|sphere| placed.near_inlined(sphere));
        self.rates(&Survey { joints: *joints, near }, aim)
    }

    /// The first half of a step: where everything is. One copy of it: rehearsal and motion share it. It fills in place: copying
    /// what it finds would cost more than finding it.
    #[inline(never)]
    pub(crate) fn survey<const N: usize>(
        &self,
        joints: &[Rotor<T>; 4],
        obstacles: &[Sphere<T>; N],
        survey: &mut Survey<T, N>,
    ) {
        survey.joints = *joints;
        let placed = self.hull.place(joints);
        for (near, sphere) in survey.near.iter_mut().zip(obstacles) {
            placed.near_into(sphere, near);
        }
    }

    /// The second half: the rates.
    pub(crate) fn choose<const N: usize>(&self, survey: &Survey<T, N>, aim: &Aim<T>) -> Step<T> {
        self.settle(survey, self.head(survey, aim))
    }

    /// The first part of [`Self::choose`]: towards the aim, and all passes but the last.
    #[inline(never)]
    pub(crate) fn head<const N: usize>(&self, survey: &Survey<T, N>, aim: &Aim<T>) -> Choosing<T> {
        let mut choosing = self.towards(survey, aim);
        self.passes(survey, PASSES - 1, &mut choosing);
        choosing
    }

    /// The rest of [`Self::choose`].
    #[inline(never)]
    pub(crate) fn settle<const N: usize>(&self, survey: &Survey<T, N>, mut choosing: Choosing<T>) -> Step<T> {
        self.passes(survey, 1, &mut choosing);
        self.settled(survey, choosing)
    }

    #[inline(always)]
    fn rates<const N: usize>(&self, survey: &Survey<T, N>, aim: &Aim<T>) -> Step<T> {
        let mut choosing = self.towards(survey, aim);
        self.passes(survey, PASSES, &mut choosing);
        self.settled(survey, choosing)
    }

    /// Straight towards the aim.
    #[inline(always)]
    fn towards<const N: usize>(&self, survey: &Survey<T, N>, aim: &Aim<T>) -> Choosing<T> {
        let here = self.aim(&survey.joints);
        let lack = self.lack(&here, aim);
        let to_go_s = self.time(&lack);
        let per_time = T::ONE / if to_go_s > self.settle { to_go_s } else { self.settle };
        Choosing { here, rates: lack.map(|lack| lack * per_time), to_go_s }
    }

    /// Gives way to every obstacle and every end of travel, so often.
    #[inline(always)]
    fn passes<const N: usize>(&self, survey: &Survey<T, N>, often: usize, choosing: &mut Choosing<T>) {
        let mobility = self.speeds.map(|speed| speed * speed);
        for _ in 0..often {
            for near in survey.near.iter().flatten() {
                self.give_way(near, &mobility, &mut choosing.rates);
            }
            self.keep_travel(&choosing.here, &mut choosing.rates);
        }
    }

    #[inline(always)]
    fn settled<const N: usize>(&self, survey: &Survey<T, N>, choosing: Choosing<T>) -> Step<T> {
        let Choosing { mut rates, to_go_s, .. } = choosing;
        self.slow_down(&survey.near, &mut rates);
        Step { rates, to_go_s, clearance: smallest(&survey.near), pace: self.pace(&rates) }
    }

    /// How fast the distance may shrink, m/s.
    #[inline(always)]
    fn approach(&self, near: &Near<T>) -> T {
        (near.distance - self.stop) * self.per_approach
    }

    /// The smallest change, in shares of the speed limits, after which the distance shrinks no faster than it may.
    #[inline(always)]
    fn give_way(&self, near: &Near<T>, mobility: &[T; 4], rates: &mut [T; 4]) {
        let missing = -self.approach(near) - dot(&near.row, rates);
        if missing > T::ZERO {
            let [s, b, a, k] = near.row;
            let [vs, vb, va, vk] = *mobility;
            let moved = [s * vs, b * vb, a * va, k * vk];
            let square = dot(&near.row, &moved);
            let inverted = if square > self.trusted_square { square } else { self.trusted_square };
            let effort = missing / inverted;
            for (rate, moved) in rates.iter_mut().zip(moved) {
                *rate = *rate + moved * effort;
            }
        }
    }

    /// No joint closes in on its limit faster than it may.
    #[inline(always)]
    fn keep_travel(&self, here: &Aim<T>, rates: &mut [T; 4]) {
        let [swing, planar @ ..] = rates;
        if let Some(travel) = self.swing {
            *swing = self.within(travel.half, travel.place(here.swing), *swing);
        }
        for ((rate, travel), place) in planar.iter_mut().zip(&self.travels).zip(here.places) {
            *rate = self.within(travel.half, place, *rate);
        }
    }

    #[inline(always)]
    fn within(&self, half: T, place: T, rate: T) -> T {
        let (up, down) = ((half - place) * self.per_approach, -(half + place) * self.per_approach);
        if rate > up {
            up
        } else if rate < down {
            down
        } else {
            rate
        }
    }

    #[inline(always)]
    fn pace(&self, rates: &[T; 4]) -> T {
        self.time(rates)
    }

    /// One factor for all joints: within the speed limits, and closing in on nothing faster than it may.
    #[inline(always)]
    fn slow_down<const N: usize>(&self, near: &[[Near<T>; SEGMENTS]; N], rates: &mut [T; 4]) {
        let pace = self.pace(rates);
        let mut factor = if pace > T::ONE { T::ONE / pace } else { T::ONE };
        for near in near.iter().flatten() {
            let (closing, allowed) = (-dot(&near.row, rates), self.approach(near));
            if closing > T::ZERO && closing * factor > allowed {
                factor = if allowed > T::ZERO { allowed / closing } else { T::ZERO };
            }
        }
        *rates = rates.map(|rate| rate * factor);
    }
}

/// The joints after `dt` s at these rates.
#[inline(always)]
pub fn advanced<T: Real>(joints: &[Rotor<T>; 4], rates: &[T; 4], dt: T) -> [Rotor<T>; 4] {
    let ([s, b, a, k], [ws, wb, wa, wk]) = (*joints, *rates);
    [turned(s, ws * dt), turned(b, wb * dt), turned(a, wa * dt), turned(k, wk * dt)].map(Rotor::renormalised)
}

#[inline(always)]
fn nearest<T: Real, const N: usize>(placed: &Placed<T>, obstacles: &[Sphere<T>; N]) -> [[Near<T>; SEGMENTS]; N] {
    obstacles.each_ref().map(|sphere| placed.near(sphere))
}

#[inline(always)]
fn smallest<T: Real, const N: usize>(near: &[[Near<T>; SEGMENTS]; N]) -> T {
    near.iter()
        .flatten()
        .fold(T::from_i32(1000), |least, near| if near.distance < least { near.distance } else { least })
}

fn rounded<T: Real>(travel: Travel<f64>) -> Travel<T> {
    let Travel { middle, half } = travel;
    Travel { middle: Rotor { cos: T::from_f64(middle.cos), sin: T::from_f64(middle.sin) }, half: T::from_f64(half) }
}

/// The travel between two ends, the way round that `Sector` takes: from `first` counter-clockwise.
fn travel(first: Rotor<f64>, last: Rotor<f64>) -> Option<Travel<f64>> {
    let (middle, half_cos) = Sector::<f64>::between(first, last).middle_and_half_width_cos();
    let half = turn(last * middle.inverse());
    (half > 0.0 && half_cos > -1.0).then_some(Travel { middle, half })
}

/// Of boom, arm, bucket, and of the swing.
type Travels = ([Travel<f64>; 3], Option<Travel<f64>>);

/// Travels of boom, arm, bucket over their strokes, and of the swing cylinder's where there is one.
fn travels(g: &PinGeometry) -> Option<Travels> {
    let linkages = Linkages::new(g);
    let ends = |cylinder, stroke: Stroke| {
        Some([linkages.rotor(cylinder, stroke.min_m)?, linkages.rotor(cylinder, stroke.max_m)?])
    };
    let [boom_short, boom_long] = ends(Cylinder::Boom, g.boom.stroke)?;
    let [arm_short, arm_long] = ends(Cylinder::Arm, g.arm.stroke)?;
    let [bucket_short, bucket_long] = ends(Cylinder::Bucket, g.bucket.stroke)?;
    let raises = g.boom_cylinder == BoomCylinder::Below;
    let (low, high) = if raises { (boom_short, boom_long) } else { (boom_long, boom_short) };
    let planar = [travel(low, high)?, travel(arm_long, arm_short)?, travel(bucket_long, bucket_short)?];
    let swing = match g.swing {
        Some(pins) => {
            let [right, left] = ends(Cylinder::Swing, pins.stroke)?;
            Some(travel(right, left)?)
        }
        None => None,
    };
    Some((planar, swing))
}

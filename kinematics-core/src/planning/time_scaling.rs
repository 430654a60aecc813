//! How fast along a path: one common factor ṡ for all cylinders, so that the path is kept exactly.
//!
//! Every tick a raw speed goes up, stays or goes down by one step, as the table of speeds planned beforehand allows; ṡ is its average over the last n
//! ticks. So |s̈| ≤ a and |s⃛| ≤ a/(n·tick) by construction, provided the raw speed never turns from faster to slower
//! within n ticks: it goes up only where it could then stay n ticks, and not within n ticks of a step down. All of it is in
//! whole numbers: nothing drifts, and the last tick stands on the end.

use core::fmt;

use crate::Real;
use crate::planning::cylinder_path::CylinderPath;
use crate::planning::move_limits::Limits;
use crate::planning::speed_table::{LONGEST_AVERAGE, SpeedTable, WHOLE};

/// The path needs speeds below what the tick resolves, or the limits leave no acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoProfile;

impl fmt::Display for NoProfile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the limits leave this path no speed that a tick resolves")
    }
}

impl core::error::Error for NoProfile {}

/// Where the move stands in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress<T> {
    /// The path's parameter, 0 to 1.
    pub s: T,
    /// ṡ, 1/s: the mean over the tick that ends here.
    pub rate: T,
    /// s̈, 1/s².
    pub acceleration: T,
    /// s⃛, 1/s³.
    pub jerk: T,
    /// At rest on the end.
    pub done: bool,
}

/// Where a move stands: its last raw speeds and their sums, about 2 KiB. [`Pace::start`] is at rest at the path's start.
#[derive(Clone, Debug)]
pub struct Pace<T> {
    /// The raw speed of the last n ticks, a ring; where the next one goes.
    speeds: [u32; LONGEST_AVERAGE],
    at: usize,
    /// The raw speed dropped out of the ring last.
    dropped: u64,
    /// Where the raw speed has led.
    place: u64,
    /// Sum of the ring, and of the places of the last n ticks.
    in_ring: u64,
    places: u64,
    progress: Progress<T>,
}

impl<T: Real> Pace<T> {
    /// At rest at the start.
    pub const fn start() -> Self {
        Self {
            speeds: [0; LONGEST_AVERAGE],
            at: 0,
            dropped: 0,
            place: 0,
            in_ring: 0,
            places: 0,
            progress: Progress { s: T::ZERO, rate: T::ZERO, acceleration: T::ZERO, jerk: T::ZERO, done: false },
        }
    }

    /// Where the move stands.
    pub fn progress(&self) -> Progress<T> {
        self.progress
    }
}

/// The scaling of one path: about 3 KiB that stay where they are and as they are, so that several [`Pace`]s may share them.
///
/// ```
/// use kinematics_core::Cylinders;
/// use kinematics_core::planning::cylinder_path::CylinderPath;
/// use kinematics_core::planning::move_limits::{Limits, MoveLimits};
/// use kinematics_core::planning::time_scaling::{Pace, TimeScaling};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let limits = Limits::<f32>::new(&MoveLimits {
///     speed_mps: [[0.5; 2]; 3],
///     acceleration_mps2: [1.0; 3],
///     jerk_mps3: [10.0; 3],
///     areas_m2: [[0.0; 2]; 3],
///     flow_m3ps: 1.0,
/// })?;
/// let at = |boom| Cylinders { boom, arm: 1.0, bucket: 1.0 };
/// let path = CylinderPath::new(&[at(1.0), at(1.5), at(2.0)], &limits).ok_or("no movement")?;
/// let mut scaling = TimeScaling::standstill();
/// scaling.plan(&path, &limits, 0.001)?;
/// let mut pace = Pace::start();
/// let mut ticks = 0;
/// while !scaling.advance(&mut pace, 1.0).done {
///     ticks += 1;
/// }
/// assert_eq!(path.at(pace.progress().s).lengths.boom, 2.0);
/// // 1 m at 0.5 m/s, 0.5 s of acceleration and 0.1 s of jerk: no less than 2.6 s.
/// assert!(ticks >= 2599 && ticks < 2800, "{ticks}");
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct TimeScaling<T> {
    table: SpeedTable,
    /// From sums over the ring to s, ṡ, s̈, s⃛.
    scale: [T; 4],
}

impl<T: Real> TimeScaling<T> {
    /// Of no path: it never gets anywhere.
    pub const fn standstill() -> Self {
        Self { table: SpeedTable::STANDSTILL, scale: [T::ZERO; 4] }
    }

    /// Plans the speeds along the path, a control tick of `tick_s` seconds, in place.
    ///
    /// # Errors
    /// [`NoProfile`]: then it is of no use.
    pub fn plan<const K: usize>(
        &mut self,
        path: &CylinderPath<T, K>,
        limits: &Limits<T>,
        tick_s: f64,
    ) -> Result<(), NoProfile> {
        self.table.plan(path, limits, tick_s).ok_or(NoProfile)?;
        let s = 1.0 / (WHOLE as f64 * self.table.average() as f64);
        let per_tick = 1.0 / tick_s;
        let scale = [s, s * per_tick, s * per_tick * per_tick, s * per_tick * per_tick * per_tick];
        self.scale = scale.map(T::from_f64);
        Ok(())
    }

    /// One tick; `share` of the planned speed, 0 (come to rest) to 1, may change at any time: a pump that gives less, an
    /// operator who asks for less.
    pub fn advance(&self, pace: &mut Pace<T>, share: T) -> Progress<T> {
        let average = self.table.average();
        let leaving = pace.speeds.get(pace.at).map_or(0, |speed| u64::from(*speed));
        let before = pace.speeds.get(if pace.at == 0 { average - 1 } else { pace.at - 1 });
        let last = before.map_or(0, |speed| u64::from(*speed));
        let speed = self.next_speed(pace, last, leaving, share);

        if let Some(slot) = pace.speeds.get_mut(pace.at) {
            // Not above 2³⁰.
            *slot = speed as u32;
        }
        pace.at = if pace.at + 1 == average { 0 } else { pace.at + 1 };
        pace.place += speed;
        pace.in_ring = (pace.in_ring + speed).saturating_sub(leaving);
        pace.places += pace.in_ring;
        // Speeds are not above 2³⁰.
        let speeds = [speed, leaving, last, pace.dropped].map(|speed| speed as i32);
        let [now, left, before, dropped] = speeds;
        let [s, rate, acceleration, jerk] = self.scale;
        let done = pace.place == WHOLE && pace.in_ring == 0;
        pace.progress = Progress {
            s: if done { T::ONE } else { number::<T>(pace.places) * s },
            rate: number::<T>(pace.in_ring) * rate,
            acceleration: T::from_i32(now - left) * acceleration,
            jerk: (T::from_i32(now - before) - T::from_i32(left - dropped)) * jerk,
            done,
        };
        pace.dropped = leaving;
        pace.progress
    }

    /// The raw speed of this tick: faster, the same or slower by a step.
    fn next_speed(&self, pace: &Pace<T>, last: u64, leaving: u64, share: T) -> u64 {
        let table = &self.table;
        // In 256ths; its square in 65536ths.
        let share = (share * T::from_i32(256)).nearest_i32();
        let share = u64::from(share.clamp(0, 256).unsigned_abs());
        let slower = share * share;
        // Not above 2⁶⁰, so one of the two products fits.
        let wanted = |square: u64| if square >> 47 == 0 { (square * slower) >> 16 } else { (square >> 16) * slower };
        let left = WHOLE.saturating_sub(pace.place);
        let within = |speed: u64, limit: u64| speed * speed <= limit;
        let in_time = |speed: u64| within(speed, table.limit_square(pace.place + speed));

        // n ticks ago the speed changed from `dropped` to `leaving`.
        let (rose, fell) = (leaving > pace.dropped, leaving < pace.dropped);
        let up = last + table.step;
        let place_then = pace.place + up * (table.average() as u64 + 1);
        let could_stay = within(up, wanted(table.limit_square(place_then)))
            && within(up, wanted(table.cap_ahead_square(pace.place)));
        let speed = if !fell && could_stay {
            up
        } else if in_time(last)
            && (share == 0 || last >= table.step)
            && (rose || within(last, wanted(table.limit_square(pace.place + last))))
        {
            last
        } else {
            // Not slower than a step before the end, or it would never get there; nor up to a step soon after a step down.
            let slowest = if share == 0 {
                0
            } else if fell {
                core::cmp::min(last, table.step)
            } else {
                table.step
            };
            core::cmp::max(last.saturating_sub(table.step), slowest)
        };
        core::cmp::min(speed, left)
    }
}

/// A sum below 2⁵³ as a number: its halves are exact, so it is rounded about once. No f64, which the Cortex-M4F has not.
#[inline(always)]
fn number<T: Real>(sum: u64) -> T {
    let (high, low) = ((sum >> 30) as i32, (sum & 0x3fff_ffff) as i32);
    T::from_i32(high) * T::from_i32(1 << 30) + T::from_i32(low)
}

//! Planning time: how fast the parameter may run at each place of a path, so that every limit holds and braking is in time.
//!
//! With dL/ds = L′ and so on, L̇ = L′ṡ, L̈ = L″ṡ² + L′s̈ and L⃛ = L‴ṡ³ + 3L″ṡs̈ + L′s⃛. Two numbers hold for the whole path: the
//! largest |s̈| = a and |s⃛| = j, a share of what the limits leave at the steepest place. What a and j leave at each of 256 cells
//! caps ṡ there, together with speed and flow. From the end backwards the table then keeps the speed
//! from which braking with a still meets every cap ahead.
//!
//! [`crate::planning::time_scaling`] averages ṡ over n ticks, so a cap holds as far before and after its cell as n ticks at that speed reach.
//! Distances are whole numbers, 2³⁶ the path; speeds the same per tick: sums and comparisons are exact.

use crate::Real;
use crate::planning::cylinder_path::{CylinderPath, magnitude};
use crate::planning::move_limits::{Limits, larger};

/// Cells of the table.
pub(crate) const CELLS: usize = 256;
/// Bits of a cell's length.
pub(crate) const CELL_BITS: u32 = 28;
/// The whole path.
pub(crate) const WHOLE: u64 = (CELLS as u64) << CELL_BITS;
/// The longest average, ticks.
pub(crate) const LONGEST_AVERAGE: usize = 512;
/// Shares of the limits given to s̈ and s⃛ along the steepest slope, tried in turn.
const SHARES: [f64; 5] = [0.95, 0.8, 0.6, 0.35, 0.15];
/// What rounding may take of a limit.
const SLACK: f64 = 1e-4;
/// No speed is above this, a tick: squares stay far below 2⁶⁴.
const FASTEST: u64 = 1 << 30;

/// The table of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SpeedTable {
    /// Squares of the cap in each cell, of the least cap from there as far as an average reaches, and of the speed at
    /// the cell's beginning from which braking is in time.
    cap: [u64; CELLS],
    ahead: [u64; CELLS],
    entry: [u64; CELLS],
    /// The change of speed a tick.
    pub(crate) step: u64,
    /// Ticks of the average.
    pub(crate) average: usize,
}

/// What a choice of a and j leaves.
struct Choice<T> {
    acceleration: T,
    jerk: T,
    step: u64,
    average: usize,
}

impl SpeedTable {
    /// The quickest table of those tried; `None` where the path needs more than the tick resolves.
    pub(crate) fn new<T: Real, const K: usize>(
        path: &CylinderPath<T, K>,
        limits: &Limits<T>,
        tick_s: f64,
    ) -> Option<Self> {
        let mut best: Option<(T, Self)> = None;
        for of_acceleration in SHARES {
            for of_jerk in SHARES {
                let choice = Choice::new(path, limits, tick_s, [of_acceleration, of_jerk])?;
                if let Some(table) = Self::of(path, limits, tick_s, &choice) {
                    let ticks = table.ticks::<T>();
                    if best.is_none_or(|(least, _)| ticks < least) {
                        best = Some((ticks, table));
                    }
                }
            }
        }
        best.map(|(_, table)| table)
    }

    fn of<T: Real, const K: usize>(
        path: &CylinderPath<T, K>,
        limits: &Limits<T>,
        tick_s: f64,
        choice: &Choice<T>,
    ) -> Option<Self> {
        let mut caps = [0; CELLS];
        let mut fastest = 0;
        for (slot, (from, to)) in caps.iter_mut().zip(cells::<T>()) {
            let extremes = path.extremes(from, to);
            let mut rate = limits.rate(&extremes).unwrap_or(T::from_f64(1.0 / tick_s));
            for axis in 0..3 {
                let get = |of: &[T; 3]| of.get(axis).copied().unwrap_or(T::ZERO);
                let [low, high] = extremes.slope.get(axis).copied().unwrap_or([T::ZERO; 2]);
                let slope = larger(high, -low);
                let (bend, third) = (get(&extremes.curvature), get(&extremes.third));
                let left = get(&limits.acceleration) - slope * choice.acceleration;
                if bend * rate * rate > left {
                    rate = if left > T::ZERO { (left / bend).sqrt() } else { T::ZERO };
                }
                let left = get(&limits.jerk) - slope * choice.jerk;
                rate = within_jerk(rate, third, T::from_i32(3) * bend * choice.acceleration, left);
            }
            *slot = units::<T>(rate * T::from_f64((1.0 - SLACK) * tick_s));
            fastest = core::cmp::max(fastest, *slot);
        }
        // A tick's step must fit under every cap with room to brake.
        if caps.iter().any(|cap| *cap < 4 * choice.step) {
            return None;
        }
        let reach = |speed: u64| (speed * (choice.average as u64 + 1)).div_ceil(1 << CELL_BITS) as usize;
        let cap = spread(&caps, reach).map(|cap| cap * cap);
        let ahead = least_ahead(&cap, reach(fastest));
        let mut entry = [0; CELLS];
        let mut after = 0;
        for (slot, cap) in entry.iter_mut().zip(&cap).rev() {
            let gained = (2 * choice.step).saturating_mul(1 << CELL_BITS);
            after = core::cmp::min(*cap, gained.saturating_add(after));
            *slot = after;
        }
        Some(Self { cap, ahead, entry, step: choice.step, average: choice.average })
    }

    /// The square of the speed at `place` from which braking is in time; 0 at the end and beyond.
    pub(crate) fn limit_square(&self, place: u64) -> u64 {
        let cell = (place >> CELL_BITS) as usize;
        let Some(&cap) = self.cap.get(cell) else { return 0 };
        let after = self.entry.get(cell + 1).copied().unwrap_or(0);
        let left = ((cell as u64 + 1) << CELL_BITS).saturating_sub(place);
        core::cmp::min(cap, (2 * self.step).saturating_mul(left).saturating_add(after))
    }

    /// The square of the least cap from `place` on, as far as an average reaches.
    pub(crate) fn cap_ahead_square(&self, place: u64) -> u64 {
        self.ahead.get((place >> CELL_BITS) as usize).copied().unwrap_or(0)
    }

    /// About how many ticks the path takes.
    fn ticks<T: Real>(&self) -> T {
        let cell = T::from_f64((1_u64 << CELL_BITS) as f64);
        let gained = (2 * self.step).saturating_mul(1 << CELL_BITS);
        let after = self.entry.iter().skip(1).chain(core::iter::once(&0));
        let mut square = 0_u64;
        let mut slow = T::ZERO;
        let mut ticks = T::from_i32(self.average as i32);
        for (cap, after) in self.entry.iter().zip(after) {
            square = core::cmp::min(core::cmp::min(square.saturating_add(gained), *after), *cap);
            let fast = T::from_f64(square as f64).sqrt();
            ticks = ticks + (cell + cell) / larger(slow + fast, T::ONE);
            slow = fast;
        }
        ticks
    }
}

impl<T: Real> Choice<T> {
    fn new<const K: usize>(
        path: &CylinderPath<T, K>,
        limits: &Limits<T>,
        tick_s: f64,
        shares: [f64; 2],
    ) -> Option<Self> {
        // The reciprocals of what the limits leave at the steepest place of each cylinder.
        let [mut acceleration, mut jerk] = [T::ZERO; 2];
        let extremes = path.extremes(T::ZERO, T::ONE);
        for (([low, high], &limit), &jerk_limit) in extremes.slope.iter().zip(&limits.acceleration).zip(&limits.jerk) {
            let slope = larger(*high, -*low);
            acceleration = larger(acceleration, slope / limit);
            jerk = larger(jerk, slope / jerk_limit);
        }
        if !(acceleration > T::ZERO && jerk > T::ZERO) {
            return None;
        }
        let [of_acceleration, of_jerk] = shares.map(T::from_f64);
        let tick = T::from_f64(tick_s);
        let (mut a, j) = (of_acceleration / acceleration, of_jerk / jerk);
        // The average over n ticks of a change a a tick: jerk a/(n·tick).
        let longest = j * tick * T::from_i32(LONGEST_AVERAGE as i32 - 1);
        a = if a > longest { longest } else { a };
        let average = (a / (j * tick)).nearest_i32() as usize + 1;
        let step = core::cmp::min(units::<T>(a * tick * tick), FASTEST);
        if step == 0 {
            return None;
        }
        Some(Self { acceleration: a, jerk: a / (T::from_i32(average as i32) * tick), step, average })
    }
}

/// The cells' beginnings and ends.
fn cells<T: Real>() -> impl Iterator<Item = (T, T)> {
    let at = |cell: i32| T::from_i32(cell) * T::from_f64(1.0 / CELLS as f64);
    (0..CELLS as i32).map(move |cell| (at(cell), at(cell + 1)))
}

/// A speed per tick in whole units, rounded down, not above [`FASTEST`].
fn units<T: Real>(share: T) -> u64 {
    // The cast saturates, and gives 0 for what is not a number.
    core::cmp::min((share.to_f64() * WHOLE as f64) as u64, FASTEST)
}

/// The largest rate not above `rate` with third·r³ + bent·r ≤ left: bisection, so that the answer is on the near side.
fn within_jerk<T: Real>(rate: T, third: T, bent: T, left: T) -> T {
    let needs = |r: T| r * (magnitude(third) * r * r + bent);
    if needs(rate) <= left {
        return rate;
    }
    let (mut low, mut high) = (T::ZERO, rate);
    for _ in 0..24 {
        let middle = (low + high) * T::from_f64(0.5);
        if needs(middle) <= left { low = middle } else { high = middle }
    }
    low
}

/// Each cap spread to both sides as far as it moves the path's parameter in an average's time.
///
/// That is far enough. Say the mean place s lies in a cell of cap c, and the raw speed keeps to c up to c·T before and after it. If the
/// window of T ended beyond that, the raw place took T or longer from s on, so all of the window lay beyond s, and so
/// would its mean; and likewise before.
fn spread(caps: &[u64; CELLS], reach: impl Fn(u64) -> usize) -> [u64; CELLS] {
    let mut out = *caps;
    for (i, cap) in caps.iter().enumerate() {
        let reach = reach(*cap);
        for slot in out.iter_mut().skip(i.saturating_sub(reach)).take(core::cmp::min(i, reach) + 1 + reach) {
            *slot = core::cmp::min(*slot, *cap);
        }
    }
    out
}

/// The least of each value and those after it, as far as `reach`.
fn least_ahead(values: &[u64; CELLS], reach: usize) -> [u64; CELLS] {
    let mut out = *values;
    for (i, slot) in out.iter_mut().enumerate() {
        *slot = values.iter().skip(i).take(reach + 1).fold(u64::MAX, |least, x| core::cmp::min(least, *x));
    }
    out
}

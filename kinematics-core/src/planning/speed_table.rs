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
/// No speed is above this, a tick: it fits 32 bits, and squares stay far below 2⁶⁴.
const FASTEST: u64 = 1 << 30;

/// The table of a path, 3 KiB: filled in place, never handed on by value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SpeedTable {
    /// The cap in each cell, the least cap from there as far as an average reaches, and the speed at the cell's beginning from
    /// which braking is in time, rounded down.
    cap: [u32; CELLS],
    ahead: [u32; CELLS],
    entry: [u32; CELLS],
    /// The change of speed a tick.
    pub(crate) step: u64,
    /// Ticks of the average, less one: the table of no path is all zeros, and an image needs no flash for it.
    last: usize,
}

/// What a choice of a and j leaves.
struct Choice<T> {
    acceleration: T,
    jerk: T,
    step: u64,
    average: usize,
}

fn square(speed: u32) -> u64 {
    u64::from(speed) * u64::from(speed)
}

impl SpeedTable {
    /// Of no path: every speed is zero.
    pub(crate) const STANDSTILL: Self =
        Self { cap: [0; CELLS], ahead: [0; CELLS], entry: [0; CELLS], step: 0, last: 0 };

    /// Fills in the quickest table of those tried; `None` where the path needs more than the tick resolves.
    pub(crate) fn plan<T: Real, const K: usize>(
        &mut self,
        path: &CylinderPath<T, K>,
        limits: &Limits<T>,
        tick_s: f64,
    ) -> Option<()> {
        let mut best: Option<(T, [f64; 2])> = None;
        for of_acceleration in SHARES {
            for of_jerk in SHARES {
                let shares = [of_acceleration, of_jerk];
                let choice = Choice::new(path, limits, tick_s, shares)?;
                if self.fill(path, limits, tick_s, &choice) {
                    let ticks = self.ticks::<T>();
                    if best.is_none_or(|(least, _)| ticks < least) {
                        best = Some((ticks, shares));
                    }
                }
            }
        }
        // Once more rather than a second table to keep the best in.
        let (_, shares) = best?;
        let choice = Choice::new(path, limits, tick_s, shares)?;
        self.fill(path, limits, tick_s, &choice).then_some(())
    }

    /// Whether the choice leaves a speed everywhere.
    #[inline(never)]
    fn fill<T: Real, const K: usize>(
        &mut self,
        path: &CylinderPath<T, K>,
        limits: &Limits<T>,
        tick_s: f64,
        choice: &Choice<T>,
    ) -> bool {
        (self.step, self.last) = (choice.step, choice.average - 1);
        // Until they are spread, the caps stand where `ahead` will.
        let mut fastest = 0;
        for (slot, (from, to)) in self.ahead.iter_mut().zip(cells::<T>()) {
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
        if self.ahead.iter().any(|cap| u64::from(*cap) < 4 * choice.step) {
            return false;
        }
        let reach = |speed: u32| (u64::from(speed) * (choice.average as u64 + 1)).div_ceil(1 << CELL_BITS) as usize;
        spread(&self.ahead, &mut self.cap, reach);
        least_ahead(&self.cap, &mut self.ahead, reach(fastest));
        let gained = self.gained();
        let mut after = 0;
        for (slot, cap) in self.entry.iter_mut().zip(&self.cap).rev() {
            after = core::cmp::min(square(*cap), gained.saturating_add(square(after))).isqrt() as u32;
            *slot = after;
        }
        true
    }

    /// Ticks of the average.
    pub(crate) fn average(&self) -> usize {
        self.last + 1
    }

    /// What the square of the speed gains over a cell.
    fn gained(&self) -> u64 {
        (2 * self.step).saturating_mul(1 << CELL_BITS)
    }

    /// The square of the speed at `place` from which braking is in time; 0 at the end and beyond.
    pub(crate) fn limit_square(&self, place: u64) -> u64 {
        let cell = (place >> CELL_BITS) as usize;
        let Some(&cap) = self.cap.get(cell) else { return 0 };
        let after = self.entry.get(cell + 1).map_or(0, |after| square(*after));
        let left = ((cell as u64 + 1) << CELL_BITS).saturating_sub(place);
        core::cmp::min(square(cap), (2 * self.step).saturating_mul(left).saturating_add(after))
    }

    /// The square of the least cap from `place` on, as far as an average reaches.
    pub(crate) fn cap_ahead_square(&self, place: u64) -> u64 {
        self.ahead.get((place >> CELL_BITS) as usize).map_or(0, |cap| square(*cap))
    }

    /// About how many ticks the path takes.
    fn ticks<T: Real>(&self) -> T {
        let cell = T::from_f64((1_u64 << CELL_BITS) as f64);
        let gained = self.gained();
        let after = self.entry.iter().skip(1).chain(core::iter::once(&0));
        let mut reached = 0_u64;
        let mut slow = T::ZERO;
        let mut ticks = T::from_i32(self.last as i32 + 1);
        for (entry, after) in self.entry.iter().zip(after) {
            reached = core::cmp::min(reached.saturating_add(gained), core::cmp::min(square(*after), square(*entry)));
            let fast = T::from_f64(reached as f64).sqrt();
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
        let step = u64::from(units::<T>(a * tick * tick));
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
fn units<T: Real>(share: T) -> u32 {
    // The cast saturates, and gives 0 for what is not a number.
    core::cmp::min((share.to_f64() * WHOLE as f64) as u64, FASTEST) as u32
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
fn spread(caps: &[u32; CELLS], out: &mut [u32; CELLS], reach: impl Fn(u32) -> usize) {
    *out = *caps;
    for (i, cap) in caps.iter().enumerate() {
        let reach = reach(*cap);
        for slot in out.iter_mut().skip(i.saturating_sub(reach)).take(core::cmp::min(i, reach) + 1 + reach) {
            *slot = core::cmp::min(*slot, *cap);
        }
    }
}

/// The least of each value and those after it, as far as `reach`.
fn least_ahead(values: &[u32; CELLS], out: &mut [u32; CELLS], reach: usize) {
    for (i, slot) in out.iter_mut().enumerate() {
        *slot = values.iter().skip(i).take(reach + 1).fold(u32::MAX, |least, x| core::cmp::min(least, *x));
    }
}

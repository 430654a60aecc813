//! The moments shown, and points over them.

use firmware::TICKS_PER_S;

use crate::run::{Log, Row};

/// Ticks from one moment to the next: 40 a second.
const TICKS: usize = TICKS_PER_S as usize / 40;
/// Moments of a long run, which is shown in longer steps.
const MOST: usize = 4000;

/// Every so many ticks of a log.
pub(super) struct Moments<'a> {
    pub(super) step_s: f64,
    pub(super) rows: Vec<&'a Row>,
}

impl<'a> Moments<'a> {
    /// Of a log; `None` where it is empty or the linkage has no pose.
    pub(super) fn of(log: &'a Log) -> Option<Self> {
        let step = log.rows.len().div_ceil(MOST).max(TICKS);
        let rows: Vec<&Row> = log.rows.iter().step_by(step).collect();
        rows.first()?.joints?;
        Some(Self { step_s: step as f64 / f64::from(TICKS_PER_S), rows })
    }

    /// The moment a time belongs to.
    pub(super) fn at(&self, time_s: f64) -> usize {
        ((time_s / self.step_s + 0.999_999) as usize).min(self.rows.len() - 1)
    }
}

/// Millimetres.
pub(super) fn mm(metres: f64) -> i32 {
    // The cast saturates.
    libm::round(metres * 1e3) as i32
}

/// Points over the moments, mm.
pub(super) struct Tracks {
    moments: usize,
    tracks: Vec<Vec<[i32; 2]>>,
}

/// A point's number.
pub(super) type Track = usize;

impl Tracks {
    pub(super) fn new(moments: &Moments<'_>) -> Self {
        Self { moments: moments.rows.len(), tracks: Vec::new() }
    }

    /// Takes a point's places, m, one a moment.
    pub(super) fn add(&mut self, places: impl ExactSizeIterator<Item = [f64; 2]>) -> Track {
        assert_eq!(places.len(), self.moments, "a place a moment");
        self.tracks.push(places.map(|place| place.map(mm)).collect());
        self.tracks.len() - 1
    }

    /// Where a point is over time, mm.
    pub(super) fn of(&self, track: Track) -> &[[i32; 2]] {
        &self.tracks[track]
    }

    /// Numbers of a moment.
    pub(super) fn width(&self) -> usize {
        2 * self.tracks.len()
    }

    /// All points of the first moment, then of every other what changed since the one before: mostly short numbers.
    pub(super) fn differences(&self) -> Vec<i32> {
        let mut out = Vec::with_capacity(self.width() * self.moments);
        for moment in 0..self.moments {
            for track in &self.tracks {
                let before = if moment > 0 { track[moment - 1] } else { [0; 2] };
                out.extend([0, 1].map(|axis| track[moment][axis].wrapping_sub(before[axis])));
            }
        }
        out
    }
}

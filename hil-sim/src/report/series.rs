//! Long series made short enough to draw, without losing what stands out.

/// A point of a line.
pub(super) type Point = (f64, f64);

/// A line without gaps.
pub(super) type Piece = Vec<Point>;

/// Points a line may have.
pub(super) const MOST_POINTS: usize = 1800;

/// A value over time with at most about [`MOST_POINTS`] points: of every bucket of samples the smallest and the largest
/// stay, and of every piece the ends. A missing or non-finite value is a gap.
pub(super) fn over_time(samples: impl ExactSizeIterator<Item = (f64, Option<f64>)>) -> Vec<Piece> {
    let bucket = (2 * samples.len()).div_ceil(MOST_POINTS).max(1);
    let mut pieces = Pieces::default();
    let mut held: Option<Extremes> = None;
    let mut last = None;
    for (index, (time, value)) in samples.enumerate() {
        let point = value.filter(|v| v.is_finite()).map(|v| (time, v));
        if index % bucket == 0 || point.is_none() {
            held.take().into_iter().flatten().for_each(|p| pieces.push(p));
        }
        match point {
            Some(point) if pieces.is_closed() && held.is_none() => pieces.push(point),
            Some(point) => held = Some(held.map_or(Extremes::of(point), |e| e.with(point))),
            None => {
                last.take().into_iter().for_each(|p| pieces.push(p));
                pieces.close();
            }
        }
        last = point;
    }
    held.into_iter().flatten().chain(last).for_each(|p| pieces.push(p));
    pieces.done()
}

/// A path in the plane: points closer than `spacing` to the last one kept are left out, but for the ends. A missing or
/// non-finite point is a gap.
pub(super) fn along_path(points: impl Iterator<Item = Option<Point>>, spacing: f64) -> Vec<Piece> {
    let mut pieces = Pieces::default();
    let mut last = None;
    for point in points {
        match point.filter(|(x, y)| x.is_finite() && y.is_finite()) {
            Some(point) => {
                if pieces.end().is_none_or(|(x, y)| libm::hypot(point.0 - x, point.1 - y) >= spacing) {
                    pieces.push(point);
                }
                last = Some(point);
            }
            None => {
                last.take().into_iter().for_each(|p| pieces.push(p));
                pieces.close();
            }
        }
    }
    last.into_iter().for_each(|p| pieces.push(p));
    pieces.done()
}

/// Smallest and largest sample of a bucket.
#[derive(Clone, Copy)]
struct Extremes {
    low: Point,
    high: Point,
}

impl Extremes {
    fn of(point: Point) -> Self {
        Self { low: point, high: point }
    }

    fn with(self, point: Point) -> Self {
        Self {
            low: if point.1 < self.low.1 { point } else { self.low },
            high: if point.1 > self.high.1 { point } else { self.high },
        }
    }
}

impl IntoIterator for Extremes {
    type Item = Point;
    type IntoIter = std::array::IntoIter<Point, 2>;

    /// In the order of time.
    fn into_iter(self) -> Self::IntoIter {
        if self.low.0 <= self.high.0 { [self.low, self.high] } else { [self.high, self.low] }.into_iter()
    }
}

/// Pieces being collected; a point said twice is kept once.
#[derive(Default)]
struct Pieces {
    done: Vec<Piece>,
    open: Piece,
}

impl Pieces {
    fn push(&mut self, point: Point) {
        if self.end() != Some(point) {
            self.open.push(point);
        }
    }

    fn end(&self) -> Option<Point> {
        self.open.last().copied()
    }

    fn is_closed(&self) -> bool {
        self.open.is_empty()
    }

    fn close(&mut self) {
        if !self.open.is_empty() {
            self.done.push(std::mem::take(&mut self.open));
        }
    }

    fn done(mut self) -> Vec<Piece> {
        self.close();
        self.done
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(n: usize, f: impl Fn(usize) -> Option<f64>) -> Vec<(f64, Option<f64>)> {
        (0..n).map(|i| (i as f64, f(i))).collect()
    }

    #[test]
    fn one_sample_out_of_many_that_stands_out_stays() {
        let long = samples(24_000, |i| {
            Some(match i {
                7_777 => 5.0,
                7_779 => -5.0,
                i => (i as f64 * 1e-3).sin(),
            })
        });
        let pieces = over_time(long.into_iter());
        assert_eq!(pieces.len(), 1);
        assert!(pieces[0].len() <= MOST_POINTS + 4, "{} points", pieces[0].len());
        assert!(pieces[0].contains(&(7_777.0, 5.0)) && pieces[0].contains(&(7_779.0, -5.0)));
    }

    #[test]
    fn time_runs_forward_and_both_ends_stay() {
        let pieces = over_time(samples(10_001, |i| Some(((i * 7919) % 1000) as f64)).into_iter());
        assert!(pieces[0].windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(pieces[0].first().map(|p| p.0), Some(0.0));
        assert_eq!(pieces[0].last().map(|p| p.0), Some(10_000.0));
    }

    #[test]
    fn a_short_series_stays_as_it_is() {
        let pieces = over_time(samples(100, |i| Some((i * i) as f64)).into_iter());
        assert_eq!(pieces, [(0..100).map(|i| (i as f64, (i * i) as f64)).collect::<Vec<_>>()]);
    }

    #[test]
    fn what_is_missing_or_not_finite_is_a_gap() {
        let pieces = over_time(
            samples(9_000, |i| match i {
                3_000..4_000 => None,
                6_000 => Some(f64::NAN),
                6_001 => Some(f64::INFINITY),
                i => Some(i as f64),
            })
            .into_iter(),
        );
        let ends: Vec<_> = pieces.iter().map(|p| (p[0].0, p[p.len() - 1].0)).collect();
        assert_eq!(ends, [(0.0, 2_999.0), (4_000.0, 5_999.0), (6_002.0, 8_999.0)]);
    }

    #[test]
    fn a_path_keeps_its_ends_gaps_and_shape() {
        let circle = |i: usize| {
            let angle = i as f64 * 1e-3;
            (i != 3_000).then(|| (angle.cos(), angle.sin()))
        };
        let pieces = along_path((0..6_000).map(circle), 0.01);
        assert_eq!(pieces.len(), 2);
        assert_eq!(pieces[0][0], (1.0, 0.0));
        assert_eq!(pieces[0].last().copied(), circle(2_999));
        assert_eq!(pieces[1].last().copied(), circle(5_999));
        assert!(pieces.iter().map(Vec::len).sum::<usize>() < 620);
        let steps = pieces.iter().flat_map(|p| p.windows(2));
        assert!(steps.map(|s| libm::hypot(s[1].0 - s[0].0, s[1].1 - s[0].1)).all(|step| step < 0.0115));
    }
}

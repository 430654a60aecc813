//! A point obstacle, and the critical point of a planar chain: the point of it nearest to the obstacle.

use crate::{Real, Rotor, Vec2};

/// A point the arm keeps away from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Obstacle<T> {
    /// Where it is, m, from the first joint.
    pub position: Vec2<T>,
    /// Nearer than this no step of a plan leads, m: the radius of the circle the tip goes round.
    pub keep_m: T,
    /// Nearer than this the obstacle's task acts, m.
    pub acts_m: T,
}

/// The point of a chain, or of one of its links, nearest to an obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Critical<T> {
    /// Its link, counted from 0.
    pub link: usize,
    /// Where it is, m.
    pub point: Vec2<T>,
    /// Its distance from the obstacle, m.
    pub distance_m: T,
    /// Direction from the obstacle to it; for a link that runs through the obstacle a quarter turn ahead of the link.
    pub away: Rotor<T>,
}

/// Each link's own critical point, for a chain whose links end at `ends` (m), as seen from `position`.
///
/// ```
/// use kinematics_core::Vec2;
/// use kinematics_core::planning::obstacle::critical_points;
/// // One link forward, one up; the obstacle beside the second.
/// let [first, second] = critical_points(&[Vec2::new(2.0, 0.0), Vec2::new(2.0, 1.0)], Vec2::new(2.5, 0.5));
/// assert_eq!((first.link, first.point), (0, Vec2::new(2.0, 0.0)));
/// assert_eq!((second.link, second.point, second.distance_m), (1, Vec2::new(2.0, 0.5), 0.5));
/// assert_eq!(second.away.to_vec(), Vec2::new(-1.0, 0.0));
/// ```
pub fn critical_points<T: Real, const N: usize>(ends: &[Vec2<T>; N], position: Vec2<T>) -> [Critical<T>; N] {
    let (mut start, mut link) = (Vec2::new(T::ZERO, T::ZERO), 0);
    ends.map(|end| {
        let along = end - start;
        let square = along.norm_squared();
        let part = if square > T::ZERO { (position - start).dot(along) / square } else { T::ZERO };
        let part = if part < T::ZERO { T::ZERO } else { part };
        let point = if part < T::ONE { start + along.scale(part) } else { end };
        let (from, across) = (point - position, Vec2::new(-along.z, along.x));
        let away = from.direction().or_else(|| across.direction()).unwrap_or(Rotor::IDENTITY);
        let critical = Critical { link, point, distance_m: from.norm(), away };
        (start, link) = (end, link + 1);
        critical
    })
}

/// The critical point of the whole chain: the nearest of [`critical_points`], the first of equals.
///
/// ```
/// use kinematics_core::Vec2;
/// use kinematics_core::planning::obstacle::nearest;
/// let found = nearest(&[Vec2::new(2.0, 0.0), Vec2::new(2.0, 1.0)], Vec2::new(2.5, 0.5));
/// assert_eq!((found.link, found.distance_m), (1, 0.5));
/// ```
pub fn nearest<T: Real, const N: usize>(ends: &[Vec2<T>; N], position: Vec2<T>) -> Critical<T> {
    let origin = Vec2::new(T::ZERO, T::ZERO);
    let base = Critical {
        link: 0,
        point: origin,
        distance_m: position.norm(),
        away: (origin - position).direction().unwrap_or(Rotor::IDENTITY),
    };
    // The base is part of the first link.
    critical_points(ends, position)
        .into_iter()
        .fold(base, |best, one| if one.distance_m < best.distance_m { one } else { best })
}

impl<T: Real> Obstacle<T> {
    /// ẋ_o, m: how far the critical point should go in one iteration, straight away from the obstacle, to where its task ends.
    ///
    /// ```
    /// use kinematics_core::Vec2;
    /// use kinematics_core::planning::obstacle::{Obstacle, nearest};
    /// let obstacle = Obstacle { position: Vec2::new(2.5f64, 0.5), keep_m: 0.2, acts_m: 0.75 };
    /// let critical = nearest(&[Vec2::new(2.0, 0.0), Vec2::new(2.0, 1.0)], obstacle.position);
    /// assert_eq!(obstacle.escape(&critical), Vec2::new(-0.25, 0.0));
    /// ```
    pub fn escape(&self, critical: &Critical<T>) -> Vec2<T> {
        let missing = self.acts_m - critical.distance_m;
        critical.away.to_vec().scale(if missing > T::ZERO { missing } else { T::ZERO })
    }
}

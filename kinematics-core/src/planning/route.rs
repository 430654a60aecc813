//! Ways round obstacles, as at most six aims: swing out of an obstacle's sector, pass in a posture that clears every obstacle at any
//! swing, swing in from the target's side; the short way about the swing axis or the long one.
//!
//! Why these: swinging away from a sphere's bearing never closes in on it (a point at reach x > 0 is at the squared distance
//! x² + R² − 2xR·cos Δ + …, growing with |Δ|), and outside the sphere's sector the plane is free. So with one sphere, out – change posture – in is free of
//! collision whenever start and target lie on one side of it; with both sides, a posture that clears it is the passage.

use super::avoid::{Aim, Avoid};
use super::hull::Sphere;
use crate::{Real, Rotor, Vec2};

/// Postures a route may pass in.
pub(crate) const POSTURES: usize = 4;

/// Sides to leave a sector by: none, left, right.
const SIDES: usize = 3;

/// All routes: posture (or none) × way round × side at the start × side at the target.
pub(crate) const ROUTES: usize = (POSTURES + 1) * 2 * SIDES * SIDES;

/// A bounded list of aims.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Route<T> {
    aims: [Option<Aim<T>>; 6],
}

impl<T: Real> Route<T> {
    /// The aim after so many.
    pub(crate) fn aim(&self, passed: usize) -> Option<Aim<T>> {
        self.aims.iter().flatten().nth(passed).copied()
    }

    pub(crate) fn is_last(&self, passed: usize) -> bool {
        self.aims.iter().flatten().count() <= passed + 1
    }

    /// Time at the speed limits without obstacles, s.
    pub(crate) fn time(&self, avoid: &Avoid<T>, start: &Aim<T>) -> T {
        let (mut time, mut at) = (T::ZERO, *start);
        for aim in self.aims.iter().flatten() {
            time = time + avoid.time(&avoid.lack(&at, aim));
            at = *aim;
        }
        time
    }
}

/// A sphere's sector: the swings at which the hull can touch it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bearing<T> {
    pub(crate) direction: Rotor<T>,
    /// Half the sector; `None` for a sphere around the swing axis.
    half: Option<Rotor<T>>,
}

impl<T: Real> Bearing<T> {
    /// Of a sphere passed at `keep` m from the hull.
    pub(crate) fn of(sphere: &Sphere<T>, thickest: T, keep: T) -> Self {
        let radial = Vec2::new(sphere.x, sphere.y);
        let Some(direction) = radial.direction() else { return Self { direction: Rotor::IDENTITY, half: None } };
        let sin = (sphere.radius + thickest + keep) / radial.norm();
        let half = (sin < T::ONE).then(|| Rotor { cos: (T::ONE - sin * sin).sqrt(), sin });
        Self { direction, half }
    }

    /// The sector's edge on a side, if the swing lies within.
    fn edge(&self, swing: Rotor<T>, left: bool) -> Option<Rotor<T>> {
        let half = self.half?;
        let off = swing * self.direction.inverse();
        // A hair inside the edge counts as outside: the edge itself is one.
        let inside = off.cos > half.cos + T::from_f64(1e-3);
        inside.then(|| self.direction * if left { half } else { half.inverse() })
    }
}

/// What every route of one planning goes by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Map<T, const N: usize> {
    pub(crate) start: Aim<T>,
    pub(crate) goal: Aim<T>,
    pub(crate) bearings: [Bearing<T>; N],
    pub(crate) postures: [Option<[T; 3]>; POSTURES],
}

impl<T: Real, const N: usize> Map<T, N> {
    /// Out of all sectors on a side; `None` if the swing is in none.
    fn out(&self, swing: Rotor<T>, side: usize) -> Option<Rotor<T>> {
        let (mut at, mut moved) = (swing, None);
        for _ in 0..N {
            for bearing in &self.bearings {
                if let Some(edge) = bearing.edge(at, side == 1) {
                    (at, moved) = (edge, Some(edge));
                }
            }
        }
        moved
    }

    /// The route of this number; `None` for one that is another's double or leaves the swing's travel.
    pub(crate) fn route(&self, avoid: &Avoid<T>, number: usize) -> Option<Route<T>> {
        let (out_side, in_side) = (number % SIDES, number / SIDES % SIDES);
        let (long_way, posture) = (number / (SIDES * SIDES) % 2 == 1, number / (SIDES * SIDES * 2));
        let (start, goal) = (self.start, self.goal);
        let passing = match posture {
            0 => None,
            n => Some(self.postures.get(n - 1).copied().flatten()?),
        };
        let leave = if out_side == 0 { None } else { Some(self.out(start.swing, out_side)?) };
        let enter = if in_side == 0 { None } else { Some(self.out(goal.swing, in_side)?) };
        let (from, to) = (leave.unwrap_or(start.swing), enter.unwrap_or(goal.swing));
        let places = passing.unwrap_or(goal.places);
        let mut aims = [None; 6];
        let [out, change, half_way, across, unfold, last] = &mut aims;
        *out = leave.map(|swing| Aim { swing, places: start.places });
        if passing.is_some() || long_way {
            *change = Some(Aim { swing: from, places });
        }
        if long_way {
            if avoid.swing.is_some() {
                return None;
            }
            // Opposite the middle of the short way.
            let middle = (from.to_vec() + to.to_vec()).direction()?;
            *half_way = Some(Aim { swing: Rotor { cos: -middle.cos, sin: -middle.sin }, places });
        }
        if passing.is_some() {
            *across = Some(Aim { swing: to, places });
        }
        *unfold = enter.map(|swing| Aim { swing, places: goal.places });
        *last = Some(goal);
        aims.iter().flatten().all(|aim| avoid.within_travel(aim)).then_some(Route { aims })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PinGeometry;
    use crate::planning::avoid::AvoidParameters;
    use crate::planning::hull::{Flesh, Hull};

    /// Start and goal beside a ball at the same bearing, all postures free.
    fn map(avoid: &Avoid<f64>) -> Map<f64, 1> {
        let [boom, arm, bucket] = &avoid.travels;
        let places = |share: f64| [boom.half * share, arm.half * share, bucket.half * share];
        let ball = Sphere { x: 2.0, y: 0.0, z: 0.5, radius: 0.3 };
        Map {
            start: Aim { swing: Rotor::from_degrees(5.0), places: places(0.1) },
            goal: Aim { swing: Rotor::from_degrees(-8.0), places: places(0.2) },
            bearings: [Bearing::of(&ball, 0.1, 0.05)],
            postures: [-0.8, -0.4, 0.4, 0.8].map(|share| Some(places(share))),
        }
    }

    fn avoid() -> Avoid<f64> {
        let g = PinGeometry::EXACT_MINI;
        let hull = Hull::new(&g, Flesh::of_reach(g.reach_m())).unwrap_or_else(|e| panic!("{e}"));
        let parameters = AvoidParameters::of_reach(g.reach_m(), [1.0; 4]);
        Avoid::new(&g, hull, &parameters).unwrap_or_else(|e| panic!("{e}"))
    }

    #[test]
    fn every_number_is_another_route_where_start_and_goal_lie_in_a_sector() {
        let avoid = avoid();
        let map = map(&avoid);
        let mut found = [None; ROUTES];
        for (number, slot) in found.iter_mut().enumerate() {
            *slot = map.route(&avoid, number);
            assert!(slot.is_some(), "{number}");
        }
        for (number, route) in found.iter().enumerate() {
            assert!(!found.iter().take(number).any(|earlier| earlier == route), "{number}");
        }
        assert!(map.route(&avoid, ROUTES).is_none(), "there are no more postures");
    }

    #[test]
    fn a_route_ends_at_the_goal_and_leaves_and_enters_at_the_sectors_edge() {
        let avoid = avoid();
        let map = map(&avoid);
        // asin(0.45/2)
        let half = 13.003_f64;
        for (number, [out, into]) in [(1, [Some(half), None]), (2, [Some(-half), None]), (3, [None, Some(half)])] {
            let route = map.route(&avoid, number).unwrap_or_else(|| panic!("{number}"));
            let swings: [Option<f64>; 2] =
                [route.aim(0), route.aim(1)].map(|aim| aim.map(|a| a.swing.angle().to_degrees()));
            let wanted = [out.or(into), Some(-8.0)];
            for (swing, wanted) in swings.into_iter().zip(wanted) {
                assert!(swing.zip(wanted).is_some_and(|(swing, wanted)| (swing - wanted).abs() < 0.01), "{swings:?}");
            }
            assert!(route.is_last(1) && !route.is_last(0) && route.aim(2).is_none());
            let first = route.aim(0).map(|aim| aim.places);
            assert_eq!(first, Some(if out.is_some() { map.start.places } else { map.goal.places }));
        }
    }

    #[test]
    fn the_long_way_goes_by_the_side_opposite_to_the_short_one() {
        let avoid = avoid();
        let map = map(&avoid);
        let route = map.route(&avoid, SIDES * SIDES).unwrap_or_else(|| panic!("none"));
        let aims =
            [route.aim(0), route.aim(1), route.aim(2)].map(|aim| aim.unwrap_or_else(|| panic!("two on the way")));
        let degrees = aims.map(|aim| aim.swing.angle().to_degrees());
        assert!((degrees[0] - 5.0).abs() < 1e-9 && (degrees[2] + 8.0).abs() < 1e-9, "{degrees:?}");
        assert!((degrees[1] - 178.5).abs() < 1e-9, "{degrees:?}");
        // First the places, by a tenth of half a travel, then 173.5° twice, at 1 rad/s; half a turn's arc is good to 0.026 rad.
        let longest =
            avoid.travels.iter().fold(0.0, |most, travel| if travel.half > most { travel.half } else { most });
        let expected = 0.1 * longest + 347.0_f64.to_radians();
        assert!((route.time(&avoid, &map.start) - expected).abs() < 0.06);
    }
}

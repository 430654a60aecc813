//! Where every pin of the linkage is at every moment, from the recorded cylinder lengths.

use kinematics_core::Machine;
use kinematics_core::planning::outline::{Outline, PlacedOutline};

use super::moments::{Moments, Track, Tracks};
use crate::scenario::Scenario;

/// A cylinder from its base to its rod's eye, with the end of its barrel between them.
#[derive(Clone, Copy)]
pub(super) struct Cylinder {
    pub(super) base: Track,
    pub(super) barrel: Track,
    pub(super) eye: Track,
}

/// The points of the linkage.
pub(super) struct Linkage {
    pub(super) boom_pin: Track,
    pub(super) knee: Track,
    pub(super) arm_pin: Track,
    pub(super) bucket_pin: Track,
    /// I.
    pub(super) rocker_pivot: Track,
    /// K.
    pub(super) coupler_pin: Track,
    pub(super) back: Track,
    pub(super) teeth: Track,
    /// Boom A–B, arm C–D, bucket E–J.
    pub(super) cylinders: [Cylinder; 3],
}

impl Linkage {
    /// Of a run.
    pub(super) fn new(
        tracks: &mut Tracks,
        moments: &Moments<'_>,
        machine: &Machine<f64>,
        outline: &Outline<f64>,
        scenario: &Scenario,
    ) -> Self {
        let mut last = PlacedOutline::nowhere();
        let placed: Vec<PlacedOutline<f64>> = moments
            .rows
            .iter()
            .map(|row| {
                // The plant stays between its stops, where the linkage closes; should it not, the machine is seen to stand.
                let now = row.joints.and_then(|joints| outline.place(machine, &joints).ok());
                last = now.unwrap_or(last);
                last
            })
            .collect();
        let end = |placed: &PlacedOutline<f64>, strip: usize, end: usize| {
            let at = placed.strips[strip].ends[end].at;
            [at.x, at.z]
        };
        let point = |tracks: &mut Tracks, strip, side| tracks.add(placed.iter().map(|placed| end(placed, strip, side)));
        // Strips in the order of `kinematics_core::planning::outline::PARTS`.
        let (boom_pin, knee, arm_pin, bucket_pin) =
            (point(tracks, 0, 0), point(tracks, 0, 1), point(tracks, 1, 1), point(tracks, 3, 1));
        let (rocker_pivot, coupler_pin, back, teeth) =
            (point(tracks, 8, 0), point(tracks, 9, 1), point(tracks, 11, 1), point(tracks, 12, 1));
        let g = &scenario.machine.geometry;
        let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
        let cylinders = [0, 1, 2].map(|i| {
            let strip = 5 + i;
            let (base, eye) = (point(tracks, strip, 0), point(tracks, strip, 1));
            // The file knows no barrels: one holds the stroke, and closed the rod still looks out.
            let (shortest, travel) = (strokes[i].min_m, strokes[i].max_m - strokes[i].min_m);
            let long = 0.5 * (shortest + if travel < shortest { travel } else { shortest });
            let barrel = tracks.add(placed.iter().map(|placed| {
                let ([bx, bz], [ex, ez]) = (end(placed, strip, 0), end(placed, strip, 1));
                let share = long / libm::hypot(ex - bx, ez - bz);
                [bx + share * (ex - bx), bz + share * (ez - bz)]
            }));
            Cylinder { base, barrel, eye }
        });
        Self { boom_pin, knee, arm_pin, bucket_pin, rocker_pivot, coupler_pin, back, teeth, cylinders }
    }

    /// Every pin.
    pub(super) fn pins(&self) -> Vec<Track> {
        let [boom, arm, bucket] = self.cylinders;
        let cylinders = [boom, arm, bucket].into_iter().flat_map(|cylinder| [cylinder.base, cylinder.eye]);
        [self.boom_pin, self.arm_pin, self.bucket_pin, self.rocker_pivot, self.coupler_pin]
            .into_iter()
            .chain(cylinders)
            .collect()
    }
}

//! The outline of everything the tip reaches over the whole stroke.
//!
//! Turning the boom turns the tip about the boom pin. At each distance from the pin, arm and bucket reach a span of directions,
//! and the boom's own range widens it: the outline is exact up to the bins' width, as long as the boom's range bridges every gap
//! between the directions of arm and bucket, which is checked.

use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
use serde::Serialize;

use super::grid;

/// Points of arm and bucket a side.
const ARM_POINTS: usize = 501;
/// Bins of distance.
const BINS: usize = 160;

/// A closed curve round the reachable tips, in the boom's plane of the base frame, m.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outline {
    /// Reach and height, counter-clockwise; the last point joins the first.
    pub points_m: Vec<[f64; 2]>,
    /// Farthest tip from the boom pin, m.
    pub farthest_m: f64,
    /// Nearest tip to the boom pin, m.
    pub nearest_m: f64,
    /// Greatest reach from the swing axis, m.
    pub reach_m: f64,
    /// Highest tip above the boom pin, m.
    pub highest_m: f64,
    /// Lowest tip, m.
    pub lowest_m: f64,
    /// Some distance is reached in directions the boom's range does not join: the outline covers the gap.
    pub has_gaps: bool,
}

/// Directions of the tip from the boom pin at one distance, boom line at 0, rad.
#[derive(Clone, Debug, Default)]
struct Bin(Vec<f64>);

/// The outline of a machine.
pub fn outline(geometry: &PinGeometry, machine: &Machine<f64>) -> Option<Outline> {
    let g = geometry;
    let boom_range = {
        let at = |boom| {
            let lengths = Cylinders { boom, arm: g.arm.stroke.min_m, bucket: g.bucket.stroke.min_m };
            Some(machine.cylinders_to_joints(&lengths).ok()?.boom.angle())
        };
        let ends = [at(g.boom.stroke.min_m)?, at(g.boom.stroke.max_m)?];
        if ends[0] < ends[1] { ends } else { [ends[1], ends[0]] }
    };
    let mut tips = Vec::with_capacity(ARM_POINTS * ARM_POINTS);
    for arm in grid(g.arm.stroke, ARM_POINTS) {
        for bucket in grid(g.bucket.stroke, ARM_POINTS) {
            let lengths = Cylinders { boom: g.boom.stroke.min_m, arm, bucket };
            let pose = machine.cylinders_to_tip(&lengths, Rotor::IDENTITY).ok()?;
            // From the boom pin, with the boom line turned to 0.
            let tip = kinematics_core::Vec2::new(pose.plane.reach - g.boom_pin_x_m, pose.plane.height);
            let turned = pose.joints.boom.inverse().rotate(tip);
            tips.push((turned.norm(), libm::atan2(turned.z, turned.x)));
        }
    }
    let radius =
        |best: fn(f64, f64) -> bool| tips.iter().map(|tip| tip.0).reduce(|a, b| if best(a, b) { a } else { b });
    let (nearest, farthest) = (radius(|a, b| a < b)?, radius(|a, b| a > b)?);
    let width = (farthest - nearest) / BINS as f64;
    let mut bins = vec![Bin::default(); BINS];
    for (distance, direction) in tips {
        let at = ((distance - nearest) / width) as usize;
        if let Some(bin) = bins.get_mut(if at < BINS { at } else { BINS - 1 }) {
            bin.0.push(direction);
        }
    }
    Some(around(geometry, &mut bins, nearest, width, boom_range))
}

/// Up along the greatest directions, back along the least.
fn around(g: &PinGeometry, bins: &mut [Bin], nearest: f64, width: f64, [low, high]: [f64; 2]) -> Outline {
    let (mut upper, mut lower) = (Vec::new(), Vec::new());
    let mut has_gaps = false;
    let last = bins.len() - 1;
    for (i, bin) in bins.iter_mut().enumerate() {
        bin.0.sort_by(f64::total_cmp);
        let (Some(&least), Some(&greatest)) = (bin.0.first(), bin.0.last()) else { continue };
        has_gaps |= bin.0.windows(2).any(|pair| pair[1] - pair[0] > high - low);
        // The outermost bins stand for the ends themselves.
        let part = if i == 0 {
            0.0
        } else if i == last {
            1.0
        } else {
            0.5
        };
        let distance = nearest + (i as f64 + part) * width;
        upper.push((distance, greatest + high));
        lower.push((distance, least + low));
    }
    let at =
        |(distance, angle): (f64, f64)| [g.boom_pin_x_m + distance * libm::cos(angle), distance * libm::sin(angle)];
    // From one side to the other at the distance of both.
    let arc = |from: Option<&(f64, f64)>, to: Option<&(f64, f64)>| {
        let ends = from.zip(to);
        let piece = move |i: i32| {
            let (&(distance, from), &(_, to)) = ends?;
            Some(at((distance, from + (to - from) * f64::from(i) / f64::from(ARC_POINTS))))
        };
        (0..=ARC_POINTS).filter_map(piece).collect::<Vec<_>>()
    };
    let mut points_m: Vec<[f64; 2]> = lower.iter().map(|&p| at(p)).collect();
    points_m.extend(arc(lower.last(), upper.last()));
    points_m.extend(upper.iter().rev().map(|&p| at(p)));
    points_m.extend(arc(upper.first(), lower.first()));
    let most = |axis: usize, sign: f64| {
        sign * points_m.iter().map(|p| sign * p[axis]).fold(f64::NEG_INFINITY, |a, b| if b > a { b } else { a })
    };
    Outline {
        farthest_m: nearest + width * (last as f64 + 1.0),
        nearest_m: nearest,
        reach_m: most(0, 1.0),
        highest_m: most(1, 1.0),
        lowest_m: most(1, -1.0),
        has_gaps,
        points_m,
    }
}

/// Pieces of the outermost and innermost arc.
const ARC_POINTS: i32 = 60;

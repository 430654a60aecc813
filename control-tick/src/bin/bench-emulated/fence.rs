//! The fence's parts: the outline placed in two halves, strips weighed against a wall they stand at, and a wish that every approach limits.

use core::cell::RefCell;
use core::hint::black_box;

use kinematics_core::planning::clearance::HalfSpace;
use kinematics_core::planning::fence::{Fence, Nearby, Scene, Stopping};
use kinematics_core::planning::limits::Limits;
use kinematics_core::planning::outline::{Outline, OutlineShape, PlacedOutline};
use kinematics_core::world::BasePlacement;
use kinematics_core::{Cylinders, Joints, Machine, PinGeometry, Rotor};

use crate::bench::{Out, row};
use crate::emulated::fail;
use crate::emulated::stopwatch::Stopwatch;

#[inline(never)]
fn place(
    outline: &Outline<f32>,
    machine: &Machine<f32>,
    joints: &Joints<f32>,
    placed: &mut PlacedOutline<f32>,
) -> bool {
    outline.place_into(machine, joints, placed).is_ok()
}

#[inline(never)]
fn limit(fence: &Fence<f32>, nearby: &Nearby<f32>, wanted: &[f32; 4]) -> [f32; 4] {
    fence.limit(nearby, wanted, &[1.0; 4], &[0.001; 4])
}

pub(crate) fn fence(
    out: &mut Out,
    stopwatch: &Stopwatch,
    machine: &Machine<f32>,
    along: impl Fn(f32) -> Cylinders<f32>,
) {
    let geometry = PinGeometry::EXACT_MINI;
    let Ok(outline) = Outline::<f32>::new(&geometry, &OutlineShape::of(&geometry)) else { fail() };
    let joints = |t: f32| machine.cylinders_to_tip_unchecked(&along(t), Rotor::IDENTITY).joints;
    let placed = RefCell::new(PlacedOutline::nowhere());
    row(out, stopwatch, "fence_place", joints, |joints| place(&outline, machine, joints, &mut placed.borrow_mut()));

    // A wall just before the linkage's foremost point, and a ceiling and a floor through it.
    let mut limits = Limits::NONE;
    let wall = |normal: [f32; 3]| Some(HalfSpace { normal, offset: 0.5 });
    let [front, ceiling, floor, ..] = &mut limits.half_spaces;
    (*front, *ceiling, *floor) = (wall([1.0, 0.0, 0.0]), wall([0.0, 0.0, 1.0]), wall([0.0, 0.0, -1.0]));
    let stopping = Stopping { deceleration: 1.0, reaction_s: 0.15, margin: 0.02 };
    let fence = black_box(Fence { limits, stopping, turning: stopping });
    let base = BasePlacement::level(Rotor::IDENTITY, [0.0; 3]);
    let wish = [0.5, 0.1, 0.2, 0.3];
    let scene = Scene { swing: Rotor::IDENTITY, base, transmissions: [1.0, 2.0, -2.0, -3.0], wish, spare: [0.01; 4] };
    let nearby = RefCell::new(Nearby::none());
    let placed = |t: f32| match outline.place(machine, &joints(t)) {
        Ok(placed) => (fence.reaches(&placed.strips, &scene), placed),
        Err(_) => fail(),
    };
    row(out, stopwatch, "fence_weigh", placed, |(reaches, placed)| {
        fence.weigh(0, (&placed.strips, reaches), (9, 6), &scene, &mut nearby.borrow_mut())
    });
    let nearby = |t: f32| match outline.place(machine, &joints(t)) {
        Ok(placed) => {
            let mut nearby = Nearby::none();
            fence.weigh_all(&placed.strips, &scene, &mut nearby);
            nearby
        }
        Err(_) => fail(),
    };
    row(out, stopwatch, "fence_limit", nearby, |nearby| limit(&fence, nearby, &wish));
}

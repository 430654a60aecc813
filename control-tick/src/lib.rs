//! The control tick as an image runs it, compiled for speed where all else of the image is compiled for size (`profile.image` of the
//! workspace).
//!
//! Generic functions and those marked `#[inline]` are compiled where they are called: whatever of `firmware` and `kinematics-core` every
//! tick runs is one or the other, and compiled here. The bench image stands beside it, because what it counts must be compiled alike.
#![no_std]
#![forbid(unsafe_code)]

use firmware::board::Controller;
use firmware::{Followers, Inputs, Outputs};

/// [`Controller::tick`].
#[inline(never)]
pub fn tick(controller: &mut Controller<&'static mut Followers>, inputs: &Inputs) -> Outputs {
    controller.tick(inputs)
}

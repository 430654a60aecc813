//! Turning a bit of the controller's memory.

use core::hint::black_box;

use firmware::simulated::link::Zone;

use crate::session::Session;
use crate::target::constant_watch::ConstantWatch;

/// Turns a bit: of the controller, or of the memory of planned motion behind it.
pub(crate) fn flip(session: &mut Session, watch: &ConstantWatch, byte: u32, bit: u8) -> Zone {
    let followers = session.fitted_at();
    let controller = &mut session.controller;
    let sizes = [size_of_val(controller), followers.1];
    let of_all = byte as usize % (sizes[0] + sizes[1]);
    let (address, in_controller) = match of_all.checked_sub(sizes[0]) {
        None => (core::ptr::from_mut(controller).cast::<u8>().wrapping_add(of_all), true),
        Some(beyond) => (followers.0.wrapping_add(beyond), false),
    };
    // SAFETY: a byte of memory that is the controller's, between two ticks. What it means after this is what is tried.
    unsafe { address.write_volatile(address.read_volatile() ^ 1 << bit) };
    // The compiler must not know what was there.
    black_box(controller);
    match (in_controller, watch.watches(address.addr())) {
        (_, true) => Zone::Watched,
        (true, _) => Zone::State,
        (false, _) => Zone::Followers,
    }
}

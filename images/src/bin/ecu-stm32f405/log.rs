//! What a debug probe reads over RTT: changes of state and fault, said from the idle loop. The control task only leaves two bytes.

use core::sync::atomic::{AtomicU8, Ordering};

use defmt_rtt as _;
use firmware::{Fault, Outputs};

static STATE: AtomicU8 = AtomicU8::new(0);
static FAULT: AtomicU8 = AtomicU8::new(0);

/// Leaves this tick's state and fault for the idle loop.
pub(crate) fn leave(outputs: &Outputs) {
    STATE.store(outputs.state.code(), Ordering::Relaxed);
    FAULT.store(outputs.fault.map_or(0, Fault::code), Ordering::Relaxed);
}

/// Says what changed since `said`; gives what is now said.
pub(crate) fn say_changes(said: Option<(u8, u8)>) -> Option<(u8, u8)> {
    let now = Some((STATE.load(Ordering::Relaxed), FAULT.load(Ordering::Relaxed)));
    if let (Some((state, fault)), true) = (now, now != said) {
        defmt::info!("state {}, fault {} {}", state, fault, Fault::from_code(fault).map_or("none", Fault::name));
    }
    now
}

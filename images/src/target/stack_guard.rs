//! A stack that grows too far stops at a guard instead of overwriting the application's state.

use cortex_m::peripheral::MPU;

/// Bytes of the guard, a power of two; the region must be aligned to its size.
const GUARD_BYTES: u32 = 256;

unsafe extern "C" {
    /// End of the static variables, by the linker script of cortex-m-rt: the stack grows down towards it.
    static __sheap: u8;
}

/// Forbids every access to the first aligned 256 bytes above the static variables: whoever touches them ends in the hard-fault handler,
/// or, where even that has no stack left, in a lock-up that the watchdog ends.
pub(crate) fn arm(mpu: &mut MPU) {
    let statics_end = (&raw const __sheap) as u32;
    let guard = statics_end.next_multiple_of(GUARD_BYTES);
    // Region size is 2^(SIZE+1).
    let size = GUARD_BYTES.trailing_zeros() - 1;
    // SAFETY: values of the architecture's MPU registers (ARMv7-M, B3.5); the region lies between statics and stack.
    unsafe {
        mpu.rnr.write(0);
        mpu.rbar.write(guard);
        // Execute never, no access, enabled.
        mpu.rasr.write(1 << 28 | size << 1 | 1);
        // The default map elsewhere (PRIVDEFENA), guard also in fault handlers off, on.
        mpu.ctrl.write(0b101);
    }
    cortex_m::asm::dsb();
    cortex_m::asm::isb();
}

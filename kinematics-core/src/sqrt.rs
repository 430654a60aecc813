//! The square root, correctly rounded everywhere: the FPU's on the ECU, libm's on the host.

/// √x for f32. On a Cortex-M4F this is one `vsqrt.f32`: libm's generic code would cost over 50 instructions.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn sqrt_f32(x: f32) -> f32 {
    unsafe extern "C" {
        // LLVM knows this name and inlines the instruction.
        safe fn sqrtf(x: f32) -> f32;
    }
    sqrtf(x)
}

/// √x for f32.
#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
#[inline(always)]
pub(crate) fn sqrt_f32(x: f32) -> f32 {
    libm::sqrtf(x)
}

/// √x for f64; used at run time on the host and once, for derived constants, on the ECU.
#[inline(always)]
pub(crate) fn sqrt_f64(x: f64) -> f64 {
    libm::sqrt(x)
}

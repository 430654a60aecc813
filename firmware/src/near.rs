//! Short addresses for the stages.

/// The same reference, by a pointer of its own. An image's application is one static of known address; the compiler counts every field from there,
/// and the ECU needs three instructions for a field beyond a kilobyte, one for a field near a pointer. Hidden behind this, a stage's fields
/// are near.
#[inline(always)]
pub(crate) fn near<R>(stage: R) -> R {
    core::hint::black_box(stage)
}

//! Speeds too small to be worth moving for.

/// Passes speeds worth moving for. Sensor noise around rest must not make the spool hop across its dead band: once at rest, a
/// cylinder starts at the smallest speed and stops below half of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Creep {
    moving: bool,
}

impl Creep {
    pub(super) const REST: Self = Self { moving: false };

    #[inline]
    pub(super) fn pass(&mut self, speed: f32, smallest: f32) -> f32 {
        let threshold = if self.moving { 0.5 * smallest } else { smallest };
        self.moving = speed >= threshold || speed <= -threshold;
        if self.moving { speed } else { 0.0 }
    }
}

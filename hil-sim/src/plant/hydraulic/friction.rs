//! Stribeck friction of a cylinder or motor, as force over speed, made smooth through zero.

use libm::sqrt;

/// Speed within which friction turns its sign, m/s or rad/s.
const SMOOTH: f64 = 0.002;

/// Friction of one actuator: N and m/s for a cylinder, N·m and rad/s for a motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// At sliding.
    pub coulomb: f64,
    /// At break-away.
    pub breakaway: f64,
    /// Speed at which half of the difference is gone.
    pub stribeck_speed: f64,
    /// In proportion to speed.
    pub viscous: f64,
}

impl Friction {
    /// Force over speed, never negative: what the implicit step needs.
    pub fn over_speed(&self, speed: f64) -> f64 {
        let share = speed / self.stribeck_speed;
        let sliding = self.coulomb + (self.breakaway - self.coulomb) / (1.0 + share * share);
        sliding / sqrt(speed * speed + SMOOTH * SMOOTH) + self.viscous
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_peaks_slowly_moving_falls_and_rises_again_with_speed() {
        let friction = Friction { coulomb: 4e3, breakaway: 6e3, stribeck_speed: 0.02, viscous: 2e4 };
        let force = |v: f64| friction.over_speed(v) * v;
        assert_eq!(force(0.0), 0.0);
        assert!(force(0.008) > 5.2e3 && force(0.06) < 5.7e3 && force(0.5) > 1.3e4);
        assert_eq!(force(-0.1), -force(0.1));
    }
}

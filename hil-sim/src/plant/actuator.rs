//! One actuator and its spool: dead time, first-order spool, dead band, gains per direction, travel stops. A cylinder's position is
//! its length between the pins, m; a swing motor's is its angle, rad, and has no stops.

use std::collections::VecDeque;

use kinematics_core::geometry::Stroke;

/// What a spool and its actuator are like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActuatorModel {
    /// Travel of a cylinder; `None` for a motor, which turns freely.
    pub stroke: Option<Stroke>,
    /// From the current to the spool's first move, s.
    pub dead_time_s: f64,
    /// Time constant of the spool, s.
    pub spool_lag_s: f64,
    /// Fraction of full scale below which nothing flows: extend, retract.
    pub dead_band: [f64; 2],
    /// Speed at full scale, m/s or rad/s: extend, retract.
    pub full_speed: [f64; 2],
}

/// What is wrong with a spool or its oil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Defect {
    /// The spool stays where it is.
    Stuck,
    /// It leaks: the actuator creeps at this speed besides, m/s or rad/s.
    Leaking(f64),
    /// There is no pressure: nothing moves.
    NoPressure,
}

/// An actuator in motion.
#[derive(Clone, Debug)]
pub struct Actuator {
    model: ActuatorModel,
    /// What is wrong with it.
    pub defect: Option<Defect>,
    /// Spool commands under way, oldest first.
    under_way: VecDeque<f64>,
    spool_step: f64,
    spool: f64,
    position: f64,
    against_stop: bool,
}

impl Actuator {
    /// At rest at `position`, stepped every `step_s`.
    pub fn new(model: ActuatorModel, position: f64, step_s: f64) -> Self {
        let delay = (model.dead_time_s / step_s + 0.5) as usize;
        let spool_step = if model.spool_lag_s > 0.0 { 1.0 - libm::exp(-step_s / model.spool_lag_s) } else { 1.0 };
        Self {
            model,
            defect: None,
            under_way: VecDeque::from(vec![0.0; delay]),
            spool_step,
            spool: 0.0,
            position,
            against_stop: false,
        }
    }

    /// One step under a spool command in −1…1 (extend positive).
    pub fn step(&mut self, command: f64, step_s: f64) {
        self.under_way.push_back(command);
        let delayed = self.under_way.pop_front().unwrap_or(command);
        if self.defect != Some(Defect::Stuck) {
            self.spool += (delayed - self.spool) * self.spool_step;
        }
        let speed = match self.defect {
            None | Some(Defect::Stuck) => self.speed(),
            Some(Defect::Leaking(creep)) => self.speed() + creep,
            Some(Defect::NoPressure) => 0.0,
        };
        let moved = self.position + speed * step_s;
        self.position = self.model.stroke.map_or(moved, |Stroke { min_m, max_m }| moved.clamp(min_m, max_m));
        self.against_stop = self.position != moved;
    }

    /// Speed the spool's opening asks for, m/s or rad/s.
    fn speed(&self) -> f64 {
        let (direction, sign) = if self.spool > 0.0 { (0, 1.0) } else { (1, -1.0) };
        let dead_band = self.model.dead_band[direction];
        let opening = (self.spool * sign - dead_band) / (1.0 - dead_band);
        if opening > 0.0 { sign * opening * self.model.full_speed[direction] } else { 0.0 }
    }

    /// Length between the pins, m, or angle, rad.
    pub fn position(&self) -> f64 {
        self.position
    }

    /// The last step ended at a travel stop that held it back.
    pub fn against_stop(&self) -> bool {
        self.against_stop
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: f64 = 0.001;

    fn cylinder() -> Actuator {
        let model = ActuatorModel {
            stroke: Some(Stroke { min_m: 1.0, max_m: 2.0 }),
            dead_time_s: 0.1,
            spool_lag_s: 0.05,
            dead_band: [0.15, 0.20],
            full_speed: [0.5, 0.4],
        };
        Actuator::new(model, 1.5, STEP)
    }

    fn run(cylinder: &mut Actuator, command: f64, seconds: f64) -> f64 {
        let before = cylinder.position();
        for _ in 0..(seconds / STEP) as u32 {
            cylinder.step(command, STEP);
        }
        cylinder.position() - before
    }

    #[test]
    fn nothing_moves_during_the_dead_time() {
        let mut c = cylinder();
        assert_eq!(run(&mut c, 1.0, 0.1), 0.0);
        assert!(run(&mut c, 1.0, 0.05) > 0.0);
    }

    #[test]
    fn nothing_moves_inside_the_dead_band_of_either_direction() {
        let mut c = cylinder();
        assert_eq!(run(&mut c, 0.149, 1.0), 0.0);
        assert_eq!(run(&mut c, -0.199, 1.0), 0.0);
    }

    #[test]
    fn full_scale_gives_each_direction_its_own_speed() {
        let mut c = cylinder();
        run(&mut c, 1.0, 0.8);
        assert!((run(&mut c, 1.0, 0.2) - 0.1).abs() < 1e-3);
        run(&mut c, -1.0, 1.0);
        assert!((run(&mut c, -1.0, 0.2) + 0.08).abs() < 1e-3);
    }

    #[test]
    fn a_travel_stop_holds_and_says_so() {
        let mut c = cylinder();
        run(&mut c, 1.0, 5.0);
        assert_eq!(c.position(), 2.0);
        assert!(c.against_stop());
        run(&mut c, 0.0, 1.0);
        assert!(!c.against_stop());
    }

    #[test]
    fn a_motor_turns_on_without_a_stop() {
        let model = ActuatorModel { stroke: None, ..cylinder().model };
        let mut motor = Actuator::new(model, 0.0, STEP);
        assert!(run(&mut motor, 1.0, 30.0) > 14.0 && !motor.against_stop());
    }
}

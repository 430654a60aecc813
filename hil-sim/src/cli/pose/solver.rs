//! Any description → the whole report, in one number type, every refusal a sentence.

use kinematics_core::geometry::GeometryError;
use kinematics_core::{Cylinder, Cylinders, Joints, Machine, PinGeometry, PlaneTip, PoseError, Real, Rotor};

use super::angle;
use super::description::{Description, finite};
use super::messages;
use super::rates::Rates;
use super::report::{InPlane, PerLink, Report, Tip};
use super::{Failure, Kind, Number};

/// The poses of one machine in T.
#[derive(Debug)]
pub struct Solver<T> {
    geometry: PinGeometry,
    machine: Machine<T>,
    /// Tells whether a linkage closes: a question about the machine, not about T's rounding.
    exact: Machine<f64>,
    allow_outside: bool,
    with_rates: bool,
}

/// What all descriptions come to before they are printed.
struct Solved<T> {
    joints: Joints<T>,
    cylinders: Cylinders<T>,
    plane: PlaneTip<T>,
}

impl<T: Number> Solver<T> {
    /// # Errors
    /// The first problem of the geometry.
    pub fn new(geometry: &PinGeometry) -> Result<Self, GeometryError> {
        Ok(Self {
            geometry: *geometry,
            machine: Machine::new(geometry)?,
            exact: Machine::new(geometry)?,
            allow_outside: false,
            with_rates: false,
        })
    }

    /// Whether poses outside the stroke are reported too.
    #[must_use]
    pub fn allowing_outside(self, allow_outside: bool) -> Self {
        Self { allow_outside, ..self }
    }

    /// Whether the report carries rates.
    #[must_use]
    pub fn with_rates(self, with_rates: bool) -> Self {
        Self { with_rates, ..self }
    }

    /// The pose a description gives, swung by `swing_deg`. The given numbers are reported as given, rounded to T.
    ///
    /// # Errors
    /// `invalid_input` for a number that is none or a negative length; `out_of_stroke` unless allowed; `no_assembly`,
    /// `unreachable`.
    pub fn pose(&self, description: &Description, swing_deg: f64) -> Result<Report<T>, Failure> {
        finite("swing_deg", swing_deg)?;
        description.validate()?;
        let solved = match *description {
            Description::Cylinders(lengths) => self.solve_cylinders(lengths)?,
            Description::Joints(degrees) => self.solve_joints(degrees)?,
            Description::Tip(tip) => self.solve_tip(tip)?,
        };
        let within_stroke = match self.machine.check_strokes(&solved.cylinders) {
            Ok(()) => true,
            Err(_) if self.allow_outside => false,
            Err(error) => return Err(self.explain_cylinders(&error, &solved.cylinders)),
        };
        let mut report = self.report(&solved, swing_deg, within_stroke);
        match *description {
            Description::Joints(degrees) => report.joints_deg = per_link(degrees.map(angle::wrapped)),
            Description::Tip([.., pitch]) => report.tip.pitch_deg = angle::wrapped(pitch),
            Description::Cylinders(_) => {}
        }
        if self.with_rates {
            report.rates = Some(self.rates(description, &solved)?);
        }
        if report.numbers().into_iter().all(|x| x.to_f64().is_finite()) {
            Ok(report)
        } else {
            Err(Failure::invalid_input("the machine's lengths are too large for this precision".into()))
        }
    }

    /// From the lengths where these are given, else from the joints: each the accurate way next to a dead point.
    fn rates(&self, description: &Description, solved: &Solved<T>) -> Result<Rates<T>, Failure> {
        let arms = match description {
            Description::Cylinders(_) => self
                .machine
                .moment_arms(&solved.cylinders)
                .map_err(|e| self.explain_cylinders(&e, &solved.cylinders))?,
            Description::Joints(_) | Description::Tip(_) => {
                let exact = |r: Rotor<T>| Rotor { cos: r.cos.to_f64(), sin: r.sin.to_f64() };
                let Joints { boom, arm, bucket } = solved.joints;
                self.machine.moment_arms_at(&solved.joints).map_err(|e| {
                    let joints = Joints { boom: exact(boom), arm: exact(arm), bucket: exact(bucket) };
                    self.explain_joints(&e, &joints)
                })?
            }
        };
        Ok(Rates::new(&arms, &self.machine.chain().jacobian(&solved.joints)))
    }

    fn solve_cylinders(&self, [boom, arm, bucket]: [f64; 3]) -> Result<Solved<T>, Failure> {
        let cylinders = Cylinders { boom: T::from_f64(boom), arm: T::from_f64(arm), bucket: T::from_f64(bucket) };
        let joints = if self.allow_outside {
            self.machine.cylinders_to_joints_any_stroke(&cylinders)
        } else {
            self.machine.cylinders_to_joints(&cylinders)
        };
        let joints = joints.map_err(|e| self.explain_cylinders(&e, &Cylinders { boom, arm, bucket }))?;
        Ok(Solved { joints, cylinders, plane: self.machine.chain().tip(&joints) })
    }

    fn solve_joints(&self, degrees: [f64; 3]) -> Result<Solved<T>, Failure> {
        let [boom, arm, bucket] = degrees.map(angle::rotor);
        let exact = Joints { boom, arm, bucket };
        self.check_assembly(&exact)?;
        let [boom, arm, bucket] = [boom, arm, bucket].map(angle::rounded);
        let joints = Joints { boom, arm, bucket };
        let cylinders = self.lengths(&joints, &exact)?;
        Ok(Solved { joints, cylinders, plane: self.machine.chain().tip(&joints) })
    }

    fn solve_tip(&self, tip: [f64; 3]) -> Result<Solved<T>, Failure> {
        let [reach, height, pitch] = tip;
        let pitch = angle::rotor(pitch);
        let unreachable = |by| messages::unreachable(&self.geometry, tip, by);
        let exact = match self.exact.tip_to_joints(&PlaneTip { reach, height, pitch }) {
            Ok(exact) => exact,
            Err(error) => return Err(unreachable(excess(&error))),
        };
        self.check_assembly(&exact)?;
        let plane = PlaneTip { reach: T::from_f64(reach), height: T::from_f64(height), pitch: angle::rounded(pitch) };
        let joints = self.machine.tip_to_joints(&plane).map_err(|e| unreachable(excess(&e).to_f64()))?;
        let cylinders = self.lengths(&joints, &exact)?;
        Ok(Solved { joints, cylinders, plane })
    }

    fn lengths(&self, joints: &Joints<T>, exact: &Joints<f64>) -> Result<Cylinders<T>, Failure> {
        self.machine.joints_to_cylinders_any_stroke(joints).map_err(|e| self.explain_joints(&e, exact))
    }

    /// Whether some length gives each joint: asked in f64, so that rounding in T does not decide near a dead point.
    fn check_assembly(&self, joints: &Joints<f64>) -> Result<(), Failure> {
        match self.exact.joints_to_cylinders_any_stroke(joints) {
            Ok(_) => Ok(()),
            Err(error) => Err(self.explain_joints(&error, joints)),
        }
    }

    fn explain_cylinders<L: Real>(&self, error: &PoseError<T>, lengths: &Cylinders<L>) -> Failure {
        let length = |cylinder| messages::length(lengths, cylinder).to_f64();
        match *error {
            PoseError::OutOfStroke { cylinder, .. } => {
                messages::out_of_stroke(&self.geometry, cylinder, length(cylinder))
            }
            PoseError::NoAssembly { cylinder, by } => {
                messages::open(&self.geometry, cylinder, length(cylinder), by.to_f64())
            }
            PoseError::Unreachable { by } => {
                let message = format!("the bucket pin is {by} m outside what boom and arm reach");
                Failure { kind: Kind::Unreachable, message }
            }
        }
    }

    fn explain_joints<E: Real>(&self, error: &PoseError<E>, joints: &Joints<f64>) -> Failure {
        let cylinder = match *error {
            PoseError::NoAssembly { cylinder, .. } | PoseError::OutOfStroke { cylinder, .. } => cylinder,
            PoseError::Unreachable { .. } => Cylinder::Arm,
        };
        messages::no_length(&self.geometry, cylinder, messages::joint(joints, cylinder), excess(error).to_f64())
    }

    fn report(&self, solved: &Solved<T>, swing_deg: f64, within_stroke: bool) -> Report<T> {
        let Solved { joints, cylinders, plane } = solved;
        let swing = angle::rounded::<T>(angle::rotor(swing_deg));
        let [a1, ..] = self.machine.chain().lengths();
        // −0 would be a second name for 0.
        let plain = |x: T| x + T::ZERO;
        Report {
            swing_deg: angle::wrapped(swing_deg),
            joints_deg: per_link([joints.boom, joints.arm, joints.bucket].map(angle::degrees)),
            cylinders_m: per_link([cylinders.boom, cylinders.arm, cylinders.bucket].map(plain)),
            tip: Tip {
                x_m: plain(plane.reach * swing.cos),
                y_m: plain(plane.reach * swing.sin),
                z_m: plain(plane.height),
                pitch_deg: angle::degrees(plane.pitch),
                reach_m: plain(plane.reach),
            },
            tip_from_boom_pin: InPlane { x_m: plain(plane.reach - a1), z_m: plain(plane.height) },
            within_stroke,
            rates: None,
        }
    }
}

fn excess<E: Real>(error: &PoseError<E>) -> E {
    match *error {
        PoseError::OutOfStroke { by, .. } | PoseError::Unreachable { by } | PoseError::NoAssembly { by, .. } => by,
    }
}

fn per_link<T>([boom, arm, bucket]: [T; 3]) -> PerLink<T> {
    PerLink { boom, arm, bucket }
}

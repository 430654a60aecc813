//! The coordinated modes of one machine: whichever is asked for, the law is the same.

use kinematics_core::{Cylinders, Machine, Pose};

use super::Wanted;
use super::coordinated::Coordination;
use super::delays::Delays;
use super::grade::GradeFollower;
use super::law::Law;
use super::limits::Limits;
use super::path::PathFollower;
use super::tip_velocity::TipFollower;
use crate::can::command::Slope;
use crate::command::Intent;
use crate::diagnosis::Pressures;
use crate::fault::Fault;
use crate::io::{Request, Speeds};
use crate::law::LawParameters;
use crate::near::near;
use crate::parameters::{ParameterError, Parameters};

/// Path, grade and tip velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Modes {
    shared: Coordination,
    path: Option<PathFollower>,
    grade: Option<GradeFollower>,
    tip: TipFollower,
    preview_s: f32,
}

impl Modes {
    pub(super) fn new(law: &LawParameters, p: &Parameters, machine: &Machine<f32>) -> Result<Self, ParameterError> {
        let path = p.path.as_ref().map(|path| PathFollower::new(path, machine)).transpose();
        let preview_s = p.motion.preview_s;
        Ok(Self {
            shared: Coordination::new(Law::new(&p.motion, law), Limits::new(law, &p.coils.valves(), &p.geometry), law),
            path: path.map_err(ParameterError::Path)?,
            grade: p.grade.as_ref().map(|grade| GradeFollower::new(grade, preview_s, law)),
            tip: TipFollower::new(preview_s, law),
            preview_s,
        })
    }

    /// Nothing is under way: what was known of loads is forgotten too.
    pub(super) fn reset(&mut self) {
        self.shared.overrun.reset();
        self.start_over();
    }

    /// Another mode begins.
    pub(super) fn start_over(&mut self) {
        self.shared.overrun.start_over();
        self.tip.reset();
        if let Some(path) = &mut self.path {
            path.reset();
        }
        if let Some(grade) = &mut self.grade {
            grade.reset();
        }
    }

    /// Lever speeds, slow enough before the ends of the strokes, where what the actuators were `told` last will have brought them when this is
    /// heard.
    #[inline]
    pub(super) fn cushion(&mut self, lengths: &Cylinders<f32>, told: [f32; 4], speeds: Speeds) -> Speeds {
        self.shared.speeds = told;
        let heard = self.shared.ahead(lengths, self.preview_s);
        self.shared.limits.cushion(&heard, speeds)
    }

    /// One tick's pressures.
    #[inline(always)]
    pub(super) fn weigh(&mut self, pressures_pa: &Pressures) {
        self.shared.overrun.weigh(pressures_pa);
    }

    /// One tick of the mode asked for; `speeds` are those of the last tick, from which all but a path begin, `arm_mps` what the arm's lever
    /// asks for.
    #[inline]
    pub(super) fn follow(
        &mut self,
        machine: &Machine<f32>,
        (intent, arm_mps, slope): (&Intent, f32, Option<Slope>),
        (speeds, delays): (impl FnOnce() -> [f32; 4], &mut Delays),
        pose: &Pose<f32>,
        lengths: &Cylinders<f32>,
    ) -> Result<Wanted, Fault> {
        let Self { shared, path, grade, tip, .. } = self;
        let shared = (near(shared), near(delays));
        match intent.request {
            Request::TipVelocity => {
                shared.0.speeds = speeds();
                near(tip).follow(machine, shared, &intent.tip, pose, lengths)
            }
            Request::Grade => {
                shared.0.speeds = speeds();
                let grade = near(grade).as_mut().ok_or(Fault::NotConfigured)?;
                grade.follow(machine, shared, (arm_mps, slope), pose, lengths)
            }
            _ => near(path).as_mut().ok_or(Fault::NotConfigured)?.follow(machine, shared, pose, lengths),
        }
    }
}

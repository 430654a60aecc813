//! Park 2008, Figures 5 and 6: the arm chosen for them, as `scenarios/obstacle-park.toml` has it. The paper gives the gains s_o, s_1
//! and s_2 alone.

use kinematics_core::chain_n::PlanarChain;
use kinematics_core::planning::obstacle::Obstacle;
use kinematics_core::planning::park::Direction;
use kinematics_core::planning::planner::{Outcome, Planner, PlannerParameters};
use kinematics_core::{Rotor, Vec2};

/// An arm on its way to a point, round an obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Four links.
    pub chain: PlanarChain<f64, 4>,
    /// Every joint's angle at the start, rad.
    pub start_rad: [f64; 4],
    /// Where the tip is to go, m.
    pub target: Vec2<f64>,
    /// What is in the way.
    pub obstacle: Obstacle<f64>,
    /// Gains and limits.
    pub parameters: PlannerParameters<f64, 4>,
    /// Iterations of a run.
    pub iterations: u32,
}

/// The arm of Figure 6; with no gains of links that of Figure 5.
pub fn figure() -> Figure {
    Figure {
        chain: PlanarChain::new([1.0; 4]),
        start_rad: [110.0, -80.0, -10.0, -20.0].map(f64::to_radians),
        target: Vec2::new(0.05, 3.0),
        obstacle: Obstacle { position: Vec2::new(1.0, 2.4), keep_m: 0.25, acts_m: 0.5 },
        parameters: PlannerParameters {
            end_effector: 0.3,
            obstacle: 0.2,
            links: [0.01, 0.01, 0.0, 0.0],
            directions: [Direction::Hold; 4],
            trusted_m: 0.1,
            turn_rad: 0.2,
            tolerance_m: 0.01,
        },
        iterations: 100,
    }
}

impl Figure {
    /// The pose at the start.
    pub fn start(&self) -> [Rotor<f64>; 4] {
        self.start_rad.map(Rotor::from_angle)
    }

    /// How a run ends, with these gains of the links.
    ///
    /// # Panics
    /// When a parameter is out of its range.
    pub fn run(&self, links: [f64; 4]) -> Outcome<f64> {
        let planner = Planner::new(self.chain, PlannerParameters { links, ..self.parameters }).unwrap();
        planner.run(&self.start(), self.target, Some(&self.obstacle), self.iterations, |_, _| ())
    }
}

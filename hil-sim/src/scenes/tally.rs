//! What all scenes of one machine showed together.

use serde::Serialize;

use super::{Ended, Look, Outcome, Proof};

/// The report of one machine.
#[derive(Clone, Debug, Serialize)]
pub struct Tally {
    /// Its name.
    pub machine: String,
    /// How many scenes.
    pub scenes: usize,
    /// The tip came to the target.
    pub reached: usize,
    /// No clear pose reaches the target; the independent search found none either.
    pub blocked_with_proof: usize,
    /// The planner says so, but the search found one.
    pub blocked_wrongly: usize,
    /// A clear pose exists, but no route was found.
    pub no_route: usize,
    /// Stuck or out of time.
    pub not_converged: usize,
    /// Of the scenes neither reached nor blocked: those in which a flood over a grid of all poses finds no path either.
    pub no_path_on_grid: usize,
    /// Scenes in which hull and sphere touched.
    pub collisions: usize,
    /// reached ÷ (scenes − blocked with proof).
    pub rate: f64,
    /// Smallest distance while moving, over all scenes, m.
    pub smallest_clearance_m: f64,
    /// Mean of the tip's way over its way without obstacles, of the scenes reached.
    pub mean_detour: f64,
    /// Straight at the target as if there were nothing: collisions.
    pub blind_collisions: usize,
    /// The step alone, without routes: scenes in which it got stuck.
    pub step_alone_stuck: usize,
    /// Planning before motion, s: the median and the longest of the scenes reached.
    pub planning_s: [f64; 2],
    /// The scenes that were neither reached nor blocked with proof, or that collided.
    pub failing: Vec<Failure>,
}

/// A scene that should not have ended as it did.
#[derive(Clone, Debug, Serialize)]
pub struct Failure {
    /// Its number.
    pub scene: u64,
    /// How it ended.
    pub ended: Ended,
    /// Whether a grid has a path.
    pub proof: Option<Proof>,
    /// What a look at it shows.
    pub look: Option<Look>,
}

impl Failure {
    fn of(outcome: &Outcome) -> Self {
        let Outcome { scene, ended, proof, look, .. } = *outcome;
        Self { scene, ended, proof, look }
    }

    /// One line for people.
    fn to_line(&self) -> String {
        let ended = match self.ended {
            Ended::Reached => "collided",
            Ended::Blocked => "blocked",
            Ended::NoRoute => "no route",
            Ended::NotConverged => "not converged",
        };
        let grid = if self.proof == Some(Proof::PathOnGrid) { "path on the grid" } else { "no path on the grid" };
        let look = self.look.map_or(String::new(), |look| {
            let place = if look.about_the_axis { "about the swing axis" } else { "elsewhere" };
            format!(", a sphere {place}, by one aim on the way {} of {}", look.arrived, look.tried)
        });
        format!("{ended}, {grid}{look}")
    }
}

impl Tally {
    /// Of one machine's outcomes.
    pub fn of(machine: &str, outcomes: &[Outcome]) -> Self {
        let count = |is: &dyn Fn(&Outcome) -> bool| outcomes.iter().filter(|o| is(o)).count();
        let proved = |o: &Outcome| o.ended != Ended::Reached && o.proof == Some(Proof::NoClearPose);
        let collided = |o: &Outcome| o.smallest_clearance_m < 0.0;
        let reached = count(&|o| o.ended == Ended::Reached);
        let blocked_with_proof = count(&proved);
        let mut detours = Vec::new();
        let mut planning: Vec<f64> = Vec::new();
        for o in outcomes.iter().filter(|o| o.ended == Ended::Reached) {
            planning.push(o.planning_s);
            if o.free_way_m > 0.0 {
                detours.push(o.way_m / o.free_way_m);
            }
        }
        planning.sort_by(f64::total_cmp);
        let failing = |o: &&Outcome| collided(o) || (o.ended != Ended::Reached && !proved(o));
        Self {
            machine: machine.to_owned(),
            scenes: outcomes.len(),
            reached,
            blocked_with_proof,
            blocked_wrongly: count(&|o| o.ended == Ended::Blocked && !proved(o)),
            no_route: count(&|o| o.ended == Ended::NoRoute && !proved(o)),
            not_converged: count(&|o| o.ended == Ended::NotConverged && !proved(o)),
            no_path_on_grid: count(&|o| o.ended != Ended::Reached && o.proof == Some(Proof::NoPathOnGrid)),
            collisions: count(&collided),
            rate: reached as f64 / (outcomes.len() - blocked_with_proof).max(1) as f64,
            smallest_clearance_m: outcomes.iter().map(|o| o.smallest_clearance_m).fold(f64::INFINITY, f64::min),
            mean_detour: detours.iter().sum::<f64>() / detours.len().max(1) as f64,
            blind_collisions: count(&|o| o.blind_collides),
            step_alone_stuck: count(&|o| o.step_alone_stuck),
            planning_s: [planning.len() / 2, planning.len().saturating_sub(1)]
                .map(|i| planning.get(i).copied().unwrap_or(0.0)),
            failing: outcomes.iter().filter(failing).map(Failure::of).collect(),
        }
    }

    /// For people.
    pub fn to_table(&self) -> String {
        let line = |name: &str, value: String| format!("  {name:<44} {value}\n");
        let mut table = format!("{}: {} scenes\n", self.machine, self.scenes);
        table += &line("reached", self.reached.to_string());
        table += &line("blocked, no clear pose (proved)", self.blocked_with_proof.to_string());
        table += &line("rate of what can be reached", format!("{:.2} %", 100.0 * self.rate));
        table += &line("blocked wrongly / no route / not converged", {
            format!("{} / {} / {}", self.blocked_wrongly, self.no_route, self.not_converged)
        });
        table += &line("… of these without a path on a grid either", self.no_path_on_grid.to_string());
        table += &line("collisions", self.collisions.to_string());
        table += &line("smallest clearance", format!("{:.1} mm", 1e3 * self.smallest_clearance_m));
        table += &line("mean detour of the tip", format!("{:.3} of the way without obstacles", self.mean_detour));
        table += &line("straight and blind would have collided", self.blind_collisions.to_string());
        table += &line("the step without routes would have stuck", self.step_alone_stuck.to_string());
        table += &line("planning before motion, median and longest", {
            let [median, longest] = self.planning_s;
            format!("{median:.2} s, {longest:.2} s")
        });
        for failure in &self.failing {
            table += &line(&format!("--scene {}", failure.scene), failure.to_line());
        }
        table
    }
}

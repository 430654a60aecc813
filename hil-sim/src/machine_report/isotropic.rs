//! Isotropic points of a machine within its stroke, and its best and worst condition number.
//!
//! The condition number of the 2 × 3 Jacobian does not depend on θ2 (Hareesha 2015, after (20)): arm and bucket are searched, the
//! boom is free. Isotropic configurations come complete from the links alone, so "none" means none.

use std::fmt;

use kinematics_core::chain_n::PlanarChain;
use kinematics_core::geometry::Stroke;
use kinematics_core::isotropic_configurations::isotropic_configurations;
use kinematics_core::isotropy::{condition_number, velocity_ellipse};
use kinematics_core::{Cylinders, GeometryError, Joints, Machine, PinGeometry, Rotor};
use serde::Serialize;

/// Points a side of the even grid over both strokes, where every local extremum starts a search of its own.
const GRID: usize = 241;
/// Halvings of the step from a grid point: to 1e-12 of the grid's step.
const HALVINGS: u32 = 40;

/// A pose of arm and bucket; the boom is free.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ArmPose {
    /// θ3, degrees.
    pub arm_deg: f64,
    /// θ4, degrees.
    pub bucket_deg: f64,
    /// Arm cylinder, m.
    pub arm_m: f64,
    /// Bucket cylinder, m.
    pub bucket_m: f64,
    /// κ = σ₁/σ₂; `None` where J is singular.
    pub condition: Option<f64>,
    /// σ₁, m.
    pub largest_m: f64,
    /// σ₂, m.
    pub smallest_m: f64,
}

impl fmt::Display for ArmPose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { arm_deg, bucket_deg, arm_m, bucket_m, largest_m, smallest_m, .. } = self;
        match self.condition {
            Some(condition) => write!(f, "condition number {condition:.4}")?,
            None => f.write_str("singular")?,
        }
        write!(f, " at θ3 {arm_deg:.2}°, θ4 {bucket_deg:.2}° (arm {arm_m:.4} m, bucket {bucket_m:.4} m): ")?;
        write!(f, "σ {largest_m:.3} and {smallest_m:.3} m")
    }
}

/// The isotropy of a machine over its stroke.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Isotropy {
    /// Isotropic configurations of the links, within the stroke or not: at most eight.
    pub of_the_links: usize,
    /// Those within the stroke.
    pub isotropic: Vec<ArmPose>,
    /// The smallest condition number within the stroke; the first isotropic point if there is one.
    pub best: ArmPose,
    /// The largest condition number within the stroke.
    pub worst: ArmPose,
}

impl fmt::Display for Isotropy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { of_the_links, isotropic, best, worst } = self;
        if isotropic.is_empty() {
            writeln!(f, "isotropic points within the stroke: none ({of_the_links} of the links alone)")?;
        } else {
            writeln!(f, "isotropic points within the stroke: {} of {of_the_links}", isotropic.len())?;
            for pose in isotropic {
                writeln!(f, "  {pose}")?;
            }
        }
        writeln!(f, "best:  {best}")?;
        write!(f, "worst: {worst}")
    }
}

/// The condition number over arm and bucket cylinder of one machine.
struct Search {
    machine: Machine<f64>,
    chain: PlanarChain<f64, 3>,
    boom_m: f64,
    strokes: [Stroke; 2],
}

impl Search {
    fn pose(&self, joints: &Joints<f64>, [arm_m, bucket_m]: [f64; 2]) -> ArmPose {
        let jacobian = self.chain.jacobian(&[Rotor::IDENTITY, joints.arm, joints.bucket]);
        let ellipse = velocity_ellipse(&jacobian);
        ArmPose {
            arm_deg: joints.arm.angle().to_degrees(),
            bucket_deg: joints.bucket.angle().to_degrees(),
            arm_m,
            bucket_m,
            condition: condition_number(&jacobian),
            largest_m: ellipse.major,
            smallest_m: ellipse.minor,
        }
    }

    /// The pose at these parts of the arm's and the bucket's stroke.
    fn at(&self, parts: [f64; 2]) -> ArmPose {
        let [arm, bucket] = self.lengths(parts);
        let joints = self.machine.cylinders_to_tip_unchecked(&self.cylinders([arm, bucket]), Rotor::IDENTITY).joints;
        self.pose(&joints, [arm, bucket])
    }

    fn lengths(&self, parts: [f64; 2]) -> [f64; 2] {
        let [arm, bucket] = self.strokes;
        let [p, q] = parts;
        [arm.min_m + p * (arm.max_m - arm.min_m), bucket.min_m + q * (bucket.max_m - bucket.min_m)]
    }

    fn cylinders(&self, [arm, bucket]: [f64; 2]) -> Cylinders<f64> {
        Cylinders { boom: self.boom_m, arm, bucket }
    }

    /// What to make small: κ, or its negative. A singular pose counts as infinite.
    fn cost(&self, parts: [f64; 2], sign: f64) -> f64 {
        sign * self.at(parts).condition.unwrap_or(f64::INFINITY)
    }

    /// The lowest of all local minima of sign·κ.
    fn lowest(&self, sign: f64) -> ArmPose {
        let part = |n: usize| n as f64 / (GRID - 1) as f64;
        let costs: Vec<f64> = (0..GRID * GRID).map(|n| self.cost([part(n / GRID), part(n % GRID)], sign)).collect();
        let mut best = (f64::INFINITY, [0.0; 2]);
        for i in 0..GRID {
            for k in 0..GRID {
                let here = costs[i * GRID + k];
                let rows = i.saturating_sub(1)..=(i + 1).min(GRID - 1);
                let lowest_here = rows
                    .flat_map(|r| (k.saturating_sub(1)..=(k + 1).min(GRID - 1)).map(move |c| r * GRID + c))
                    .all(|n| costs[n] >= here);
                if lowest_here {
                    let found = self.descended([part(i), part(k)], sign);
                    if found.0 < best.0 {
                        best = found;
                    }
                }
            }
        }
        self.at(best.1)
    }

    /// From a grid point downwards: the best of sixteen neighbours, or half the step.
    fn descended(&self, mut parts: [f64; 2], sign: f64) -> (f64, [f64; 2]) {
        const TURNS: [[f64; 2]; 16] = [
            [1.0, 0.0],
            [0.0, 1.0],
            [-1.0, 0.0],
            [0.0, -1.0],
            [1.0, 1.0],
            [-1.0, 1.0],
            [-1.0, -1.0],
            [1.0, -1.0],
            [1.0, 0.5],
            [0.5, 1.0],
            [-0.5, 1.0],
            [-1.0, 0.5],
            [-1.0, -0.5],
            [-0.5, -1.0],
            [0.5, -1.0],
            [1.0, -0.5],
        ];
        let mut cost = self.cost(parts, sign);
        let mut step = 1.0 / (GRID - 1) as f64;
        let mut halvings = 0;
        while halvings < HALVINGS {
            let neighbours = TURNS.map(|turn| {
                let [p, q] = [parts[0] + step * turn[0], parts[1] + step * turn[1]].map(|x| x.clamp(0.0, 1.0));
                (self.cost([p, q], sign), [p, q])
            });
            let lowest =
                neighbours.into_iter().fold((cost, parts), |low, next| if next.0 < low.0 { next } else { low });
            if lowest.0 < cost {
                (cost, parts) = lowest;
            } else {
                step *= 0.5;
                halvings += 1;
            }
        }
        (cost, parts)
    }
}

/// Searches a machine's stroke.
///
/// # Errors
/// What is wrong with the geometry.
///
/// ```
/// use hil_sim::machine_report::isotropic::isotropy;
/// use kinematics_core::PinGeometry;
/// let found = isotropy(&PinGeometry::EXACT_MINI).unwrap();
/// println!("{found}");
/// assert!(found.worst.condition > found.best.condition);
/// ```
pub fn isotropy(geometry: &PinGeometry) -> Result<Isotropy, GeometryError> {
    let machine = Machine::new(geometry)?;
    let boom = geometry.boom.stroke;
    let search = Search {
        chain: PlanarChain::from(machine.chain()),
        machine,
        boom_m: 0.5 * (boom.min_m + boom.max_m),
        strokes: [geometry.arm.stroke, geometry.bucket.stroke],
    };
    let links = isotropic_configurations([geometry.boom_m, geometry.arm_m, geometry.bucket_m]);
    let middle =
        search.machine.cylinders_to_tip_unchecked(&search.cylinders(search.lengths([0.5; 2])), Rotor::IDENTITY);
    let isotropic: Vec<ArmPose> = links
        .iter()
        .flatten()
        .filter_map(|found| {
            let joints = Joints { boom: middle.joints.boom, arm: found.arm, bucket: found.bucket };
            let cylinders = search.machine.joints_to_cylinders(&joints).ok()?;
            Some(search.pose(&joints, [cylinders.arm, cylinders.bucket]))
        })
        .collect();
    let best = isotropic.first().copied().unwrap_or_else(|| search.lowest(1.0));
    Ok(Isotropy { of_the_links: links.iter().flatten().count(), isotropic, best, worst: search.lowest(-1.0) })
}

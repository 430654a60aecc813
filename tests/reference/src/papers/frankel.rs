//! Frankel 2003's distances, angles and programs, in inches and radians, in the paper's own terms.

use core::f64::consts::PI;

use libm::{acos, atan, atan2, cos, sin, sqrt};

/// a1…a4, in.
pub const LINKS: [f64; 4] = [8.5, 48.0, 38.5, 18.5];

/// The angle between `a` and `b`, opposite `c`.
pub fn corner(a: f64, b: f64, c: f64) -> f64 {
    acos((a * a + b * b - c * c) / (2.0 * a * b))
}

/// The side opposite `angle`.
fn side(a: f64, b: f64, angle: f64) -> f64 {
    sqrt(a * a + b * b - 2.0 * a * b * cos(angle))
}

const R3D: f64 = 47.25;
const R3F: f64 = 4.5;
const REF: f64 = 30.77;
const R3G: f64 = 5.5;
const RFH: f64 = 9.5;
const RGH: f64 = 9.5;

/// θ_23D, (11).
pub fn t23d() -> f64 {
    corner(LINKS[2], R3D, 9.1875)
}

/// θ_G34.
pub fn tg34() -> f64 {
    corner(R3G, LINKS[3], 20.01)
}

/// θ_DFE.
pub fn tdfe() -> f64 {
    corner(R3D - R3F, REF, 13.0)
}

/// (1)–(9): swing, boom and stick cylinder, in, from θ1, θ2, θ3.
pub fn joint_to_cyl_1_to_3(theta: [f64; 3]) -> [f64; 3] {
    let (rjm, r0m, r0k) = (10.0, 6.0, 5.5);
    let r0j = sqrt(r0m * r0m + rjm * rjm);
    let swing = side(r0j, r0k, PI - atan(rjm / r0m) + theta[0]);
    let (r1a, r1b) = (sqrt(10.5 * 10.5 + 1.0), 36.0);
    let boom = side(r1a, r1b, PI - atan(10.5) - corner(r1b, LINKS[1], 12.35) - theta[1]);
    let (r2c, r2d) = (36.25, 9.1875);
    let stick = side(r2c, r2d, 3.0 * PI - corner(r2d, LINKS[2], R3D) - corner(LINKS[1], r2c, 17.5) - theta[2]);
    [swing, boom, stick]
}

/// (12), (14) as printed: φ1, φ2 from the first columns of frames 3 and 4 as they stand in the base frame.
pub fn loop_angles_printed(swing: f64, forearm: f64, pitch: f64) -> [f64; 2] {
    let from_column = |angle: f64| atan2(sin(angle), cos(angle) * cos(swing));
    [from_column(forearm) - t23d(), from_column(pitch) + tg34()]
}

/// Both solutions φ4 of the vector loop (15), found by circles; first the one of the machine.
pub fn loop_solutions([phi1, phi2]: [f64; 2]) -> [f64; 2] {
    // R3 + R4 = −(R1 + R2), from G back to F.
    let (x, y) = (-R3F * cos(phi1) - R3G * cos(phi2), -R3F * sin(phi1) - R3G * sin(phi2));
    let distance = sqrt(x * x + y * y);
    let at_f = corner(distance, RFH, RGH);
    let from_g = atan2(y, x);
    [from_g + at_f, from_g - at_f]
}

/// (16), (17), (18): the bucket cylinder, in, from φ1 and φ4. `turn` is π in (16) and −π in the program.
pub fn bucket_cylinder(phi1: f64, phi4: f64, turn: f64) -> f64 {
    let thf3 = turn - phi1 + phi4;
    side(REF, RFH, PI - tdfe() - thf3)
}

/// `cyl_to_joint`: θ1…θ4 from the cylinders, in.
pub fn cyl_to_joint(rc: [f64; 4]) -> [f64; 4] {
    let (r1a, r1b) = (sqrt(10.5 * 10.5 + 1.0), 36.0);
    let theta2 = PI - atan(10.5) - corner(r1a, r1b, rc[1]) - corner(r1b, LINKS[1], 12.35);
    let (r2c, r2d) = (36.25, 9.1875);
    let theta3 = 3.0 * PI - corner(LINKS[1], r2c, 17.5) - corner(r2c, r2d, rc[2]) - corner(r2d, LINKS[2], R3D);
    let thf3 = PI - tdfe() - corner(REF, RFH, rc[3]);
    let r3h = side(R3F, RFH, thf3);
    let theta4 = 3.0 * PI - corner(R3F, r3h, RFH) - corner(r3h, R3G, RGH) - tg34() - t23d();
    [0.0, theta2, theta3, theta4]
}

/// The bucket displacement B of `backhoe_sim` for a tip (in) and the seed's φ: R_x(90°)·R_z(180°)·R_y(−θ)·R_z(φ) and the tip.
pub fn bucket_displacement(tip: [f64; 3], swing: f64, phi: f64) -> [[f64; 4]; 3] {
    let (c, s, cp, sp) = (cos(swing), sin(swing), cos(phi), sin(phi));
    [[-c * cp, c * sp, s, tip[0]], [-s * cp, s * sp, -c, tip[1]], [-sp, -cp, 0.0, tip[2]]]
}

/// What `Rdisp` and its derivation differ in, or do wrong.
#[derive(Clone, Copy, Debug)]
pub struct Reverse {
    /// θ1 from B: (1), or the program's arctangent.
    pub swing: fn(&[[f64; 4]; 3]) -> f64,
    /// Frame 1 in frame 0 at θ1.
    pub frame: fn(f64) -> [[f64; 3]; 3],
    /// −1 as the program has it with `p113=p114-p134`; +1 for (6) with (10).
    pub wrist: f64,
    /// The sign of sin θ3.
    pub elbow: f64,
    /// φ from B and θ1: (23).
    pub pitch: fn(&[[f64; 4]; 3], f64) -> f64,
}

/// The frame of the program, `Rx90*Ryt1`, where `Ryt1` is a rotation about z.
pub fn frame_of_the_program(t: f64) -> [[f64; 3]; 3] {
    [[cos(t), -sin(t), 0.0], [0.0, 0.0, -1.0], [sin(t), cos(t), 0.0]]
}

/// R_x(90°)·R_y(θ1), the Denavit–Hartenberg frame 1.
pub fn frame_1(t: f64) -> [[f64; 3]; 3] {
    [[cos(t), 0.0, sin(t)], [sin(t), 0.0, -cos(t)], [0.0, 1.0, 0.0]]
}

/// The displacement analysis with everything put right.
pub const CORRECTED: Reverse = Reverse {
    swing: |b| atan2(b[1][3], b[0][3]),
    frame: frame_1,
    wrist: -1.0,
    elbow: -1.0,
    pitch: |b, t| atan2(b[2][0], b[0][0] * cos(t) + b[1][0] * sin(t)),
};

impl Reverse {
    /// θ1…θ4 from B: (3)–(24).
    pub fn angles(&self, b: &[[f64; 4]; 3]) -> [f64; 4] {
        let [a1, a2, a3, a4] = LINKS;
        let t1 = (self.swing)(b);
        let frame = (self.frame)(t1);
        let into = |v: [f64; 3]| -> [f64; 2] { core::array::from_fn(|k| (0..3).map(|i| frame[i][k] * v[i]).sum()) };
        let tip = into([b[0][3], b[1][3], b[2][3]]);
        let pin = into([a1 * cos(t1), a1 * sin(t1), 0.0]);
        let back = into([a4 * b[0][0], a4 * b[1][0], a4 * b[2][0]]);
        let [x, y]: [f64; 2] = core::array::from_fn(|i| tip[i] - pin[i] + self.wrist * back[i]);
        let c3 = (x * x + y * y - a2 * a2 - a3 * a3) / (2.0 * a2 * a3);
        let s3 = self.elbow * sqrt(1.0 - c3 * c3);
        let t3 = atan2(s3, c3);
        // (15)–(22)
        let (a, d) = (x + y, x - y);
        let (b2, c) = (a2 + a3 * (c3 + s3), a2 + a3 * (c3 - s3));
        let t2 = atan2(c * a - b2 * d, b2 * a + c * d);
        [t1, t2, t3, (self.pitch)(b, t1) - t2 - t3]
    }
}

/// One row of `dig`: t, x, z, φ in degrees.
pub type DigRow = [f64; 4];

/// `dig.m` as printed.
pub fn dig(reach: f64, plunge: f64, _scoop: f64, n: usize) -> Vec<DigRow> {
    let start = [0.0, 30.0, 2.0, -20.0];
    let [phi1, phi2, phi3] = [140.0, 120.0, -20.0];
    let t1_angle = atan((-0.3 * plunge) / (0.6 * reach));
    let r1 = 0.6 * reach / cos(t1_angle);
    let t2_start = atan2(-0.7 * plunge, 0.4 * reach);
    let r2 = 0.4 * reach / cos(t2_start);
    let t2_end = -165.0 * PI / 180.0;
    let tf = 20.0;
    let (t1, t2, dt) = (0.2 * tf, 0.4 * tf, tf / n as f64);
    let mut rows = vec![start];
    for i in 1..n {
        let last = rows[i - 1];
        let t = last[0] + dt;
        rows.push(if t < t1 {
            [
                t,
                start[1] + ((reach - start[1]) / t1) * t,
                start[2] - ((13.0 + start[2]) / t1) * t,
                start[3] + ((phi1 - start[3]) / t1) * t,
            ]
        } else if t1 < t && t < t2 {
            [
                t,
                last[1],
                -13.0 + ((13.0 - plunge) / (t2 - t1)) * (t - t1),
                phi1 + ((phi2 - phi1) / (t2 - t1)) * (t - t1),
            ]
        } else {
            let angle = t2_start + ((t2_end - t2_start) / (tf - t2)) * (t - t2);
            [
                t,
                r1 * cos(t1_angle) + r2 * cos(angle),
                r1 * sin(t1_angle) + r2 * sin(angle),
                phi2 + ((phi3 - phi2) / (tf - t2)) * (t - t2),
            ]
        });
    }
    rows
}

//! A plain transliteration of Frankel 2003's `cyl_to_joint`, `Jdisp`, `Rdisp`, `joint_to_cyl` with libm.
//!
//! As the paper has them, with angles throughout, but for the slips that give no result: θ1 comes from the tip's position, and
//! the four-bar is solved by the law of cosines where the paper searches (`fminsearch` over two angles costs thousands of times
//! more and may fall into the wrong assembly).

/// Frankel's distances, inches, and the constant angles of `dimensions.m`, rad.
macro_rules! seed {
    ($name:ident, $t:ident, $sqrt:path, $sin:path, $cos:path, $acos:path, $atan2:path) => {
        #[doc = concat!("In ", stringify!($t), ", inches and radians.")]
        pub mod $name {
            const PI: $t = core::f64::consts::PI as $t;

            /// `dimensions.m`: the distances used, and the angles calculated from them once.
            #[derive(Clone, Copy, Debug)]
            #[allow(missing_docs)] // the paper's names
            pub struct Dimensions {
                pub a: [$t; 4],
                pub r1a: $t,
                pub r1b: $t,
                pub r2c: $t,
                pub r2d: $t,
                pub r_ef: $t,
                pub r_fh: $t,
                pub r3f: $t,
                pub r3g: $t,
                pub r_gh: $t,
                pub t01a: $t,
                pub tb12: $t,
                pub t12c: $t,
                pub td23: $t,
                pub t23d: $t,
                pub tdfe: $t,
                pub tg34: $t,
            }

            fn corner(a: $t, b: $t, c: $t) -> $t {
                $acos((a * a + b * b - c * c) / (2.0 * a * b))
            }

            impl Dimensions {
                /// The paper's numbers.
                pub fn new() -> Self {
                    let (r01, r0n, ran) = (8.5, 10.5, 7.5);
                    let (r1c, r12, r2c, r1b, r2b) = (17.5, 48.0, 36.25, 36.0, 12.35);
                    let (r2d, rde, r23, r3d, r_ef, r3f) = (9.1875, 13.0, 38.5, 47.25, 30.77, 4.5);
                    let (r34, r3g, r4g) = (18.5, 5.5, 20.01);
                    let rdf = r3d - r3f;
                    let ahead: $t = r01 - ran;
                    Self {
                        a: [r01, r12, r23, r34],
                        r1a: $sqrt(r0n * r0n + ahead * ahead),
                        r1b,
                        r2c,
                        r2d,
                        r_ef,
                        r_fh: 9.5,
                        r3f,
                        r3g,
                        r_gh: 9.5,
                        t01a: $atan2(r0n, ahead),
                        tb12: corner(r1b, r12, r2b),
                        t12c: corner(r12, r2c, r1c),
                        td23: corner(r2d, r23, r3d),
                        t23d: corner(r23, r3d, r2d),
                        tdfe: corner(rdf, r_ef, rde),
                        tg34: corner(r3g, r34, r4g),
                    }
                }

                /// `cyl_to_joint`: boom, arm, bucket cylinders → θ2, θ3, θ4.
                pub fn cyl_to_joint(&self, [rab, rcd, reh]: [$t; 3]) -> [$t; 3] {
                    let ta1b = corner(self.r1a, self.r1b, rab);
                    let theta2 = PI - self.t01a - ta1b - self.tb12;
                    let tc2d = corner(self.r2c, self.r2d, rcd);
                    let theta3 = 3.0 * PI - self.t12c - tc2d - self.td23;
                    let tefh = corner(self.r_ef, self.r_fh, reh);
                    let thf3 = PI - self.tdfe - tefh;
                    let r3h =
                        $sqrt(self.r3f * self.r3f + self.r_fh * self.r_fh - 2.0 * self.r3f * self.r_fh * $cos(thf3));
                    let tf3h = corner(self.r3f, r3h, self.r_fh);
                    let th3g = corner(r3h, self.r3g, self.r_gh);
                    let theta4 = 3.0 * PI - tf3h - th3g - self.tg34 - self.t23d;
                    [theta2, theta3, theta4]
                }

                /// `Jdisp`, its last column: θ1…θ4 → tip in the base frame.
                pub fn jdisp(&self, theta1: $t, [theta2, theta3, theta4]: [$t; 3]) -> [$t; 3] {
                    let [a1, a2, a3, a4] = self.a;
                    let t23 = theta2 + theta3;
                    let t234 = t23 + theta4;
                    let reach = a1 + a2 * $cos(theta2) + a3 * $cos(t23) + a4 * $cos(t234);
                    let height = a2 * $sin(theta2) + a3 * $sin(t23) + a4 * $sin(t234);
                    [reach * $cos(theta1), reach * $sin(theta1), height]
                }

                /// Cylinders and swing → tip.
                pub fn cylinders_to_tip(&self, theta1: $t, cylinders: [$t; 3]) -> [$t; 3] {
                    self.jdisp(theta1, self.cyl_to_joint(cylinders))
                }

                /// `Rdisp` in the plane: reach, height, pitch φ → θ2, θ3, θ4.
                pub fn rdisp(&self, [reach, height, phi]: [$t; 3]) -> [$t; 3] {
                    let [a1, a2, a3, a4] = self.a;
                    let pwx = reach - a1 - a4 * $cos(phi);
                    let pwy = height - a4 * $sin(phi);
                    let c3 = (pwx * pwx + pwy * pwy - a2 * a2 - a3 * a3) / (2.0 * a2 * a3);
                    let s3 = -$sqrt(1.0 - c3 * c3);
                    let theta3 = $atan2(s3, c3);
                    // (21): the two equations A, D in c2, s2.
                    let (a, d) = (pwx + pwy, pwx - pwy);
                    let (b, c) = (a2 + a3 * (c3 + s3), a2 + a3 * (c3 - s3));
                    let det = -(b * b + c * c);
                    let (c2, s2) = ((-b * a - c * d) / det, (b * d - c * a) / det);
                    let theta2 = $atan2(s2, c2);
                    [theta2, theta3, phi - theta2 - theta3]
                }

                /// `joint_to_cyl`: θ2, θ3, θ4 → boom, arm, bucket cylinders.
                pub fn joint_to_cyl(&self, [theta2, theta3, theta4]: [$t; 3]) -> [$t; 3] {
                    let law = |a: $t, b: $t, angle: $t| $sqrt(a * a + b * b - 2.0 * a * b * $cos(angle));
                    let ta1b = PI - self.t01a - self.tb12 - theta2;
                    let boom = law(self.r1a, self.r1b, ta1b);
                    let tc2d = 3.0 * PI - self.td23 - self.t12c - theta3;
                    let arm = law(self.r2c, self.r2d, tc2d);
                    // The four-bar by its diagonal F–G: the angle at 3 between F and G, then two triangles at F.
                    let tf3g = PI - self.t23d - self.tg34 - theta4;
                    let (x, y) = (self.r3f - self.r3g * $cos(tf3g), self.r3g * $sin(tf3g));
                    let rfg = $sqrt(x * x + y * y);
                    let tgf3 = $atan2(y, x);
                    let thfg = corner(self.r_fh, rfg, self.r_gh);
                    let thf3 = tgf3 + thfg;
                    let bucket = law(self.r_ef, self.r_fh, PI - self.tdfe - thf3);
                    [boom, arm, bucket]
                }

                /// Tip in the plane → cylinders.
                pub fn tip_to_cylinders(&self, tip: [$t; 3]) -> [$t; 3] {
                    self.joint_to_cyl(self.rdisp(tip))
                }
            }

            impl Default for Dimensions {
                fn default() -> Self {
                    Self::new()
                }
            }
        }
    };
}

seed!(single, f32, libm::sqrtf, libm::sinf, libm::cosf, libm::acosf, libm::atan2f);
seed!(double, f64, libm::sqrt, libm::sin, libm::cos, libm::acos, libm::atan2);

//! The machine the comparison is made on: Frankel 2003's backhoe, for our maps.

use kinematics_core::distances::FrankelDistances;
use kinematics_core::geometry::Stroke;

/// `dimensions.m` and the travel limits, turned from inches to metres.
pub fn frankel() -> FrankelDistances {
    let inches = |x: f64| x * 0.0254;
    let stroke = |min: f64, max: f64| Stroke { min_m: inches(min), max_m: inches(max) };
    FrankelDistances {
        r01_m: inches(8.5),
        r0n_m: inches(10.5),
        ran_m: inches(7.5),
        rjm_m: inches(10.0),
        r0m_m: inches(6.0),
        r0k_m: inches(5.5),
        r1c_m: inches(17.5),
        r12_m: inches(48.0),
        r2c_m: inches(36.25),
        r1b_m: inches(36.0),
        r2b_m: inches(12.35),
        r2d_m: inches(9.1875),
        rde_m: inches(13.0),
        r23_m: inches(38.5),
        r3d_m: inches(47.25),
        ref_m: inches(30.77),
        r3f_m: inches(4.5),
        r34_m: inches(18.5),
        r3g_m: inches(5.5),
        r4g_m: inches(20.01),
        rfh_m: inches(9.5),
        rgh_m: inches(9.5),
        swing: stroke(7.5, 16.6208),
        boom: stroke(29.0, 46.5434),
        arm: stroke(27.6990, 41.9298),
        bucket: stroke(22.0242, 38.6144),
    }
}

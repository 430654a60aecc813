//! Flow through openings, with the slope the implicit step needs.

use libm::sqrt;

/// Below this pressure drop an opening's flow turns from a square root into a line, Pa.
const LAMINAR_PA: f64 = 5e4;

/// A flow (m³/s) and its derivative by the pressure drop (m³/s/Pa).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Flow {
    /// m³/s.
    pub flow: f64,
    /// m³/s/Pa, never negative.
    pub slope: f64,
}

/// Flow through an opening of conductance k (m³/s/√Pa): k·Δp/√(|Δp| + a laminar rest), either way.
pub(super) fn orifice(k: f64, drop_pa: f64) -> Flow {
    let size = drop_pa.abs() + LAMINAR_PA;
    let root = sqrt(size);
    Flow { flow: k * drop_pa / root, slope: k * (size - 0.5 * drop_pa.abs()) / (size * root) }
}

/// Conductance that passes this flow (m³/s) at this pressure drop (Pa).
pub fn conductance(flow: f64, drop_pa: f64) -> f64 {
    flow * sqrt(drop_pa + LAMINAR_PA) / drop_pa
}

/// Two openings in a row, as one conductance; the second may be infinite.
pub(super) fn in_series(k: f64, other: f64) -> f64 {
    k / sqrt(1.0 + (k / other) * (k / other))
}

/// A valve that opens in proportion above its setting: `gain` m³/s/Pa.
pub(super) fn relief(gain: f64, pressure_pa: f64, setting_pa: f64) -> Flow {
    let over = pressure_pa - setting_pa;
    if over > 0.0 { Flow { flow: gain * over, slope: gain } } else { Flow::default() }
}

/// The same behind an opening of conductance `gap`, which may be infinite: q from over = q/gain + (q/gap)².
pub(super) fn relief_behind(gap: f64, gain: f64, pressure_pa: f64, setting_pa: f64) -> Flow {
    let over = pressure_pa - setting_pa;
    if over <= 0.0 {
        return Flow::default();
    }
    let (valve, square) = (1.0 / gain, 1.0 / (gap * gap));
    let flow = 2.0 * over / (valve + sqrt(valve * valve + 4.0 * over * square));
    Flow { flow, slope: 1.0 / (valve + 2.0 * flow * square) }
}

/// A check valve: the orifice one way, nothing the other.
pub(super) fn check(k: f64, drop_pa: f64) -> Flow {
    if drop_pa > 0.0 { orifice(k, drop_pa) } else { Flow::default() }
}

/// A metering edge: open area over spool travel beyond the dead band, 0…1 → 0…1; `fine` is the share that grows with the square.
pub(super) fn opening(travel: f64, dead_band: f64, fine: f64) -> f64 {
    let beyond = (travel - dead_band) / (1.0 - dead_band);
    if beyond > 0.0 { beyond * (1.0 - fine + fine * beyond) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_is_the_flows_derivative_on_both_sides_of_zero() {
        for drop in [-2e6, -1e4, 0.0, 3e3, 5e6] {
            let by_difference = (orifice(2e-6, drop + 1.0).flow - orifice(2e-6, drop - 1.0).flow) / 2.0;
            let slope = orifice(2e-6, drop).slope;
            assert!((by_difference / slope - 1.0).abs() < 1e-4, "{drop}: {by_difference} {slope}");
        }
    }

    #[test]
    fn two_equal_openings_in_a_row_pass_what_one_passes_at_half_the_drop() {
        let k = conductance(5e-3, 1e6);
        assert!((orifice(k, 1e6).flow - 5e-3).abs() < 1e-15);
        let (both, one) = (orifice(in_series(k, k), 2e7).flow, orifice(k, 1e7).flow);
        assert!((both / one - 1.0).abs() < 0.01);
    }

    #[test]
    fn a_relief_valve_behind_an_opening_passes_what_both_pass_and_alone_what_it_would() {
        let (gain, gap, setting) = (5e-9, 1e-6, 37e6);
        let behind = |pressure: f64| relief_behind(gap, gain, pressure, setting);
        assert_eq!(behind(setting).flow, 0.0);
        let flow = behind(50e6).flow;
        // The drop over the opening and what the valve needs to pass it.
        assert!((flow * flow / (gap * gap) + flow / gain - 13e6).abs() < 1.0);
        let by_difference = (behind(50e6 + 10.0).flow - behind(50e6 - 10.0).flow) / 20.0;
        assert!((by_difference / behind(50e6).slope - 1.0).abs() < 1e-6);
        let alone = relief_behind(f64::INFINITY, gain, 40e6, setting);
        assert!((alone.flow / relief(gain, 40e6, setting).flow - 1.0).abs() < 1e-12 && alone.slope == gain);
    }

    #[test]
    fn an_edge_is_closed_in_the_dead_band_and_full_at_the_end() {
        assert_eq!(opening(0.19, 0.2, 0.5), 0.0);
        assert!((opening(1.0, 0.2, 0.5) - 1.0).abs() < 1e-15);
        assert!(opening(0.6, 0.2, 0.5) < opening(0.6, 0.2, 0.0));
    }
}

//! The parts of the coil stage, each alone: flow map, ramp, dither, numbers, parameters.

use firmware::parameters::{Coil, ValveDirection};
use firmware::valve::coil_stage::{CoilStage, CoilStageParameters};
use firmware::valve::current_loop::{CurrentLoop, LoopGains};
use firmware::valve::dither::{Dither, DitherParameters};
use firmware::valve::flow_map::{FlowMap, FlowParameters};
use firmware::valve::number::{duty_code, fraction, share};
use firmware::valve::ramp::{Ramp, RampParameters};
use hil_sim::coil_trial;

const VALVE: ValveDirection = ValveDirection { dead_band: 0.15, full_speed: 0.4 };
const COIL: Coil = Coil { full_scale_a: 1.2, resistance_ohm: 5.3 };

fn linear() -> FlowParameters {
    FlowParameters::linear(&VALVE, &COIL)
}

#[test]
fn the_default_flow_map_is_the_straight_line_from_dead_band_to_full_scale() {
    let mut map = FlowMap::new(&linear());
    for i in 1..=1000 {
        let speed = 0.4 * i as f32 / 1000.0;
        let straight = 0.18 + (1.2 - 0.18) / 0.4 * speed;
        let current = map.current_a(speed);
        assert!((current - straight).abs() < 5e-7, "{speed}: {current} against {straight}");
    }
    assert_eq!(map.current_a(5.0), 1.2);
    assert_eq!(map.current_a(0.0), 0.0);
    assert_eq!(map.current_a(-0.3), 0.0);
    assert_eq!(map.current_a(f32::NAN), 0.0);
}

#[test]
fn a_curved_flow_table_is_inverted_so_that_the_curve_undoes_it() {
    let table = [0.0, 0.02, 0.07, 0.15, 0.28, 0.45, 0.65, 0.84, 1.0];
    let mut map = FlowMap::new(&FlowParameters { flow_table: table, ..linear() });
    let mut last = 0.0;
    for i in 1..=1000 {
        let share = i as f32 / 1000.0;
        let current = map.current_a(0.4 * share);
        assert!(current >= last, "{share}");
        last = current;
        // What the curve makes of that current.
        let place = ((current - 0.18) / (1.2 - 0.18) * 8.0).clamp(0.0, 8.0);
        let knot = (place as usize).min(7);
        let flow = table[knot] + (table[knot + 1] - table[knot]) * (place - knot as f32);
        assert!((flow - share).abs() < 2e-5, "{share}: {flow}");
    }
}

#[test]
fn the_jump_over_the_dead_band_has_hysteresis() {
    let mut map = FlowMap::new(&FlowParameters { on_above: 0.02, off_at: 0.01, ..linear() });
    assert_eq!(map.current_a(0.015), 0.0);
    assert!(map.current_a(0.021) > 0.18);
    assert!(map.current_a(0.015) > 0.18);
    assert_eq!(map.current_a(0.01), 0.0);
    assert_eq!(map.current_a(0.015), 0.0);
}

#[test]
fn a_ramp_jumps_the_dead_band_and_keeps_to_its_slopes_above_it() {
    let mut ramp = Ramp::new(&RampParameters { up_a_per_s: 2.0, down_a_per_s: 4.0 });
    let rise: Vec<f32> = (0..500).map(|_| ramp.step(1.0, 0.2)).collect();
    assert!((rise[0] - 0.202).abs() < 1e-6);
    assert!(rise.windows(2).all(|pair| pair[1] - pair[0] < 0.002_001 && pair[1] >= pair[0]));
    // 400 steps of 2 mA; their rounding may take one more.
    let top = rise.iter().position(|&a| a == 1.0).unwrap();
    assert!((399..=400).contains(&top), "{top}");
    let fall: Vec<f32> = (0..500).map(|_| ramp.step(0.0, 0.2)).collect();
    let end = fall.iter().position(|&a| a == 0.0).unwrap();
    assert!((199..=201).contains(&end), "{end}");
    assert!(fall[..end].iter().all(|&a| a >= 0.2) && fall[end..].iter().all(|&a| a == 0.0));
    ramp.step(1.0, 0.2);
    ramp.reset();
    assert_eq!(ramp.step(0.0, 0.2), 0.0);
}

#[test]
fn dither_has_its_frequency_its_amplitude_and_no_mean() {
    for (frequency_hz, least_share) in
        [(50.0, 1.0), (62.5, 1.0), (125.0, 1.0), (250.0, 1.0), (100.0, 0.8), (77.7, 0.99)]
    {
        let p = DitherParameters { frequency_hz, amplitude_a: 0.1, fade_below_a: 0.3 };
        let mut dither = Dither::new(&p);
        let values: Vec<f32> = (0..10_000).map(|_| dither.step(0.6)).collect();
        let rises = values.windows(2).filter(|pair| pair[0] <= 0.0 && pair[1] > 0.0).count();
        assert!((rises as f32 - 10.0 * frequency_hz).abs() <= 1.0, "{frequency_hz} Hz: {rises} rises in 10 s");
        let peak = values.iter().copied().fold(0.0, f32::max);
        assert!(peak <= 0.1 && peak > 0.0999 * least_share, "{frequency_hz} Hz: {peak}");
        let mean = values.iter().map(|&x| f64::from(x)).sum::<f64>() / 1e4;
        assert!(mean.abs() < 1e-4, "{frequency_hz} Hz: mean {mean}");
    }
}

#[test]
fn dither_fades_with_the_current_and_never_asks_for_less_than_none() {
    let mut dither = Dither::new(&DitherParameters { frequency_hz: 62.5, amplitude_a: 0.1, fade_below_a: 0.2 });
    for i in 0..2000 {
        let current = 0.3 * (i as f32 / 2000.0);
        let value = dither.step(current);
        assert!(current + value >= 0.0, "{current} {value}");
        assert!(value.abs() <= 0.5 * current + 1e-6);
    }
    assert_eq!(dither.step(0.0), 0.0);
    let mut none = Dither::new(&DitherParameters::NONE);
    assert!((0..100).all(|_| none.step(1.0) == 0.0));
}

#[test]
fn a_code_is_a_share_of_full_scale_and_the_duty_fills_the_timer() {
    assert_eq!([share(2048, 2048), share(2047, 2048)].map(fraction), [0.0, -1.0 / 65536.0]);
    assert_eq!(fraction(share(65535, 0)), 65535.0 / 65536.0);
    assert_eq!([1.0, 0.0, -0.3, -1e9, 1e9].map(duty_code), [65535, 0, 0, 0, 65535]);
    assert_eq!(duty_code(0.5), 32768);
}

#[test]
fn no_supply_makes_a_duty_that_is_no_fraction() {
    let gains = LoopGains::new(&coil_trial::parameters().coil);
    for supply_v in [0.0, -5.0, 1.0, 24.0, f32::MAX, f32::INFINITY, f32::NAN] {
        let supply = gains.supply(supply_v);
        assert!((1.0..=1000.0).contains(&supply.volts), "{supply_v}");
        let mut current = CurrentLoop::start(0.0);
        for tick in 0_u8..200 {
            let measured_a = if tick < 100 { 0.0 } else { 2.3 };
            let duty = current.step(&gains, &supply, 1.0, 0.05, measured_a);
            assert!((0.0..=1.0 + f32::EPSILON).contains(&duty), "{supply_v} V: {duty}");
        }
    }
}

type Spoil = fn(&mut CoilStageParameters);

const SPOILT: [(&str, Spoil); 29] = [
    ("valve.max_current_a", |p| p.spools[0].flow[0].max_current_a = 0.0),
    ("valve.min_current_a", |p| p.spools[1].flow[1].min_current_a = 1.2),
    ("valve.full_speed", |p| p.spools[2].flow[0].full_speed = f32::NAN),
    ("valve.on_above", |p| p.spools[3].flow[0].on_above = 0.5),
    ("valve.off_at", |p| p.spools[3].flow[0].off_at = 0.1),
    ("valve.flow_table", |p| p.spools[0].flow[0].flow_table[0] = 0.1),
    ("valve.flow_table", |p| p.spools[0].flow[0].flow_table[8] = 0.99),
    ("valve.flow_table", |p| p.spools[0].flow[0].flow_table[4] = 0.376),
    ("valve.flow_table", |p| p.spools[0].flow[0].flow_table[4] = f32::NAN),
    ("ramp.up_a_per_s", |p| p.spools[0].ramp[0].up_a_per_s = 0.0),
    ("ramp.down_a_per_s", |p| p.spools[0].ramp[1].down_a_per_s = f32::INFINITY),
    ("dither.frequency_hz", |p| p.spools[0].dither.frequency_hz = 300.0),
    ("dither.amplitude_a", |p| p.spools[0].dither.amplitude_a = -0.1),
    ("dither.fade_below_a", |p| p.spools[0].dither.amplitude_a = 0.2),
    ("coil.resistance_ohm", |p| p.coil.resistance_ohm = 0.0),
    ("coil.inductance_h", |p| p.coil.inductance_h = 0.001),
    ("coil.response_s", |p| p.coil.response_s = 0.001),
    ("coil.proportional_v_per_a", |p| p.coil.proportional_v_per_a = 90.0),
    ("coil.integral_v_per_a_s", |p| p.coil.integral_v_per_a_s = 1e5),
    ("coil.freewheel_v", |p| p.coil.freewheel_v = f32::NAN),
    ("coil.max_duty", |p| p.coil.max_duty = 1.1),
    ("coil_watch.winding_c", |p| p.watch.winding_c = [30.0, 20.0]),
    ("coil_watch.slowest_s", |p| p.watch.slowest_s = 0.0),
    ("coil_watch.floor_a", |p| p.watch.floor_a = 0.0),
    ("coil_watch.over_current_a", |p| p.watch.over_current_a = 0.01),
    ("coil_watch.short_ticks", |p| p.watch.short_ticks = 1),
    ("current_sense.zero_code", |p| p.sense.zero_code = 60_000),
    ("current_sense.full_scale_a", |p| p.sense.full_scale_a = 1.5),
    ("released_a", |p| p.released_a = f32::NAN),
];

#[test]
fn every_value_out_of_its_range_is_refused_by_name() {
    assert!(CoilStage::new(&coil_trial::parameters()).is_ok());
    for (field, spoil) in SPOILT {
        let mut parameters = coil_trial::parameters();
        spoil(&mut parameters);
        match CoilStage::new(&parameters) {
            Ok(_) => panic!("{field} was accepted"),
            Err(error) => assert!(error.to_string().contains(&format!("`{field}")), "{field}: {error}"),
        }
    }
}

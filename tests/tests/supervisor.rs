//! The supervisor: nothing moves without neutral and a fresh enable, and everything stops when something is wrong.

use cross_tests::rig::{Rig, drives, is_safe, scenario};
use firmware::valve::coil_fault::{CoilFault, FaultyCoil};
use firmware::valve::interlock::Side;
use firmware::{Ecu, Fault, Inputs, Intent, Request, State};
use hil_sim::plant::coil::Broken;
use kinematics_core::{Cylinder, Cylinders};
use proptest::prelude::*;

/// Ticks of digging after which the machine has a speed command: past the start of the feed-forward.
const DIGGING: u32 = 20;

#[test]
fn a_healthy_dig_drives_the_coils() {
    assert!(drives(&Rig::new().dig(DIGGING)));
}

#[test]
fn an_enable_switch_found_on_at_power_up_enables_nothing() {
    let mut rig = Rig::new();
    rig.inputs.enable = true;
    for _ in 0..500 {
        let outputs = rig.tick();
        assert!(is_safe(&outputs) && outputs.state != State::Running);
    }
}

#[test]
fn levers_out_of_neutral_while_enabling_enable_nothing() {
    let mut rig = Rig::new();
    rig.ticks(5);
    rig.request = Request::Dig;
    rig.inputs.enable = true;
    for _ in 0..500 {
        assert!(is_safe(&rig.tick()));
    }
}

#[test]
fn without_a_command_message_nothing_is_ever_enabled() {
    let mut rig = Rig::new();
    rig.sending = false;
    rig.ticks(5);
    rig.inputs.enable = true;
    for _ in 0..500 {
        assert!(is_safe(&rig.tick()));
    }
}

#[test]
fn running_in_neutral_commands_zero_current() {
    let mut rig = Rig::new();
    rig.start();
    for _ in 0..500 {
        let outputs = rig.tick();
        assert_eq!(outputs.state, State::Running);
        assert!(outputs.currents.iter().flatten().all(|&current| current == 0.0));
    }
}

#[test]
fn switching_enable_off_stops_in_the_same_tick_without_a_fault() {
    let mut rig = Rig::new();
    rig.dig(DIGGING);
    rig.inputs.enable = false;
    let outputs = rig.tick();
    assert!(is_safe(&outputs));
    assert_eq!(outputs.fault, None);
}

type Break = fn(&mut Rig);

/// Every fault that one input can cause while digging.
const BREAKS: [(&str, Break, Fault); 8] = [
    ("emergency stop", |rig| rig.inputs.emergency_stop = true, Fault::EmergencyStop),
    ("supply lost", |rig| rig.inputs.supply_code = 0, Fault::Supply),
    ("supply too high", |rig| rig.inputs.supply_code = 65535, Fault::Supply),
    ("swing sensor open", |rig| rig.inputs.codes[0] = 0, Fault::Sensor(Cylinder::Swing)),
    ("boom sensor open", |rig| rig.inputs.codes[1] = 0, Fault::Sensor(Cylinder::Boom)),
    ("arm sensor shorted", |rig| rig.inputs.codes[2] = 65535, Fault::Sensor(Cylinder::Arm)),
    ("bucket sensor open", |rig| rig.inputs.codes[3] = 0, Fault::Sensor(Cylinder::Bucket)),
    ("boom sensor jumps", |rig| rig.inputs.codes[1] += 500, Fault::Jump(Cylinder::Boom)),
];

#[test]
fn every_fault_stops_everything_in_the_same_tick_and_is_named() {
    for (what, break_it, fault) in BREAKS {
        let mut rig = Rig::new();
        assert!(drives(&rig.dig(DIGGING)), "{what}");
        break_it(&mut rig);
        let outputs = rig.tick();
        assert!(is_safe(&outputs), "{what}");
        assert_eq!((outputs.state, outputs.fault), (State::Fault, Some(fault)), "{what}");
    }
}

#[test]
fn a_fault_stays_latched_after_its_cause_is_gone_until_neutral_and_a_fresh_enable() {
    for (what, break_it, fault) in BREAKS {
        let mut rig = Rig::new();
        rig.dig(DIGGING);
        let healthy = rig.inputs;
        break_it(&mut rig);
        rig.tick();
        rig.inputs = healthy;
        // The lever is still on dig and enable still on: nothing may start.
        for _ in 0..300 {
            let outputs = rig.tick();
            assert!(is_safe(&outputs), "{what}");
            assert_eq!(outputs.fault, Some(fault), "{what}");
        }
        // Enable off and on with the lever on dig: still nothing.
        rig.inputs.enable = false;
        rig.ticks(5);
        rig.inputs.enable = true;
        assert!(is_safe(&rig.ticks(50)), "{what}");
        // Neutral and a fresh enable: running again, the fault forgotten.
        assert_eq!(rig.start().fault, None, "{what}");
    }
}

#[test]
fn a_machine_that_stands_while_its_reference_goes_on_is_a_following_error() {
    let mut rig = Rig::new();
    rig.dig(DIGGING);
    let stopped = (0..5000).map(|_| rig.tick()).find(|outputs| outputs.state != State::Running).expect("stopped");
    assert_eq!(stopped.fault, Some(Fault::FollowingError));
    assert!(is_safe(&stopped));
}

#[test]
fn one_late_tick_is_told_in_the_same_cycle_and_stops_nothing() {
    let mut rig = Rig::new();
    rig.dig(DIGGING);
    rig.inputs.overrun = true;
    let late = rig.tick();
    rig.inputs.overrun = false;
    assert!(late.late && drives(&late) && drives(&rig.tick()));
}

#[test]
fn an_emergency_stop_acts_in_every_state() {
    let states: [(&str, Break); 4] = [
        ("locked", |_| {}),
        ("ready", |rig| {
            rig.ticks(5);
        }),
        ("running", |rig| {
            rig.start();
        }),
        ("fault", |rig| {
            rig.dig(DIGGING);
            rig.inputs.codes[1] = 0;
            rig.tick();
        }),
    ];
    for (state, reach) in states {
        let mut rig = Rig::new();
        reach(&mut rig);
        rig.inputs.emergency_stop = true;
        let outputs = rig.tick();
        assert_eq!(outputs.state, State::Fault, "{state}");
        assert!(is_safe(&outputs), "{state}");
    }
}

#[test]
fn the_first_fault_keeps_its_name_when_others_follow() {
    let mut rig = Rig::new();
    rig.dig(DIGGING);
    rig.inputs.codes[2] = 0;
    rig.tick();
    rig.inputs.emergency_stop = true;
    rig.inputs.supply_code = 0;
    assert_eq!(rig.ticks(10).fault, Some(Fault::Sensor(Cylinder::Arm)));
}

#[test]
fn one_sensors_good_value_does_not_clear_anothers_fault() {
    let mut rig = Rig::new();
    rig.dig(DIGGING);
    rig.inputs.codes[1] = 0;
    rig.tick();
    rig.request = Request::Neutral;
    rig.inputs.enable = false;
    for step in 0..200 {
        // The others move and are fine.
        rig.inputs.codes[2] = 30000 + step;
        assert_eq!(rig.tick().state, State::Fault);
    }
}

#[test]
fn a_stale_command_stops_motion_in_the_same_tick() {
    let mut rig = Rig::new();
    assert!(drives(&rig.dig(DIGGING)));
    rig.sending = false;
    let outputs = rig.tick();
    assert!(is_safe(&outputs));
    assert_eq!(outputs.fault, Some(Fault::CommandStale));
}

#[test]
fn a_broken_coil_stops_everything_and_is_named() {
    let cases = [
        (Broken::Open, CoilFault::Open, 50),
        (Broken::ShortToSupply, CoilFault::ShortToSupply, 20),
        (Broken::ShortToGround, CoilFault::ShortToGround, 20),
    ];
    for (broken, fault, bound) in cases {
        let mut rig = Rig::new();
        rig.start();
        rig.request = Request::Levers;
        rig.levers = [0, 16000, 0, 0];
        rig.ticks(500);
        // A wire at the supply shows when the loop no longer drives it.
        if broken == Broken::ShortToSupply {
            rig.levers = [0; 4];
            rig.ticks(200);
        }
        rig.solenoids[1][0].broken = Some(broken);
        let named = (0..bound).find_map(|tick| rig.tick().fault.map(|fault| (tick, fault)));
        let expected = Fault::Coil(FaultyCoil { spool: 1, side: Side::Extend, fault });
        assert_eq!(named.map(|(_, fault)| fault), Some(expected), "{broken:?}");
        assert!(is_safe(&rig.tick()));
    }
}

#[test]
fn a_sensor_supply_outside_its_range_stops_everything_and_is_named() {
    for code in [0, 58_000, 65_535] {
        let mut rig = Rig::new();
        assert!(drives(&rig.dig(DIGGING)));
        rig.inputs.sensor_supply_code = code;
        let outputs = rig.tick();
        assert_eq!(outputs.fault, Some(Fault::SensorSupply), "{code}");
        assert!(is_safe(&outputs));
    }
}

#[test]
fn a_dig_far_from_its_start_is_a_fault_and_moves_nothing() {
    let parameters = scenario("dig").parameters;
    let mut rig = Rig::with(&parameters);
    rig.stand_at(&parameters, &Cylinders { boom: 1.0, arm: 0.9, bucket: 0.8 });
    rig.start();
    rig.request = Request::Dig;
    let outputs = rig.tick();
    assert!(is_safe(&outputs));
    assert_eq!(outputs.fault, Some(Fault::NotAtStart));
}

#[test]
fn releasing_the_lever_during_a_dig_commands_zero_at_once_and_starting_over_needs_the_start() {
    let mut rig = Rig::new();
    assert!(drives(&rig.dig(DIGGING)));
    rig.request = Request::Neutral;
    let outputs = rig.tick();
    assert_eq!(outputs.state, State::Running);
    assert!(outputs.currents.iter().flatten().all(|&current| current == 0.0));
    assert_eq!(outputs.dig_tick, 0);
}

fn any_inputs() -> impl Strategy<Value = Inputs> {
    // Mostly codes near where the machine stands, so that runs get past the sensors; sometimes anything.
    let code = || prop_oneof![100 => 0_u16..40, 1 => any::<u16>()];
    (
        [code(), code(), code(), code()],
        prop_oneof![8 => Just(39_321_u16), 1 => any::<u16>()],
        (prop_oneof![8 => Just(63_999_u16), 1 => any::<u16>()], any::<[[u16; 2]; 4]>(), prop::bool::weighted(0.98)),
        prop_oneof![Just(Request::Neutral), Just(Request::Dig), Just(Request::Levers)],
        any::<[i16; 4]>(),
        any::<bool>(),
        prop::bool::weighted(0.02),
        prop::bool::weighted(0.02),
        (prop::bool::weighted(0.98), prop::bool::weighted(0.98), any::<bool>()),
    )
        .prop_map(|(codes, supply_code, analogue, request, levers, enable, emergency_stop, overrun, board)| {
            let (sensor_supply_code, coil_codes, sending) = analogue;
            let (sensors_sound, coils_sound, cut_off_closed) = board;
            let converters_sound = [sensors_sound, coils_sound];
            Inputs {
                codes,
                supply_code,
                sensor_supply_code,
                // Mostly no more than a released coil shows.
                coil_codes: coil_codes.map(|spool| spool.map(|code| if code % 8 == 0 { code } else { 2048 })),
                command: sending.then_some(Intent { request, levers, ..Intent::NEUTRAL }),
                slope: None,
                pressures_pa: [[None; 2]; 3],
                converters_sound,
                cut_off_closed,
                enable,
                emergency_stop,
                overrun,
            }
        })
}

proptest! {
    #[test]
    fn whatever_comes_in_outputs_are_finite_and_safe_outside_running(
        inputs in prop::collection::vec(any_inputs(), 1..200),
        from_the_start in any::<bool>(),
    ) {
        let mut rig = Rig::new();
        let mut ecu: Ecu = if from_the_start {
            rig.dig(DIGGING);
            rig.ecu
        } else {
            rig.ecu
        };
        let stands = rig.inputs.codes;
        for mut inputs in inputs {
            for (code, stands) in inputs.codes.iter_mut().zip(stands) {
                *code = if *code < 40 { stands + *code } else { *code };
            }
            let outputs = ecu.tick(&inputs);
            prop_assert!(outputs.state == State::Running || is_safe(&outputs));
            prop_assert!(matches!(outputs.state, State::Fault | State::Stopped) <= outputs.fault.is_some());
            prop_assert_eq!(outputs.cut_off_closed, outputs.state == State::Running);
            prop_assert_eq!(outputs.late, inputs.overrun);
            if inputs.emergency_stop || !inputs.enable {
                prop_assert!(is_safe(&outputs));
            }
            for [extend, retract] in outputs.currents {
                prop_assert!(extend.is_finite() && retract.is_finite() && extend >= 0.0 && retract >= 0.0);
                prop_assert!(extend == 0.0 || retract == 0.0, "both solenoids of a spool on together");
            }
            let pose = outputs.pose;
            let all = [pose.x, pose.y, pose.plane.reach, pose.plane.height, pose.swing.cos, pose.swing.sin,
                pose.plane.pitch.cos, pose.plane.pitch.sin, pose.joints.boom.cos, pose.joints.arm.cos,
                pose.joints.bucket.cos, outputs.lengths.boom, outputs.lengths.arm, outputs.lengths.bucket,
                outputs.reference.boom, outputs.speeds.swing, outputs.speeds.boom, outputs.speeds.arm, outputs.speeds.bucket];
            prop_assert!(all.iter().all(|x| x.is_finite()));
        }
    }
}

#[test]
fn a_converter_that_answers_unsoundly_stops_the_machine_by_name() {
    for (which, fault) in [(0, Fault::SensorConverter), (1, Fault::CoilConverter)] {
        let mut rig = Rig::new();
        assert!(drives(&rig.dig(DIGGING)));
        rig.inputs.converters_sound[which] = false;
        let outputs = rig.tick();
        assert_eq!(outputs.fault, Some(fault));
        assert!(is_safe(&outputs));
    }
}

#[test]
fn a_cut_off_that_does_not_follow_is_a_fault_after_fifty_ticks_and_not_before() {
    let mut rig = Rig::new();
    rig.dig(DIGGING);
    // Its contact opens by itself.
    for tick in 0..52 {
        rig.inputs.cut_off_closed = false;
        let outputs = rig.tick();
        let expected = (tick >= 50).then_some(Fault::CutOffStuckOpen);
        assert_eq!(outputs.fault, expected, "{tick}");
    }
    // Welded: opened long ago, and still closed.
    let mut rig = Rig::new();
    for tick in 0..52 {
        rig.inputs.cut_off_closed = true;
        let outputs = rig.tick();
        assert_eq!(outputs.fault, (tick >= 50).then_some(Fault::CutOffWelded), "{tick}");
        assert!(is_safe(&outputs));
    }
}

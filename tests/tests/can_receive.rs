//! What is received counts only while it can be trusted, and no message speaks for another.

use cross_tests::can::{Bench, address, cut, flipped, from, sent, under};
use firmware::can::command::{Mode, ValveState};
use firmware::can::id::Identifier;
use firmware::can::message::Sender;
use firmware::can::receive::Validity;
use firmware::can::table::received::{
    ARM_COMMAND, BOOM_COMMAND, BOOM_PRESSURES, MODE, SLOPE, TIMEOUT_MS, TIP_VELOCITY,
};
use firmware::can::{CanFrame, table};
use kinematics_core::Rotor;
use proptest::prelude::*;

fn mode(counter: u8, mode: Mode) -> CanFrame {
    sent(&MODE, counter & 0xf, [mode.code() as f32, 0.0, 0.0])
}

/// A bench on which the mode command is fresh; the last counter is 3.
fn digging() -> Bench {
    let mut bench = Bench::new();
    for counter in 0..4 {
        assert_eq!(bench.inbox().mode().value, None, "before message {counter}");
        bench.tick(&[mode(counter, Mode::Dig)]);
    }
    assert_eq!((bench.inbox().mode().value, bench.inbox().mode().validity), (Some(Mode::Dig), Validity::Fresh));
    bench
}

/// Lets the rest of the timeout pass, `passed` ticks of it gone, sending what `frame` says each tick.
fn run_out(bench: &mut Bench, mut frame: impl FnMut(u32) -> Option<CanFrame>) {
    for tick in 1..=u32::from(TIMEOUT_MS) {
        assert_eq!(bench.inbox().mode().validity, Validity::Fresh, "tick {tick}");
        bench.tick(frame(tick).as_slice());
    }
    assert_eq!(bench.inbox().mode().value, None);
}

#[test]
fn a_command_runs_out_after_exactly_the_timeout() {
    let mut bench = digging();
    run_out(&mut bench, |_| None);
    assert_eq!(bench.inbox().mode().validity, Validity::Stale);
}

#[test]
fn a_frozen_counter_runs_out_and_says_so() {
    let mut bench = digging();
    run_out(&mut bench, |_| Some(mode(3, Mode::Dig)));
    assert_eq!(bench.inbox().mode().validity, Validity::FrozenCounter);
    // Moving again it is trusted from the third message on.
    for (counter, expected) in [(4, None), (5, None), (6, Some(Mode::Hold))] {
        bench.tick(&[mode(counter, Mode::Hold)]);
        assert_eq!(bench.inbox().mode().value, expected, "{counter}");
    }
}

#[test]
fn a_leap_of_the_counter_must_earn_trust_again() {
    let mut bench = digging();
    // Five steps are messages lost; six are a leap.
    bench.tick(&[mode(8, Mode::Move)]);
    assert_eq!(bench.inbox().mode().value, Some(Mode::Move));
    bench.tick(&[mode(14, Mode::Hold)]);
    assert_eq!(bench.inbox().mode().value, Some(Mode::Move), "the leap is passed over");
    for (counter, expected) in [(15, Mode::Move), (0, Mode::Move), (1, Mode::Hold)] {
        bench.tick(&[mode(counter, Mode::Hold)]);
        assert_eq!(bench.inbox().mode().value, Some(expected), "{counter}");
    }
}

#[test]
fn a_replayed_handful_never_counts() {
    let mut bench = Bench::new();
    let handful = [7, 8, 9].map(|counter| mode(counter, Mode::Dig));
    for _ in 0..50 {
        for frame in handful {
            bench.tick(&[frame]);
            assert_eq!(bench.inbox().mode().value, None);
        }
    }
    assert_eq!(bench.inbox().mode().validity, Validity::FrozenCounter);
}

#[test]
fn wrong_checksums_run_out_and_say_so_and_then_silence_is_silence() {
    let mut bench = digging();
    run_out(&mut bench, |tick| Some(flipped(&mode(3 + tick as u8, Mode::Hold), tick % 64)));
    assert_eq!(bench.inbox().mode().validity, Validity::BadChecksum);
    bench.ticks(TIMEOUT_MS.into());
    assert_eq!(bench.inbox().mode().validity, Validity::Stale);
}

#[test]
fn short_frames_run_out_and_say_so() {
    for bytes in 0..8 {
        let mut bench = digging();
        run_out(&mut bench, |tick| Some(cut(&mode(3 + tick as u8, Mode::Hold), bytes)));
        assert_eq!(bench.inbox().mode().validity, Validity::Short, "{bytes}");
    }
}

#[test]
fn a_sender_that_has_no_value_is_believed_at_once() {
    let [signal, ..] = MODE.signals;
    for code in [9, 13, signal.error(), signal.not_available()] {
        let mut bench = digging();
        bench.tick(&[from(&MODE, 4, MODE.pack([code, 0, 0]))]);
        assert_eq!((bench.inbox().mode().value, bench.inbox().mode().validity), (None, Validity::OutOfRange), "{code}");
        bench.tick(&[mode(5, Mode::Hold)]);
        assert_eq!(bench.inbox().mode().value, Some(Mode::Hold));
    }
}

#[test]
fn no_message_speaks_for_another() {
    let mut bench = digging();
    let all = |bench: &Bench| bench.inbox().validities();
    assert_eq!(all(&bench).iter().filter(|&&v| v == Validity::Fresh).count(), 1);
    // The mode goes on while the boom's command comes with wrong checksums and the arm's as not available.
    for counter in 4..=60_u8 {
        let boom = flipped(&sent(&BOOM_COMMAND, counter & 0xf, [50.0, 1.0, 0.0, 0.0]), 3);
        let arm = from(&ARM_COMMAND, counter & 0xf, u64::MAX);
        bench.tick(&[mode(counter, Mode::Levers), boom, arm]);
        bench.ticks(19);
    }
    let [swing, boom, arm, bucket, tip, mode, slope, others @ ..] = all(&bench);
    assert_eq!((boom, arm, mode), (Validity::BadChecksum, Validity::OutOfRange, Validity::Fresh));
    assert_eq!([swing, bucket, tip, slope], [Validity::Stale; 4]);
    assert_eq!(others, [Validity::Stale; 4]);
}

#[test]
fn only_the_configured_sender_is_heard() {
    let mut bench = Bench::new();
    for counter in 0..10 {
        let id = MODE.header.identifier(0x55);
        let payload = firmware::can::protect::seal(id, counter, MODE.encode([3.0, 0.0, 0.0]));
        bench.tick(&[CanFrame::of_payload(id.extended(), payload)]);
    }
    assert_eq!(bench.inbox().mode().validity, Validity::Stale);
}

#[test]
fn valve_commands_become_levers() {
    let mut bench = Bench::new();
    let cases = [(0.0, 1.0, 0), (100.0, 1.0, 32767), (100.0, 2.0, -32767), (50.0, 2.0, -16384), (80.0, 0.0, 0)];
    for counter in 0..3 {
        bench.tick(&[sent(&BOOM_COMMAND, counter, [0.0, 0.0, 0.0, 0.0])]);
    }
    for (counter, (flow, state, lever)) in (3..).zip(cases) {
        bench.tick(&[sent(&BOOM_COMMAND, counter, [flow, state, 0.0, 0.0])]);
        let [swing, boom, arm, bucket] = bench.inbox().valves();
        assert_eq!(boom.value.unwrap().lever(), Some(lever), "{flow} % {state}");
        assert!([swing, arm, bucket].iter().all(|other| other.value.is_none()));
    }
    bench.tick(&[sent(&BOOM_COMMAND, 8, [80.0, 3.0, 0.0, 0.0])]);
    let floating = bench.inbox().valves()[1].value.unwrap();
    assert_eq!((floating.state, floating.lever()), (ValveState::Floating, None));
}

#[test]
fn a_tip_velocity_beyond_its_range_is_no_command() {
    let mut bench = Bench::new();
    for counter in 0..4 {
        bench.tick(&[sent(&TIP_VELOCITY, counter, [0.25, -0.5, 0.125, 0.0, 0.0])]);
    }
    let velocity = bench.inbox().tip_velocity().value.unwrap();
    assert!((velocity.x_mps - 0.25).abs() < 1e-5 && (velocity.z_mps + 0.5).abs() < 1e-5);
    assert!((velocity.pitch_radps - 0.125).abs() < 1e-5);
    // 3.2 m/s as a code that the signal could hold.
    let fast = TIP_VELOCITY.pack([35_200, 32_000, 32_000, 0, 0]);
    bench.tick(&[from(&TIP_VELOCITY, 4, fast)]);
    assert_eq!(bench.inbox().tip_velocity().validity, Validity::OutOfRange);
}

#[test]
fn the_slope_comes_in_the_signs_of_the_kinematics_and_runs_out() {
    let mut bench = Bench::new();
    // Nose up 10°, right side down 5°: counters play no part.
    let slope = |merit| sent(&SLOPE, 0, [10.0, 5.0, 0.0, merit, 0.0, 0.0, 10.0]);
    bench.tick(&[slope(0.0)]);
    let found = bench.inbox().slope().value.unwrap();
    let near = |rotor: Rotor<f32>, deg: f64| (f64::from(rotor.sin) - libm::sin(deg.to_radians())).abs() < 1e-6;
    assert!(near(found.pitch, -10.0) && near(found.roll, 5.0), "{found:?}");
    bench.tick(&[slope(1.0)]);
    assert_eq!(bench.inbox().slope().validity, Validity::OutOfRange, "a degraded sensor");
    bench.tick(&[slope(0.0)]);
    bench.ticks(99);
    assert_eq!(bench.inbox().slope().validity, Validity::Fresh);
    bench.ticks(1);
    assert_eq!(bench.inbox().slope().validity, Validity::Stale);
}

#[test]
fn one_pressure_sensors_failure_is_not_the_others() {
    let mut bench = Bench::new();
    for counter in 0..3 {
        bench.tick(&[sent(&BOOM_PRESSURES, counter, [20e6, 3e6, 0.0, 0.0])]);
    }
    bench.tick(&[sent(&BOOM_PRESSURES, 3, [f32::NAN, 5e6, 0.0, 0.0])]);
    let [[head, rod], arm, bucket] = bench.inbox().pressures_pa();
    assert_eq!((head.value, head.validity), (None, Validity::OutOfRange));
    assert_eq!((rod.value, rod.validity), (Some(5e6), Validity::Fresh));
    assert!(arm.iter().chain(&bucket).all(|p| p.value.is_none() && p.validity == Validity::Stale));
    bench.ticks(TIMEOUT_MS.into());
    let [boom, ..] = bench.inbox().pressures_pa();
    assert_eq!(boom.map(|p| p.validity), [Validity::Stale; 2]);
}

/// Any frame, half of them under an identifier that is heard.
fn frames() -> impl Strategy<Value = CanFrame> {
    let heard = (0..table::MESSAGES.len()).prop_map(|index| {
        let header = table::MESSAGES[index].header;
        header.identifier(address(header.sender))
    });
    let any_id = (0_u32..1 << 29).prop_map(|raw| Identifier::of(embedded_can::ExtendedId::new(raw).unwrap()));
    let whole = any::<u64>().prop_map(|payload| CanFrame::of_payload(MODE.header.identifier(0).extended(), payload));
    (prop_oneof![heard, any_id], whole, 0..=8_usize).prop_map(|(id, frame, bytes)| cut(&under(&frame, id), bytes))
}

proptest! {
    #[test]
    fn nothing_random_is_taken_for_a_protected_message(all in prop::collection::vec(frames(), 1..200)) {
        let mut bench = Bench::new();
        for frame in &all {
            bench.tick(&[*frame]);
        }
        // A random CRC is right once in 256; three in a row whose counter moves on are not met here.
        let slope_came = all.iter().any(|f| Identifier::of(f.extended_id()).pgn == SLOPE.header.pgn);
        for (index, validity) in bench.inbox().validities().into_iter().enumerate() {
            let is_slope = index == 6;
            prop_assert!(validity != Validity::Fresh || (is_slope && slope_came), "{index}: {validity:?}");
        }
    }

    #[test]
    fn noise_between_good_messages_changes_nothing(noise in prop::collection::vec(frames(), 0..40)) {
        let own = address(Sender::Operator);
        let mut bench = digging();
        for (counter, frame) in (4..).zip(&noise) {
            // Not the mode command's own identifier: what the noise says under others is no matter.
            let id = Identifier::of(frame.extended_id());
            let frame = if id.pgn == MODE.header.pgn && id.source == own { None } else { Some(*frame) };
            bench.tick(&[Some(mode(counter, Mode::Dig)), frame].into_iter().flatten().collect::<Vec<_>>());
            prop_assert_eq!(bench.inbox().mode().value, Some(Mode::Dig));
        }
    }

    #[test]
    fn any_bit_turned_in_a_good_message_is_seen(counter in 4_u8..9, bit in 0_u32..64) {
        let mut bench = digging();
        bench.tick(&[flipped(&mode(counter, Mode::Hold), bit)]);
        prop_assert_eq!(bench.inbox().mode().value, Some(Mode::Dig));
    }
}

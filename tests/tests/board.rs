//! A board put together from parts: what goes in and out at its pins.

use cross_tests::boards::{Wire, board, can_frame};
use embedded_can::nb::Can;
use firmware::board::ads8688::AdcError;
use firmware::board::signals::{Measured, RANGES, SIGNALS, Signal};
use firmware::board::{Board, BoardError, Switches};
use sim_chips::ads8688::{Break, Span};

#[test]
fn every_signal_has_one_channel_and_arrives_at_its_place() {
    let mut board = board();
    let code = |chip: usize, channel: usize| 1000 + 100 * (8 * chip + channel) as u16;
    for (chip, adc) in board.adcs.iter_mut().enumerate() {
        for (channel, range) in RANGES[chip].iter().enumerate() {
            adc.bus().set_volts(channel as u8, Span::of(range.code()).volts(code(chip, channel)));
        }
    }
    let [Ok(first), Ok(second)] = board.scan() else { panic!("a healthy board") };
    let measured = Measured::from_scans(&[first, second]);
    assert_eq!(measured.positions, [1000, 1100, 1200, 1300]);
    assert_eq!((measured.supply, measured.sensor_supply), (1400, 1500));
    assert_eq!(measured.coils, [[1800, 1900], [2000, 2100], [2200, 2300], [2400, 2500]]);
    let mut all: Vec<Signal> = SIGNALS.into_iter().flatten().filter(|signal| *signal != Signal::Spare).collect();
    let count = all.len();
    all.sort_by_key(|signal| format!("{signal:?}"));
    all.dedup();
    assert_eq!((count, all.len()), (14, 14), "4 positions, 2 supplies, 8 coils, each once");
}

#[test]
fn one_broken_converter_leaves_the_other() {
    let mut board = board();
    board.adcs[1].bus().set_broken(Some(Break::StuckHigh));
    let [first, second] = board.scan();
    assert!(first.is_ok());
    assert_eq!(second, Err(AdcError::NoAnswer));
}

#[test]
fn duties_scale_to_the_timers_range() {
    let mut board = board();
    board.drive(&[[0, 65535], [32768, 0], [0, 16], [1, 0]]).unwrap();
    let duties = board.solenoids.map(|spool| spool.map(|pwm| pwm.duty));
    assert_eq!(duties, [[0, 4095], [2047, 0], [0, 0], [0, 0]]);
}

#[test]
fn a_bad_output_is_named_and_every_other_is_set() {
    let mut board = board();
    board.solenoids[1][1].works = false;
    board.solenoids[2][0].works = false;
    let error = board.drive(&[[65535; 2]; 4]).unwrap_err();
    assert_eq!(error, BoardError::Solenoid(1, 1));
    assert_eq!(error.to_string(), "PWM output of solenoid 1 of the boom spool");
    let full = board.solenoids.iter().flatten().filter(|pwm| pwm.duty == 4095).count();
    assert_eq!(full, 6);
}

#[test]
fn a_broken_emergency_stop_wire_is_a_pressed_one() {
    let mut board = board();
    assert_eq!(board.switches(), Ok(Switches { enable: false, emergency_stop: false }));
    board.enable = Wire::new(true);
    board.emergency_stop_released = Wire::new(false);
    assert_eq!(board.switches(), Ok(Switches { enable: true, emergency_stop: true }));
    board.emergency_stop_released.0.set(None);
    assert_eq!(board.switches(), Err(BoardError::EmergencyStop));
    board.enable.0.set(None);
    assert_eq!(board.switches(), Err(BoardError::Enable));
}

#[test]
fn the_cut_offs_read_back_is_its_own_wire() {
    let mut board = board();
    board.set_cut_off(true).unwrap();
    assert_eq!(board.cut_off_is_closed(), Ok(true));
    // The relay does not fall.
    board.cut_off_read_back = Wire::new(true);
    board.set_cut_off(false).unwrap();
    assert_eq!(board.cut_off_is_closed(), Ok(true));
    board.cut_off.0.set(None);
    assert_eq!(board.set_cut_off(false), Err(BoardError::CutOff));
}

#[test]
fn frames_and_the_watchdog_reach_the_board() {
    let mut board = board();
    assert!(matches!(board.can().receive(), Err(nb::Error::WouldBlock)));
    let frame = can_frame(&[1, 2, 3]);
    board.can().transmit(&frame).unwrap();
    assert_eq!(board.can().receive(), Ok(frame));
    board.feed_watchdog();
    assert_eq!(board.watchdog.0, 1);
}

//! The board's part of the start-up self-test: each broken part is found, and everything is left off.

use cross_tests::boards::{SimBoard, Wire, board};
use cross_tests::rig::scenario;
use firmware::board::Board;
use firmware::board::start_up::{memory_holds, quiet_code, try_outputs};
use firmware::supervisor::Check;

fn tried(board: &mut SimBoard) -> [Check; 2] {
    let result = try_outputs(board, quiet_code(&scenario("dig").parameters.coils), || {});
    assert!(board.solenoids.iter().flatten().all(|pwm| pwm.duty == 0 || !pwm.works));
    assert_eq!(board.cut_off.0.get(), Some(false), "left open");
    result
}

#[test]
fn a_healthy_board_passes_and_feeds_its_watchdog_meanwhile() {
    let mut board = board();
    assert_eq!(tried(&mut board), [Check::Passed; 2]);
    assert!(board.watchdog.0 >= 100);
}

#[test]
fn a_driver_that_does_not_obey_or_leaks_current_with_the_cut_off_open_fails() {
    let mut dead = board();
    dead.solenoids[2][1].works = false;
    assert_eq!(tried(&mut dead)[0], Check::Failed);
    let mut leaking = board();
    // The first coil's channel: half of its range.
    leaking.adcs[1].bus().set_volts(0, 2.56);
    assert_eq!(tried(&mut leaking), [Check::Failed; 2]);
}

#[test]
fn a_cut_off_whose_contact_does_not_follow_fails() {
    for stuck in [true, false] {
        let mut board = board();
        board.cut_off_read_back = Wire::new(stuck);
        assert_eq!(tried(&mut board)[1], Check::Failed, "{stuck}");
    }
}

#[test]
fn a_converter_that_does_not_answer_fails_both() {
    let mut board = board();
    board.adcs[1].bus().set_broken(Some(sim_chips::ads8688::Break::StuckHigh));
    assert_eq!(tried(&mut board), [Check::Failed; 2]);
    assert!(board.cut_off_is_closed() == Ok(false));
}

#[test]
fn good_memory_holds_every_pattern() {
    assert_eq!(memory_holds(&mut [7; 1000]), Check::Passed);
}

//! The service jog through the pins: one spool, a limited current, its own enable sequence, and every way it ends.

use cross_tests::rig::scenario;
use firmware::service::{ServiceRequest, Task};
use firmware::{Intent, Request, State};
use hil_sim::plant::coil::Broken;
use hil_sim::service::calibrate::middle;
use hil_sim::service::{Workshop, idle, on_spool};

const BOOM: usize = 1;

fn jog(spool: u8, current_a: f32) -> ServiceRequest {
    ServiceRequest { current_a, ..on_spool(Task::Jog, spool) }
}

/// The machine in the middle of its strokes.
fn workshop() -> Workshop {
    let scenario = scenario("dig-zx200");
    Workshop::new(&scenario, middle(&scenario.plant), 1).expect("a machine")
}

/// A boom jog under way.
fn jogging() -> Workshop {
    let mut workshop = workshop();
    workshop.begin(jog(BOOM as u8, 0.4));
    workshop.ticks(300);
    assert_eq!(workshop.heard.phase, "under_way", "{:?}", workshop.heard);
    assert!(duties(&workshop)[BOOM][0] > 0);
    workshop
}

fn duties(workshop: &Workshop) -> [[u16; 2]; 4] {
    workshop.pins.as_ref().expect("a tick").duties
}

fn is_off(workshop: &Workshop) -> bool {
    duties(workshop) == [[0; 2]; 4] && !workshop.pins.as_ref().expect("a tick").cut_off_closed
}

#[test]
fn only_the_spool_asked_for_moves_and_the_way_asked_for() {
    let mut workshop = workshop();
    let before = workshop.plant.positions();
    workshop.begin(jog(2, -0.4));
    for _ in 0..3000 {
        workshop.tick();
        for (spool, [extend, retract]) in duties(&workshop).into_iter().enumerate() {
            assert!(extend == 0 && (retract == 0 || spool == 2), "{:?}", duties(&workshop));
        }
    }
    let after = workshop.plant.positions();
    assert!(after[2] < before[2] - 0.02, "{before:?} → {after:?}");
    assert_eq!((after[0], after[1], after[3]), (before[0], before[1], before[3]));
}

#[test]
fn the_current_stays_at_the_dead_band_and_a_fifth_of_full_scale_or_at_the_parameter() {
    let mut scenario = scenario("dig-zx200");
    let reached = |scenario: &hil_sim::scenario::Scenario| {
        let mut workshop = Workshop::new(scenario, middle(&scenario.plant), 1).expect("a machine");
        workshop.begin(jog(BOOM as u8, 2.5));
        workshop.ticks(1000);
        workshop.plant.solenoids()[BOOM][0].current_a()
    };
    let flow = scenario.parameters.coils.spools[BOOM].flow[0];
    let own = f64::from(flow.min_current_a + 0.2 * flow.max_current_a);
    let is = reached(&scenario);
    assert!((is - own).abs() < 0.01 * own, "{is} A instead of {own} A");
    scenario.parameters.jog.max_current_a = Some(0.25);
    let is = reached(&scenario);
    assert!((is - 0.25).abs() < 0.005, "{is} A");
}

#[test]
fn it_needs_a_fresh_command_neutral_levers_and_the_enable_switch_turned_on_in_this_order() {
    // Enable before the command: refused.
    let mut early = workshop();
    early.ticks(500);
    early.enable = true;
    early.ticks(100);
    early.ask(jog(BOOM as u8, 0.4));
    early.ticks(300);
    assert_eq!((early.heard.phase, early.heard.reason), ("refused", "enabled"));
    assert_eq!(duties(&early), [[0; 2]; 4]);
    // Levers not neutral: it waits.
    let mut busy = workshop();
    busy.rest();
    busy.ask(jog(BOOM as u8, 0.4));
    busy.intent = Some(Intent { request: Request::Levers, levers: [0, 20_000, 0, 0], ..Intent::NEUTRAL });
    busy.ticks(100);
    busy.enable = true;
    busy.ticks(300);
    assert_eq!(busy.heard.phase, "waiting_for_enable");
    assert!(is_off(&busy));
    // Without the switch: it waits.
    let mut waiting = workshop();
    waiting.rest();
    waiting.ask(jog(BOOM as u8, 0.4));
    waiting.ticks(2000);
    assert_eq!(waiting.heard.phase, "waiting_for_enable");
    assert!(is_off(&waiting));
}

/// What ends a jog, the phase and the reason it then shows.
type End = (&'static str, fn(&mut Workshop), &'static str, &'static str);

#[test]
fn everything_that_ends_it_opens_the_cut_off_and_a_new_one_needs_the_whole_sequence() {
    let ends: [End; 8] = [
        ("let go", |w| w.request = Some(idle()), "done", "none"),
        ("silent tool", |w| w.request = None, "aborted", "stale"),
        ("another spool", |w| w.request = Some(jog(2, 0.4)), "aborted", "changed"),
        ("another task", |w| w.request = Some(on_spool(Task::ValveSearch, 1)), "aborted", "changed"),
        ("enable off", |w| w.enable = false, "aborted", "enable_released"),
        (
            "levers",
            |w| w.intent = Some(Intent { request: Request::Levers, levers: [0, 9_000, 0, 0], ..Intent::NEUTRAL }),
            "aborted",
            "not_neutral",
        ),
        ("emergency stop", |w| w.emergency_stop = true, "aborted", "fault"),
        ("open coil", |w| w.plant.set_broken(BOOM, 0, Some(Broken::Open)), "aborted", "fault"),
    ];
    for (what, end, phase, reason) in ends {
        let mut workshop = jogging();
        let request = workshop.request;
        end(&mut workshop);
        // 100 ms of time-out, 20 ms of message period; an open coil takes as long to be sure of.
        workshop.ticks(160);
        assert!(is_off(&workshop), "{what}: {:?}", duties(&workshop));
        workshop.ticks(200);
        assert_eq!((workshop.heard.phase, workshop.heard.reason), (phase, reason), "{what}");
        // Everything as it was, but the switch was never off: nothing moves.
        workshop.emergency_stop = false;
        workshop.plant.set_broken(BOOM, 0, None);
        (workshop.request, workshop.intent, workshop.enable) = (request, Some(Intent::NEUTRAL), true);
        workshop.ticks(600);
        assert_eq!(duties(&workshop), [[0; 2]; 4], "{what}: it began again by itself");
        // Switched off and on, the switch enables the levers, but the command has had its turn.
        assert!(is_off(&workshop) || what == "enable off", "{what}");
        workshop.begin(jog(BOOM as u8, 0.4));
        workshop.ticks(300);
        assert!(duties(&workshop)[BOOM][0] > 0, "{what}: the whole sequence works again: {:?}", workshop.heard);
    }
}

#[test]
fn it_ends_by_itself_after_ten_seconds() {
    let mut workshop = workshop();
    workshop.begin(jog(0, 0.1));
    workshop.ticks(9_900);
    assert_eq!(workshop.heard.phase, "under_way");
    workshop.ticks(300);
    assert!(is_off(&workshop));
    assert_eq!((workshop.heard.phase, workshop.heard.reason), ("aborted", "too_long"));
}

#[test]
fn a_jog_commanded_at_work_changes_nothing_there() {
    let mut workshop = workshop();
    workshop.ticks(500);
    workshop.enable = true;
    workshop.ticks(10);
    workshop.intent = Some(Intent { request: Request::Levers, levers: [0, 0, 16_000, 0], ..Intent::NEUTRAL });
    workshop.ticks(300);
    let before = duties(&workshop)[2];
    workshop.request = Some(jog(BOOM as u8, 0.4));
    let outputs = workshop.ticks(500).expect("ticks");
    assert_eq!(outputs.state, State::Running);
    assert_eq!(duties(&workshop)[BOOM], [0; 2]);
    assert!(duties(&workshop)[2][0].abs_diff(before[0]) < 2000 && duties(&workshop)[2][0] > 0);
    assert_eq!((workshop.heard.phase, workshop.heard.reason), ("refused", "enabled"));
}

//! The application on a board: what volts, switches and CAN frames at its pins become as duties, telemetry and a fed watchdog.

use cross_tests::boards::{Bus, SimBoard, board_on};
use cross_tests::can::{NAME, sent};
use cross_tests::rig::{Rig, scenario};
use firmware::board::Controller;
use firmware::board::signals::RANGES;
use firmware::can::address::Addresses;
use firmware::can::command::Mode;
use firmware::can::table::received::{ARM_COMMAND, BOOM_COMMAND, BUCKET_COMMAND, MODE, SWING_COMMAND};
use firmware::{Fault, Outputs, Request, SelfTest, State};
use sim_chips::ads8688::{Break, Span};

/// A controller on its board, and an operator on the bus.
struct Machine {
    board: SimBoard<Bus>,
    controller: Controller,
    /// Inputs as a rig would give them: the codes that stand at the pins.
    rig: Rig,
    counter: u8,
    tick: u32,
    mode: Mode,
    /// Flow (%), and state: 0 blocked, 1 extend, 2 retract.
    boom: (f32, f32),
    /// Messages the operator leaves out.
    silent: bool,
}

impl Machine {
    /// At the dig's start, everything healthy.
    fn new() -> Self {
        let parameters = scenario("dig").parameters;
        let mut controller = Controller::new(&parameters, Addresses::DEFAULT, &NAME).expect("a valid record");
        controller.self_tested(&SelfTest::PASSED);
        Self {
            board: board_on(Bus::default()),
            controller,
            rig: Rig::new(),
            counter: 0,
            tick: 0,
            mode: Mode::Neutral,
            boom: (0.0, 0.0),
            silent: false,
        }
    }

    /// Volts at the converters' inputs for the rig's codes.
    fn put_codes(&mut self) {
        let mut put = |chip: usize, channel: usize, code: u16| {
            let volts = Span::of(RANGES[chip][channel].code()).volts(code);
            assert!(self.board.adcs[chip].bus().set_volts(channel as u8, volts));
        };
        for (channel, code) in self.rig.inputs.codes.into_iter().enumerate() {
            put(0, channel, code);
        }
        put(0, 4, self.rig.inputs.supply_code);
        put(0, 5, self.rig.inputs.sensor_supply_code);
        for (channel, code) in self.rig.coil_codes().into_iter().flatten().enumerate() {
            put(1, channel, code);
        }
    }

    fn operate(&mut self) {
        if !self.silent && self.tick.is_multiple_of(20) {
            let c = self.counter;
            let (flow, state) = self.boom;
            let blocked = [0.0, 0.0, 0.0, 0.0];
            self.board.can.inbound.extend([
                sent(&MODE, c, [self.mode.code() as f32, 0.0, 0.0]),
                sent(&SWING_COMMAND, c, blocked),
                sent(&BOOM_COMMAND, c, [flow, state, 0.0, 0.0]),
                sent(&ARM_COMMAND, c, blocked),
                sent(&BUCKET_COMMAND, c, blocked),
            ]);
            self.counter = (c + 1) & 0xf;
        }
        self.tick += 1;
    }

    fn cycle(&mut self) -> Outputs {
        self.operate();
        self.put_codes();
        let outputs = self.controller.cycle(&mut self.board, false);
        self.rig.drive(&outputs);
        outputs
    }

    fn cycles(&mut self, count: u32) -> Outputs {
        (0..count).map(|_| self.cycle()).last().expect("at least one cycle")
    }

    fn duties(&self) -> [[u16; 2]; 4] {
        self.board.solenoids.map(|spool| spool.map(|pwm| pwm.duty))
    }

    fn cut_off_closed(&self) -> bool {
        self.board.cut_off.0.get() == Some(true)
    }

    /// Neutral for a while, then the enable switch.
    fn start(&mut self) {
        assert_eq!(self.cycles(400).state, State::Ready);
        self.board.enable.0.set(Some(true));
        assert_eq!(self.cycles(2).state, State::Running);
    }
}

#[test]
fn a_lever_on_the_bus_becomes_a_duty_at_the_pin_and_nothing_else_moves() {
    let mut machine = Machine::new();
    machine.start();
    machine.mode = Mode::Levers;
    machine.boom = (40.0, 1.0);
    let outputs = machine.cycles(60);
    let duties = machine.duties();
    assert!(duties[1][0] > 500, "{duties:?}");
    let others = [duties[0][0], duties[0][1], duties[1][1], duties[2][0], duties[2][1], duties[3][0], duties[3][1]];
    assert_eq!(others, [0; 7]);
    assert!(machine.cut_off_closed());
    // The pin has what the application asked for, in the timer's own range.
    assert_eq!(u32::from(duties[1][0]), u32::from(outputs.duties[1][0]) * 4095 / 65535);
    machine.boom = (40.0, 2.0);
    machine.cycles(60);
    let duties = machine.duties();
    assert!(duties[1][1] > 500 && duties[1][0] == 0, "{duties:?}");
}

#[test]
fn through_the_pins_the_application_does_what_it_does_without_them() {
    let mut machine = Machine::new();
    machine.start();
    let mut rig = machine.rig.clone();
    // The board's pins have none.
    rig.noisy = false;
    rig.start();
    machine.mode = Mode::Dig;
    rig.request = Request::Dig;
    // Until the operator's next message.
    while machine.cycle().dig_tick == 0 {}
    let mut direct = rig.tick();
    // Not so long that sensors without noise count as stuck.
    for _ in 0..300 {
        let through = machine.cycle();
        direct = rig.tick();
        assert_eq!(through.duties, direct.duties);
        assert_eq!(through.speeds, direct.speeds);
        assert_eq!(through.pose, direct.pose);
    }
    assert!(direct.duties.iter().flatten().any(|&duty| duty > 0));
}

#[test]
fn the_watchdog_is_fed_once_a_cycle_and_not_when_an_output_fails() {
    let mut machine = Machine::new();
    machine.start();
    let fed = machine.board.watchdog.0;
    machine.cycles(100);
    assert_eq!(machine.board.watchdog.0, fed + 100);
    machine.board.solenoids[2][1].works = false;
    machine.cycles(10);
    assert_eq!(machine.board.watchdog.0, fed + 100);
    assert!(!machine.cut_off_closed());
    assert!(machine.duties().iter().flatten().all(|&duty| duty == 0));
}

#[test]
fn a_silent_operator_or_one_without_his_levers_is_a_stale_command() {
    let mut machine = Machine::new();
    machine.start();
    machine.mode = Mode::Levers;
    machine.boom = (100.0, 1.0);
    machine.cycles(60);
    machine.silent = true;
    let outputs = machine.cycles(230);
    assert_eq!(outputs.fault, Some(Fault::CommandStale));
    assert!(!machine.cut_off_closed());
}

#[test]
fn broken_converters_switches_and_read_backs_stop_the_machine_by_name() {
    type Break1 = fn(&mut Machine);
    let cases: [(&str, Break1, Fault); 5] = [
        ("sensors' converter", |m| m.board.adcs[0].bus().set_broken(Some(Break::StuckLow)), Fault::SensorConverter),
        ("coils' converter", |m| m.board.adcs[1].bus().set_broken(Some(Break::Noisy)), Fault::CoilConverter),
        ("stop input", |m| m.board.emergency_stop_released.0.set(None), Fault::EmergencyStop),
        ("stop wire", |m| m.board.emergency_stop_released.0.set(Some(false)), Fault::EmergencyStop),
        ("boom sensor", |m| m.rig.inputs.codes[1] = 0, Fault::Sensor(kinematics_core::Cylinder::Boom)),
    ];
    for (what, break_it, fault) in cases {
        let mut machine = Machine::new();
        machine.start();
        break_it(&mut machine);
        let outputs = machine.cycle();
        assert_eq!(outputs.fault, Some(fault), "{what}");
        assert!(!machine.cut_off_closed(), "{what}");
        assert!(machine.duties().iter().flatten().all(|&duty| duty == 0), "{what}");
    }
}

#[test]
fn telemetry_and_the_active_fault_go_out_on_the_bus() {
    use firmware::can::id::Identifier;
    let mut machine = Machine::new();
    machine.start();
    machine.board.can.outbound.clear();
    machine.board.emergency_stop_released.0.set(Some(false));
    machine.cycles(1200);
    let pgns: std::collections::BTreeSet<u32> =
        machine.board.can.outbound.iter().map(|frame| Identifier::of(frame.extended_id()).pgn).collect();
    let state = firmware::can::table::sent::STATE.header.pgn;
    assert!(pgns.contains(&state) && pgns.contains(&65226) && pgns.len() >= 6, "{pgns:?}");
}

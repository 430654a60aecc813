//! The supervisor's state machine, exhaustively: every state with every set of facts, every reachable state, and the whole supervisor
//! under every combination of its inputs.

use std::collections::BTreeSet;

use firmware::parameters::Supply;
use firmware::supervisor::machine::{Facts, next, transitions};
use firmware::supervisor::{Check, Gate, IDLE_TICKS, OVERRUN_TICKS, Supervisor, Watched};
use firmware::valve::coil_fault::{CoilFault, FaultyCoil};
use firmware::{Fault, Inputs, Intent, Request, SelfTest, State};

fn every_set() -> Vec<Facts> {
    let count = Facts::NAMED.len();
    let facts = |bits: u32| {
        let of = |all: Facts, (i, (fact, _)): (usize, &(Facts, &str))| all.and_if(bits >> i & 1 == 1, *fact);
        Facts::NAMED.iter().enumerate().fold(Facts::NONE, of)
    };
    (0..1 << count).map(facts).collect()
}

/// Every state with every set: where it leads.
fn everything() -> impl Iterator<Item = (State, Facts, State)> {
    State::ALL
        .into_iter()
        .flat_map(|state| every_set().into_iter().map(move |facts| (state, facts, next(state, facts))))
}

/// What can be reached from a state by sets of facts that `may` come.
fn reachable(from: State, may: impl Fn(Facts) -> bool) -> BTreeSet<u8> {
    let sets: Vec<Facts> = every_set().into_iter().filter(|facts| may(*facts)).collect();
    let mut found = BTreeSet::from([from.code()]);
    let mut open = vec![from];
    while let Some(state) = open.pop() {
        for facts in &sets {
            let to = next(state, *facts);
            if found.insert(to.code()) {
                open.push(to);
            }
        }
    }
    found
}

#[test]
fn every_state_with_every_set_of_facts_is_tried() {
    assert_eq!(everything().count(), 6 * 128);
}

#[test]
fn every_fact_is_told_from_every_other_and_stays_when_it_is_added_again() {
    for (i, (fact, name)) in Facts::NAMED.iter().enumerate() {
        for (j, (other, _)) in Facts::NAMED.iter().enumerate() {
            assert_eq!((fact.has(*other), fact.has_any(*other)), (i == j, i == j), "{name}");
        }
        assert_eq!(fact.and(*fact), *fact, "{name}");
    }
}

#[test]
fn running_begins_only_from_ready_self_tested_in_neutral_by_a_fresh_enable_with_nothing_wrong() {
    let needed = Facts::SELF_TESTED.and(Facts::NEUTRAL).and(Facts::ENABLE).and(Facts::ENABLE_EDGE);
    let wrong = Facts::WRONG.and(Facts::GRAVE);
    for (state, facts, to) in everything().filter(|(state, ..)| *state != State::Running) {
        let may = state == State::Ready && facts.has(needed) && !facts.has_any(wrong);
        assert_eq!(to == State::Running, may, "{state:?} {facts:?} → {to:?}");
    }
}

#[test]
fn running_ends_when_enable_goes_off_when_idle_and_when_anything_is_wrong_and_not_otherwise() {
    for (_, facts, to) in everything().filter(|(state, ..)| *state == State::Running) {
        let ends = Facts::IDLE.and(Facts::WRONG).and(Facts::GRAVE);
        assert_eq!(to == State::Running, facts.has(Facts::ENABLE) && !facts.has_any(ends), "{facts:?} → {to:?}");
    }
}

#[test]
fn a_fault_is_latched_in_every_state_and_a_grave_one_until_the_restart() {
    for (state, facts, to) in everything() {
        if state == State::Stopped || facts.has(Facts::GRAVE) {
            assert_eq!(to, State::Stopped, "{state:?} {facts:?}");
        } else if facts.has(Facts::WRONG) {
            assert_eq!(to, State::Fault, "{state:?} {facts:?}");
        } else if state == State::Fault && to != State::Fault {
            assert_eq!(to, State::Ready, "{facts:?}");
            assert!(facts.has(Facts::NEUTRAL.and(Facts::SELF_TESTED)) && !facts.has(Facts::ENABLE), "{facts:?}");
        }
    }
}

#[test]
fn every_state_is_reached_and_only_stopped_is_never_left() {
    let all: BTreeSet<u8> = State::ALL.into_iter().map(State::code).collect();
    assert_eq!(reachable(State::SelfTest, |_| true), all);
    for state in State::ALL {
        let runs_again = reachable(state, |_| true).contains(&State::Running.code());
        assert_eq!(runs_again, state != State::Stopped, "{state:?}");
    }
}

#[test]
fn without_self_test_neutral_enable_off_or_its_edge_running_is_never_reached() {
    let running = State::Running.code();
    for fact in [Facts::SELF_TESTED, Facts::NEUTRAL, Facts::ENABLE, Facts::ENABLE_EDGE] {
        assert!(!reachable(State::SelfTest, |facts| !facts.has(fact)).contains(&running), "{fact:?}");
    }
    assert!(!reachable(State::SelfTest, |facts| facts.has(Facts::ENABLE)).contains(&running), "enable never off");
    assert!(reachable(State::SelfTest, |facts| !facts.has_any(Facts::WRONG)).contains(&running));
}

#[test]
fn every_arrow_of_the_table_is_taken_by_something_and_changes_the_state() {
    for state in State::ALL {
        for (i, arrow) in transitions(state).iter().enumerate() {
            let fits = |facts: &Facts, i: usize| {
                let arrow = transitions(state)[i];
                facts.has(arrow.all) && !facts.has_any(arrow.none)
            };
            let taken = every_set().iter().any(|facts| fits(facts, i) && !(0..i).any(|earlier| fits(facts, earlier)));
            assert!(taken && arrow.to != state, "{state:?} → {:?}", arrow.to);
        }
    }
}

const HEALTHY: Inputs = Inputs {
    codes: [32768; 4],
    supply_code: 39321,
    sensor_supply_code: 63_999,
    coil_codes: [[2048; 2]; 4],
    command: Some(Intent::NEUTRAL),
    slope: None,
    pressures_pa: [[None; 2]; 3],
    service: None,
    converters_sound: [true; 2],
    cut_off_closed: false,
    enable: false,
    emergency_stop: false,
    overrun: false,
};
const AT_REST: Watched =
    Watched { supply_v: 24.0, sensor_supply_v: 10.0, coil: None, stage_fault: None, moving: false };
const SUPPLY: Supply = Supply { full_scale_v: 40.0, min_v: 9.0, max_v: 32.0 };
const SENSOR_SUPPLY: Supply = Supply { full_scale_v: 10.24, min_v: 9.5, max_v: 10.2 };

fn asking(request: Request) -> Option<Intent> {
    Some(Intent { request, ..Intent::NEUTRAL })
}

/// A supervisor with the relay that follows it.
#[derive(Clone, Copy)]
struct Bench {
    supervisor: Supervisor,
    inputs: Inputs,
    watched: Watched,
}

impl Bench {
    fn untested() -> Self {
        Self { supervisor: Supervisor::new(&SUPPLY, &SENSOR_SUPPLY), inputs: HEALTHY, watched: AT_REST }
    }

    fn locked() -> Self {
        let mut bench = Self::untested();
        bench.supervisor.self_tested(&SelfTest::PASSED);
        bench.tick();
        bench
    }

    fn ready() -> Self {
        let mut bench = Self::locked();
        bench.tick();
        bench
    }

    fn running() -> Self {
        let mut bench = Self::ready();
        bench.inputs.enable = true;
        bench.tick();
        bench
    }

    fn after(mut self, fault: Fault) -> Self {
        self.watched.stage_fault = Some(fault);
        self.tick();
        self.watched.stage_fault = None;
        self
    }

    /// The short way of a machine at work is tried beside the whole of it: it is taken for nothing else, and says and leaves the same.
    fn tick(&mut self) -> (State, Gate) {
        let (mut short, before) = (self.supervisor, format!("{:?}", self.supervisor));
        let watched = &self.watched;
        let faulty = watched.coil.is_some() || watched.stage_fault.is_some();
        let goes_on = short.goes_on(&self.inputs, (watched.supply_v, watched.sensor_supply_v), faulty);
        let gate = self.supervisor.judge(&self.inputs, &self.watched);
        if goes_on {
            assert_eq!(format!("{short:?} Open"), format!("{:?} {gate:?}", self.supervisor), "{self:?}");
        } else {
            assert_eq!(format!("{short:?}"), before, "{self:?}");
        }
        self.inputs.cut_off_closed = gate == Gate::Open;
        (self.supervisor.state(), gate)
    }
}

/// A bench in each state.
fn benches() -> [(State, Bench); 6] {
    [
        (State::SelfTest, Bench::untested()),
        (State::Locked, Bench::locked()),
        (State::Ready, Bench::ready()),
        (State::Running, Bench::running()),
        (State::Fault, Bench::running().after(Fault::FollowingError)),
        (State::Stopped, Bench::running().after(Fault::CutOffWelded)),
    ]
}

#[test]
fn the_whole_supervisor_opens_the_gate_only_while_running_whatever_comes_in_in_every_state() {
    let mut tried = 0;
    for (state, bench) in benches() {
        assert_eq!(bench.supervisor.state(), state);
        for bits in 0..1_u32 << 10 {
            let bit = |i: u32| bits >> i & 1 == 1;
            for stage_fault in [None, Some(Fault::FollowingError), Some(Fault::CutOffWelded)] {
                let mut b = bench;
                b.inputs.enable = bit(0);
                b.inputs.emergency_stop = bit(1);
                b.inputs.overrun = bit(2);
                b.inputs.converters_sound = [bit(3), bit(4)];
                b.inputs.cut_off_closed = bit(5);
                let command = asking(if bit(7) { Request::Neutral } else { Request::Levers });
                b.inputs.command = command.filter(|_| bit(6));
                b.watched.supply_v = if bit(8) { 24.0 } else { 8.9 };
                b.watched.moving = bit(9);
                b.watched.stage_fault = stage_fault;
                let (to, gate) = b.tick();
                let wrong = b.inputs.emergency_stop
                    || b.inputs.converters_sound != [true; 2]
                    || b.watched.supply_v < 9.0
                    || stage_fault.is_some();
                let open = match state {
                    State::Running => b.inputs.enable && bit(6) && !wrong,
                    State::Ready => b.inputs.enable && bit(6) && bit(7) && !wrong,
                    _ => false,
                };
                assert_eq!((gate == Gate::Open, to == State::Running), (open, open), "{state:?} {b:?}");
                assert_eq!(wrong && to != State::Stopped, to == State::Fault && wrong, "{state:?} {b:?}");
                tried += 1;
            }
        }
    }
    assert_eq!(tried, 6 * 1024 * 3);
}

impl std::fmt::Debug for Bench {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?} {:?}", self.inputs, self.watched)
    }
}

#[test]
fn a_failed_or_missing_step_of_the_self_test_enables_nothing_and_is_named() {
    type Step = fn(&mut SelfTest) -> &mut Check;
    let steps: [(Step, Fault); 5] = [
        (|t| &mut t.parameters, Fault::ParametersCorrupt),
        (|t| &mut t.memory, Fault::Memory),
        (|t| &mut t.converters, Fault::ConverterSetUp),
        (|t| &mut t.drivers, Fault::OutputDrivers),
        (|t| &mut t.cut_off, Fault::CutOffUnproven),
    ];
    for (step, fault) in steps {
        for (check, state, named) in
            [(Check::Pending, State::SelfTest, None), (Check::Failed, State::Stopped, Some(fault))]
        {
            let mut bench = Bench::untested();
            let mut report = SelfTest::PASSED;
            *step(&mut report) = check;
            bench.supervisor.self_tested(&report);
            for tick in 0..100 {
                bench.inputs.enable = tick > 50;
                assert_eq!(bench.tick(), (state, Gate::Closed));
            }
            assert_eq!(bench.supervisor.fault(), named);
        }
    }
}

#[test]
fn a_fault_during_the_self_test_does_not_get_round_it() {
    let mut bench = Bench::untested().after(Fault::FollowingError);
    for tick in 0..100 {
        bench.inputs.enable = tick > 50;
        assert_eq!(bench.tick(), (State::Fault, Gate::Closed));
    }
}

#[test]
fn a_machine_at_work_goes_on_the_short_way_and_nothing_wrong_does() {
    type Spoil<'a> = &'a dyn Fn(&mut Inputs, &mut Watched);
    let goes_on = |spoil: Spoil<'_>| {
        let mut b = Bench::running();
        b.inputs.command = asking(Request::Path);
        spoil(&mut b.inputs, &mut b.watched);
        let faulty = b.watched.coil.is_some() || b.watched.stage_fault.is_some();
        b.supervisor.goes_on(&b.inputs, (b.watched.supply_v, b.watched.sensor_supply_v), faulty)
    };
    assert!(goes_on(&|_, _| {}) && goes_on(&|_, watched| watched.moving = true));
    let spoilt: [Spoil<'_>; 12] = [
        &|inputs, _| inputs.enable = false,
        &|inputs, _| inputs.emergency_stop = true,
        &|inputs, _| inputs.overrun = true,
        &|inputs, _| inputs.cut_off_closed = false,
        &|inputs, _| inputs.converters_sound = [true, false],
        &|inputs, _| inputs.converters_sound = [false, true],
        &|inputs, _| inputs.command = None,
        &|inputs, _| inputs.command = asking(Request::Neutral),
        &|_, watched| watched.supply_v = f32::NAN,
        &|_, watched| watched.sensor_supply_v = 9.4,
        &|_, watched| watched.stage_fault = Some(Fault::FollowingError),
        &|_, watched| watched.coil = FaultyCoil::ALL.first().copied(),
    ];
    for (number, spoil) in spoilt.into_iter().enumerate() {
        assert!(!goes_on(spoil), "{number}");
    }
}

#[test]
fn enable_drops_after_ten_seconds_of_neutral_without_motion_and_needs_a_fresh_edge() {
    let mut bench = Bench::running();
    for _ in 1..IDLE_TICKS {
        assert_eq!(bench.tick(), (State::Running, Gate::Open));
    }
    assert_eq!(bench.tick(), (State::Locked, Gate::Closed));
    for _ in 0..100 {
        assert_eq!(bench.tick(), (State::Locked, Gate::Closed));
    }
    assert_eq!(bench.supervisor.fault(), None);
    bench.inputs.enable = false;
    bench.tick();
    bench.inputs.enable = true;
    assert_eq!(bench.tick(), (State::Running, Gate::Open));
}

#[test]
fn a_lever_or_a_motion_keeps_it_enabled() {
    for moving in [true, false] {
        let mut bench = Bench::running();
        for tick in 0..3 * IDLE_TICKS {
            let busy = tick % 9000 == 0;
            bench.watched.moving = busy && moving;
            bench.inputs.command = asking(if busy && !moving { Request::Levers } else { Request::Neutral });
            assert_eq!(bench.tick(), (State::Running, Gate::Open));
        }
    }
}

#[test]
fn fewer_than_three_overruns_in_a_row_stop_nothing_three_do_until_the_restart() {
    let mut bench = Bench::running();
    for tick in 0..300 {
        bench.inputs.overrun = tick % 3 != 0;
        assert_eq!(bench.tick(), (State::Running, Gate::Open));
    }
    bench.inputs.overrun = false;
    bench.tick();
    bench.inputs.overrun = true;
    for _ in 1..OVERRUN_TICKS {
        assert_eq!(bench.tick().1, Gate::Open);
    }
    assert_eq!(bench.tick(), (State::Stopped, Gate::Closed));
    assert_eq!(bench.supervisor.fault(), Some(Fault::Overrun));
    bench.inputs.overrun = false;
    for tick in 0..1000 {
        bench.inputs.enable = tick / 100 % 2 == 0;
        assert_eq!(bench.tick(), (State::Stopped, Gate::Closed));
    }
}

#[test]
fn a_cut_off_s_contact_may_be_elsewhere_for_fifty_ticks_then_it_is_stuck_open_or_welded() {
    for (mut bench, state, gate, contact, then, fault) in [
        (Bench::running(), State::Running, Gate::Open, false, State::Fault, Fault::CutOffStuckOpen),
        (Bench::ready(), State::Ready, Gate::Closed, true, State::Stopped, Fault::CutOffWelded),
    ] {
        for tick in 1..=50 {
            bench.inputs.cut_off_closed = contact;
            assert_eq!(bench.tick(), (state, gate), "{fault:?} {tick}");
        }
        bench.inputs.cut_off_closed = contact;
        assert_eq!(bench.tick(), (then, Gate::Closed));
        assert_eq!(bench.supervisor.fault(), Some(fault));
    }
}

#[test]
fn a_self_test_that_passes_while_enable_is_on_still_waits_for_its_edge() {
    let mut bench = Bench::ready();
    bench.supervisor.self_tested(&SelfTest::PENDING);
    bench.inputs.enable = true;
    assert_eq!(bench.tick(), (State::Ready, Gate::Closed));
    bench.supervisor.self_tested(&SelfTest::PASSED);
    assert_eq!(bench.tick(), (State::Ready, Gate::Closed));
    bench.inputs.enable = false;
    bench.tick();
    bench.inputs.enable = true;
    assert_eq!(bench.tick(), (State::Running, Gate::Open));
}

#[test]
fn a_fault_that_needs_a_restart_takes_the_name_of_one_that_does_not() {
    let bench = Bench::running().after(Fault::FollowingError).after(Fault::CutOffWelded);
    assert_eq!((bench.supervisor.state(), bench.supervisor.fault()), (State::Stopped, Some(Fault::CutOffWelded)));
    let bench = bench.after(Fault::FollowingError);
    assert_eq!(bench.supervisor.fault(), Some(Fault::CutOffWelded));
}

#[test]
fn exactly_the_faults_of_memory_scheduling_and_outputs_and_crossed_coils_need_a_restart() {
    let (coils, grave): (Vec<Fault>, Vec<Fault>) =
        Fault::ALL.into_iter().filter(|f| f.needs_restart()).partition(|fault| matches!(fault, Fault::Coil(_)));
    let cross = |fault: &Fault| matches!(fault, Fault::Coil(FaultyCoil { fault: CoilFault::Cross, .. }));
    assert!(coils.len() == 8 && coils.iter().all(cross), "{coils:?}");
    let grave: Vec<&str> = grave.into_iter().map(Fault::name).collect();
    let expected = [
        "tick_overrun",
        "cut_off_welded",
        "parameters_corrupt",
        "memory",
        "converter_set_up",
        "output_drivers",
        "cut_off_unproven",
    ];
    assert_eq!(grave, expected);
}

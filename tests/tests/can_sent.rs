//! What the controller sends: its timetable, the load of the bus, active faults, and the claim of its address.

use cross_tests::can::{Bench, NAME, all_faults, claim, of, sent};
use embedded_can::Frame;
use firmware::can::address::{AddressError, Addresses, Name};
use firmware::can::dm1::ActiveFaults;
use firmware::can::id::Identifier;
use firmware::can::load::{BIT_RATE, MOST_PERCENT, bits_per_second, worst_bits};
use firmware::can::message::{Rate, Sender};
use firmware::can::table::network::{ADDRESS_CLAIMED, DM1, REQUEST, TRANSPORT_CONTROL, TRANSPORT_DATA};
use firmware::can::table::sent::{LENGTHS, STATE, SWING_AND_BOOM_CURRENTS, TIP};
use firmware::can::table::{MESSAGES, received::MODE};
use firmware::can::{CanFrame, Node, protect};
use firmware::{Fault, trouble};

fn pgn(frame: &CanFrame) -> u32 {
    Identifier::of(frame.extended_id()).pgn
}

#[test]
fn every_message_goes_out_at_its_period_and_three_mailboxes_are_enough() {
    let mut bench = Bench::claimed();
    bench.active = all_faults();
    let mut sent = Vec::new();
    for at in 0..2000 {
        let due = bench.tick(&[]);
        assert!(due.len() <= 3, "{at}: {due:?}");
        sent.extend(due.into_iter().map(|frame| (at, frame)));
    }
    for entry in MESSAGES.iter().filter(|entry| entry.header.sender == Sender::Controller) {
        let Rate::Every { ms, .. } = entry.header.rate else { continue };
        let times: Vec<u32> = of(entry.header.pgn, &sent).into_iter().map(|(at, _)| at).collect();
        assert_eq!(times.len(), 2000 / usize::from(ms), "{}", entry.header.name);
        assert!(times.windows(2).all(|pair| pair[1] - pair[0] == u32::from(ms)), "{}", entry.header.name);
    }
}

#[test]
fn the_load_stays_below_its_limit_and_what_is_sent_below_what_is_stated() {
    println!("{} of {BIT_RATE} bit/s at worst", bits_per_second(false));
    assert!(bits_per_second(false) * 100 <= MOST_PERCENT * BIT_RATE);
    let mut bench = Bench::claimed();
    bench.active = all_faults();
    // A second of the busiest: all faults at once, and somebody asking for the address all the time.
    let asked = REQUEST.frame(0x27, 0, u64::from(ADDRESS_CLAIMED.header.pgn));
    let frames: usize = (0..1000).map(|_| bench.tick(&[asked]).len()).sum();
    let bits = frames as u32 * worst_bits(8);
    assert!(bits > 60_000 && bits <= bits_per_second(true), "{bits} of {}", bits_per_second(true));
    // Davis 2007: 160 bits for eight bytes under a 29-bit identifier.
    assert_eq!(worst_bits(8), 160);
}

#[test]
fn telemetry_says_what_the_application_put_out() {
    let mut bench = Bench::claimed();
    bench.outputs.currents[1] = [0.25, 0.75];
    let frames = bench.ticks(40);
    let of = |pgn| of(pgn, &frames)[0].1.payload().unwrap();
    let lengths = bench.outputs.lengths;
    for (value, expected) in
        LENGTHS.decode(of(LENGTHS.header.pgn)).into_iter().zip([lengths.boom, lengths.arm, lengths.bucket])
    {
        assert!(expected > 0.1 && (value.unwrap() - expected).abs() < 6e-5, "{value:?} {expected}");
    }
    let pose = bench.outputs.pose;
    for (value, expected) in TIP.decode(of(TIP.header.pgn)).into_iter().zip([pose.x, pose.y, pose.plane.height]) {
        assert!((value.unwrap() - expected).abs() < 6e-4, "{value:?} {expected}");
    }
    let [_, _, extend, retract] = SWING_AND_BOOM_CURRENTS.decode(of(SWING_AND_BOOM_CURRENTS.header.pgn));
    assert!((extend.unwrap() - 0.25).abs() < 1e-4 && (retract.unwrap() - 0.75).abs() < 1e-4);
    let [state, cut_off, pose_valid, fault, tick, ..] = STATE.unpack(of(STATE.header.pgn));
    assert_eq!((state, cut_off, pose_valid), (bench.outputs.state.code().into(), 0, 1));
    assert_eq!((fault, tick), (0, bench.outputs.tick));
}

#[test]
fn an_invalid_pose_is_sent_as_an_error_and_not_as_the_last_one() {
    let mut bench = Bench::claimed();
    bench.outputs.pose_valid = false;
    bench.outputs.fault = Some(Fault::Geometry);
    let frames = bench.ticks(40);
    for message in [LENGTHS.header.pgn, TIP.header.pgn] {
        let payload = of(message, &frames)[0].1.payload().unwrap();
        let values = LENGTHS.decode(payload);
        assert!(values.iter().all(|value| *value == Err(firmware::can::signal::Unusable::Error)), "{values:?}");
    }
    let [_, _, pose_valid, fault, ..] = STATE.unpack(of(STATE.header.pgn, &frames)[0].1.payload().unwrap());
    assert_eq!((pose_valid, fault), (0, Fault::Geometry.code().into()));
}

#[test]
fn the_states_counter_counts_and_its_crc_is_right() {
    let mut bench = Bench::claimed();
    let frames = of(STATE.header.pgn, &bench.ticks(400));
    let counters: Vec<u8> = frames
        .iter()
        .map(|(_, f)| protect::open(Identifier::of(f.extended_id()), f.payload().unwrap()).expect("a right CRC"))
        .collect();
    assert_eq!(counters.len(), 20);
    assert!(counters.windows(2).all(|pair| pair[1] == (pair[0] + 1) & 0xf), "{counters:?}");
}

/// A transfer's packets put together, or the single frame: its bytes.
fn dm1s(frames: &[(u32, CanFrame)]) -> Vec<(u32, Vec<u8>)> {
    let mut all: Vec<(u32, Vec<u8>)> = Vec::new();
    let mut awaited = 0;
    for (at, frame) in frames {
        let data = frame.data();
        match pgn(frame) {
            p if p == DM1.header.pgn => {
                assert_eq!(awaited, 0, "inside a transfer");
                all.push((*at, data.to_vec()));
            }
            p if p == TRANSPORT_CONTROL.header.pgn => {
                assert_eq!(awaited, 0, "inside a transfer");
                assert_eq!((data[0], &data[4..]), (32, &[0xff, 0xca, 0xfe, 0x00][..]));
                awaited = usize::from(data[3]);
                assert_eq!(usize::from(data[1]).div_ceil(7), awaited);
                all.push((*at, vec![data[1]]));
            }
            p if p == TRANSPORT_DATA.header.pgn => {
                let (_, bytes) = all.last_mut().unwrap();
                assert_eq!(usize::from(data[0]), bytes.len() / 7 + 1, "in order");
                bytes.extend(&data[1..]);
                awaited -= 1;
                if awaited == 0 {
                    let length = usize::from(bytes.remove(0));
                    assert!(bytes[length..].iter().all(|&b| b == 0xff));
                    bytes.truncate(length);
                }
            }
            _ => {}
        }
    }
    all
}

/// Lamps, and SPN, FMI and count of every code.
fn decoded(bytes: &[u8]) -> (u8, Vec<(u32, u8, u8)>) {
    let code = |b: &[u8]| {
        let spn = u32::from(b[0]) | u32::from(b[1]) << 8 | u32::from(b[2] >> 5) << 16;
        (spn, b[2] & 31, b[3] & 127)
    };
    (bytes[0], bytes[2..].chunks_exact(4).map(code).collect())
}

#[test]
fn without_a_fault_dm1_says_so_every_second() {
    let mut bench = Bench::claimed();
    let told = dm1s(&bench.ticks(3000));
    let times: Vec<u32> = told.iter().map(|(at, _)| *at).collect();
    assert_eq!(times.len(), 3, "{times:?}");
    assert!(times.windows(2).all(|pair| pair[1] - pair[0] == 1000), "{times:?}");
    assert!(told.iter().all(|(_, bytes)| *bytes == [0, 0xff, 0, 0, 0, 0, 0xff, 0xff]), "{told:?}");
}

#[test]
fn one_fault_is_told_at_once_in_one_frame() {
    let mut bench = Bench::claimed();
    bench.ticks(500);
    bench.active = ActiveFaults::from(Some(Fault::FollowingError));
    let told = dm1s(&bench.ticks(1500));
    assert_eq!(told.iter().map(|(at, _)| *at).collect::<Vec<_>>(), [0, 1000]);
    let code = Fault::FollowingError.trouble_code();
    let (lamps, codes) = decoded(&told[0].1[..6]);
    assert_eq!((lamps, codes), (0b01_0000, vec![(code.spn, code.fmi, 1)]));
}

#[test]
fn all_faults_are_told_in_packets_fifty_ticks_apart_most_urgent_first() {
    let mut bench = Bench::claimed();
    bench.ticks(500);
    bench.active = all_faults();
    let frames = bench.ticks(1990);
    let told = dm1s(&frames);
    assert_eq!(told.iter().map(|(at, _)| *at).collect::<Vec<_>>(), [0, 1000]);
    // As many as fit into a second, the most urgent ones.
    let listed = Fault::ALL.into_iter().take(31);
    let expected: Vec<_> = listed.map(|f| (f.trouble_code().spn, f.trouble_code().fmi, 1)).collect();
    for (_, bytes) in &told {
        assert_eq!(decoded(bytes), (0b01_0100, expected.clone()));
    }
    let packets: Vec<u32> = frames
        .iter()
        .filter(|(_, f)| [TRANSPORT_CONTROL.header.pgn, TRANSPORT_DATA.header.pgn].contains(&pgn(f)))
        .map(|(at, _)| *at)
        .collect();
    assert!(packets.len() > 10 && packets.windows(2).all(|p| p[1] - p[0] >= 50), "{packets:?}");
}

#[test]
fn a_flickering_fault_is_told_no_more_than_once_a_second_and_counts_its_occurrences() {
    let mut bench = Bench::claimed();
    bench.ticks(500);
    let mut frames = Vec::new();
    for at in 0..10_000 {
        bench.active = if at / 30 % 2 == 0 { ActiveFaults::from(Some(Fault::Supply)) } else { ActiveFaults::NONE };
        frames.extend(bench.tick(&[]).into_iter().map(|frame| (at, frame)));
    }
    let told = dm1s(&frames);
    let changes: Vec<u32> =
        told.windows(2).filter(|p| p[0].1[2] != p[1].1[2] || p[0].1[4] != p[1].1[4]).map(|p| p[1].0).collect();
    assert!(changes.len() > 4 && changes.windows(2).all(|p| p[1] - p[0] >= 1000), "{changes:?}");
    let counts: Vec<u8> = told.iter().map(|(_, bytes)| decoded(&bytes[..6]).1[0].2).filter(|&n| n > 0).collect();
    assert!(counts.is_sorted() && counts.last() > counts.first(), "{counts:?}");
}

#[test]
fn another_faults_change_does_not_wait_for_the_first_ones_second() {
    let mut bench = Bench::claimed();
    bench.ticks(500);
    bench.active = ActiveFaults::from(Some(Fault::Supply));
    let first = bench.ticks(200);
    bench.active = bench.active.with(Fault::EmergencyStop);
    let second = bench.ticks(1);
    assert_eq!((dm1s(&first).len(), pgn(&second.last().unwrap().1)), (1, TRANSPORT_CONTROL.header.pgn));
}

#[test]
fn every_fault_has_a_trouble_code_of_its_own_in_the_makers_range() {
    let mut codes: Vec<(u32, u8)> =
        Fault::ALL.into_iter().map(|fault| (fault.trouble_code().spn, fault.trouble_code().fmi)).collect();
    assert!(codes.iter().all(|(spn, fmi)| (trouble::FIRST_SPN..=524_287).contains(spn) && *fmi < 32));
    codes.sort_unstable();
    codes.dedup();
    assert_eq!(codes.len(), Fault::ALL.len());
}

#[test]
fn the_address_is_claimed_and_nothing_else_is_sent_for_a_quarter_of_a_second() {
    let mut bench = Bench::new();
    let frames = bench.ticks(250);
    assert_eq!(frames, [(0, claim(0x80, NAME.bits().unwrap()))]);
    assert_eq!(frames[0].1.extended_id().as_raw(), 0x18ee_ff80);
    assert!(!bench.ticks(20).is_empty());
}

#[test]
fn a_higher_name_does_not_take_the_address_and_a_lower_one_does() {
    let own = NAME.bits().unwrap();
    let mut bench = Bench::claimed();
    bench.ticks(100);
    let mut answer = bench.tick(&[claim(0x80, own + 1)]);
    assert_eq!(answer.pop(), Some(claim(0x80, own)));
    assert!(bench.node.has_address());
    bench.ticks(100);
    let mut sent = bench.tick(&[claim(0x80, own - 1)]);
    sent.extend(bench.ticks(500).into_iter().map(|(_, frame)| frame));
    assert_eq!(sent, [claim(0xfe, own)], "says that it has none, and nothing more");
    // A claim of another address is no matter.
    let mut other = Bench::claimed();
    other.tick(&[claim(0x81, own - 1)]);
    assert!(other.node.has_address());
}

#[test]
fn a_request_for_the_address_is_answered_whoever_it_was_sent_to() {
    let request = |destination, pgn: u32| {
        let id = Identifier { priority: 6, pgn: REQUEST.header.pgn, destination, source: 0x27 };
        CanFrame::new(id.extended(), &pgn.to_le_bytes()[..3]).unwrap()
    };
    for (destination, pgn, answered) in [(0xff, 60928, 1), (0x80, 60928, 1), (0x81, 60928, 0), (0xff, 65226, 0)] {
        let mut bench = Bench::claimed();
        bench.ticks(100);
        let mut frames: Vec<_> = bench.tick(&[request(destination, pgn)]).into_iter().map(|f| (0, f)).collect();
        frames.extend(bench.ticks(60));
        assert_eq!(of(ADDRESS_CLAIMED.header.pgn, &frames).len(), answered, "{destination} {pgn}");
    }
}

#[test]
fn a_node_without_an_address_still_hears_its_operator() {
    let mut bench = Bench::claimed();
    bench.tick(&[claim(0x80, 0)]);
    for counter in 0..4 {
        bench.tick(&[sent(&MODE, counter, [3.0, 0.0, 0.0])]);
    }
    assert!(!bench.node.has_address() && bench.inbox().mode().value.is_some());
}

#[test]
fn wrong_addresses_and_names_are_named() {
    let with = |addresses| Node::new(addresses, &NAME).unwrap_err().to_string();
    let d = Addresses::DEFAULT;
    assert_eq!(with(Addresses { operator: 0xfe, ..d }), "`operator` is 254 but must be within 0…253");
    assert_eq!(with(Addresses { slope_sensor: 0x80, ..d }), "`own` and `slope_sensor` must differ");
    let error = Name { manufacturer: 2048, ..NAME }.bits().unwrap_err();
    assert_eq!(error, AddressError::TooHigh { field: "Manufacturer", value: 2048, highest: 2047 });
}

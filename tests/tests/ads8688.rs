//! The converter's driver, the simulated converter, and both together, at the bytes of the SPI.
//!
//! The transcripts are written by hand from the data sheet (SBAS582C: Tables 6, 11 to 14, the figures of register write and read
//! and of the sequence modes), so that driver and simulation cannot agree on the same mistake.

use embedded_hal::spi::{ErrorKind, ErrorType, Operation, SpiDevice};
use firmware::board::ads8688::{AdcError, Ads8688, CHECK_SCANS, Channel, Device, Range, SCAN_BYTES};
use sim_chips::ads8688::{Ads8688 as Chip, Break, Span};

/// A frame: what the driver must send, what the chip answers.
type Frame = (Vec<u8>, Vec<u8>);

/// A bus that plays a transcript and accepts no other byte.
struct Transcript {
    frames: std::vec::IntoIter<Frame>,
}

impl Transcript {
    fn new(text: &str) -> Self {
        let bytes = |text: &str| text.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect();
        let frames: Vec<Frame> = text
            .lines()
            .filter(|line| !line.trim().is_empty())
            .map(|line| line.split_once('>').map(|(out, answer)| (bytes(out), bytes(answer))).unwrap())
            .collect();
        Self { frames: frames.into_iter() }
    }
}

impl ErrorType for Transcript {
    type Error = ErrorKind;
}

impl SpiDevice for Transcript {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), ErrorKind> {
        let [Operation::Transfer(read, write)] = operations else { panic!("one transfer a frame") };
        let (out, answer) = self.frames.next().expect("the transcript has ended");
        assert_eq!(**write, *out, "sent {write:02x?} where the data sheet wants {out:02x?}");
        read.copy_from_slice(&answer);
        Ok(())
    }
}

/// Device 1; channels 0 to 3 read 0 to 10.24 V, the rest the other ranges.
const RANGES: [Range; 8] = [
    Range::To10V24,
    Range::To10V24,
    Range::To10V24,
    Range::To10V24,
    Range::To5V12,
    Range::PlusMinus10V24,
    Range::PlusMinus5V12,
    Range::PlusMinus2V56,
];

/// RST, then every register written (echo in the third byte) and read back.
const CONFIGURE: &str = "
    85 00 00 00 00 00 > 00 00 00 00 00 00
    07 43 00 > 00 00 43
    06 00 00 > 00 00 43
    03 ff 00 > 00 00 ff
    02 00 00 > 00 00 ff
    05 00 00 > 00 00 00
    04 00 00 > 00 00 00
    0b 05 00 > 00 00 05
    0a 00 00 > 00 00 05
    0d 05 00 > 00 00 05
    0c 00 00 > 00 00 05
    0f 05 00 > 00 00 05
    0e 00 00 > 00 00 05
    11 05 00 > 00 00 05
    10 00 00 > 00 00 05
    13 06 00 > 00 00 06
    12 00 00 > 00 00 06
    15 00 00 > 00 00 00
    14 00 00 > 00 00 00
    17 01 00 > 00 00 01
    16 00 00 > 00 00 01
    19 02 00 > 00 00 02
    18 00 00 > 00 00 02
";

/// Results 1234h, 2345h, … Under each: channel in four bits, device 01, range in three, then low.
const SCAN: &str = "
    06 00 00 > 00 00 43
    a0 00 00 00 00 00 > 00 00 00 00 00 00
    00 00 00 00 00 00 > 00 00 12 34 06 80
    00 00 00 00 00 00 > 00 00 23 45 16 80
    00 00 00 00 00 00 > 00 00 34 56 26 80
    00 00 00 00 00 00 > 00 00 45 67 36 80
    00 00 00 00 00 00 > 00 00 56 78 47 00
    00 00 00 00 00 00 > 00 00 67 89 54 00
    00 00 00 00 00 00 > 00 00 78 9a 64 80
    00 00 00 00 00 00 > 00 00 89 ab 75 00
";
const SCANNED: [u16; 8] = [0x1234, 0x2345, 0x3456, 0x4567, 0x5678, 0x6789, 0x789a, 0x89ab];

fn driver<SPI: SpiDevice>(spi: SPI) -> Ads8688<SPI> {
    Ads8688::new(spi, Device::One, RANGES)
}

/// The driver's scan against a transcript in which one line was changed.
fn scan_of(line: usize, changed: &str) -> Result<[u16; 8], AdcError> {
    let mut lines: Vec<&str> = SCAN.lines().filter(|line| !line.trim().is_empty()).collect();
    lines[line] = changed;
    driver(Transcript::new(&lines.join("\n"))).scan()
}

#[test]
fn configuring_and_scanning_send_what_the_data_sheet_says() {
    let mut adc = driver(Transcript::new(&[CONFIGURE, SCAN].concat()));
    assert_eq!(adc.configure(), Ok(()));
    assert_eq!(adc.scan(), Ok(SCANNED));
    assert_eq!(adc.bus().frames.len(), 0, "frames are missing");
    let moved: usize = Transcript::new(SCAN).frames.map(|(out, _)| out.len()).sum();
    assert_eq!(moved, SCAN_BYTES);
}

#[test]
fn one_channel_by_hand_is_chosen_in_one_frame_and_read_in_the_next() {
    let transcript = "
        d0 00 00 00 00 00 > 00 00 ff ff 06 80
        00 00 00 00 00 00 > 00 00 be ef 47 00
    ";
    assert_eq!(driver(Transcript::new(transcript)).convert(Channel::ALL[4]), Ok(0xbeef));
}

#[test]
fn every_bit_around_a_result_is_looked_at() {
    let changed = |answer: &str| scan_of(4, &format!("00 00 00 00 00 00 > {answer}"));
    assert_eq!(changed("00 00 34 56 26 80"), Ok(SCANNED));
    let garbled = Err(AdcError::Garbled { channel: 2 });
    for wrong in ["80 00 34 56 26 80", "00 01 34 56 26 80", "00 00 34 56 26 81", "00 00 34 56 26 c0"] {
        assert_eq!(changed(wrong), garbled, "{wrong}");
    }
    assert_eq!(changed("00 00 34 56 2a 80"), Err(AdcError::WrongDevice { expected: 1, found: 2 }));
    assert_eq!(changed("00 00 34 56 22 80"), Err(AdcError::WrongDevice { expected: 1, found: 0 }));
    assert_eq!(changed("00 00 34 56 36 80"), Err(AdcError::WrongChannel { expected: 2, found: 3 }));
    assert_eq!(changed("00 00 34 56 a6 80"), Err(AdcError::WrongChannel { expected: 2, found: 10 }));
    assert_eq!(changed("00 00 34 56 27 00"), Err(AdcError::WrongRange { channel: 2 }));
    assert_eq!(changed("00 00 34 56 24 80"), Err(AdcError::WrongRange { channel: 2 }));
}

#[test]
fn a_register_that_changed_is_named_with_what_it_should_hold() {
    let wrong = |read| Err(AdcError::Configuration { register: 3, wrote: 0x43, read });
    assert_eq!(scan_of(0, "06 00 00 > 00 00 40"), wrong(0x40));
    assert_eq!(scan_of(0, "06 00 00 > 00 01 43"), wrong(0x43));
    let refused = CONFIGURE.replace("18 00 00 > 00 00 02", "18 00 00 > 00 00 00");
    let expected = AdcError::Configuration { register: 0x0c, wrote: 2, read: 0 };
    assert_eq!(driver(Transcript::new(&refused)).configure(), Err(expected));
}

/// Sends hand-written frames to the simulated chip and compares its answers.
fn plays(chip: &mut Chip, transcript: &str) {
    for (out, answer) in Transcript::new(transcript).frames {
        let mut read = vec![0xaa; answer.len()];
        chip.transfer(&mut read, &out).unwrap();
        assert_eq!(read, answer, "to {out:02x?} the chip answered {read:02x?}, the data sheet {answer:02x?}");
    }
}

#[test]
fn the_simulated_chip_answers_the_same_transcripts() {
    let mut chip = Chip::new();
    plays(&mut chip, CONFIGURE);
    for (channel, (range, code)) in RANGES.iter().zip(SCANNED).enumerate() {
        assert!(chip.set_volts(channel as u8, Span::of(range.code()).volts(code)));
    }
    plays(&mut chip, SCAN);
    assert_eq!(chip.not_understood(), 0);
}

#[test]
fn the_simulated_chip_wakes_without_a_mode_and_converts_a_frame_after_the_command() {
    let mut chip = Chip::new();
    chip.set_volts(0, -10.24);
    chip.set_volts(3, 5.12);
    // ±10.24 V after power-up: 5.12 V is three quarters. Nothing follows the 16 bits in format 000.
    plays(
        &mut chip,
        "
        00 00 00 00 00 00 > 00 00 00 00 00 00
        cc 00 00 00 > 00 00 00 00
        00 00 00 00 00 00 > 00 00 c0 00 00 00
        c0 00 00 00 > 00 00 c0 00
        7e 00 00 > 00 00 c0
        ",
    );
    // The read of the command register ended the mode.
    plays(&mut chip, "00 00 00 00 > 00 00 00 00");
    assert_eq!(chip.not_understood(), 0);
}

#[test]
fn the_simulated_sequence_takes_enabled_channels_in_order_and_starts_over() {
    let mut chip = Chip::new();
    for channel in 0..8 {
        chip.set_volts(channel, 0.32 * f32::from(channel));
    }
    // Channels 1 and 6 only, format 001: the channel in four bits after the result. 0.32 V is 400h.
    plays(
        &mut chip,
        "
        03 42 00 > 00 00 42
        07 01 00 > 00 00 01
        a0 00 00 00 00 > 00 00 00 00 00
        00 00 00 00 00 > 00 00 84 00 10
        00 00 00 00 00 > 00 00 98 00 60
        00 00 00 00 00 > 00 00 84 00 10
        a0 00 00 00 00 > 00 00 98 00 60
        00 00 00 00 00 > 00 00 84 00 10
        ",
    );
}

#[test]
fn short_frames_and_unknown_commands_change_nothing_in_the_simulated_chip() {
    let mut chip = Chip::new();
    plays(&mut chip, "c0 00 00 00 > 00 00 00 00\na0 > 00\n00 00 00 00 > 00 00 80 00");
    assert_eq!(chip.not_understood(), 0, "an aborted frame is no command");
    plays(&mut chip, "90 00 00 00 > 00 00 80 00\n00 00 00 00 > 00 00 80 00");
    // A write without the clocks of its echo, and one to an address that is none.
    plays(&mut chip, "0b 05 > 00 00\n0a 00 00 > 00 00 00\n09 05 00 > 00 00 05\n08 00 00 > 00 00 00");
    assert_eq!(chip.not_understood(), 4);
}

#[test]
fn every_code_of_every_range_survives_volts_and_back() {
    for range in [Range::PlusMinus10V24, Range::PlusMinus5V12, Range::PlusMinus2V56, Range::To10V24, Range::To5V12] {
        let span = Span::of(range.code());
        for code in 0..=u16::MAX {
            assert_eq!(span.code(span.volts(code)), code, "{range:?}");
        }
        assert_eq!(span.code(1e9), u16::MAX);
        assert_eq!(span.code(-1e9), 0);
    }
    // Table 1: 0 V is the middle of a range of both signs; 0 to 10.24 V has 156.25 µV a code.
    assert_eq!(Span::of(0b000).code(0.0), 0x8000);
    assert_eq!(Span::of(0b101).code(10_000.0 * 156.25e-6), 10_000);
}

/// A configured driver on a simulated chip, its inputs at the codes of [`SCANNED`].
fn running() -> Ads8688<Chip> {
    let mut adc = driver(Chip::new());
    adc.configure().unwrap();
    for (channel, (range, code)) in RANGES.iter().zip(SCANNED).enumerate() {
        adc.bus().set_volts(channel as u8, Span::of(range.code()).volts(code));
    }
    adc
}

#[test]
fn driver_and_chip_agree_over_many_scans() {
    let mut adc = running();
    for scan in 0..3 * CHECK_SCANS {
        assert_eq!(adc.scan(), Ok(SCANNED), "scan {scan}");
    }
    for (channel, code) in Channel::ALL.into_iter().zip(SCANNED) {
        assert_eq!(adc.convert(channel), Ok(code));
    }
    assert_eq!(adc.bus().not_understood(), 0);
}

#[test]
fn every_break_is_seen_in_the_scan_it_happens_and_named() {
    type IsNamed = fn(AdcError) -> bool;
    let cases: [(Break, IsNamed); 7] = [
        (Break::StuckLow, |e| e == AdcError::NoAnswer),
        (Break::StuckHigh, |e| e == AdcError::NoAnswer),
        (Break::Noisy, |e| matches!(e, AdcError::Garbled { channel: 0 })),
        (Break::StuckChannel(0), |e| e == AdcError::WrongChannel { expected: 1, found: 0 }),
        (Break::StuckChannel(6), |e| e == AdcError::WrongChannel { expected: 0, found: 6 }),
        (Break::WrongRange(2, 0b110), |e| e == AdcError::WrongRange { channel: 2 }),
        (Break::Bus, |e| e == AdcError::Bus(ErrorKind::Other)),
    ];
    for (broken, is_named) in cases {
        // Whatever register is being looked at.
        for before in 0..CHECK_SCANS {
            let mut adc = running();
            for _ in 0..before {
                adc.scan().unwrap();
            }
            adc.bus().set_broken(Some(broken));
            let error = adc.scan().expect_err(&format!("{broken:?} was not seen"));
            assert!(is_named(error), "{broken:?} was called {error:?}");
        }
    }
}

#[test]
fn no_scan_of_a_noisy_chip_is_believed() {
    let mut adc = running();
    adc.bus().set_broken(Some(Break::Noisy));
    let believed = (0..100_000).filter(|_| adc.scan().is_ok()).count();
    assert_eq!(believed, 0);
}

#[test]
fn every_wrong_range_of_every_channel_is_seen_at_once() {
    for channel in 0..8 {
        for code in [0b000, 0b001, 0b010, 0b101, 0b110] {
            let mut adc = running();
            adc.bus().set_broken(Some(Break::WrongRange(channel, code)));
            if code == RANGES[usize::from(channel)].code() {
                assert_eq!(adc.scan(), Ok(SCANNED));
            } else {
                assert_eq!(adc.scan(), Err(AdcError::WrongRange { channel }), "code {code:03b}");
            }
        }
    }
}

#[test]
fn a_reset_chip_is_seen_at_once_and_works_after_configuring() {
    let mut adc = running();
    adc.scan().unwrap();
    adc.bus().reset();
    assert_eq!(adc.scan(), Err(AdcError::WrongDevice { expected: 1, found: 0 }));
    assert_eq!(adc.scan().unwrap_err().to_string(), "device 1 was reset");
    assert_eq!(adc.configure(), Ok(()));
    assert_eq!(adc.scan(), Ok(SCANNED));
}

#[test]
fn a_chip_that_answers_on_the_others_select_is_seen() {
    let mut other = Ads8688::new(Chip::new(), Device::Two, RANGES);
    other.configure().unwrap();
    let mut adc = driver(other.bus());
    assert_eq!(adc.scan(), Err(AdcError::WrongDevice { expected: 1, found: 2 }));
}

#[test]
fn a_register_the_results_do_not_show_is_seen_when_its_turn_comes() {
    let mut adc = running();
    // Channel 5 loses its power: its result is plausible, only the register tells.
    plays(adc.bus(), "05 20 00 > 00 00 20");
    let seen = (1..=CHECK_SCANS).find(|_| adc.scan().is_err());
    assert_eq!(seen, Some(3), "the power-down register is the third looked at");
    let after_a_round = (1..=CHECK_SCANS).filter(|_| adc.scan().is_err()).count();
    assert_eq!(after_a_round, 1);
}

#[test]
fn a_broken_chip_cannot_be_configured() {
    for (broken, expected) in [
        (Break::StuckLow, AdcError::NoAnswer),
        (Break::StuckHigh, AdcError::NoAnswer),
        (Break::Bus, AdcError::Bus(ErrorKind::Other)),
    ] {
        let mut adc = driver(Chip::new());
        adc.bus().set_broken(Some(broken));
        assert_eq!(adc.configure(), Err(expected), "{broken:?}");
    }
    let mut adc = driver(Chip::new());
    adc.bus().set_broken(Some(Break::Noisy));
    assert!(matches!(adc.configure(), Err(AdcError::Configuration { .. })));
}

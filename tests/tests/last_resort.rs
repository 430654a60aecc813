//! When nothing else helps, on the emulated Cortex-M4F: panic, hard fault, stack overflow and an interrupt nobody expects each end with the
//! outputs off, by the handlers and the stack guard of the board's image. The registers of its ports are not emulated; the emulator
//! writes down every access to them.

use std::io::Write;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use hil_sim::place::Image;

/// Exit code of the image, and what was written to the ports' registers.
fn told(image: &Image, way: u8) -> (i32, Vec<(String, u32, u32)>) {
    let log = std::env::temp_dir().join(format!("last-resort-{}-{way}", std::process::id()));
    let mut emulator = Command::new("qemu-system-arm")
        .args(["-machine", "netduinoplus2", "-display", "none", "-serial", "none", "-monitor", "none"])
        .args(["-semihosting-config", "enable=on,target=native", "-icount", "shift=3,sleep=off", "-d", "unimp", "-D"])
        .arg(&log)
        .arg("-kernel")
        .arg(&image.path)
        .stdin(Stdio::piped())
        .spawn()
        .expect("qemu-system-arm");
    emulator.stdin.take().expect("a pipe").write_all(&[way]).expect("the image reads");
    let status = (0..1000).find_map(|_| {
        thread::sleep(Duration::from_millis(20));
        emulator.try_wait().expect("a child")
    });
    if status.is_none() {
        emulator.kill().expect("a child that still runs");
    }
    let text = std::fs::read_to_string(&log).expect("the emulator's log");
    std::fs::remove_file(&log).expect("the emulator's log");
    let code = status.and_then(|status| status.code()).unwrap_or_else(|| panic!("`{}`: {status:?}", way as char));
    (code, text.lines().filter_map(write).collect())
}

/// "GPIOB: unimplemented device write (size 4, offset 0x018, value 0x00010000)"
fn write(line: &str) -> Option<(String, u32, u32)> {
    let (device, access) = line.split_once(": unimplemented device write")?;
    let number = |name: &str| {
        let digits = access.split_once(name)?.1.strip_prefix("0x")?;
        u32::from_str_radix(digits.split([',', ')']).next()?, 16).ok()
    };
    Some((device.to_owned(), number("offset ")?, number("value ")?))
}

/// Offsets of a port's registers (RM0090, 8.4): mode of the pins; set and reset.
const MODER: u32 = 0x00;
const BSRR: u32 = 0x18;

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn panic_hard_fault_stack_overflow_and_strange_interrupts_end_with_the_outputs_off() {
    let image = Image::build("faults-emulated").unwrap_or_else(|error| panic!("{error}"));
    let told_codes = [
        (b'p', 10, "a panic"),
        (b'h', 11, "an undefined instruction"),
        (b's', 12, "a stack that grows into its guard"),
        (b'i', 13, "an interrupt without a handler"),
        (b'x', 10, "a start that cannot go on"),
    ];
    for (way, expected, name) in told_codes {
        let (code, writes) = told(&image, way);
        assert_eq!(code, expected, "{name}");
        let find = |port: &str, register: u32, value: u32| {
            let wanted = (port.to_owned(), register, value);
            writes
                .iter()
                .position(|found| *found == wanted)
                .unwrap_or_else(|| panic!("{name}: {wanted:x?} in {writes:x?}"))
        };
        // PB0, the cut-off, before anything else; then PC6 to PC9 and PB6 to PB9 low, and outputs of their own instead of their timers'.
        assert_eq!(find("GPIOB", BSRR, 1 << 16), 0, "{name}: the cut-off opens first");
        let low = [find("GPIOC", BSRR, 0b1111 << 22), find("GPIOB", BSRR, 0b1111 << 22)];
        let taken = [find("GPIOC", MODER, 0x55 << 12), find("GPIOB", MODER, 0x55 << 12)];
        assert!(
            low.iter().all(|low| taken.iter().all(|taken| low < taken)),
            "{name}: low before they leave their timers"
        );
    }
}

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn an_image_that_does_not_fail_touches_no_output() {
    let image = Image::build("faults-emulated").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(told(&image, b'-'), (1, vec![]));
}

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn the_parameter_flash_is_unlocked_for_one_operation_erased_forgotten_by_the_cache_programmed_and_locked() {
    let image = Image::build("faults-emulated").unwrap_or_else(|error| panic!("{error}"));
    let (code, writes) = told(&image, b'w');
    assert_eq!(code, 0, "sector 3 erased and a word of it programmed");
    let found: Vec<(u32, u32)> =
        writes.into_iter().filter(|(device, ..)| device == "Flash Int").map(|(_, at, value)| (at, value)).collect();
    // RM0090, 3.9: access control, keys, status, control.
    const ACR: u32 = 0x00;
    const KEYR: u32 = 0x04;
    const SR: u32 = 0x0c;
    const CR: u32 = 0x10;
    let unlocked = [(KEYR, 0x4567_0123), (KEYR, 0xcdef_89ab), (SR, 0xf2)];
    let locked = [(CR, 1 << 31)];
    // Sector 3 by words of 32 bits: chosen, then started.
    let erased = [(CR, 0x21a), (CR, 0x1_021a)];
    // Data cache off, reset, on again.
    let forgotten = [(ACR, 0), (ACR, 1 << 12), (ACR, 0), (ACR, 1 << 10)];
    let programmed = [(CR, 0x201)];
    let expected = [&unlocked[..], &erased, &locked, &forgotten, &unlocked, &programmed, &locked].concat();
    assert_eq!(found, expected);
}

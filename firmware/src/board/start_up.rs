//! The part of the start-up self-test that needs the board's pins, before the first tick: output drivers, cut-off, a block of memory.

use core::hint::black_box;

use super::signals::Measured;
use super::{Board, BoardError};
use crate::io::Solenoids;
use crate::supervisor::Check;
use crate::valve::coil_stage::CoilStageParameters;

/// A relay closes or opens within so many milliseconds.
const RELAY_MS: u8 = 60;
/// A driver's pulse, ms.
const PULSE_MS: u8 = 2;
const OFF: [Solenoids<u16>; 4] = [[0; 2]; 4];

/// Code of a coil current below which nothing flows.
pub fn quiet_code(coils: &CoilStageParameters) -> u16 {
    let floor = coils.watch.floor_a / coils.sense.full_scale_a * 65536.0;
    // The cast saturates.
    coils.sense.zero_code.saturating_add(floor as u16)
}

/// Tries the drivers and the cut-off, and leaves all duties zero and the cut-off open. `wait` lets a millisecond pass. About 0.1 s; the
/// watchdog is fed in it.
///
/// Drivers: with the cut-off open each solenoid is pulsed, and no coil may carry current. Cut-off: with all duties zero its contact must
/// close and open as told, and no coil may carry current while it is closed.
pub fn try_outputs<B: Board>(board: &mut B, quiet_code: u16, mut wait: impl FnMut()) -> [Check; 2] {
    let mut pass = |board: &mut B, ms: u8| {
        for _ in 0..ms {
            wait();
            board.feed_watchdog();
        }
    };
    let drivers = try_drivers(board, quiet_code, &mut pass);
    let off = board.drive(&OFF).is_ok();
    let cut_off = if off { try_cut_off(board, quiet_code, &mut pass) } else { Ok(false) };
    let opened = board.set_cut_off(false).is_ok();
    let check = |good: bool| if good { Check::Passed } else { Check::Failed };
    [check(off && drivers == Ok(true)), check(opened && cut_off == Ok(true))]
}

/// No coil carries current, as far as the converter knows.
fn is_quiet<B: Board>(board: &mut B, quiet_code: u16) -> bool {
    let [Ok(first), Ok(second)] = board.scan() else { return false };
    Measured::from_scans(&[first, second]).coils.iter().flatten().all(|code| *code <= quiet_code)
}

fn try_drivers<B: Board>(
    board: &mut B,
    quiet_code: u16,
    pass: &mut impl FnMut(&mut B, u8),
) -> Result<bool, BoardError> {
    board.set_cut_off(false)?;
    if board.cut_off_is_closed()? {
        return Ok(false);
    }
    for number in 0..8 {
        let mut duties = OFF;
        if let Some(duty) = duties.iter_mut().flatten().nth(number) {
            *duty = u16::MAX;
        }
        board.drive(&duties)?;
        pass(board, PULSE_MS);
        if !is_quiet(board, quiet_code) {
            return Ok(false);
        }
    }
    Ok(true)
}

fn try_cut_off<B: Board>(
    board: &mut B,
    quiet_code: u16,
    pass: &mut impl FnMut(&mut B, u8),
) -> Result<bool, BoardError> {
    let mut good = true;
    for closed in [true, false] {
        board.set_cut_off(closed)?;
        pass(board, RELAY_MS);
        good &= board.cut_off_is_closed()? == closed && is_quiet(board, quiet_code);
    }
    Ok(good)
}

/// Writes patterns to a block of memory and reads them back; what stood there is lost.
pub fn memory_holds(block: &mut [u32]) -> Check {
    let patterns: [fn(u32) -> u32; 4] = [|_| 0x5555_5555, |_| 0xAAAA_AAAA, |at| at, |at| !at];
    for pattern in patterns {
        (0..).zip(block.iter_mut()).for_each(|(at, word)| *word = pattern(at));
        // The compiler must not know what was written.
        let read = black_box(&mut *block);
        if (0..).zip(read.iter()).any(|(at, word)| *word != pattern(at)) {
            return Check::Failed;
        }
    }
    Check::Passed
}

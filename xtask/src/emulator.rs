//! Makes sure of `qemu-system-arm`.

use crate::packages;
use crate::process::{Outcome, announce, capture, command};

const PROGRAM: &str = "qemu-system-arm";
/// The board the images are built for (STM32F405).
const MACHINE: &str = "netduinoplus2";

/// Finds the emulator or installs it, and says which it is.
pub(crate) fn ensure() -> Outcome<()> {
    announce("emulator");
    let version = version().or_else(|_missing| {
        packages::install_emulator()
            .and_then(|()| version())
            .map_err(|why| format!("{PROGRAM} is missing ({why}); {}", packages::EMULATOR_BY_HAND))
    })?;
    let machines = capture(command(PROGRAM).args(["-machine", "help"]))?;
    if !machines.lines().any(|line| line.split_whitespace().next() == Some(MACHINE)) {
        return Err(format!("this {PROGRAM} ({version}) does not know the board {MACHINE}; version 7.2 does"));
    }
    eprintln!("{version}");
    Ok(())
}

fn version() -> Outcome<String> {
    let text = capture(command(PROGRAM).arg("--version"))?;
    Ok(text.lines().next().unwrap_or_default().to_owned())
}

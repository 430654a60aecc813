//! The package managers this project may install from, in one small table.

use crate::process::{Outcome, announce, capture, command, run};

/// How a package manager is driven.
struct Manager {
    program: &'static str,
    /// Refreshes the package lists first, where installing does not do it itself.
    refresh: &'static [&'static str],
    install: &'static [&'static str],
    needs_root: bool,
    /// The package with `qemu-system-arm`.
    emulator: &'static str,
    /// The package with Chromium.
    browser: &'static str,
}

// `--no-remove`: nothing that is already on the machine may go because of us.
static MANAGERS: [Manager; 4] = [
    Manager {
        program: "apt-get",
        refresh: &["-o", "DPkg::Lock::Timeout=300", "update"],
        install: &["-o", "DPkg::Lock::Timeout=300", "install", "-y", "--no-install-recommends", "--no-remove"],
        needs_root: true,
        emulator: "qemu-system-arm",
        browser: "chromium",
    },
    Manager {
        program: "dnf",
        refresh: &[],
        install: &["install", "-y"],
        needs_root: true,
        emulator: "qemu-system-arm",
        browser: "chromium",
    },
    Manager {
        program: "pacman",
        refresh: &[],
        install: &["-Sy", "--noconfirm", "--needed"],
        needs_root: true,
        emulator: "qemu-system-arm",
        browser: "chromium",
    },
    Manager {
        program: "brew",
        refresh: &[],
        install: &["install"],
        needs_root: false,
        emulator: "qemu",
        browser: "chromium",
    },
];

/// What to tell a user who has to install the emulator himself.
pub(crate) const EMULATOR_BY_HAND: &str =
    "install QEMU's ARM system emulator: package qemu-system-arm (Debian, Ubuntu, Fedora, Arch) or qemu (Homebrew)";

/// Installs the package that has `qemu-system-arm`, with the first package manager on this machine.
pub(crate) fn install_emulator() -> Outcome<()> {
    let manager = first()?;
    install(manager, &[manager.emulator])
}

/// Installs the package that has Chromium, the same way.
pub(crate) fn install_browser() -> Outcome<()> {
    let manager = first()?;
    install(manager, &[manager.browser])
}

fn first() -> Outcome<&'static Manager> {
    MANAGERS.iter().find(|manager| exists(manager.program)).ok_or_else(|| "no package manager found".to_owned())
}

/// Installs Debian packages; an error where there is no `apt-get`.
pub(crate) fn install_debian(packages: &[&str]) -> Outcome<()> {
    let manager = MANAGERS.iter().find(|manager| manager.program == "apt-get" && exists(manager.program));
    install(manager.ok_or("there is no apt-get here")?, packages)
}

fn install(manager: &Manager, packages: &[&str]) -> Outcome<()> {
    let prefix: &[&str] = match () {
        () if !manager.needs_root || is_root() => &[],
        () if capture(command("sudo").args(["-n", "true"])).is_ok() => &["sudo", "-n"],
        () => return Err(format!("{} needs root, or sudo without a password", manager.program)),
    };
    announce(&format!("installing {} with {}", packages.join(" "), manager.program));
    // Through env, because sudo drops the caller's variables.
    let words =
        |rest: &[&'static str]| [prefix, &["env", "DEBIAN_FRONTEND=noninteractive", manager.program], rest].concat();
    if !manager.refresh.is_empty() {
        run_words(&words(manager.refresh))?;
    }
    run_words(&[words(manager.install).as_slice(), packages].concat())
}

fn run_words(words: &[&str]) -> Outcome<()> {
    let (program, arguments) = words.split_first().ok_or("an empty command")?;
    run(command(program).args(arguments))
}

fn exists(program: &str) -> bool {
    capture(command(program).arg("--version")).is_ok()
}

fn is_root() -> bool {
    capture(command("id").arg("-u")).is_ok_and(|id| id.trim() == "0")
}

//! A compiler for the ECU: rustup's target where it can be had, otherwise Debian's compiler, which builds `core`
//! from source.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::packages;
use crate::process::{Outcome, announce, capture, cargo, command, run, rustc};

/// The Cortex-M4F with hardware floating point.
pub(crate) const TARGET: &str = "thumbv7em-none-eabihf";
/// Chooses the compiler instead of taking the first that works.
pub(crate) const CHOICE: &str = "XTASK_ARM_TOOLCHAIN";

const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
const DEBIAN_PACKAGES: [&str; 2] = ["rustc-web", "rust-web-src"];

/// Where the code for the target comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Toolchain {
    /// The active toolchain has the target's `core`.
    Rustup,
    /// Debian's compiler and library sources; they lack a linker for the target, so the toolchain's is used.
    Debian { linker: PathBuf },
}

impl Toolchain {
    /// The value of [`CHOICE`] that means this one.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::Rustup => "rustup",
            Self::Debian { .. } => "debian",
        }
    }

    /// `cargo build` for the target.
    pub(crate) fn build(&self) -> Command {
        let mut build = cargo();
        build.args(["build", "--target", TARGET]);
        if let Self::Debian { linker } = self {
            build.arg("-Zbuild-std=core").env("RUSTC", DEBIAN_RUSTC).env("RUSTC_BOOTSTRAP", "1");
            build.env("CARGO_TARGET_THUMBV7EM_NONE_EABIHF_LINKER", linker);
        }
        build
    }
}

/// Finds a compiler for the target or installs one, and says which.
pub(crate) fn ensure() -> Outcome<Toolchain> {
    announce("ARM compiler");
    let choice = env::var(CHOICE).unwrap_or_default();
    let toolchain = match choice.as_str() {
        "rustup" => rustup()?,
        "debian" => debian()?,
        "" => rustup().or_else(|why| {
            eprintln!("{why}\ntrying Debian's {}", DEBIAN_PACKAGES.join(" and "));
            debian().map_err(|and| {
                format!(
                    "no compiler for {TARGET}: {why}; {and}.\nInstall one of: `rustup target add {TARGET}`, or Debian's \
                     `apt-get install {}` beside a rustup toolchain",
                    DEBIAN_PACKAGES.join(" ")
                )
            })
        })?,
        other => return Err(format!("{CHOICE}={other}: must be rustup or debian, or not be set")),
    };
    let described = match toolchain {
        Toolchain::Rustup => capture(rustc().arg("--version"))?,
        Toolchain::Debian { .. } => capture(command(DEBIAN_RUSTC).arg("--version"))?,
    };
    eprintln!("{TARGET} from {}: {}", toolchain.name(), described.trim());
    Ok(toolchain)
}

/// The active toolchain with the target, added if need be.
pub(crate) fn rustup() -> Outcome<Toolchain> {
    if !has_core() {
        run(command("rustup").args(["target", "add", TARGET]))?;
        if !has_core() {
            return Err(format!("`rustup target add {TARGET}` succeeded, but the active rustc still lacks the target"));
        }
    }
    Ok(Toolchain::Rustup)
}

/// Whether the compiler cargo uses can build for the target now. Asks the compiler rather than `rustup target list`:
/// it is right for a toolchain of any origin, and for one chosen by `+name` or by variable.
fn has_core() -> bool {
    let directory = capture(rustc().args(["--print", "target-libdir", "--target", TARGET]));
    let files = directory.ok().and_then(|path| Path::new(path.trim()).read_dir().ok());
    files.is_some_and(|files| files.flatten().any(|file| file.file_name().to_string_lossy().starts_with("libcore-")))
}

/// Debian's compiler and sources, installed if need be, with the active toolchain's linker.
fn debian() -> Outcome<Toolchain> {
    // First the linker: without it there is no point in installing anything.
    let linker = rust_lld()?;
    if debian_problem().is_some() {
        packages::install_debian(&DEBIAN_PACKAGES)?;
    }
    match debian_problem() {
        Some(problem) => Err(problem),
        None => Ok(Toolchain::Debian { linker }),
    }
}

/// What keeps Debian's compiler from building the images, if anything.
fn debian_problem() -> Option<String> {
    let Ok(version) = capture(command(DEBIAN_RUSTC).arg("--version")) else {
        return Some(format!("{DEBIAN_RUSTC} is missing"));
    };
    let needed = env!("CARGO_PKG_RUST_VERSION");
    if minor(&version) < minor(needed) {
        return Some(format!("{DEBIAN_RUSTC} is too old ({}); {needed} is needed", version.trim()));
    }
    let sysroot = capture(command(DEBIAN_RUSTC).args(["--print", "sysroot"])).unwrap_or_default();
    let sources = Path::new(sysroot.trim()).join("lib/rustlib/src/rust/library/Cargo.lock");
    (!sources.exists()).then(|| format!("the library sources of {DEBIAN_RUSTC} are missing ({})", sources.display()))
}

/// The linker inside the active toolchain.
fn rust_lld() -> Outcome<PathBuf> {
    let sysroot = capture(rustc().args(["--print", "sysroot"]))?;
    let verbose = capture(rustc().arg("-vV"))?;
    let host = verbose.lines().find_map(|line| line.strip_prefix("host: ")).ok_or("rustc -vV names no host")?;
    let linker = Path::new(sysroot.trim()).join("lib/rustlib").join(host).join("bin/rust-lld");
    if linker.exists() { Ok(linker) } else { Err(format!("the active toolchain has no {}", linker.display())) }
}

/// `(major, minor)` of the first version number in a text such as `rustc 1.96.0 (…)`; `None` sorts below any.
fn minor(text: &str) -> Option<(u32, u32)> {
    let number = text.split_whitespace().find(|word| word.starts_with(|c: char| c.is_ascii_digit()))?;
    let mut parts = number.split(|c: char| !c.is_ascii_digit()).map(str::parse);
    Some((parts.next()?.ok()?, parts.next()?.ok()?))
}

#[cfg(test)]
mod choosing {
    use super::{TARGET, Toolchain, minor};
    use std::ffi::OsStr;

    #[test]
    fn versions_are_compared_as_numbers() {
        assert_eq!(minor("rustc 1.96.0 (ac68faa20 2026-05-25)"), Some((1, 96)));
        assert!(minor("rustc 1.100.0-nightly") > minor("1.95"));
        assert!(minor("rustc 1.63.0") < minor("1.95"));
        assert!(minor("no number") < minor("1.95"));
    }

    #[test]
    fn debian_builds_core_with_the_linker_of_the_toolchain() {
        let build = Toolchain::Debian { linker: "/tools/rust-lld".into() }.build();
        assert!(build.get_args().any(|a| a == "-Zbuild-std=core"));
        assert!(build.get_args().any(|a| a == TARGET));
        let linker = OsStr::new("CARGO_TARGET_THUMBV7EM_NONE_EABIHF_LINKER");
        assert!(build.get_envs().any(|e| e == (linker, Some(OsStr::new("/tools/rust-lld")))));
        assert!(!Toolchain::Rustup.build().get_args().any(|a| a == "-Zbuild-std=core"));
    }
}

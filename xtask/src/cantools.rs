//! Makes sure of Python's cantools, the independent reader of `docs/excavator.dbc`, in an environment of its own under `target`.

use crate::packages;
use crate::process::{Outcome, announce, capture, command, run};

/// Where the environment stands; the test that needs it looks here.
const FOLDER: &str = "target/cantools";
const PYTHON: &str = "target/cantools/bin/python3";
/// The version tried.
const PACKAGE: &str = "cantools==45.1.0";

/// Finds cantools or installs it, and says which version it is.
pub(crate) fn ensure() -> Outcome<()> {
    announce("cantools");
    let version = version().or_else(|_missing| {
        install().and_then(|()| version()).map_err(|why| {
            format!("cantools is missing ({why}); it needs Python 3 with venv (Debian: python3-venv) and pip's package index")
        })
    })?;
    eprintln!("cantools {}", version.trim());
    Ok(())
}

fn version() -> Outcome<String> {
    capture(command(PYTHON).args(["-c", "import cantools; print(cantools.__version__)"]))
}

fn install() -> Outcome<()> {
    environment().or_else(|_without_venv| {
        packages::install_debian(&["python3", "python3-venv"])?;
        environment()
    })?;
    run(command(PYTHON).args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", PACKAGE]))
}

fn environment() -> Outcome<()> {
    run(command("python3").args(["-m", "venv", "--clear", FOLDER]))
}

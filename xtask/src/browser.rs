//! Makes sure of Chromium, in which the tests look at a report's page.

use crate::packages;
use crate::process::{Outcome, announce, capture, command};

/// What it is called; the tests try the same names.
const PROGRAMS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

/// Finds Chromium or installs it, and says which it is.
pub(crate) fn ensure() -> Outcome<()> {
    announce("browser");
    let version = version().or_else(|_missing| {
        packages::install_browser()
            .and_then(|()| version())
            .map_err(|why| format!("Chromium is missing ({why}); install the package chromium or Google Chrome"))
    })?;
    eprintln!("{}", version.trim());
    Ok(())
}

fn version() -> Outcome<String> {
    let mut found = PROGRAMS.iter().map(|program| capture(command(program).arg("--version")));
    found.find(Result::is_ok).unwrap_or_else(|| Err(format!("none of {} starts", PROGRAMS.join(", "))))
}

//! A page in headless Chromium, as it opens from a file: no network, no display.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Uses the page and leaves what it saw in the document.
const PROBE: &str = include_str!("../data/probe.js");
/// What Chromium is called.
const PROGRAMS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
/// Long enough for a loaded computer.
const PATIENCE: Duration = Duration::from_secs(240);

/// What Chromium leaves of a page.
pub struct Seen {
    /// The document at the end, as HTML.
    pub document: String,
    /// What it wrote to its console, and what it logged of itself.
    pub said: String,
}

/// Opens the page with the probe in it, in a folder of its own; virtual time, so that a loaded computer makes no difference.
///
/// # Panics
/// Without Chromium, or when it fails or does not end.
pub fn open(folder: &Path, page: &str) -> Seen {
    let _old = fs::remove_dir_all(folder);
    fs::create_dir_all(folder).expect("a folder of the test's own");
    assert!(page.contains("<style>"), "the probe's place");
    let page = page.replacen("<style>", &format!("<script>{PROBE}</script>\n<style>"), 1);
    let [file, document, said] = ["page.html", "document.html", "said.txt"].map(|file| folder.join(file));
    fs::write(&file, page).expect("the page is written");
    run(folder, &file, &document, &said);
    let read = |file: &PathBuf| String::from_utf8_lossy(&fs::read(file).expect("Chromium's output")).into_owned();
    Seen { document: read(&document), said: read(&said) }
}

fn run(folder: &Path, page: &Path, document: &Path, said: &Path) {
    let create = |file: &Path| fs::File::create(file).expect("a file for Chromium's output");
    let start = |program: &str| {
        Command::new(program)
            // The page is our own, and as root or in a container the sandbox does not start.
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run"])
            .args(["--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-quic"])
            .args(["--enable-logging=stderr", "--window-size=1400,1000", "--virtual-time-budget=20000", "--dump-dom"])
            .arg(format!("--user-data-dir={}", folder.join("profile").display()))
            .arg(format!("file://{}", page.canonicalize().expect("the page is there").display()))
            .stdin(Stdio::null())
            .stdout(create(document))
            .stderr(create(said))
            .spawn()
            .ok()
    };
    let mut child = PROGRAMS.iter().find_map(|program| start(program)).unwrap_or_else(|| {
        panic!("none of {PROGRAMS:?} starts: install Chromium (cargo xtask test does so on Debian)");
    });
    let started = Instant::now();
    loop {
        match child.try_wait().expect("a child of ours") {
            Some(status) => return assert!(status.success(), "Chromium: {status}"),
            None if started.elapsed() > PATIENCE => {
                let _gone = child.kill();
                panic!("Chromium did not end in {PATIENCE:?}");
            }
            None => std::thread::sleep(Duration::from_millis(50)),
        }
    }
}

//! The report of a run in a browser: nothing goes wrong in it, the machine moves, no figure is empty. And a broken page is found out.

use std::path::Path;
use std::sync::LazyLock;

use cross_tests::browser::{self, Seen};
use cross_tests::rig::scenario;
use hil_sim::place::Host;
use hil_sim::report;
use hil_sim::run::{Run, Summary};
use serde_json::Value;

/// The report of the dig through soil: written once, as tests run at the same time and one would read what another has
/// half written.
static SOIL: LazyLock<String> = LazyLock::new(|| page("soil-dig-zx200"));

/// The report of this scenario's run. Each test asks for one of its own.
fn page(name: &str) -> String {
    let scenario = scenario(name);
    let mut host = Host::new(&scenario.parameters).expect("accepted parameters");
    let log =
        Run::new(&scenario, 1).expect("inside the limits").complete(&mut host, |_, _| {}).expect("the host stays");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("reports").join(name);
    report::write(&scenario, &log, &Summary::of(&scenario, "host", 1, &log, None), &folder).expect("written");
    std::fs::read_to_string(folder.join("report.html")).expect("a page")
}

fn open(name: &str, page: &str) -> Seen {
    browser::open(&Path::new(env!("CARGO_TARGET_TMPDIR")).join("pages").join(name), page)
}

/// What the probe left in the document.
fn probe(seen: &Seen) -> Option<Value> {
    let (_, rest) = seen.document.split_once("<script id=\"probe\" type=\"application/json\">")?;
    serde_json::from_str(rest.split_once("</script>")?.0).ok()
}

/// Everything that is wrong with a page; empty for a sound one.
fn faults(seen: &Seen) -> Vec<String> {
    let Some(probe) = probe(seen) else { return vec!["the probe did not come to its end".to_owned()] };
    let mut faults: Vec<String> = probe["errors"].as_array().expect("a list").iter().map(ToString::to_string).collect();
    faults.extend(seen.said.lines().filter(|line| line.contains("CONSOLE")).map(str::to_owned));
    let at = |moment: &str, what: &str| probe["moments"][moment][what].clone();
    let mut expect = |holds: bool, what: &str| {
        if !holds {
            faults.push(what.to_owned());
        }
    };
    let advances = |what: &str| {
        let [start, playing, later] = ["start", "playing", "later"].map(|moment| at(moment, what));
        !start.is_null() && start != playing && playing != later
    };
    expect(at("start", "parts").as_u64() > Some(15), "the machine is drawn");
    for what in ["time", "linkage", "cursors"] {
        expect(advances(what), &format!("{what} advances while it plays"));
        expect(at("paused", what) == at("still paused", what), &format!("{what} stays while it is paused"));
        expect(at("moved", what) != at("paused", what), &format!("{what} follows the slider"));
    }
    expect(at("moved", "way").as_f64() > Some(20.0), "the tip's way is seen");
    expect(at("start", "visible") == Value::Bool(true), "the figures have a cursor");
    let figures = probe["figures"].as_array().expect("a list");
    expect(figures.len() > 4, "there are figures");
    for figure in figures {
        let title = &figure["title"];
        // A histogram has bars and no long line.
        let drawn =
            figure["points"].as_u64() > Some(50) || title.as_str().is_some_and(|title| title.contains("timing"));
        expect(drawn && figure["lines"].as_u64() > Some(0), &format!("{title} is empty"));
    }
    faults
}

fn titles(seen: &Seen) -> String {
    probe(seen).expect("a probe")["figures"].to_string()
}

#[test]
#[ignore = "needs Chromium: run cargo xtask test"]
fn a_dig_through_soil_plays_without_an_error_and_with_every_figure_drawn() {
    let seen = open("soil", &SOIL);
    assert_eq!(faults(&seen), [""; 0]);
    let moments = &probe(&seen).expect("a probe")["moments"];
    assert_ne!(moments["start"]["soil"], moments["moved"]["soil"], "the ground is cut");
    for title in ["Tracking error", "Pressures", "Flows", "Coil currents", "Cylinder lengths"] {
        assert!(titles(&seen).contains(title), "{title}");
    }
}

#[test]
#[ignore = "needs Chromium: run cargo xtask test"]
fn a_run_before_a_fence_plays_from_the_side_and_from_above() {
    let page = page("fence-zx200");
    assert!(page.len() < 2_000_000, "{} bytes", page.len());
    let seen = open("fence", &page);
    assert_eq!(faults(&seen), [""; 0]);
    assert!(seen.document.contains("class=\"above\"") && titles(&seen).contains("Before the fence"));
}

#[test]
#[ignore = "needs Chromium: run cargo xtask test"]
fn a_page_that_is_broken_is_found_out() {
    let sound = &*SOIL;
    // What is changed, into what, and what is to be said of it.
    let broken = [
        ("throws", "const slider = ", "nowhere(); const slider = ", "nowhere is not defined"),
        ("does not parse", "const slider = ", "const const = ", "Unexpected token"),
        ("complains", "const slider = ", "console.error('ouch'); const slider = ", "ouch"),
        ("stands still", "if (!playing) return;", "return;", "linkage advances while it plays"),
        (
            "never stops",
            "button.addEventListener(\"click\", () => play(!playing))",
            "button.addEventListener(\"click\", () => play(true))",
            "time stays",
        ),
        ("ignores its slider", "draw(Number(slider.value));", "", "follows the slider"),
        ("loads from outside", "const slider = ", "fetch('https://example.org/'); const slider = ", "connect-src"),
        ("has empty figures", "<polyline ", "<desc ", "is empty"),
    ];
    for (name, from, to, said) in broken {
        assert!(sound.contains(from), "`{from}` is in the page");
        let found = faults(&open(&name.replace(' ', "-"), &sound.replace(from, to))).join("\n");
        assert!(found.contains(said), "a page that {name}: {found}");
    }
}

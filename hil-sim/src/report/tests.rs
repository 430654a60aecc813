//! Reports of real runs and digs, as a reader's browser gets them.

use std::fs;
use std::path::Path;

use super::{draw_only, write};
use crate::place::{Host, Timing};
use crate::run::{Log, Run, Summary};
use crate::scenario::Scenario;

fn scenario(name: &str, changes: &[(&str, &str)], more: &str) -> Scenario {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios").join(name);
    let mut text = fs::read_to_string(&file).expect("the scenario is there");
    for (from, to) in changes {
        assert!(text.contains(from), "`{from}` is in {name}");
        text = text.replace(from, to);
    }
    Scenario::from_toml(&(text + more), &file).expect("the scenario is valid")
}

fn run(scenario: &Scenario) -> Log {
    let mut host = Host::new(&scenario.parameters).expect("valid parameters");
    Run::new(scenario, 1).expect("inside the limits").complete(&mut host, |_, _| {}).expect("the host stays")
}

/// The folder's report.
fn report(scenario: &Scenario, log: &Log, folder: &Path) -> String {
    write(scenario, log, &Summary::of(scenario, "host", 1, log, None), folder).expect("written");
    fs::read_to_string(folder.join("report.html")).expect("a page")
}

/// The dig drawn only, and what it violates.
fn drawn(scenario: &Scenario, folder: &Path) -> std::io::Result<Vec<crate::travel::Violation>> {
    draw_only(scenario, scenario.parameters.dig.as_ref().expect("a dig"), folder)
}

/// Every figure of a page, each with its heading.
fn figures(page: &str) -> Vec<(&str, &str)> {
    let headings = page.split("<h2>").skip(1);
    headings
        .filter(|part| part.contains("<figure>"))
        .map(|part| {
            let (heading, rest) = part.split_once("</h2>").expect("a heading ends");
            let from = rest.find("<svg").expect("a figure");
            (heading, &rest[from..rest.find("</svg>").expect("the figure ends")])
        })
        .collect()
}

/// The points of every line of a figure.
fn lines(svg: &str) -> Vec<Vec<(i32, i32)>> {
    let points = |list: &str| {
        let pairs = list.split_whitespace().map(|pair| pair.split_once(',').expect("x,y"));
        pairs.map(|(x, y)| (x.parse().expect("a number"), y.parse().expect("a number"))).collect()
    };
    svg.split("points=\"").skip(1).map(|rest| points(rest.split('"').next().expect("quoted"))).collect()
}

fn assert_sound(heading: &str, svg: &str) {
    let view = svg.split("viewBox=\"0 0 ").nth(1).and_then(|rest| rest.split('"').next()).expect("a view box");
    let (wide, high) = view.split_once(' ').expect("width and height");
    let (wide, high): (i32, i32) = (wide.parse().expect("a width"), high.parse().expect("a height"));
    let lines = lines(svg);
    assert!(lines.iter().any(|line| line.len() > 50) || svg.matches("<rect").count() > 10, "{heading}: data is drawn");
    for point in lines.iter().flatten() {
        // What is not finite would end at 0 or far outside.
        assert!(point.0 > 0 && point.0 <= wide && point.1 > 0 && point.1 <= high, "{heading}: {point:?} in {view}");
    }
    assert!(lines.iter().all(|line| line.len() > 1), "{heading}: no line without length");
}

fn assert_loads_nothing(page: &str) {
    let without_namespace = page.replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    for outside in ["http:", "https:", "src=", "href=", "url(", "@import", "fetch(", "import(", "<link"] {
        assert!(!without_namespace.contains(outside), "the page has `{outside}`");
    }
}

#[test]
fn a_run_has_every_figure_drawn_inside_its_frame_and_the_page_loads_nothing() {
    let scenario = scenario("dig.toml", &[("duration_s = 22.0", "duration_s = 6.0")], "");
    let folder = tempfile::tempdir().expect("a folder");
    let page = report(&scenario, &run(&scenario), folder.path());
    let figures = figures(&page);
    let headings: Vec<_> = figures.iter().map(|figure| figure.0).collect();
    assert_eq!(
        headings,
        ["1. Tracking error", "2. Coil currents", "3. Cylinder lengths", "4. Joint trajectories", "5. Tick timing"]
    );
    figures.iter().for_each(|(heading, svg)| assert_sound(heading, svg));
    assert_loads_nothing(&page);
    assert!(page.contains("no board has been flashed") && page.contains("noisy"));
    assert!(!page.contains("role=\"alert\""), "nothing went wrong");
    assert!(page.len() < 2_000_000, "{} bytes", page.len());
    let linkage = fs::read_to_string(folder.path().join("linkage.svg")).expect("the first figure alone");
    assert!(page.contains(&linkage) && linkage.len() < 200_000);
}

#[test]
fn pressures_and_flows_are_drawn_of_a_hydraulic_machine_and_no_error_where_no_path_is_followed() {
    let scenario = scenario("levers-zx200-hydraulic.toml", &[("duration_s = 10.0", "duration_s = 9.0")], "");
    let folder = tempfile::tempdir().expect("a folder");
    let page = report(&scenario, &run(&scenario), folder.path());
    let figures = figures(&page);
    let headings: Vec<_> = figures.iter().map(|figure| figure.0).collect();
    assert_eq!(
        headings,
        [
            "1. Pressures",
            "2. Flows",
            "3. Coil currents",
            "4. Cylinder lengths",
            "5. Joint trajectories",
            "6. Tick timing"
        ]
    );
    figures.iter().for_each(|(heading, svg)| assert_sound(heading, svg));
    // Swing, boom, arm and bucket each have a panel of pressures, and a cursor in it.
    assert_eq!(figures[0].1.matches("class=\"cursor\"").count(), 4);
    assert_loads_nothing(&page);
}

#[test]
fn a_fault_stands_above_the_figures_and_in_them() {
    let event = "\n[[event]]\nkind = \"arm_sensor_open\"\nat_s = 2.0\nuntil_s = 2.5\n";
    let changes = [
        ("duration_s = 22.0", "duration_s = 3.0"),
        ("\"Frankel 2003's dig, inside the travel limits\"", "'a<b> & \"c\"'"),
    ];
    let scenario = scenario("dig.toml", &changes, event);
    let folder = tempfile::tempdir().expect("a folder");
    let page = report(&scenario, &run(&scenario), folder.path());
    assert!(page.contains("<li>arm_sensor_out_of_range (code 6) at 2.000 s</li>"));
    assert!(page.contains("a&lt;b&gt; &amp; &quot;c&quot;") && !page.contains("<b> &"));
    let figures = figures(&page);
    assert!(figures[1].1.contains("arm_sensor_out_of_range"), "the fault is named in the coil currents");
    figures.iter().for_each(|(heading, svg)| assert_sound(heading, svg));
}

#[test]
fn the_emulators_timing_is_drawn_with_its_jitter_across_a_wrap_of_the_clock() {
    let scenario = scenario("dig.toml", &[("duration_s = 22.0", "duration_s = 1.0")], "");
    let mut log = run(&scenario);
    for (i, timing) in log.timing.iter_mut().enumerate() {
        let i = i as u32;
        let started_ns = (u32::MAX - 500_000_000).wrapping_add(i * 1_000_000 + 8 * (i % 3));
        *timing = Timing::Emulator { started_ns, instructions: 1200 + 7 * (i % 90) };
    }
    let folder = tempfile::tempdir().expect("a folder");
    let page = report(&scenario, &log, folder.path());
    assert!(page.contains("the longest 1823. The starts of ticks vary by 24 ns."));
    let figures = figures(&page);
    assert_sound(figures[4].0, figures[4].1);
    for title in
        ["Instructions of a tick", "Distance from the tick before", "How many ticks take how many instructions"]
    {
        assert!(figures[4].1.contains(title), "{title}");
    }
}

#[test]
fn the_log_has_a_row_a_tick_and_a_reference_of_the_tip_only_while_digging() {
    let scenario = scenario("dig.toml", &[("duration_s = 22.0", "duration_s = 2.0")], "");
    let log = run(&scenario);
    let folder = tempfile::tempdir().expect("a folder");
    report(&scenario, &log, folder.path());
    let mut reader = csv::Reader::from_path(folder.path().join("log.csv")).expect("a log");
    let header = reader.headers().expect("a header").clone();
    let column = |name: &str| header.iter().position(|h| h == name).unwrap_or_else(|| panic!("a column `{name}`"));
    let (time, boom, wanted) = (column("time_s"), column("boom_true_m"), column("tip_x_reference_m"));
    let (current, wall, state) = (column("arm_retract_a"), column("host_wall_ns"), column("state"));
    let rows: Vec<csv::StringRecord> = reader.records().map(|row| row.expect("as wide as the header")).collect();
    assert_eq!(rows.len(), 2000);
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    for (row, logged) in rows.iter().zip(&log.rows) {
        assert!((number(&row[time]) - logged.time_s).abs() < 1e-9);
        assert!((number(&row[boom]) - logged.lengths.boom).abs() < 1e-9);
        assert_eq!(row[current].parse::<f32>(), Ok(logged.outputs.currents[2][1]));
        assert_eq!(row[wanted].is_empty(), logged.outputs.dig_tick <= 1);
        assert!(number(&row[wall]) >= 0.0 && !row[state].is_empty());
    }
    assert!(rows.iter().any(|row| !row[wanted].is_empty()));
}

#[test]
fn the_published_dig_is_drawn_with_both_violations_of_its_arm() {
    let scenario = scenario("dig-published.toml", &[], "");
    let folder = tempfile::tempdir().expect("a folder");
    let found = drawn(&scenario, folder.path()).expect("drawn");
    let said: Vec<_> = found.iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        ["arm: 0.000…0.248 s, worst +19.1 mm at 0.000 s", "arm: 19.388…20.000 s, worst +16.4 mm at 20.000 s"]
    );
    let page = fs::read_to_string(folder.path().join("report.html")).expect("a page");
    assert_loads_nothing(&page);
    assert!(!page.contains("<script"), "nothing moves");
    assert!(page.contains("<td>arm</td><td>0.000</td><td>0.248</td><td>0.000</td><td>+19.1</td>"));
    assert!(page.contains("<td>arm</td><td>19.388</td><td>20.000</td><td>20.000</td><td>+16.4</td>"));
    let figures = figures(&page);
    assert_eq!(figures.len(), 2);
    figures.iter().for_each(|(heading, svg)| assert_sound(heading, svg));
    assert!(figures[1].1.contains("+19.1 mm") && figures[1].1.contains("+16.4 mm"));
    let rows = fs::read_to_string(folder.path().join("dig.csv")).expect("the dig").lines().count();
    assert_eq!(rows, 1 + 20_001);
}

#[test]
fn a_dig_out_of_reach_is_drawn_with_a_gap() {
    let scenario = scenario("dig-published.toml", &[("reach_m = 2.286", "reach_m = 2.9")], "");
    let folder = tempfile::tempdir().expect("a folder");
    let found = drawn(&scenario, folder.path()).expect("drawn");
    let reach = found.iter().find(|v| v.cylinder == "reach").expect("a violation of the reach");
    let page = fs::read_to_string(folder.path().join("report.html")).expect("a page");
    let figures = figures(&page);
    figures.iter().for_each(|(heading, svg)| assert_sound(heading, svg));
    // Every cylinder's line has two pieces.
    assert_eq!(lines(figures[1].1).iter().filter(|line| line.len() > 50).count(), 6);
    let mut reader = csv::Reader::from_path(folder.path().join("dig.csv")).expect("the dig");
    let empty = reader.records().map(|row| row.expect("a row")).filter(|row| row[4].is_empty()).count();
    assert_eq!(empty, ((reach.until_s - reach.from_s) * 1e3 + 1.5) as usize);
}

#[test]
fn a_dig_out_of_reach_from_beginning_to_end_is_drawn_all_the_same() {
    let changes = [("start_x_m = 0.762", "start_x_m = 9.0"), ("reach_m = 2.286", "reach_m = 20.0")];
    let folder = tempfile::tempdir().expect("a folder");
    let found = drawn(&scenario("dig-published.toml", &changes, ""), folder.path()).expect("drawn");
    assert_eq!((found.len(), found[0].cylinder), (1, "reach"));
    let page = fs::read_to_string(folder.path().join("report.html")).expect("a page");
    assert_eq!(figures(&page).len(), 2);
}

//! `docs/supervisor.svg` and `docs/faults.md` are what the firmware's tables say.

use cross_tests::rig::workspace;
use firmware::supervisor::machine::{Facts, transitions};
use firmware::{Fault, State};
use hil_sim::supervisor_page::{drawing, files, page};

#[test]
fn the_drawing_and_the_page_of_faults_are_up_to_date() {
    for (name, text) in files() {
        let found = std::fs::read_to_string(workspace().join(name)).unwrap_or_default();
        assert!(found == text, "{name} is out of date: run cargo hil supervisor");
    }
}

#[test]
fn every_fault_stands_on_the_page_by_name_and_number() {
    let page = page();
    for fault in Fault::ALL {
        let rows: Vec<&str> = page.lines().filter(|line| line.contains(&format!("`{}`", fault.name()))).collect();
        let row = rows.last().unwrap_or_else(|| panic!("{} is missing", fault.name()));
        assert!(row.contains(&fault.trouble_code().spn.to_string()), "{row}");
        assert_eq!(row.contains("| restart |"), fault.needs_restart(), "{row}");
    }
}

#[test]
fn every_state_and_every_fact_of_the_table_is_drawn() {
    let drawing = drawing();
    for state in State::ALL {
        assert!(drawing.contains(&format!(">{}</text>", state.name().replace('_', " "))), "{state:?}");
        for arrow in transitions(state) {
            for (fact, name) in Facts::NAMED {
                assert!(!arrow.all.has(fact) || drawing.contains(name), "{name}");
            }
        }
    }
}

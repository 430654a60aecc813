//! The machine files hold the numbers of their sources, entered here a second time by hand.

use cross_tests::machines;
use hil_sim::machine_file::MachineFile;

#[test]
fn every_machine_file_holds_the_pins_of_its_source() {
    let mut seen = 0;
    for (name, pins) in machines::all().unwrap() {
        let file = MachineFile::load(name).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(file.geometry, pins, "{name}");
        seen += 1;
    }
    assert_eq!(seen, 4);
}

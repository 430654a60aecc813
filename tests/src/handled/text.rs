//! Machine files and scenario files.

use std::sync::LazyLock;

use hil_sim::machine_file::MachineFile;
use hil_sim::place::Host;
use hil_sim::planar_arm::{self, PlanarArm};
use hil_sim::run::{Run, RunError};
use hil_sim::scenario::Scenario;
use kinematics_core::{Cylinders, Machine, Rotor};

use super::record::accepted;

/// What is run of an accepted scenario, s.
const RUN_S: f64 = 0.03;

/// A refusal names the field, or quotes the line that is no TOML.
fn names(error: &str) {
    assert!(error.contains('`') || error.contains("line "), "names nothing: {error}");
}

/// A machine file: what is accepted has a pose in mid-stroke.
pub fn machine_file(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let file = match MachineFile::from_toml(text, "machine.toml") {
        Err(error) => return names(&error.to_string()),
        Ok(file) => file,
    };
    let g = &file.geometry;
    assert_eq!(MachineFile::from_toml(text, "machine.toml").ok().as_ref(), Some(&file), "no NaN, no chance in it");
    let machine = Machine::<f64>::new(g).unwrap_or_else(|error| panic!("{error}"));
    let [boom, arm, bucket] = [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| 0.5 * (s.min_m + s.max_m));
    let pose = machine.cylinders_to_tip(&Cylinders { boom, arm, bucket }, Rotor::IDENTITY);
    let pose = pose.unwrap_or_else(|error| panic!("{error} in mid-stroke of {text}"));
    assert!([pose.x, pose.y, pose.plane.reach, pose.plane.height].into_iter().all(f64::is_finite), "{text}");
}

/// A scenario file on a machine of its own, whatever machine it names: what is accepted runs, or the controller refuses it by name.
pub fn scenario_file(bytes: &[u8]) {
    static MACHINES: LazyLock<[MachineFile; 2]> = LazyLock::new(|| {
        ["zx200", "frankel"].map(|name| MachineFile::load(name).unwrap_or_else(|error| panic!("{error}")))
    });
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if planar_arm::is_planar_arm(text) {
        return match PlanarArm::from_toml(text) {
            Ok(arm) => assert!(arm.start_rad.into_iter().all(f64::is_finite)),
            Err(error) => names(&error),
        };
    }
    for machine in MACHINES.iter() {
        match Scenario::of_text(text, machine.clone(), None) {
            Err(error) => names(&error),
            Ok(scenario) => runs(scenario),
        }
    }
}

fn runs(mut scenario: Scenario) {
    if let Err(error) = scenario.parameters.validate() {
        return names(&error.to_string());
    }
    accepted(&scenario.parameters);
    let Ok(mut host) = Host::new(&scenario.parameters) else { return };
    scenario.duration_s = RUN_S;
    let log = match Run::new(&scenario, 1) {
        Err(RunError::Refused(violations)) => return assert!(!violations.is_empty()),
        Err(error) => return assert!(!error.to_string().is_empty()),
        Ok(run) => run.complete(&mut host, |_, _| {}).expect("this process"),
    };
    for row in &log.rows {
        let numbers =
            [row.lengths.boom, row.lengths.arm, row.lengths.bucket].into_iter().chain(row.tip.into_iter().flatten());
        assert!(numbers.into_iter().all(f64::is_finite), "{row:?}");
        super::sound(&row.outputs);
    }
}

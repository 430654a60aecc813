//! The score's tasks on drawn hydraulic plants, those that are tuned on: all are done, and grading is as exact as is wanted.

use hil_sim::machine_file::MachineFile;
use hil_sim::score::{LAW, Plants, Report, Setting, Task, score};
use hil_sim::shard::Shard;

fn scored(law: &str, seeds: u32) -> Report {
    let machine = MachineFile::load("zx200").expect("zx200");
    let setting = Setting { seeds, plants: Plants::Tuning, law: law.to_owned(), alone: true };
    score(&machine, &setting, Shard::WHOLE, || ()).expect("a score")
}

#[test]
fn every_task_is_done_and_grading_stays_within_ten_millimetres_rms_and_thirty() {
    for row in scored(LAW, 4).tasks {
        println!(
            "{} at {} m/s: {:.1} mm RMS, {:.1} mm max",
            row.name,
            row.speed_mps,
            row.rmse_m * 1e3,
            row.max_m * 1e3
        );
        assert_eq!((row.completed, row.still_at_rest), (4, 4), "{row:?}");
        if Task::ALL.into_iter().any(|task| task.is_grading() && task.name() == row.name) {
            assert!(row.rmse_m <= 0.010 && row.max_m <= 0.030, "{row:?}");
        }
    }
}

#[test]
fn a_fault_is_told_with_its_name_and_time() {
    // With a gain this high the boom rings on its oil until the diagnosis stops it.
    let law =
        LAW.replace("gain_per_s = 3.0", "gain_per_s = 20.0").replace("feedback_lag_s = 0.2", "feedback_lag_s = 0.0");
    let report = scored(&law, 1);
    let stopped = report.tasks.iter().flat_map(|row| &row.by_plant).filter(|on| on.fault.is_some());
    let stopped: Vec<_> = stopped.collect();
    assert!(!stopped.is_empty());
    for on in stopped {
        println!("plant {}: {} at {:.2} s", on.plant, on.fault.unwrap_or_default(), on.fault_at_s.unwrap_or_default());
        assert!(on.fault_at_s.is_some_and(|at_s| at_s > 0.5) && !on.completed());
    }
}

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
fn a_run_that_does_not_come_to_its_paths_end_counts_as_not_done_and_says_how_much_is_missing() {
    // Without preview, and with a gain and a learning this high, the machine rings.
    let law = [
        ("preview_s = 0.15", "preview_s = 0.0"),
        ("gain_per_s = 3.0", "gain_per_s = 20.0"),
        ("feedback_lag_s = 0.2", "feedback_lag_s = 0.0"),
        ("correction_limit_mps = 0.1", "correction_limit_mps = 1.0"),
        ("integral_per_s2 = 2.0", "integral_per_s2 = 20.0"),
        ("bias_limit_mps = 0.01", "bias_limit_mps = 0.09"),
    ]
    .into_iter()
    .fold(LAW.to_owned(), |law, (good, bad)| {
        assert!(law.contains(good), "{good}");
        law.replace(good, bad)
    });
    let tasks = scored(&law, 1).tasks;
    assert!(tasks.iter().filter(|row| row.completed == 0).count() >= 3);
    for row in tasks {
        let [on] = &row.by_plant[..] else { panic!("{row:?}") };
        assert_eq!(row.completed == 1, on.completed());
        assert!(on.completed() || on.fault.is_some() || on.to_end_m > 0.05, "{row:?}");
    }
}

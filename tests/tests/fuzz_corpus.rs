//! What the fuzz targets are given is handled here too, on the stable compiler: their seeds, every file of the corpus under `fuzz/corpus`, and
//! thousands of changes of them.

use std::path::PathBuf;

use cross_tests::handled::mutation::Mutator;
use cross_tests::handled::seeds::seeds;
use cross_tests::handled::{TARGETS, Target};
use cross_tests::rig::workspace;

fn corpus(target: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = workspace().join("fuzz/corpus").join(target);
    let files = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> = files.map(|file| file.expect("a readable folder").path()).collect();
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), std::fs::read(path).expect("a readable file"))).collect()
}

/// Handles bytes; a breach names the bytes, so that they can become a file of the corpus.
fn handled((name, handle): Target, bytes: &[u8], what: &str) {
    let result = std::panic::catch_unwind(|| handle(bytes));
    if result.is_err() {
        let kept = std::env::temp_dir().join(format!("breach-of-{name}"));
        std::fs::write(&kept, bytes).expect("a place for the breach");
        panic!("{name}: {what}: the bytes are in {}", kept.display());
    }
}

/// The seeds and the corpus as they are, and `count` changes of them.
fn target_handles_its_corpus_and_changes_of_it(name: &str, count: usize) {
    let target = TARGETS.into_iter().find(|(target, _)| *target == name).expect("a target");
    let (mut all, files) = (seeds(name), corpus(name));
    assert!(!all.is_empty() && !files.is_empty());
    for (number, seed) in all.iter().enumerate() {
        handled(target, seed, &format!("seed {number}"));
    }
    for (path, bytes) in files {
        handled(target, &bytes, &path.display().to_string());
        all.push(bytes);
    }
    let mut mutator = Mutator::new(7);
    for number in 0..count {
        let [one, other] = [mutator.below(all.len()), mutator.below(all.len())];
        handled(target, &mutator.changed(&all[one], &all[other]), &format!("change {number}"));
    }
}

#[test]
fn can_frames_never_panic_and_leave_no_nan() {
    target_handles_its_corpus_and_changes_of_it("can_frames", 3_000);
}

#[test]
fn parameter_records_are_refused_by_name_or_run_without_a_nan() {
    target_handles_its_corpus_and_changes_of_it("parameter_record", 20_000);
}

#[test]
fn machine_files_are_refused_by_name_or_give_a_pose() {
    target_handles_its_corpus_and_changes_of_it("machine_file", 10_000);
}

#[test]
fn scenario_files_are_refused_by_name_or_run_without_a_nan() {
    target_handles_its_corpus_and_changes_of_it("scenario_file", 10_000);
}

#[test]
fn both_ends_of_the_emulator_link_take_any_bytes() {
    target_handles_its_corpus_and_changes_of_it("exchange", 20_000);
}

#[test]
fn every_target_has_its_file_its_corpus_and_its_function() {
    let fuzz = workspace().join("fuzz");
    let names = |folder: &str| {
        let files = std::fs::read_dir(fuzz.join(folder)).unwrap_or_else(|error| panic!("{folder}: {error}"));
        let stem = |path: PathBuf| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let mut names: Vec<String> = files.filter_map(|file| stem(file.expect("a readable folder").path())).collect();
        names.sort();
        names
    };
    let mut targets: Vec<String> = TARGETS.iter().map(|(name, _)| (*name).to_owned()).collect();
    targets.sort();
    assert_eq!(names("fuzz_targets"), targets);
    assert_eq!(names("corpus"), targets);
    for name in targets {
        let text = std::fs::read_to_string(fuzz.join("fuzz_targets").join(&name).with_extension("rs")).expect("a file");
        assert!(text.contains(&format!("handled::{name}(bytes)")), "{name}: {text}");
        let manifest = std::fs::read_to_string(fuzz.join("Cargo.toml")).expect("a manifest");
        assert!(manifest.contains(&format!("name = \"{name}\"")), "{name}");
    }
}

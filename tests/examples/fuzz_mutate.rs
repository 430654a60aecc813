//! Changes of the seeds and the corpus for as long as wanted, where there is no cargo-fuzz:
//! `cargo run --profile test -p cross-tests --example fuzz_mutate -- TARGET COUNT SEED`. What breaks is written to `fuzz/artifacts/TARGET`.

use std::panic::catch_unwind;
use std::process::ExitCode;

use cross_tests::handled::TARGETS;
use cross_tests::handled::mutation::Mutator;
use cross_tests::handled::seeds::seeds;
use cross_tests::rig::workspace;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [name, count, seed] = &arguments[..] else { return usage() };
    let (Ok(count), Ok(seed)) = (count.parse::<u64>(), seed.parse()) else { return usage() };
    let Some((name, handle)) = TARGETS.into_iter().find(|(target, _)| target == name) else { return usage() };
    let mut all = seeds(name);
    let files = std::fs::read_dir(workspace().join("fuzz/corpus").join(name)).expect("a corpus");
    all.extend(files.map(|file| std::fs::read(file.expect("a file").path()).expect("a readable file")));
    let mut mutator = Mutator::new(seed);
    let mut breaches = 0;
    for number in 0..count {
        let [one, other] = [mutator.below(all.len()), mutator.below(all.len())];
        let bytes = mutator.changed(&all[one], &all[other]);
        if catch_unwind(|| handle(&bytes)).is_err() {
            let folder = workspace().join("fuzz/artifacts").join(name);
            std::fs::create_dir_all(&folder).expect("a place for breaches");
            std::fs::write(folder.join(format!("{seed}-{number}")), bytes).expect("a place for the breach");
            breaches += 1;
        }
        if number % 10_000 == 0 {
            eprintln!("{name}: {number} of {count}, {breaches} breaches");
        }
    }
    println!("{name}: {count} changes, {breaches} breaches");
    ExitCode::from(u8::from(breaches > 0))
}

fn usage() -> ExitCode {
    let names: Vec<&str> = TARGETS.iter().map(|(name, _)| *name).collect();
    eprintln!("TARGET COUNT SEED; the targets: {}", names.join(", "));
    ExitCode::from(2)
}

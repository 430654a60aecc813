//! Writes what fuzzing begins with to `fuzz/seeds`, a folder a target: `cargo run -p cross-tests --example fuzz_seeds`.

use cross_tests::handled::TARGETS;
use cross_tests::handled::seeds::seeds;
use cross_tests::rig::workspace;

fn main() -> std::io::Result<()> {
    for (name, _) in TARGETS {
        let folder = workspace().join("fuzz/seeds").join(name);
        std::fs::create_dir_all(&folder)?;
        for (number, seed) in seeds(name).iter().enumerate() {
            std::fs::write(folder.join(number.to_string()), seed)?;
        }
        println!("{}", folder.display());
    }
    Ok(())
}

//! `hil params`, as a user runs it.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

/// Runs `hil params` in the workspace's root.
fn params(args: &[&str]) -> Output {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    Command::new(env!("CARGO_BIN_EXE_hil")).arg("params").args(args).current_dir(root).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// A folder with files, by path.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    fn path(&self, name: &str) -> String {
        self.0.path().join(name).display().to_string()
    }

    fn make(&self, source: &str, name: &str, more: &[&str]) -> Output {
        params(&[&["make", source, "-o", &self.path(name)], more].concat())
    }

    fn json(&self, name: &str) -> Value {
        let shown = params(&["show", &self.path(name), "--json", "-"]);
        assert!(shown.status.success(), "{}", text(&shown.stderr));
        serde_json::from_slice(&shown.stdout).unwrap()
    }
}

fn refused(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stdout));
    text(&output.stderr)
}

const DITCH: &str = "[[bucket]]\nname = \"ditch\"\nbucket_m = 0.45\ncoupler_pin_x_m = -0.0191\n\
                     coupler_pin_z_m = 0.1384\ncoupler_m = 0.2413\n";

#[test]
fn a_record_is_made_shown_approved_and_compared() {
    let folder = Folder::new();
    let made = folder.make("scenarios/dig.toml", "a.bin", &[]);
    assert!(made.status.success(), "{}", text(&made.stderr));
    let json = folder.json("a.bin");
    assert_eq!(json["approved"], false);
    assert_eq!(json["record"]["machine"], "frankel");
    assert_eq!(json["record"]["parameters"]["supply"]["full_scale_v"], 40.0);
    assert_eq!(json["record"]["buckets"][0]["name"], "standard");
    assert_eq!(json["record"]["buckets"][0]["bucket_m"], json["record"]["parameters"]["geometry"]["bucket_m"]);

    fs::copy(folder.path("a.bin"), folder.path("b.bin")).unwrap();
    let same = params(&["compare", &folder.path("a.bin"), &folder.path("b.bin")]);
    assert_eq!((same.status.code(), text(&same.stdout).as_str()), (Some(0), "the records are the same\n"));
    assert!(params(&["approve", &folder.path("b.bin")]).status.success());
    assert_eq!(folder.json("b.bin")["approved"], true);
    let differ = params(&["compare", &folder.path("a.bin"), &folder.path("b.bin")]);
    assert_eq!(differ.status.code(), Some(1));
    let lines = text(&differ.stdout);
    assert!(lines.lines().count() == 1 && lines.contains("approved") && lines.contains("false → true"), "{lines}");
}

#[test]
fn the_file_holds_what_the_controller_loads() {
    let folder = Folder::new();
    folder.make("scenarios/dig-exact-mini.toml", "a.bin", &[]);
    params(&["approve", &folder.path("a.bin")]);
    let decoded = firmware::store::copy::decode(&fs::read(folder.path("a.bin")).unwrap()).unwrap();
    assert!(decoded.approved);
    assert_eq!(decoded.record.machine.text(), Some("exact-mini"));
    firmware::Ecu::new(&decoded.record.parameters_for(0).unwrap()).unwrap();
}

#[test]
fn more_buckets_come_from_a_file() {
    let folder = Folder::new();
    fs::write(folder.path("buckets.toml"), DITCH).unwrap();
    let made = folder.make("scenarios/levers-zx200.toml", "a.bin", &[]);
    assert!(made.status.success(), "{}", text(&made.stderr));
    let made = folder.make("scenarios/dig.toml", "b.bin", &["--buckets", &folder.path("buckets.toml")]);
    assert!(made.status.success(), "{}", text(&made.stderr));
    assert_eq!(folder.json("b.bin")["record"]["buckets"][1]["bucket_m"], 0.45);
    let differ = params(&["compare", &folder.path("a.bin"), &folder.path("b.bin")]);
    let lines = text(&differ.stdout);
    assert!(lines.lines().any(|line| line.contains("buckets[1].name") && line.contains("none → \"ditch\"")), "{lines}");
}

#[test]
fn a_bad_bucket_is_refused_by_field() {
    let folder = Folder::new();
    let buckets = folder.path("buckets.toml");
    for (wrong, expected) in [
        (DITCH.replace("name = \"ditch\"", "name = \"\""), "`bucket[0].name` is \"\" but must be 1 to 16"),
        (DITCH.replace("bucket_m = 0.45", "bucket_m = -1.0"), "with `buckets[1]`: `links.bucket_m`"),
        (DITCH.replace("bucket_m = 0.45", "bucket_m = 0.01"), "with `buckets[1]`: `dig`"),
        (DITCH.replace("coupler_m", "coupling_m"), "coupling_m"),
        (DITCH.repeat(8), "8 tables but at most 7"),
    ] {
        fs::write(&buckets, wrong).unwrap();
        let error = refused(&folder.make("scenarios/dig.toml", "a.bin", &["--buckets", &buckets]));
        assert!(error.contains(expected) && error.contains("buckets.toml"), "{expected}: {error}");
        assert!(!Path::new(&folder.path("a.bin")).exists(), "nothing is written");
    }
}

#[test]
fn a_machine_with_several_scenarios_or_none_asks_for_one() {
    let folder = Folder::new();
    let several = refused(&folder.make("frankel", "a.bin", &[]));
    assert!(several.contains("dig.toml") && several.contains("dig-published.toml"), "{several}");
    let none = refused(&folder.make("zx120", "a.bin", &[]));
    assert!(none.contains("no scenario uses the machine `zx120`"), "{none}");
    let unknown = refused(&folder.make("no-such-thing", "a.bin", &[]));
    assert!(unknown.contains("neither a scenario's file nor a machine"), "{unknown}");
}

#[test]
fn spoilt_files_are_refused_with_what_is_wrong() {
    let folder = Folder::new();
    folder.make("scenarios/dig.toml", "a.bin", &[]);
    let good = fs::read(folder.path("a.bin")).unwrap();
    let mut flipped = good.clone();
    flipped[100] ^= 1;
    let longer = [good.clone(), vec![0]].concat();
    for (bytes, expected) in [
        (flipped, "the data do not fit their CRC"),
        (longer, "more bytes than the record has"),
        (good[..20].to_vec(), "no intact header"),
        (b"not a record, but long enough for one's header".to_vec(), "no intact header"),
    ] {
        fs::write(folder.path("b.bin"), bytes).unwrap();
        for command in ["show", "approve"] {
            let error = refused(&params(&[command, &folder.path("b.bin")]));
            assert!(error.contains(expected) && error.contains("b.bin"), "{command}: {error}");
        }
    }
    assert!(refused(&params(&["show", &folder.path("missing.bin")])).contains("cannot read"));
}

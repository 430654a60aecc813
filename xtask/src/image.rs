//! Builds the ARM images: the binaries of packages `images` and `control-tick`.

use std::path::{Path, PathBuf};

use crate::arm::{self, Toolchain};
use crate::elf;
use crate::process::{Outcome, announce, line, stream};

/// Flags meant for the host (a CPU, a linker) break an image, and link arguments given here would replace those of
/// images/build.rs; an image takes none of them.
const FLAGS: [&str; 4] =
    ["RUSTFLAGS", "CARGO_ENCODED_RUSTFLAGS", "CARGO_BUILD_RUSTFLAGS", "CARGO_TARGET_THUMBV7EM_NONE_EABIHF_RUSTFLAGS"];

/// `cargo xtask image`: one path a line on standard output.
pub(crate) fn command(names: &[String]) -> Outcome<bool> {
    for path in build(names, &arm::ensure()?)? {
        println!("{}", path.display());
    }
    Ok(true)
}

/// Builds the named images, or all, in the profile `image`; the ELFs in the order cargo finished them, each checked.
pub(crate) fn build(names: &[String], toolchain: &Toolchain) -> Outcome<Vec<PathBuf>> {
    announce("ARM images");
    let mut cargo = toolchain.build();
    cargo.args([
        "--profile=image",
        "--package=images",
        "--package=control-tick",
        "--message-format=json-render-diagnostics",
    ]);
    if names.is_empty() {
        cargo.arg("--bins");
    }
    for name in names {
        cargo.args(["--bin", name]);
    }
    for flags in FLAGS {
        if std::env::var_os(flags).is_some_and(|value| !value.is_empty()) {
            eprintln!("note: {flags} is not used for the images");
        }
        cargo.env_remove(flags);
    }
    let mut paths = Vec::new();
    if !stream(&mut cargo, &mut std::io::sink(), |message| paths.extend(executable(message)))? {
        return Err(format!("`{}` failed", line(&cargo)));
    }
    if paths.is_empty() {
        return Err("packages images and control-tick have no binaries: there is no image to build".into());
    }
    for path in &paths {
        let size = check(path)?;
        eprintln!("{}: {size} bytes of flash", path.display());
    }
    Ok(paths)
}

fn check(path: &Path) -> Outcome<u64> {
    let file = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    elf::flash_bytes(&file).map_err(|problem| format!("{}: {problem}", path.display()))
}

/// The path of a linked binary, if this line of cargo's JSON announces one. Asking cargo is right wherever the target
/// directory was moved to.
fn executable(message: &str) -> Option<PathBuf> {
    let announces = message.contains(r#""reason":"compiler-artifact""#) && message.contains(r#""kind":["bin"]"#);
    let (_, value) = message.split_once(r#""executable":""#).filter(|_| announces)?;
    let mut path = String::new();
    let mut characters = value.chars();
    loop {
        match characters.next()? {
            '"' => return Some(path.into()),
            // In a path only the backslash and the quote come escaped.
            '\\' => path.push(characters.next()?),
            character => path.push(character),
        }
    }
}

#[cfg(test)]
mod messages {
    use super::executable;
    use std::path::PathBuf;

    fn artifact(kind: &str, executable: &str) -> String {
        format!(
            r#"{{"reason":"compiler-artifact","target":{{"kind":["{kind}"],"name":"n"}},"executable":{executable}}}"#
        )
    }

    #[test]
    fn a_linked_binary_is_found() {
        let message = artifact("bin", r#""/a dir/target/thumbv7em-none-eabihf/release/n""#);
        assert_eq!(executable(&message), Some(PathBuf::from("/a dir/target/thumbv7em-none-eabihf/release/n")));
        assert_eq!(executable(&artifact("bin", r#""C:\\dir\\n""#)), Some(PathBuf::from(r"C:\dir\n")));
    }

    #[test]
    fn libraries_and_build_scripts_are_not_images() {
        assert_eq!(executable(&artifact("lib", "null")), None);
        assert_eq!(executable(&artifact("custom-build", r#""/b""#)), None);
        assert_eq!(executable(r#"{"reason":"build-finished","success":true}"#), None);
        assert_eq!(executable("Compiling"), None);
    }
}

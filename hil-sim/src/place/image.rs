//! Building an ARM image and reading its size.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use object::{Object, ObjectSection, SectionFlags, SectionKind};

/// An ARM image and what it takes of the target's memory.
#[derive(Clone, Debug)]
pub struct Image {
    /// The ELF file.
    pub path: PathBuf,
    /// Code, constants and initial values, bytes.
    pub flash_bytes: u64,
    /// Static memory without the stack, bytes.
    pub ram_bytes: u64,
}

/// Why there is no image.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The build could not be started.
    #[error("cannot start the image's build: {0}")]
    Start(std::io::Error),
    /// The build failed; it has said why on standard error.
    #[error("building the image `{0}` failed (see above)")]
    Build(String),
    /// The build's result cannot be read.
    #[error("cannot read the image {}: {why}", path.display())]
    Read {
        /// The ELF file.
        path: PathBuf,
        /// Why.
        why: String,
    },
}

impl Image {
    /// Builds an image by `cargo xtask image`, which also sees to the ARM target. Its progress goes to standard error.
    ///
    /// # Errors
    /// The build's failure.
    pub fn build(name: &str) -> Result<Self, ImageError> {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let output = Command::new(cargo)
            .args(["xtask", "image", name])
            .current_dir(workspace)
            .stderr(Stdio::inherit())
            .output()
            .map_err(ImageError::Start)?;
        let path = String::from_utf8_lossy(&output.stdout).lines().last().map(str::to_owned);
        match path {
            Some(path) if output.status.success() => Self::read(path.into()),
            _ => Err(ImageError::Build(name.to_owned())),
        }
    }

    /// Reads the sizes of an ELF file's loaded sections.
    ///
    /// # Errors
    /// A file that cannot be read or is no ELF.
    pub fn read(path: PathBuf) -> Result<Self, ImageError> {
        let unreadable = |why: String| ImageError::Read { path: path.clone(), why };
        let bytes = std::fs::read(&path).map_err(|e| unreadable(e.to_string()))?;
        let file = object::File::parse(&*bytes).map_err(|e| unreadable(e.to_string()))?;
        let (mut flash_bytes, mut ram_bytes) = (0, 0);
        for section in file.sections() {
            let SectionFlags::Elf { sh_flags, .. } = section.flags() else { continue };
            if !sh_flags.contains(object::elf::SHF_ALLOC) {
                continue;
            }
            let writable = sh_flags.contains(object::elf::SHF_WRITE);
            if writable {
                ram_bytes += section.size();
            }
            if section.kind() != SectionKind::UninitializedData {
                flash_bytes += section.size();
            }
        }
        Ok(Self { path, flash_bytes, ram_bytes })
    }
}

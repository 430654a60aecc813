//! Link arguments of the images. They stand here and not in config rustflags, which a RUSTFLAGS in the environment would
//! replace: the image would then link empty, without an error.
use std::env;
use std::path::Path;

fn main() {
    println!("cargo:rerun-if-changed=../memory.x");
    if env::var("CARGO_CFG_TARGET_OS").as_deref() != Ok("none") {
        return;
    }
    let manifest = env::var("CARGO_MANIFEST_DIR").expect("cargo sets CARGO_MANIFEST_DIR");
    let root = Path::new(&manifest).parent().expect("the package stands in the workspace");
    println!("cargo:rustc-link-search={}", root.display());
    // memory.x is found through the search path; link.x comes from cortex-m-rt.
    for argument in ["-Tlink.x", "--nmagic"] {
        println!("cargo:rustc-link-arg-bins={argument}");
    }
    // Where defmt's strings go; only these images log.
    let logging: &[&str] = if env!("CARGO_PKG_NAME") == "images" { &["ecu-stm32f405", "faults-emulated"] } else { &[] };
    for image in logging {
        println!("cargo:rustc-link-arg-bin={image}=-Tdefmt.x");
    }
}

//! Copies the memory map to the linker's search path, and checks that MBS_MODEL names the model to be compiled in.

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::write(out.join("memory.x"), include_bytes!("memory.x")).expect("OUT_DIR is writable");
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rerun-if-changed=memory.x");
    println!("cargo:rerun-if-env-changed=MBS_MODEL");
    let model = env::var("MBS_MODEL")
        .expect("MBS_MODEL names a file that `mbs export SCENE --rust FILE` wrote");
    println!("cargo:rerun-if-changed={model}");
    println!("cargo:rustc-env=MBS_MODEL={model}");
    println!("cargo:rerun-if-env-changed=MBS_LOOP");
    if let Ok(linkage) = env::var("MBS_LOOP") {
        println!("cargo:rerun-if-changed={linkage}");
        println!("cargo:rustc-env=MBS_LOOP={linkage}");
    }
}

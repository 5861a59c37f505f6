//! Checks that MBS_MODEL names the model to be compiled in.

fn main() {
    println!("cargo:rerun-if-env-changed=MBS_MODEL");
    let model = std::env::var("MBS_MODEL")
        .expect("MBS_MODEL names a file that `mbs export SCENE --rust FILE` wrote");
    println!("cargo:rerun-if-changed={model}");
    println!("cargo:rustc-env=MBS_MODEL={model}");
}

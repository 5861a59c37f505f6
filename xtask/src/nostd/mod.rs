//! `cargo xtask check-nostd`: the `no_std` crates are cross-compiled for microcontrollers, and the firmware example is run on
//! emulated ones.
//!
//! 1. Every crate and feature set of the table compiles for the first target, the ends of each crate's range for the second.
//! 2. Nothing that panics or allocates can be reached from a step, in the disassembled images.
//! 3. The images run under QEMU, within their bounds, and end where the host does.
//! 4. All features together add to the image, and what they add is gone without them.
//! 5. A program in C, linked with the static library, gives the bits of the host's run. That one links with a panic handler of
//!    its own, which a standard library that sneaks in would contradict.
//! 6. An observer sets the state of an exported arm on an emulated board, and a loop is closed there, in Rust and in C with the same bits.
//!
//! Asked for alone it is whole: with the third target, each feature of an effect in an image, the other board and more models.
//!
//! A host build cannot show that a crate works without the standard library: the library is there, and a
//! dependency that asks for it goes unnoticed. The target has none.

mod board;
mod firmware;
mod form;
mod image;
mod in_c;
mod observer;
mod panics;
mod run_report;
mod sizes;
mod table;
mod toolchain;

use crate::process;
use crate::summary::{self, Outcome};
use form::Form;
use std::process::ExitCode;
use std::thread;
use table::{Build, TARGETS};
use toolchain::Toolchain;

/// Runs the check by itself: here a toolchain that is missing is a failure.
pub fn check_nostd() -> ExitCode {
    summary::ended("check-nostd", check_with(Form::Whole))
}

/// Builds the rows of the table for their targets, and runs the firmware.
///
/// # Errors
///
/// The first build that failed, with crate, features and target.
pub(crate) fn check() -> Result<Outcome, String> {
    check_with(Form::Short)
}

fn check_with(form: Form) -> Result<Outcome, String> {
    let mut toolchains = Vec::new();
    for target in table::targets(form) {
        match toolchain::find(target) {
            Ok(toolchain) => toolchains.push((*target, toolchain)),
            Err(left_out) => return Ok(Outcome::LeftOut(left_out)),
        }
    }
    let builds = cross_compile_all(&toolchains)?;
    let used: Vec<_> = toolchains
        .iter()
        .map(|(target, toolchain)| format!("{target} by {}", toolchain.name()))
        .collect();
    let toolchain = toolchains[0].1;
    let lld = match toolchain::for_images(toolchain) {
        Ok(lld) => lld,
        Err(left_out) => return Ok(Outcome::LeftOut(left_out)),
    };
    let measured = firmware::check((toolchain, lld.as_deref()), form)?;
    Ok(Outcome::Passed(format!("{builds} builds, {}; {}", used.join(", "), measured.join("; "))))
}

/// Builds the rows of the table for their targets; how many. Each target has a thread and a folder of its own: most of the time is that of
/// a few large crates, which one core compiles.
fn cross_compile_all(toolchains: &[(&str, Toolchain)]) -> Result<usize, String> {
    let build_for = |(target, toolchain): &(&str, Toolchain)| {
        table::of(target)
            .try_fold(0, |n, build| cross_compile(toolchain, build, target).map(|()| n + 1))
    };
    thread::scope(|scope| {
        let all: Vec<_> = toolchains.iter().map(|one| scope.spawn(|| build_for(one))).collect();
        all.into_iter().map(|one| one.join().expect("a build does not panic")).sum()
    })
}

/// Compiles one crate with one feature set for a target. What a target lacks shows in types and names: machine code, not optimised, is made of
/// the last row alone, and for the first target by the images.
fn cross_compile(toolchain: &Toolchain, build: &Build, target: &str) -> Result<(), String> {
    eprintln!("   {} [{}] for {target}", build.package, build.features.join(", "));
    // Whether a crate needs `alloc` does not depend on the target. The first target lacks it where the crate must do without.
    let has_alloc = build.is_alloc || target != TARGETS[0];
    let mut command = toolchain.cargo(has_alloc);
    let verb = if table::is_whole(build) && target != TARGETS[0] { "build" } else { "check" };
    command.args([verb, "--quiet", "--locked", "--no-default-features", "--profile", "plain"]);
    command.args(["--package", build.package, "--target", target]);
    if !build.features.is_empty() {
        command.args(["--features", &build.features.join(",")]);
    }
    command.arg("--target-dir").arg(process::target_dir().join("nostd").join(target));
    process::run(command.current_dir(process::root()))
}

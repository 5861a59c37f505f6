//! The job `cargo xtask check-nostd`: cross-compiles the `no_std` crates for microcontrollers, and runs the firmware example on emulated
//! boards.
//!
//! 1. Every crate and feature set of the table compiles for the first target. For the other targets, the smallest and the largest set of
//!    each crate are compiled.
//! 2. A step can reach no panic and no allocation, by the disassembled images.
//! 3. The images run under QEMU within their bounds, and have the results of the host.
//! 4. All features together add code to the image, and an image without a feature does not contain its code.
//! 5. A program in C, linked with the static library, gives the same bits as the run on the host. The library has a panic handler of its
//!    own. So the linker would fail if the standard library were included.
//! 6. An observer sets the state of an exported arm on an emulated board, and a loop is closed there. Programs in Rust and in C give the
//!    same bits.
//!
//! The job alone makes the long form: with the third target, an image with each feature of an effect, the other board and more models.
//!
//! A build for the host cannot show that a crate works without the standard library. The host has this library, so a dependency that needs
//! it is not noticed. The targets do not have it.

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

/// Runs the check alone. A missing toolchain is then a failure.
pub fn check_nostd() -> ExitCode {
    summary::ended("check-nostd", check_with(Form::Whole))
}

/// Builds the rows of the table for their targets, and runs the firmware.
///
/// # Errors
///
/// The first build that fails, with crate, features and target.
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

/// Builds the rows of the table for their targets. Returns the number of builds. Each target has a thread and a folder of its own, since
/// most of the time a few large crates are compiled, each on one core.
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

/// Compiles one crate with one feature set for a target. Parts that the target lacks are missing types and names, so the code is only
/// checked. Machine code, not optimised, is made for the last row alone; for the first target the images are built anyway.
fn cross_compile(toolchain: &Toolchain, build: &Build, target: &str) -> Result<(), String> {
    eprintln!("   {} [{}] for {target}", build.package, build.features.join(", "));
    // whether a crate needs `alloc` does not depend on the target; so only the first target is without it, for crates that must not need it
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

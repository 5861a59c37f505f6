//! Check of an observer of an exported arm, and of the closing of a loop, on an emulated board. The firmware has a program in Rust and one
//! in C, which clang compiles for the board.

use super::board::{M7, TARGET, Tools, build_program, cross_build, emulate, export};
use super::panics::no_panics;
use super::toolchain;
use crate::debian;
use crate::process::{self, run};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The scenes: the arm of the observer, from the tests of mbs-nostd, and the linkage whose loop is closed.
const SCENES: [&str; 2] = ["../mbs-nostd/tests/all/two-link-arm", "spatial-four-bar"];

/// Largest error of the observer's angles after [`SETTLED`] steps [rad]: a fortieth of the error at the start.
const MAX_ERROR: f64 = 1e-3;
/// Number of steps of 1 ms after which the observer must have reached the state of the arm [-].
const SETTLED: u32 = 400;
/// Largest violation that the closing of the loop leaves [m, m/s]: the rounding of lengths of 1 m and of rates of 6 rad/s.
const MAX_VIOLATION: f64 = 1e-12;

/// Report of a run of the observer.
#[derive(Debug, Clone, PartialEq)]
struct ObserverReport {
    /// Lines with the errors, the result of the closing, and the coordinates of the loop, as the run prints them.
    lines: Vec<String>,
    /// Numbers of instructions: to set a state of the arm, to set one of the loop, and for a step of the arm.
    instructions: [u64; 3],
    /// Largest error of an angle after [`SETTLED`] steps [rad].
    error: f64,
    /// Largest residual of |Φ| and |Φ'| after the closing, and in `moved` the largest displacement by it [rad].
    violation: f64,
    moved: f64,
}

impl ObserverReport {
    /// Reads the report from the text that a run prints.
    fn read(text: &str) -> Result<Self, String> {
        let mut report = Self {
            lines: Vec::new(),
            instructions: [0; 3],
            error: f64::NAN,
            violation: f64::NAN,
            moved: f64::NAN,
        };
        let (mut settled, mut n_settled) = (0.0_f64, 0);
        for line in text.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            let real = |word: &&str| u64::from_str_radix(word, 16).map_or(f64::NAN, f64::from_bits);
            match words.first() {
                Some(&"o") => {
                    let step = words.get(1).and_then(|word| word.parse::<u32>().ok());
                    if step.is_some_and(|step| step >= SETTLED) {
                        let errors = words[2..].iter().map(real).map(f64::abs);
                        settled = errors.fold(settled, largest);
                        n_settled += 1;
                    }
                }
                Some(&"c") => {
                    let numbers: Vec<f64> = words[1..].iter().map(real).collect();
                    let [moved, position, velocity] = numbers[..] else {
                        return Err(format!("the observer printed: {line}"));
                    };
                    (report.moved, report.violation) = (moved, largest(position, velocity));
                }
                Some(&"n") => {
                    for (to, word) in report.instructions.iter_mut().zip(&words[1..]) {
                        *to = word.parse().unwrap_or(0);
                    }
                }
                _ => {}
            }
            if matches!(words.first(), Some(&("o" | "c" | "s"))) {
                report.lines.push(line.to_owned());
            }
        }
        if n_settled > 0 {
            report.error = settled;
        }
        Ok(report)
    }

    /// Checks that the observer has reached the arm, and that the loop is closed.
    fn holds(&self, place: &str) -> Result<(), String> {
        let Self { error, violation, moved, .. } = *self;
        if !(error < MAX_ERROR) {
            return Err(format!("{place}: the observer is {error:e} rad from the arm"));
        }
        if !(violation < MAX_VIOLATION && moved > 0.0) {
            return Err(format!("{place}: the loop is open by {violation:e}, moved by {moved:e}"));
        }
        Ok(())
    }
}

/// The larger of two numbers. A NaN is never replaced.
fn largest(most: f64, x: f64) -> f64 {
    if most.is_nan() || x <= most { most } else { x }
}

/// Builds and runs the programs in Rust and in C.
///
/// # Errors
///
/// The first program that fails, or the first result that is wrong.
pub(super) fn check(tools: Tools<'_>, models: &Path) -> Result<String, String> {
    let [arm, linkage] = SCENES.map(|scene| export(scene, "f64", models));
    let (arm, linkage) = (arm?, linkage?);
    let variables = [("MBS_MODEL", &*arm), ("MBS_LOOP", &*linkage)];
    let (elf, image) = build_program(tools, &M7, ("observer", "signals"), &variables)?;
    no_panics(&elf, (M7.cpu, "mbs_set_state"), "the observer")?;
    let own = ObserverReport::read(&emulate(&M7, &elf)?)?;
    own.holds("the observer")?;
    let program = in_c(tools, models, [&arm, &linkage])?;
    let other = ObserverReport::read(&emulate(&M7, &program)?)?;
    other.holds("the observer in C")?;
    if own.lines != other.lines {
        return Err("the observers in Rust and in C have different bits".to_owned());
    }
    let [of_arm, of_loop, of_step] = own.instructions;
    Ok(format!(
        "observer on {}: {of_arm} instructions a state of the arm, {of_loop} a loop, {of_step} a step, {:.3} mrad after 0.4 s, flash {}, \
         the same bits in C",
        M7.cpu,
        own.error * 1e3,
        image.flash
    ))
}

/// Compiles the program in C for the board, and links it with the static library.
fn in_c(tools: Tools<'_>, models: &Path, [arm, linkage]: [&Path; 2]) -> Result<PathBuf, String> {
    let why = |left_out: crate::summary::LeftOut| left_out.why;
    debian::find("clang", "clang").map_err(why)?;
    let here = process::root().join("mbs-nostd/ffi");
    let (mut library, folder) = cross_build(tools, &M7);
    library.args(["--no-default-features", "--features", "mbs-nostd/signals"]);
    run(library.current_dir(&here))?;
    let bytes = [("arm_model", arm), ("linkage_model", linkage)]
        .map(|(name, file)| array(name, &file.with_extension("mbs")));
    let [arm, linkage] = bytes;
    let header = models.join("models.h");
    std::fs::write(&header, format!("{}{}", arm?, linkage?))
        .map_err(|e| format!("{}: {e}", header.display()))?;
    let (object, program) = (models.join("observer.o"), models.join("observer"));
    let mut compile = Command::new("clang");
    compile.args([&format!("--target={TARGET}"), &format!("-mcpu={}", M7.cpu)]);
    // products and sums are rounded separately, as in Rust
    compile.args(["-std=c11", "-ffreestanding", "-ffp-contract=off", "-O1"]);
    compile.args(["-Wall", "-Wextra", "-Werror", "-I", "include", "-I"]).arg(models);
    compile.args(["-c", "controller/observer.c", "-o"]).arg(&object);
    run(compile.current_dir(&here))?;
    let mut link = Command::new(toolchain::linker().map_err(why)?);
    link.args(["-flavor", "gnu", "--gc-sections", "-T", "controller/controller.ld"]).arg(&object);
    link.arg(folder.join("libmbs_nostd_ffi.a")).arg("-o").arg(&program);
    run(link.current_dir(&here))?;
    Ok(program)
}

/// The bytes of a file as an array in C.
fn array(name: &str, file: &Path) -> Result<String, String> {
    let bytes = std::fs::read(file).map_err(|e| format!("{}: {e}", file.display()))?;
    let numbers: Vec<String> = bytes.iter().map(u8::to_string).collect();
    Ok(format!("static const uint8_t {name}[] = {{{}}};\n", numbers.join(",")))
}

#[cfg(test)]
mod tests {
    use super::ObserverReport;

    #[test]
    fn errors_count_from_when_the_observer_has_settled_and_what_is_no_number_is_an_error() {
        let bits = |x: f64| format!("{:x}", x.to_bits());
        let text = |error: f64, left: f64| {
            format!(
                "o 50 {} {}\no 400 {} 0\nc {} {} 0\ns 500 1\nn 10 20 30\nm 7\n",
                bits(0.04),
                bits(0.02),
                bits(error),
                bits(0.05),
                bits(left)
            )
        };
        let read = |text: &str| ObserverReport::read(text).expect("a run");
        let report = read(&text(-2e-4, 1e-15));
        assert_eq!((report.error, report.violation, report.moved), (2e-4, 1e-15, 0.05));
        assert_eq!((report.instructions, report.lines.len()), ([10, 20, 30], 4));
        assert!(report.holds("").is_ok());
        for (error, left) in [(2e-3, 0.0), (f64::NAN, 0.0), (0.0, 1e-3), (0.0, f64::NAN)] {
            assert!(read(&text(error, left)).holds("").is_err(), "{error} {left}");
        }
        assert!(read("s 1 0\n").holds("").is_err());
    }
}

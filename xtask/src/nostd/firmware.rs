//! The firmware example on emulated boards: built, run, disassembled, and compared with the same run on the host.

use super::board::{Board, M4, M7, build, emulate, export, name, on_host};
use super::form::Form;
use super::image::Image;
use super::in_c;
use super::observer;
use super::panics::no_panics;
use super::run_report::RunReport;
use super::sizes;
use super::toolchain::Toolchain;
use crate::process;
use std::path::Path;

/// A run, and what must hold of it.
#[derive(Debug, Clone, Copy)]
struct Case {
    scene: &'static str,
    features: &'static str,
    precision: &'static str,
    board: Board,
    /// Instructions of the slowest step, and bytes of stack, at most.
    instructions: u64,
    stack: u64,
    /// Largest differences of coordinates from the host's run in double precision [m], [rad]; none: no bit differs.
    apart: Option<[f64; 2]>,
    /// Least form of the check that has it.
    form: Form,
}

/// Most bytes of an image.
const FLASH: u64 = 256 * 1024;
/// Most bytes of its stack.
const STACK: u64 = 64 * 1024;
/// Most bytes of the stack where links are bodies, of which there are four times as many, and of a vehicle with its drive line in double.
const MORE_STACK: u64 = 96 * 1024;

const VEHICLE: &str = "polynomial,speed-hold,tire";
const SUSPENSION: &str = "polynomial,tire";
const DRIVE_LINE: &str = "couplings,friction,polynomial,signals,tire";
/// A cam and a rope, from the tests of mbs-nostd.
const HOIST_SCENE: &str = "../mbs-nostd/tests/all/hoist";

/// Largest difference of a vehicle in single precision from the run in double [m, rad].
const NEAR_VEHICLE: Option<[f64; 2]> = Some([5e-3, 5e-3]);
/// Largest difference of the other cases in single precision from the run in double [m, rad].
const NEARER: Option<[f64; 2]> = Some([1e-3, 1e-3]);

/// Runs, and what must hold of them. The short form has the vehicle and the robot in both precisions, and elements with rows, on one board. `iltis-links` is the vehicle with 42 coordinates and 36 closures, whose links are bodies.
#[rustfmt::skip]
const CASES: &[Case] = &[
    Case { scene: "iltis-slalom", features: VEHICLE, precision: "f32", board: M7, instructions: 100_000, stack: STACK, apart: NEAR_VEHICLE, form: Form::Short },
    Case { scene: "iltis-slalom", features: VEHICLE, precision: "f64", board: M7, instructions: 200_000, stack: STACK, apart: None, form: Form::Short },
    Case { scene: "iltis-links", features: VEHICLE, precision: "f32", board: M7, instructions: 400_000, stack: MORE_STACK, apart: NEAR_VEHICLE, form: Form::Whole },
    Case { scene: "iltis-suspension", features: SUSPENSION, precision: "f32", board: M4, instructions: 100_000, stack: STACK, apart: NEARER, form: Form::Whole },
    Case { scene: "iltis-drive-line", features: DRIVE_LINE, precision: "f64", board: M7, instructions: 200_000, stack: MORE_STACK, apart: None, form: Form::Whole },
    Case { scene: "six-joint-arm", features: "", precision: "f32", board: M7, instructions: 15_000, stack: STACK, apart: NEARER, form: Form::Short },
    Case { scene: "six-joint-arm", features: "", precision: "f64", board: M7, instructions: 15_000, stack: STACK, apart: None, form: Form::Short },
    Case { scene: "servo-arm", features: "signals", precision: "f32", board: M7, instructions: 25_000, stack: STACK, apart: NEARER, form: Form::Whole },
    Case { scene: HOIST_SCENE, features: "couplings,curves,lines", precision: "f64", board: M7, instructions: 30_000, stack: STACK, apart: None, form: Form::Short },
];

/// Builds and runs the cases of a form; what was measured, a line for each.
///
/// # Errors
///
/// The first thing that does not hold.
pub(super) fn check(
    (toolchain, lld): (Toolchain, Option<&Path>),
    form: Form,
) -> Result<Vec<String>, String> {
    let models = process::target_dir().join("nostd/models");
    std::fs::create_dir_all(&models).map_err(|e| format!("{}: {e}", models.display()))?;
    let mut lines = vec![fresh_export(&models)?];
    for case in CASES.iter().filter(|case| case.form <= form) {
        lines.push(case.check(toolchain, lld, &models)?);
        eprintln!("   {}", lines[lines.len() - 1]);
    }
    lines.extend(sizes::check((toolchain, lld), &models, form)?);
    lines.push(in_c::check(&models)?);
    lines.push(observer::check((toolchain, lld), &models)?);
    Ok(lines)
}

impl Case {
    fn check(
        &self,
        toolchain: Toolchain,
        lld: Option<&Path>,
        models: &Path,
    ) -> Result<String, String> {
        let Self { scene, precision, board, .. } = self;
        let place = format!("{}, {precision} on {}", name(scene), board.cpu);
        let model = export(scene, precision, models)?;
        let (elf, image) = build((toolchain, lld), board, self.features, &model)?;
        no_panics(&elf, (board.cpu, "mbs_step"), &place)?;
        let report = RunReport::read(&emulate(board, &elf)?)?;
        let same = RunReport::read(&on_host(&model, self.features)?)?;
        let exact = if *precision == "f64" {
            same.clone()
        } else {
            RunReport::read(&on_host(&export(scene, "f64", models)?, self.features)?)?
        };
        let apart = report.apart(&exact)?;
        match self.apart {
            None if report.lines != same.lines => {
                return Err(format!("{place}: controller and host differ, by {apart}"));
            }
            Some(most) if !apart.is_within(most) => {
                return Err(format!("{place}: {apart} from the run in double precision"));
            }
            _ => {}
        }
        let bound = same.bound;
        for (what, is, most) in [
            ("instructions in a step", report.most, self.instructions),
            ("instructions in a step", report.most, bound),
            ("bytes of stack", report.stack, self.stack),
            ("bytes of flash", image.flash, FLASH),
        ] {
            if is > most {
                return Err(format!("{place}: {is} {what}, and {most} are allowed"));
            }
        }
        let RunReport { least, most, evaluation, stack, solver, .. } = report;
        let Image { flash, ram } = image;
        Ok(format!(
            "{place}: {least} to {most} instructions a step (bound {bound}), {evaluation} an evaluation, stack {stack} bytes, static \
             data {ram}, flash {flash}, solver {solver}, {apart} from f64"
        ))
    }
}

/// The table that stands in the repository is the one that its scene is exported to, but for white space.
fn fresh_export(models: &Path) -> Result<String, String> {
    let read = |path: &Path| {
        let text = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
        let text: String = text.split_whitespace().collect();
        // Where a list is broken into lines its last comma comes or goes.
        Ok::<_, String>(text.replace(",]", "]").replace(",}", "}").replace(",)", ")"))
    };
    let committed = process::root().join("examples/pick/nostd/src/model.rs");
    if read(&committed)? == read(&export("double-pendulum", "f64", models)?)? {
        Ok("the committed table is its scene's".to_owned())
    } else {
        Err(format!("{} is not what `mbs export` writes", committed.display()))
    }
}

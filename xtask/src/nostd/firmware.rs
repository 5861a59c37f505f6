//! Checks of the firmware example on emulated boards: it is built, run, disassembled, and compared with the same run on the host.

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

/// A run of the firmware, with the limits of its results.
#[derive(Debug, Clone, Copy)]
struct Case {
    scene: &'static str,
    features: &'static str,
    precision: &'static str,
    board: Board,
    /// Largest number of instructions of a step, and largest size of the stack in bytes.
    instructions: u64,
    stack: u64,
    /// Largest differences of coordinates from the host's run in double precision [m], [rad]; `None` if all bits must be equal.
    apart: Option<[f64; 2]>,
    /// Shortest form of the check that makes this run.
    form: Form,
}

/// Largest size of an image in bytes.
const FLASH: u64 = 256 * 1024;
/// Largest size of the stack in bytes.
const STACK: u64 = 64 * 1024;
/// Largest size of the stack in bytes for the two largest models: a vehicle whose links are bodies, and a vehicle with its drive line in
/// double precision.
const MORE_STACK: u64 = 96 * 1024;

const VEHICLE: &str = "polynomial,speed-hold,tire";
const SUSPENSION: &str = "polynomial,tire";
const DRIVE_LINE: &str = "couplings,friction,polynomial,signals,tire";
/// Scene with a cam and a rope, from the tests of mbs-nostd.
const HOIST_SCENE: &str = "../mbs-nostd/tests/all/hoist";

/// Largest difference of a vehicle in single precision from the run in double [m, rad].
const NEAR_VEHICLE: Option<[f64; 2]> = Some([5e-3, 5e-3]);
/// Largest difference of the other cases in single precision from the run in double [m, rad].
const NEARER: Option<[f64; 2]> = Some([1e-3, 1e-3]);

/// Runs of the firmware with the limits of their results. The short form has the vehicle and the robot in both precisions, and machine
/// elements with rows, on one board. `iltis-links` is the vehicle with links as bodies: it has 42 coordinates and 36 closures of loops.
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

/// Builds and runs the cases of a form. Returns a line with the measurements of each.
///
/// # Errors
///
/// The first build or run that fails, or the first limit that is exceeded.
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

/// Checks that the committed table is equal to the exported table of its scene, except for white space.
fn fresh_export(models: &Path) -> Result<String, String> {
    let read = |path: &Path| {
        let text = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
        let text: String = text.split_whitespace().collect();
        // a list on several lines has a comma after its last item, one on a single line has none
        Ok::<_, String>(text.replace(",]", "]").replace(",}", "}").replace(",)", ")"))
    };
    let committed = process::root().join("examples/pick/nostd/src/model.rs");
    if read(&committed)? == read(&export("double-pendulum", "f64", models)?)? {
        Ok("the committed table is its scene's".to_owned())
    } else {
        Err(format!("{} is not what `mbs export` writes", committed.display()))
    }
}

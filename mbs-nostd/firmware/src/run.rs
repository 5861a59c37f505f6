//! Steps the model at 1 kHz of its own time and reports the result; the same on the controller and on the host.
//!
//! ```text
//! s STEP COORDINATES      every so many steps, as hexadecimal bits
//! v STEP VELOCITIES
//! r POSITION VELOCITY ACCELERATION     the largest residuals of the steps, as bits
//! n LEAST MEAN MOST       what a step took, by the clock that is given
//! e MEAN                  what one more evaluation in a step took
//! z BYTES                 the size of the solver
//! ```

use crate::model::{Axes, MODEL, ModelSolver, Scalar};
use core::fmt::{Arguments, Write};
use mbs_nostd::{BoundedReport, Checked, StepError, Unwatched};

/// Steps of 1 ms.
const STEPS: u32 = 10_000;
/// Pairs of steps, with one evaluation and with two, behind these.
const COMPARED: u32 = 100;
/// Steps between two that are reported.
const REPORT_INTERVAL: u32 = 100;

/// One step: what is proved to have no path to a panic.
#[unsafe(no_mangle)]
#[inline(never)]
pub fn mbs_step(
    solver: &mut ModelSolver,
    model: &Checked<'_, Scalar, Axes>,
) -> Result<BoundedReport<Scalar>, StepError> {
    solver.step(model, 1e-3, &mut Unwatched)
}

/// The run; `None` after an error, which was reported. `clock` gives the time since the last call.
pub fn run(out: &mut impl Write, mut clock: impl FnMut() -> u32) -> Option<()> {
    let Ok(model) = Checked::new(&MODEL) else {
        writeln!(out, "the model does not pass its check").ok()?;
        return None;
    };
    // Borrowed where it was made: taken out, it would be on the stack twice.
    let mut made = ModelSolver::new(&model);
    let Ok(solver) = &mut made else {
        writeln!(out, "the model does not fit its solver").ok()?;
        return None;
    };
    let (mut least, mut most, mut sum) = (u32::MAX, 0, 0_u64);
    let mut residuals: [Scalar; 3] = [0.0; 3];
    for step in 1..=STEPS {
        clock();
        let done = mbs_step(solver, &model);
        let spent = clock();
        (least, most, sum) = (least.min(spent), most.max(spent), sum + u64::from(spent));
        let report = match done {
            Ok(report) => report,
            Err(error) => {
                writeln!(out, "step {step}: {}", what(&error)).ok()?;
                return None;
            }
        };
        for (largest, x) in residuals.iter_mut().zip(report.violation) {
            *largest = if x > *largest { x } else { *largest };
        }
        if step % REPORT_INTERVAL == 0 {
            write_line(out, format_args!("s {step}"), solver.coordinates())?;
            write_line(out, format_args!("v {step}"), solver.velocities())?;
        }
    }
    write_line(out, format_args!("r"), &residuals)?;
    writeln!(out, "n {least} {} {most}", sum / u64::from(STEPS)).ok()?;
    let mut spent = [0_u64; 2];
    for _ in 0..COMPARED {
        for (evaluations, spent) in (1..).zip(&mut spent) {
            solver.bounds.evaluations = evaluations;
            clock();
            mbs_step(solver, &model).ok()?;
            *spent += u64::from(clock());
        }
    }
    writeln!(out, "e {}", spent[1].saturating_sub(spent[0]) / u64::from(COMPARED)).ok()?;
    writeln!(out, "z {}", size_of::<ModelSolver>()).ok()
}

/// A line of numbers, as bits.
fn write_line(out: &mut impl Write, what: Arguments<'_>, numbers: &[Scalar]) -> Option<()> {
    write!(out, "{what}").ok()?;
    for x in numbers {
        write!(out, " {:x}", x.to_bits()).ok()?;
    }
    writeln!(out).ok()
}

/// What stopped a step, in a word: names and numbers are for the host.
fn what(error: &StepError) -> &'static str {
    match error {
        StepError::NotFinite { .. } => "not finite",
        StepError::Singular(_) => "singular",
        StepError::RankLost { .. } => "rank lost",
        StepError::Tables => "tables",
        _ => "stopped",
    }
}

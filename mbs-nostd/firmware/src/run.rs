//! Steps the model at 1 kHz of simulated time and reports the result. The code is the same on the controller and on the host.
//!
//! ```text
//! s STEP COORDINATES      every 100 steps, as hexadecimal bits
//! v STEP VELOCITIES
//! r POSITION VELOCITY ACCELERATION     the largest residuals of the steps, as bits
//! n LEAST MEAN MOST       time of a step by the given clock: minimum, mean, maximum
//! e MEAN                  time of one more evaluation in a step
//! z BYTES                 the size of the solver
//! ```

use crate::model::{Axes, MODEL, ModelSolver, Scalar};
use core::fmt::{Arguments, Write};
use mbs_nostd::{BoundedReport, Checked, StepError, Unwatched};

/// Number of steps of 1 ms [-].
const STEPS: u32 = 10_000;
/// Number of pairs of further steps [-]. The first step of a pair has one evaluation, the second has two.
const COMPARED: u32 = 100;
/// Number of steps between two reports [-].
const REPORT_INTERVAL: u32 = 100;

/// Makes one step of the model. A check of the compiled code proves that this function has no path to a panic.
#[unsafe(no_mangle)]
#[inline(never)]
pub fn mbs_step(
    solver: &mut ModelSolver,
    model: &Checked<'_, Scalar, Axes>,
) -> Result<BoundedReport<Scalar>, StepError> {
    solver.step(model, 1e-3, &mut Unwatched)
}

/// Runs the model with reports. Returns `None` after an error, which was printed. `clock` returns the time since its last call.
pub fn run(out: &mut impl Write, mut clock: impl FnMut() -> u32) -> Option<()> {
    let Ok(model) = Checked::new(&MODEL) else {
        writeln!(out, "the model does not pass its check").ok()?;
        return None;
    };
    // The solver is used by reference. A move out of the result would need the stack memory of two solvers.
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

/// Writes a line of numbers as hexadecimal bits.
fn write_line(out: &mut impl Write, what: Arguments<'_>, numbers: &[Scalar]) -> Option<()> {
    write!(out, "{what}").ok()?;
    for x in numbers {
        write!(out, " {:x}", x.to_bits()).ok()?;
    }
    writeln!(out).ok()
}

/// Returns the kind of a step's error as text, without indices and numbers. A run on the host shows these.
fn what(error: &StepError) -> &'static str {
    match error {
        StepError::NotFinite { .. } => "not finite",
        StepError::Singular(_) => "singular",
        StepError::RankLost { .. } => "rank lost",
        StepError::Tables => "tables",
        _ => "stopped",
    }
}

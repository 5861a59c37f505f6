//! Steps a model at 1 kHz of its own time and tells the host: states as bits, instructions of a step, stack.
//!
//! ```text
//! s STEP COORDINATES      every so many steps: the coordinates, as hexadecimal bits
//! v STEP VELOCITIES
//! n LEAST MEAN MOST       instructions of a step, by a timer of 40 instructions a tick
//! m STACK SOLVER          bytes of stack that were used, and of the solver in it
//! r EVALUATIONS POSITION VELOCITY ACCELERATION     the largest residuals of the steps, as bits
//! ```

#![no_std]
#![no_main]

mod model;
mod stack;
mod timer;

use core::fmt::Write;
use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hio};
use mbs_nostd::{BoundedReport, Checked, StepError, Unwatched};
use model::{Axes, MODEL, ModelSolver, Scalar};

/// Steps of 1 ms.
const STEPS: u32 = 10_000;
/// Steps between two that are told.
const TOLD: u32 = 100;

/// One step: what is proved to have no path to a panic.
#[unsafe(no_mangle)]
#[inline(never)]
pub fn mbs_step(
    solver: &mut ModelSolver,
    model: &Checked<'_, Scalar, Axes>,
) -> Result<BoundedReport<Scalar>, StepError> {
    solver.step(model, 1e-3, &mut Unwatched)
}

#[entry]
fn main() -> ! {
    stack::paint();
    let status = match run() {
        Some(()) => debug::EXIT_SUCCESS,
        None => debug::EXIT_FAILURE,
    };
    debug::exit(status);
    loop {}
}

/// The run; `None` when something went wrong, which was told.
fn run() -> Option<()> {
    let mut out = hio::hstdout().ok()?;
    let Ok(model) = Checked::new(&MODEL) else {
        writeln!(out, "the model does not pass its check").ok()?;
        return None;
    };
    let Ok(mut solver) = ModelSolver::new(&model) else {
        writeln!(out, "the model does not fit its solver").ok()?;
        return None;
    };
    let timer = timer::Timer::start();
    let (mut least, mut most, mut sum) = (u32::MAX, 0, 0_u64);
    let mut residuals: [Scalar; 3] = [0.0; 3];
    for step in 1..=STEPS {
        let before = timer.now();
        let done = mbs_step(&mut solver, &model);
        let spent = timer.since(before) * timer::INSTRUCTIONS_PER_TICK;
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
        if step % TOLD == 0 {
            tell(&mut out, 's', step, solver.coordinates())?;
            tell(&mut out, 'v', step, solver.velocities())?;
        }
    }
    let mean = sum / u64::from(STEPS);
    writeln!(out, "n {least} {mean} {most}").ok()?;
    writeln!(out, "m {} {}", stack::used(), size_of::<ModelSolver>()).ok()?;
    tell(&mut out, 'r', 1, &residuals)
}

/// A line of numbers, as bits.
fn tell(out: &mut hio::HostStream, what: char, step: u32, numbers: &[Scalar]) -> Option<()> {
    write!(out, "{what} {step}").ok()?;
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

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    debug::exit(debug::EXIT_FAILURE);
    loop {}
}

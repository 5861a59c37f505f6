//! diffsol on Andrews' squeezing mechanism as an ordinary differential equation in 14 unknowns: andrews andrews 7 SECONDS
//!
//! Each evaluation solves the 13 equations of accelerations and multipliers. The program prints a line for each tolerance. Its value is the
//! number of correct digits at 0.03 s. The method TSIT45 is the fastest of diffsol's methods here at every number of digits.

use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason, Vector};
use rust_peers::andrews::{START, digits, rate};
use rust_peers::{asked, print_line, time_of};
use std::error::Error;

const END: f64 = 0.03;

/// Tolerances of the runs: five per two decades.
fn tolerances() -> impl Iterator<Item = f64> {
    (0..=18).map(|i| 10_f64.powf(-3.0 - 0.4 * f64::from(i)))
}

/// Digits and seconds at one tolerance.
fn measure(tolerance: f64, seconds: f64) -> Result<[f64; 2], Box<dyn Error>> {
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(tolerance)
        .atol([tolerance; 14])
        .h0(1e-7)
        .rhs(|x, _, _, y| rate(x, y))
        .init(
            |_, _, y| {
                y.fill(0.0);
                y[..7].copy_from_slice(&START);
            },
            14,
        )
        .build()?;
    let run = || -> Result<f64, Box<dyn Error>> {
        let mut solver = problem.tsit45()?;
        solver.set_stop_time(END)?;
        while !matches!(solver.step()?, OdeSolverStopReason::TstopReached) {}
        Ok(digits(&solver.state().y.clone_as_vec()[..7]))
    };
    let found = run()?;
    let time = time_of(seconds, |_| {
        std::hint::black_box(run().is_ok());
    });
    Ok([found, time])
}

fn main() -> Result<(), Box<dyn Error>> {
    let (_, _, seconds) = asked("andrews andrews 7 SECONDS")?;
    for tolerance in tolerances() {
        let [found, time] = measure(tolerance, seconds)?;
        print_line(&format!("diffsol TSIT45 {tolerance:.1e}"), time, found, "digits");
    }
    Ok(())
}

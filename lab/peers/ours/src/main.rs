//! Times of mbs on the problems on which its peers are timed: ours PROBLEM N (SECONDS | STEP)
//!
//! A line has an algorithm, the seconds of one call or run, a value, and the name of the reference for the value. Lines of the algorithm
//! `reference` have the exact value, by a closed form or by the same equations with 32 digits.

mod andrews;
mod clock;
mod line;
mod loops;
mod open;
mod robots;
mod runs;
mod scenes;
mod space;
mod step;

use line::Failure;
use std::process::ExitCode;

const USAGE: &str = "ours (chain | tree | inverse | four-bars | step) N SECONDS\n\
                     ours robot-(forward | inverse | mass | jacobian | derivatives) N SECONDS\n\
                     ours (double-pendulum | n-four-bars) N STEP\n\
                     ours andrews 7 SECONDS";

fn run() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [problem, n, number] = &words[..] else { return Err(USAGE.into()) };
    let (n, number): (usize, f64) = (n.parse()?, number.parse()?);
    match problem.as_str() {
        "chain" => open::forward(scenes::Shape::Chain, n, number),
        "tree" => open::forward(scenes::Shape::Tree, n, number),
        "inverse" => open::inverse(n, number),
        robot if robot.starts_with("robot-") => robots::robot(robot, n, number),
        "four-bars" => loops::four_bars(n, number),
        "step" => step::step(n, number),
        "double-pendulum" => runs::double_pendulum(number),
        "n-four-bars" => runs::four_bars(n, number),
        "andrews" => andrews::andrews(number),
        _ => Err(USAGE.into()),
    }
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

//! The job `cargo xtask peers`: times mbs and its peers on the same problems, interleaved, in one run (docs/PEERS.md).

mod digits;
mod lanes;
mod problems;
mod programs;
mod tables;

use crate::bench::Machine;
use crate::lab::section::page;
use lanes::Measured;
use problems::{Kind, Problem, selected};
use programs::{Asked, Who};
use xtask::process;

/// Effort of a measurement: number of turns, and times of its runs.
#[derive(Debug, Clone, Copy)]
struct Effort {
    /// Number of the turns. In a turn each program runs once.
    turns: usize,
    /// Time of each algorithm in a turn [s].
    seconds: f64,
    /// Time of each tolerance of a curve in a turn [s].
    point: f64,
}

const FULL: Effort = Effort { turns: 7, seconds: 0.2, point: 0.03 };
const QUICK: Effort = Effort { turns: 3, seconds: 0.05, point: 0.01 };

/// Measures the problems, or the named ones, and writes the results. Returns whether our values are right.
///
/// # Errors
///
/// The reason why nothing can be measured.
#[allow(clippy::print_stdout, reason = "the tables are what is asked for")]
pub(crate) fn peers(quick: bool, names: &[String]) -> Result<bool, String> {
    let effort = if quick { QUICK } else { FULL };
    let problems = selected(names)?;
    programs::build()?;
    let mut machine = Machine::now();
    let mut measured = Vec::new();
    for problem in problems {
        measured.push(measure(problem, effort)?);
        machine.end();
        write(&measured, &machine, effort)?;
    }
    process::progress("");
    println!("{}", tables::text(&measured, &remark(&machine, effort)));
    Ok(measured.iter().all(|m| m.wrong().is_empty()))
}

/// Measures one of the problems. In every turn each available program runs once, ours first.
fn measure(problem: Problem, effort: Effort) -> Result<Measured, String> {
    let mut measured = Measured::new(problem);
    let seconds = if problem.kind == Kind::Digits { effort.point } else { effort.seconds };
    let asked =
        Asked { problem: problem.name, n: problem.n, number: problem.step.unwrap_or(seconds) };
    for turn in 0..effort.turns {
        process::progress(&format!("{}, turn {} of {}", problem.label(), turn + 1, effort.turns));
        measured.take(Who::Ours, Who::Ours.run(&asked)?);
        for &who in problem.peers.iter().filter(|who| who.is_here()) {
            if measured.failed.iter().any(|(failed, _)| *failed == who) {
                continue;
            }
            match who.run(&asked) {
                Ok(lines) => measured.take(who, lines),
                Err(why) => measured.failed.push((who, why)),
            }
        }
    }
    Ok(measured)
}

/// Returns the remark on the meaning of the numbers.
fn remark(machine: &Machine, effort: Effort) -> String {
    format!(
        "CPU time of one thread; the median of {} turns, in each of which every program ran once, ours first. A ratio is the \
         median of the turns' own ratios. mbs {}, built for any x86-64; the peers for this processor. {}, {}.",
        effort.turns,
        Who::Ours.version(),
        machine.processor,
        machine.load_text()
    )
}

/// Writes the results so far, so that an interrupted job leaves them.
fn write(measured: &[Measured], machine: &Machine, effort: Effort) -> Result<(), String> {
    let folder = programs::folder();
    let remark = remark(machine, effort);
    let page = page("mbs and its peers", &remark, &tables::sections(measured));
    let files = [
        ("peers.txt", tables::text(measured, &remark).into_bytes()),
        ("peers.md", tables::markdown(measured, &remark).into_bytes()),
        ("peers.csv", tables::csv(measured)?),
        ("peers.html", page.into_bytes()),
    ];
    files.into_iter().try_for_each(|(name, bytes)| process::write(&folder.join(name), &bytes))
}

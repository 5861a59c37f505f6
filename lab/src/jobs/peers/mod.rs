//! `cargo xtask peers`: mbs and its peers on the same problems, by turns, in one run (docs/PEERS.md).

mod digits;
mod lanes;
mod problems;
mod programs;
mod tables;

use crate::page;
use lanes::Measured;
use problems::{Kind, Problem, wanted};
use programs::{Asked, Who};
use std::process::ExitCode;
use xtask::process;

/// How long and how often is measured.
#[derive(Debug, Clone, Copy)]
struct Effort {
    /// Turns: each program once.
    turns: usize,
    /// For each algorithm in a turn [s].
    seconds: f64,
    /// For each tolerance of a curve in a turn [s].
    point: f64,
}

const FULL: Effort = Effort { turns: 7, seconds: 0.2, point: 0.03 };
const QUICK: Effort = Effort { turns: 3, seconds: 0.05, point: 0.01 };

/// Measures the problems, or those named; exit status 1 where ours cannot run or is not right.
pub(crate) fn peers(quick: bool, names: &[String]) -> ExitCode {
    match run(if quick { QUICK } else { FULL }, names) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(why) => {
            eprintln!("cargo xtask peers: {why}");
            ExitCode::FAILURE
        }
    }
}

/// Builds, measures and writes; says whether ours is right.
#[allow(clippy::print_stdout, reason = "the tables are what is asked for")]
fn run(effort: Effort, names: &[String]) -> Result<bool, String> {
    let problems = wanted(names);
    if problems.is_empty() {
        return Err(format!("no problem is named {}", names.join(", ")));
    }
    programs::build()?;
    let mut machine = crate::bench::Machine::now();
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

/// One problem: in every turn each program that is here, ours first.
fn measure(problem: Problem, effort: Effort) -> Result<Measured, String> {
    let mut measured = Measured::new(problem);
    let seconds = if problem.kind == Kind::Digits { effort.point } else { effort.seconds };
    let asked =
        Asked { problem: problem.name, n: problem.n, number: problem.step.unwrap_or(seconds) };
    for turn in 0..effort.turns {
        process::progress(&format!("{}, turn {} of {}", problem.told(), turn + 1, effort.turns));
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

/// What the numbers are.
fn remark(machine: &crate::bench::Machine, effort: Effort) -> String {
    format!(
        "CPU time of one thread; the median of {} turns, in each of which every program ran once, ours first. A ratio is the \
         median of the turns' own ratios. mbs {}, built for any x86-64; the peers for this processor. {}",
        effort.turns,
        Who::Ours.version(),
        busy(machine)
    )
}

/// The processor, and how busy the machine was.
fn busy(machine: &crate::bench::Machine) -> String {
    let load = machine.load.map(|x| x.map_or("?".to_owned(), |x| format!("{x:.1}")));
    format!("{}, load average {} before and {} after.", machine.processor, load[0], load[1])
}

/// Writes what there is so far, so that a job that is cut off leaves it.
fn write(
    measured: &[Measured],
    machine: &crate::bench::Machine,
    effort: Effort,
) -> Result<(), String> {
    let folder = programs::folder();
    let remark = remark(machine, effort);
    let content: String = tables::sections(measured).iter().map(|s| s.html()).collect();
    let page = page::page("mbs and its peers", &remark, &content);
    let files = [
        ("peers.txt", tables::text(measured, &remark)),
        ("peers.md", tables::markdown(measured, &remark)),
        ("peers.csv", tables::csv(measured)),
        ("peers.html", page),
    ];
    for (name, text) in files {
        let path = folder.join(name);
        std::fs::write(&path, text).map_err(|e| format!("cannot write {}: {e}", path.display()))?;
    }
    Ok(())
}

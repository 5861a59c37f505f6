//! Table D1: index-3 with small steps, where it is ill-conditioned, in the published form with 16 and with 32 digits.
//!
//! The report supposes that words of 128 bits would be a remedy. Each run is made by the program `runner`, which has the published form in
//! all precisions. This module lists the runs and evaluates them.

mod cell;
mod outcome;
mod report;

use crate::bench;
use crate::lab::Lab;
use crate::lab::section::Section;
use cell::{Cell, DEFAULT, LADDERS, OURS, SCENES, WAYS, Way};
use outcome::Run;
use std::collections::BTreeSet;
use std::time::Duration;
use xtask::process;

/// Largest wall-clock time of a run. Chosen, not tuned.
const RUN_TIME: Duration = Duration::from_secs(300);
/// Simulated time [s]: one swing of the double pendulum, or one singular position of the four-bars, at 0.71 s.
const SPAN: &str = "1";
/// Exponents k of the steps 10^-k s [-].
const STEPS: [i32; 5] = [2, 3, 4, 5, 6];
/// Largest exponent of a step with `--quick` [-]: smaller steps take minutes.
const QUICK: i32 = 4;

/// Makes all runs, one after the other.
///
/// # Errors
///
/// The reason why something cannot be run.
pub(crate) fn d1(lab: &Lab<'_>) -> Result<Section, String> {
    let program = bench::built(&bench::Threads::up_to(1), lab.quick)?;
    let run = |words: &[&str]| {
        process::progress(&format!("D1 {}", words[1..].join(" ")));
        Run::read(program.run(words, RUN_TIME))
    };
    let cells = cells(lab.quick, run);
    process::write(&lab.folder.join("digits.csv"), &cell::csv(&cells)?)?;
    Ok(report::section(&cells))
}

/// Makes the runs of all cells. `run` calls the program with the given arguments.
fn cells(quick: bool, mut run: impl FnMut(&[&str]) -> Run) -> Vec<Cell> {
    let mut cells = Vec::new();
    for scene in SCENES {
        let steps = || STEPS.into_iter().filter(|&k| !quick || k <= QUICK);
        let mut made = |way: Way, k: i32, exponent: i32| {
            let [step, alpha] = [format!("1e-{k}"), format!("1e{exponent}")];
            run(&["digits", scene.file, way.form, way.digits, &step, SPAN, &alpha])
        };
        for k in steps() {
            let ours = made(DEFAULT, k, 7);
            let exponents: BTreeSet<_> = LADDERS.iter().map(|rule| (rule.exponent)(k)).collect();
            for exponent in exponents {
                let printed = WAYS[..OURS].iter().map(|&way| made(way, k, exponent));
                let runs = printed.chain([ours.clone()]).collect();
                cells.push(Cell { scene, k, exponent, runs });
            }
        }
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::cell::{CORRECTION, PAIRS, PRINTED, REFINED};
    use super::*;

    #[test]
    fn penalties_are_the_printed_ones_where_the_report_names_them() {
        let raised = |k| (LADDERS[1].exponent)(k);
        assert_eq!([2, 3, 4, 5].map(raised), [7, 7, 9, 11]);
        assert_eq!(STEPS.map(|k| (LADDERS[0].exponent)(k)), [7; 5]);
    }

    #[test]
    fn every_way_is_run_once_for_each_step_and_penalty_and_ours_once_for_each_step() {
        let mut asked = Vec::new();
        let cells = cells(true, |words| {
            asked.push(words.join(" "));
            Run::read(Err("not run".to_owned()))
        });
        // at 1e-2 and 1e-3 s two choices give the same penalty
        assert_eq!(cells.len(), 2 * (2 + 2 + 3));
        assert!(cells.iter().all(|cell| cell.runs.len() == WAYS.len()));
        assert_eq!(asked.len(), 2 * ((2 + 2 + 3) * 5 + 3));
        assert!(asked.contains(&"digits two-four-bars printed dd 1e-4 1 1e17".to_owned()));
        assert_eq!([WAYS[PRINTED], WAYS[PAIRS]].map(|way| way.digits), ["f64", "dd"]);
        assert_eq!(
            (WAYS[REFINED].digits, WAYS[CORRECTION].form, WAYS[OURS]),
            ("refined", "correction", DEFAULT)
        );
    }
}

//! The job `cargo xtask gauntlet`: thousands of difficult cases by seed, in every formulation, in supervised processes. The result is a
//! table of methods by properties.

mod tally;
mod workers;

use crate::lab::section::{Section, page};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use tally::Tallies;
use workers::Share;
use xtask::process::{self, write};

/// Largest time of a run: a run that takes longer hangs. Chosen, not tuned.
const RUN_TIME: Duration = Duration::from_secs(120);

/// Runs cases on `jobs` cores; by default on all. Returns whether no result is wrong.
///
/// # Errors
///
/// The reason why the cases cannot be run.
#[allow(clippy::print_stdout, reason = "the table is what is asked for")]
pub(crate) fn gauntlet(count: usize, jobs: Option<usize>) -> Result<bool, String> {
    let (section, is_sound) = run(count, jobs)?;
    println!("{}", section.text());
    Ok(is_sound)
}

fn run(count: usize, jobs: Option<usize>) -> Result<(Section, bool), String> {
    let program = process::tested("runner", "short")?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let stride = jobs.unwrap_or(cores).clamp(1, count.max(1));
    let (start, n_done) = (Instant::now(), AtomicUsize::new(0));
    let done = || {
        let n = n_done.fetch_add(1, Ordering::Relaxed) + 1;
        if n.is_multiple_of(100) {
            let rest = start.elapsed().as_secs_f64() * (count as f64 / n as f64 - 1.0);
            process::progress(&format!("{n} of {count} cases, {:.0} min left", rest / 60.0));
        }
    };
    let lines = std::thread::scope(|scope| {
        let worker = |first| {
            let share = Share { count, first, stride, limit: RUN_TIME };
            let (program, done) = (&program, &done);
            scope.spawn(move || workers::run(program, share, done))
        };
        let workers: Vec<_> = (0..stride).map(worker).collect();
        let join = |worker: std::thread::ScopedJoinHandle<'_, _>| {
            worker.join().unwrap_or_else(|_| Err("a thread panicked".to_owned()))
        };
        workers.into_iter().map(join).collect::<Result<Vec<_>, _>>()
    })?;
    let mut lines = lines.concat();
    lines.sort_by_key(|line| line["number"].as_u64());
    let tallies = Tallies::of(&lines);
    let section = section(&tallies, (count, stride), start.elapsed());
    let folder = process::target_dir().join("gauntlet");
    let json_lines: String = lines.iter().map(|line| format!("{line}\n")).collect();
    write(&folder.join("cases.jsonl"), json_lines.as_bytes())?;
    write(&folder.join("gauntlet.txt"), section.text().as_bytes())?;
    let remark = process::commit().map_or_else(String::new, |commit| format!("commit {commit}"));
    let html = page("Gauntlet", &remark, std::slice::from_ref(&section));
    write(&folder.join("gauntlet.html"), html.as_bytes())?;
    Ok((section, tallies.wrong.is_empty() && tallies.faults.is_empty()))
}

/// Makes the page: methods by properties, then by families, and all wrong results.
fn section(tallies: &Tallies, (count, jobs): (usize, usize), time: Duration) -> Section {
    let mut section = Section::new("gauntlet", "Hard cases in every formulation");
    let sum = tallies.sum();
    section.words(format!(
        "{} cases by seed, each run by {} formulations with the trapezoidal rule (multi-index with its own control of the step): {} runs are right, {} as far \
         off as the rule itself is at that step, {} further off than the others by an error that falls with the square of the step, {} ended in a typed error, {} were completed with nothing to compare them with, {} are wrong. {:.0} minutes in {jobs} processes. \
         Again: cargo xtask gauntlet --count {count}.",
        tallies.cases, tallies.methods.len(), sum.right, sum.coarse,
        sum.apart, sum.stops(), sum.unjudged, sum.wrong + tallies.faults.len(),
        time.as_secs_f64() / 60.0,
    ));
    section.words(
        "Wrong is: off from the reference (a closed form, the same motion without the difficulty, or another formulation at a tenth of the step) by more than \
         ten times the error of the rule at that step (the lower median of the other formulations' errors, or what it is at steps down to half of it where that is more) and by more than 1e-7 of the size, or the energy in the end by more than a tenth of what \
         was turned over, without a typed error; a panic; a number that is none; a run of more than two minutes. A cell says pass, or the largest step up to which no run stopped, \
         the share of runs that ended in a typed error, and the error that most of them name.",
    );
    let mut head = vec!["property"];
    head.extend(tallies.methods.iter().map(String::as_str));
    let row = |name: &str, tallies: &[tally::Tally]| {
        let cells = tallies.iter().map(tally::Tally::cell);
        [name.to_owned()].into_iter().chain(cells).collect::<Vec<_>>()
    };
    let rows = tallies.properties().iter().map(|(name, cells)| row(name, cells)).collect();
    section.table(&head, rows);
    section.heading("By families");
    head[0] = "family";
    let rows = tallies.families.iter().map(|(_, name, cells)| row(name, cells)).collect();
    section.table(&head, rows);
    section.heading("What is wrong");
    if tallies.wrong.is_empty() && tallies.faults.is_empty() {
        section.words("Nothing.");
    } else {
        let one = |wrong: &tally::Wrong| {
            let name = format!("{}, seed {}", wrong.family, wrong.seed);
            vec![name, wrong.method.clone(), format!("{:e}", wrong.step), wrong.why.clone()]
        };
        let fault =
            |fault: &String| vec![fault.clone(), String::new(), String::new(), String::new()];
        let rows = tallies.wrong.iter().map(one).chain(tallies.faults.iter().map(fault));
        section.table(&["case", "method", "step [s]", "why"], rows.collect());
    }
    section
}

//! The job `cargo xtask counts`: counts the instructions of a step by callgrind, and checks that absent parts cost nothing.
//!
//! The program `counts` is built three times: with all effects, without any, and with all effects but nearly without inlining, so that
//! functions can be found by name. Callgrind is run directly rather than through a library. So no versions have to match, and lists of
//! functions are available.

mod callgrind;
mod claims;

use crate::format;
use callgrind::Case;
pub(crate) use callgrind::missing as missing_valgrind;
use claims::{Claim, Lean, Runs};
use serde_json::{Value, json};
use std::path::PathBuf;
use std::process::Command;
use xtask::effects::{self, Listed};
use xtask::process::{self, cargo};

/// Number of steps that are counted in each case.
const STEPS: u64 = 10;
/// Name of the cases with a guide, which is present or absent.
const GUIDE: &str = "guide";
/// Trains of gears: one for the ratio of gears to wheels, and two for the growth.
const TRAINS: [&str; 3] = ["train-5", "train-20", "train-40"];

/// The names of all effects, and the guide.
fn cases() -> Vec<String> {
    effects::all().flat_map(Listed::cases).chain([GUIDE.to_owned()]).collect()
}

/// Counts, prints the table and writes it as JSON. Returns whether every claim holds. The short form has no build without effects.
///
/// # Errors
///
/// The program that could not be built or run.
#[allow(clippy::print_stdout, reason = "the table is what this job is for")]
pub(crate) fn counts(is_short: bool) -> Result<bool, String> {
    if let Some(left_out) = callgrind::missing("counts") {
        return Err(format!("{}\n{}", left_out.why, left_out.remedy));
    }
    let (runs, claims) = count(is_short)?;
    print!("{}\n{}", table(&runs), verdict(&claims));
    let json = format!("{:#}\n", json(&runs, &claims));
    process::write(&folder().join("counts.json"), json.as_bytes())?;
    let n: usize = claims.iter().map(|claim| claim.n_checked).sum();
    println!("{} cases, {n} comparisons", runs.full.len());
    Ok(claims.iter().all(Claim::holds))
}

/// Builds and runs the programs, and checks the claims.
fn count(is_short: bool) -> Result<(Runs, Vec<Claim>), String> {
    let counted = |profile, with_effects, steps: u64, effects: &[String]| {
        let args: Vec<_> = [steps.to_string()].into_iter().chain(effects.to_vec()).collect();
        callgrind::run(&build(profile, with_effects)?, &args, &folder().join("callgrind"))
    };
    let lean = || {
        let cases = counted("dist", false, STEPS, &["spring-damper".to_owned()])?;
        Ok::<_, String>(Lean { cases, refusals: refusals()? })
    };
    let runs = Runs {
        lean: if is_short { None } else { Some(lean()?) },
        full: counted("dist", true, STEPS, &cases())?,
        trains: counted("dist", true, STEPS, &TRAINS.map(str::to_owned))?,
        plain: counted("plain", true, 1, &["bumper".to_owned(), GUIDE.to_owned()])?,
    };
    let claims = claims::all(&runs);
    Ok((runs, claims))
}

/// Refusals by the build without effects, for each effect that has a feature: effect, feature, message.
fn refusals() -> Result<Vec<[String; 3]>, String> {
    let program = build("dist", false)?;
    let refusal = |(effect, feature): (String, &str)| {
        let out = Command::new(&program).args(["1", &effect]).output();
        let out = out.map_err(|e| format!("cannot start {}: {e}", program.display()))?;
        Ok([effect, feature.to_owned(), String::from_utf8_lossy(&out.stderr).into_owned()])
    };
    let with_feature = effects::all().filter_map(|listed| Some((listed, listed.feature?)));
    let cases = with_feature
        .flat_map(|(listed, feature)| listed.cases().into_iter().map(move |case| (case, feature)));
    cases.map(refusal).collect()
}

/// Builds the program for counts. Each build replaces the one before.
fn build(profile: &str, with_effects: bool) -> Result<PathBuf, String> {
    let mut command = cargo();
    command.args(["build", "--quiet", "--package", "lab", "--bin", "counts", "--profile", profile]);
    command.args(["--no-default-features", "--features"]);
    command.arg(if with_effects { "effects" } else { "counts" });
    command.arg("--target-dir").arg(folder());
    // names contain generic arguments; loops are not vectorised, since vectorised ones compare the addresses of two buffers at run time,
    // which depend on the allocator
    command.env("RUSTFLAGS", "-C symbol-mangling-version=v0 -C no-vectorize-loops");
    process::run(command.current_dir(process::root()))?;
    Ok(folder().join(profile).join("counts"))
}

fn folder() -> PathBuf {
    process::target_dir().join("counts")
}

/// The runs and the claims.
fn json(runs: &Runs, claims: &[Claim]) -> Value {
    let cases = |cases: &[Case]| -> Value {
        cases.iter().map(|c| json!({ "case": c.name, "instructions": c.instructions })).collect()
    };
    let claim = |c: &Claim| json!({ "claim": c.text, "holds": c.holds(), "comparisons": c.n_checked, "against": c.against });
    let claims: Value = claims.iter().map(claim).collect();
    let lean = runs.lean.as_ref().map(|lean| cases(&lean.cases));
    json!({ "all_effects": cases(&runs.full), "claims": claims, "no_effects": lean, "steps": STEPS, "trains": cases(&runs.trains) })
}

/// Table of the instructions per step: a row for each effect, a column for each formulation and dimension. A cell has three numbers: left
/// out, switched off, switched on.
fn table(runs: &Runs) -> String {
    let mut columns: Vec<[&str; 2]> = Vec::new();
    for case in &runs.full {
        let [formulation, dimension, ..] = claims::words(case);
        if !columns.contains(&[formulation, dimension]) {
            columns.push([formulation, dimension]);
        }
    }
    let row = |cases: &[Case], name: &str, effect: &str, switches: &[&str]| {
        let cell = |column: &[&str; 2]| {
            let count = |switch: &&str| {
                let words = [column[0], column[1], effect, switch];
                let case = cases.iter().find(|case| claims::words(case) == words);
                case.map_or("-".to_owned(), |case| (case.instructions / STEPS).to_string())
            };
            switches.iter().map(count).collect::<Vec<_>>().join(" / ")
        };
        [name.to_owned()].into_iter().chain(columns.iter().map(cell)).collect()
    };
    let full = |effect: String| {
        let switches: &[&str] = if effect == GUIDE { &["on"] } else { &["out", "off", "on"] };
        row(&runs.full, &effect, &effect, switches)
    };
    let lean = runs.lean.as_ref();
    let lean = lean.map(|lean| row(&lean.cases, "none compiled", "spring-damper", &["out"]));
    let headings = columns.iter().map(|column| column.join(", "));
    let head: Vec<_> = ["effect".to_owned()].into_iter().chain(headings).collect();
    let effects = format::markdown(&head, lean.into_iter().chain(cases().into_iter().map(full)));
    format!("{effects}\n{}", of_trains(&runs.trains))
}

/// Table of the instructions per step of a Runge-Kutta method in the recursive formulation: wheels without gears and with them.
fn of_trains(trains: &[Case]) -> String {
    let head = ["wheels", "without gears", "with gears"].map(str::to_owned);
    let count = |name: &str, switch| {
        let case = claims::train(trains, name, switch);
        case.map_or("-".to_owned(), |n| (n / STEPS).to_string())
    };
    format::markdown(
        &head,
        TRAINS.map(|name| vec![name.to_owned(), count(name, "out"), count(name, "on")]),
    )
}

/// One line for each claim, followed by the comparisons that contradict it.
fn verdict(claims: &[Claim]) -> String {
    let mut text = String::new();
    for claim in claims {
        let word = if claim.holds() { "holds" } else { "FAILS" };
        text.push_str(&format!("{word}  {} ({} comparisons)\n", claim.text, claim.n_checked));
        for against in &claim.against {
            text.push_str(&format!("       {against}\n"));
        }
    }
    text
}

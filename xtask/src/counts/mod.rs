//! `cargo xtask counts`: what a step executes, by callgrind, and that what is absent costs nothing.
//!
//! The program `counts` is built three times: with all effects, without any, and with all but nothing inlined, so that
//! functions can be looked for by name. Callgrind is driven directly: its counts need no agreement of versions with a
//! library and its runner, and the function lists come with them.

mod callgrind;
mod claims;
mod json;

use crate::effects::{self, Listed};
use crate::process::{self, cargo};
use crate::summary::Outcome;
pub use callgrind::missing as missing_valgrind;
use callgrind::{Case, STEPS};
use claims::{Claim, Runs};
use std::fs;
use std::path::PathBuf;
use std::process::{Command, ExitCode};
/// Cases of a guide, which is there or not.
const GUIDE: &str = "guide";

/// The effects, and a guide.
fn cases() -> Vec<String> {
    effects::all().flat_map(Listed::cases).chain([GUIDE.to_owned()]).collect()
}

/// Runs the job by itself: prints the table, writes it as JSON.
#[allow(clippy::print_stdout, reason = "the table is what this job is for")]
pub fn counts() -> ExitCode {
    if let Some(left_out) = callgrind::missing("counts") {
        eprintln!("counts did not run: {}\n{}", left_out.why, left_out.remedy);
        return ExitCode::FAILURE;
    }
    let (runs, claims) = match count() {
        Ok(done) => done,
        Err(why) => {
            eprintln!("counts failed: {why}");
            return ExitCode::FAILURE;
        }
    };
    print!("{}\n{}", table(&runs), verdict(&claims));
    let path = folder().join("counts.json");
    match fs::write(&path, json::text(&runs, &claims)) {
        Ok(()) => eprintln!("\nwritten to {}", path.display()),
        Err(e) => eprintln!("\n{}: {e}", path.display()),
    }
    if claims.iter().all(Claim::holds) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The claims as a check.
///
/// # Errors
///
/// The claims that do not hold, or what could not be built or run.
pub(crate) fn check() -> Result<Outcome, String> {
    if let Some(left_out) = callgrind::missing("counts") {
        return Ok(Outcome::LeftOut(left_out));
    }
    let (runs, claims) = count()?;
    if claims.iter().all(Claim::holds) {
        let n: usize = claims.iter().map(|claim| claim.n_checked).sum();
        Ok(Outcome::Passed(format!("{} cases, {n} comparisons", runs.full.len())))
    } else {
        Err(format!("\n{}", verdict(&claims)))
    }
}

/// Builds and runs.
fn count() -> Result<(Runs, Vec<Claim>), String> {
    let counted = |profile, features: &[&str], steps: u64, effects: &[String]| {
        let args: Vec<_> = [steps.to_string()].into_iter().chain(effects.to_vec()).collect();
        callgrind::run(&build(profile, features)?, &args, &folder().join("callgrind"))
    };
    let runs = Runs {
        full: counted("dist", &[], STEPS, &cases())?,
        lean: counted("dist", &["--no-default-features"], STEPS, &["spring-damper".to_owned()])?,
        refusals: refusals()?,
        plain: counted("plain", &[], 1, &["bumper".to_owned(), GUIDE.to_owned()])?,
    };
    let claims = claims::all(&runs);
    Ok((runs, claims))
}

/// What the build without effects says to each that has a feature: effect, feature, message.
fn refusals() -> Result<Vec<[String; 3]>, String> {
    let program = build("dist", &["--no-default-features"])?;
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

/// Builds the program; each build takes the place of the one before it.
fn build(profile: &str, features: &[&str]) -> Result<PathBuf, String> {
    let mut command = cargo();
    command.args(["build", "--quiet", "--package", "counts", "--profile", profile]).args(features);
    command.arg("--target-dir").arg(folder());
    // Names with their generic arguments; and loops that do not ask at run time which of two buffers comes first in memory,
    // as vectorised ones do: that is the allocator's affair.
    command.env("RUSTFLAGS", "-C symbol-mangling-version=v0 -C no-vectorize-loops");
    process::run(command.current_dir(process::root()))?;
    Ok(folder().join(profile).join("counts"))
}

fn folder() -> PathBuf {
    process::target_dir().join("counts")
}

/// Instructions of a step: one row for each effect, one column for each formulation and dimension; left out / switched off / on.
fn table(runs: &Runs) -> String {
    let mut columns: Vec<[&str; 2]> = Vec::new();
    for case in &runs.full {
        let [formulation, dimension, ..] = claims::words(case);
        if !columns.contains(&[formulation, dimension]) {
            columns.push([formulation, dimension]);
        }
    }
    let headings: Vec<_> = columns.iter().map(|column| column.join(", ")).collect();
    let mut text = format!("| effect | {} |\n", headings.join(" | "));
    text.push_str(&format!("|---|{}\n", "---|".repeat(columns.len())));
    let mut push = |cases: &[Case], name: &str, effect: &str, switches: &[&str]| {
        let cell = |column: &[&str; 2]| {
            let count = |switch: &&str| {
                let words = [column[0], column[1], effect, switch];
                let case = cases.iter().find(|case| claims::words(case) == words);
                case.map_or("-".to_owned(), |case| (case.instructions / STEPS).to_string())
            };
            switches.iter().map(count).collect::<Vec<_>>().join(" / ")
        };
        let cells: Vec<_> = columns.iter().map(cell).collect();
        text.push_str(&format!("| {name} | {} |\n", cells.join(" | ")));
    };
    push(&runs.lean, "none compiled", "spring-damper", &["out"]);
    for effect in cases() {
        let switches: &[&str] = if effect == GUIDE { &["on"] } else { &["out", "off", "on"] };
        push(&runs.full, &effect, &effect, switches);
    }
    text
}

/// One line for each claim, then what contradicts it.
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

//! `cargo xtask counts`: what a step executes, by callgrind, and that what is absent costs nothing.
//!
//! The program `counts` is built three times: with all effects, without any, and with all but nothing inlined, so that
//! functions can be looked for by name. Callgrind is driven directly: its counts need no agreement of versions with a
//! library and its runner, and the function lists come with them.

mod callgrind;
mod claims;

use crate::process::{self, cargo, run};
use crate::summary::Outcome;
use claims::{Claim, Runs};
use serde_json::{Value, json};
use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;

/// Steps counted in each case.
const STEPS: u64 = 10;
/// Cases of the run that looks at names.
const BY_NAME: [&str; 3] = ["none", "spring-damper on", "guide on"];

/// Runs the job by itself: prints the table, writes it as JSON.
#[allow(clippy::print_stdout, reason = "the table is what this job is for")]
pub(crate) fn counts() -> ExitCode {
    if let Some(left_out) = callgrind::missing() {
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
    match fs::write(&path, format!("{:#}\n", as_json(&runs, &claims))) {
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
    if let Some(left_out) = callgrind::missing() {
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
    let steps = STEPS.to_string();
    let all = [&steps[..]];
    let by_name: Vec<&str> = ["1"].into_iter().chain(BY_NAME).collect();
    let counted = |profile: &str, features: &[&str], args: &[&str], name: &str| {
        callgrind::run(&build(profile, features)?, args, &folder().join(name))
    };
    let runs = Runs {
        full: counted("release", &[], &all, "full")?,
        lean: counted("release", &["--no-default-features"], &all, "lean")?,
        plain: counted("plain", &[], &by_name, "plain")?,
    };
    let claims = claims::all(&runs);
    Ok((runs, claims))
}

/// Builds the program; each build takes the place of the one before it.
fn build(profile: &str, features: &[&str]) -> Result<PathBuf, String> {
    let mut command = cargo();
    command.args(["build", "--quiet", "--package", "counts", "--profile", profile]).args(features);
    command.arg("--target-dir").arg(folder());
    // Names with their generic arguments.
    command.env("RUSTFLAGS", "-C symbol-mangling-version=v0");
    run(command.current_dir(process::root()))?;
    Ok(folder().join(profile).join("counts"))
}

fn folder() -> PathBuf {
    process::target_dir().join("counts")
}

/// Instructions of a step: one row for each effect, one column for each formulation and dimension.
fn table(runs: &Runs) -> String {
    let mut columns: Vec<[&str; 2]> = Vec::new();
    let mut rows: Vec<[&str; 2]> = Vec::new();
    for case in &runs.full {
        let [formulation, dimension, effect, switch] = claims::words(case);
        if !columns.contains(&[formulation, dimension]) {
            columns.push([formulation, dimension]);
        }
        if !rows.contains(&[effect, switch]) {
            rows.push([effect, switch]);
        }
    }
    let mut text = String::from("| effect |");
    for column in &columns {
        text.push_str(&format!(" {} |", column.join(", ")));
    }
    text.push_str(&format!("\n|---|{}\n", "---|".repeat(columns.len())));
    let cell = |cases: &[callgrind::Case], [formulation, dimension]: [&str; 2], row: [&str; 2]| {
        let case = cases
            .iter()
            .find(|case| claims::words(case) == [formulation, dimension, row[0], row[1]]);
        case.map_or("-".to_owned(), |case| (case.instructions / STEPS).to_string())
    };
    let mut push = |cases: &[callgrind::Case], name: String, row: [&str; 2]| {
        text.push_str(&format!("| {name} |"));
        for &column in &columns {
            text.push_str(&format!(" {} |", cell(cases, column, row)));
        }
        text.push('\n');
    };
    push(&runs.lean, "none, and none compiled".to_owned(), ["none", ""]);
    for &row in &rows {
        push(&runs.full, row.join(" ").trim().to_owned(), row);
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

/// Everything counted.
fn as_json(runs: &Runs, claims: &[Claim]) -> Value {
    let cases = |cases: &[callgrind::Case]| -> Vec<Value> {
        let value = |case: &callgrind::Case| json!({ "case": case.name, "instructions": case.instructions, "copies": case.copies });
        cases.iter().map(value).collect()
    };
    let claims: Vec<_> = claims
        .iter()
        .map(|claim| {
            json!({ "claim": claim.text, "holds": claim.holds(), "comparisons": claim.n_checked,
                    "against": claim.against })
        })
        .collect();
    json!({ "steps": STEPS, "all_effects": cases(&runs.full), "no_effects": cases(&runs.lean), "claims": claims })
}

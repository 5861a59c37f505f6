//! The command `runner gauntlet`. `run COUNT FIRST STRIDE` runs the cases of these numbers, and prints a line of JSON for each. Before each
//! run it prints a line, so that the caller knows which run hangs. `show FAMILY SEED` prints the scene of a case and its settings. `one
//! FAMILY SEED` prints the verdicts on a case.

use super::families::Family;
use super::judge::{Verdict, judge};
use super::run::{keep_panics, methods};
use super::schedule::{cases, family};
use serde_json::{Value, json};
use std::io::Write;

/// Runs the job that the words name.
///
/// # Errors
///
/// The usage of the command.
pub fn run(words: &[String]) -> Result<(), String> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["run", numbers @ ..] => cases_of(numbers),
        ["show", name, seed] => of(name, seed).map(|(family, seed)| show(family, seed)),
        ["one", name, seed] => of(name, seed).map(|(family, seed)| {
            keep_panics();
            print_line(&verdicts_of((family, seed), &mut |_| {}).to_string());
        }),
        _ => Err(
            "usage: runner gauntlet run COUNT FIRST STRIDE | show FAMILY SEED | one FAMILY SEED"
                .to_owned(),
        ),
    }
}

fn of(name: &str, seed: &str) -> Result<(&'static Family, u64), String> {
    let family = family(name).ok_or_else(|| format!("there is no family `{name}`"))?;
    Ok((family, number(seed)?))
}

fn number(text: &str) -> Result<u64, String> {
    text.parse().map_err(|e| format!("`{text}`: {e}"))
}

/// Prints a line of output. An error is ignored, since the reader may have closed its end.
fn print_line(line: &str) {
    let mut out = std::io::stdout().lock();
    let _ = writeln!(out, "{line}").and_then(|()| out.flush());
}

fn show(family: &Family, seed: u64) {
    let case = family.case(seed);
    print_line(&format!(
        "# step {:e} s, {:?}, judged by {:?}\n{}",
        case.step, case.options, case.truth, case.scene
    ));
}

fn cases_of(numbers: &[&str]) -> Result<(), String> {
    let [count, first, stride] = numbers else { return Err("run COUNT FIRST STRIDE".to_owned()) };
    let as_usize = |text: &str| usize::try_from(number(text)?).map_err(|e| e.to_string());
    let (count, first, stride) = (as_usize(count)?, as_usize(first)?, as_usize(stride)?.max(1));
    keep_panics();
    for (k, case) in cases(count).enumerate().skip(first).step_by(stride) {
        let mut line = verdicts_of(case, &mut |about| print_line(&format!("begin {k} {about}")));
        line["number"] = json!(k);
        print_line(&line.to_string());
    }
    Ok(())
}

/// Runs a case with all methods. Returns the verdicts.
fn verdicts_of((family, seed): (&Family, u64), about: &mut dyn FnMut(&str)) -> Value {
    let case = family.case(seed);
    let verdicts: serde_json::Map<String, Value> = judge(&case, about)
        .into_iter()
        .map(|(method, verdict)| (method.to_owned(), of_verdict(&verdict)))
        .collect();
    json!({ "family": family.name, "property": family.property, "seed": seed, "step": case.step, "methods": methods().collect::<Vec<_>>(), "verdicts": verdicts })
}

fn of_verdict(verdict: &Verdict) -> Value {
    match verdict {
        Verdict::Right(error) => json!({ "is": "right", "error": error }),
        Verdict::Coarse(error) => json!({ "is": "coarse", "error": error }),
        Verdict::Apart(error) => json!({ "is": "apart", "error": error }),
        Verdict::Kept => json!({ "is": "kept" }),
        Verdict::Unjudged => json!({ "is": "unjudged" }),
        Verdict::Stopped(code, time) => json!({ "is": "stopped", "code": code, "time": time }),
        Verdict::Wrong(why) => json!({ "is": "wrong", "why": why }),
    }
}

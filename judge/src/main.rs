//! The command `judge` runs scenes. With `--seeds A..B [--formulation F]` it runs random scenes by their seeds through the crates and
//! compares them with the judge. With `--cases [STRIDE]` it does so for the enumerated scenes. `--scene` prints the scene of a seed or a
//! case. `--look` prints the channels of such a scene that differ.

use judge::random;
use judge::trial::{self, Way};
use std::fmt::Write as _;
use std::io::Write as _;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |key: &str| {
        arguments.iter().position(|a| a == key).and_then(|i| arguments.get(i + 1)).cloned()
    };
    let (only, integrator) = (value("--formulation"), value("--integrator"));
    let out = &mut std::io::stdout();
    if let Some(name) = value("--scene") {
        let _ = match drawn(&name) {
            Some(drawn) => {
                writeln!(out, "# step {:?}, {} steps\n{}", drawn.step, drawn.steps, drawn.text)
            }
            None => writeln!(out, "no case of this name"),
        };
        return ExitCode::SUCCESS;
    }
    if let Some(name) = value("--look") {
        let is_asked = |[f, i]: &Way| {
            only.as_deref().unwrap_or("index-3") == *f
                && integrator.as_deref().unwrap_or("trapezoidal") == *i
        };
        let method = trial::oracle::methods()
            .into_iter()
            .find(is_asked)
            .unwrap_or(trial::seeds::methods()[0]);
        let share = value("--share").and_then(|s| s.parse().ok()).unwrap_or(1);
        let text =
            drawn(&name).map_or("no case of this name".to_owned(), |d| look(&d, method, share));
        let _ = write!(out, "{text}");
        return ExitCode::SUCCESS;
    }
    // a panic of a run is a verdict, and its message is not printed
    std::panic::set_hook(Box::new(|_| {}));
    if arguments.iter().any(|a| a == "--cases") {
        return cases(value("--cases").and_then(|s| s.parse().ok()).unwrap_or(1));
    }
    let seeds = value("--seeds").unwrap_or_else(|| "1..100".to_owned());
    let Some((first, last)) =
        seeds.split_once("..").and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)))
    else {
        eprintln!(
            "usage: judge --seeds A..B [--formulation F] [--integrator I] [--scene SEED|CASE] [--look SEED|CASE] [--cases [STRIDE]]"
        );
        return ExitCode::FAILURE;
    };
    let mut tally = trial::seeds::Tally::default();
    for seed in first..=last {
        let lines = tally.add(seed, only.as_deref());
        let _ = write!(out, "{lines}");
    }
    let _ = write!(out, "{}", tally.text());
    ExitCode::from(u8::from(tally.differences > 0))
}

/// Runs every `stride`-th case in every method.
fn cases(stride: usize) -> ExitCode {
    let cases: Vec<_> = random::cases().into_iter().step_by(stride.max(1)).collect();
    let tally = trial::oracle::all(&cases);
    let out = &mut std::io::stdout();
    for line in &tally.wrong {
        let _ = writeln!(out, "{line}");
    }
    let n = tally.agree + tally.wrong.len() + tally.left_out.values().sum::<usize>();
    let (agree, wrong) = (tally.agree, tally.wrong.len());
    let _ =
        writeln!(out, "{} cases, {n} combinations: {agree} agree, {wrong} are wrong", cases.len());
    for (reason, n) in &tally.left_out {
        let _ = writeln!(out, "{n} left out: {reason}");
    }
    ExitCode::from(u8::from(!tally.wrong.is_empty()))
}

/// The scene of a seed, or of a case by its name.
fn drawn(name: &str) -> Option<random::Drawn> {
    if let Ok(seed) = name.parse() {
        return Some(random::scene(seed));
    }
    let case = random::cases().into_iter().find(|case| case.name == name)?;
    Some(random::Drawn { text: case.text, step: case.step, steps: random::STEPS })
}

/// Channels of a scene that differ by more than `1e-7` of their size, with the values of the crates and of the judge. The crates run with
/// the scene's step divided by `share`.
fn look(drawn: &random::Drawn, method: Way, share: u32) -> String {
    let mut out = random::kinds(&drawn.text).join(", ");
    let (judged, product) =
        match (trial::judge(&drawn.text, drawn.step, drawn.steps), trial::product(&drawn.text)) {
            (Ok(judged), Ok(product)) => (judged, product),
            (Err(why), _) | (_, Err(why)) => return why,
        };
    let rows = match trial::rows(&product, method, (drawn.step, drawn.steps), share) {
        Ok(rows) => rows,
        Err(verdict) => return format!("{out}\n{verdict:?}\n"),
    };
    for (i, (row, right)) in rows.iter().zip(&judged.rows).enumerate() {
        let _ = writeln!(out, "\nrow {i}");
        for part in trial::parts(&judged) {
            let output = &judged.mechanism.scene.outputs[part.output];
            let (found, right) = (&row[part.components.clone()], &right[part.components.clone()]);
            let size = right.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
            let off = found.iter().zip(right).fold(0.0_f64, |a, (x, y)| a.max((x - y).abs()));
            if off > 1e-7 * size {
                let _ =
                    writeln!(out, "{:16} {off:.1e} off: {found:?}, judge {right:?}", output.name);
            }
        }
    }
    out
}

//! The job `cargo xtask choice`: checks the choice of a method by `mbs run --error`. For every scene and three errors, the chosen method is
//! compared with the best of all methods.

use crate::format;
use serde_json::Value;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use xtask::child::watched;
use xtask::command::built;
use xtask::process;

/// Largest ratio of the chosen method's time to the best time at which the choice is good [-].
const GOOD: f64 = 1.3;
/// Least fraction of good choices [-]: a requirement.
const GOOD_SHARE: f64 = 0.9;
/// Largest ratio of any choice's time to the best time [-]: a requirement.
const WORST: f64 = 3.0;
/// Duration of a run above which the time of the pilot counts too [s].
const LONG: f64 = 1.0;
/// Time limits of the comparison: for all its runs, and CPU time of one run [s].
const EFFORT: [&str; 4] = ["--budget", "12", "--time-limit", "4"];
const ERRORS: &str = "1e-2,1e-4,1e-6";

/// A choice, as `mbs compare --choice` reports it.
#[derive(Debug, Clone, PartialEq)]
struct Row {
    scene: String,
    error: f64,
    method: String,
    true_error: Option<f64>,
    /// The error that the pilot expects. It exceeds the required error if the pilot reports that this one may not be reached.
    expected: Option<f64>,
    seconds: Option<f64>,
    pilot: f64,
    best: Option<(String, f64)>,
    stopped: usize,
}

impl Row {
    /// Ratio of the choice's time to the best time. The pilot counts for long runs.
    fn over_best(&self) -> Option<f64> {
        let (seconds, (_, best)) = (self.seconds?, self.best.as_ref()?);
        let pilot = if *best > LONG { self.pilot } else { 0.0 };
        Some((seconds + pilot) / best)
    }

    /// True if the error is larger than the required one, without a warning by the pilot.
    fn is_missed(&self) -> bool {
        let is_larger = |e: Option<f64>| e.is_some_and(|e| e > self.error);
        is_larger(self.true_error) && !is_larger(self.expected)
    }

    /// True if the choice is good: within the factor `GOOD`, and not stopped. `None` without a best method.
    fn is_good(&self) -> Option<bool> {
        self.best.as_ref()?;
        Some(self.stopped == 0 && self.over_best().is_some_and(|q| q <= GOOD))
    }
}

/// Measures all scenes, or the named ones. Returns whether nine in ten choices are good and no choice stopped.
///
/// # Errors
///
/// The reason why nothing can be measured.
#[allow(clippy::print_stdout, reason = "the table is what is asked for")]
pub(crate) fn choice(names: &[String]) -> Result<bool, String> {
    let mbs = built()?;
    let (mut rows, mut failed, mut text) = (Vec::new(), Vec::new(), String::new());
    let folder = process::target_dir().join("choice");
    for scene in scenes(names)? {
        let name = scene.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        process::progress(&name);
        match measure(&mbs, &scene, &name) {
            Ok(found) => rows.extend(found),
            Err(why) => failed.push(format!("{name} was not measured: {why}")),
        }
        // results are written after each scene, so that an interrupted job leaves them
        text = table(&rows) + &failed.join("\n");
        process::write(&folder.join("choice.txt"), text.as_bytes())?;
        process::write(&folder.join("choice.csv"), &csv(&rows)?)?;
    }
    process::progress("");
    println!("{text}");
    Ok(verdict(&rows) && failed.is_empty())
}

/// The scene files, in the order of their names.
pub(crate) fn scenes(names: &[String]) -> Result<Vec<PathBuf>, String> {
    if !names.is_empty() {
        return Ok(names.iter().map(|name| crate::mbs::scene(name)).collect());
    }
    let folder = process::root().join("scenes");
    let files = std::fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let paths = files.filter_map(|file| Some(file.ok()?.path()));
    let mut scenes: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|end| end == "toml")).collect();
    scenes.sort();
    Ok(scenes)
}

fn measure(mbs: &Path, scene: &Path, name: &str) -> Result<Vec<Row>, String> {
    let mut command = Command::new(mbs);
    command.args(["compare", "--choice", "--json", "--no-maps", "--precision", "f64"]);
    command.args(["--error", ERRORS, "--repeats", "3"]).args(EFFORT).arg(scene);
    let output = watched(&mut command, None)?.ok_or("a comparison without an end")?;
    let value: Value = serde_json::from_slice(&output.stdout).map_err(|e| {
        let errors = String::from_utf8_lossy(&output.stderr);
        format!("`{}`: {e}: {errors}", process::line(&command))
    })?;
    let choices = value.get("choices").and_then(Value::as_array).cloned().unwrap_or_default();
    Ok(choices.iter().map(|choice| row(choice, name)).collect())
}

fn row(choice: &Value, scene: &str) -> Row {
    let number = |key: &str| choice.get(key).and_then(Value::as_f64);
    let text = |key: &str| choice.get(key).and_then(Value::as_str).unwrap_or_default().to_owned();
    let best = number("best_seconds").map(|seconds| (text("best_method"), seconds));
    Row {
        scene: scene.to_owned(),
        error: number("error").unwrap_or_default(),
        method: text("method"),
        true_error: number("true_error"),
        expected: number("predicted_error"),
        seconds: number("cpu_seconds"),
        pilot: number("pilot_seconds").unwrap_or_default(),
        best,
        stopped: choice.get("stopped").and_then(Value::as_array).map_or(0, Vec::len),
    }
}

fn table(rows: &[Row]) -> String {
    let mut text = String::new();
    let ms = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), |x| format!("{:.3}", 1e3 * x));
    let mut line = |cells: [&str; 8]| {
        let [scene, error, method, found, time, best, quotient, why] = cells;
        let _ = writeln!(
            text,
            "{scene:<26} {error:>6} {method:<34} {found:>9} {time:>10} {best:>10} {quotient:>6}  {why}"
        );
    };
    line([
        "scene",
        "wanted",
        "chosen",
        "error",
        "CPU [ms]",
        "best [ms]",
        "over",
        "the best; the pilot",
    ]);
    for r in rows {
        let why = match (&r.best, r.stopped) {
            (_, n) if n > 0 => format!("{n} stopped before"),
            (Some((best, _)), _) => format!("{best}; {:.0} ms", 1e3 * r.pilot),
            (None, _) => "no method reaches it, or the reference is too coarse".to_owned(),
        };
        line([
            &r.scene,
            &format!("{:.0e}", r.error),
            &r.method,
            &r.true_error.map_or_else(|| "-".to_owned(), |e| format!("{e:.1e}")),
            &ms(r.seconds),
            &ms(r.best.as_ref().map(|(_, seconds)| *seconds)),
            &r.over_best().map_or_else(|| "-".to_owned(), |q| format!("{q:.2}")),
            &why,
        ]);
    }
    for error in levels(rows) {
        let of = || rows.iter().filter(|r| (r.error / error - 1.0).abs() < 1e-9);
        let judged: Vec<bool> = of().filter_map(Row::is_good).collect();
        let good = judged.iter().filter(|is| **is).count();
        let held = of().filter(|r| r.best.is_some() && r.true_error.is_some_and(|e| e <= r.error));
        let _ = writeln!(
            text,
            "error {error:.0e}: {good} of {} within {GOOD} of the best; the wanted error held on {}",
            judged.len(),
            held.count()
        );
    }
    let stopped: usize = rows.iter().map(|r| r.stopped).sum();
    let missed = rows.iter().filter(|r| r.is_missed()).count();
    let largest = rows.iter().filter_map(Row::over_best).fold(0.0, f64::max);
    let _ = writeln!(text, "choices that stopped: {stopped}");
    let _ = writeln!(text, "errors missed and not announced: {missed}");
    let _ = writeln!(text, "largest quotient: {largest:.2}");
    text
}

fn levels(rows: &[Row]) -> Vec<f64> {
    let mut levels: Vec<f64> = rows.iter().map(|r| r.error).collect();
    levels.sort_by(|a, b| b.total_cmp(a));
    levels.dedup();
    levels
}

/// True if a large enough fraction of choices is good, no choice takes much longer than the best, and no choice stopped.
fn verdict(rows: &[Row]) -> bool {
    let judged: Vec<bool> = rows.iter().filter_map(Row::is_good).collect();
    let good = judged.iter().filter(|is| **is).count();
    #[allow(clippy::cast_precision_loss, reason = "counts of scenes")]
    let share = good as f64 / judged.len().max(1) as f64;
    let is_near = |r: &Row| r.over_best().is_none_or(|q| q <= WORST);
    share >= GOOD_SHARE && rows.iter().all(|r| r.stopped == 0 && is_near(r))
}

fn csv(rows: &[Row]) -> Result<Vec<u8>, String> {
    let number = |x: Option<f64>| x.map(|x| format!("{x:e}")).unwrap_or_default();
    let record = |r: &Row| {
        let (best, seconds) = r.best.clone().unzip();
        vec![
            r.scene.clone(),
            number(Some(r.error)),
            r.method.clone(),
            number(r.true_error),
            number(r.seconds),
            number(Some(r.pilot)),
            best.unwrap_or_default(),
            number(seconds),
            number(r.over_best()),
            r.stopped.to_string(),
        ]
    };
    let head = "scene,wanted_error,chosen,error,cpu_seconds,pilot_seconds,best,best_seconds,over_best,stopped";
    format::csv(head, rows.iter().map(record))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(seconds: f64, best: f64, pilot: f64) -> Row {
        Row {
            scene: "s".into(),
            error: 1e-4,
            method: "m".into(),
            true_error: Some(1e-5),
            expected: Some(1e-5),
            seconds: Some(seconds),
            pilot,
            best: Some(("b".into(), best)),
            stopped: 0,
        }
    }

    #[test]
    fn the_pilot_counts_in_long_runs_alone_and_a_stop_is_never_good() {
        assert_eq!(of(1.2e-3, 1e-3, 0.2).is_good(), Some(true));
        assert_eq!(of(2.4, 2.0, 0.15).is_good(), Some(true));
        assert_eq!(of(2.4, 2.0, 0.25).is_good(), Some(false));
        assert_eq!(Row { stopped: 1, ..of(1.0, 1.0, 0.0) }.is_good(), Some(false));
        assert_eq!(Row { best: None, ..of(1.0, 1.0, 0.0) }.is_good(), None);
    }

    #[test]
    fn nine_in_ten_pass_and_fewer_do_not() {
        let mut rows = vec![of(1.0, 1.0, 0.0); 9];
        rows.push(of(2.0, 1.0, 0.0));
        assert!(verdict(&rows));
        rows.push(of(2.0, 1.0, 0.0));
        assert!(!verdict(&rows));
        assert!(table(&rows).contains("error 1e-4: 9 of 11 within 1.3"), "{}", table(&rows));
    }

    #[test]
    fn one_that_takes_far_longer_does_not_pass_and_a_missed_error_is_counted_where_it_is_not_announced()
     {
        let mut rows = vec![of(1.0, 1.0, 0.0); 99];
        rows.push(of(3.1, 1.0, 0.0));
        assert!(!verdict(&rows));
        let missed = Row { true_error: Some(2e-4), ..of(1.0, 1.0, 0.0) };
        assert!(missed.is_missed());
        assert!(!Row { expected: Some(2e-4), ..missed }.is_missed());
    }
}

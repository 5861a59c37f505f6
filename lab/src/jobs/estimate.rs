//! `cargo xtask estimate`: are the errors that `mbs run` states those that it has? Every scene, against a run of order 8 with a tolerance near rounding.

use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use xtask::child::watched;
use xtask::command::built;
use xtask::process;

/// Largest ratio of a stated error to its estimate [-].
const STATED: f64 = 3.0;
/// Least fraction of the components that are good [-]: what is promised.
const GOOD_SHARE: f64 = 0.95;
/// The median of the quotients lies between its inverse and this.
const MEDIAN: f64 = 10.0;
/// Share of the scenes that may have no estimate.
const NONE: f64 = 0.05;
/// Tolerances of the reference, from the finest that runs.
const TOLERANCES: [&str; 2] = ["1e-12", "1e-10"];
/// Errors below this share of what an output is are rounding of the reference.
const ROUNDING: f64 = 1e-11;

/// What was found of a scene.
struct Row {
    scene: String,
    /// True errors over the estimates.
    ratios: Vec<f64>,
    /// CPU time of the looks over that of the steps.
    share: f64,
    basis: Result<String, String>,
}

/// Measures all scenes, or those named; says whether the estimates are of the size of the errors.
///
/// # Errors
///
/// Why nothing can be measured.
#[allow(clippy::print_stdout, reason = "the table is what is asked for")]
pub(crate) fn estimate(names: &[String]) -> Result<bool, String> {
    let mbs = built()?;
    let mut rows = Vec::new();
    for scene in crate::choice::scenes(names)? {
        let name = scene.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        process::progress(&name);
        rows.push(measure(&mbs, &scene, name)?);
    }
    process::progress("");
    let (text, is_good) = table(&rows);
    process::write(&process::target_dir().join("estimate/estimate.txt"), text.as_bytes())?;
    println!("{text}");
    Ok(is_good)
}

fn measure(mbs: &Path, scene: &Path, name: String) -> Result<Row, String> {
    let folder = process::target_dir().join("estimate").join(&name);
    let [of_run, of_reference] = ["run", "reference"].map(|part| folder.join(part));
    command(mbs, scene, &of_run, &[])?;
    let text = std::fs::read_to_string(of_run.join("run.json")).map_err(|e| e.to_string())?;
    let summary: Value = serde_json::from_str(&text).map_err(|e| e.to_string())?;
    let estimate = &summary["estimate"];
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let share = number(&estimate["cpu_seconds"]) / number(&summary["cpu_seconds"]);
    let text = |key: &str| estimate[key].as_str().map(str::to_owned);
    let basis = text("basis").ok_or_else(|| text("missing").unwrap_or_default());
    let mut row = Row { scene: name, ratios: Vec::new(), share, basis };
    let Some(outputs) = estimate["outputs"].as_object() else { return Ok(row) };
    let mut stated = BTreeMap::new();
    let mut used: BTreeMap<&String, usize> = BTreeMap::new();
    for column in csv(&of_run)?.0 {
        // `tip.x` is a component of `tip`, unless an output has this name
        let is_of = |name: &&String| {
            column.strip_prefix(*name).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        let Some(name) = outputs.keys().filter(is_of).max_by_key(|name| name.len()) else {
            continue;
        };
        let k = used.entry(name).or_default();
        let value = match &outputs[name] {
            Value::Array(several) => several.get(*k).map_or(f64::NAN, number),
            one => number(one),
        };
        *k += 1;
        stated.insert(column, value);
    }
    let step = number(&summary["step"]).to_string();
    for tolerance in TOLERANCES {
        let options = ["--formulation", "recursive", "--integrator", "rk853", "--step", &step];
        let is_whole = command(
            mbs,
            scene,
            &of_reference,
            &[&options[..], &["--no-estimate", "--tolerance", tolerance]].concat(),
        )?;
        if is_whole {
            break;
        }
    }
    row.ratios = ratios(&of_run, &of_reference, &stated)?;
    Ok(row)
}

/// Runs the command; says whether the run was completed.
fn command(mbs: &Path, scene: &Path, out: &Path, options: &[&str]) -> Result<bool, String> {
    let mut command = Command::new(mbs);
    command.arg("run").arg(scene).arg("--json").arg("--out").arg(out).args(options);
    Ok(watched(&mut command, None)?.is_some_and(|output| output.status.success()))
}

/// Names of the columns after the time, and the rows by their times in nanoseconds.
type Table = (Vec<String>, BTreeMap<u64, Vec<f64>>);

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "times of a run")]
fn csv(folder: &Path) -> Result<Table, String> {
    let path: PathBuf = folder.join("run.csv");
    let mut reader =
        csv::Reader::from_path(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let names = reader.headers().map_err(|e| e.to_string())?.iter().skip(1).map(str::to_owned);
    let (names, mut rows) = (names.collect(), BTreeMap::new());
    for record in reader.records() {
        let record = record.map_err(|e| e.to_string())?;
        let numbers: Vec<f64> = record.iter().filter_map(|cell| cell.parse().ok()).collect();
        if let [t, values @ ..] = &numbers[..] {
            rows.insert((t * 1e9).round() as u64, values.to_vec());
        }
    }
    Ok((names, rows))
}

/// True errors over the stated ones, at the instants that both have.
fn ratios(
    of_run: &Path,
    of_reference: &Path,
    stated: &BTreeMap<String, f64>,
) -> Result<Vec<f64>, String> {
    let ((names, run), (_, reference)) = (csv(of_run)?, csv(of_reference)?);
    let both: Vec<_> = run.iter().filter_map(|(t, row)| Some((row, reference.get(t)?))).collect();
    if both.len() < 3 {
        return Ok(Vec::new());
    }
    let ratio = |(c, name): (usize, &String)| {
        let largest = |of: &dyn Fn(&Vec<f64>, &Vec<f64>) -> f64| {
            both.iter().map(|(a, b)| of(a, b)).fold(0.0, f64::max)
        };
        let error = largest(&|a, b| (a[c] - b[c]).abs());
        let size = largest(&|a, _| a[c].abs());
        let stated = stated.get(name)?;
        (error > ROUNDING * size.max(1e-3)).then(|| error / stated)
    };
    Ok(names.iter().enumerate().filter_map(ratio).collect())
}

fn table(rows: &[Row]) -> (String, bool) {
    let mut text = String::new();
    let mut all = Vec::new();
    for row in rows {
        let mut ratios = row.ratios.clone();
        ratios.sort_by(f64::total_cmp);
        all.extend(&ratios);
        let at = |share: usize| {
            ratios.get((ratios.len() * share / 100).min(ratios.len().saturating_sub(1)))
        };
        let cell = |x: Option<&f64>| x.map_or_else(|| "-".to_owned(), |x| format!("{x:.2}"));
        let basis = row.basis.clone().unwrap_or_else(|why| format!("no estimate: {why}"));
        let _ = writeln!(
            text,
            "{:<26} {:>3} components  true/stated {:>8} {:>8} {:>8}  {:>4.0} % of the steps' time  {basis}",
            row.scene,
            ratios.len(),
            cell(at(0)),
            cell(at(50)),
            cell(at(100)),
            100.0 * row.share
        );
    }
    all.sort_by(f64::total_cmp);
    let stated = all.iter().filter(|ratio| **ratio <= STATED).count();
    let median = all.get(all.len() / 2).copied().unwrap_or(1.0);
    let none = rows.iter().filter(|row| row.basis.is_err()).count();
    let _ = writeln!(
        text,
        "{stated} of {} components err by no more than {STATED} times what is stated; median {median:.2}; {none} of {} scenes have no estimate",
        all.len(),
        rows.len()
    );
    #[allow(clippy::cast_precision_loss, reason = "small counts")]
    let share = |part: usize, whole: usize| part as f64 / whole.max(1) as f64;
    let is_good = share(stated, all.len()) >= GOOD_SHARE
        && (1.0 / MEDIAN..=MEDIAN).contains(&median)
        && share(none, rows.len()) <= NONE;
    (text, is_good)
}

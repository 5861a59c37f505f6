//! The job `cargo xtask estimate`: compares the errors that `mbs run` states with true errors. For every scene a complete and a short run
//! are compared with a run of order 8 with a tolerance near machine precision.

use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use xtask::child::watched;
use xtask::command::built;
use xtask::process;

/// Largest ratio of a stated error to the true one, or its inverse, for a good estimate [-]: a requirement for most components.
const STATED: f64 = 3.0;
/// Least fraction of components with a good estimate [-]: a requirement.
const GOOD_SHARE: f64 = 0.95;
/// Largest ratio of any true error to the stated one [-]: a requirement for all components.
const NONE_ABOVE: f64 = 10.0;
/// Durations of short runs, used alternately [s]: they take milliseconds.
const SHORT: [&str; 2] = ["0.05", "0.2"];
/// Formulations of short runs, used in turn.
const FORMULATIONS: [&str; 6] =
    ["index-3", "state-space", "index-1", "classical", "multi-index", "recursive"];
/// Time that an estimate may always take [s].
const ALWAYS: f64 = 0.1;
/// Largest time of an estimate relative to that of the steps [-], if this is more than [`ALWAYS`].
const LOOKS_SHARE: f64 = 0.3;
/// Largest energy error of the finer reference at which it is used, relative to that of the coarser one [-].
const BETTER: f64 = 0.1;
/// Tolerances of the reference. The coarser one is used if the finer run stops or has a larger energy error, as at a singular position.
const TOLERANCES: [&str; 2] = ["1e-12", "1e-10"];
/// Errors below this, relative to the size of an output, are rounding errors of the reference [-].
const ROUNDING: f64 = 1e-11;

/// Results for a scene.
struct Row {
    scene: String,
    /// Ratios of true errors to stated errors.
    ratios: Vec<f64>,
    /// CPU time of the steps and of the estimate [s].
    seconds: [f64; 2],
    basis: Result<String, String>,
}

/// Measures all scenes, or the named ones. Returns whether the estimates satisfy the requirements.
///
/// # Errors
///
/// The reason why nothing can be measured.
#[allow(clippy::print_stdout, reason = "the table is what is asked for")]
pub(crate) fn estimate(names: &[String]) -> Result<bool, String> {
    let mbs = built()?;
    let mut rows = Vec::new();
    let scenes = crate::choice::scenes(names)?;
    let name = |scene: &Path| scene.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    for scene in &scenes {
        process::progress(&name(scene));
        rows.extend(measure(&mbs, scene, (name(scene), &[]))?);
    }
    for (i, scene) in scenes.iter().enumerate() {
        let duration = SHORT[i % SHORT.len()];
        let formulation = FORMULATIONS[i % FORMULATIONS.len()];
        let what = format!("{} {formulation} {duration}", name(scene));
        process::progress(&what);
        let options = ["--duration", duration, "--formulation", formulation];
        rows.extend(measure(&mbs, scene, (what, &options))?);
    }
    process::progress("");
    let (text, is_good) = table(&rows);
    process::write(&process::target_dir().join("estimate/estimate.txt"), text.as_bytes())?;
    println!("{text}");
    Ok(is_good)
}

/// Makes a run with options and compares its estimate; `None` if the run stops.
fn measure(
    mbs: &Path,
    scene: &Path,
    (name, options): (String, &[&str]),
) -> Result<Option<Row>, String> {
    let folder = process::target_dir().join("estimate").join(&name);
    let [of_run, of_reference] = ["run", "reference"].map(|part| folder.join(part));
    if !command(mbs, scene, &of_run, options)? {
        return Ok(None);
    }
    let text = std::fs::read_to_string(of_run.join("run.json")).map_err(|e| e.to_string())?;
    let summary: Value = serde_json::from_str(&text).map_err(|e| e.to_string())?;
    let estimate = &summary["estimate"];
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let seconds = [&summary, estimate].map(|of| number(&of["cpu_seconds"]));
    let text = |key: &str| estimate[key].as_str().map(str::to_owned);
    let basis = text("basis").ok_or_else(|| text("missing").unwrap_or_default());
    let mut row = Row { scene: name, ratios: Vec::new(), seconds, basis };
    let Some(outputs) = estimate["outputs"].as_object() else { return Ok(Some(row)) };
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
    let duration: Vec<&str> = options.iter().take(2).copied().collect();
    let of_reference =
        reference(mbs, scene, &of_reference, &[&["--step", &step], &duration[..]].concat())?;
    row.ratios = match of_reference {
        Some(folder) => ratios(&of_run, &folder, &stated)?,
        None => Vec::new(),
    };
    Ok(Some(row))
}

/// The folder of the best reference whose run is completed.
fn reference(
    mbs: &Path,
    scene: &Path,
    folder: &Path,
    options: &[&str],
) -> Result<Option<PathBuf>, String> {
    let mut best: Option<(f64, PathBuf)> = None;
    for tolerance in TOLERANCES {
        let folder = folder.with_extension(tolerance);
        let method = ["--formulation", "recursive", "--integrator", "rk853", "--no-estimate"];
        let all = [&method[..], &["--tolerance", tolerance], options].concat();
        if !command(mbs, scene, &folder, &all)? {
            continue;
        }
        let text = std::fs::read_to_string(folder.join("run.json")).map_err(|e| e.to_string())?;
        let summary: Value = serde_json::from_str(&text).map_err(|e| e.to_string())?;
        let error = summary["energy"]["max_error"].as_f64().unwrap_or(f64::INFINITY);
        if best.as_ref().is_none_or(|(least, _)| error < BETTER * least) {
            best = Some((error, folder));
        }
    }
    Ok(best.map(|(_, folder)| folder))
}

/// Runs the command on a scene. Returns whether the run was completed.
fn command(mbs: &Path, scene: &Path, out: &Path, options: &[&str]) -> Result<bool, String> {
    let mut command = Command::new(mbs);
    command.arg("run").arg(scene).arg("--json").arg("--out").arg(out).args(options);
    Ok(watched(&mut command, None)?.is_some_and(|output| output.status.success()))
}

/// Names of the columns after the time, and rows by their times in nanoseconds.
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

/// Ratios of true errors to stated errors, at the times that both tables contain.
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
            100.0 * row.seconds[1] / row.seconds[0]
        );
    }
    let good = all.iter().filter(|x| (1.0 / STATED..=STATED).contains(*x)).count();
    let largest = all.iter().copied().fold(0.0, f64::max);
    let none = rows.iter().filter(|row| row.basis.is_err()).count();
    let sum = |i: usize| rows.iter().map(|row| row.seconds[i]).sum::<f64>();
    let is_long = |row: &&Row| row.seconds[1] > (LOOKS_SHARE * row.seconds[0]).max(ALWAYS);
    let long = rows.iter().filter(is_long).count();
    let _ = writeln!(
        text,
        "{good} of {} components have 1/{STATED} to {STATED} times the stated error, the largest {largest:.2} times; {none} of {} runs have no estimate\n\
         looks take {:.2} s beside {:.2} s of steps; {long} take more than {} % and {ALWAYS} s",
        all.len(),
        rows.len(),
        sum(1),
        sum(0),
        100.0 * LOOKS_SHARE
    );
    #[allow(clippy::cast_precision_loss, reason = "small counts")]
    let share = good as f64 / all.len().max(1) as f64;
    (text, share >= GOOD_SHARE && largest <= NONE_ABOVE && none == 0)
}

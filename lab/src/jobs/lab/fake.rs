//! Made-up runs for the tests of the experiments: their errors and times follow simple formulas.

use super::Lab;
use super::case::{Case, Rule};
use crate::mbs::outcome::{Control, Figures, Outcome};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Exchanged energy of every run [J].
const TURNED_OVER: f64 = 100.0;
/// CPU time of a step [s].
const PRICE: f64 = 1e-5;
/// Number of rows of a run.
const ROWS: usize = 600;

/// Calls a function with a lab of made-up runs.
pub(crate) fn with_lab(call: impl FnOnce(&Lab<'_>)) {
    lab(&|case, out| Ok(run(case, out)), call);
}

/// Calls a function with a lab whose runs support fixed steps only.
pub(crate) fn with_old_lab(call: impl FnOnce(&Lab<'_>)) {
    let runner = |case: &Case, out: Option<&Path>| {
        let is_fixed = case.rule == Rule::Fixed;
        let refused = "unexpected argument '--step-control' found";
        Ok(if is_fixed { run(case, out) } else { Outcome::Refused(refused.into()) })
    };
    lab(&runner, call);
}

fn lab(runner: &super::Runner<'_>, call: impl FnOnce(&Lab<'_>)) {
    static CALLS: AtomicUsize = AtomicUsize::new(0);
    let number = CALLS.fetch_add(1, Ordering::Relaxed);
    let folder = std::env::temp_dir().join(format!("mbs-steps-{}-{number}", std::process::id()));
    call(&Lab { runner, quick: true, folder: folder.clone() });
    // an error is ignored: the folder exists only if files were requested
    let _ = std::fs::remove_dir_all(folder);
}

/// Writes a page and a text to the folder that the environment names.
pub(crate) fn keep(page: &str, text: &str) {
    if let Some(folder) = std::env::var_os("MBS_FAKE_STEPS").map(PathBuf::from) {
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("steps.html"), page).unwrap();
        std::fs::write(folder.join("steps.txt"), text).unwrap();
    }
}

/// A made-up run, whose error is of second order in the usual step.
fn run(case: &Case, out: Option<&Path>) -> Outcome {
    let duration = case.duration.unwrap_or(6.0);
    let is_explicit = case.arguments.contains(&"rk54");
    if case.formulation == "absent" || (is_explicit && case.scene == "iltis-stairs") {
        return Outcome::Refused("the made-up vehicle has no tree".into());
    }
    if let ("index-3", Rule::Energy(tolerance)) = (case.formulation, case.rule)
        && tolerance < 5e-10
    {
        return Outcome::Stopped {
            code: "not-converged".into(),
            message: "no convergence within 20 iterations".into(),
            time: 1.25,
        };
    }
    let usual = match case.rule {
        Rule::Fixed => case.step,
        Rule::Energy(tolerance) | Rule::Printed(tolerance) => {
            2.0 * duration * tolerance.sqrt().min(0.02) / 6.0
        }
        Rule::Error(tolerance) | Rule::Both(tolerance) => duration * (0.003 * tolerance).cbrt(),
    };
    let usual = usual.min(case.largest);
    let size = usual / duration;
    let is_variable = case.rule != Rule::Fixed;
    let is_smooth = case.scene != "iltis-suspension-stiff";
    let help = if is_variable && is_smooth { 0.05 } else { 1.0 };
    let n_steps = duration / usual;
    let price = PRICE * if case.formulation == "index-1" { 2.0 } else { 1.0 };
    let error = if is_explicit { 1e-13 } else { 2e3 * help * size * size };
    if let Some(out) = out {
        write(out, case, usual, duration);
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "made-up counts")]
    let steps = n_steps as u64;
    let control = Control {
        rejected: steps / 20,
        steps: [0.02 * usual, case.largest],
        index_changes: 4,
        index_1_steps: if case.formulation == "multi-index" { steps / 10 } else { 0 },
        events: if case.events == Some(true) { 12 } else { 0 },
    };
    Outcome::Completed(Figures {
        energy_error: error,
        turned_over: TURNED_OVER,
        seconds: n_steps * price,
        sizes: [10, 9, 1],
        work: [steps, 3 * steps, 2 * steps],
        control: is_variable.then_some(control),
        outputs: outputs(error, duration),
    })
}

/// Values of the channels at the end of a made-up run.
fn outputs(error: f64, duration: f64) -> BTreeMap<String, Vec<f64>> {
    let values = |base: &[f64]| base.iter().map(|x| x + error / 50.0).collect::<Vec<_>>();
    [
        ("tip", values(&[1.330_436_825_144_049, -1.398_644_860_519_204])),
        ("crank-end", values(&[0.328_458_111_540_815_4, 0.944_518_538_178_600_9])),
        ("beta", values(&[15.872_485_085_167_984])),
        ("center", values(&[0.02, -0.04, 0.08])),
        ("wheel", values(&[0.97, 0.62, 0.44])),
        ("nose", values(&[7.0, 0.0, 1.0])),
        (
            "angle",
            values(&[if duration > 5.0 { 0.565_606_072_417_484 } else { 0.247_213_592_867_112 }]),
        ),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .into()
}

/// Writes the files of a made-up run. It has short steps in index 1 at roughly three seconds.
fn write(out: &Path, case: &Case, usual: f64, duration: f64) {
    let mut steps = String::from(
        "t,step,index,iterations,rejected,energy_error,energy_change,penalty_energy,error_estimate,limit\n",
    );
    let mut run = String::from("t,wheel.z,tip-acceleration.y\n");
    let mut energy = 0.0;
    for i in 1..=ROWS {
        let t = duration * f64::from(u32::try_from(i).unwrap())
            / f64::from(u32::try_from(ROWS).unwrap());
        let bump = (-(t - 3.1) * (t - 3.1) / 0.01).exp();
        let is_index_1 = case.rule != Rule::Fixed && bump > 0.5;
        let step = if case.rule == Rule::Fixed { usual } else { usual * (1.0 - 0.97 * bump) };
        let change = 1e-3 * step * (7.0 * t).sin() * (0.1 + bump);
        energy += change;
        let index = if is_index_1 { 1 } else { 3 };
        writeln!(steps, "{t},{step},{index},3,0,{energy},{change},{},,energy", change.abs() * 1e-3)
            .unwrap();
        writeln!(run, "{t},{},{}", 0.36 + 0.08 * bump, 90.0 * bump * (40.0 * t).sin()).unwrap();
    }
    std::fs::create_dir_all(out).unwrap();
    std::fs::write(out.join("steps.csv"), steps).unwrap();
    std::fs::write(out.join("run.csv"), run).unwrap();
}

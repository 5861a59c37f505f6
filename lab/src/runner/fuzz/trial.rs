//! Trial of a text: it is read, built, and run for a few steps in every formulation and precision.

use crate::fuzz::table::tables;
use crate::fuzz::torn::torn;
use mbs::core::scene::Scene;
use mbs::scene_file::Dice;
use mbs::scene_file::SceneFile;
use mbs::{FormulationKind, Mechanism, Method, Run, SettingsError};

/// Number of steps of a run.
const STEPS: f64 = 6.0;
/// Step of a scene without a step of its own [s].
const STEP: f64 = 1e-3;
/// Number of texts of which one is run in f32 and one in double-double. Chosen, not tuned.
const OTHER_PRECISIONS: usize = 5;
/// Largest number of bodies of a mechanism that is run in double-double, which takes long. Chosen, not tuned.
const SMALL: usize = 8;
/// Further methods that control their steps, besides the formulations whose steps the energy controls. Every second text that is not run in
/// double-double is tried with one of all these methods. They are tried less often, since step control may need a hundred thousand steps
/// before it stops.
const CONTROLLED: [[&str; 3]; 6] = [
    ["state-space", "trapezoidal", "both"],
    ["recursive", "trapezoidal", "error"],
    ["recursive", "rk54", "fixed"],
    ["recursive", "gbs", "fixed"],
    ["recursive", "rk853", "fixed"],
    ["recursive", "radau5", "fixed"],
];

/// All methods under trial: formulation, integrator and control of the step. The number is the length of the first part of the list, whose
/// methods every text is tried with.
fn tried() -> (Vec<[&'static str; 3]>, usize) {
    let (steered, fixed): (Vec<_>, Vec<_>) =
        FormulationKind::ALL.into_iter().partition(|f| f.row().energy_rule);
    let mut all: Vec<_> = fixed.iter().map(|f| [f.name(), "trapezoidal", "fixed"]).collect();
    all.extend(steered.iter().map(|f| [f.name(), "trapezoidal", "energy"]));
    all.extend(CONTROLLED);
    (all, fixed.len())
}

/// Duration of a run with controlled steps, relative to one with fixed steps [-]: controlled steps may be short. With springs of 1e20 N/m,
/// the stiffest of the texts so far, `rk853` then takes three seconds. With a ratio of 1e-2 it took ten minutes.
const SHORTER: f64 = 1e-4;

/// Verdict on a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// The text is no valid scene, and was refused with a message.
    Refused,
    /// The scene was run.
    Ran {
        /// Number of runs that were completed.
        completed: usize,
        /// Number of runs that stopped.
        stopped: usize,
    },
    /// A fault of the program, in words.
    Wrong(String),
}

/// Makes the trial of a text. A panic is left to the caller. `turn` chooses the precision.
#[must_use]
pub fn trial(text: &[u8], turn: usize) -> Verdict {
    let document = match SceneFile::from_bytes(text, "fuzzed.toml") {
        Ok(document) => document,
        Err(error) => return refusal(&error.render()),
    };
    let scene = match document.scene::<f64>() {
        Ok(scene) => scene,
        Err(error) => return refusal(&error.render()),
    };
    let mechanism = match Mechanism::of_file(document.clone()) {
        Ok(mechanism) => mechanism,
        Err(error) => return refusal(&error.render()),
    };
    let precision = match turn % OTHER_PRECISIONS {
        0 => "f32",
        1 if scene.bodies.len() <= SMALL => "dd",
        _ => "f64",
    };
    let [mut completed, mut stopped] = [0; 2];
    let is_turn = (turn / OTHER_PRECISIONS).is_multiple_of(2) && precision != "dd";
    let (tried, always) = tried();
    let other = turn / (2 * OTHER_PRECISIONS) % (tried.len() - always);
    let other = is_turn.then_some(always + other);
    for (i, &method) in tried.iter().enumerate() {
        if i >= always && other != Some(i) {
            continue;
        }
        let share = if i < always { 1.0 } else { SHORTER };
        match run((&mechanism, &scene), method, (precision, share)) {
            Ok(Some(true)) => completed += 1,
            Ok(Some(false)) => stopped += 1,
            Ok(None) => {}
            Err(why) => {
                return Verdict::Wrong(format!("{}, {precision}: {why}", method.join(", ")));
            }
        }
    }
    // the trial also damages files that are read with the scene, and a saved state
    let mut dice = Dice::new(turn as u64);
    if let Err(why) = tables(&document, &scene, &mut dice) {
        return Verdict::Wrong(why);
    }
    let formulation = tried[turn % always][0];
    match torn(&scene, formulation, &mut dice) {
        Ok(_) => Verdict::Ran { completed, stopped },
        Err(why) => Verdict::Wrong(format!("a damaged checkpoint, {formulation}: {why}")),
    }
}

/// Verdict on a refusal, which must name its place.
fn refusal(words: &str) -> Verdict {
    match words.contains("fuzzed.toml") {
        true => Verdict::Refused,
        false => Verdict::Wrong(format!("a refusal without a place: {words}")),
    }
}

/// Runs a scene for some steps of a fraction of the scene's step. Returns true if the run was completed; `None` if
/// the method refuses the scene.
fn run(
    (mechanism, scene): (&Mechanism, &Scene<f64>),
    [formulation, integrator, control]: [&str; 3],
    (precision, share): (&str, f64),
) -> Result<Option<bool>, String> {
    let step = share * scene.solver.step.unwrap_or(STEP);
    let overrides = Method {
        formulation: Some(formulation.to_owned()),
        precision: Some(precision.to_owned()),
        integrator: Some(integrator.to_owned()),
        step_control: Some(control.to_owned()),
        step: Some(step),
        step_max: Some(step),
        duration: Some((STEPS * step).min(scene.duration)),
        ..Method::default()
    };
    let result = match mbs::run(mechanism, &Run::new().method(overrides)) {
        Ok(result) => result,
        Err(error) if error.cause::<SettingsError>().is_some() => return Ok(None),
        Err(error) => match refusal(&error.to_string()) {
            Verdict::Wrong(why) => return Err(why),
            _ => return Ok(None),
        },
    };
    let outcome = result.outcome();
    let is_finite = outcome.rows().iter().flat_map(|(_, row)| row).all(|x| x.is_finite());
    match (outcome.summary.completed, &outcome.summary.error) {
        (true, Some(_)) => Err("completed with an error".to_owned()),
        (false, None) => Err("stopped without an error".to_owned()),
        _ if !is_finite => Err("a row that is not finite".to_owned()),
        (is_completed, _) => Ok(Some(is_completed)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_scene_is_refused_and_a_scene_runs_in_every_formulation() {
        assert_eq!(trial(b"name = ", 0), Verdict::Refused);
        assert_eq!(trial(b"\xff", 0), Verdict::Refused);
        let pendulum = b"[scene]\nname = \"p\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n\n[[body]]\nname = \"b\"\n\
            mass = 1.0\nrod = { from = [0.0, 0.0], to = [1.0, 0.0] }\n\n[[joint]]\nname = \"j\"\nkind = \"revolute\"\n\
            bodies = [\"ground\", \"b\"]\nat = [0.0, 0.0]\n";
        let count = |turn: usize| match trial(pendulum, turn) {
            Verdict::Ran { completed, stopped: 0 } => completed,
            other => panic!("{turn}: {other:?}"),
        };
        let sums: Vec<usize> = (0..50).map(count).collect();
        // half of the texts that are not run in double-double
        assert_eq!((sums.iter().sum::<usize>(), sums[0], sums[1]), (5 * 50 + 20, 6, 5));
    }
}

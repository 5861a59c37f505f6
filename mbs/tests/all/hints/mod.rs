//! Every hint helps: a scene causes it, and the same scene, changed as the hint says, runs.

mod mechanisms;
mod scenes;
mod values;
mod words;

use mbs::core::scene::Scene;
use mbs::scene_file::SceneFile;
use mbs::{Method, ResolvedMethod};

/// Changes of a text: passages that occur in it once, and their replacements.
type Change = &'static [(&'static str, &'static str)];

/// Hint, with the change that causes it and the change that it proposes.
struct Row {
    /// Text of a scene that runs.
    base: &'static str,
    /// Change that provokes the hint.
    spoil: Change,
    /// A part of the message.
    message: &'static str,
    /// A part of the hint.
    hint: &'static str,
    /// Change of the spoiled scene that the hint proposes.
    mend: Change,
}

const fn row(
    base: &'static str,
    spoil: Change,
    [message, hint]: [&'static str; 2],
    mend: Change,
) -> Row {
    Row { base, spoil, message, hint, mend }
}

/// Returns the text with passages replaced.
fn changed(text: &str, change: Change) -> String {
    change.iter().fold(text.to_owned(), |text, (from, to)| {
        assert_eq!(text.matches(from).count(), 1, "`{from}` stands once in\n{text}");
        text.replacen(from, to, 1)
    })
}

/// Reads and runs a text as `mbs run` does. An error is its message and its hint.
fn run(text: &str) -> Result<(), [String; 2]> {
    run_with(text, &Method::default())
}

fn run_with(text: &str, overrides: &Method) -> Result<(), [String; 2]> {
    let document = SceneFile::parse(text, "scene.toml").map_err(|e| [e.to_string(), e.hint()])?;
    let scene: Scene<f64> = document.scene().map_err(|e| [e.to_string(), e.hint()])?;
    let settings = ResolvedMethod::new(&scene, overrides)
        .and_then(|settings| settings.check_step(&scene, overrides).map(|()| settings));
    let settings = settings.map_err(|e| [e.to_string(), e.hint()])?;
    let outcome = crate::common::run_by(&scene, &settings);
    match &outcome.error {
        None => Ok(()),
        Some(error) => Err([error.to_string(), error.hint().to_owned()]),
    }
}

#[test]
fn every_hint_leads_to_a_scene_that_runs() {
    let mut lost = Vec::new();
    let rows = [words::rows(), values::rows(), mechanisms::rows()];
    for (i, row) in rows.into_iter().flatten().enumerate() {
        assert_eq!(run(row.base), Ok(()), "the scene that row {i} spoils");
        let spoiled = changed(row.base, row.spoil);
        match run(&spoiled) {
            Ok(()) => lost.push(format!("row {i}: {:?} is not refused", row.spoil)),
            Err([message, hint]) => {
                if !(message.contains(row.message) && hint.contains(row.hint)) {
                    lost.push(format!("row {i}: {message} / {hint}"));
                }
                // messages are for people, so no hint is empty
                if hint.is_empty() {
                    lost.push(format!("row {i}: {message} has no hint"));
                }
            }
        }
        if let Err([message, hint]) = run(&changed(&spoiled, row.mend)) {
            lost.push(format!("row {i}: {:?} leads to {message} / {hint}", row.mend));
        }
    }
    assert!(lost.is_empty(), "{}", lost.join("\n"));
}

/// Options that are refused, a part of the hint, and the change that it proposes.
type Refused = (fn(&mut Method), &'static str, fn(&mut Method));

const OPTIONS: [Refused; 9] = [
    (|o| o.step = Some(-1e-3), "larger than zero", |o| o.step = Some(1e-3)),
    (|o| o.step = Some(1.0), "a step of 0.02 s at most", |o| o.step = Some(0.02)),
    (|o| o.step = Some(1e-300), "a longer step", |o| o.step = Some(1e-3)),
    (
        |o| o.formulation = Some("index3".into()),
        "did you mean `index-3`?",
        |o| o.formulation = Some("index-3".into()),
    ),
    (
        |o| {
            o.formulation = Some("index-3".into());
            o.integrator = Some("radau5".into());
        },
        "need formulation `recursive`",
        |o| o.formulation = Some("recursive".into()),
    ),
    (
        |o| {
            o.formulation = Some("state-space".into());
            o.penalty = Some(1e6);
        },
        "leave the penalty out",
        |o| o.penalty = None,
    ),
    (
        |o| {
            o.integrator = Some("rk853".into());
            o.step_control = Some("error".into());
        },
        "control their own step by --tolerance",
        |o| {
            o.step_control = None;
            o.tolerance = Some(1e-6);
        },
    ),
    (
        |o| {
            o.formulation = Some("recursive".into());
            o.threads = Some(2);
        },
        "threads share the steps of index-3",
        |o| o.formulation = Some("index-3".into()),
    ),
    (
        |o| o.energy_tolerance = Some([1e-7, 1e-5]),
        "the larger one first",
        |o| o.energy_tolerance = Some([1e-5, 1e-7]),
    ),
];

#[test]
fn every_hint_of_an_option_leads_to_settings_that_run() {
    for (i, (spoil, hint, mend)) in OPTIONS.into_iter().enumerate() {
        let mut overrides = Method::default();
        spoil(&mut overrides);
        let [message, told] = run_with(scenes::PLANAR, &overrides).expect_err("it is refused");
        assert!(told.contains(hint), "{i}: {message} / {told}");
        mend(&mut overrides);
        assert_eq!(run_with(scenes::PLANAR, &overrides), Ok(()), "{i}: {hint}");
    }
}

//! `mbs explain`: what it says of scenes, and what leaving an effect out changes. No time is asserted.

use mbs::explain::{Effort, explain, report};
use mbs::scene_file::{Document, Explanation, Price, Provenance, SearchEnd};
use mbs::{Overrides, Settings};
use mbs_core::scene::Scene;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Little is timed; everything else is measured in full.
const LITTLE: Effort = Effort { timed_steps: 20, repeats: 2, seconds: 60.0 };

fn scene(name: &str) -> String {
    format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn mbs(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_mbs"));
    command.arg("explain").args(arguments).output().expect("the command is built")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The JSON object of a scene of the repository, by the command.
fn json(name: &str, more: &[&str]) -> Value {
    let output = mbs(&[&[scene(name).as_str(), "--json"], more].concat());
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let value: Value = serde_json::from_slice(&output.stdout).expect("one JSON object");
    assert!(value.is_object());
    value
}

/// A pendulum of 1 kg and 1 m that hangs at rest 60 degrees off, with effects.
fn pendulum(effects: &str) -> Scene<f64> {
    let text = format!(
        r#"
[scene]
name = "pendulum"
dimension = 2
duration = 2.0
gravity = [0.0, -9.81]
[[body]]
name = "bob"
mass = 1.0
center = [0.8660254037844386, -0.5]
inertia = 0.1
[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "bob"]
at = [0.0, 0.0]
{effects}
"#
    );
    let document = Document::parse(&text, "pendulum.toml").unwrap_or_else(|e| panic!("{e}"));
    document.scene().unwrap_or_else(|e| panic!("{}", e.render()))
}

const DAMPER: &str = r#"
[[effect]]
name = "damper"
kind = "torsion-spring"
joint = "pivot"
stiffness = 0.0
damping = 2.0
free_value = 0.0
"#;

const IDLE: &str = r#"
[[effect]]
name = "idle"
kind = "torque"
joint = "pivot"
value = 0.0
"#;

fn explained(scene: &Scene<f64>) -> (Explanation, Settings) {
    let overrides = Overrides { step: Some(1e-2), ..Overrides::default() };
    let settings = Settings::new(scene, &overrides).expect("the settings are built");
    (explain::<f64, 2>(scene, &settings, &LITTLE), settings)
}

fn price<'a>(explanation: &'a Explanation, name: &str) -> &'a Price {
    let prices = explanation.prices.as_ref().expect("it starts");
    prices.effects.iter().find(|p| p.names == [name]).expect("it is on the list")
}

fn absences(value: &Value) -> Vec<&str> {
    let list = value["absent"].as_array().expect("a list");
    list.iter().map(|entry| entry["what"].as_str().expect("a word")).collect()
}

#[test]
fn json_is_one_object_with_its_keys() {
    let value = json("double-pendulum", &["--step", "1e-2"]);
    let keys: Vec<&str> =
        value.as_object().expect("an object").keys().map(String::as_str).collect();
    let wanted = [
        "absent",
        "choice",
        "chosen",
        "dimension",
        "duration",
        "effects",
        "error",
        "formulation",
        "integrator",
        "precision",
        "prices",
        "scene",
        "simulated",
        "step",
    ];
    assert_eq!(keys, wanted);
    assert_eq!(
        (&value["formulation"], &value["chosen"]["formulation"]),
        (&"auto".into(), &"index-3".into())
    );
    assert!(!value["chosen"]["reasons"].as_array().expect("a list").is_empty());
    let simulated = &value["simulated"];
    assert_eq!(simulated["dof"], 2);
    assert_eq!(simulated["bodies"].as_array().expect("a list").len(), 2);
    assert_eq!(simulated["joints"][0]["kind"], "revolute");
    assert_eq!(simulated["joints"][0]["names"].as_array().expect("a list").len(), 2);
    assert_eq!(simulated["gravity"], serde_json::json!([0.0, -9.81]));
    let natural = &simulated["natural"];
    let sizes = ["coordinates", "constraints", "constraint_rank", "redundant", "dof"];
    assert_eq!(sizes.map(|key| natural[key].as_u64()), [4, 2, 2, 0, 2].map(Some));
    let relative = &simulated["relative"];
    assert_eq!(sizes.map(|key| relative[key].as_u64()), [2, 0, 0, 0, 2].map(Some));
    assert_eq!((&relative["loops"], &relative["cut_joints"]), (&0.into(), &Value::Array(vec![])));
    let absent = absences(&value);
    for what in ["third-dimension", "guides", "damping", "friction", "tires", "flexible-bodies"] {
        assert!(absent.contains(&what), "{what}");
    }
    assert!(!absent.contains(&"gravity"));
    let prices = &value["prices"];
    assert_eq!((&prices["effects"], &prices["completed"]), (&Value::Array(vec![]), &true.into()));
    for key in ["timed_steps", "repeats", "compared_duration", "iterations_per_step"] {
        assert!(prices[key].is_number(), "{key}");
    }
    assert_eq!(prices["timed_steps"], 1000);
}

#[test]
fn loops_are_cut_at_named_joints_and_redundant_equations_are_counted() {
    let value = json("two-four-bars", &["--duration", "0.05"]);
    let relative = &value["simulated"]["relative"];
    assert_eq!((&value["simulated"]["dof"], &relative["loops"]), (&1.into(), &2.into()));
    let cut = relative["cut_joints"].as_array().expect("a list");
    let names: Vec<_> =
        value["simulated"]["joints"][0]["names"].as_array().expect("a list").clone();
    assert!(cut.len() == 2 && cut.iter().all(|joint| names.contains(joint)));
    assert_eq!((&relative["constraints"], &relative["redundant"]), (&4.into(), &0.into()));

    // One spatial revolute joint is cut: five equations, two of which the planar motion needs.
    let value = json("spatial-four-bar", &["--duration", "0.05"]);
    let relative = &value["simulated"]["relative"];
    let sizes = ["coordinates", "constraints", "constraint_rank", "redundant", "dof", "loops"];
    assert_eq!(sizes.map(|key| relative[key].as_u64()), [3, 5, 2, 3, 1, 1].map(Some));
    assert!(value["simulated"]["natural"]["redundant"].as_u64() > Some(0));
    assert_eq!(value["simulated"]["natural"]["dof"], 1);
    assert!(!absences(&value).contains(&"third-dimension"));
}

#[test]
fn guides_are_told_and_leave_no_freedom() {
    let value = json("guided-four-bar", &["--duration", "0.05"]);
    let simulated = &value["simulated"];
    assert_eq!(simulated["guides"], serde_json::json!([{"joint": "crank-pivot", "law": "ramp"}]));
    assert_eq!((&simulated["dof"], &simulated["relative"]["dof"]), (&0.into(), &0.into()));
    assert!(!absences(&value).contains(&"guides"));
}

#[test]
fn an_idle_spin_is_told_where_a_thin_rod_has_one() {
    let text = r#"
[scene]
dimension = 3
duration = 0.1
gravity = [0.0, 0.0, -9.81]
[[body]]
name = "on-ball"
rod = { from = [0.0, 0.0, 0.0], to = [1.0, 0.0, 0.0] }
mass = 1.0
[[body]]
name = "on-hinge"
rod = { from = [0.0, 3.0, 0.0], to = [1.0, 3.0, 0.0] }
mass = 1.0
[[joint]]
name = "ball"
kind = "spherical"
bodies = ["ground", "on-ball"]
at = [0.0, 0.0, 0.0]
[[joint]]
name = "hinge"
kind = "revolute"
bodies = ["ground", "on-hinge"]
at = [0.0, 3.0, 0.0]
axis = [0.0, 1.0, 0.0]
"#;
    let document = Document::parse(text, "rods.toml").expect("TOML");
    let scene: Scene<f64> = document.scene().expect("a scene");
    let settings = Settings::new(&scene, &Overrides::default()).expect("the settings are built");
    let simulated = explain::<f64, 3>(&scene, &settings, &LITTLE).simulated;
    let rods: Vec<_> =
        simulated.rods.iter().map(|rod| (rod.body.as_str(), rod.idle_spin_carried)).collect();
    assert_eq!(rods, [("on-ball", false), ("on-hinge", true)]);
    // Two swings of the ball and one turn of the hinge; relative coordinates carry the spin too.
    assert_eq!((simulated.dof, simulated.relative.map(|r| r.sizes.dof)), (Some(3), Some(4)));
    let planar = json("guided-four-bar", &["--duration", "0.02"]);
    assert_eq!(planar["simulated"]["rods"], Value::Array(vec![]), "the plane has no such spin");
}

#[test]
fn a_switched_off_effect_is_named_and_absent() {
    let off = DAMPER.replace("kind", "enabled = false\nkind");
    let (explanation, _) = explained(&pendulum(&off));
    assert_eq!(explanation.effects.len(), 1);
    assert!(!explanation.effects[0].enabled && explanation.effects[0].kind == "torsion-spring");
    assert!(explanation.absent.iter().any(|a| a.what == "damping"));
    assert!(explanation.prices.expect("it starts").effects.is_empty());
    let (explanation, _) = explained(&pendulum(DAMPER));
    assert!(!explanation.absent.iter().any(|a| a.what == "damping"));
    assert!(explanation.absent.iter().any(|a| a.what == "springs"), "it has no stiffness");
}

#[test]
fn leaving_a_damper_out_changes_what_two_runs_differ_by_and_an_idle_effect_changes_nothing() {
    let scene = pendulum(&[DAMPER, IDLE].concat());
    let (explanation, settings) = explained(&scene);
    let mut free = scene.clone();
    free.effects[0].enabled = false;
    let [with, without] = [&scene, &free].map(|s| mbs::run::<f64, 2>(s, &settings, &mut ()));
    let rows = with.rows().iter().zip(without.rows());
    let by_hand = rows.map(|(a, b)| (a.1[0] - b.1[0]).abs()).fold(0.0, f64::max);
    assert!(by_hand > 0.1, "{by_hand} rad");
    let changes = &price(&explanation, "damper").changes;
    assert_eq!(
        (changes.len(), changes[0].output.as_str(), changes[0].unit.as_str()),
        (1, "pivot", "rad")
    );
    assert_eq!(changes[0].largest.to_bits(), by_hand.to_bits());
    assert!((changes[0].relative.expect("it moves") * changes[0].range - by_hand).abs() < 1e-12);

    let idle = price(&explanation, "idle");
    /// Sums in another order [rad].
    const ROUNDING: f64 = 1e-12;
    assert!(idle.completed && idle.changes[0].largest < ROUNDING, "{:?}", idle.changes);
    assert!(idle.changes[0].is_rounding && !changes[0].is_rounding);
    assert!(idle.largest_change().is_none());
}

#[test]
fn what_is_rounding_beside_the_scene_is_no_change() {
    // The guided joint follows its guide whatever acts elsewhere.
    let text = std::fs::read_to_string(scene("guided-four-bar")).expect("it is there");
    let effect = DAMPER.replace("pivot", "rocker-pivot");
    let document = Document::parse(&format!("{text}\n{effect}"), "guided.toml").expect("TOML");
    let (explanation, _) = explained(&document.scene().expect("a scene"));
    let changes = &price(&explanation, "damper").changes;
    let of = |output: &str, unit: &str| {
        let mut found = changes.iter().filter(|c| c.output == output && c.unit == unit);
        found.next().expect("it is an output")
    };
    assert!(of("crank-angle", "rad").is_rounding && of("rocker-angle", "rad").is_rounding);
    // The driving moment carries what the damper takes: a channel has an entry for each of its units.
    assert!(!of("crank-reaction", "N m").is_rounding && !of("crank-reaction", "N").is_rounding);
}

#[test]
fn effects_of_a_kind_are_left_out_together_too() {
    let second = DAMPER.replace("\"damper\"", "\"brake\"");
    let (explanation, _) = explained(&pendulum(&[DAMPER, IDLE, &second].concat()));
    let prices = explanation.prices.as_ref().expect("it starts");
    assert_eq!(prices.effects.len(), 3);
    assert_eq!(prices.kinds.len(), 1, "one torque is no group");
    assert_eq!(prices.kinds[0].names, ["damper", "brake"]);
    let together = prices.kinds[0].changes[0].largest;
    assert!(together > price(&explanation, "brake").changes[0].largest);
    let text = report(&explanation, Provenance::default()).text();
    assert!(text.contains("all 2 torsion-spring") && text.contains("share of a step"), "{text}");
}

#[test]
fn the_largest_step_completes_and_twice_as_long_a_one_does_not() {
    let scene = pendulum(DAMPER);
    let (explanation, settings) = explained(&scene);
    let prices = explanation.prices.as_ref().expect("it starts");
    for (found, enabled) in
        [(&prices.largest_step, true), (&price(&explanation, "damper").largest_step, false)]
    {
        let step = found.step.expect("the given one completes");
        let doublings = (step / settings.step).log2();
        assert!((doublings - doublings.round()).abs() < 1e-9 && doublings > -0.5);
        let mut scene = scene.clone();
        scene.effects[0].enabled = enabled;
        let completes = |step: f64| {
            let settings = Settings { step, step_max: step, ..settings.clone() };
            mbs::run::<f64, 2>(&scene, &settings, &mut ()).summary.completed
        };
        assert!(completes(step));
        match found.end {
            SearchEnd::Stops => assert!(!completes(2.0 * step)),
            SearchEnd::Limit => assert!(2.0 * step > settings.duration / 10.0),
            SearchEnd::NotMeasured => panic!("a minute is enough"),
        }
    }
}

#[test]
fn files_are_written_and_the_page_stands_alone() {
    let out: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join("explain-files");
    let _ = std::fs::remove_dir_all(&out);
    let directory = out.to_str().expect("a plain path");
    let output = mbs(&[&scene("andrews"), "--duration", "1e-3", "--out", directory]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let table = text(&output.stdout);
    for words in ["What is simulated", "cut at", "Price of each effect", "costs nothing", "drive"] {
        assert!(table.contains(words), "{words}: {table}");
    }
    let json = std::fs::read(out.join("explain.json")).expect("it is written");
    let value: Value = serde_json::from_slice(&json).expect("one JSON object");
    assert_eq!(value["prices"]["effects"][0]["kind"], "spring-damper");
    let html = std::fs::read_to_string(out.join("explain.html")).expect("it is written");
    for word in ["http:", "https:", "src=", "href=", "url(", "<script"] {
        assert!(!html.contains(word), "{word}");
    }
    assert!(html.contains("mbs explain") && html.contains("Price of each effect"));
}

#[test]
fn refusals_and_scenes_without_a_start_have_their_status() {
    let output = mbs(&[&scene("double-pendulum"), "--formulation", "index-2"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("hint:") && output.stdout.is_empty());
    let output = mbs(&["no-such-scene.toml"]);
    assert_eq!(output.status.code(), Some(1));

    let bad = Path::new(env!("CARGO_TARGET_TMPDIR")).join("explain-open-loop.toml");
    let far = std::fs::read_to_string(scene("guided-four-bar")).expect("it is there");
    // The crank is told to run away from where it is held.
    let start = "[[initial]]\njoint = \"rocker-pivot\"\nvalue = 2.0\n\n[solver]";
    std::fs::write(&bad, far.replace("[solver]", start)).expect("it can be written");
    let output = mbs(&[bad.to_str().expect("a plain path"), "--json"]);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    let value: Value = serde_json::from_slice(&output.stdout).expect("one JSON object");
    assert_eq!(value["error"]["code"], "cannot-assemble");
    assert!(value["prices"].is_null() && value["simulated"]["natural"].is_null());
    assert_eq!(value["simulated"]["bodies"][0], "crank");
}

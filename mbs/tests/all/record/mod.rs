//! Files of a run, read again with the written content.

mod choice;
mod realtime;

use mbs::record::{Channel, Contact, CsvWriter, Outputs, RunError, RunSummary};
use mbs_scene::SceneFile;
use proptest::prelude::*;

const SCENE: &str = r#"
scene = { dimension = 3, duration = 1 }
body = [{ name = "b", mass = 1, center = [0, 0, 0], inertia = [1, 1, 1, 0, 0, 0] }]
joint = [{ name = "rail", kind = "cylindrical", bodies = ["ground", "b"], at = [0, 0, 0], axis = [1, 0, 0] }]
"#;

fn columns(extra: &str) -> Vec<String> {
    let file = SceneFile::parse(&format!("{SCENE}{extra}"), "x").expect("TOML");
    let scene = file.scene::<f64>().expect("a scene");
    Channel::of_scene(&scene).iter().flat_map(Channel::columns).collect()
}

#[test]
fn columns_are_named_as_the_format_says() {
    assert_eq!(columns(""), ["rail.1", "rail.2"]);
    let tip = r#"output = [{ name = "tip", body = "b", at = [1, 0, 0] }, { name = "r", joint = "rail", quantity = "reaction" }]"#;
    let expected = ["tip.x", "tip.y", "tip.z", "r.Fx", "r.Fy", "r.Fz", "r.Mx", "r.My", "r.Mz"];
    assert_eq!(columns(tip), expected);
}

#[test]
fn units_of_joint_coordinates_put_translations_first() {
    let scene = SceneFile::parse(SCENE, "x").unwrap().scene::<f64>().unwrap();
    let units: Vec<_> =
        Channel::of_scene(&scene)[0].components.iter().map(|c| c.unit.clone()).collect();
    assert_eq!(units, ["m", "rad"]);
}

fn channel(name: &str) -> Channel {
    let component = mbs_core::outputs::Component { label: String::new(), unit: "m".into() };
    Channel { name: name.into(), quantity: "", components: vec![component] }
}

proptest! {
    #[test]
    fn csv_reads_back_exactly(rows in proptest::collection::vec([any::<f64>(), any::<f64>()], 0..20)) {
        let mut bytes = Vec::new();
        let mut writer = CsvWriter::new(&mut bytes, &[channel("a,\"b")]).unwrap();
        for [t, x] in &rows {
            writer.row(*t, &[*x]).unwrap();
        }
        writer.finish().unwrap();
        let mut reader = csv::Reader::from_reader(bytes.as_slice());
        prop_assert_eq!(reader.headers().unwrap(), vec!["t", "a,\"b"]);
        let found: Vec<[f64; 2]> = reader
            .records()
            .map(|r| [0, 1].map(|i| r.as_ref().unwrap()[i].parse().unwrap()))
            .collect();
        prop_assert_eq!(found.len(), rows.len());
        for (found, row) in found.iter().zip(&rows) {
            for (a, b) in found.iter().zip(row) {
                prop_assert!(a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()));
            }
        }
    }
}

#[test]
fn a_run_that_stops_keeps_its_rows() {
    let mut bytes = Vec::new();
    {
        let mut writer = CsvWriter::new(&mut bytes, &[channel("x")]).unwrap();
        writer.row(0.001, &[1.0e-300]).unwrap();
    }
    assert_eq!(String::from_utf8(bytes).unwrap(), "t,x\n0.001,1e-300\n");
}

fn keys(value: &serde_json::Value) -> Vec<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}

#[test]
fn json_has_exactly_the_keys_of_the_format() {
    let mut summary = RunSummary { scene: "double pendulum".into(), ..Default::default() };
    summary.outputs =
        Outputs(vec![("tip".into(), vec![1.0, 2.0]), ("angle".into(), vec![f64::NAN])]);
    let json: serde_json::Value = serde_json::from_str(&summary.to_json()).unwrap();
    let mut expected = vec![
        "scene",
        "formulation",
        "precision",
        "dimension",
        "coordinates",
        "constraints",
        "constraint_rank",
        "dof",
        "step",
        "steps",
        "completed",
        "error",
        "end_time",
        "cpu_seconds",
        "real_time_factor",
        "worst_step_seconds",
        "iterations",
        "factorizations",
        "energy",
        "violation",
        "outputs",
        "channels",
        "method_used",
    ];
    expected.sort_unstable();
    assert_eq!(keys(&json), expected);
    assert_eq!(
        keys(&json["energy"]),
        ["drift", "final_error", "initial", "max_error", "scatter", "turned_over"]
    );
    assert_eq!(keys(&json["violation"]), ["acceleration", "position", "velocity"]);
    assert_eq!(json["outputs"]["tip"], serde_json::json!([1.0, 2.0]));
    assert!(json["outputs"]["angle"].is_null() && json["error"].is_null());
    summary.error = Some(RunError { joint: Some("pivot".into()), ..Default::default() });
    summary.chosen = Some(Default::default());
    summary.not_unique = vec!["pivot".into()];
    let json: serde_json::Value = serde_json::from_str(&summary.to_json()).unwrap();
    assert_eq!(keys(&json["error"]), ["code", "hint", "joint", "message", "time"]);
    assert_eq!(keys(&json["chosen"]), ["formulation", "reasons"]);
    assert_eq!(json["not_unique"], serde_json::json!(["pivot"]));
    let contact = |end, event| Contact { time: 0.5, effect: "stop".into(), end, event };
    summary.contacts = vec![contact(None, "made"), contact(Some("upper"), "broken")];
    summary.contacts_left_out = 3;
    let json: serde_json::Value = serde_json::from_str(&summary.to_json()).unwrap();
    assert_eq!(keys(&json["contacts"][0]), ["effect", "event", "time"]);
    assert_eq!(json["contacts"][1]["end"], "upper");
    assert_eq!(json["contacts_left_out"], 3);
}

#[test]
fn magnitudes_have_columns_where_they_are_asked_for() {
    let tip = r#"output = [{ name = "tip", body = "b", at = [1, 0, 0], magnitude = true }, { name = "r", joint = "rail", quantity = "reaction", magnitude = true }]"#;
    let expected = [
        "tip.x", "tip.y", "tip.z", "tip.abs", "r.Fx", "r.Fy", "r.Fz", "r.Mx", "r.My", "r.Mz",
        "r.F", "r.M",
    ];
    assert_eq!(columns(tip), expected);
}

#[test]
fn outputs_of_all_joints_and_effects_are_added_once() {
    let all = SCENE.replace("duration = 1", "duration = 1, outputs = \"all\"");
    let more = r#"
effect = [{ name = "spring", kind = "torsion-spring", joint = "rail", coordinate = 0, stiffness = 1 }]
output = [{ name = "rail rate", joint = "rail" }]"#;
    let scene = SceneFile::parse(&(all + more), "x").unwrap().scene::<f64>().unwrap();
    let found: Vec<_> =
        Channel::of_scene(&scene).into_iter().map(|c| (c.name, c.quantity)).collect();
    let expected = [
        ("rail rate", "value"),
        ("rail rate 2", "rate"),
        ("rail reaction", "reaction"),
        ("spring force", "force"),
    ];
    assert_eq!(found, expected.map(|(name, quantity)| (name.to_owned(), quantity)));
}

#[test]
fn what_has_no_vector_has_no_magnitude() {
    for (output, word) in [
        (r#"{ name = "x", joint = "rail", magnitude = true }"#, "no magnitude"),
        (r#"{ name = "x", body = "b", quantity = "orientation", magnitude = true }"#, "magnitude"),
    ] {
        let text = format!("{SCENE}output = [{output}]");
        let error = SceneFile::parse(&text, "x").unwrap().scene::<f64>().unwrap_err();
        assert!(error.to_string().contains(word), "{error}");
    }
}

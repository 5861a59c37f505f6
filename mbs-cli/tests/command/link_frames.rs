//! Frames of links by their names, for models with and without masses, and gravity that acts on some links only: `mbs inspect`.

use super::models::file;
use super::{run, status, text};
use serde_json::Value;

/// Largest difference from the values of other programs [-]: they agree up to rounding.
const TOLERANCE: f64 = 1e-9;

fn inspected(name: &str, model: &str, options: &[&str]) -> Value {
    let path = file(name);
    std::fs::write(&path, model).expect("a folder");
    let output = run("inspect", &[&[path.to_str().expect("UTF-8"), "--json"], options].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// Returns all numbers in a JSON value, at any depth, as one list.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().flat_map(flat).collect(),
        other => other.as_f64().into_iter().collect(),
    }
}

fn close(what: &str, found: &Value, expected: &[f64]) {
    let found = flat(found);
    assert_eq!(found.len(), expected.len(), "{what}");
    for (found, expected) in found.iter().zip(expected) {
        let error = (found - expected).abs();
        assert!(error < TOLERANCE * expected.abs().max(1.0), "{what}: {found} {expected}");
    }
}

/// A model of an arm with three joints and a hand that is fixed to it. Each moving link contains the text `inertia`.
fn arm(inertia: &str) -> String {
    let link = |name: &str| format!("<link name=\"{name}\">{inertia}</link>");
    let joint = |name: &str, [parent, child]: [&str; 2], origin: &str, axis: &str| {
        format!(
            "<joint name=\"{name}\" type=\"revolute\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
             <origin {origin}/><axis xyz=\"{axis}\"/>\
             <limit lower=\"-3\" upper=\"3\" effort=\"9\" velocity=\"9\"/></joint>"
        )
    };
    [
        "<robot name=\"arm\"><link name=\"root\"/>".to_owned(),
        link("base_turn") + &link("upper") + &link("fore") + "<link name=\"gripper\"/>",
        joint("j1", ["root", "base_turn"], "xyz=\"0 0 0.3\" rpy=\"0 0 0.1\"", "0 0 1"),
        joint("j2", ["base_turn", "upper"], "xyz=\"0.1 0 0.2\" rpy=\"0 -0.5 0\"", "0 1 0"),
        joint("j3", ["upper", "fore"], "xyz=\"0.5 0 0\" rpy=\"0 0 0.2\"", "0 1 0"),
        "<joint name=\"jf\" type=\"fixed\"><parent link=\"fore\"/><child link=\"gripper\"/>\
         <origin xyz=\"0.2 0 0\" rpy=\"0.4 0 0\"/></joint></robot>"
            .to_owned(),
    ]
    .concat()
}

/// Inertia whose centre is off the link's origin and whose axes are rotated against the link's.
const INERTIA: &str = "<inertial><origin xyz=\"0.05 0.02 0.1\" rpy=\"0.1 0.2 0\"/><mass value=\"2\"/>\
    <inertia ixx=\"0.05\" iyy=\"0.06\" izz=\"0.03\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>";
const STATE: [&str; 5] =
    ["--joint=j1=0.4", "--joint=j2=0.6", "--joint=j3=-0.8", "--what", "frames,jacobians"];

/// Place and rotation matrix of each link, by Pinocchio 4.1.0.
#[rustfmt::skip]
const PLACES: [(&str, [f64; 12]); 5] = [
    ("root", [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
    ("base_turn", [
        0.0, 0.0, 0.3, 0.8775825618903729, -0.47942553860420306, 0.0, 0.47942553860420306, 0.8775825618903729, 0.0, 0.0, 0.0, 1.0,
    ]),
    ("upper", [
        0.08775825618903729, 0.04794255386042031, 0.5, 0.873198304456282, -0.47942553860420306, 0.0876120655431923,
        0.4770304078518431, 0.8775825618903729, 0.04786268954660332, -0.09983341664682799, 0.0, 0.9950041652780259,
    ]),
    ("fore", [
        0.5243574084171783, 0.28645775778634186, 0.450083291676586, 0.5927260782233383, -0.643346669747227, -0.484541906050585,
        0.48152993616138007, 0.7653180263082267, -0.427103312078118, 0.6456041486657275, 0.019833838076209843, 0.7634146331403192,
    ]),
    ("gripper", [
        0.642902624061846, 0.3827637450186179, 0.5792041214097315, 0.5927260782233383, -0.7812510289591195, -0.19576165596024847,
        0.48152993616138007, 0.5385827182557865, -0.6914170783084737, 0.6456041486657275, 0.31555583554503575, 0.6954277804913145,
    ]),
];
/// Jacobian of the gripper, by Pinocchio 4.1.0, in axes of the world.
#[rustfmt::skip]
const JACOBIAN: [f64; 18] = [
    -0.3827637450186179, 0.0695081557790283, 0.09690838121011702, 0.642902624061846, 0.03797247856653321, 0.08542066241562363,
    0.0, -0.6477068464839508, -0.15268292662806393, 0.0, -0.47942553860420306, -0.643346669747227,
    0.0, 0.8775825618903729, 0.7653180263082267, 1.0, 0.0, 0.019833838076209843,
];

#[test]
fn links_are_where_pinocchio_has_their_frames_with_masses_and_without() {
    for (name, inertia) in [("heavy.urdf", INERTIA), ("light.urdf", "")] {
        let object = inspected(name, &arm(inertia), &STATE);
        assert_eq!(object["frames"].as_object().expect("frames").len(), PLACES.len());
        for (link, expected) in PLACES {
            let frame = &object["frames"][link];
            close(link, &frame["position"], &expected[..3]);
            close(link, &frame["rotation"], &expected[3..]);
        }
        close("jacobian", &object["jacobians"]["gripper"], &JACOBIAN);
    }
}

#[test]
fn centres_of_mass_have_a_word_of_their_own() {
    let options = ["--joint=j1=0.4", "--joint=j2=0.6", "--joint=j3=-0.8", "--what=centers,frames"];
    let object = inspected("centers.urdf", &arm(INERTIA), &options);
    let center = flat(&object["centers"]["base_turn"]["position"]);
    let [x, y] = [0.8775825618903729, 0.47942553860420306];
    let expected = [x * 0.05 - y * 0.02, y * 0.05 + x * 0.02, 0.4];
    close("centre", &serde_json::json!(center), &expected);
    assert!(object["centers"]["gripper"].is_null() && !object["frames"]["gripper"].is_null());
}

#[test]
fn places_need_no_inertia_that_a_body_can_have() {
    let right = inspected("possible.urdf", &arm(INERTIA), &STATE);
    let moments = |xx: &str, mass: &str| {
        format!(
            r#"<inertial><origin xyz="0.05 0.02 0.1"/><mass value="{mass}"/><inertia ixx="{xx}" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>"#
        )
    };
    // moments that violate the triangle inequality, a negative moment, and moments without a mass
    for (xx, mass) in [("0.3", "1"), ("-0.1", "1"), ("0.1", "0")] {
        let model = arm(&moments(xx, mass));
        let object = inspected("impossible.urdf", &model, &STATE);
        assert_eq!(object["frames"], right["frames"], "{xx}, {mass}");
        assert_eq!(object["jacobians"], right["jacobians"], "{xx}, {mass}");
        let path = file("impossible.urdf");
        let refused = run("inspect", &[path.to_str().expect("UTF-8"), "--what=frames,mass-matrix"]);
        assert_eq!(status(&refused), 1, "{}", text(&refused.stdout));
    }
}

#[test]
fn accelerations_without_masses_are_refused_by_name_with_a_remedy() {
    let path = file("no-masses.urdf");
    std::fs::write(&path, arm("")).expect("a folder");
    for options in [&["--what=accelerations"][..], &[]] {
        let refused = run("inspect", &[&[path.to_str().expect("UTF-8")], options].concat());
        assert_eq!(status(&refused), 1);
        let said = text(&refused.stderr);
        for part in [
            "accelerations (body `base_turn`): `j1`",
            "meets no inertia",
            "--what frames,jacobians",
        ] {
            assert!(said.contains(part), "{said}");
        }
    }
}

#[test]
fn a_link_without_gravity_has_none_in_accelerations_and_efforts() {
    let model = "<sdf version=\"1.10\"><model name=\"m\">\
        <link name=\"base\"><inertial><mass>1</mass></inertial></link>\
        <link name=\"rod\"><pose>0 0 1 0 0 0</pose><gravity>false</gravity><inertial><pose>0.3 0 0 0 0 0</pose>\
        <mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.02</iyy><izz>0.02</izz></inertia></inertial></link>\
        <joint name=\"bolt\" type=\"fixed\"><parent>world</parent><child>base</child></joint>\
        <joint name=\"pin\" type=\"revolute\"><parent>base</parent><child>rod</child><axis><xyz>0 1 0</xyz></axis></joint>\
        </model></sdf>";
    let object = inspected("weightless.sdf", model, &["--joint=pin=0.4"]);
    for key in ["accelerations", "gravity", "bias", "efforts"] {
        close(key, &object[key], &[0.0]);
    }
}

#[test]
fn gravcomp_of_parts_that_are_fixed_to_each_other_and_armature_without_weight_act_as_in_mujoco() {
    let model = r#"<mujoco><compiler angle="radian"/><worldbody>
        <body name="stand" gravcomp="1" pos="0 0 1"><geom type="box" size="0.1 0.1 0.1" mass="3"/>
        <body name="arm" pos="0 0 0.2" gravcomp="0.25"><joint name="pivot" axis="0 1 0"/>
        <geom type="box" pos="0.2 0 0" size="0.2 0.02 0.02" mass="1"/>
        <body name="hand" pos="0.4 0 0" euler="0 0.3 0" gravcomp="1">
        <geom type="box" pos="0.1 0 0" size="0.05 0.05 0.02" mass="0.5"/>
        <body name="finger" pos="0.1 0 0"><joint name="bend" axis="0 1 0"/>
        <geom type="box" pos="0.05 0 0.01" size="0.05 0.01 0.01" mass="0.2"/></body></body></body></body>
        <body name="free" pos="0 2 1"><joint name="base" type="free" armature="0.3"/>
        <geom type="box" pos="0.1 0 0.05" size="0.1 0.05 0.02" mass="2"/></body></worldbody></mujoco>"#;
    let options = ["--joint=pivot=0.3,0.5", "--joint=bend=-0.4,-1.1"];
    let object = inspected("carried.xml", model, &options);
    // reference values by MuJoCo 4.0.0
    #[rustfmt::skip]
    let expected = [
        8.398896145853247, 79.07122758709191, -0.03586996133487117, 0.0, -8.458694859938955, 0.0, 0.8250091107020374, 0.0,
    ];
    close("accelerations", &object["accelerations"], &expected);
    close(
        "place",
        &object["frames"]["hand"]["position"],
        &[0.3821345956502424, 0.0, 1.0817919173354642],
    );
    let [cosine, sine] = [0.825335614909678, 0.5646424733950353];
    let turn = [cosine, 0.0, sine, 0.0, 1.0, 0.0, -sine, 0.0, cosine];
    close("axes", &object["frames"]["hand"]["rotation"], &turn);
}

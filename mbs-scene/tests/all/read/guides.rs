//! Guides of whole joints and of bodies: they are read to the intended data and written back. Invalid guides are refused at their place.

use super::{refused, spoil};
use mbs_core::scene::*;
use mbs_scene::SceneFile;
use mbs_scene::to_toml;

const SCENE: &str = r#"[scene]
dimension = 3
duration = 4
[[body]]
name = "platform"
mass = 2
center = [0, 0, 1]
inertia = [1, 1, 1, 0, 0, 0]
[[body]]
name = "head"
mass = 1
center = [0, 0, 2]
inertia = [1, 1, 1, 0, 0, 0]
[[body]]
name = "plate"
mass = 1
center = [0, 1, 2]
inertia = [1, 1, 1, 0, 0, 0]
[[joint]]
name = "neck"
kind = "spherical"
bodies = ["platform", "head"]
at = [0, 0, 1.5]
[[joint]]
name = "bolt"
kind = "weld"
bodies = ["head", "plate"]
at = [0, 0.5, 2]
[[guide]]
joint = "neck"
signals = ["still", "wave", "still"]
[[guide]]
body = "platform"
signals = ["wave", "wave", "wave", "still", "still", "rise"]
[[signal]]
name = "still"
kind = "constant"
value = 0.1
[[signal]]
name = "wave"
kind = "sine"
amplitude = 0.1
frequency = 2
[[signal]]
name = "rise"
kind = "step"
to = 1
at = 0.5
rise = 0.2
[[output]]
name = "effort"
joint = "platform"
quantity = "effort"
"#;

fn numbers(text: &str) -> Scene<Number> {
    SceneFile::parse(text, "test.toml").and_then(|f| f.numbers()).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn a_guided_body_has_a_free_joint_of_its_name_and_a_guide_for_each_signal() {
    let scene = numbers(SCENE).resolve::<f64>().expect("a scene that can be meant");
    let joint = &scene.joints[2];
    assert_eq!((joint.name.as_str(), joint.kind), ("platform", JointKind::Free));
    assert_eq!(joint.bodies, [BodyId::Ground, BodyId::Body(0)]);
    assert_eq!(joint.points, [[0.0, 0.0, 1.0]; 2], "the centre of mass");
    let of = |guide: &Guide<f64>| {
        let Motion::Signal(signal) = guide.law else { panic!("a signal") };
        (guide.joint.index(), guide.number, signal.index())
    };
    let guides: Vec<_> = scene.guides.iter().map(of).collect();
    let neck = [(0, 0, 0), (0, 1, 1), (0, 2, 0)];
    let platform = [(2, 0, 1), (2, 1, 1), (2, 2, 1), (2, 3, 0), (2, 4, 0), (2, 5, 2)];
    assert_eq!(guides, [&neck[..], &platform].concat());
    let at = SCENE.replacen("body = \"platform\"\n", "body = \"platform\"\nat = [1, 2, 3]\n", 1);
    assert_eq!(
        numbers(&at).resolve::<f64>().expect("it is meant").joints[2].points,
        [[1.0, 2.0, 3.0]; 2]
    );
}

#[test]
fn guides_of_whole_joints_read_back_as_they_were_written() {
    let scene = numbers(SCENE);
    let text = to_toml(&scene).expect("no code in it");
    assert_eq!(numbers(&text), scene, "{text}");
    // Each coordinate may have a motion of another form.
    let each = "joint = \"neck\"\ncoordinate = 0\nramp = { rate = 1 }\n[[guide]]\njoint = \"neck\"\ncoordinate = 1\n\
                sine = { amplitude = 1, frequency = 2 }\n[[guide]]\njoint = \"neck\"\ncoordinate = 2\nsignal = \"rise\"";
    let text =
        SCENE.replacen("joint = \"neck\"\nsignals = [\"still\", \"wave\", \"still\"]", each, 1);
    let scene = numbers(&text);
    scene.resolve::<f64>().expect("a scene that can be meant");
    assert_eq!(numbers(&to_toml(&scene).expect("no code in it")), scene);
}

#[test]
fn guides_that_cannot_be_meant_are_refused_at_their_place() {
    let spoiled = |from: &str, to: &str| spoil(SCENE, from, to);
    let neck = "signals = [\"still\", \"wave\", \"still\"]";
    let few = spoiled(neck, "signals = [\"still\", \"wave\"]");
    refused(
        &few,
        "31:11",
        "`signals` is guided by 2 of the 3 motions that its joint needs",
        "`signals`",
    );
    let many = spoiled(neck, "signals = [\"still\", \"wave\", \"still\", \"still\"]");
    refused(
        &many,
        "31:11",
        "`signals` is guided by 4 of the 3 motions that its joint needs",
        "one name",
    );
    let one = spoiled(neck, "ramp = { rate = 1 }");
    refused(
        &one,
        "30:9",
        "`joint` is guided by 1 of the 3 motions that its joint needs",
        "`signals`",
    );
    let none = spoiled(neck, "signals = []");
    refused(
        &none,
        "31:11",
        "expected a list of names of signals, one for each coordinate, found an empty one",
        "",
    );
    let jump = spoiled("rise = 0.2", "rise = 0");
    refused(&jump, "34:54", "`rise` jumps at 0.5 s", "give it `rise`");
    let unknown = spoiled("\"still\", \"rise\"]", "\"still\", \"rice\"]");
    refused(&unknown, "34:54", "unknown signal `rice`", "did you mean `rise`?");
}

#[test]
fn guides_of_joint_and_body_of_a_body_twice_and_of_welded_bodies_are_refused_at_their_place() {
    let spoiled = |from: &str, to: &str| spoil(SCENE, from, to);
    let neck = "signals = [\"still\", \"wave\", \"still\"]";
    let both = spoiled("joint = \"neck\"\n", "joint = \"neck\"\nbody = \"head\"\n");
    refused(&both, "31:8", "both `joint` and `body` are given", "keep one of the two");
    let law = spoiled(neck, "signals = [\"still\", \"wave\", \"still\"]\nsignal = \"wave\"");
    refused(&law, "31:11", "both `signal` and `signals` are given", "keep one of the two");
    let key = spoiled("body = \"platform\"\n", "body = \"platform\"\nramp = { rate = 1 }\n");
    refused(&key, "35:11", "both `ramp` and `signals` are given", "keep one of the two");
    let ground = spoiled("body = \"platform\"\n", "body = \"ground\"\n");
    refused(&ground, "33:8", "the ground does not move", "name a body");
    let stranger = spoiled("body = \"platform\"\n", "body = \"platfrom\"\n");
    refused(&stranger, "33:8", "unknown body `platfrom`", "did you mean `platform`?");
    let named = spoiled("name = \"neck\"", "name = \"platform\"");
    refused(&named, "33:8", "this name is already that of joint 1", "its own name");
    let twice =
        spoiled("[[output]]", "[[guide]]\nbody = \"platform\"\nsignals = [\"still\"]\n[[output]]");
    refused(&twice, "51:8", "`body` is already prescribed by guide 2", "remove one of the two");
    let again =
        spoiled("[[output]]", "[[guide]]\njoint = \"neck\"\nsignals = [\"still\"]\n[[output]]");
    refused(&again, "51:9", "`joint` is already prescribed by guide 1", "remove one of the two");
    let weld = "kind = \"weld\"\nbodies = [\"head\", \"plate\"]";
    let fixed = spoiled(weld, "kind = \"weld\"\nbodies = [\"ground\", \"platform\"]");
    refused(
        &fixed,
        "33:8",
        "`joint` is between bodies that are welded together",
        "remove the weld",
    );
    let of_weld = spoiled("joint = \"neck\"", "joint = \"bolt\"");
    refused(
        &of_weld,
        "30:9",
        "`joint` is a joint with 0 coordinates; exactly one is needed",
        "revolute",
    );
    let given =
        spoiled("[[output]]", "[[initial]]\njoint = \"neck\"\nvalue = [0.1, 0.0, 0.3]\n[[output]]");
    refused(
        &given,
        "52:9",
        "`value` is 0.3, but the guide of the joint starts with 0.1",
        "remove the initial",
    );
}

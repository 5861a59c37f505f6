//! Outputs of couplings, effects and the whole scene.

use super::{PLANAR, read, refused};
use mbs_core::outputs::RelativePoint;
use mbs_core::scene::*;
use mbs_scene::{SceneFile, to_toml};

const COUPLING: &str = "[[coupling]]\nname = \"mesh\"\nkind = \"gear\"\njoints = [\"pivot\", \"elbow\"]\nteeth = [40, 17]\n\
                        [[effect]]\nname = \"mount\"\nkind = \"bushing\"\nbodies = [\"ground\", \"upper\"]\nat = [0, 0]\nstiffness = [1, 1, 1]\n";

/// The planar scene without its guide, with a coupling, a bushing and one more output.
fn with(output: &str) -> String {
    let guide =
        "[[guide]]\njoint = \"elbow\"\nsine = { amplitude = 0.05, frequency = 0.5, phase = 0.0 }\n";
    format!("{}\n{COUPLING}[[output]]\nname = \"x\"\n{output}\n", PLANAR.replace(guide, ""))
}

#[test]
fn outputs_of_parts_and_of_the_scene_are_read_by_name_with_their_defaults() {
    let cases = [
        ("coupling = \"mesh\"", Quantity::Effort { coupling: CouplingId::new(0) }),
        (
            "coupling = \"mesh\"\nquantity = \"force\"",
            Quantity::Effort { coupling: CouplingId::new(0) },
        ),
        (
            "coupling = \"mesh\"\nquantity = \"power\"",
            Quantity::CouplingPower { coupling: CouplingId::new(0) },
        ),
        ("effect = \"strut\"", Quantity::EffectForce { effect: EffectId::new(0) }),
        (
            "effect = \"strut\"\nquantity = \"length\"",
            Quantity::EffectValue { effect: EffectId::new(0) },
        ),
        // An effect without a name is called by its number.
        ("effect = \"effect-2\"", Quantity::EffectForce { effect: EffectId::new(1) }),
        ("quantity = \"energy\"", Quantity::Energy),
        ("quantity = \"kinetic-energy\"", Quantity::KineticEnergy),
        (
            "body = \"lower\"\nquantity = \"kinetic-energy\"",
            Quantity::BodyKineticEnergy { body: BodyId::Body(1) },
        ),
        (
            "joint = \"elbow\"\nquantity = \"acceleration\"",
            Quantity::JointAcceleration { joint: JointId::new(1) },
        ),
    ];
    for (output, expected) in cases {
        let scene = read(&with(output)).unwrap_or_else(|e| panic!("{output}: {e}"));
        assert_eq!(scene.outputs.last().expect("an output").quantity, expected, "{output}");
    }
}

#[test]
fn outputs_may_be_seen_from_another_body() {
    let read_one = |output: &str| {
        let scene = read(&with(output)).unwrap_or_else(|e| panic!("{output}: {e}"));
        scene.outputs.last().expect("an output").quantity.clone()
    };
    let [upper, lower] = [0, 1].map(BodyId::Body);
    let seen = |relative_to, origin| RelativePoint {
        body: lower,
        at: [2.0, 0.0, 0.0],
        relative_to,
        origin,
    };
    let point = "body = \"lower\"\nat = [2, 0]\n";
    // The default of both places is the centre of mass.
    let bare = RelativePoint { at: [1.5, 0.0, 0.0], ..seen(upper, [0.5, 0.0, 0.0]) };
    assert_eq!(
        read_one("body = \"lower\"\nrelative_to = \"upper\""),
        Quantity::RelativePosition(bare)
    );
    assert_eq!(
        read_one(&format!("{point}relative_to = \"upper\"")),
        Quantity::RelativePosition(seen(upper, [0.5, 0.0, 0.0]))
    );
    assert_eq!(
        read_one(&format!(
            "{point}relative_to = \"upper\"\norigin = [1, 0]\nquantity = \"velocity\""
        )),
        Quantity::RelativeVelocity(seen(upper, [1.0, 0.0, 0.0]))
    );
    assert_eq!(
        read_one(&format!("{point}relative_to = \"ground\"\nquantity = \"acceleration\"")),
        Quantity::RelativeAcceleration(seen(BodyId::Ground, [0.0; 3]))
    );
    assert_eq!(
        read_one("body = \"lower\"\nrelative_to = \"upper\"\nquantity = \"angular-velocity\""),
        Quantity::RelativeAngularVelocity { body: lower, relative_to: upper }
    );
    let refusal = |output: &str| read(&with(output)).expect_err("it is refused");
    let line = with("").lines().count();
    let e = refusal("body = \"lower\"\nrelative_to = \"uper\"\nat = [2, 0]");
    refused(&e, &format!("{}:15", line + 1), "unknown body `uper`", "`upper`");
    let e = refusal("body = \"lower\"\nrelative_to = \"upper\"\nquantity = \"orientation\"");
    refused(
        &e,
        &format!("{}:12", line + 2),
        "unknown quantity `orientation`",
        "choices: position, velocity, acceleration, distance, angular-velocity, camber, toe, caster",
    );
    let e = refusal("body = \"lower\"\nquantity = \"camber\"\nside = \"left\"");
    refused(&e, &format!("{}:1", line - 2), "`relative_to` is missing", "relative_to");
    let e = refusal("body = \"lower\"\nrelative_to = \"upper\"\nquantity = \"toe\"");
    refused(&e, &format!("{}:1", line - 2), "`side` is missing", "side");
    let wheel = "body = \"lower\"\nrelative_to = \"upper\"\nquantity = \"toe\"\nside = ";
    let e = refusal(&format!("{wheel}\"middle\""));
    refused(&e, &format!("{}:8", line + 3), "unknown side `middle`", "choices: left, right");
    let e = refusal(&format!("{wheel}\"left\""));
    refused(&e, &format!("{}:12", line + 2), "`quantity` needs a spatial scene", "dimension = 3");
    let e = refusal("body = \"lower\"\nat = [2, 0]\norigin = [1, 0]");
    refused(&e, &format!("{}:1", line + 2), "`origin` has no meaning here", "keys");
}

#[test]
fn the_axes_of_an_output_are_global_or_those_of_a_body() {
    let [upper, lower] = [0, 1].map(BodyId::Body);
    let point = "body = \"lower\"\nat = [2, 0]\nquantity = \"proper-acceleration\"\n";
    let cases = [
        (point.to_owned(), None),
        (format!("{point}frame = \"global\""), Some(BodyId::Ground)),
        (format!("{point}frame = \"ground\""), Some(BodyId::Ground)),
        (format!("{point}frame = \"body\""), Some(lower)),
        (format!("{point}frame = \"upper\""), Some(upper)),
        ("joint = \"elbow\"\nquantity = \"reaction\"\nframe = \"lower\"".to_owned(), Some(lower)),
        ("effect = \"mount\"\nframe = \"upper\"".to_owned(), Some(upper)),
        ("quantity = \"momentum\"\nframe = \"upper\"".to_owned(), Some(upper)),
    ];
    for (output, expected) in cases {
        let numbers = |text: &str| SceneFile::parse(text, "x").and_then(|file| file.numbers());
        let scene = numbers(&with(&output)).unwrap_or_else(|e| panic!("{output}: {e}"));
        assert_eq!(scene.outputs.last().expect("an output").frame, expected, "{output}");
        let again = numbers(&mbs_scene::to_toml(&scene).expect("no code in it"));
        assert_eq!(again.expect("it reads").outputs, scene.outputs, "{output}");
    }
    let refusal = |output: &str| read(&with(output)).expect_err("it is refused");
    let line = with("").lines().count();
    let e = refusal("joint = \"elbow\"\nquantity = \"reaction\"\nframe = \"body\"");
    let of_no_body = "this output is of no body, whose axes `body` would be";
    refused(&e, &format!("{}:9", line + 2), of_no_body, "name of the body");
    let e = refusal("body = \"lower\"\nat = [2, 0]\nframe = \"uper\"");
    refused(&e, &format!("{}:9", line + 2), "unknown body `uper`", "`upper`");
    for scalar in [
        "joint = \"elbow\"",
        "effect = \"strut\"",
        "quantity = \"energy\"",
        "body = \"lower\"\nquantity = \"orientation\"",
        "body = \"lower\"\nquantity = \"angular-velocity\"",
    ] {
        let e = refusal(&format!("{scalar}\nframe = \"upper\""));
        let line = line + scalar.lines().count();
        assert_eq!((e.place().line, e.place().column), (line, 9), "{e}");
        assert!(
            e.to_string().ends_with("no axes") && e.hint().contains("leave the key out"),
            "{e}"
        );
    }
}

#[test]
fn components_have_the_units_of_what_they_are_of() {
    let units = |output: &str| -> Vec<String> {
        let scene = read(&with(output)).unwrap_or_else(|e| panic!("{output}: {e}"));
        let components = scene.outputs.last().expect("an output").quantity.components(&scene);
        components.into_iter().map(|c| format!("{} {}", c.label, c.unit)).collect()
    };
    assert_eq!(units("coupling = \"mesh\""), [" N m"]);
    assert_eq!(units("coupling = \"mesh\"\nquantity = \"rate\""), [" rad/s"]);
    assert_eq!(units("effect = \"strut\""), [" N"]);
    assert_eq!(units("effect = \"strut\"\nquantity = \"value\""), [" m"]);
    assert_eq!(units("effect = \"effect-2\"\nquantity = \"value\""), [" rad"]);
    assert_eq!(units("effect = \"mount\""), ["Fx N", "Fy N", "Mz N m"]);
    assert_eq!(units("joint = \"elbow\"\nquantity = \"effort\""), [" N m"]);
    assert_eq!(units("quantity = \"momentum\""), ["x kg m/s", "y kg m/s"]);
    let orientation = "body = \"lower\"\nquantity = \"orientation\"";
    assert_eq!(units(orientation), [" rad"]);
    assert_eq!(units(&format!("{orientation}\nas = \"matrix\"")), ["xx -", "xy -", "yx -", "yy -"]);
    assert_eq!(units(&format!("{orientation}\nas = \"rotation-vector\"")), [" rad"]);
    assert_eq!(units("effect = \"strut\"\nquantity = \"deflection\""), [" m"]);
    assert_eq!(units("joint = \"elbow\"\nquantity = \"power\""), [" W"]);
}

#[test]
fn degrees_are_of_angles_alone() {
    let angles = [
        "joint = \"elbow\"",
        "joint = \"elbow\"\nquantity = \"rate\"",
        "body = \"lower\"\nquantity = \"angular-acceleration\"",
        "coupling = \"mesh\"\nquantity = \"value\"",
    ];
    for output in angles {
        let text = with(&format!("{output}\nunit = \"deg\""));
        let scene = read(&text).unwrap_or_else(|e| panic!("{output}: {e}"));
        assert!(scene.outputs.last().expect("an output").is_in_degrees, "{output}");
        // The written scene has the same outputs.
        let file = SceneFile::parse(&text, "x.toml").expect("it reads");
        let numbers = file.numbers().expect("it reads");
        let again = to_toml(&numbers).expect("it is written");
        assert!(again.contains("unit = \"deg\""), "{again}");
        assert!(read(&again).expect("it reads back").outputs == scene.outputs);
    }
    let line = with("").lines().count();
    let refusal = |output: &str| read(&with(output)).expect_err("it is refused");
    for number in [
        "joint = \"elbow\"\nquantity = \"reaction\"",
        "body = \"lower\"\nat = [2, 0]",
        "effect = \"strut\"\nquantity = \"rate\"",
        "coupling = \"mesh\"\nquantity = \"power\"",
    ] {
        let n = number.lines().count();
        let e = refusal(&format!("{number}\nunit = \"deg\""));
        let message = "`unit` is of angles, their rates and their accelerations alone";
        refused(&e, &format!("{}:8", line + n), message, "leave the key out");
    }
    let e = refusal("joint = \"elbow\"\nunit = \"degrees\"");
    refused(&e, &format!("{}:8", line + 1), "unknown unit `degrees`", "choices: deg");
}

#[test]
fn outputs_of_unknown_parts_are_refused_at_the_name() {
    let refusal = |output: &str| read(&with(output)).expect_err("it is refused");
    let line = with("").lines().count();
    let at = |column: usize| format!("{line}:{column}");
    let e = refusal("coupling = \"mash\"");
    refused(&e, &at(12), "unknown coupling `mash`", "`mesh`");
    let e = refusal("effect = \"struts\"");
    refused(&e, &at(10), "unknown effect `struts`", "`strut`");
    let e = refusal("effect = \"strut\"\ncoupling = \"mesh\"");
    refused(&e, &format!("{line}:10"), "both `coupling` and `effect` are given", "keep one");
    let e = refusal("effect = \"strut\"\nquantity = \"forse\"");
    refused(&e, &format!("{}:12", line + 1), "unknown quantity `forse`", "`force`");
    let e = refusal("effect = \"mount\"\nquantity = \"value\"");
    let message =
        "`quantity` is not measured by this effect, which acts on bodies in several directions";
    refused(&e, &format!("{}:12", line + 1), message, "`force`");
    let e = refusal("effect = \"strut\"\nquantity = \"contact\"");
    let message = "`quantity` is not known of this effect, which acts on both sides";
    refused(&e, &format!("{}:12", line + 1), message, "a bumper, a limit or a tire");
    let e = refusal("effect = \"mount\"\nquantity = \"deflection\"");
    let message =
        "`quantity` is not known of this effect, which has neither a free value nor a gap";
    refused(&e, &format!("{}:12", line + 1), message, "a spring, a bumper, a limit or a tire");
    let e = refusal("body = \"lower\"\nquantity = \"orientation\"\nas = \"matrx\"");
    refused(&e, &format!("{}:6", line + 2), "unknown as `matrx`", "`matrix`");
    let e = refusal("body = \"lower\"\nquantity = \"kinetic-energy\"\nas = \"matrix\"");
    refused(&e, &format!("{}:1", line + 2), "`as` has no meaning here", "keys");
    let e = refusal("quantity = \"position\"");
    refused(
        &e,
        &format!("{}:1", line - 2),
        "`joint, body, coupling, rolling, effect or signal` is missing",
        "`coupling`, `rolling`, `effect` or `signal`",
    );
}

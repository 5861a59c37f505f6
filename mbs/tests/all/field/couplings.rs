//! Couplings have the sense of the drawing: neither the order of a joint's bodies nor the sense of an axis changes it.

use super::{by_tolerance, field, last, read, text};
use crate::common::{run, run_in};
use mbs::FormulationKind;
use mbs::core::scene::Scene;
use mbs::scene_file::SceneFile;

/// Asserts the values of columns at the end of a run, in every formulation.
fn ends_with(name: &str, scene: &Scene<f64>, values: &[(usize, f64)]) {
    let found = run(scene, &by_tolerance("rk853", None));
    for &(column, right) in values {
        let found = last(&found)[column];
        assert!((found - right).abs() < 1e-9 * right.abs(), "{name}: {found}, {right}");
    }
    for formulation in FormulationKind::ALL.map(FormulationKind::name) {
        let coarse = run_in(scene, formulation, Some(1e-3));
        // steps that the energy controls are no longer than those of index-3, which has the same rule
        let fixed = if formulation == "multi-index" { "index-3" } else { formulation };
        let rule = [1e-3, 5e-4].map(|step| run_in(scene, fixed, Some(step)));
        for &(column, right) in values {
            let coarse = last(&coarse)[column];
            let [one, half] = [&rule[0], &rule[1]].map(|run| last(run)[column]);
            // this is the largest error of a rule with an order of at least 1.9
            let by_the_rule = 1.37 * (one - half).abs() + 1e-9 * right.abs();
            assert!(
                (coarse - right).abs() < by_the_rule,
                "{name}, {formulation}: {coarse}, {right}"
            );
        }
    }
}

/// Rates of both wheels after 0.4 s with 0.7 N m on the first, whose effective inertia is 0.02 + (2/3)² 0.04 kg m² [rad/s].
const WHEELS: [f64; 2] = [7.411_764_705_882_353, 4.941_176_470_588_235];

#[test]
fn wheels_turn_as_they_are_drawn_whatever_the_order_of_bodies_and_the_sense_of_axes() {
    let [one, two] = WHEELS;
    let gear = text("22-gear-joint-wheel-first");
    let belt = text("22-belt-axes-opposite");
    for bodies in [r#"["two", "ground"]"#, r#"["ground", "two"]"#] {
        let gear = gear.replace(r#"["two", "ground"]"#, bodies);
        ends_with("gear", &read(&gear, "gear"), &[(0, one), (1, -two)]);
        for axis in ["[0.0, 0.0, -1.0]", "[0.0, 0.0, 3.0]"] {
            let belt = belt.replace("[0.0, 0.0, -1.0]", axis);
            let belt = belt.replace(r#"["ground", "two"]"#, bodies);
            ends_with("belt", &read(&belt, "belt"), &[(2, one), (5, two)]);
            let crossed = belt.replace("radii =", "crossed = true\nradii =");
            ends_with("crossed belt", &read(&crossed, "belt"), &[(2, one), (5, -two)]);
        }
    }
}

#[test]
fn sums_and_signals_take_the_coordinates_of_a_free_body_in_every_formulation() {
    // the line y moves by -0.02 m per radian: 0.3 g / (0.3 + 1e-4 / 0.02^2) over 0.3 s
    let fall = -0.5 * 9.81 * 0.3 / (0.3 + 0.25) * 0.09;
    let reel = text("26-coupling-on-a-free-body");
    ends_with("reel", &read(&reel, "reel"), &[(1, fall), (2, -fall / 0.02)]);
    // the equation of motion is 2 x'' = -80 x
    let disc = text("26-signal-on-a-free-body");
    ends_with("disc", &read(&disc, "disc"), &[(0, 0.1 * (40.0_f64.sqrt() * 0.3).cos())]);
    // an effect on a sum of coordinates gives the same motion
    let effect = disc.find("[[signal]]").zip(disc.find("[[initial]]"));
    let (from, to) = effect.expect("signals and a start");
    let spring = "[[effect]]\nkind = \"spring-damper\"\nterms = [{ joint = \"place\", coordinate = \"x\", factor = 1.0 }]\n\
                  stiffness = 80.0\n\n";
    let sprung = format!("{}{spring}{}", &disc[..from], &disc[to..]);
    ends_with("sum", &read(&sprung, "sum"), &[(0, 0.1 * (40.0_f64.sqrt() * 0.3).cos())]);
}

/// A spatial body whose x is twice its y falls along (2, 1), by the component of gravity along this line.
#[test]
fn a_free_body_in_space_keeps_to_a_line_whatever_the_order_of_the_bodies() {
    let scene = |bodies: &str, inertia: &str| {
        format!(
            "[scene]\ndimension = 3\nduration = 0.5\ngravity = [1.0, -9.81, 2.0]\n\
             [[body]]\nname = \"box\"\nmass = 2.0\ncenter = [0.1, 0.2, 0.3]\ninertia = {inertia}\n\
             [[joint]]\nname = \"place\"\nkind = \"free\"\nbodies = {bodies}\n\
             [[coupling]]\nname = \"line\"\nkind = \"linear\"\nterms = [{{ joint = \"place\", coordinate = \"x\", factor = 1.0 }}, \
             {{ joint = \"place\", coordinate = \"y\", factor = -2.0 }}]\n\
             [[output]]\nname = \"at\"\nbody = \"box\"\nquantity = \"position\"\n"
        )
    };
    let along = (2.0 - 9.81) / 5.0 * 0.5 * 0.25;
    let right = [(0, 0.1 + 2.0 * along), (1, 0.2 + along), (2, 0.3 + 0.25)];
    let text = scene("[\"ground\", \"box\"]", "[0.1, 0.2, 0.25, 0.0, 0.0, 0.0]");
    ends_with("box", &read(&text, "box"), &right);
    // a reversed joint measures the ground in axes of the box, which rotate: the force acts through a point of the ground
    let text = scene("[\"box\", \"ground\"]", "[0.1, 0.2, 0.25, 0.0, 0.0, 0.0]");
    let scene = read(&text, "reversed");
    let found = last(&run(&scene, &by_tolerance("rk853", None))).to_vec();
    assert!((found[0] - right[0].1).abs() > 0.01, "{found:?}");
    ends_with("reversed", &scene, &[(0, found[0]), (1, found[1]), (2, found[2])]);
}

/// Torque of the coupling: on the first wheel 0.7 − 0.02 α, on the second 0.04 α 2/3, with the acceleration α.
#[test]
fn efforts_are_torques_forces_and_tensions_of_the_drawn_machine() {
    let torque = -(0.7 - 0.02 * WHEELS[0] / 0.4);
    let gear = text("22-gear-joint-wheel-first");
    let power = "[[output]]\nname = \"power\"\ncoupling = \"mesh\"\nquantity = \"power\"\n";
    let with_power = format!("{gear}\n{power}");
    let right = [(2, torque), (3, torque * WHEELS[0])];
    ends_with("torque of a gear", &read(&with_power, "gear"), &right);
    let ratio = gear.replace("teeth = [20, 30]", "ratio = 0.6666666666666667");
    ends_with("torque by a ratio", &read(&ratio, "gear"), &[(2, torque)]);
    let belt = text("22-belt-axes-opposite");
    ends_with("strands of a belt", &read(&belt, "belt"), &[(6, torque / 0.1)]);
    let power = power.replace("\"mesh\"", "\"differential\"");
    let effort = power.replace("power", "effort");
    let differential = format!("{}\n{effort}{power}", text("22-differential-axes-outward"));
    // each half shaft of 0.03 kg m² accelerates by 25 rad/s²
    ends_with("differential", &read(&differential, "d"), &[(9, 0.75), (10, 0.75 * 12.5)]);
    // tension T and acceleration a follow from 60 (g − a) = T and 0.25 T = 0.5 a/0.25
    ends_with("tension of a rope", &field("29-axle-of-a-winch"), &[(3, 69.247_058_823_529_41)]);
    ends_with("force of a thread", &field("30-lead-screw"), &[(0, 600.0)]);
    let units = |name: &str| {
        let scene = field(name);
        let efforts = scene.outputs.iter().filter(|output| {
            output.name == "mesh" || output.name == "thread" || output.name == "rope"
        });
        efforts.flat_map(|output| output.components(&scene)).map(|one| one.unit).collect::<Vec<_>>()
    };
    assert_eq!(units("22-gear-joint-wheel-first"), ["N m"]);
    assert_eq!(units("22-belt-axes-opposite"), ["N"]);
    assert_eq!(units("29-axle-of-a-winch"), ["N"]);
    assert_eq!(units("30-lead-screw"), ["N"]);
}

/// Bearings carry the forces of rope and thread: the drum and the screw need them in addition to their weight and torque.
#[test]
fn bearings_carry_what_the_drawn_machine_puts_on_them() {
    let tension = 69.247_058_823_529_41;
    let axle = [(0, 0.0), (1, 20.0 * 9.81 + tension), (2, 0.0)];
    let winch = text("29-axle-of-a-winch");
    reacts("axle", &read(&winch, "winch"), &axle);
    let swapped = winch.replace(r#"bodies = ["ground", "drum"]"#, r#"bodies = ["drum", "ground"]"#);
    let swapped = swapped.replace("radius = 0.25", "radius = -0.25");
    reacts("axle, swapped", &read(&swapped, "winch"), &axle.map(|(k, right)| (k, -right)));
    let moment = -600.0 * 0.02 / core::f64::consts::TAU;
    let right = [(1, 600.0), (2, 0.0), (3, 0.0), (4, 0.0), (5, 0.0), (6, 0.0)];
    let bearing = text("30-lead-screw");
    reacts("bearing", &read(&bearing, "screw"), &right);
    let guide = [(7, 0.0), (8, 0.0), (9, 0.0), (10, moment), (11, 0.0), (12, 0.0)];
    reacts("guide", &read(&bearing, "screw"), &guide);
}

/// Forces of a belt with the pretension S. Both strands pull by 2 S sqrt(1 - c²) between the axes, and their difference F by -F c across. c
/// is (r1 - r2)/D, or (r1 + r2)/D if the belt is crossed.
#[test]
fn bearings_carry_the_strands_of_a_belt() {
    let torque = -(0.7 - 0.02 * WHEELS[0] / 0.4);
    let outputs = ["one", "two"].map(|joint| {
        format!(
            "\n[[output]]\nname = \"R {joint}\"\njoint = \"{joint}\"\nquantity = \"reaction\"\n"
        )
    });
    let belt = text("22-belt-axes-opposite").replace("radii =", "pretension = 500.0\nradii =");
    let belt = format!("{belt}{}", outputs.concat());
    // the radii have the same ratio, which gives the same motion
    let crossed = belt.replace("radii = [0.1, 0.15]", "crossed = true\nradii = [0.08, 0.12]");
    for (text, radius, c) in [(belt, 0.1, -0.2), (crossed, 0.08, 0.8_f64)] {
        let across = -torque / radius * c;
        let between = 1000.0 * (1.0 - c * c).sqrt();
        let one = [-between, across, 0.0, 0.0, 0.0, 0.0];
        for (swap, sign) in [("[\"ground\", \"two\"]", 1.0), ("[\"two\", \"ground\"]", -1.0)] {
            let text = text.replace("[\"ground\", \"two\"]", swap);
            let of_one = one.iter().enumerate().map(|(k, right)| (7 + k, *right));
            let of_two = one.iter().enumerate().map(|(k, right)| (13 + k, -sign * right));
            let all: Vec<_> = of_one.chain(of_two).collect();
            reacts("belt", &read(&text, "belt"), &all);
        }
    }
}

#[test]
fn a_strand_that_would_push_is_noted_and_strands_that_nobody_knows_are_refused() {
    let belt = |pretension: &str| {
        text("22-belt-axes-opposite").replace("radii =", &format!("{pretension}\nradii ="))
    };
    let notes = |text: &str| {
        let outcome = run_in(&read(text, "belt"), "index-3", None);
        outcome.notes().iter().filter(|note| note.contains("pushes")).cloned().collect::<Vec<_>>()
    };
    // the pretension must be half of the transmitted 3.29 N at least
    assert_eq!(notes(&belt("pretension = 1.7")), [""; 0]);
    let found = notes(&belt("pretension = 1.6"));
    assert!(
        found.len() == 1
            && found[0].contains("`mesh`")
            && found[0].contains("`pretension` of 1.6 N"),
        "{found:?}"
    );
    let tight = belt("pretension = 100.0");
    let deep = tight.replacen("at = [0.25, 0.0, 0.0]", "at = [0.25, 0.0, 0.02]", 1);
    assert!(
        refused(&deep).contains("stand 2.000000e-2 m apart along the axes"),
        "{}",
        refused(&deep)
    );
    let large = tight.replace("[0.1, 0.15]", "[0.1, 0.4]");
    assert!(refused(&large).contains("too near for wheels"), "{}", refused(&large));
    let negative = belt("pretension = -1.0");
    assert!(refused(&negative).contains("pretension"), "{}", refused(&negative));
}

/// Asserts columns of reactions at the end of a run in every formulation. Zeros are compared with the rounding of the largest reaction.
fn reacts(name: &str, scene: &Scene<f64>, values: &[(usize, f64)]) {
    let largest = values.iter().fold(1.0, |most: f64, (_, right)| most.max(right.abs()));
    for formulation in FormulationKind::ALL.map(FormulationKind::name) {
        let found = run_in(scene, formulation, Some(1e-3));
        for &(column, right) in values {
            let found = last(&found)[column];
            assert!(
                (found - right).abs() < 1e-6 * largest,
                "{name}, {formulation}: {found}, {right}"
            );
        }
    }
}

#[test]
fn radii_that_do_not_meet_the_distance_of_the_axes_are_noted() {
    let gear = text("22-gear-joint-wheel-first");
    let notes = |teeth: &str| {
        let scene = read(&gear.replace("teeth = [20, 30]", teeth), "gear");
        scene.radii_notes().map(|(_, note)| note).collect::<Vec<_>>()
    };
    assert_eq!(notes("radii = [0.1, 0.15]"), [""; 0]);
    assert_eq!(notes("mesh = \"internal\"\nradii = [0.5, 0.75]"), [""; 0]);
    let found = notes("radii = [0.2, 0.3]");
    assert!(
        found.len() == 1
            && found[0].contains("0.250000 m apart")
            && found[0].contains("0.500000 m"),
        "{found:?}"
    );
}

#[test]
fn reactions_without_a_line_of_action_are_marked() {
    let notes = |text: &str| {
        let outcome = run_in(&read(text, "marked"), "recursive", Some(1e-3));
        outcome.notes().iter().filter(|note| note.contains("lacks")).cloned().collect::<Vec<_>>()
    };
    let reaction = "[[output]]\nname = \"bearing\"\njoint = \"one\"\nquantity = \"reaction\"\n";
    let gear = format!("{}\n{reaction}", text("22-gear-joint-wheel-first"));
    let found = notes(&gear);
    assert!(
        found.len() == 1 && found[0].contains("gear `mesh`") && found[0].contains("`at`"),
        "{found:?}"
    );
    assert!(notes(&gear.replace("teeth =", "at = [0.1, 0.0]\nteeth =")).is_empty());
    assert!(notes(&text("22-gear-joint-wheel-first")).is_empty());
    let winch = text("29-axle-of-a-winch");
    assert!(notes(&winch).is_empty());
    // a line that does not begin at the rim is noted
    let found = notes(&winch.replace("at = [0.25, 3.0]", "at = [0.25, 3.1]"));
    assert!(
        found.len() == 1 && found[0].contains("rope `rope`") && found[0].contains("rim"),
        "{found:?}"
    );
}

#[test]
fn half_shafts_turn_alike_with_axes_outward_or_inward() {
    let outward = text("22-differential-axes-outward");
    let all = [(1, 12.5), (4, 12.5), (7, 12.5)];
    ends_with("outward", &read(&outward, "differential"), &all);
    let alike = outward.replace("axis = [0.0, -1.0, 0.0]", "axis = [0.0, 1.0, 0.0]");
    ends_with("alike", &read(&alike, "differential"), &all);
    let swapped = outward.replace(r#"["ground", "cage"]"#, r#"["cage", "ground"]"#);
    ends_with("swapped", &read(&swapped, "differential"), &all);
}

/// Rates of sun s, arm c and planet p from their equations, with r1 (s − c) + r2 (p − c) = 0.
#[test]
fn a_planet_on_an_arm_rolls_on_the_sun_that_turns_on_the_ground() {
    let right = [2.127_659_574_468_085, 4.113_475_177_304_965, 7.092_198_581_560_283];
    let right: Vec<(usize, f64)> = right.into_iter().enumerate().collect();
    ends_with("arm", &field("22-gear-on-an-arm"), &right);
    let swapped = text("22-gear-on-an-arm").replace(r#"["ground", "arm"]"#, r#"["arm", "ground"]"#);
    ends_with("arm swapped", &read(&swapped, "arm"), &right);
}

#[test]
fn another_sense_than_that_of_version_0_1_is_noted_until_the_scene_says_that_it_is_meant() {
    let wheel_first = text("22-gear-joint-wheel-first");
    let notes = |text: &str| {
        let outcome = run_in(&read(text, "gear"), "recursive", Some(1e-3));
        outcome.notes().iter().filter(|note| note.contains("sense")).cloned().collect::<Vec<_>>()
    };
    let found = notes(&wheel_first);
    assert!(found.len() == 1 && found[0].contains("gear `mesh`"), "{found:?}");
    assert!(notes(&wheel_first.replace("teeth =", "sense = \"drawn\"\nteeth =")).is_empty());
    assert!(notes(&wheel_first.replace(r#"["two", "ground"]"#, r#"["ground", "two"]"#)).is_empty());
    let linear = "kind = \"linear\"\nterms = [{ joint = \"one\", factor = 20 }, { joint = \"two\", factor = 30 }]";
    let sum = wheel_first
        .replace("kind = \"gear\"\njoints = [\"one\", \"two\"]\nteeth = [20, 30]", linear);
    assert!(notes(&sum).is_empty());
    // the motion is that of version 0.1
    ends_with("sum", &read(&sum, "sum"), &[(0, WHEELS[0]), (1, WHEELS[1])]);
}

#[test]
fn wheels_without_a_body_that_carries_both_are_refused_with_the_joint_to_add() {
    let off = text("22-gear-on-an-arm").replace(
        "name = \"arm\"\nkind = \"revolute\"\nbodies = [\"ground\", \"arm\"]\nat = [0.0, 0.0]",
        "name = \"arm\"\nkind = \"revolute\"\nbodies = [\"ground\", \"arm\"]\nat = [0.01, 0.0]",
    );
    let refused = refused(&off);
    for part in ["`arm`", "`ground`", "`sun`", "add a joint", "joints = "] {
        assert!(refused.contains(part), "{part}: {refused}");
    }
}

#[test]
fn a_rack_on_the_axis_of_its_pinion_is_taken_as_written_with_a_note_or_refused() {
    let rack = r#"
[scene]
dimension = 2
duration = 0.1
[[body]]
name = "pinion"
mass = 1.0
center = [0.0, 0.0]
inertia = 0.1
[[body]]
name = "rack"
mass = 1.0
center = [0.0, 0.0]
inertia = 0.1
[[joint]]
name = "turn"
kind = "revolute"
bodies = ["ground", "pinion"]
at = [0.0, 0.0]
[[joint]]
name = "slide"
kind = "prismatic"
bodies = ["ground", "rack"]
at = [0.3, 0.0]
axis = [1.0, 0.0]
[[coupling]]
kind = "rack"
joints = ["turn", "slide"]
radius = 0.2
[[initial]]
joint = "turn"
rate = 1.0
[[output]]
name = "slide"
joint = "slide"
"#;
    let slid = |text: &str| {
        let outcome = run_in(&read(text, "rack"), "recursive", Some(1e-3));
        let is_noted = outcome.notes().iter().any(|note| note.contains("rack `coupling-1`"));
        (last(&outcome)[0], is_noted)
    };
    let (way, is_noted) = slid(rack);
    assert!((way - 0.02).abs() < 1e-12 && is_noted);
    // above the axis the teeth move against the sense of rotation, below it with it
    for (at, right) in [("[0.3, 0.2]", -0.02), ("[0.3, -0.2]", 0.02)] {
        let (way, is_noted) = slid(&rack.replace("[0.3, 0.0]", at));
        assert!((way - right).abs() < 1e-12, "{at}: {way}");
        assert_eq!(is_noted, right < 0.0);
    }
    let stated = rack.replace("radius = 0.2", "radius = 0.2\nsense = \"drawn\"");
    let refused = refused(&stated);
    assert!(refused.contains("pitch line"), "{refused}");
}

#[test]
fn the_length_of_a_rope_is_a_length_and_that_of_wheels_is_refused() {
    let scene = field("61-length-of-a-rope");
    for formulation in FormulationKind::ALL.map(FormulationKind::name) {
        let outcome = run_in(&scene, formulation, Some(1e-3));
        assert!(outcome.error.is_none(), "{formulation}: {:?}", outcome.error);
        for (t, row) in outcome.rows() {
            assert!((row[0] - 1.3).abs() < 1e-9, "{formulation} at {t}: {}", row[0]);
        }
    }
    let gear =
        text("22-gear-joint-wheel-first").replace("quantity = \"effort\"", "quantity = \"length\"");
    let refused = refused(&gear);
    assert!(refused.contains("`value`"), "{refused}");
}

/// How a text that is a file but no scene is refused.
fn refused(text: &str) -> String {
    let document = SceneFile::parse(text, "refused.toml").expect("a file");
    document.scene::<f64>().expect_err("it is no scene").render()
}

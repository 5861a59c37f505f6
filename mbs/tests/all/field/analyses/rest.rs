//! Static equilibria: their positions, their distance from the start, and parts that the search ignores.

use super::super::{field, read, text};
use crate::common::run_in;
use mbs::{FormulationKind, Search, StaticEquilibrium};

/// Relative difference of positions [-]: the search ends at rounding, and a pad is stiff.
const CLOSE: f64 = 1e-10;

fn still(name: &str) -> StaticEquilibrium {
    StaticEquilibrium::new(&field(name), Search::Down).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// First coordinate of the first joint.
fn joint(still: &StaticEquilibrium) -> f64 {
    still.joints[0].1[0]
}

#[test]
fn a_block_rests_on_its_pad_and_not_beyond() {
    for (name, stiffness) in [("02-pad", 20_000.0), ("02-pad-with-spring", 20_001.0)] {
        let still = still(name);
        let sag = 5.0 * 9.81 / stiffness;
        assert!((joint(&still) + sag).abs() < CLOSE, "{name}: {still:?}");
        assert_eq!(still.unstable, Some(0));
        let [way, turn] = still.moved.expect("there is a body");
        assert!((way.size - sag).abs() < CLOSE && way.body == "block" && turn.size < CLOSE);
    }
}

#[test]
fn pads_hold_at_any_distance_below_and_through_a_joint_limit() {
    // a pad 0.1 m below, one 20 m below, and stops of the joint in place of the pad
    for clearance in [0.1, 0.3] {
        let text = text("02-pad").replace("clearance = 0.0", &format!("clearance = {clearance}"));
        let found =
            StaticEquilibrium::new(&read(&text, "pad"), Search::Down).expect("the pad holds it");
        let place = -clearance - 5.0 * 9.81 / 20_000.0;
        assert!((joint(&found) - place).abs() < CLOSE, "{clearance}: {found:?}");
    }
    let limit =
        "kind = \"limit\"\njoint = \"post\"\nlower = -20.0\nupper = 0.5\nstiffness = 20000.0";
    let text = text("02-pad");
    let (start, end) = (
        text.find("kind = \"bumper\"").expect("there is a pad"),
        text.find("[solver]").expect("it ends with the solver"),
    );
    let text = format!("{}{limit}\n\n{}", &text[..start], &text[end..]);
    let found =
        StaticEquilibrium::new(&read(&text, "limit"), Search::Down).expect("the stop holds it");
    assert!((joint(&found) + 20.0 + 5.0 * 9.81 / 20_000.0).abs() < CLOSE, "{found:?}");
}

#[test]
fn a_slide_on_a_spring_rests_at_the_springs_length() {
    let found = still("05-slide-on-a-spring");
    assert!((joint(&found) + 0.02).abs() < CLOSE, "{found:?}");
    assert_eq!((found.unstable, found.neutral), (Some(0), Some(0)));
}

/// Scene of a rod of 1 m that hangs down from a pivot.
const PENDULUM: &str = r#"
[scene]
name = "pendulum"
dimension = 2
gravity = [0.0, -9.81]
duration = 1.0
[[body]]
name = "rod"
rod = { from = [0.0, 0.0], to = [0.0, -1.0] }
mass = 1.0
[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "rod"]
at = [0.0, 0.0]
[[initial]]
joint = "pivot"
value = 3.0
"#;

#[test]
fn near_its_start_a_pendulum_stands_and_otherwise_it_hangs() {
    let scene = read(PENDULUM, "pendulum");
    let near = StaticEquilibrium::new(&scene, Search::Near).expect("it stands");
    assert!((joint(&near).abs() - core::f64::consts::PI).abs() < CLOSE, "{near:?}");
    assert_eq!(near.unstable, Some(1));
    let [_, turn] = near.moved.expect("there is a body");
    assert!((turn.size - (core::f64::consts::PI - 3.0)).abs() < CLOSE, "{turn:?}");
    let down = StaticEquilibrium::new(&scene, Search::Down).expect("it hangs");
    assert!(joint(&down).abs() < CLOSE && down.unstable == Some(0), "{down:?}");
    let [way, turn] = down.moved.expect("there is a body");
    // the centre, half a metre from the pivot, turns by 3 rad: its chord is sin(1.5) metres
    assert!((way.size - f64::sin(1.5)).abs() < CLOSE && (turn.size - 3.0).abs() < CLOSE);
}

#[test]
fn rates_that_do_not_fit_do_not_keep_it_from_an_equilibrium() {
    // the rates of a joint and of a point of its body contradict each other
    let text = format!(
        "{PENDULUM}rate = 2.0\n[[initial]]\nbody = \"rod\"\nat = [0.0, -1.0]\nvelocity = [9.0, 0.0]\n"
    );
    let scene = read(&text, "pendulum");
    let found = StaticEquilibrium::new(&scene, Search::Down).expect("rates are not used");
    assert!(joint(&found).abs() < CLOSE);
    // the search does not use rates of guides either, nor accelerations that a guided mechanism could not have
    let guided = text.replace("[[initial]]\njoint = \"pivot\"\nvalue = 3.0\nrate = 2.0\n", "")
        + "[[guide]]\njoint = \"pivot\"\nramp = { rate = 5.0 }\n";
    StaticEquilibrium::new(&read(&guided, "guided"), Search::Down)
        .expect("a guide holds its value");
}

#[test]
fn dry_friction_is_left_out_by_name_and_viscous_friction_is_not() {
    let viscous = still("04-modes-viscous-friction");
    assert!(viscous.left_out.is_empty());
    let dry = text("04-modes-viscous-friction").replace("coulomb = 0.0", "coulomb = 40.0");
    let found =
        StaticEquilibrium::new(&read(&dry, "dry"), Search::Down).expect("the spring holds it");
    let left_out: Vec<_> = found.left_out.iter().map(|l| (l.name.as_str(), l.part)).collect();
    assert_eq!(left_out, [("rub", "dry friction")]);
    assert!(joint(&found).abs() < CLOSE);
    assert_eq!(found.to_json()["left_out"][0]["effect"], "rub");
}

/// A weight on a rope of 1.25^(1/2) m hangs straight below the end of the rope, at any size.
#[test]
fn a_weight_on_a_rope_rests_below_its_end_in_the_plane_and_in_space() {
    let plane = text("24-weight-on-a-rope");
    let space = plane
        .replace("dimension = 2", "dimension = 3")
        .replace("[0.0, -9.81]", "[0.0, -9.81, 0.0]")
        .replace("[0.5, -1.0]", "[0.3, -1.0, 0.4]")
        .replace("[0.0, 0.0]", "[0.0, 0.0, 0.0]");
    let body = plane.replace("point = [0.5, -1.0]", "center = [0.5, -1.0]\ninertia = 0.02");
    for (text, place) in
        [(&plane, "[0.5, -1.0]"), (&space, "[0.3, -1.0, 0.4]"), (&body, "[0.5, -1.0]")]
    {
        for size in [1e-3, 1.0, 100.0] {
            let numbers = place.trim_matches(['[', ']']).split(", ");
            let numbers = numbers.map(|x| x.parse::<f64>().expect("a number") * size);
            let scaled = format!("{:?}", numbers.collect::<Vec<_>>());
            let scene = read(&text.replace(place, &scaled), "rope");
            let found = StaticEquilibrium::new(&scene, Search::Down);
            let found = found.unwrap_or_else(|e| panic!("{size}: {e}"));
            let at = &found.outputs[0].1;
            assert!((at[1] + size * 1.25_f64.sqrt()).abs() < CLOSE * size, "{size}: {at:?}");
            assert!(at[0].abs() < 1e-7 * size && found.unstable == Some(0), "{size}: {at:?}");
        }
    }
}

#[test]
fn a_weight_on_a_cam_rests_at_its_lowest_place() {
    let found = still("24-follower-on-a-cam");
    assert!(joint(&found).abs() < 1e-7 && found.unstable == Some(0), "{found:?}");
    let cam = text("24-follower-on-a-cam");
    let table = cam.replace(
        "coefficients = [0.0, 0.0, 0.05]",
        "table = [[-1.0, 0.05], [-0.5, 0.0125], [0.0, 0.0], [0.5, 0.0125], [1.0, 0.05]]",
    );
    let found = StaticEquilibrium::new(&read(&table, "cam"), Search::Down).expect("it rests");
    assert!(joint(&found).abs() < 1e-7 && found.unstable == Some(0), "{found:?}");
}

/// A load of 3 kg hangs in the middle of a rope over two points 2 m apart. The rope has 500 N/m and a length of 2.2 m: 2 T cos = m g, T = 500
/// (2 (1 + y^2)^(1/2) - 2.2).
#[test]
fn a_load_on_an_elastic_rope_over_three_points_rests() {
    let text = "[scene]\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n\
        [[body]]\nname = \"load\"\nmass = 3.0\npoint = [0.3, -0.6]\n\
        [[effect]]\nname = \"rope\"\nkind = \"spring-damper\"\nstiffness = 500.0\nfree_length = 2.2\npulls_only = true\n\
        points = [{ body = \"ground\", at = [-1.0, 0.0] }, { body = \"load\", at = [0.3, -0.6] }, { body = \"ground\", at = [1.0, 0.0] }]\n\
        [[output]]\nname = \"load\"\nbody = \"load\"\nquantity = \"position\"\n";
    let found = StaticEquilibrium::new(&read(text, "load"), Search::Down);
    let found = found.unwrap_or_else(|e| panic!("{e}"));
    let at = &found.outputs[0].1;
    let length = (1.0 + at[1] * at[1]).sqrt();
    let pull = 500.0 * (2.0 * length - 2.2) * 2.0 * -at[1] / length;
    assert!(at[0].abs() < 1e-9 && at[1] < 0.0 && (pull - 3.0 * 9.81).abs() < 1e-7, "{at:?}");
    assert_eq!(found.unstable, Some(0));
}

/// A wheel of 0.2 m rolls by a quarter revolution. The search rolls the wheel. A large step of the search slips by about 2e-7.
#[test]
fn a_wheel_with_a_weight_off_its_centre_rests_where_it_rolls_to() {
    let wheel = text("24-wheel-rolls-to-rest");
    let large = wheel
        .replace("center = [0.05, 0.2]", "center = [1.0, 4.0]")
        .replace("[0.0, 0.2]", "[0.0, 4.0]")
        .replace("radius = 0.2", "radius = 4.0")
        .replace("inertia = 0.05", "inertia = 20.0");
    for (text, radius) in [(wheel, 0.2), (large, 4.0)] {
        let found = StaticEquilibrium::new(&read(&text, "wheel"), Search::Down).expect("it rests");
        let [x, y] = [0, 1].map(|i| found.outputs[0].1[i] / radius);
        let right = core::f64::consts::FRAC_PI_2;
        assert!((x - right).abs() < 1e-6 && (y - 1.0).abs() < CLOSE, "{x}, {y}");
        assert_eq!(found.unstable, Some(0));
    }
}

/// A torque of 100 N m on 10 N m/rad gives 10 rad, which is more than a revolution.
#[test]
fn a_rest_beyond_a_turn_keeps_its_turns() {
    let scene = |effects: &str| {
        let text = format!(
            "[scene]\ndimension = 2\nduration = 0.01\nstart = \"equilibrium\"\n\
             [[body]]\nname = \"a\"\nmass = 1.0\ncenter = [0, 0]\ninertia = 0.1\n\
             [[joint]]\nname = \"j\"\nkind = \"revolute\"\nbodies = [\"ground\", \"a\"]\nat = [0, 0]\n\
             [[effect]]\nkind = \"torque\"\njoint = \"j\"\nvalue = 100.0\n{effects}\
             [[output]]\nname = \"j\"\njoint = \"j\"\nquantity = \"value\"\n"
        );
        read(&text, "turns")
    };
    let spring = "[[effect]]\nkind = \"torsion-spring\"\njoint = \"j\"\nstiffness = 10.0\n";
    let bushing = |bodies: &str| {
        format!(
            "[[effect]]\nkind = \"bushing\"\nbodies = {bodies}\nat = [0, 0]\nstiffness = [1e3, 1e3, 10.0]\n"
        )
    };
    let sum = "[[effect]]\nkind = \"spring-damper\"\nterms = [{ joint = \"j\", factor = 1.0 }]\nstiffness = 10.0\n";
    let wheel = "[[body]]\nname = \"b\"\nmass = 1.0\ncenter = [1, 0]\ninertia = 0.1\n\
        [[joint]]\nname = \"k\"\nkind = \"revolute\"\nbodies = [\"ground\", \"b\"]\nat = [1, 0]\n\
        [[coupling]]\nkind = \"gear\"\njoints = [\"j\", \"k\"]\nteeth = [20, 40]\n\
        [[effect]]\nkind = \"torsion-spring\"\njoint = \"k\"\nstiffness = 40.0\n";
    let all =
        [spring, &bushing("[\"ground\", \"a\"]"), &bushing("[\"a\", \"ground\"]"), sum, wheel];
    for effects in all {
        let scene = scene(effects);
        let found = StaticEquilibrium::new(&scene, Search::Down).expect("it rests");
        let joint = found.joints[0].1[0];
        assert!((joint - 10.0).abs() < 1e-9, "{effects}: {joint}");
        for formulation in FormulationKind::ALL.map(FormulationKind::name) {
            let outcome = run_in(&scene, formulation, Some(1e-3));
            let ranges = outcome.ranges()[0];
            assert!(
                ranges.iter().all(|x| (x - 10.0).abs() < 1e-7),
                "{formulation}, {effects}: {ranges:?}"
            );
        }
    }
}

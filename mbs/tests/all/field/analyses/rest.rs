//! Static equilibria: where they are, how far away, and what they leave out.

use super::super::{field, read, text};
use mbs::{Search, StaticEquilibrium};

/// Ten digits: the search ends at rounding, and the stiffness of a pad is far above what rounding moves.
const CLOSE: f64 = 1e-10;

fn still(name: &str) -> StaticEquilibrium {
    StaticEquilibrium::new(&field(name), Search::Down).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The first coordinate of the first joint.
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
    // A pad 0.1 m and 20 m below, and stops of the joint in place of the pad.
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

/// A rod of 1 m on a pivot, hanging down.
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
    // Half a metre of centre on a turn of 3 rad: a chord of sin(1.5) metres.
    assert!((way.size - f64::sin(1.5)).abs() < CLOSE && (turn.size - 3.0).abs() < CLOSE);
}

#[test]
fn rates_that_do_not_fit_do_not_keep_it_from_an_equilibrium() {
    // Rates that contradict each other, of a joint and of a point of its body.
    let text = format!(
        "{PENDULUM}rate = 2.0\n[[initial]]\nbody = \"rod\"\nat = [0.0, -1.0]\nvelocity = [9.0, 0.0]\n"
    );
    let scene = read(&text, "pendulum");
    let found = StaticEquilibrium::new(&scene, Search::Down).expect("rates are not used");
    assert!(joint(&found).abs() < CLOSE);
    // Rates of guides are not used either, nor accelerations that a guided mechanism could not have.
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

//! Rolling contacts that are refused, with their place.

use crate::common::oracle::{Way, rows};
use mbs_testkit::scene;

fn text(rolling: &str) -> String {
    format!(
        "[scene]\nname = \"r\"\ndimension = 3\nduration = 1.0\ngravity = [0.0, 0.0, -9.81]\n\
         [[body]]\nname = \"disc\"\nmass = 1.0\ncenter = [0.0, 0.0, 0.3]\ninertia = [0.01, 0.02, 0.01, 0.0, 0.0, 0.0]\n\
         [[rolling]]\nname = \"front\"\nbody = \"disc\"\n{rolling}"
    )
}

const WHEEL: &str =
    "kind = \"wheel\"\ncenter = [0.0, 0.0, 0.3]\naxis = [0.0, 1.0, 0.0]\nradius = 0.3\n";

fn refusal(rolling: &str) -> String {
    let read = mbs::Mechanism::parse(&text(rolling)).map_err(|e| e.to_string());
    match read.and_then(|mechanism| mechanism.check().map_err(|e| e.to_string())) {
        Ok(()) => panic!("not refused: {rolling}"),
        Err(message) => message,
    }
}

#[test]
fn what_cannot_roll_is_refused_with_its_place() {
    let cases = [
        (WHEEL.replace("axis = [0.0, 1.0, 0.0]", "axis = [0.0, 0.0, 1.0]"), "the disc lies flat"),
        (WHEEL.replace("radius = 0.3", "radius = -0.3"), "larger than zero"),
        (
            format!("{WHEEL}plane = {{ point = [0.0, 0.0, 0.1], normal = [0.0, 0.0, 1.0] }}\n"),
            "does not touch",
        ),
        (format!("{WHEEL}on = \"disc\"\n"), "the same body twice"),
        (WHEEL.replace("kind = \"wheel\"", "kind = \"wheels\""), "wheel"),
        ("kind = \"blade\"\nat = [0.0, 0.0, 0.0]\ndirection = [0.0, 0.0, 2.0]\n".into(), "normal"),
    ];
    for (rolling, words) in cases {
        let message = refusal(&rolling);
        assert!(message.contains(words), "{rolling}: {message}");
    }
}

#[test]
fn state_space_says_that_it_has_no_rows_of_velocities() {
    let scene = scene(&text(WHEEL));
    let error = rows(&scene, Way("state-space", "trapezoidal"), (1e-3, 0.1), 1).unwrap_err();
    assert_eq!(error.code(), "velocity-rows");
}

#[test]
fn a_disc_that_falls_flat_is_named() {
    let scene = scene(&format!(
        "{}[[initial]]\nbody = \"disc\"\nangular_velocity = [0.3, 0.0, 0.0]\n",
        text(WHEEL)
    ));
    for formulation in super::WAYS {
        let error = rows(&scene, Way(formulation, "trapezoidal"), (1e-4, 2.0), 1).unwrap_err();
        let report = error.report(0.0, &mbs::Names::new(&scene));
        println!("{formulation}: {}", report.message);
        assert!(["rolling-flat", "not-converged", "violated"].contains(&error.code()), "{error}");
    }
}

//! Bearing forces of gears that mesh at a pitch point, against the balance of each wheel by hand.

use crate::common::oracle::{TRAPEZOIDAL, Way, last, rows};
use mbs_testkit::scene;

/// Pressure angle of 20 degrees [rad].
const ANGLE: f64 = core::f64::consts::PI / 9.0;
/// Relative error of forces under constant accelerations [-]: steps of 1 ms, and rounding of angles after half a second.
const EXACT: f64 = 1e-6;

/// Last values of the outputs by each formulation.
fn ends(text: &str) -> impl Iterator<Item = (&'static str, Vec<f64>)> + use<> {
    let scene = scene(text);
    TRAPEZOIDAL.into_iter().map(move |formulation| {
        let rows = rows(&scene, Way(formulation, "trapezoidal"), (1e-3, 0.5), 500);
        let rows = rows.unwrap_or_else(|e| panic!("{formulation}: {e}"));
        (formulation, last(&rows).to_vec())
    })
}

fn is_near(found: &[f64], expected: &[f64], what: &str) {
    let size = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
        let left = (found - expected).abs();
        assert!(left < EXACT * size, "{what}, component {k}: {found}, not {expected}");
    }
}

/// Scene of two wheels on the ground, `[x, inertia]` of each, with a torque of 5 N m on the first.
fn wheels([first, second]: [[f64; 2]; 2], coupling: &str) -> String {
    let wheel = |name: &str, [x, inertia]: [f64; 2]| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1.0\ncenter = [{x:?}, 0.0]\ninertia = {inertia:?}\n\
             [[joint]]\nname = \"of {name}\"\nkind = \"revolute\"\nbodies = [\"ground\", \"{name}\"]\nat = [{x:?}, 0.0]\n\
             [[output]]\nname = \"R {name}\"\njoint = \"of {name}\"\nquantity = \"reaction\"\n"
        )
    };
    format!(
        "[scene]\nname = \"teeth\"\ndimension = 2\nduration = 1.0\n{}{}\
         [[effect]]\nkind = \"torque\"\njoint = \"of one\"\nvalue = 5.0\n\
         [[coupling]]\nname = \"mesh\"\njoints = [\"of one\", \"of two\"]\n{coupling}\n",
        wheel("one", first),
        wheel("two", second)
    )
}

#[test]
fn bearings_of_an_external_pair_carry_the_tangent_and_what_drives_it_apart() {
    let text = |more: &str| {
        let coupling = format!("kind = \"gear\"\nteeth = [20, 30]\n{more}");
        wheels([[0.0, 0.02], [1.0, 0.05]], &coupling)
    };
    // (I1 + k² I2) α = T with k = 2/3; the teeth transmit k² I2 α at 0.4 m
    let k = 2.0 / 3.0;
    let alpha = 5.0 / (0.02 + k * k * 0.05);
    let tangent = k * k * 0.05 * alpha / 0.4;
    for (formulation, found) in ends(&text("at = [0.4, 0.0]")) {
        let apart = tangent * ANGLE.tan();
        let expected = [apart, tangent, 0.0, -apart, -tangent, 0.0];
        is_near(&found, &expected, formulation);
    }
    for (formulation, found) in ends(&text("at = [0.4, 0.0]\npressure_angle = 0.0")) {
        is_near(&found, &[0.0, tangent, 0.0, 0.0, -tangent, 0.0], formulation);
    }
    // without a pitch point the coupling acts by torques only, and the bearings carry no force
    for (formulation, found) in ends(&text("")) {
        assert!(found.iter().all(|x| x.abs() < 1e-9 * tangent), "{formulation}: {found:?}");
    }
}

#[test]
fn a_pinion_in_a_ring_is_pressed_inward_whichever_comes_first() {
    // the radii are 0.2 and 0.6 m and the axes 0.4 m apart, so the wheels touch 0.2 m beyond the pinion's axis
    let k = 0.2 / 0.6;
    let (pinion, ring) = ([0.4, 0.02], [0.0, 0.05]);
    let coupling =
        |radii| format!("kind = \"gear\"\nradii = {radii}\nmesh = \"internal\"\nat = [0.6, 0.0]");
    let driven_by_pinion = wheels([pinion, ring], &coupling("[0.2, 0.6]"));
    let alpha = 5.0 / (0.02 + k * k * 0.05);
    let tangent = k * k * 0.05 * alpha / 0.2;
    // the pinion rotates forward and pushes the ring up: the teeth push the pinion down and towards its axis, along -x
    let apart = tangent * ANGLE.tan();
    for (formulation, found) in ends(&driven_by_pinion) {
        let expected = [apart, tangent, 0.0, -apart, -tangent, 0.0];
        is_near(&found, &expected, formulation);
    }
    let driven_by_ring = wheels([ring, pinion], &coupling("[0.6, 0.2]"));
    let alpha = 5.0 / (0.05 + 0.02 / (k * k));
    let tangent = 0.02 / k * alpha / 0.2;
    let apart = tangent * ANGLE.tan();
    for (formulation, found) in ends(&driven_by_ring) {
        // now the ring pushes the pinion up
        let expected = [-apart, tangent, 0.0, apart, -tangent, 0.0];
        is_near(&found, &expected, formulation);
    }
}

/// The axes are along (1, 2, 2)/3, and the wheels 0.3 m apart. The teeth are 0.1 m from the joints along the axes.
#[test]
fn teeth_beside_their_bearings_bend_the_shafts_in_space() {
    let n = [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];
    // e and t are unit vectors perpendicular to n: e points from the first axis to the second, and t is the tangent n × e
    let e = [2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0];
    let t = [-2.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0];
    let at = |x: f64, z: f64| [0, 1, 2].map(|i| x * e[i] + z * n[i]);
    let inertia = |about: f64| {
        // thin discs have half of the inertia across their axis; J = a 1 + (about - a) n nᵀ
        let a = 0.5 * about;
        let entry = |i: usize, j: usize| if i == j { a } else { 0.0 } + (about - a) * n[i] * n[j];
        [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)]
    };
    let wheel = |name: &str, x: f64, about: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1.0\ncenter = {at:?}\ninertia = {:?}\n\
             [[joint]]\nname = \"of {name}\"\nkind = \"revolute\"\nbodies = [\"ground\", \"{name}\"]\nat = {at:?}\naxis = {n:?}\n\
             [[output]]\nname = \"R {name}\"\njoint = \"of {name}\"\nquantity = \"reaction\"\n",
            inertia(about),
            at = at(x, 0.0),
        )
    };
    let text = format!(
        "[scene]\nname = \"teeth\"\ndimension = 3\nduration = 1.0\n{}{}\
         [[effect]]\nkind = \"torque\"\njoint = \"of one\"\nvalue = 5.0\n\
         [[coupling]]\nname = \"mesh\"\nkind = \"gear\"\njoints = [\"of one\", \"of two\"]\nradii = [0.1, 0.2]\nat = {:?}\n",
        wheel("one", 0.0, 0.02),
        wheel("two", 0.3, 0.05),
        at(0.1, 0.1)
    );
    let alpha = 5.0 / (0.02 + 0.25 * 0.05);
    let tangent = 0.25 * 0.05 * alpha / 0.1;
    let apart = tangent * ANGLE.tan();
    // the teeth push the first wheel by -tangent t - apart e at 0.1 n + 0.1 e; its bearing exerts the opposite force, and the moment -0.1 n ×
    // f of the force 0.1 m along the axis
    let f = [0, 1, 2].map(|i| -tangent * t[i] - apart * e[i]);
    let moment = [n[1] * f[2] - n[2] * f[1], n[2] * f[0] - n[0] * f[2], n[0] * f[1] - n[1] * f[0]];
    for (formulation, found) in ends(&text) {
        let on_first: Vec<f64> = f.iter().chain(&moment.map(|m| 0.1 * m)).map(|x| -x).collect();
        is_near(&found[..6], &on_first, formulation);
        let on_second: Vec<f64> = on_first.iter().map(|x| -x).collect();
        is_near(&found[6..], &on_second, formulation);
    }
}

/// The wheels are in a housing on a free hinge, and a motor acts from the housing on the first wheel.
#[test]
fn in_a_turning_housing_the_motion_and_what_its_hinge_carries_stay_the_same() {
    let text = |more: &str| {
        let body = |name: &str, x: f64, inertia: f64| {
            format!(
                "[[body]]\nname = \"{name}\"\nmass = 1.0\ncenter = [{x:?}, 0.0]\ninertia = {inertia:?}\n"
            )
        };
        let joint = |name: &str, on: &str, body: &str, x: f64| {
            format!(
                "[[joint]]\nname = \"{name}\"\nkind = \"revolute\"\nbodies = [\"{on}\", \"{body}\"]\nat = [{x:?}, 0.0]\n"
            )
        };
        let outputs = ["h", "a", "b"].map(|name| {
            format!("[[output]]\nname = \"{name}\"\njoint = \"{name}\"\nquantity = \"reaction\"\n")
        });
        format!(
            "[scene]\nname = \"housing\"\ndimension = 2\nduration = 1.0\ngravity = [0.0, -9.81]\n{}{}{}{}{}{}\
             [[effect]]\nkind = \"torque\"\njoint = \"a\"\nvalue = 0.8\n\
             [[coupling]]\nname = \"mesh\"\nkind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [40, 17]\n{more}\n{}\
             [[output]]\nname = \"angle\"\njoint = \"h\"\nquantity = \"value\"\n",
            body("housing", 0.0, 0.196),
            body("w1", 0.2, 0.02),
            body("w2", -0.2, 0.004),
            joint("h", "ground", "housing", 0.0),
            joint("a", "housing", "w1", 0.2),
            joint("b", "housing", "w2", -0.2),
            outputs.concat()
        )
    };
    let pitch = 0.2 - 0.4 * 40.0 / 57.0;
    let with = ends(&text(&format!("at = [{pitch:?}, 0.0]")));
    for ((formulation, with), (_, without)) in with.zip(ends(&text(""))) {
        assert_eq!(with[9].to_bits(), without[9].to_bits(), "{formulation}: the motion");
        is_near(&with[..3], &without[..3], formulation);
        let change = |i: usize| with[i] - without[i];
        // the forces at both bearings are equal and opposite, along the line of action, which rotates with the housing
        let (sine, cosine) = with[9].sin_cos();
        let [along, across] =
            [cosine * change(3) + sine * change(4), cosine * change(4) - sine * change(3)];
        assert!(across.abs() > 0.1, "{formulation}: {across}");
        let slope = across.abs() * ANGLE.tan();
        // the first wheel is at +x: its bearing pulls it towards the mesh
        assert!((along + slope).abs() < EXACT * slope, "{formulation}: {along} {slope}");
        for i in [3, 4] {
            assert!((change(i) + change(i + 3)).abs() < EXACT * slope, "{formulation}: {i}");
        }
    }
}

#[test]
fn pitch_points_that_are_none_are_refused_at_their_place() {
    let gear = |more: &str| {
        wheels([[0.0, 0.02], [1.0, 0.05]], &format!("kind = \"gear\"\nteeth = [20, 30]\n{more}"))
    };
    let belt = "kind = \"linear\"\nterms = [{ joint = \"of one\" }, { joint = \"of two\", factor = -1.0 }]\nat = [0.5, 0.0]";
    let linear =
        wheels([[0.0, 0.02], [1.0, 0.05]], belt).replace("joints = [\"of one\", \"of two\"]\n", "");
    for (text, key, says) in [
        (gear("at = [0.5, 0.0]"), "`at`", "touch, which is at [0.4, 0, 0]"),
        (gear("at = [0.4, 0.1]"), "`at`", "touch, which is at [0.4, 0, 0]"),
        (
            gear("at = [0.4, 0.0]\npressure_angle = 20.0"),
            "`pressure_angle`",
            "20 degrees are 0.349",
        ),
        (gear("pressure_angle = 0.3"), "at", "missing"),
        (linear, "`at`", "for two wheels on one body"),
    ] {
        let read = mbs::Mechanism::parse(&text).map_err(|e| e.to_string());
        let run = read
            .and_then(|m| mbs::run(&m, &mbs::Run::new()).map(|_| ()).map_err(|e| e.to_string()));
        let message = run.expect_err("it is refused");
        assert!(message.contains(key) && message.contains(says), "{message}");
    }
}

//! Point masses: periods, frequencies and equilibrium positions.

use super::{GRAVITY, apart, check, distance, head, list, output, point, run};
use crate::common::oracle::{TRAPEZOIDAL, Way};
use mbs::{FormulationKind, Method, Modes, Place, Search};
use mbs_testkit::scene;

/// Length of the pendulum [m] and its angle from the vertical at the start [rad].
const PENDULUM: [f64; 2] = [0.7, 2.2];

/// Position of the pendulum in the plane, or in the plane through z and (0.8, -0.6, 0).
fn place(dimension: usize, angle: f64) -> Vec<f64> {
    let (along, up) = (PENDULUM[0] * angle.sin(), -PENDULUM[0] * angle.cos());
    if dimension == 2 { vec![along, up] } else { vec![0.8 * along, -0.6 * along, up] }
}

fn pendulum(dimension: usize) -> String {
    let at = place(dimension, PENDULUM[1]);
    let (gravity, zero) = match dimension {
        2 => (list(&[0.0, -GRAVITY]), list(&[0.0; 2])),
        _ => (list(&[0.0, 0.0, -GRAVITY]), list(&[0.0; 3])),
    };
    let rod = distance(["ground", "ball"], &[], &at).replace("[[], ", &format!("[{zero}, "));
    [
        head(dimension, &gravity),
        point("ball", 1.7, &at),
        rod,
        output("ball", &at, "position"),
        "[[output]]\nname = \"e\"\nquantity = \"energy\"\n".into(),
    ]
    .concat()
}

/// Period of a pendulum: 2 pi sqrt(l/g) over the arithmetic-geometric mean of 1 and cos(a/2).
fn period([length, angle]: [f64; 2]) -> f64 {
    let (mut a, mut b) = (1.0, (0.5 * angle).cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    core::f64::consts::TAU * (length / GRAVITY).sqrt() / a
}

#[test]
fn a_point_on_a_distance_has_the_period_of_the_elliptic_integral() {
    // the point passes the lowest position after a quarter of the period, and again after five quarters
    let period = period(PENDULUM);
    for dimension in [2, 3] {
        let (start, mut right) = (place(dimension, PENDULUM[1]), place(dimension, 0.0));
        right.push(1.7 * GRAVITY * start[dimension - 1]);
        check(&pendulum(dimension), 1.25 * period, (1e-3, 1e-3), (&right, 1e-9));
    }
}

/// Scene of two points between two fixed points of the ground, at distances of a metre along (0.6, 0.8). Three springs pull by 30 N at rest.
fn springs(dimension: usize) -> String {
    let at = |x: f64| {
        let mut at = vec![0.6 * x, 0.8 * x];
        at.resize(dimension, 0.0);
        at
    };
    let ends = ["ground", "a", "b", "ground"];
    let zero = vec![0.0; dimension];
    let mut text = head(dimension, &list(&zero)) + &point("a", 1.3, &at(1.0));
    text += &point("b", 0.7, &at(2.0));
    for (i, (pair, k)) in ends.windows(2).zip(STIFFNESSES).enumerate() {
        let points = [i as f64, i as f64 + 1.0].map(|x| list(&at(x))).join(", ");
        text += &format!(
            "[[effect]]\nname = \"s{i}\"\nkind = \"spring-damper\"\nbodies = {pair:?}\npoints = [{points}]\n\
             stiffness = {k:?}\nfree_length = {:?}\n",
            1.0 - TENSION / k
        );
    }
    text + &output("a", &at(1.0), "position")
}

const STIFFNESSES: [f64; 3] = [200.0, 100.0, 150.0];
const TENSION: f64 = 30.0;

/// Frequencies of two masses with stiffness [[p + q, -q], [-q, q + r]].
fn pair([p, q, r]: [f64; 3]) -> [f64; 2] {
    let [m, n] = [1.3, 0.7];
    let (a, d, bc) = ((p + q) / m, (q + r) / n, q * q / (m * n));
    let root = (0.25 * (a - d) * (a - d) + bc).sqrt();
    [-root, root].map(|root| (0.5 * (a + d) + root).sqrt())
}

#[test]
fn two_points_on_springs_oscillate_along_and_across_them() {
    let (along, across) = (pair(STIFFNESSES), pair([TENSION; 3]));
    for dimension in [2, 3] {
        let text = springs(dimension);
        let modes = Modes::new(&scene(&text), Place::Equilibrium, Search::Down).expect("it rests");
        let mut expected = along.to_vec();
        (1..dimension).for_each(|_| expected.extend(across));
        expected.sort_by(f64::total_cmp);
        let mut found: Vec<f64> = modes.modes.iter().map(|mode| mode.imaginary).collect();
        found.sort_by(f64::total_cmp);
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(&expected) {
            // the limit is the square root of the rounding of the eigenvalues
            assert!((found - expected).abs() < 1e-7, "{found}, not {expected}");
        }
        // at rest the forces balance to rounding
        for formulation in TRAPEZOIDAL {
            let rows = run(&text, Way(formulation, "trapezoidal"), 1e-3, 0.1);
            assert!(apart(&rows, &[0.6, 0.8]) < 1e-12, "{formulation}");
        }
    }
}

#[test]
fn a_point_on_two_strings_rests_where_the_forces_balance() {
    // a triangle with sides 0.6, 0.8 and 1 m: the point hangs from both ends of the hypotenuse, and a spring pulls it perpendicular to the
    // plane
    let at = [0.36, -0.48, 0.0];
    let spring = "[[effect]]\nname = \"s\"\nkind = \"spring-damper\"\nbodies = [\"ground\", \"ball\"]\n\
                  points = [[0.36, -0.48, 0.5], [0.36, -0.48, 0.0]]\nstiffness = 50.0\nfree_length = 0.5\n";
    let text = [
        head(3, &list(&[0.0, -GRAVITY, 0.0])),
        point("ball", 2.0, &at),
        distance(["ground", "ball"], &[0.0, 0.0, 0.0], &at),
        distance(["ball", "ground"], &at, &[1.0, 0.0, 0.0]),
        spring.into(),
        "[[output]]\nname = \"r\"\njoint = \"ground-ball\"\nquantity = \"reaction\"\n".into(),
    ]
    .concat();
    // the string of 0.6 m carries the component along it
    let tension = 2.0 * GRAVITY * 0.8;
    let right = [-0.6 * tension, 0.8 * tension, 0.0];
    for formulation in TRAPEZOIDAL {
        let rows = run(&text, Way(formulation, "trapezoidal"), 1e-3, 0.1);
        assert!(apart(&rows, &right) < 1e-9, "{formulation}: {rows:?}");
    }
    let modes = Modes::new(&scene(&text), Place::Equilibrium, Search::Down).expect("it rests");
    // the point swings about the hypotenuse, at a height of 0.48 m; the spring acts perpendicular to the plane
    let omega = (GRAVITY / 0.48 + 50.0 / 2.0_f64).sqrt();
    assert_eq!(modes.modes.len(), 1);
    assert!((modes.modes[0].imaginary - omega).abs() < 1e-8, "{modes:?}, not {omega}");
}

#[test]
fn a_simulation_that_is_restored_goes_on_with_the_same_bits() {
    let mechanism = mbs::Mechanism::parse(&pendulum(3)).expect("it reads");
    for kind in FormulationKind::listed() {
        let method = Method { step: Some(1e-3), ..Method::new(kind) };
        let mut sim = mechanism.simulate(&method).expect("it starts");
        sim.advance_to(0.1).expect("it moves");
        let saved = sim.save().expect("a state");
        sim.advance_to(0.2).expect("it moves");
        let end = sim.save().expect("a state");
        sim.restore(&saved).expect("its own");
        sim.advance_to(0.2).expect("it moves");
        assert_eq!(sim.save().expect("a state"), end, "{}", kind.name());
    }
}

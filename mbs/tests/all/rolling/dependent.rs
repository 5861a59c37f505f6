//! Dependent no-slip rows: two wheels on one axle cannot slip along it, and one of their two rows is enough.

use super::{apart, end};
use crate::common::oracle::Way;
use mbs_testkit::repository::text;
use std::fmt::Write as _;

/// Formulations that accept dependent rows, by the trapezoidal rule.
const WAYS: [&str; 4] = ["index-3", "index-1", "multi-index", "recursive"];

/// Last row by a method of high order with its default tolerance.
fn exact(text: &str, duration: f64) -> Vec<f64> {
    end(text, Way("recursive", "rk853"), 1e-3, duration)
}

/// Asserts an order of 1.9 to 2.1. The error may be at most 4/3 of the change of the result when the step is halved. For a method of order two,
/// this limit equals the error.
fn is_of_order_two(text: &str, (duration, step): (f64, f64), right: &[f64]) {
    for formulation in WAYS {
        let by = |step| end(text, Way(formulation, "trapezoidal"), step, duration);
        let [coarse, fine] = [by(step), by(step / 2.0)];
        let [error, half] = [&coarse, &fine].map(|found| apart(found, right));
        println!("{formulation}: {error:.2e}, {half:.2e}");
        let order = (error / half).log2();
        // multi-index controls its step
        if formulation != "multi-index" {
            assert!((1.9..2.1).contains(&order), "{formulation}: {error:e}, {half:e}");
        }
        let most = 1.4 * apart(&coarse, &fine);
        assert!(error < most, "{formulation}: {coarse:?}, {right:?}");
    }
}

/// Returns `text` with one number replaced.
fn with(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    text.replace(from, to)
}

#[test]
fn an_axle_of_two_wheels_rolls_round_its_circle() {
    let text = text("21-axle-of-two-wheels");
    // a circle of 0.5 m at 1 m/s; wheels of 0.1 m run at 0.3 m and 0.7 m from its centre
    let right = |t: f64| {
        let (sine, cosine) = (2.0 * t).sin_cos();
        [0.5 * sine, 0.5 * (1.0 - cosine), 0.1, 6.0 * t, 14.0 * t]
    };
    assert!(apart(&exact(&text, 2.0), &right(2.0)) < 1e-9);
    is_of_order_two(&text, (2.0, 1e-3), &right(2.0));
    is_of_order_two(&text, (2.0, 5e-3), &right(2.0));
}

#[test]
fn axles_of_other_sizes_keep_the_order_of_the_rule() {
    let text = text("21-axle-of-two-wheels");
    let heavy = with(
        &text,
        "mass = 5.0\ncenter = [0.0, 0.0, 0.1]",
        "mass = 50.0\ncenter = [0.03, 0.02, 0.15]",
    );
    let light = with(&text, "mass = 1.0", "mass = 0.01");
    let light = with(&light, "inertia = [0.003, 0.005, 0.003", "inertia = [3e-5, 5e-5, 3e-5");
    let fast = with(&text, "velocity = [1.0, 0.0, 0.0]", "velocity = [4.0, 0.0, 0.0]");
    for (text, duration) in [(heavy, 1.0), (light, 1.0), (fast, 0.5)] {
        is_of_order_two(&text, (duration, 1e-3), &exact(&text, duration));
    }
}

/// Scene of a wagon on four wheels, whose front axle rotates about its pin against a spring.
fn wagon() -> String {
    let mut text =
        "[scene]\nname = \"wagon\"\ndimension = 3\nduration = 1.0\ngravity = [0.0, 0.0, -9.81]\n"
            .to_owned();
    let mut body = |name: &str, mass: f64, center: [f64; 3], inertia: [f64; 3]| {
        let [a, b, c] = inertia;
        writeln!(text, "[[body]]\nname = \"{name}\"\nmass = {mass}\ncenter = {center:?}\ninertia = [{a}, {b}, {c}, 0.0, 0.0, 0.0]").expect("a string");
    };
    body("wagon", 60.0, [0.5, 0.0, 0.5], [3.0, 8.0, 9.0]);
    body("axle", 8.0, [1.2, 0.0, 0.3], [0.6, 0.1, 0.6]);
    text.push_str(
        "[[joint]]\nname = \"pin\"\nkind = \"revolute\"\nbodies = [\"wagon\", \"axle\"]\nat = [1.2, 0.0, 0.3]\naxis = [0.0, 0.0, 1.0]\n\
         [[effect]]\nname = \"tie\"\nkind = \"torsion-spring\"\njoint = \"pin\"\nstiffness = 40.0\ndamping = 5.0\nfree_value = 0.3\n",
    );
    for (name, on, x, y) in [
        ("rear left", "wagon", 0.0, 0.4),
        ("rear right", "wagon", 0.0, -0.4),
        ("front left", "axle", 1.2, 0.35),
        ("front right", "axle", 1.2, -0.35),
    ] {
        writeln!(
            text,
            "[[body]]\nname = \"{name}\"\nmass = 4.0\ncenter = [{x:?}, {y:?}, 0.3]\ninertia = [0.1, 0.18, 0.1, 0.0, 0.0, 0.0]\n\
             [[joint]]\nname = \"{name}\"\nkind = \"revolute\"\nbodies = [\"{on}\", \"{name}\"]\nat = [{x:?}, {y:?}, 0.3]\naxis = [0.0, 1.0, 0.0]\n\
             [[rolling]]\nname = \"{name}\"\nkind = \"wheel\"\nbody = \"{name}\"\ncenter = [{x:?}, {y:?}, 0.3]\naxis = [0.0, 1.0, 0.0]\nradius = 0.3"
        )
        .expect("a string");
    }
    text.push_str(
        "[[initial]]\nbody = \"wagon\"\nat = [0.0, 0.0, 0.3]\nvelocity = [3.0, 0.0, 0.0]\n\
         [[output]]\nname = \"place\"\nbody = \"wagon\"\nquantity = \"position\"\n\
         [[output]]\nname = \"pin\"\njoint = \"pin\"\nquantity = \"value\"\n",
    );
    text
}

#[test]
fn a_wagon_of_four_wheels_steers_by_the_order_of_the_rule_and_keeps_its_energy() {
    let text = wagon();
    is_of_order_two(&text, (1.0, 1e-3), &exact(&text, 1.0));
}

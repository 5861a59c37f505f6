//! Machines and vehicles of `mbs/tests/field`, inputs 21 to 30 and 60 to 65. Each file has reference values by a closed form or another
//! program.

use crate::{channel, mechanism, run, scene};

/// Tolerance of values with a closed form, by steps to 1e-12 [-].
const CLOSE: f64 = 1e-9;
/// Tolerances of values that are given with nine digits, and with seven [-].
const DIGITS: [f64; 2] = [1e-8, 1e-6];

fn near(what: &str, found: f64, right: f64, tolerance: f64) {
    let off = (found - right).abs();
    assert!(off <= tolerance * (1.0 + right.abs()), "{what}: {found}, but {right}");
}

/// The text of an input of `mbs/tests/field`.
fn text(name: &str) -> String {
    let path = format!("{}/../mbs/tests/field/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("the scene is there")
}

/// Compares channels at the end of a run with reference values. `right` lists name, component and reference value.
fn ends(name: &str, text: &str, duration: f64, right: &[(&str, usize, f64)], tolerance: f64) {
    let m = mechanism(text);
    let end = run(&m, duration);
    for &(output, component, value) in right {
        let what = format!("{name}, {output}");
        near(&what, channel(&m, &end, output)[component], value, tolerance);
    }
}

#[test]
fn wheels_in_mesh_turn_as_they_are_drawn() {
    // 0.7 N m during 0.4 s on an inertia of 0.02 + (2/3)² 0.04 kg m²
    let (one, two) = (7.411_764_705_882_353, 4.941_176_470_588_235);
    let effort = -(0.7 - 0.02 * one / 0.4);
    let gear = text("22-gear-joint-wheel-first");
    let right = [("one", 0, one), ("two", 0, -two), ("mesh", 0, effort)];
    ends("gear", &gear, 0.4, &right, CLOSE);
    ends("gear", &gear.replace(r#"["two", "ground"]"#, r#"["ground", "two"]"#), 0.4, &right, CLOSE);
    let belt = text("22-belt-axes-opposite");
    for axis in ["[0.0, 0.0, -1.0]", "[0.0, 0.0, 3.0]"] {
        let belt = belt.replace("[0.0, 0.0, -1.0]", axis);
        let right = [("one", 2, one), ("two", 2, two), ("mesh", 0, effort / 0.1)];
        ends("belt", &belt, 0.4, &right, CLOSE);
    }
    let arm = text("22-gear-on-an-arm");
    let right =
        [("sun", 0, 2.127_659_574), ("arm", 0, 4.113_475_177), ("planet", 0, 7.092_198_582)];
    ends("gear on an arm", &arm, 0.4, &right, DIGITS[0]);
    let shafts = ["left", "right", "cage"].map(|name| (name, 1, 12.5));
    ends("differential", &text("22-differential-axes-outward"), 0.5, &shafts, CLOSE);
}

#[test]
fn a_reel_falls_from_its_thread() {
    let right = [("place", 1, -0.240_790_909), ("place", 2, 12.039_545_455)];
    ends("reel", &text("26-coupling-on-a-free-body"), 0.3, &right, DIGITS[0]);
}

#[test]
fn bearings_carry_the_rope_and_the_thread() {
    let right = [("axle", 0, 0.0), ("axle", 1, 265.447_059), ("rope", 0, 69.247_059)];
    ends("winch", &text("29-axle-of-a-winch"), 0.3, &right, DIGITS[1]);
    let mut right = vec![("thread", 0, 600.0), ("bearing", 0, 600.0), ("guide", 3, -1.909_859_317)];
    right.extend((1..6).map(|i| ("bearing", i, 0.0)));
    right.extend([0, 1, 2, 4, 5].map(|i| ("guide", i, 0.0)));
    ends("lead screw", &text("30-lead-screw"), 0.1, &right, DIGITS[0]);
}

#[test]
fn bearings_carry_teeth_and_strands() {
    // 0.329 N m on a radius of 0.1 m; the force that pushes the teeth apart is the tangential force times tan 20 degrees
    let torque = 0.7 - 0.02 * 7.411_764_705_882_353 / 0.4;
    let (across, apart) = (torque / 0.1, torque / 0.1 * 20.0_f64.to_radians().tan());
    let outputs = "\n[[output]]\nname = \"first\"\njoint = \"one\"\nquantity = \"reaction\"\n\
                   [[output]]\nname = \"second\"\njoint = \"two\"\nquantity = \"reaction\"\n";
    let gear =
        text("22-gear-joint-wheel-first").replace("teeth =", "at = [0.1, 0.0]\nteeth =") + outputs;
    let right = [
        ("first", 0, apart),
        ("first", 1, across),
        // the wheel is the first body of the second joint
        ("second", 0, apart),
        ("second", 1, across),
    ];
    ends("teeth", &gear, 0.4, &right, CLOSE);
    // angle of the strands to the line of the axes: cosine (0.1 - 0.15)/0.25; the pretension acts along that line by 2 S sin, the effort
    // across it
    let (cosine, effort) = (-0.2_f64, -torque / 0.1);
    let along = 2.0 * 10.0 * (1.0 - cosine * cosine).sqrt();
    let belt =
        text("22-belt-axes-opposite").replace("radii =", "pretension = 10.0\nradii =") + outputs;
    let right = [
        ("first", 0, -along),
        ("first", 1, -effort * cosine),
        ("second", 0, along),
        ("second", 1, effort * cosine),
        ("mesh", 0, effort),
    ];
    ends("strands", &belt, 0.4, &right, CLOSE);
}

#[test]
fn a_guided_cross_takes_the_moments_of_its_motors() {
    let right =
        [("effort", 0, -5.399_044_19), ("effort", 1, 1.102_128_63), ("power", 0, 16.795_604_76)];
    ends("cross", &text("60-guided-cross"), 0.5, &right, DIGITS[0]);
    let m = scene("mbs/tests/field/60-guided-cross.toml");
    let end = run(&m, 0.5);
    let [reaction, turn] =
        ["reaction", "turn against the mast"].map(|name| channel(&m, &end, name));
    let power = (0..3).map(|i| reaction[3 + i] * turn[i]).sum::<f64>();
    near("moment times turn", channel(&m, &end, "power")[0], power, CLOSE);
}

#[test]
fn a_rope_keeps_its_length() {
    let rope = text("61-length-of-a-rope");
    for duration in [0.1, 0.4] {
        ends("rope", &rope, duration, &[("length", 0, 1.3)], CLOSE);
    }
}

#[test]
fn a_bar_comes_back_from_its_stop_with_its_energy() {
    let right = [("pivot", 0, -0.961_152_555_21), ("energy", 0, 0.0)];
    // the corner of the stop's force is within a step
    ends("stop", &text("62-stop-by-gbs"), 1.2, &right, DIGITS[1]);
}

#[test]
fn a_disc_counts_its_turns() {
    ends("disc", &text("64-rotation-vector-by-steps"), 2.0, &[("turns", 0, 8.0)], CLOSE);
}

#[test]
fn an_axle_of_two_wheels_rolls_round_its_circle() {
    let right = [
        ("place", 0, -0.378_401_248),
        ("place", 1, 0.826_821_810),
        ("left", 0, 12.0),
        ("right", 0, 28.0),
    ];
    ends("axle", &text("21-axle-of-two-wheels"), 2.0, &right, DIGITS[0]);
}

#[test]
fn slides_and_a_blade_move_as_another_program_says() {
    let right = [("guide", 0, -0.322_743_35), ("slide", 0, -0.322_743_35)];
    ends("blade", &text("65-violated-by-rounding"), 2.0, &right, DIGITS[0]);
}

#[test]
fn a_force_follows_the_place_of_a_free_body() {
    let right = [("place", 0, -0.032_079_646)];
    ends("disc", &text("26-signal-on-a-free-body"), 0.3, &right, DIGITS[1]);
}

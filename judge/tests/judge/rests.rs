//! Equilibria and frequencies of the inputs 21 to 28 of `mbs/tests/field`, from accelerations. At an equilibrium accelerations are zero. At
//! a small displacement they are minus the square of the frequency times the displacement.

use crate::{channel, mechanism, run};

/// Displacement from the equilibrium [rad or m]. Its square is smaller than the given digits.
const ASIDE: f64 = 1e-6;
/// Tolerance of frequencies and equilibria, which are given with eight digits or more [-].
const DIGITS: f64 = 1e-7;

fn near(what: &str, found: f64, right: f64) {
    let off = (found - right).abs();
    assert!(off <= DIGITS * (1.0 + right.abs()), "{what}: {found}, but {right}");
}

/// The text of an input of `mbs/tests/field`.
fn text(name: &str) -> String {
    let path = format!("{}/../mbs/tests/field/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("the scene is there")
}

/// The text of a joint's initial condition.
fn held(joint: &str, value: f64, rate: f64) -> String {
    format!("[[initial]]\njoint = \"{joint}\"\nvalue = {value:?}\nrate = {rate:?}\n")
}

/// Accelerations of joints at the start.
fn accelerations(text: &str, joints: &[&str]) -> Vec<f64> {
    let output = |joint: &&str| {
        format!(
            "[[output]]\nname = \"a {joint}\"\njoint = \"{joint}\"\nquantity = \"acceleration\"\n"
        )
    };
    let outputs: String = joints.iter().map(output).collect();
    let m = mechanism(&format!("{text}\n{outputs}"));
    let start = m.start().expect("it starts");
    joints.iter().map(|joint| channel(&m, &start, &format!("a {joint}"))[0]).collect()
}

/// The frequency of a coordinate about an equilibrium.
fn frequency(text: &str, joint: &str, rest: f64) -> f64 {
    let [a, b] = [ASIDE, -ASIDE].map(|x| {
        let text = format!("{text}\n{}", held(joint, rest + x, 0.0));
        accelerations(&text, &[joint])[0]
    });
    ((b - a) / (2.0 * ASIDE)).sqrt()
}

#[test]
fn a_weight_rests_below_its_rope() {
    let length = 1.25_f64.sqrt();
    let at = |x: f64| {
        let place = format!("[{x:?}, {:?}]", -(1.25 - x * x).sqrt());
        let text = text("24-weight-on-a-rope").replace("[0.5, -1.0]", &place);
        let m = mechanism(&text);
        let moved = m.evaluate(&m.start().expect("it starts"));
        [0, 1].map(|i| moved.accelerations[0][i])
    };
    at(0.0).into_iter().for_each(|a| near("rest", a, 0.0));
    near("swing", (-at(ASIDE)[0] / ASIDE).sqrt(), 2.962_149_68);
    near("its rope", length, 1.118_033_989);
}

#[test]
fn a_follower_rests_in_the_hollow_of_its_cam() {
    let scene = text("24-follower-on-a-cam");
    let (from, to) = scene.split_once("[[initial]]").expect("a start");
    let outputs = to.split_once("[[output]]").expect("an output").1;
    let scene = format!("{from}[[output]]{outputs}");
    near("rest", accelerations(&scene, &["shaft"])[0], 0.0);
    near("mode", frequency(&scene, "shaft", 0.0), 7.672_027_11);
}

#[test]
fn a_wheel_with_a_weight_rolls_to_its_rest() {
    let damped = format!(
        "{}\n[[joint]]\nname = \"place\"\nkind = \"free\"\nbodies = [\"ground\", \"wheel\"]\n\
         [[effect]]\nkind = \"friction\"\njoint = \"place\"\ncoordinate = \"turn\"\ncoulomb = 0.0\nviscous = 0.5\n",
        text("24-wheel-rolls-to-rest")
    );
    let m = mechanism(&damped);
    near("centre", channel(&m, &run(&m, 12.0), "center")[0], 0.314_159_265);
}

#[test]
fn a_cart_on_two_wheels_pitches_about_its_axle() {
    let held = ["left", "right"].map(|joint| held(joint, 1e-4, 0.0)).concat();
    let outputs = ["orientation", "angular-acceleration"].map(|quantity| {
        format!("[[output]]\nname = \"{quantity}\"\nbody = \"body\"\nquantity = \"{quantity}\"\n")
    });
    let m = mechanism(&format!("{}\n{held}{}", text("21-cart-on-two-wheels"), outputs.concat()));
    let start = m.start().expect("it starts");
    let pitch = 2.0 * channel(&m, &start, "orientation")[2].asin();
    let ratio = -channel(&m, &start, "angular-acceleration")[1] / pitch;
    near("mode", ratio.sqrt(), 5.420_572_73);
}

#[test]
fn a_blade_and_a_governor_swing_in_the_turning_frame() {
    near("blade", frequency(&text("23-hinged-blade"), "flap", 0.0), 35.157_807_5);
    let governor = text("25-governor-at-speed");
    let (governor, outputs) = governor.split_once("[[initial]]").expect("a start");
    let outputs = outputs.split_once("[[output]]").expect("an output").1;
    let governor = format!("{governor}[[output]]{outputs}");
    let rest = 1.189_831_548;
    let at_rest = format!("{governor}\n{}", held("arm", rest, 0.0));
    near("rest", accelerations(&at_rest, &["arm"])[0], 0.0);
    near("mode", frequency(&governor, "arm", rest), 7.424_200_00);
}

#[test]
fn a_rotor_whirls_with_two_frequencies() {
    let scene = text("23-whirl-of-a-rotor");
    // accelerations of both gimbals per unit of one of their coordinates or rates
    let by = |of: usize, is_rate: bool| {
        let at = |x: f64| {
            let start = ["outer", "inner"].iter().enumerate().map(|(i, joint)| {
                let x = if i == of { x } else { 0.0 };
                if is_rate { held(joint, 0.0, x) } else { held(joint, x, 0.0) }
            });
            let text = format!("{scene}\n{}", start.collect::<String>());
            accelerations(&text, &["outer", "inner"])
        };
        let (a, b) = (at(ASIDE), at(-ASIDE));
        [0, 1].map(|i| (b[i] - a[i]) / (2.0 * ASIDE))
    };
    let (k, g) = ([by(0, false), by(1, false)], [by(0, true), by(1, true)]);
    // (k₀₀ - w²)(k₁₁ - w²) + g₀₁ g₁₀ w² = 0; the loop checks that all other terms are zero
    let gyroscopic = g[0][1] * g[1][0];
    for (name, zero) in [("k", k[0][1]), ("k", k[1][0]), ("g", g[0][0]), ("g", g[1][1])] {
        assert!(zero.abs() < 1e-4, "{name}: {zero}");
    }
    let half = 0.5 * (k[0][0] + k[1][1] - gyroscopic);
    let root = (half * half - k[0][0] * k[1][1]).sqrt();
    near("slow", (half - root).sqrt(), 44.274_661_5);
    near("fast", (half + root).sqrt(), 170.736_245_3);
}

#[test]
fn sums_act_on_each_of_their_coordinates() {
    // the first wheel slides on the second with 40/√(1 + 1e-6) N m of regularised friction; inertias are 0.5 and 2 kg m²
    let clutch =
        format!("{}\n{}", text("23-closed-clutch"), held("one", 0.0, 1.0) + &held("two", 0.0, 0.0));
    let torque = 40.0 / (1.0 + 1e-6_f64).sqrt();
    let found = accelerations(&clutch, &["one", "two"]);
    near("one", found[0], -torque / 0.5);
    near("two", found[1], torque / 2.0);
    let slide = format!("{}\n{}", text("28-spring-on-a-slide"), held("rail", 0.1, 0.0));
    near("slide", accelerations(&slide, &["rail"])[0], -5.0);
}

#[test]
fn a_wheel_is_driven_up_by_two_radians() {
    let m = mechanism(&text("27-error-stated-of-a-short-run"));
    near("axle", channel(&m, &run(&m, 0.2), "axle")[0], 2.0);
}

/// A thin rod has no inertia about its own line. So the moments of a force and of a rope about this line are equal: the rope's tension T at
/// 0.1 m, and 3 N at 0.2 m.
#[test]
fn a_rope_beside_the_line_of_a_thin_rod_balances_a_force() {
    let text = "[scene]\ndimension = 3\nduration = 0.1\n\
        [[body]]\nname = \"rod\"\nmass = 1.0\nrod = { from = [-0.5, 0.0, 0.0], to = [0.5, 0.0, 0.0] }\n\
        [[coupling]]\nname = \"rope\"\nkind = \"rope\"\npoints = [{ body = \"rod\", at = [0.0, 0.1, 0.0] }, \
        { body = \"ground\", at = [0.0, 0.1, 1.0] }]\n\
        [[effect]]\nkind = \"force\"\nbody = \"rod\"\nat = [0.0, 0.2, 0.0]\nvalue = [0.0, 0.0, -3.0]\n\
        [[output]]\nname = \"tension\"\ncoupling = \"rope\"\n\
        [[output]]\nname = \"center\"\nbody = \"rod\"\nquantity = \"acceleration\"\n";
    let m = mechanism(text);
    let start = m.start().expect("it starts");
    near("tension", channel(&m, &start, "tension")[0], 6.0);
    near("center", channel(&m, &start, "center")[2], 3.0);
}

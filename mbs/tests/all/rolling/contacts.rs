//! Rolling contacts: forces and energy, on a slope, on a moving plane, and with a joint in addition.

use super::{WAYS, end, run};
use crate::common::oracle::{Way, last};

const RADIUS: f64 = 0.25;
const MASS: f64 = 3.0;
const INERTIA: f64 = 0.12;

/// Scene of a wheel on a slope of `angle`, in the plane or about y in space, with the contact force as output.
fn slope(dimension: usize, angle: f64, ball: bool) -> String {
    let (sin, cos) = angle.sin_cos();
    let vector = |x: f64, up: f64| {
        if dimension == 2 { format!("[{x:?}, {up:?}]") } else { format!("[{x:?}, 0.0, {up:?}]") }
    };
    let center = vector(-sin * RADIUS, cos * RADIUS);
    let (gravity, normal, origin) = (vector(0.0, -9.81), vector(-sin, cos), vector(0.0, 0.0));
    let kind = if ball { "ball" } else { "wheel" };
    let axis = if dimension == 3 && !ball { "axis = [0.0, 1.0, 0.0]\n" } else { "" };
    let inertia = if dimension == 2 {
        format!("{INERTIA:?}")
    } else {
        format!("[{INERTIA:?}, {INERTIA:?}, {INERTIA:?}, 0.0, 0.0, 0.0]")
    };
    format!(
        "[scene]\nname = \"slope\"\ndimension = {dimension}\nduration = 1.0\ngravity = {gravity}\n\
         [[body]]\nname = \"wheel\"\nmass = {MASS:?}\ncenter = {center}\ninertia = {inertia}\n\
         [[rolling]]\nname = \"contact\"\nkind = \"{kind}\"\nbody = \"wheel\"\ncenter = {center}\n{axis}radius = {RADIUS:?}\n\
         plane = {{ point = {origin}, normal = {normal} }}\n\
         [[output]]\nname = \"p\"\nbody = \"wheel\"\nat = {center}\nquantity = \"position\"\n\
         [[output]]\nname = \"f\"\nrolling = \"contact\"\nquantity = \"force\"\n"
    )
}

#[test]
fn wheels_and_balls_roll_down_a_slope_as_inertia_says_and_their_forces_hold_them() {
    let angle = 0.35_f64;
    let a = 9.81 * angle.sin() / (1.0 + INERTIA / (MASS * RADIUS * RADIUS));
    let way = 0.5 * a;
    for (dimension, ball) in [(2, false), (3, false), (3, true)] {
        let text = slope(dimension, angle, ball);
        for formulation in WAYS {
            let found = end(&text, Way(formulation, "trapezoidal"), 1e-3, 1.0);
            let up = dimension - 1;
            let (x, z) = (found[0] + angle.sin() * RADIUS, found[up] - angle.cos() * RADIUS);
            let along = -(x * angle.cos() + z * angle.sin());
            // the rule is exact for a uniform acceleration, but not for directions that rotate by 8 rad: 2e-6 at 1 ms
            assert!((along - way).abs() < 1e-5 * way, "{formulation} {dimension}: {along} {way}");
            let force = &found[dimension..];
            let [push, hold] = [
                -force[0] * angle.sin() + force[up] * angle.cos(),
                force[0] * angle.cos() + force[up] * angle.sin(),
            ];
            let normal = MASS * 9.81 * angle.cos();
            let friction = MASS * 9.81 * angle.sin() - MASS * a;
            assert!((push - normal).abs() < 1e-5 * normal, "{formulation} {dimension}: {push}");
            assert!((hold - friction).abs() < 1e-5 * normal, "{formulation} {dimension}: {hold}");
        }
    }
}

#[test]
fn a_wheel_on_a_cart_that_drives_below_it_rolls_back() {
    // the cart is guided by a sine; the wheel's centre moves by I / (I + m R^2) of the cart's displacement
    let text = format!(
        "[scene]\nname = \"cart\"\ndimension = 2\nduration = 1.0\ngravity = [0.0, -9.81]\n\
         [[body]]\nname = \"cart\"\nmass = 5.0\ncenter = [0.0, -0.1]\ninertia = 1.0\n\
         [[body]]\nname = \"wheel\"\nmass = {MASS:?}\ncenter = [0.0, {RADIUS:?}]\ninertia = {INERTIA:?}\n\
         [[joint]]\nname = \"rail\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"cart\"]\nat = [0.0, -0.1]\naxis = [1.0, 0.0]\n\
         [[guide]]\njoint = \"rail\"\nsine = {{ amplitude = 0.3, frequency = 0.8, phase = 0.0 }}\n\
         [[rolling]]\nname = \"contact\"\nkind = \"wheel\"\nbody = \"wheel\"\ncenter = [0.0, {RADIUS:?}]\nradius = {RADIUS:?}\non = \"cart\"\n\
         [[initial]]\nbody = \"wheel\"\nat = [0.0, {RADIUS:?}]\nvelocity = [0.0, 0.0]\n\
         [[output]]\nname = \"x\"\nbody = \"wheel\"\nat = [0.0, {RADIUS:?}]\nquantity = \"position\"\n\
         [[output]]\nname = \"cart\"\njoint = \"rail\"\nquantity = \"value\"\n"
    );
    let share = INERTIA / (INERTIA + MASS * RADIUS * RADIUS);
    // the wheel's centre is at rest at the start while the cart moves; then it has the cart's acceleration times this fraction
    let rate = 0.3 * core::f64::consts::TAU * 0.8;
    for formulation in WAYS {
        for (t, row) in run(&text, Way(formulation, "trapezoidal"), 1e-3, 1.0) {
            let right = share * (row[2] - rate * t);
            assert!((row[0] - right).abs() < 2e-5, "{formulation} {t}: {} {right}", row[0]);
        }
    }
}

#[test]
fn nothing_is_lost_or_won_where_things_roll() {
    let text = format!("{}[[output]]\nname = \"e\"\nquantity = \"energy\"\n", slope(3, 0.35, true));
    for formulation in WAYS {
        // the energy error of the rule falls with the square of the step
        let lost = |step: f64| {
            let rows = run(&text, Way(formulation, "trapezoidal"), step, 1.0);
            let [first, end] = [&rows[0].1, last(&rows)].map(|row| row[6]);
            (end - first).abs()
        };
        let [coarse, fine] = [2e-3, 1e-3].map(lost);
        assert!(coarse < 1e-3 && fine < 0.3 * coarse + 1e-9, "{formulation}: {coarse:e} {fine:e}");
    }
}

/// Scene of a wheel on a slope in the plane, whose centre of mass is below its centre.
fn eccentric(angle: f64) -> String {
    let below = 0.1;
    let (sin, cos) = angle.sin_cos();
    let center = [-sin * RADIUS, cos * RADIUS];
    let mass_at = [center[0], center[1] - below];
    format!(
        "[scene]\nname = \"eccentric\"\ndimension = 2\nduration = 1.0\ngravity = [0.0, -9.81]\n\
         [[body]]\nname = \"wheel\"\nmass = {MASS:?}\ncenter = {mass_at:?}\ninertia = {INERTIA:?}\n\
         [[rolling]]\nname = \"contact\"\nkind = \"wheel\"\nbody = \"wheel\"\ncenter = {center:?}\nradius = {RADIUS:?}\n\
         plane = {{ point = [0.0, 0.0], normal = {:?} }}\n\
         [[output]]\nname = \"a\"\nbody = \"wheel\"\nquantity = \"orientation\"\n",
        [-sin, cos]
    )
}

#[test]
fn an_eccentric_wheel_rests_and_rocks_as_its_energy_says() {
    let below = 0.1;
    for angle in [0.0_f64, 0.2] {
        let m = mbs::Mechanism::parse(&eccentric(angle)).expect("a scene");
        let rest = mbs::equilibrium(&m, &mbs::EquilibriumOptions::default())
            .unwrap_or_else(|e| panic!("{angle}: {e}"));
        // V = m g (R (t sin) - e cos t) with the angle t; at equilibrium the centre of mass is displaced sideways by R sin
        let turn = (RADIUS * angle.sin() / below).asin();
        // `square` is the squared distance of the centre of mass from the contact; `up` gives the curvature of V
        let up = below * turn.cos();
        let square = (RADIUS * angle.sin() - below * turn.sin()).powi(2)
            + (RADIUS * angle.cos() - up).powi(2);
        let omega = (MASS * 9.81 * up / (INERTIA + MASS * square)).sqrt();
        let modes = mbs::modes(&m, &rest).unwrap_or_else(|e| panic!("{angle}: {e}")).modes;
        let found = modes.iter().fold(0.0_f64, |a, mode| a.max(mode.imaginary));
        assert!((found - omega).abs() < 1e-6 * omega, "{angle}: {found} {omega}");
    }
}

#[test]
fn two_wheels_of_one_axle_roll_straight_and_share_what_nothing_determines() {
    let angle = 0.35_f64;
    let (sin, cos) = angle.sin_cos();
    let center = [-sin * RADIUS, 0.0, cos * RADIUS];
    let wheel = |y: f64| {
        format!(
            "[[rolling]]\nname = \"wheel-{y}\"\nkind = \"wheel\"\nbody = \"axle\"\ncenter = [{:?}, {y:?}, {:?}]\n\
             axis = [0.0, 1.0, 0.0]\nradius = {RADIUS:?}\nplane = {{ point = [0.0, 0.0, 0.0], normal = [{:?}, 0.0, {cos:?}] }}\n\
             [[output]]\nname = \"force-{y}\"\nrolling = \"wheel-{y}\"\nquantity = \"force\"\n",
            center[0], center[2], -sin
        )
    };
    let text = format!(
        "[scene]\nname = \"axle\"\ndimension = 3\nduration = 1.0\ngravity = [0.0, 0.0, -9.81]\n\
         [[body]]\nname = \"axle\"\nmass = {MASS:?}\ncenter = {center:?}\ninertia = [0.3, {INERTIA:?}, 0.3, 0.0, 0.0, 0.0]\n\
         [[output]]\nname = \"p\"\nbody = \"axle\"\nat = {center:?}\nquantity = \"position\"\n{}{}",
        wheel(-0.4),
        wheel(0.4)
    );
    let way = 0.5 * 9.81 * sin / (1.0 + INERTIA / (MASS * RADIUS * RADIUS));
    for formulation in ["index-3", "index-1", "recursive"] {
        let found = end(&text, Way(formulation, "trapezoidal"), 1e-3, 1.0);
        let along = -((found[0] - center[0]) * cos + (found[2] - center[2]) * sin);
        assert!((along - way).abs() < 1e-5 * way, "{formulation}: {along} {way}");
        assert!(found[1].abs() < 1e-9, "{formulation}: {}", found[1]);
        // each wheel carries half of the weight
        for force in [&found[3..6], &found[6..9]] {
            let push = -force[0] * sin + force[2] * cos;
            let half = 0.5 * MASS * 9.81 * cos;
            assert!((push - half).abs() < 1e-5 * half, "{formulation}: {push} {half}");
        }
    }
}

#[test]
fn a_contact_that_pulls_is_noted_with_its_time_and_force() {
    // a plate under the wheel oscillates by 0.1 m, with an acceleration larger than gravity
    let text = |frequency: f64| {
        format!(
            "[scene]\nname = \"plate\"\ndimension = 2\nduration = 0.5\ngravity = [0.0, -9.81]\n\
             [[body]]\nname = \"plate\"\nmass = 5.0\ncenter = [0.0, -0.1]\ninertia = 1.0\n\
             [[body]]\nname = \"wheel\"\nmass = {MASS:?}\ncenter = [0.0, {RADIUS:?}]\ninertia = {INERTIA:?}\n\
             [[joint]]\nname = \"guide\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"plate\"]\nat = [0.0, -0.1]\naxis = [0.0, 1.0]\n\
             [[guide]]\njoint = \"guide\"\nsine = {{ amplitude = 0.1, frequency = {frequency:?}, phase = 0.0 }}\n\
             [[rolling]]\nname = \"contact\"\nkind = \"wheel\"\nbody = \"wheel\"\ncenter = [0.0, {RADIUS:?}]\nradius = {RADIUS:?}\non = \"plate\"\n"
        )
    };
    for formulation in WAYS {
        let method = || mbs::Method {
            step: Some(1e-3),
            formulation: Some(formulation.to_owned()),
            ..mbs::Method::default()
        };
        let notes = |frequency: f64| {
            let m = mbs::Mechanism::parse(&text(frequency)).expect("a scene");
            let run = mbs::run(&m, &mbs::Run::new().method(method()));
            run.unwrap_or_else(|e| panic!("{formulation}: {e}")).notes().to_vec()
        };
        // the acceleration 0.1 (2 pi f)^2 reaches 9.81 m/s^2 at f = 1.576 Hz
        assert_eq!(notes(1.5), [""; 0], "{formulation}");
        let noted = notes(3.0);
        let omega = core::f64::consts::TAU * 3.0;
        // the note has the end of the first step after sin(w t) = g / (A w^2), with amplitude A and angular frequency w
        let first = ((9.81 / (0.1 * omega * omega)).asin() / omega * 1e3).ceil() / 1e3;
        let begin = format!("`contact` pulls on its plane at t = {first} s, by up to ");
        assert_eq!(noted.len(), 1, "{formulation}: {noted:?}");
        let rest = noted[0].strip_prefix(&begin);
        let most: f64 = rest
            .and_then(|rest| rest.split(' ').next())
            .and_then(|number| number.parse().ok())
            .unwrap_or_else(|| panic!("{formulation}: {noted:?}"));
        let right = MASS * (0.1 * omega * omega - 9.81);
        assert!((most - right).abs() < 1e-2 * right, "{formulation}: {most} {right}");
    }
}

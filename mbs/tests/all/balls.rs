//! Effects on swing and twist of ball joints against closed forms, in every formulation.

use crate::common::oracle::{
    WAYS, Way, agree_in_the_limit, energy_balances, outputs_of, rows, run,
};
use mbs_testkit::scene;

const GRAVITY: f64 = 9.81;
/// Inertias of a body about its point on the ball joint: across its axis, and about it [kg m^2].
const INERTIAS: [f64; 2] = [0.5, 0.06];

/// Scene of one body on a ball joint at the origin. Its centre is `height` above the joint along z. `rotation` and `spin` are its initial
/// state, `rest` its effects.
fn body_on_ball(height: f64, rotation: [f64; 3], spin: [f64; 3], rest: &str) -> String {
    let [across, about] = INERTIAS;
    let across = across - 2.0 * height * height;
    format!(
        "[scene]\nname = \"b\"\ndimension = 3\nduration = 1.0\ngravity = [0.0, 0.0, -{GRAVITY:?}]\n\
         [[body]]\nname = \"b\"\nmass = 2.0\ncenter = [0.0, 0.0, {height:?}]\ninertia = [{across:?}, {across:?}, {about:?}, 0.0, 0.0, 0.0]\n\
         [[joint]]\nname = \"ball\"\nkind = \"spherical\"\nbodies = [\"ground\", \"b\"]\nat = [0.0, 0.0, 0.0]\n\
         [[initial]]\njoint = \"ball\"\nvalue = {rotation:?}\nrate = {spin:?}\n{rest}"
    )
}

#[test]
fn a_body_that_turns_about_the_vertical_rests_on_its_cone() {
    // steady precession at w about the vertical, below the ball joint, with inertia J across and I about the axis: (J - I) w^2 sin cos - m g l
    // sin = k (swing - end)
    let (below, swing, omega, stiffness) = (0.4, 0.7_f64, 8.0, 900.0);
    let [across, about] = INERTIAS;
    let pull = (across - about) * omega * omega * swing.sin() * swing.cos()
        - 2.0 * GRAVITY * below * swing.sin();
    let end = swing - pull / stiffness;
    assert!(pull > 1.0 && end > 0.5, "it leans on its cone: {pull}, {end}");
    let limit = format!(
        "[[effect]]\nname = \"e\"\nkind = \"limit\"\njoint = \"ball\"\ncoordinate = \"swing\"\naxis = [0.0, 0.0, -3.0]\nupper = {end:?}\nstiffness = {stiffness:?}\n{}",
        outputs_of("e")
    );
    let text = body_on_ball(-below, [0.0, swing, 0.0], [0.0, 0.0, omega], &limit);
    for way in WAYS {
        for (t, row) in run(&text, way, (1e-4, 0.5)) {
            let found = [row[0] - swing, row[1] / 30.0, row[2] / stiffness - pull / stiffness];
            for x in found {
                assert!(x.abs() < 1e-6, "{way:?}, {t}: {row:?}, {pull}");
            }
        }
    }
}

#[test]
fn what_stands_above_its_ball_comes_to_rest_on_the_cone() {
    // equilibrium of moments: m g l sin(swing) = k (swing - end)
    let (above, end, stiffness) = (0.3, 0.5_f64, 400.0);
    let mut swing = end;
    for _ in 0..50 {
        swing = end + 2.0 * GRAVITY * above * swing.sin() / stiffness;
    }
    let limit = format!(
        "[[effect]]\nname = \"e\"\nkind = \"limit\"\njoint = \"ball\"\ncoordinate = \"swing\"\naxis = [0.0, 0.0, 1.0]\nupper = {end:?}\nstiffness = {stiffness:?}\ndamping = 20.0\n\
         [[effect]]\nkind = \"friction\"\njoint = \"ball\"\ncoordinate = \"swing\"\naxis = [0.0, 0.0, 1.0]\ncoulomb = 0.0\nviscous = 0.4\n{}",
        outputs_of("e")
    );
    let text = body_on_ball(above, [0.2, 0.1, 0.0], [0.0, 0.0, 0.0], &limit);
    for way in WAYS {
        let rows = run(&text, way, (1e-3, 6.0));
        let end = &rows.last().expect("a row").1;
        assert!((end[0] - swing).abs() < 1e-6 && end[1].abs() < 1e-5, "{way:?}: {end:?} {swing}");
    }
}

/// Scene of a body that only twists about its fixed axis, from a given rate at the start, and its angular frequency.
fn twisting(rate: f64) -> (String, f64) {
    let stiffness = 2.0;
    let spring = format!(
        "[[effect]]\nname = \"e\"\nkind = \"torsion-spring\"\njoint = \"ball\"\ncoordinate = \"twist\"\naxis = [0.0, 0.0, 0.5]\nstiffness = {stiffness:?}\n{}",
        outputs_of("e")
    );
    let text = body_on_ball(0.0, [0.0; 3], [0.0, 0.0, rate], &spring);
    (text, (stiffness / INERTIAS[1]).sqrt())
}

#[test]
fn a_twist_spring_has_the_frequency_of_the_inertia_about_its_axis() {
    let (text, omega) = twisting(28.0);
    let amplitude: f64 = 28.0 / omega;
    assert!(amplitude > 4.0 && amplitude < 6.0, "more than half a turn: {amplitude}");
    for way in WAYS {
        for (t, row) in run(&text, way, (1e-4, 1.2)) {
            let (sin, cos) = (omega * t).sin_cos();
            // the phase error is (w h)^2/12 of seven radians, with frequency w and step h; in natural coordinates w is 30 rad/s
            let most = 2e-5 * amplitude;
            assert!((row[0] - amplitude * sin).abs() < most, "{way:?}, {t}: {row:?}");
            assert!((row[1] - 28.0 * cos).abs() < most * omega, "{way:?}, {t}: {row:?}");
            assert!((row[2] - 2.0 * row[0]).abs() < 1e-9, "{way:?}, {t}: {row:?}");
        }
    }
    // natural coordinates count revolutions; relative coordinates determine a twist only within one revolution
    let (text, omega) = twisting(60.0);
    for way in WAYS {
        let result = rows(&scene(&text), way, (1e-4, 0.6), 1);
        match (way.0, result) {
            ("recursive", Err(stop)) => assert_eq!(stop.code(), "overturned", "{way:?}: {stop}"),
            ("recursive", Ok(_)) => panic!("{way:?}: it does not stop"),
            (_, Err(stop)) => panic!("{way:?}: {stop}"),
            (_, Ok(rows)) => {
                let (t, row) = rows.last().expect("a row");
                let expected = 60.0 / omega * (omega * t).sin();
                assert!((row[0] - expected).abs() < 2e-3, "{way:?}: {row:?} {expected}");
                assert!(rows.iter().any(|(_, row)| row[0] > 10.0), "{way:?}: more than a turn");
            }
        }
    }
}

#[test]
fn a_torque_on_a_twist_turns_on_past_whole_turns() {
    let torque = "[[effect]]\nname = \"e\"\nkind = \"torque\"\njoint = \"ball\"\ncoordinate = \"twist\"\naxis = [0.0, 0.0, 1.0]\nvalue = 3.0\n";
    let drag = "[[effect]]\nkind = \"friction\"\njoint = \"ball\"\ncoordinate = \"twist\"\naxis = [0.0, 0.0, 1.0]\ncoulomb = 0.0\nviscous = 0.2\n";
    let text = body_on_ball(0.0, [0.0; 3], [0.0; 3], &format!("{torque}{drag}{}", outputs_of("e")));
    let (duration, decay) = (1.5, 0.2 / INERTIAS[1]);
    for way in WAYS {
        let rows = run(&text, way, (1e-4, duration));
        let (t, row) = rows.last().expect("a row");
        let rate = 15.0 * (1.0 - (-decay * t).exp());
        let angle = 15.0 * (t - (1.0 - (-decay * t).exp()) / decay);
        assert!(angle > 15.0, "more than two turns");
        assert!((row[0] - angle).abs() < 1e-4 * angle, "{way:?}: {row:?} {angle}");
        assert!((row[1] - rate).abs() < 1e-4 * rate, "{way:?}: {row:?} {rate}");
    }
}

#[test]
fn a_twist_is_open_where_its_axes_are_opposite() {
    // the body rotates about x, across the axis, by half a revolution in pi seconds
    let damper = "[[effect]]\nname = \"e\"\nkind = \"torsion-spring\"\njoint = \"ball\"\ncoordinate = \"twist\"\naxis = [0.0, 0.0, 1.0]\nstiffness = 1.0\n";
    let text = body_on_ball(0.0, [0.0; 3], [1.0, 0.0, 0.0], damper);
    for way in WAYS {
        let stop = match rows(&scene(&text), way, (1e-3, 4.0), 1) {
            Err(stop) => stop,
            Ok(_) => panic!("{way:?}: it does not stop"),
        };
        assert_eq!(stop.code(), "twist-open", "{way:?}: {stop}");
    }
}

/// Scene of two bodies on ball joints, and a closed loop of a rod with a ball joint. Smooth laws act on swings and twists about oblique axes.
fn chain() -> String {
    let body = |name: &str, at: [f64; 3], mass: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = {mass:?}\ncenter = {at:?}\ninertia = [0.13, 0.16, 0.15, 0.002, 0.01, 0.003]\n"
        )
    };
    let ball = |name: &str, bodies: [&str; 2], at: [f64; 3]| {
        format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"spherical\"\nbodies = {bodies:?}\nat = {at:?}\n\
             [[output]]\nname = \"{name}\"\njoint = \"{name}\"\nquantity = \"rate\"\n"
        )
    };
    let effect = |name: &str, kind: &str, joint: &str, angle: &str, rest: &str| {
        format!(
            "[[effect]]\nname = \"{name}\"\nkind = \"{kind}\"\njoint = \"{joint}\"\ncoordinate = \"{angle}\"\n{rest}\n{}",
            outputs_of(name)
        )
    };
    [
        "[scene]\nname = \"c\"\ndimension = 3\nduration = 0.3\ngravity = [0.0, 0.0, -9.81]\n".to_owned(),
        body("one", [0.3, 0.1, -0.2], 2.0),
        body("two", [0.8, 0.0, -0.5], 1.5),
        ball("a", ["ground", "one"], [0.0, 0.0, 0.0]),
        // the joint names its bodies in reverse; the spanning tree attaches the second body to the first
        ball("b", ["two", "one"], [0.6, 0.1, -0.3]),
        "[[initial]]\njoint = \"a\"\nvalue = [0.3, 0.2, -0.4]\nrate = [1.0, -0.5, 2.0]\n[[initial]]\njoint = \"b\"\nvalue = [-0.2, 0.5, 0.3]\nrate = [0.4, 1.0, -1.5]\n".to_owned(),
        effect("swing-a", "torsion-spring", "a", "swing", "axis = [0.36, 0.48, -0.8]\nstiffness = 20.0\ndamping = 0.3\nfree_value = 0.1"),
        effect("twist-a", "torsion-spring", "a", "twist", "axis = [0.36, 0.48, -0.8]\nstiffness = 12.0\ndamping = 0.2"),
        effect("twist-b", "torsion-spring", "b", "twist", "axis = [0.5, -0.2, 0.4]\nstiffness = 15.0\nfree_value = -0.3"),
        effect("drag-b", "friction", "b", "swing", "axis = [0.5, -0.2, 0.4]\ncoulomb = 0.3\nregularisation = 0.8"),
        "[[effect]]\nname = \"sum\"\nkind = \"torsion-spring\"\nstiffness = 4.0\nterms = [{ joint = \"a\", coordinate = \"twist\", axis = [0, 0, 1], factor = 1.5 }, { joint = \"b\", coordinate = \"swing\", axis = [1, 0, 0], coefficients = [0.0, 0.2, 0.7] }]\n".to_owned(),
        outputs_of("sum"),
    ]
    .concat()
}

#[test]
fn natural_and_relative_coordinates_agree_on_balls_to_eight_digits() {
    for way in [Way("index-3", "trapezoidal"), Way("recursive", "trapezoidal")] {
        agree_in_the_limit(&scene(&chain()), way, (5e-4, 0.3, 60), 1e-8, |_| ());
    }
}

#[test]
fn the_energy_of_laws_on_balls_balances() {
    energy_balances(&scene(&chain()));
}

#[test]
fn a_thin_rod_swings_about_its_line_without_a_turn_of_its_own() {
    // a rod on a ball joint below the ground, with a spring on its swing: small swings have the frequency sqrt((m g l/2 + k)/J)
    let text = format!(
        "[scene]\nname = \"rod\"\ndimension = 3\nduration = 1.0\ngravity = [0.0, 0.0, -{GRAVITY:?}]\n\
         [[body]]\nname = \"rod\"\nmass = 3.0\nrod = {{ from = [0.0, 0.0, 0.0], to = [0.0, 0.0, -1.0] }}\n\
         [[joint]]\nname = \"ball\"\nkind = \"spherical\"\nbodies = [\"ground\", \"rod\"]\nat = [0.0, 0.0, 0.0]\n\
         [[initial]]\nbody = \"rod\"\nat = [0.0, 0.0, -1.0]\nvelocity = [0.02, 0.01, 0.0]\n\
         [[effect]]\nname = \"e\"\nkind = \"torsion-spring\"\njoint = \"ball\"\ncoordinate = \"swing\"\naxis = [0.0, 0.0, 2.0]\nstiffness = 30.0\n{}",
        outputs_of("e")
    );
    let omega = ((3.0 * GRAVITY * 0.5 + 30.0) / 1.0_f64).sqrt();
    let rate = (0.02_f64 * 0.02 + 0.01 * 0.01).sqrt();
    for way in WAYS {
        for (t, row) in run(&text, way, (1e-3, 1.0)) {
            let expected = (rate / omega * (omega * t).sin()).abs();
            // the errors are proportional to the cube of the amplitude, and to (w h)^2
            assert!((row[0] - expected).abs() < 1e-6, "{way:?}, {t}: {row:?} {expected}");
        }
    }
}

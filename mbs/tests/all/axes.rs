//! Effects on each coordinate of a joint, and guides on every joint of a chain. All kinds of joints are tested in both orders of their
//! bodies, on the ground and on a moving body. Formulations are compared with each other and with closed forms.

use crate::common::oracle::{Way, disagreement, everything, methods, rows, rows_with_errors};
use crate::common::run;
use mbs::Method;
use mbs::core::scene::{JointId, Quantity};
use mbs_testkit::{quantities, scene};

/// Scene of a body on a joint with an effect. The joint is on the ground, or on a body that itself swings.
fn hung(is_planar: bool, kind: &str, [is_on_body, is_reversed]: [bool; 2], effect: &str) -> String {
    let first = if is_on_body { "base" } else { "ground" };
    let bodies = if is_reversed { ["a", first] } else { [first, "a"] };
    let (dimension, gravity) = if is_planar { (2, "[0, -9.81]") } else { (3, "[0, 0, -9.81]") };
    let vector = |x: [f64; 3]| format!("{:?}", &x[..dimension]);
    let inertia = |of: [&str; 2]| of[usize::from(!is_planar)].to_owned();
    let axis = |of: &str| if is_planar { String::new() } else { format!("axis = {of}\n") };
    let own_axis = match kind {
        "planar" => "axis = [1.0, 0.2, 0.3]\ndirection = [0.0, 1.0, 0.1]\n",
        "universal" => "axes = [[1.0, 0.2, 0.3], [0.1, 1.0, -0.4]]\n",
        "pin-in-slot" if is_planar => "axis = [1.0, 0.3]\n",
        "pin-in-slot" => "axis = [1.0, 0.2, 0.3]\n",
        "revolute" | "cylindrical" if !is_planar => "axis = [1.0, 0.2, 0.3]\n",
        _ => "",
    };
    let at = if kind == "free" { String::new() } else { format!("at = {}\n", vector([0.0; 3])) };
    let mut text = format!(
        "[scene]\nname = \"axes\"\ndimension = {dimension}\nduration = 0.1\ngravity = {gravity}\n\
         [[body]]\nname = \"a\"\nmass = 1.0\ncenter = {}\ninertia = {}\n",
        vector([0.3, 0.1, 0.05]),
        inertia(["0.05", "[0.02, 0.03, 0.04, 0.002, -0.001, 0.003]"]),
    );
    if is_on_body {
        text += &format!(
            "[[body]]\nname = \"base\"\nmass = 2.0\ncenter = {}\ninertia = {}\n\
             [[joint]]\nname = \"root\"\nkind = \"revolute\"\nbodies = [\"ground\", \"base\"]\nat = {}\n{}",
            vector([-0.2, 0.05, 0.1]),
            inertia(["0.1", "[0.1, 0.12, 0.15, 0.01, 0.0, -0.01]"]),
            vector([-0.5, 0.0, 0.1]),
            axis("[0.3, 0.2, 1.0]"),
        );
    }
    let rate = match (kind, effect.contains("coordinate")) {
        ("revolute", _) => "[[initial]]\njoint = \"j\"\nvalue = 0.2\nrate = 3.0\n",
        ("universal", _) => "[[initial]]\njoint = \"j\"\nvalue = [0.2, -0.6]\nrate = [3.0, -2.0]\n",
        ("cylindrical", true) => {
            "[[initial]]\njoint = \"j\"\nvalue = [0.2, 0.3]\nrate = [1.5, -2.0]\n"
        }
        ("pin-in-slot", true) if is_planar => {
            "[[initial]]\njoint = \"j\"\nvalue = [0.2, 0.3]\nrate = [1.5, -2.0]\n"
        }
        ("planar", true) => {
            "[[initial]]\njoint = \"j\"\nvalue = [0.2, -0.05, 0.3]\nrate = [1.5, -2.0, 2.0]\n"
        }
        _ => "",
    };
    text + &format!(
        "[[joint]]\nname = \"j\"\nkind = \"{kind}\"\nbodies = {bodies:?}\n{at}{own_axis}{rate}\
         [[effect]]\nname = \"e\"\njoint = \"j\"\n{effect}\n"
    )
}

const ON_ONE_ROTATION: [&str; 3] = [
    "kind = \"torque\"\nvalue = 0.7",
    "kind = \"torque\"\ntable = [[0.0, 0.0], [0.05, 2.0], [0.1, -1.0]]",
    "kind = \"torsion-spring\"\nstiffness = 6.0\ndamping = 0.2\nfree_value = 0.9",
];
const ON_ONE_COORDINATE: [&str; 2] = [
    "kind = \"friction\"\ncoulomb = 0.4\nviscous = 0.1\nregularisation = 0.5",
    "kind = \"limit\"\nlower = -0.1\nupper = 0.3\nstiffness = 400.0\ndamping = 1.0",
];

#[test]
fn effects_about_an_axis_are_the_same_in_every_formulation() {
    for (is_planar, kind) in [
        (true, "revolute"),
        (true, "free"),
        (false, "revolute"),
        (false, "cylindrical"),
        (false, "planar"),
    ] {
        let others = if kind == "revolute" { &ON_ONE_COORDINATE[..] } else { &[] };
        for effect in ON_ONE_ROTATION.iter().chain(others) {
            every_method_agrees(is_planar, kind, effect, &[false, true]);
        }
    }
}

#[test]
fn effects_on_each_coordinate_are_the_same_in_every_formulation() {
    for (is_planar, kind, coordinate) in [
        (false, "cylindrical", "\"slide\""),
        (false, "cylindrical", "\"turn\""),
        (false, "universal", "\"first\""),
        (false, "universal", "\"second\""),
        (false, "planar", "\"x\""),
        (false, "planar", "1"),
        (false, "planar", "\"turn\""),
        (true, "pin-in-slot", "\"slide\""),
        (true, "pin-in-slot", "\"turn\""),
        (false, "pin-in-slot", "\"slide\""),
        (true, "free", "\"y\""),
    ] {
        for effect in ON_ONE_ROTATION[2..].iter().chain(&ON_ONE_COORDINATE) {
            let effect = format!("{effect}\ncoordinate = {coordinate}");
            // only on a moving body: on the ground, closed forms are tested below
            every_method_agrees(is_planar, kind, &effect, &[true]);
        }
    }
}

/// Asserts that all methods agree, in both orders of the bodies, on the ground and on a moving body.
fn every_method_agrees(is_planar: bool, kind: &str, effect: &str, is_on_body: &[bool]) {
    let mut faults = Vec::new();
    for place in is_on_body.iter().flat_map(|&of| [[of, false], [of, true]]) {
        let text = hung(is_planar, kind, place, effect);
        let scene = everything(&scene(&text));
        let case = |method: Way| rows_with_errors(&scene, method, (1e-3, 0.1));
        let reference = case(methods()[0]).unwrap_or_else(|e| panic!("{e}\n{text}"));
        for &method in &methods()[1..] {
            match case(method).map(|other| disagreement(&reference, &other)) {
                Ok((ratio, _)) if ratio <= 1.0 => {}
                Ok((ratio, i)) => faults.push(format!("{place:?} {method:?}: {ratio:.2}, {i}")),
                Err(stop) => faults.push(format!("{place:?} {method:?}: {stop}")),
            }
        }
    }
    assert!(faults.is_empty(), "{kind} {effect}\n{}", faults.join("\n"));
}

#[test]
fn effects_on_each_coordinate_keep_the_energy_balance() {
    for (kind, coordinate) in
        [("cylindrical", "slide"), ("universal", "first"), ("universal", "second"), ("planar", "x")]
    {
        for effect in ON_ONE_ROTATION.iter().chain(&ON_ONE_COORDINATE) {
            let effect = format!("{effect}\ncoordinate = \"{coordinate}\"");
            let scene = scene(&hung(false, kind, [true, true], &effect));
            for Way(formulation, integrator) in methods() {
                let method = Method {
                    formulation: Some(formulation.to_owned()),
                    integrator: Some(integrator.to_owned()),
                    step: Some(2e-4),
                    ..Default::default()
                };
                let outcome = run(&scene, &method);
                assert!(outcome.error.is_none(), "{kind} {effect} {formulation}");
                let errors = &outcome.steps().energy_errors;
                let worst = errors.iter().fold(0.0, |worst, error| f64::max(worst, error.abs()));
                // a stop stores up to 50 J; energy errors fall with the square of the step
                assert!(worst < 2e-3, "{kind} {effect} {formulation} {integrator}: {worst:e} J");
            }
        }
    }
}

/// Body with its centre in the joint and its principal axes along the joint's, and the inertia against each coordinate.
fn centred(kind: &str, is_planar: bool) -> (&'static str, Vec<(&'static str, f64)>) {
    let (m, [jx, jy, jz]) = (2.0, [0.02, 0.03, 0.04]);
    match (kind, is_planar) {
        ("cylindrical", _) => ("axis = [0.0, 0.0, 1.0]", vec![("slide", m), ("turn", jz)]),
        ("universal", _) => {
            ("axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]", vec![("first", jx), ("second", jy)])
        }
        ("planar", _) => (
            "axis = [0.0, 0.0, 1.0]\ndirection = [1.0, 0.0, 0.0]",
            vec![("x", m), ("y", m), ("turn", jz)],
        ),
        ("pin-in-slot", true) => ("axis = [1.0, 0.0]", vec![("slide", m), ("turn", jz)]),
        ("pin-in-slot", false) => ("axis = [1.0, 0.0, 0.0]", vec![("slide", m)]),
        _ => ("", vec![("x", m), ("y", m), ("turn", jz)]),
    }
}

/// Value and rate at the start, an effect, and value and rate at the end.
type Case = ([f64; 2], &'static str, [f64; 2]);

/// Cases of start, effect, and value and rate after `t` [s]. The first number is the angular frequency of their springs [rad/s].
fn cases(inertia: f64, t: f64) -> (f64, [Case; 4]) {
    let omega = (5.0 / inertia).sqrt();
    // each case has the value and rate at the start, the effect, and the value and rate at time t
    let cases = [
        (
            [0.0, 0.3],
            "kind = \"torque\"\nvalue = 0.7",
            [0.3 * t + 0.35 / inertia * t * t, 0.3 + 0.7 / inertia * t],
        ),
        (
            [0.3, 0.0],
            "kind = \"torsion-spring\"\nstiffness = 5.0\nfree_value = 0.1",
            [0.1 + 0.2 * (omega * t).cos(), -0.2 * omega * (omega * t).sin()],
        ),
        (
            [0.2, 1.5],
            "kind = \"limit\"\nlower = -1.0\nupper = 0.2\nstiffness = 5.0",
            [0.2 + 1.5 / omega * (omega * t).sin(), 1.5 * (omega * t).cos()],
        ),
        (
            [0.2, 1.5],
            "kind = \"friction\"\ncoulomb = 0.0\nviscous = 0.4",
            [
                0.2 + 1.5 * inertia / 0.4 * (1.0 - (-0.4 / inertia * t).exp()),
                1.5 * (-0.4 / inertia * t).exp(),
            ],
        ),
    ];
    (omega, cases)
}

/// Scene of one body with a joint on the ground, and an effect on one coordinate of the joint.
fn alone(
    (is_planar, kind): (bool, &str),
    (axes, name): (&str, &str),
    bodies: [&str; 2],
    start: &[String; 2],
    effect: &str,
) -> String {
    let origin = if is_planar { "[0.0, 0.0]" } else { "[0.0, 0.0, 0.0]" };
    let at = if kind == "free" { String::new() } else { format!("at = {origin}\n") };
    let inertia = if is_planar { "0.04" } else { "[0.02, 0.03, 0.04, 0.0, 0.0, 0.0]" };
    format!(
        "[scene]\nname = \"alone\"\ndimension = {}\nduration = 0.05\n\
         [[body]]\nname = \"a\"\nmass = 2.0\ncenter = {origin}\ninertia = {inertia}\n\
         [[joint]]\nname = \"j\"\nkind = \"{kind}\"\nbodies = {bodies:?}\n{at}{axes}\n\
         [[initial]]\njoint = \"j\"\nvalue = {}\nrate = {}\n\
         [[effect]]\njoint = \"j\"\ncoordinate = \"{name}\"\n{effect}\n\
         [[output]]\nname = \"q\"\njoint = \"j\"\nquantity = \"value\"\n\
         [[output]]\nname = \"v\"\njoint = \"j\"\nquantity = \"rate\"\n",
        if is_planar { 2 } else { 3 },
        start[0],
        start[1],
    )
}

#[test]
fn effects_move_each_coordinate_alone_by_closed_form() {
    let t = 0.05;
    for (is_planar, kind) in [
        (false, "cylindrical"),
        (false, "universal"),
        (false, "planar"),
        (true, "pin-in-slot"),
        (false, "pin-in-slot"),
        (true, "free"),
    ] {
        let (axes, coordinates) = centred(kind, is_planar);
        let count = match (kind, is_planar) {
            ("pin-in-slot", false) => 4,
            _ => coordinates.len(),
        };
        for (number, (name, inertia)) in coordinates.into_iter().enumerate() {
            let (omega, cases) = cases(inertia, t);
            for (start, effect, expected) in cases {
                for bodies in [["ground", "a"], ["a", "ground"]] {
                    let start = start.map(|x| {
                        let mut all = vec![0.0; count];
                        all[number] = x;
                        format!("{all:?}")
                    });
                    let text = alone((is_planar, kind), (axes, name), bodies, &start, effect);
                    let scene = scene(&text);
                    for &method in &methods() {
                        let rows = rows(&scene, method, (1e-4, t), 500);
                        let rows = rows.unwrap_or_else(|e| panic!("{kind} {name} {method:?}: {e}"));
                        let last = &rows.last().expect("rows").1;
                        for (i, found) in last.iter().enumerate() {
                            let own = i % count == number;
                            let expected = if own { expected[i / count] } else { 0.0 };
                            assert!(
                                (found - expected).abs() < 2e-6 * (1.0 + omega),
                                "{kind} {name} {bodies:?} {effect} {method:?}: {last:?}, {expected}"
                            );
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn a_torque_on_a_free_joint_turns_its_body_by_closed_form() {
    // a free body has the angular acceleration α = M / J, with moment M and inertia J; after 0.6 s the second body has the rate 0.6 · 0.7 /
    // 0.05 rad/s relative to the first
    for place in [[false, false], [false, true]] {
        let mut scene = scene(&hung(true, "free", place, ON_ONE_ROTATION[0]));
        let joint = JointId::new(scene.joints.len() - 1);
        quantities::show(&mut scene, [Quantity::JointRate { joint }]);
        for method in methods().iter().filter(|method| method.0 == "recursive") {
            let rows = rows(&scene, *method, (1e-3, 0.6), 600);
            let rows = rows.unwrap_or_else(|e| panic!("{method:?}: {e}"));
            let last = rows.last().expect("rows").1.last().copied().expect("a joint rate");
            assert!((last - 8.4).abs() < 1e-6, "{method:?} {place:?}: {last}");
        }
    }
}

#[test]
fn chains_that_are_guided_at_every_joint_run_in_relative_coordinates() {
    // two bars of 1 m and 1 kg have the angles q = 0.5 sin 2πt and 0.3 sin 2πt; at 1 s this gives q = 0, q' = π and 0.6 π, q'' = 0
    let text = "[scene]\nname = \"guided\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n\
        [[body]]\nname = \"a\"\nmass = 1.0\nrod = { from = [0.0, 0.0], to = [1.0, 0.0] }\n\
        [[body]]\nname = \"b\"\nmass = 1.0\nrod = { from = [1.0, 0.0], to = [2.0, 0.0] }\n\
        [[joint]]\nname = \"j1\"\nkind = \"revolute\"\nbodies = [\"ground\", \"a\"]\nat = [0.0, 0.0]\n\
        [[joint]]\nname = \"j2\"\nkind = \"revolute\"\nbodies = [\"a\", \"b\"]\nat = [1.0, 0.0]\n\
        [[guide]]\njoint = \"j1\"\nsine = { amplitude = 0.5, frequency = 1.0 }\n\
        [[guide]]\njoint = \"j2\"\nsine = { amplitude = 0.3, frequency = 1.0 }\n\
        [[output]]\nname = \"ground\"\njoint = \"j1\"\nquantity = \"reaction\"\n";
    let scene = scene(text);
    // the force of the ground moves the centres at 0.5 m and 1.5 m:   m a = −(0.5 + 1) π² − 0.5 (1.6 π)²,   and the weight of both
    let pi = core::f64::consts::PI;
    let x = -(1.5 * pi * pi + 0.5 * (1.6 * pi) * (1.6 * pi));
    for method in methods().iter().filter(|method| method.0 == "recursive") {
        let rows = rows(&scene, *method, (1e-3, 1.0), 1000);
        let rows = rows.unwrap_or_else(|e| panic!("{method:?}: {e}"));
        let last = &rows.last().expect("rows").1;
        // the row has the force of the ground and the moments of the guides; the first moment is m g (0.5 + 1.5)
        for (found, expected) in last.iter().zip([x, 19.62, 19.62]) {
            assert!((found - expected).abs() < 1e-6 * 27.0, "{method:?}: {last:?}");
        }
    }
}

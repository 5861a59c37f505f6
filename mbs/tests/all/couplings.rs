//! Couplings against closed forms, in every formulation that has them.

use crate::common::oracle::{Rows, Way, rows};
use mbs::core::scene::Scene;
use mbs_testkit::scene;

/// What is integrated exactly, constant accelerations, is met to this, relative.
const EXACT: f64 = 1e-9;

/// Every formulation with the trapezoidal rule.
fn ways() -> [Way; 4] {
    ["index-3", "index-1", "classical", "state-space"].map(|f| Way(f, "trapezoidal"))
}

fn last(rows: &Rows) -> &[f64] {
    &rows.last().expect("a row").1
}

/// Last values of the outputs after `duration` by each formulation.
fn ends(scene: &Scene<f64>, duration: f64) -> Vec<(Way, Vec<f64>)> {
    let run = |way| {
        let rows = rows(scene, way, (duration / 16.0, duration), 1);
        let rows = rows.unwrap_or_else(|e| panic!("{way:?}: {e}"));
        (way, last(&rows).to_vec())
    };
    ways().map(run).to_vec()
}

/// Rates at the end of a motion with these constant accelerations.
fn has_accelerations(name: &str, text: &str, expected: &[f64]) {
    let duration = 0.02;
    for (way, found) in ends(&scene(text), duration) {
        for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
            let acceleration = found / duration;
            assert!(
                (acceleration - expected).abs() <= EXACT * expected.abs(),
                "{name} by {way:?}, output {k}: {acceleration:.12}, not {expected:.12}"
            );
        }
    }
}

const HEAD: &str = "[scene]\nname = \"c\"\ndimension = 2\nduration = 1.0\n";

fn body(name: &str, mass: f64, center: [f64; 2], inertia: f64) -> String {
    format!(
        "[[body]]\nname = \"{name}\"\nmass = {mass:?}\ncenter = {center:?}\ninertia = {inertia:?}\n"
    )
}

fn revolute(name: &str, bodies: [&str; 2], at: [f64; 2]) -> String {
    format!("[[joint]]\nname = \"{name}\"\nkind = \"revolute\"\nbodies = {bodies:?}\nat = {at:?}\n")
}

fn prismatic(name: &str, bodies: [&str; 2], at: [f64; 2], axis: [f64; 2]) -> String {
    format!(
        "[[joint]]\nname = \"{name}\"\nkind = \"prismatic\"\nbodies = {bodies:?}\nat = {at:?}\naxis = {axis:?}\n"
    )
}

fn torque(joint: &str, value: f64) -> String {
    format!("[[effect]]\nkind = \"torque\"\njoint = \"{joint}\"\nvalue = {value:?}\n")
}

fn rates(joints: &[&str]) -> String {
    let one = |joint: &&str| {
        format!("[[output]]\nname = \"{joint}-rate\"\njoint = \"{joint}\"\nquantity = \"rate\"\n")
    };
    joints.iter().map(one).collect()
}

/// Two wheels in a housing on a free hinge; a motor from the housing on the first.
fn housing() -> String {
    [
        HEAD.to_owned(),
        body("housing", 1.0, [0.0, 0.0], 0.196),
        body("w1", 1.0, [0.2, 0.0], 0.02),
        body("w2", 1.0, [-0.2, 0.0], 0.004),
        revolute("h", ["ground", "housing"], [0.0, 0.0]),
        revolute("a", ["housing", "w1"], [0.2, 0.0]),
        revolute("b", ["housing", "w2"], [-0.2, 0.0]),
        "[[coupling]]\nname = \"mesh\"\nkind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [40, 17]\n".into(),
        torque("a", 0.8),
        rates(&["h", "a"]),
    ]
    .concat()
}

#[test]
fn a_gear_in_a_free_housing_takes_the_housing_along() {
    // [[0.3, I1 - k I2], [I1 - k I2, I1 + k^2 I2]] (h, a)'' = (0, 0.8), k = 40/17
    has_accelerations("housing", &housing(), &[-0.675_944_334_0, 19.151_756_130]);
    let (i1, i2, k) = (0.02, 0.004, 40.0 / 17.0);
    let (m12, m22) = (i1 - k * i2, i1 + k * k * i2);
    let a = 0.8 / (m22 - m12 * m12 / 0.3);
    has_accelerations("housing", &housing(), &[-m12 / 0.3 * a, a]);
}

#[test]
fn a_planetary_set_drives_its_carrier() {
    // sun and ring on the ground's axis, the ring fixed, one planet on the carrier
    let parts = |couplings: &str| {
        [
            HEAD.to_owned(),
            body("sun", 1.0, [0.0, 0.0], 0.01),
            body("carrier", 1.0, [0.0, 0.0], 0.05),
            body("planet", 0.4, [0.08, 0.0], 0.002),
            revolute("s", ["ground", "sun"], [0.0, 0.0]),
            revolute("c", ["ground", "carrier"], [0.0, 0.0]),
            revolute("p", ["carrier", "planet"], [0.08, 0.0]),
            couplings.to_owned(),
            torque("s", 1.0),
            rates(&["c", "s", "p"]),
        ]
        .concat()
    };
    let of_wheels = "[[coupling]]\nkind = \"linear\"\nterms = [{ joint = \"s\", factor = 20.0 }, { joint = \"c\", factor = -20.0 }, { joint = \"p\", factor = 20.0 }]\n[[coupling]]\nkind = \"linear\"\nterms = [{ joint = \"c\", factor = 60.0 }, { joint = \"p\", factor = 20.0 }]\n";
    let carrier = 18.135_654_697;
    // the planet's angle is against the carrier: -2 of it against the ground
    let expected = [carrier, 4.0 * carrier, -3.0 * carrier];
    has_accelerations("planetary set", &parts(of_wheels), &expected);
}

#[test]
fn elements_between_two_coordinates_share_their_inertia() {
    // each: m1 x'' + m2 r^2 x'' = f for y = r x
    let turn_and_slide = |coupling: &str| {
        [
            HEAD.to_owned(),
            body("wheel", 1.0, [0.0, 0.0], 0.02),
            body("slider", 3.0, [0.0, 1.0], 0.1),
            revolute("a", ["ground", "wheel"], [0.0, 0.0]),
            prismatic("s", ["ground", "slider"], [0.0, 1.0], [1.0, 0.0]),
            coupling.to_owned(),
            torque("a", 0.5),
            rates(&["a", "s"]),
        ]
        .concat()
    };
    let expected = |r: f64| [0.5 / (0.02 + 3.0 * r * r), 0.5 * r / (0.02 + 3.0 * r * r)];
    let lead = 0.4 / core::f64::consts::TAU;
    for (r, coupling) in [
        (0.3, "kind = \"rack\"\njoints = [\"a\", \"s\"]\nradius = 0.3\n"),
        (lead, "kind = \"screw\"\njoints = [\"a\", \"s\"]\nlead = 0.4\n"),
        (-0.25, "kind = \"mimic\"\njoint = \"s\"\nof = \"a\"\nfactor = -0.25\n"),
        (0.2, "kind = \"cam\"\njoints = [\"a\", \"s\"]\ncoefficients = [0.0, 0.2]\n"),
        (
            0.5,
            "kind = \"linear\"\nterms = [{ joint = \"s\", factor = 2.0 }, { joint = \"a\", factor = -1.0 }]\n",
        ),
    ] {
        let text = turn_and_slide(&format!("[[coupling]]\n{coupling}"));
        has_accelerations(coupling, &text, &expected(r));
    }
    let two_wheels = |coupling: &str| {
        [
            HEAD.to_owned(),
            body("w1", 1.0, [0.0, 0.0], 0.02),
            body("w2", 1.0, [1.0, 0.0], 0.05),
            revolute("a", ["ground", "w1"], [0.0, 0.0]),
            revolute("b", ["ground", "w2"], [1.0, 0.0]),
            coupling.to_owned(),
            torque("a", 0.5),
            rates(&["a", "b"]),
        ]
        .concat()
    };
    let expected = |r: f64| [0.5 / (0.02 + 0.05 * r * r), 0.5 * r / (0.02 + 0.05 * r * r)];
    for (r, coupling) in [
        (0.5, "kind = \"belt\"\njoints = [\"a\", \"b\"]\nradii = [0.1, 0.2]\n"),
        (-0.5, "kind = \"belt\"\njoints = [\"a\", \"b\"]\nradii = [0.1, 0.2]\ncrossed = true\n"),
        (-0.5, "kind = \"gear\"\njoints = [\"a\", \"b\"]\nradii = [0.1, 0.2]\n"),
        (0.25, "kind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [10, 40]\nmesh = \"internal\"\n"),
        (-0.75, "kind = \"gear\"\njoints = [\"a\", \"b\"]\nratio = -0.75\n"),
    ] {
        let text = two_wheels(&format!("[[coupling]]\n{coupling}"));
        has_accelerations(coupling, &text, &expected(r));
    }
}

#[test]
fn a_differential_shares_its_torque_by_the_teeth() {
    // cage c drives a and b: a - c = -(b - c); T on the cage: (Ia + Ib) c'' = T for equal wheels
    let text = [
        HEAD.to_owned(),
        body("wa", 1.0, [0.0, 1.0], 0.03),
        body("wb", 1.0, [0.0, -1.0], 0.01),
        body("cage", 1.0, [0.0, 0.0], 0.02),
        revolute("a", ["ground", "wa"], [0.0, 1.0]),
        revolute("b", ["ground", "wb"], [0.0, -1.0]),
        revolute("c", ["ground", "cage"], [0.0, 0.0]),
        "[[coupling]]\nkind = \"differential\"\njoints = [\"a\", \"b\", \"c\"]\n".into(),
        torque("c", 0.7),
        rates(&["a", "b", "c"]),
    ]
    .concat();
    // a'' = l/Ia, b'' = l/Ib, c'' = (T - 2 l)/Ic, a'' + b'' = 2 c''
    let (ia, ib, ic, t) = (0.03, 0.01, 0.02, 0.7);
    let l = 2.0 * t / ic / (1.0 / ia + 1.0 / ib + 4.0 / ic);
    has_accelerations("differential", &text, &[l / ia, l / ib, (t - 2.0 * l) / ic]);
}

fn hanging(name: &str, mass: f64, at: [f64; 2]) -> String {
    body(name, mass, at, 0.1) + &prismatic(&format!("{name}-s"), ["ground", name], at, [0.0, 1.0])
}

#[test]
fn ropes_over_points_share_their_tension() {
    let head = "[scene]\nname = \"c\"\ndimension = 2\nduration = 1.0\ngravity = [0.0, -9.81]\n";
    let rope = |points: &[(&str, [f64; 2])]| {
        let one = |(body, at): &(&str, [f64; 2])| format!("{{ body = \"{body}\", at = {at:?} }}");
        let points: Vec<_> = points.iter().map(one).collect();
        format!("[[coupling]]\nkind = \"rope\"\npoints = [{}]\n", points.join(", "))
    };
    let atwood = [
        head.to_owned(),
        hanging("m", 3.0, [0.0, -1.0]),
        hanging("n", 2.0, [1.0, -2.0]),
        rope(&[
            ("m", [0.0, -1.0]),
            ("ground", [0.0, 1.0]),
            ("ground", [1.0, 1.0]),
            ("n", [1.0, -2.0]),
        ]),
        rates(&["m-s", "n-s"]),
    ];
    natural_has_accelerations("Atwood", &atwood.concat(), &[-1.962, 1.962]);
    let movable = [
        head.to_owned(),
        hanging("p", 4.0, [0.0, -1.0]),
        hanging("n", 3.0, [1.0, -2.0]),
        rope(&[
            ("ground", [-0.2, 1.0]),
            ("p", [-0.2, -1.0]),
            ("p", [0.2, -1.0]),
            ("ground", [0.2, 1.0]),
            ("ground", [1.0, 1.0]),
            ("n", [1.0, -2.0]),
        ]),
        rates(&["p-s", "n-s"]),
    ];
    // 4 p'' = 2 T - 4 g, 3 n'' = T - 3 g, n'' = -2 p''
    natural_has_accelerations("movable pulley", &movable.concat(), &[1.226_25, -2.4525]);
}

/// Relative coordinates refuse ropes.
fn natural_has_accelerations(name: &str, text: &str, expected: &[f64]) {
    has_accelerations(name, text, expected);
}

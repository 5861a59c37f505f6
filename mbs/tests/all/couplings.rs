//! Couplings against closed forms, in every formulation that has them.

use crate::common::oracle::{TRAPEZOIDAL, Way, last, rows};
use mbs::core::scene::Scene;
use mbs_testkit::scene;

/// Relative error of constant accelerations [-]. In half a millisecond, the trapezoidal rule of rotating directions gives 1e-9, and rounding
/// divided by the step as much.
const EXACT: f64 = 1e-8;

/// Returns each formulation with the trapezoidal rule.
fn ways() -> [Way; 5] {
    TRAPEZOIDAL.map(|f| Way(f, "trapezoidal"))
}

/// Last values of the outputs after `duration` [s] by each formulation.
fn ends(scene: &Scene<f64>, duration: f64) -> Vec<(Way, Vec<f64>)> {
    let run = |way| {
        let rows = rows(scene, way, (duration / 16.0, duration), 1);
        let rows = rows.unwrap_or_else(|e| panic!("{way:?}: {e}"));
        (way, last(&rows).to_vec())
    };
    ways().map(run).to_vec()
}

/// Asserts the rates after a motion with these constant accelerations.
fn has_accelerations(name: &str, text: &str, expected: &[f64]) {
    let duration = 5e-4;
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

/// Scene of two wheels on the ground with these inertias, and further text.
fn wheels(inertias: [f64; 2], others: &[&str]) -> String {
    [
        HEAD,
        &body("w1", 1.0, [0.0, 0.0], inertias[0]),
        &body("w2", 1.0, [1.0, 0.0], inertias[1]),
        &revolute("a", ["ground", "w1"], [0.0, 0.0]),
        &revolute("b", ["ground", "w2"], [1.0, 0.0]),
        &others.concat(),
    ]
    .concat()
}

/// Scene of two wheels in a housing on a free hinge. A motor acts from the housing on the first wheel.
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
    // equations of motion: [[0.3, I1 - k I2], [I1 - k I2, I1 + k^2 I2]] (h, a)'' = (0, 0.8), k = 40/17, with the angles h of the housing and a
    // of the first wheel
    has_accelerations("housing", &housing(), &[-0.675_944_334_0, 19.151_756_130]);
    let (i1, i2, k) = (0.02, 0.004, 40.0 / 17.0);
    let (m12, m22) = (i1 - k * i2, i1 + k * k * i2);
    let a = 0.8 / (m22 - m12 * m12 / 0.3);
    has_accelerations("housing", &housing(), &[-m12 / 0.3 * a, a]);
}

#[test]
fn a_planetary_set_drives_its_carrier() {
    // sun and ring turn about the ground's axis, the ring is fixed, and one planet is on the carrier
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
    // the planet's angle is relative to the carrier; relative to the ground it is -2 times the carrier's
    let expected = [carrier, 4.0 * carrier, -3.0 * carrier];
    has_accelerations("planetary set", &parts(of_wheels), &expected);
}

#[test]
fn elements_between_two_coordinates_share_their_inertia() {
    // each coupling y = r x gives m1 x'' + m2 r^2 x'' = f, with m1 and m2 the masses or inertias, and the force or torque f
    let turn_and_slide = |coupling: &str| {
        [
            HEAD.to_owned(),
            body("wheel", 1.0, [0.0, 0.0], 0.02),
            body("slider", 3.0, [0.0, 1.0], 0.1),
            revolute("a", ["ground", "wheel"], [0.0, 0.0]),
            // the rack is below its pinion
            prismatic("s", ["ground", "slider"], [0.0, -0.3], [1.0, 0.0]),
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
    let two_wheels =
        |coupling: &str| wheels([0.02, 0.05], &[coupling, &torque("a", 0.5), &rates(&["a", "b"])]);
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
    // the cage with angle c drives the wheels with angles a and b: a - c = -(b - c); a torque T on the cage gives (Ia + Ib) c'' = T for equal
    // wheels
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
    // the coupling's torque l gives a'' = l/Ia, b'' = l/Ib, c'' = (T - 2 l)/Ic, where a'' + b'' = 2 c''
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
    has_accelerations("Atwood", &atwood.concat(), &[-1.962, 1.962]);
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
    // the tension T moves the pulley at height p and the mass at height n: 4 p'' = 2 T - 4 g, 3 n'' = T - 3 g, n'' = -2 p''
    has_accelerations("movable pulley", &movable.concat(), &[1.226_25, -2.4525]);
}

/// Two coupled wheels whose centres of mass are not on their axles, and the one equation of motion that remains.
struct Eccentric {
    /// Second angle as a function of the first, with its derivatives.
    curve: fn(f64) -> [f64; 3],
    coupling: &'static str,
}

impl Eccentric {
    const MASS: [f64; 2] = [1.5, 0.7];
    const INERTIA: [f64; 2] = [0.02, 0.004];
    const OFFSET: [f64; 2] = [0.1, 0.06];
    const RATE: f64 = 6.0;

    fn scene(&self, dimension: usize) -> Scene<f64> {
        let wheel = |i: usize| {
            let [name, joint] = [["w1", "w2"][i], ["a", "b"][i]];
            let (x, mass, inertia) = (i as f64, Self::MASS[i], Self::INERTIA[i]);
            let center = x + Self::OFFSET[i];
            if dimension == 2 {
                return body(name, mass, [center, 0.0], inertia)
                    + &revolute(joint, ["ground", name], [x, 0.0]);
            }
            // the axis (0, -0.6, 0.8) is oblique; gravity is perpendicular to it
            format!(
                "[[body]]\nname = \"{name}\"\nmass = {mass:?}\ncenter = [{center:?}, 0.0, 0.0]\ninertia = [{inertia:?}, {inertia:?}, {inertia:?}, 0.0, 0.0, 0.0]\n[[joint]]\nname = \"{joint}\"\nkind = \"revolute\"\nbodies = [\"ground\", \"{name}\"]\nat = [{x:?}, 0.0, 0.0]\naxis = [0.0, -0.6, 0.8]\n"
            )
        };
        let gravity = if dimension == 2 { "[0.0, -9.81]" } else { "[0.0, -7.848, -5.886]" };
        let head = format!(
            "[scene]\nname = \"e\"\ndimension = {dimension}\nduration = 1.0\ngravity = {gravity}\n"
        );
        let start = format!("[[initial]]\njoint = \"a\"\nvalue = 0.0\nrate = {:?}\n", Self::RATE);
        let values = "[[output]]\nname = \"x\"\njoint = \"a\"\nquantity = \"value\"\n[[output]]\nname = \"y\"\njoint = \"b\"\nquantity = \"value\"\n";
        scene(&[&head, &wheel(0), &wheel(1), &start, self.coupling, values].concat())
    }

    fn acceleration(&self, x: f64, v: f64) -> f64 {
        let [y, slope, bend] = (self.curve)(x);
        let inertia = |i: usize| Self::INERTIA[i] + Self::MASS[i] * Self::OFFSET[i].powi(2);
        let torque = |i: usize, angle: f64| -9.81 * Self::MASS[i] * Self::OFFSET[i] * angle.cos();
        let force = torque(0, x) + slope * torque(1, y) - inertia(1) * slope * bend * v * v;
        force / (inertia(0) + slope * slope * inertia(1))
    }

    /// Both angles at time one, by the classical Runge-Kutta method with an error of 1e-12.
    fn end(&self) -> [f64; 2] {
        let (n, mut x, mut v) = (20_000, 0.0, Self::RATE);
        let h = 1.0 / f64::from(n);
        for _ in 0..n {
            let k1 = [v, self.acceleration(x, v)];
            let at = |k: [f64; 2], h: f64| {
                let (x, v) = (x + h * k[0], v + h * k[1]);
                [v, self.acceleration(x, v)]
            };
            let k2 = at(k1, 0.5 * h);
            let k3 = at(k2, 0.5 * h);
            let k4 = at(k3, h);
            x += h / 6.0 * (k1[0] + 2.0 * (k2[0] + k3[0]) + k4[0]);
            v += h / 6.0 * (k1[1] + 2.0 * (k2[1] + k3[1]) + k4[1]);
        }
        [x, (self.curve)(x)[0]]
    }
}

const GEAR: Eccentric = Eccentric {
    curve: |x| [-40.0 / 17.0 * x, -40.0 / 17.0, 0.0],
    coupling: "[[coupling]]\nkind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [40, 17]\n",
};

const CAM: Eccentric = Eccentric {
    curve: |x| {
        [0.2 * x + 0.3 * x * x - 0.04 * x * x * x, 0.2 + 0.6 * x - 0.12 * x * x, 0.6 - 0.24 * x]
    },
    coupling: "[[coupling]]\nkind = \"cam\"\njoints = [\"a\", \"b\"]\ncoefficients = [0.0, 0.2, 0.3, -0.04]\n",
};

#[test]
fn half_the_step_has_a_quarter_of_the_error_with_gears_and_cams() {
    for (name, wheels) in [("gear", GEAR), ("cam", CAM)] {
        let expected = wheels.end();
        for dimension in [2, 3] {
            let scene = wheels.scene(dimension);
            for way in ways() {
                let error = |step: f64| {
                    let rows = rows(&scene, way, (step, 1.0), 1);
                    let rows = rows.unwrap_or_else(|e| panic!("{name} by {way:?}: {e}"));
                    let end = last(&rows);
                    (end[0] - expected[0]).abs().max((end[1] - expected[1]).abs())
                };
                let errors = [2e-3, 1e-3, 5e-4].map(error);
                for pair in errors.windows(2) {
                    let ratio = pair[0] / pair[1];
                    assert!(
                        (ratio - 4.0).abs() < 0.4,
                        "{name} in {dimension}D by {way:?}: {errors:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_gear_keeps_its_ratio_over_many_hundred_turns() {
    let text = wheels(
        [0.02, 0.05],
        &[
            "[[coupling]]\nkind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [13, 17]\n",
            "[[initial]]\njoint = \"a\"\nrate = 100.0\n",
        ],
    );
    let scene = scene(&text);
    for way in ways() {
        let rows = rows(&scene, way, (5e-4, 63.0), 1).unwrap_or_else(|e| panic!("{way:?}: {e}"));
        let end = last(&rows);
        assert!(end[0] > 900.0 * core::f64::consts::TAU, "{way:?}: {end:?}");
        let left = (13.0 * end[0] + 17.0 * end[1]) / (13.0 * end[0]);
        assert!(left.abs() < 1e-13, "{way:?}: {left:e}");
    }
}

#[test]
fn a_driven_sum_prescribes_motion() {
    // a + b = 0.5 sin(2 pi t): with equal inertias each wheel turns by half of it
    let text = wheels(
        [0.02, 0.02],
        &[
            "[[coupling]]\nkind = \"linear\"\nterms = [{ joint = \"a\" }, { joint = \"b\" }]\nsine = { amplitude = 0.5, frequency = 1.0 }\n",
            "[[initial]]\njoint = \"a\"\nrate = 1.5707963267948966\n",
        ],
    );
    for way in ways() {
        let rows =
            rows(&scene(&text), way, (1e-3, 0.25), 1).unwrap_or_else(|e| panic!("{way:?}: {e}"));
        for (t, row) in &rows {
            let expected = 0.25 * (core::f64::consts::TAU * t).sin();
            // the trapezoidal rule has a relative error of h^2 w^2 / 12
            assert!((row[0] - expected).abs() < 2e-5, "{way:?} at {t}: {row:?}");
            assert!((row[0] + row[1] - 2.0 * expected).abs() < 1e-12, "{way:?} at {t}: {row:?}");
        }
    }
}

#[test]
fn turns_at_the_start_count_in_the_sum() {
    let text = wheels(
        [0.02, 0.05],
        &[
            "[[coupling]]\nkind = \"gear\"\njoints = [\"a\", \"b\"]\nratio = 1.75\n",
            "[[initial]]\njoint = \"a\"\nvalue = -12.5\nrate = 1.0\n",
        ],
    );
    for way in ways() {
        let rows =
            rows(&scene(&text), way, (1e-3, 0.1), 1).unwrap_or_else(|e| panic!("{way:?}: {e}"));
        let [start, end] = [&rows[0].1, last(&rows)];
        assert!((start[0] + 12.5).abs() < 1e-12 && (start[1] + 21.875).abs() < 1e-12, "{start:?}");
        assert!((end[1] - 1.75 * end[0]).abs() < 1e-12, "{way:?}: {end:?}");
    }
}

//! Equilibria and modes in any unit: lengths from a millimetre to a hundred metres, other masses, other times.

use super::super::read;
use mbs::{Modes, Place, Search, StaticEquilibrium};

/// Relative difference of results between units [-]: the differences behind the eigenvalues have nine digits.
const CLOSE: f64 = 1e-9;
/// Relative difference with times of a thousandth [-]. Velocities differ by 1e-4 of the size in a second, and their rounding gives 5e-9 of an
/// eigenvalue.
const FAST: f64 = 2e-8;

/// Scene of a spatial tree with springs: a bar on a hinge with a torsion spring, a second bar on a ball joint with two springs, and a slide
/// on a pad. Units of length, mass and time are `l`, `m` and `t`.
fn tree([l, m, t]: [f64; 3]) -> String {
    let (g, k) = (-9.81 * l / (t * t), m / (t * t));
    let vector = |x: [f64; 3]| format!("[{:e}, {:e}, {:e}]", x[0] * l, x[1] * l, x[2] * l);
    let inertia = |x: [f64; 3]| {
        let s = m * l * l;
        format!("[{:e}, {:e}, {:e}, 0.0, 0.0, 0.0]", x[0] * s, x[1] * s, x[2] * s)
    };
    let body = |name: &str, mass: f64, at: [f64; 3], tensor: [f64; 3]| {
        let (center, inertia) = (vector(at), inertia(tensor));
        format!(
            "[[body]]\nname = \"{name}\"\nmass = {:e}\ncenter = {center}\ninertia = {inertia}\n",
            mass * m
        )
    };
    let joint = |name: &str, kind: &str, bodies: [&str; 2], at: [f64; 3], axis: &str| {
        let (at, [a, b]) = (vector(at), bodies);
        format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"{kind}\"\nbodies = [\"{a}\", \"{b}\"]\nat = {at}\n{axis}\n"
        )
    };
    let spring = |name: &str, [a, b]: [&str; 2], points: [[f64; 3]; 2], law: [f64; 2]| {
        let [p, q] = points.map(vector);
        format!(
            "[[effect]]\nname = \"{name}\"\nkind = \"spring-damper\"\nbodies = [\"{a}\", \"{b}\"]\npoints = [{p}, {q}]\n\
             stiffness = {:e}\ndamping = {:e}\nfree_length = {:e}\n",
            law[0] * k,
            0.3 * k * t,
            law[1] * l
        )
    };
    [
        format!("[scene]\nname = \"tree\"\ndimension = 3\ngravity = [0.0, 0.0, {g:e}]\nduration = {t:e}\n"),
        body("bar", 1.2, [0.4, 0.0, 0.0], [0.01, 0.09, 0.08]),
        body("arm", 0.5, [1.0, 0.1, 0.0], [0.02, 0.03, 0.04]),
        body("block", 2.0, [0.0, 0.0, 0.5], [0.1, 0.1, 0.1]),
        joint("hinge", "revolute", ["ground", "bar"], [0.0; 3], "axis = [0.0, 1.0, 0.0]"),
        joint("ball", "spherical", ["bar", "arm"], [0.8, 0.0, 0.0], ""),
        joint("post", "prismatic", ["ground", "block"], [0.0, 0.0, 0.5], "axis = [0.0, 0.0, 1.0]"),
        format!(
            "[[effect]]\nname = \"twist\"\nkind = \"torsion-spring\"\njoint = \"hinge\"\nstiffness = {:e}\ndamping = {:e}\n",
            30.0 * k * l * l,
            0.2 * k * t * l * l
        ),
        spring("s1", ["ground", "arm"], [[1.1, 0.2, 1.0], [1.2, 0.2, 0.0]], [60.0, 0.8]),
        spring("s2", ["ground", "arm"], [[1.3, -0.9, 0.3], [1.1, -0.1, 0.0]], [40.0, 0.6]),
        format!(
            "[[effect]]\nname = \"pad\"\nkind = \"bumper\"\nbodies = [\"ground\", \"block\"]\npoints = [{}, {}]\n\
             stiffness = {:e}\nclearance = {:e}\n",
            vector([0.0; 3]),
            vector([0.0, 0.0, 0.5]),
            5000.0 * k,
            0.01 * l
        ),
    ]
    .concat()
}

#[test]
fn equilibria_and_modes_are_the_same_in_every_unit() {
    let analyse = |units: [f64; 3]| {
        let scene = read(&tree(units), "tree");
        let still = StaticEquilibrium::new(&scene, Search::Down)
            .unwrap_or_else(|e| panic!("{units:?}: {e}"));
        let modes = Modes::new(&scene, Place::Equilibrium, Search::Down);
        (still, modes.unwrap_or_else(|e| panic!("{units:?}: {e}")).modes)
    };
    let (still, modes) = analyse([1.0; 3]);
    assert_eq!((still.unstable, still.neutral), (Some(0), Some(0)));
    // the hinge has one degree of freedom, the ball joint three, the slide one
    assert_eq!(modes.len(), 5);
    for l in [1e-4, 1e-3, 0.1, 100.0] {
        for [m, t] in [[1.0, 1.0], [1e-6, 1.0], [1e6, 1.0], [1.0, 1e-3], [1.0, 60.0]] {
            let (scaled, others) = analyse([l, m, t]);
            assert_eq!((scaled.unstable, scaled.neutral), (Some(0), Some(0)), "{l} {m} {t}");
            let slide = |s: &StaticEquilibrium| s.joints[2].1[0];
            assert!((slide(&scaled) / l - slide(&still)).abs() < CLOSE, "{l} {m} {t}");
            let angle = |s: &StaticEquilibrium| s.joints[0].1[0];
            assert!((angle(&scaled) - angle(&still)).abs() < CLOSE, "{l} {m} {t}");
            assert_eq!(others.len(), modes.len(), "{l} {m} {t}");
            for (a, b) in others.iter().zip(&modes) {
                let apart = (a.real * t - b.real).hypot(a.imaginary * t - b.imaginary);
                let close = if t < 1.0 { FAST } else { CLOSE };
                assert!(apart < close * b.real.hypot(b.imaginary), "{l} {m} {t}: {a:?} {b:?}");
            }
            let near = StaticEquilibrium::new(&read(&tree([l, m, t]), "tree"), Search::Near);
            let near = near.unwrap_or_else(|e| panic!("{l} {m} {t}: {e}"));
            assert!((slide(&near) / l - slide(&still)).abs() < CLOSE, "{l} {m} {t}: {near:?}");
            assert!((angle(&near) - angle(&still)).abs() < CLOSE, "{l} {m} {t}: {near:?}");
        }
    }
}

//! Slides that a relation holds on a curve: one degree of freedom, whose equation is written by hand.

use super::{Ellipse, Product, initial, of_joints, run, scene, slides, solve};
use crate::common::oracle::{WAYS, Way, agree_in_the_limit, last};
use mbs::core::scene::Scene;

/// Step and length of the runs that are compared with equations [s].
const TIMES: (f64, f64) = (1e-3, 0.6);
/// Error of methods of order eight with steps of 1 ms, for a motion of order one, and for its accelerations with oblique directions.
const EXACT: f64 = 1e-11;

/// Two bodies on oblique slides with coordinates x and y, where (1 + x)(1 + y) = 1. The start is at x = 0.5 with a rate.
struct Hyperbola {
    dimension: usize,
    axes: [[f64; 3]; 2],
    gravity: [f64; 3],
}

const IN_PLANE: Hyperbola = Hyperbola {
    dimension: 2,
    axes: [[0.8, 0.6, 0.0], [-0.28, 0.96, 0.0]],
    gravity: [1.5, -9.81, 0.0],
};
const IN_SPACE: Hyperbola = Hyperbola {
    dimension: 3,
    axes: [[0.48, 0.64, 0.6], [0.6, -0.8, 0.0]],
    gravity: [2.0, 3.0, -9.81],
};

impl Hyperbola {
    const MASS: [f64; 2] = [1.3, 0.7];
    const START: [f64; 2] = [1.5, 0.8];

    fn scene(&self) -> Scene<f64> {
        let [u, w] = self.axes;
        let bodies = [("a", Self::MASS[0], "ground", u), ("b", Self::MASS[1], "ground", w)];
        let text = slides(self.dimension, self.gravity, &bodies)
            + &initial("a-s", &format!("value = [{:?}]\nrate = [{:?}]", 0.5, Self::START[1]));
        scene(&text, [of_joints(&[0, 1], Product).holding(1.0)])
    }

    /// Weight along the slides.
    fn forces(&self) -> [f64; 2] {
        [0, 1].map(|i| {
            let along = self.axes[i].iter().zip(self.gravity).map(|(x, g)| x * g);
            Self::MASS[i] * along.sum::<f64>()
        })
    }

    /// Acceleration with X = 1 + x and Y = 1/X: (m1 + m2/X^4) X'' - 2 m2 X'^2/X^5 = F1 - F2/X^2.
    fn acceleration(&self, [x, v]: [f64; 2]) -> f64 {
        let ([m1, m2], [f1, f2]) = (Self::MASS, self.forces());
        (f1 - f2 / (x * x) + 2.0 * m2 * v * v / x.powi(5)) / (m1 + m2 / x.powi(4))
    }

    /// Coordinates, rates, effort and value of the relation at a time. The effort follows from m1 X'' = F1 + Y effort.
    fn at(&self, t: f64) -> [f64; 6] {
        let [x, v] = solve(Self::START, t, |x| self.acceleration(x));
        let effort = (Self::MASS[0] * self.acceleration([x, v]) - self.forces()[0]) * x;
        [x - 1.0, v, 1.0 / x - 1.0, -v / (x * x), effort, 1.0]
    }
}

#[test]
fn two_slides_on_a_hyperbola_move_as_its_equation_says_in_every_formulation() {
    for hyperbola in [IN_PLANE, IN_SPACE] {
        let scene = hyperbola.scene();
        let right = hyperbola.at(TIMES.1);
        let exact = run(&scene, Way("recursive", "rk853"), TIMES.0, TIMES.1, 1);
        for (k, (found, right)) in last(&exact).iter().zip(right).enumerate() {
            assert!((found - right).abs() < EXACT * 10.0, "{k}: {found} {right}");
        }
        for way in WAYS.into_iter().filter(|way| way.1 == "trapezoidal") {
            let times = (TIMES.0, TIMES.1, 200);
            agree_in_the_limit(&scene, way, times, 1e-9, |_| ());
        }
    }
}

/// Returns a scene and its equation of motion. A carrier moves on a slide. A bead moves on the carrier, perpendicular to the slide. A relation
/// holds the bead on an ellipse.
fn trammel() -> (Scene<f64>, impl Fn([f64; 2]) -> f64) {
    let (axes, mass, gravity) = ([0.7, 0.4], [2.0, 0.9], [-1.0, 4.0, -7.0]);
    let [u, w] = [[0.48, 0.64, 0.6], [0.8, -0.6, 0.0]];
    let bodies = [("carrier", mass[0], "ground", u), ("bead", mass[1], "carrier", w)];
    let text = slides(3, gravity, &bodies) + &initial("bead-s", "value = [0.0]\nrate = [1.6]");
    let along = |v: [f64; 3]| v.iter().zip(gravity).map(|(x, g)| x * g).sum::<f64>();
    let force = [(mass[0] + mass[1]) * along(u), mass[1] * along(w)];
    let of = of_joints(&[0, 1], Ellipse(axes)).holding(1.0);
    let equation = move |[s, v]: [f64; 2]| {
        // the bead has x = a (cos s - 1) and y = b sin s; the carrier has x
        let inertia = [(mass[0] + mass[1]) * axes[0].powi(2), mass[1] * axes[1].powi(2)];
        let [sin, cos] = [s.sin(), s.cos()];
        let bent = (inertia[0] - inertia[1]) * sin * cos * v * v;
        let driving = -force[0] * axes[0] * sin + force[1] * axes[1] * cos;
        (driving - bent) / (inertia[0] * sin * sin + inertia[1] * cos * cos)
    };
    (scene(&text, [of]), equation)
}

#[test]
fn an_elliptic_trammel_is_a_bead_on_an_ellipse_in_every_formulation() {
    let (scene, equation) = trammel();
    let [s, v] = solve([0.0, 4.0], TIMES.1, equation);
    assert!(s.abs() > 1.0, "it moves over a large part of the ellipse: {s}");
    let right = [0.7 * (s.cos() - 1.0), -0.7 * s.sin() * v, 0.4 * s.sin(), 0.4 * s.cos() * v];
    let exact = run(&scene, Way("recursive", "rk853"), TIMES.0, TIMES.1, 1);
    for (k, (found, right)) in last(&exact).iter().zip(right).enumerate() {
        assert!((found - right).abs() < EXACT * 10.0, "{k}: {found} {right}");
    }
    for way in WAYS.into_iter().filter(|way| way.1 == "trapezoidal") {
        agree_in_the_limit(&scene, way, (TIMES.0, TIMES.1, 200), 1e-9, |_| ());
    }
}

#[test]
fn half_the_step_has_a_quarter_of_the_error_on_a_hyperbola() {
    for hyperbola in [IN_PLANE, IN_SPACE] {
        let scene = hyperbola.scene();
        let right = hyperbola.at(TIMES.1);
        for way in WAYS.into_iter().filter(|way| way.1 == "trapezoidal") {
            let error = |step: f64| {
                let rows = run(&scene, way, step, TIMES.1, 1);
                let found = last(&rows).iter().zip(right).take(4);
                found.fold(0.0, |most: f64, (x, y)| most.max((x - y).abs()))
            };
            let [coarse, fine] = [4e-3, 2e-3].map(error);
            let ratio = coarse / fine;
            assert!((3.6..4.4).contains(&ratio), "{way:?}: {coarse:e} {fine:e}");
        }
    }
}

#[test]
fn a_product_that_follows_time_drives_two_slides() {
    // (1 + x)(1 + y) = 1 + 0.3 sin(w t) without gravity, from a rate of x' = 0.2; the energy balance contains the drive's work
    let bodies = [("a", 1.3, "ground", [0.8, 0.6, 0.0]), ("b", 0.7, "ground", [-0.6, 0.8, 0.0])];
    let text = slides(2, [0.0; 3], &bodies);
    let motion = mbs::Motion::<f64>::Sine { amplitude: 0.3, frequency: 0.7, phase: 0.0 };
    let of = of_joints(&[0, 1], Product).holding(1.0).driven(motion);
    let text = text + &initial("a-s", "rate = [0.2]");
    let scene = scene(&text, [of]);
    for way in WAYS {
        for (t, row) in run(&scene, way, 1e-3, 1.0, 10) {
            let needed = 1.0 + 0.3 * (core::f64::consts::TAU * 0.7 * t).sin();
            let found = (1.0 + row[0]) * (1.0 + row[2]);
            // projections are exact to rounding
            assert!((found - needed).abs() < 1e-10, "{way:?}, {t}: {found} {needed}");
            assert!((row[5] - needed).abs() < 1e-10, "{way:?}, {t}: {row:?}");
        }
    }
    crate::common::oracle::energy_balances(&scene);
    for way in WAYS.into_iter().filter(|way| way.1 == "trapezoidal") {
        agree_in_the_limit(&scene, way, (TIMES.0, TIMES.1, 200), 1e-9, |_| ());
    }
}

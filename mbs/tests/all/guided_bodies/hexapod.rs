//! Scene `hexapod`: legs and energies computed by hand from the guided platform.

use super::kinematics::{
    Matrix, Motion, Sine, Vector, add, cross_of, minus, product, rate, scaled, spin_of, times,
    transposed,
};
use super::{Rows, WAYS, off, oracle};
use crate::common::{self, dot};
use mbs::core::scene::{Inertia, Scene};

/// Signals of the scene.
const MOTION: Motion = Motion {
    translation: [Sine([0.08, 0.7, 0.0]), Sine([0.06, 0.9, 0.0]), Sine([0.05, 1.1, 0.0])],
    rotation: [Sine([0.2, 0.8, 0.0]), Sine([-0.15, 1.0, 0.0]), Sine([0.4, 0.6, 0.0])],
};

/// Guided point of the platform [m].
const AT: Vector = [0.0, 0.0, 1.2];

fn length(d: Vector) -> f64 {
    dot(d, d).sqrt()
}

/// Leg of the hexapod: its base point, its platform point, and the axis of its universal joint in the ground.
struct Leg {
    base: Vector,
    top: Vector,
    axis: Vector,
}

impl Leg {
    fn all(scene: &Scene<f64>) -> [Self; 6] {
        let joint = |name: String| {
            scene.joints.iter().find(|joint| joint.name == name).expect("it is there")
        };
        [1, 2, 3, 4, 5, 6].map(|i| {
            let base = joint(format!("base-{i}"));
            let top = joint(format!("top-{i}")).points[0];
            Self { base: base.points[0], top, axis: base.axes[0].expect("universal") }
        })
    }

    /// Vector from the base point to the present platform point.
    fn way(&self, t: f64) -> Vector {
        minus(on_platform(self.top, t), self.base)
    }

    /// Unit vectors of the leg: along it, along its second axis, and perpendicular to both. The second axis is perpendicular to the first
    /// axis and to the leg.
    fn frame(&self, way: Vector) -> Matrix {
        let u = scaled(way, 1.0 / length(way));
        let b = cross_of(self.axis, u);
        let b = scaled(b, 1.0 / length(b));
        [u, b, cross_of(u, b)]
    }

    /// Rotation of the leg from the reference configuration.
    fn rotation(&self, t: f64) -> Matrix {
        let [before, now] = [minus(self.top, self.base), self.way(t)].map(|way| self.frame(way));
        product(&transposed(&now), &before)
    }
}

/// Position of a point of the platform at a time.
fn on_platform(x: Vector, t: f64) -> Vector {
    add(AT, MOTION.place(minus(x, AT), t))
}

/// Kinetic and potential energy of a body, whose centre and rotation are functions of time [J].
fn energy(
    (scene, body): (&Scene<f64>, usize),
    center: impl Fn(f64) -> Vector,
    r: impl Fn(f64) -> Matrix,
    t: f64,
) -> f64 {
    let body = &scene.bodies[body];
    let Inertia::Spatial([xx, yy, zz, xy, yz, zx]) = body.inertia else { panic!("in space") };
    let v = rate(&center, t);
    let w = times(&transposed(&r(t)), spin_of(&r, t));
    let turning = dot(w, times(&[[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]], w));
    0.5 * body.mass * dot(v, v) + 0.5 * turning + body.mass * 9.81 * center(t)[2]
}

/// Energy of the whole hexapod [J]: the platform is the first body, then cylinder and rod of each leg.
fn total(scene: &Scene<f64>, legs: &[Leg; 6], t: f64) -> f64 {
    let center = |body: usize| scene.bodies[body].center;
    let mut sum = energy((scene, 0), |t| on_platform(center(0), t), |t| MOTION.rotation_at(t), t);
    for (leg, i) in legs.iter().zip((1..).step_by(2)) {
        let cylinder = minus(center(i), leg.base);
        let rod = minus(center(i + 1), leg.top);
        let turned = |x: Vector, t: f64| times(&leg.rotation(t), x);
        let of_cylinder = |t: f64| add(leg.base, turned(cylinder, t));
        let of_rod = |t: f64| add(on_platform(leg.top, t), turned(rod, t));
        sum += energy((scene, i), of_cylinder, |t| leg.rotation(t), t);
        sum += energy((scene, i + 1), of_rod, |t| leg.rotation(t), t);
    }
    sum
}

#[test]
fn the_legs_of_a_hexapod_are_as_long_as_between_base_and_guided_platform() {
    let scene = common::scene("hexapod");
    let legs = Leg::all(&scene);
    let mut efforts: Option<Rows> = None;
    for way in WAYS {
        let rows = oracle::rows(&scene, way, (2e-3, 1.0), 10).expect("it runs");
        let mut worst = 0.0;
        for (t, row) in &rows {
            for (leg, found) in legs.iter().zip(row) {
                let slide = length(leg.way(*t)) - length(minus(leg.top, leg.base));
                worst = common::worst(worst, (found - slide).abs());
            }
        }
        println!("{way:?}: legs within {worst:.1e} m");
        assert!(worst < 1e-12, "{way:?}: {worst:e}");
        // natural coordinates and the tree give the same force and moment
        let first = efforts.get_or_insert_with(|| rows.clone());
        let all = first.iter().zip(&rows).map(|((_, a), (_, b))| off(&b[6..12], &a[6..12]));
        let differences = all.fold(0.0, common::worst);
        println!("{way:?}: efforts within {differences:.1e}");
        assert!(differences < 1e-7, "{way:?}: {differences:e}");
    }
}

#[test]
fn the_power_of_the_guides_of_a_hexapod_is_what_its_bodies_gain_in_energy() {
    let scene = common::scene("hexapod");
    let legs = Leg::all(&scene);
    for way in WAYS {
        let rows = oracle::rows(&scene, way, (2e-3, 1.0), 50).expect("it runs");
        let mut worst = 0.0;
        for (t, row) in &rows {
            let effort = |i: usize| [row[6 + i], row[7 + i], row[8 + i]];
            let power =
                dot(effort(0), rate(|t| on_platform(AT, t), *t)) + dot(effort(3), MOTION.spin(*t));
            let [gained] = rate(|t| [total(&scene, &legs, t)], *t);
            worst = common::worst(worst, (power - gained).abs() / (1.0 + gained.abs()));
        }
        println!("{way:?}: power within {worst:.1e}");
        // difference quotients of energies of 400 J have an error of 1e-10 W
        assert!(worst < 1e-8, "{way:?}: {worst:e}");
    }
}

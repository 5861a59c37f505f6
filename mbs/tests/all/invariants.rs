//! Invariants of every motion: angular momenta, constraints after projection, the frame of reference, and memory.

use crate::common;
use crate::common::allocations;
use crate::retell;

use crate::common::{Bench, FORMULATIONS, SCENES, cross, distance, dot, scene, worst};
use crate::retell::{turn_scene, turned};
use mbs::core::natural::Affine;
use mbs::core::scene::{Dimension, Inertia, InitialTarget, Scene};

/// Ratio of the errors at a step and at half of it in a method of order 2: about 4. Terms of higher order may make it larger.
const SECOND_ORDER: core::ops::RangeFrom<f64> = 3.5..;

type Vector = [f64; 3];

/// Spatial body observed at four points: its centre, and the centre plus each axis of the reference configuration.
struct Gyro {
    points: [Affine<f64, 3>; 4],
    mass: f64,
    inertia: [f64; 6],
}

impl Gyro {
    fn new(bench: &Bench<3>, scene: &Scene<f64>) -> Self {
        let body = &scene.bodies[0];
        let Inertia::Spatial(inertia) = body.inertia else { panic!("a spatial inertia") };
        let at = |axis: Option<usize>| {
            let mut x = body.center;
            if let Some(i) = axis {
                x[i] += 1.0;
            }
            bench.point(0, x)
        };
        Self { points: [at(None), at(Some(0)), at(Some(1)), at(Some(2))], mass: body.mass, inertia }
    }

    /// Columns of the rotation matrix.
    fn axes(&self, b: &Bench<3>) -> [Vector; 3] {
        let c = b.position(&self.points[0]);
        [1, 2, 3].map(|i| sub(b.position(&self.points[i]), c))
    }

    /// Angular momentum about the centre of mass.
    fn spin(&self, b: &Bench<3>) -> Vector {
        let axes = self.axes(b);
        let v = b.velocity(&self.points[0]);
        let mut omega = [0.0; 3];
        for (i, e) in axes.iter().enumerate() {
            let rate = sub(b.velocity(&self.points[i + 1]), v);
            omega = add(omega, scale(cross(*e, rate), 0.5));
        }
        let [xx, yy, zz, xy, yz, zx] = self.inertia;
        let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
        let local = axes.map(|e| dot(e, omega));
        let [x, y, z] = rows.map(|row| dot(row, local));
        add(add(scale(axes[0], x), scale(axes[1], y)), scale(axes[2], z))
    }

    /// Angular momentum about the origin.
    fn about_origin(&self, b: &Bench<3>) -> Vector {
        let (c, v) = (b.position(&self.points[0]), b.velocity(&self.points[0]));
        add(self.spin(b), scale(cross(c, v), self.mass))
    }
}

fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn scale(a: Vector, s: f64) -> Vector {
    a.map(|x| x * s)
}

/// Largest relative deviation that is rounding, summed over a few thousand steps, and has no order [-].
const ROUNDING: f64 = 1e-10;

fn assert_second_order(case: &str, errors: [f64; 3], size: f64) {
    println!("{case}: {:.2e} {:.2e} {:.2e} (size {size:.3e})", errors[0], errors[1], errors[2]);
    for pair in errors.windows(2) {
        let is_kept = pair[0] <= ROUNDING * size && pair[1] <= ROUNDING * size;
        assert!(is_kept || SECOND_ORDER.contains(&(pair[0] / pair[1])), "{case}: {errors:?}");
    }
}

#[test]
fn spinning_top_keeps_energy_and_two_angular_momenta_to_order_2() {
    let scene = scene("spinning-top");
    for formulation in FORMULATIONS {
        let mut sizes = [0.0; 3];
        let errors = [1e-3, 5e-4, 2.5e-4].map(|step| {
            let mut bench = Bench::<3>::of_scene(&scene, formulation, step);
            let gyro = Gyro::new(&bench, &scene);
            let center = scene.bodies[0].center;
            let length = dot(center, center).sqrt();
            let momenta = |b: &Bench<3>| {
                let axis = scale(b.position(&gyro.points[0]), 1.0 / length);
                [gyro.about_origin(b)[2], dot(gyro.spin(b), axis)]
            };
            let start = momenta(&bench);
            sizes = [bench.simulation.initial_energies()[0], start[0].abs(), start[1].abs()];
            let mut off = [0.0; 3];
            bench
                .run(2.0, |b| {
                    let now = momenta(b);
                    off[0] = worst(off[0], b.energy_error());
                    off[1] = worst(off[1], (now[0] - start[0]).abs());
                    off[2] = worst(off[2], (now[1] - start[1]).abs());
                })
                .unwrap_or_else(|(t, e)| panic!("{formulation} {step}: {e} at {t}"));
            off
        });
        for (i, what) in
            ["energy", "momentum about the vertical", "momentum about the axis"].iter().enumerate()
        {
            assert_second_order(
                &format!("spinning-top {formulation} {what}"),
                errors.map(|e| e[i]),
                sizes[i],
            );
        }
    }
}

/// Time at which the free body turns over first, from Euler's equations [s].
const TURNS_AT: f64 = 2.97;
/// Error of this time [s], by the trapezoidal rule at 1e-3 s and the three digits of the reference.
const TURNS_WITHIN: f64 = 0.02;

#[test]
fn free_body_turns_over_and_keeps_its_angular_momentum_to_order_2() {
    let scene = scene("free-body");
    for formulation in FORMULATIONS {
        let mut size = 0.0;
        let errors = [1e-3, 5e-4, 2.5e-4].map(|step| {
            let mut bench = Bench::<3>::of_scene(&scene, formulation, step);
            let gyro = Gyro::new(&bench, &scene);
            let start = gyro.spin(&bench);
            size = dot(start, start).sqrt();
            let (mut off, mut turned, mut k) = (0.0, None, 0);
            bench
                .run(10.0, |b| {
                    k += 1;
                    off = worst(off, distance(gyro.spin(b), start));
                    if turned.is_none() && dot(gyro.axes(b)[1], start) < 0.0 {
                        turned = Some(f64::from(k) * step);
                    }
                })
                .unwrap_or_else(|(t, e)| panic!("{formulation} {step}: {e} at {t}"));
            println!("free-body {formulation} {step}: turns over at {turned:?}");
            assert!(turned.is_some_and(|t| (t - TURNS_AT).abs() <= TURNS_WITHIN), "{turned:?}");
            off
        });
        assert_second_order(&format!("free-body {formulation} angular momentum"), errors, size);
    }
}

/// Largest violation of positions [m] and velocities [m/s], and of accelerations relative to 1 + the largest one.
const VIOLATION: f64 = 1e-9;

#[test]
fn constraints_hold_after_projection_on_all_scenes_at_their_own_steps() {
    fn largest<const D: usize>(name: &str, formulation: &str) -> [f64; 3] {
        let scene = scene(name);
        let step = common::settings(&scene, formulation, None).step;
        let mut bench = Bench::<D>::of_scene(&scene, formulation, step);
        let mut largest = [0.0; 3];
        for _ in 0..common::steps(scene.duration, step) {
            let report = bench.step().unwrap_or_else(|e| panic!("{name} {formulation}: {e}"));
            let a = bench.simulation.state().a.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
            let [p, v, w] = report.violation;
            for (most, now) in largest.iter_mut().zip([p, v, w / (1.0 + a)]) {
                *most = worst(*most, now);
            }
        }
        largest
    }
    for name in SCENES {
        for formulation in FORMULATIONS {
            let [p, v, a] = match scene(name).dimension {
                Dimension::Planar => largest::<2>(name, formulation),
                Dimension::Spatial => largest::<3>(name, formulation),
            };
            println!(
                "{name} {formulation}: position {p:.1e}, velocity {v:.1e}, acceleration {a:.1e}"
            );
            assert!(
                p <= VIOLATION && v <= VIOLATION && a <= VIOLATION,
                "{name} {formulation}: {p:e} {v:e} {a:e}"
            );
        }
    }
}

#[test]
fn a_step_allocates_nothing() {
    fn in_steps<const D: usize>(name: &str, formulation: &str) -> u64 {
        let mut bench = Bench::<D>::new(name, formulation, 1e-3);
        let before = allocations::count();
        for _ in 0..200 {
            bench.step().unwrap();
        }
        allocations::count() - before
    }
    for formulation in ["index-3", "index-1", "classical", "recursive"] {
        assert_eq!(in_steps::<2>("guided-four-bar", formulation), 0, "planar with guide");
        assert_eq!(in_steps::<2>("two-four-bars", formulation), 0, "planar");
        // the classical Lagrangian refuses redundant joints
        if formulation != "classical" {
            assert_eq!(in_steps::<3>("spatial-four-bar", formulation), 0, "spatial");
        }
        for name in ["planetary-gear", "cam-follower", "crane", "geared-arm"] {
            assert_eq!(in_steps::<2>(name, formulation), 0, "{name} by {formulation}");
        }
        for name in ["servo-arm", "rolling-disc", "hexapod"] {
            assert_eq!(in_steps::<3>(name, formulation), 0, "{name} by {formulation}");
        }
    }
    let counted = allocations::count();
    drop(std::hint::black_box(Box::new(1)));
    assert_eq!(allocations::count(), counted + 1, "the allocator counts");
}

/// How far two descriptions of one mechanism may differ after half a second [m]: the rounding of a start of order one, with a margin for its
/// growth in the motion.
const RETOLD: f64 = 1e-9;
const RETOLD_STEP: f64 = 1e-3;
const RETOLD_DURATION: f64 = 0.5;

/// Runs both scenes and returns the largest distance of a body's point between them. The point of the first scene is rotated by `turn`.
fn apart(
    (original, retold): (&Scene<f64>, &Scene<f64>),
    bodies: [usize; 2],
    turn: impl Fn(Vector) -> Vector,
    formulation: &str,
) -> f64 {
    let mut first = Bench::<3>::of_scene(original, formulation, RETOLD_STEP);
    let mut second = Bench::<3>::of_scene(retold, formulation, RETOLD_STEP);
    let at = add(original.bodies[bodies[0]].center, [0.1, -0.2, 0.15]);
    let points = [first.point(bodies[0], at), second.point(bodies[1], turn(at))];
    let mut off = 0.0;
    for _ in 0..common::steps(RETOLD_DURATION, RETOLD_STEP) {
        first.step().expect("the motion is regular");
        second.step().expect("the motion is regular");
        off = worst(off, distance(turn(first.position(&points[0])), second.position(&points[1])));
    }
    off
}

const SPATIAL: [&str; 4] = ["spinning-top", "spatial-four-bar", "spatial-chain-20", "rolling-disc"];

#[test]
fn turning_a_whole_scene_changes_the_motion_only_by_rounding() {
    for name in SPATIAL {
        for formulation in FORMULATIONS {
            let scene = scene(name);
            let off = apart((&scene, &turn_scene(&scene)), [0, 0], turned, formulation);
            println!("{name} {formulation} turned: {off:.1e} m");
            assert!(off <= RETOLD, "{name} {formulation}: {off:e}");
        }
    }
}

#[test]
fn reordering_bodies_changes_the_motion_only_by_rounding() {
    for name in SPATIAL {
        for formulation in FORMULATIONS {
            let scene = scene(name);
            let n = scene.bodies.len();
            let other = retell::reorder(&scene);
            let off = apart((&scene, &other), [0, n - 1], |x| x, formulation);
            println!("{name} {formulation} reordered: {off:.1e} m");
            assert!(off <= RETOLD, "{name} {formulation}: {off:e}");
        }
    }
}

#[test]
fn reversing_the_bodies_of_joints_changes_the_motion_only_by_rounding() {
    for name in SPATIAL {
        for formulation in FORMULATIONS {
            let scene = scene(name);
            let mut other = scene.clone();
            for joint in &mut other.joints {
                joint.bodies.reverse();
                joint.points.reverse();
            }
            // with exchanged bodies, values and rates change their sign
            for initial in &mut other.initials {
                if let InitialTarget::Joint { value, rate, .. } = &mut initial.target {
                    [value, rate].into_iter().flatten().flatten().for_each(|x| *x = -*x);
                }
            }
            other.outputs.clear();
            let off = apart((&scene, &other), [0, 0], |x| x, formulation);
            println!("{name} {formulation} reversed: {off:.1e} m");
            assert!(off <= RETOLD, "{name} {formulation}: {off:e}");
        }
    }
}

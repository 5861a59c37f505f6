//! Every kind of effect in natural coordinates: power, tangents compared with central differences, action and reaction.

mod friction;
mod limit;
mod speed_hold;

use crate::codes;
use mbs_core::Cliques;
use mbs_core::algebra::{Vector, cross, rotation};
use mbs_core::effects::ActsOn;
use mbs_core::model::{Load, Model, ScalarForce, State, Tangent, Terms};
use mbs_core::natural::NaturalModel;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{
    Dimension, EffectKind, Friction, LawOnJoint, Limit, RoadFeature, Scene, Tire,
};
use mbs_testkit::effects::{bushing, every, tire, with};
use mbs_testkit::{Random, close, dot, matrix, model, plus, residual};

type V = Vector<f64, 3>;

/// Step of central differences. The rounding error is 1e-16 of 1e2 N, divided by the step. The truncation error is the square of
/// the step times third derivatives of order 1e3.
const STEP: f64 = 1e-5;
const DIFFERENCE: f64 = 2e-6;
/// Allowed error: rounding in sums of some tens of products, whose numbers are of order a hundred.
const ROUNDING: f64 = 1e-11;

/// Model with a state and its terms.
struct At<const D: usize> {
    model: NaturalModel<f64, D>,
    motions: Vec<RigidMotion<f64>>,
    state: State<f64>,
    terms: Terms<f64>,
}

impl<const D: usize> At<D> {
    /// Places bodies at random, with random velocities of a given size.
    fn new(scene: &Scene<f64>, seed: u64, [spread, speed]: [f64; 2]) -> Self {
        let model = model::<D>(scene);
        let mut random = Random(seed);
        let mut draw = |size: f64| vector::<D>(&mut random, size);
        let motions = scene.bodies.iter().map(|body| {
            let origin = V::from(body.center);
            let mut motion = RigidMotion::at_rest(origin);
            (motion.position, motion.velocity) = (origin + draw(spread), draw(speed));
            let (turn, omega) = (draw(2.0 * spread), draw(speed));
            motion.rotation = rotation(&axial::<D>(&turn));
            motion.omega = axial::<D>(&omega);
            motion
        });
        let motions: Vec<_> = motions.collect();
        let mut state = State::at_rest(&model);
        state.t = 0.4;
        model.write_motions(&motions, &mut state);
        let terms = model.terms();
        let mut at = Self { model, motions, state, terms };
        at.evaluate();
        at
    }

    fn evaluate(&mut self) {
        let State { t, q, v, .. } = &self.state;
        self.model.set_inputs(*t, &self.state, &mut self.terms);
        self.model.evaluate(q, &mut self.terms);
        self.model.evaluate_forces(q, v, &mut self.terms);
    }

    /// Central difference (g(STEP) - g(-STEP)) / 2 STEP, where `moved` changes the state by its argument.
    fn difference(
        &mut self,
        moved: impl Fn(&mut State<f64>, f64),
        g: impl Fn(&Self) -> Vec<f64>,
    ) -> Vec<f64> {
        let state = self.state.clone();
        let mut side = |h: f64| {
            moved(&mut self.state, h);
            self.evaluate();
            let value = g(self);
            self.state.copy_from(&state);
            value
        };
        let (before, after) = (side(-STEP), side(STEP));
        self.evaluate();
        after.iter().zip(before).map(|(a, b)| (a - b) / (2.0 * STEP)).collect()
    }

    /// Negative generalised forces of the effects, -Q.
    fn minus_force(&self) -> Vec<f64> {
        let load = Load { mass: None, multipliers: None, force: 1.0 };
        residual(&self.model, &self.terms, &load)
    }

    /// Velocities for which all bodies move as one rigid body: `velocity` at the origin, angular velocity `omega`.
    fn carried(&self, velocity: V, omega: V) -> Vec<f64> {
        let mut motions = self.motions.clone();
        for motion in &mut motions {
            motion.omega = omega;
            motion.velocity = velocity + cross(&omega, &motion.position);
        }
        let mut state = self.state.clone();
        self.model.write_motions(&motions, &mut state);
        state.v
    }

    /// Tangent of the forces for the factors of stiffness and damping: K or C.
    fn tangent(&self, [stiffness, damping]: [f64; 2]) -> Vec<Vec<f64>> {
        let zero = vec![0.0; self.model.n_constraints()];
        let block = |stiffness, damping| {
            let tangent = Tangent { stiffness, damping, penalty: &zero, geometric: None };
            matrix(&self.model, &self.terms, &tangent)
        };
        let (with, without) = (block(stiffness, damping), block(0.0, 0.0));
        with.iter().zip(without).map(|(a, b)| plus(a, -1.0, &b)).collect()
    }
}

/// Random vector of the plane or of space.
fn vector<const D: usize>(random: &mut Random, size: f64) -> V {
    V::from_fn(|i, _| if i < D { size * random.next() } else { 0.0 })
}

/// Rotation axis from a vector: along z in the plane.
fn axial<const D: usize>(x: &V) -> V {
    if D == 2 { V::new(0.0, 0.0, x[0]) } else { *x }
}

/// Every kind of effect, and user-defined laws in code.
fn tried(dimension: Dimension) -> impl Iterator<Item = (&'static str, EffectKind<f64>)> {
    every(dimension).into_iter().chain(codes::every(dimension))
}

/// Calls `$check::<D>(what, kind, scene)` for every effect in the plane and in space.
macro_rules! for_every_effect {
    ($check:ident) => {
        for (what, kind) in tried(Dimension::Planar) {
            $check::<2>(what, &kind, &with(Dimension::Planar, kind.clone()));
        }
        for (what, kind) in tried(Dimension::Spatial) {
            $check::<3>(what, &kind, &with(Dimension::Spatial, kind.clone()));
        }
    };
}

#[test]
fn forces_do_the_work_that_energy_and_power_tell() {
    fn check<const D: usize>(what: &str, _: &EffectKind<f64>, scene: &Scene<f64>) {
        for seed in 1..5 {
            let mut at = At::<D>::new(scene, seed, [0.1, 1.0]);
            let v = at.state.v.clone();
            let power = at.model.power(&at.state.q, &v, &[], &at.terms);
            // energy balance: -Q.v = dV/dt - power
            let along = |state: &mut State<f64>, h| {
                state.q = plus(&state.q, h, &v);
                state.t += h;
            };
            let rate =
                at.difference(along, |at| vec![at.model.potential_energy(&at.state.q, &at.terms)]);
            let f = at.minus_force();
            let (work, told) = (dot(&f, &v[..f.len()]), rate[0] - power);
            assert!((work - told).abs() < 1e-5, "{what}, {D}: {work} W, told {told} W");
        }
    }
    for_every_effect!(check);
}

#[test]
fn tangents_of_laws_are_the_derivatives_of_their_tensions() {
    fn check<const D: usize>(what: &str, kind: &EffectKind<f64>, scene: &Scene<f64>) {
        // The load of a tire changes its other forces, and the tangent omits this. The value of a tire is its depth, whose sign is
        // opposite to that of the distance.
        let sign = match kind {
            EffectKind::Tire(Tire { rolling_resistance, .. }) if *rolling_resistance > 0.0 => {
                return;
            }
            EffectKind::Tire(_) => -1.0,
            _ => 1.0,
        };
        for seed in 1..5 {
            let mut at = At::<D>::new(scene, seed, [0.1, 1.0]);
            let (n, all) = (at.model.n_unknowns(), at.state.q.len());
            let random = &mut Random(seed + 100);
            let [dq, dv] = [0, 1].map(|_| random.vector(n, all, 1.0));
            let moved = |state: &mut State<f64>, h| {
                state.q = plus(&state.q, h, &dq);
                state.v = plus(&state.v, h, &dv);
            };
            let told = at.terms.measures.clone();
            let of = |part: fn(&ScalarForce<f64>) -> f64| {
                move |at: &At<D>| at.terms.measures.iter().map(part).collect::<Vec<f64>>()
            };
            let tension = at.difference(moved, of(|m| m.tension));
            let value = at.difference(moved, of(|m| m.value));
            let rate = at.difference(moved, of(|m| m.rate));
            for (k, m) in told.iter().enumerate() {
                let by_law = sign * m.stiffness * value[k] + m.damping * rate[k];
                let apart = (tension[k] - by_law).abs();
                assert!(apart < 1e-5 * (1.0 + by_law.abs()), "{what}, {D}: {m:?}, {by_law}");
            }
        }
    }
    for_every_effect!(check);
}

#[test]
fn damping_is_the_derivative_of_forces_by_velocity() {
    fn check<const D: usize>(what: &str, kind: &EffectKind<f64>, scene: &Scene<f64>) {
        let mut at = At::<D>::new(scene, 7, [0.1, 1.0]);
        let damping = at.tangent([0.0, 1.0]);
        let v = at.state.v.clone();
        match kind {
            // Drag has a tangent along its velocity only.
            EffectKind::AeroDrag(_) => {
                let by_size = |state: &mut State<f64>, h| state.v = plus(&v, h, &v);
                let difference = at.difference(by_size, At::minus_force);
                let told: Vec<f64> = damping.iter().map(|row| dot(row, &v[..row.len()])).collect();
                close(what, &told, &difference, DIFFERENCE);
            }
            EffectKind::Tire(Tire { rolling_resistance, .. }) if *rolling_resistance > 0.0 => {}
            // A law on a body has no tangent.
            EffectKind::LawOnBody(_) => {}
            _ => {
                for (i, told) in damping.iter().enumerate() {
                    let difference = at.difference(|s, h| s.v[i] += h, At::minus_force);
                    close(&format!("{what}, {D}, column {i}"), told, &difference, DIFFERENCE);
                }
            }
        }
    }
    for_every_effect!(check);
}

#[test]
fn a_wheel_is_damped_along_and_across_its_plane_as_its_forces_change() {
    fn check<const D: usize>(dimension: Dimension) {
        let mut scene = with(dimension, tire(dimension, true));
        scene.road.left = vec![RoadFeature::Flat { height: 0.5 }];
        scene.road.right = scene.road.left.clone();
        for seed in 1..5 {
            // A small slip, for which the side force is linear.
            let mut at = At::<D>::new(&scene, seed, [0.02, 0.03]);
            let normal = V::from_fn(|i, _| f64::from(u8::from(i == D - 1)));
            let axis = if D == 2 {
                V::new(0.0, 0.0, 1.0)
            } else {
                at.motions[2].rotation * V::new(0.05, 1.0, 0.1)
            };
            let across = (axis - normal * axis.dot(&normal)).normalize();
            let damping = at.tangent([0.0, 1.0]);
            let directions = if D == 2 { vec![] } else { vec![across] };
            for direction in directions.into_iter().chain([cross(&across, &normal)]) {
                let w = at.carried(direction, V::zeros());
                let moved = |state: &mut State<f64>, h| state.v = plus(&state.v, h, &w);
                let change = at.difference(moved, At::minus_force);
                let w = &w[..change.len()];
                let told: f64 = damping.iter().zip(w).map(|(row, x)| x * dot(row, w)).sum();
                let found = dot(&change, w);
                assert!((told - found).abs() < 1e-5 * (1.0 + found.abs()), "{D}: {told} {found}");
                assert!(found > 0.0, "{D}: {found}");
            }
        }
    }
    check::<2>(Dimension::Planar);
    check::<3>(Dimension::Spatial);
}

#[test]
fn stiffness_is_the_derivative_of_forces_by_position() {
    fn check<const D: usize>(what: &str, scene: &Scene<f64>, spread: f64) {
        let mut at = At::<D>::new(scene, 9, [spread, 0.0]);
        let stiffness = at.tangent([1.0, 0.0]);
        assert!(stiffness.iter().flatten().any(|k| k.abs() > 1.0), "{what}");
        for (i, told) in stiffness.iter().enumerate() {
            let difference = at.difference(|s, h| s.q[i] += h, At::minus_force);
            close(&format!("{what}, {D}, column {i}"), told, &difference, DIFFERENCE);
        }
    }
    fn all<const D: usize>(dimension: Dimension) {
        // A spring under tension, whose line rotates.
        let (what, spring) = every(dimension).swap_remove(1);
        check::<D>(what, &with(dimension, spring), 0.05);
        // A bushing without tension, because the tangent omits the effect of the rotation of its axes.
        check::<D>("bushing", &with(dimension, bushing(dimension, 0.0)), 0.0);
        // A wheel that does not lean, on level ground, where the normal does not rotate. The tangent omits the rotation of a
        // leaning axis, as it does for the axes of a bushing.
        let mut wheel = tire(dimension, false);
        if let EffectKind::Tire(Tire { axis, .. }) = &mut wheel {
            *axis = None;
        }
        let mut scene = with(dimension, wheel);
        scene.road.left = vec![RoadFeature::Flat { height: 0.5 }];
        scene.road.right = scene.road.left.clone();
        check::<D>("tire", &scene, 0.02);
    }
    all::<2>(Dimension::Planar);
    all::<3>(Dimension::Spatial);
}

#[test]
fn what_acts_between_two_bodies_does_no_work_when_they_move_as_one() {
    fn check<const D: usize>(what: &str, kind: &EffectKind<f64>, scene: &Scene<f64>) {
        let mut scene = scene.clone();
        scene.gravity = None;
        for seed in 1..5 {
            let at = At::<D>::new(&scene, seed, [0.2, 1.0]);
            let random = &mut Random(seed + 200);
            let (velocity, omega) = match kind {
                // a term of the sum is a joint to the ground
                _ if kind.acts_on() == ActsOn::Sum => continue,
                EffectKind::AeroDrag(_)
                | EffectKind::SpeedHold(_)
                | EffectKind::Tire(_)
                | EffectKind::LawOnBody(_) => continue,
                EffectKind::Limit(Limit { joint, .. })
                | EffectKind::Friction(Friction { joint, .. })
                | EffectKind::LawOnJoint(LawOnJoint { joint, .. })
                    if joint.index() == 0 =>
                {
                    continue;
                }
                // The arm rotates about its hinge only.
                EffectKind::Limit(_) | EffectKind::Friction(_) | EffectKind::LawOnJoint(_) => {
                    let hinge = &scene.joints[0];
                    let omega = V::from(hinge.axes[0].unwrap_or([0.0, 0.0, 1.0]));
                    (-cross(&omega, &V::from(hinge.points[0])), omega)
                }
                _ => {
                    let (velocity, omega) = (vector::<D>(random, 1.0), vector::<D>(random, 1.0));
                    (velocity, axial::<D>(&omega))
                }
            };
            let v = at.carried(velocity, omega);
            let f = at.minus_force();
            let work = dot(&f, &v[..f.len()]);
            assert!(work.abs() < ROUNDING * (1.0 + dot(&f, &f).sqrt()), "{what}, {D}: {work} W");
        }
    }
    for_every_effect!(check);
}

/// Solvers skip an element that reports no block. Its block must be zero for all weights.
#[test]
fn elements_without_a_block_would_write_zeros() {
    fn check<const D: usize>(what: &str, _: &EffectKind<f64>, scene: &Scene<f64>) {
        let at = At::<D>::new(scene, 7, [0.2, 1.0]);
        let m = at.model.n_constraints();
        let (rows, lambda) = (vec![3.0; m], vec![2.0; m]);
        let mut n_silent = 0;
        for (penalty, geometric) in
            [(&rows[..], None), (&[], None), (&[], Some(&lambda[..])), (&rows, Some(&lambda))]
        {
            for [stiffness, damping] in [[0.0, 0.0], [0.7, 0.0], [0.0, 0.3], [0.7, 0.3]] {
                let tangent = Tangent { stiffness, damping, penalty, geometric };
                for e in 0..at.model.n_elements() {
                    if at.model.has_block(&at.terms, &tangent, e) {
                        continue;
                    }
                    let k = at.model.clique(e).len();
                    let mut block = vec![f64::NAN; k * (k + 1) / 2];
                    at.model.write_block(&at.terms, &tangent, e, &mut block);
                    assert!(block.iter().all(|x| *x == 0.0), "{what}, {D}, element {e}: {block:?}");
                    n_silent += 1;
                }
            }
        }
        // Without weights no effect is in the matrix, so that these scenes have elements without a block.
        assert!(n_silent > 0, "{what}, {D}");
    }
    for_every_effect!(check);
}

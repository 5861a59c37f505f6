//! Energies, forces and rank of whole models, compared with mechanics written down directly.

use mbs_core::Cliques;
use mbs_core::model::{Load, Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{
    BodyId, BodyTorque, EffectKind, Force, Inertia, JointTorque, Scene, Signal, SpringDamper,
    TorsionSpring,
};
use mbs_core::start::constraint_rank;
use mbs_testkit::{
    PLANAR, Random, SPATIAL, close, dot, in_null_space, jacobian, model, plus, reference, residual,
    scene,
};

type V = [f64; 3];

/// Allowed error: rounding in sums of some tens of products, whose numbers are of order ten. They are projected on the null space.
const ROUNDING: f64 = 1e-10;

fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn three<const D: usize>(x: &[f64]) -> V {
    std::array::from_fn(|i| if i < D { x[i] } else { 0.0 })
}

/// Velocities of material points and angular velocities of bodies, from the rates of points and directions.
struct Field<'a, const D: usize> {
    model: &'a NaturalModel<f64, D>,
    q: &'a [f64],
    v: &'a [f64],
}

impl<const D: usize> Field<'_, D> {
    fn point(&self, body: BodyId, at: V) -> V {
        three::<D>(self.model.point(body, at).rate(self.v).as_slice())
    }
    fn place(&self, body: BodyId, at: V) -> V {
        three::<D>(self.model.point(body, at).value(self.q).as_slice())
    }
    fn direction(&self, body: BodyId, d: V) -> (V, V) {
        let u = self.model.direction(body, d);
        (three::<D>(u.value(self.q).as_slice()), three::<D>(u.rate(self.v).as_slice()))
    }
    /// Angular velocity w = 1/2 sum u x u' over three orthonormal directions u.
    fn spin(&self, body: BodyId) -> V {
        if D == 2 {
            let (u, w) = self.direction(body, [1.0, 0.0, 0.0]);
            return cross(u, w);
        }
        let mut spin = [0.0; 3];
        for i in 0..3 {
            let e = std::array::from_fn(|k| f64::from(u8::from(k == i)));
            let (u, w) = self.direction(body, e);
            let part = cross(u, w);
            (0..3).for_each(|k| spin[k] += 0.5 * part[k]);
        }
        spin
    }
}

/// Random velocity in the reference configuration that the constraints allow, with guides at rest.
fn admissible<const D: usize>(
    model: &NaturalModel<f64, D>,
    random: &mut Random,
) -> (Vec<f64>, Vec<f64>) {
    let mut terms = model.terms();
    let q = reference(model);
    model.set_inputs(0.0, &State::at_rest(model), &mut terms);
    model.evaluate(&q, &mut terms);
    close("phi", &terms.phi, &vec![0.0; terms.phi.len()], 1e-14);
    let v = random.vector(model.n_unknowns(), model.n_extended(), 1.0);
    let v = in_null_space(&jacobian(model, &terms), &v);
    assert!(dot(&v, &v) > 0.1, "some motion is left");
    (q, v)
}

/// Kinetic energy 1/2 m v.v + 1/2 w.I w, summed over bodies. For a rod it follows from the velocities of its ends.
fn kinetic_energy<const D: usize>(scene: &Scene<f64>, field: &Field<'_, D>) -> f64 {
    let mut energy = 0.0;
    for (i, body) in scene.bodies.iter().enumerate() {
        let me = BodyId::Body(i);
        let v = field.point(me, body.center);
        match body.inertia {
            Inertia::Point => energy += 0.5 * body.mass * dot(&v, &v),
            Inertia::Rod { from, to } => {
                let (a, b) = (field.point(me, from), field.point(me, to));
                energy += body.mass / 6.0 * (dot(&a, &a) + dot(&a, &b) + dot(&b, &b));
            }
            Inertia::Planar(moment) => {
                let w = field.spin(me)[2];
                energy += 0.5 * (body.mass * dot(&v, &v) + moment * w * w);
            }
            Inertia::Spatial([xx, yy, zz, xy, yz, zx]) => {
                let w = field.spin(me);
                let h = [
                    xx * w[0] + xy * w[1] + zx * w[2],
                    xy * w[0] + yy * w[1] + yz * w[2],
                    zx * w[0] + yz * w[1] + zz * w[2],
                ];
                energy += 0.5 * (body.mass * dot(&v, &v) + dot(&w, &h));
            }
        }
    }
    energy
}

fn check_kinetic<const D: usize>(text: &str) {
    // The guides are removed, so that their joints move too.
    let mut scene = scene(text);
    scene.guides.clear();
    let model = model::<D>(&scene);
    for seed in 1..6 {
        let (q, v) = admissible(&model, &mut Random(seed));
        let field = Field { model: &model, q: &q, v: &v };
        let (expected, found) = (kinetic_energy(&scene, &field), model.kinetic_energy(&v));
        assert!((expected - found).abs() < ROUNDING * expected, "{found} against {expected}");
    }
}

#[test]
fn kinetic_energy_is_that_of_rigid_bodies_planar() {
    check_kinetic::<2>(PLANAR);
}

#[test]
fn kinetic_energy_is_that_of_rigid_bodies_rods_and_welded_clusters_spatial() {
    check_kinetic::<3>(SPATIAL);
}

/// Scenes of free bodies, which share no entities: every basis has the body's own entities.
const LOOSE: [&str; 2] = [
    "[scene]\nname = \"loose\"\ndimension = 2\ngravity = [1.0, -9.81]\nduration = 1.0\n[[body]]\nname = \"x\"\nmass = 2.0\ncenter = [3.0, -1.0]\ninertia = 0.7\n[[body]]\nname = \"r\"\nmass = 2.0\nrod = { from = [1.0, 2.0], to = [4.0, 3.0] }",
    "[scene]\nname = \"loose\"\ndimension = 3\ngravity = [1.0, 0.5, -9.81]\nduration = 1.0\n[[body]]\nname = \"x\"\nmass = 2.0\ncenter = [3.0, -1.0, 2.0]\ninertia = [0.7, 0.8, 0.9, 0.1, 0.05, -0.02]\n[[body]]\nname = \"r\"\nmass = 2.0\nrod = { from = [1.0, 2.0, 0.0], to = [4.0, 3.0, -1.0] }",
];

#[test]
fn kinetic_energy_is_that_of_rigid_bodies_without_joints() {
    check_kinetic::<2>(LOOSE[0]);
    check_kinetic::<3>(LOOSE[1]);
}

fn check_points<const D: usize>(text: &str) {
    let scene = scene(text);
    let model = model::<D>(&scene);
    let q = reference(&model);
    let v = vec![0.0; q.len()];
    let field = Field { model: &model, q: &q, v: &v };
    for (i, body) in scene.bodies.iter().enumerate() {
        let me = BodyId::Body(i);
        // A rod held by ball joints has points on its line only.
        let points = if model.has_full_rotation(me) {
            vec![body.center, std::array::from_fn(|k| if k < D { 0.7 + k as f64 } else { 0.0 })]
        } else {
            vec![body.center]
        };
        for at in points {
            close(&body.name, &field.place(me, at), &at, 1e-13);
        }
    }
}

#[test]
fn every_point_of_every_body_is_where_the_scene_says_in_the_reference_configuration() {
    check_points::<2>(PLANAR);
    check_points::<3>(SPATIAL);
    check_points::<2>(LOOSE[0]);
    check_points::<3>(LOOSE[1]);
}

/// Power of all applied forces, from the laws as the scene format defines them.
fn power<const D: usize>(scene: &Scene<f64>, field: &Field<'_, D>) -> f64 {
    let at_start = |course: &Signal<f64>| match course {
        Signal::Constant(f) | Signal::Input(f) => *f,
        Signal::Table(rows) => rows[0].1,
        Signal::Named(_) => panic!("the scene has no signals"),
    };
    let mut power = 0.0;
    for (i, body) in scene.bodies.iter().enumerate() {
        let g = scene.gravity.unwrap_or_default();
        power += body.mass * dot(&g, &field.point(BodyId::Body(i), body.center));
    }
    for effect in &scene.effects {
        power += match &effect.kind {
            EffectKind::SpringDamper(SpringDamper {
                bodies,
                points,
                stiffness,
                damping,
                free_length,
            }) => {
                let d = plus(
                    &field.place(bodies[1], points[1]),
                    -1.0,
                    &field.place(bodies[0], points[0]),
                );
                let w = plus(
                    &field.point(bodies[1], points[1]),
                    -1.0,
                    &field.point(bodies[0], points[0]),
                );
                let length = dot(&d, &d).sqrt();
                let rate = dot(&d, &w) / length;
                -(stiffness * (length - free_length) + damping * rate) * rate
            }
            EffectKind::TorsionSpring(TorsionSpring {
                joint,
                damping,
                free_value,
                stiffness,
                ..
            }) => {
                let rate = joint_rate(scene, field, joint.index());
                -(stiffness * (0.0 - free_value) + damping * rate) * rate
            }
            EffectKind::JointTorque(JointTorque { joint, course, .. }) => {
                at_start(course)[0] * joint_rate(scene, field, joint.index())
            }
            EffectKind::Force(Force { body, at, course, .. }) => {
                dot(&at_start(course), &field.point(*body, *at))
            }
            EffectKind::BodyTorque(BodyTorque { body, course }) => {
                let (tau, w) = (at_start(course), field.spin(*body));
                if D == 2 { tau[0] * w[2] } else { dot(&tau, &w) }
            }
            other => unreachable!("the scenes of these tests have no {other:?}"),
        };
    }
    power
}

/// Relative angular velocity about a joint's axis.
fn joint_rate<const D: usize>(scene: &Scene<f64>, field: &Field<'_, D>, joint: usize) -> f64 {
    let joint = &scene.joints[joint];
    let axis = joint.axes[0].unwrap_or([0.0, 0.0, 1.0]);
    let spin = |body| if body == BodyId::Ground { [0.0; 3] } else { field.spin(body) };
    let w = plus(&spin(joint.bodies[1]), -1.0, &spin(joint.bodies[0]));
    dot(&w, &axis) / dot(&axis, &axis).sqrt()
}

fn check_power<const D: usize>(text: &str) {
    let mut scene = scene(text);
    scene.guides.clear();
    let model = model::<D>(&scene);
    for seed in 1..6 {
        let (q, v) = admissible(&model, &mut Random(seed));
        let mut terms = model.terms();
        model.set_inputs(0.0, &State::at_rest(&model), &mut terms);
        model.evaluate(&q, &mut terms);
        model.evaluate_forces(&q, &v, &mut terms);
        let load = Load { mass: None, multipliers: None, force: 1.0 };
        let f = residual(&model, &terms, &load);
        let found = -dot(&f, &v[..f.len()]);
        let expected = power(&scene, &Field { model: &model, q: &q, v: &v });
        assert!((expected - found).abs() < ROUNDING * 100.0, "{found} against {expected}");
    }
}

#[test]
fn forces_do_the_work_of_gravity_springs_dampers_forces_and_torques_planar() {
    check_power::<2>(PLANAR);
}

#[test]
fn forces_do_the_work_of_gravity_springs_dampers_forces_and_torques_spatial() {
    check_power::<3>(SPATIAL);
}

#[test]
fn potential_energy_of_gravity_is_weight_times_height() {
    let scene = scene(LOOSE[1]);
    let model = model::<3>(&scene);
    let q = reference(&model);
    let expected: f64 = scene
        .bodies
        .iter()
        .map(|b| -b.mass * dot(&scene.gravity.unwrap_or_default(), &b.center))
        .sum();
    let found = model.potential_energy(&q, &model.terms());
    assert!((found - expected).abs() < 1e-12 * expected.abs(), "{found} against {expected}");
}

fn rank<const D: usize>(scene: &Scene<f64>) -> (usize, usize, usize) {
    let model = model::<D>(scene);
    let mut terms = model.terms();
    model.set_inputs(0.0, &State::at_rest(&model), &mut terms);
    model.evaluate(&reference(&model), &mut terms);
    let rank = constraint_rank(&model, &terms);
    (model.n_unknowns(), model.n_constraints(), rank)
}

#[test]
fn planar_and_spatial_four_bars_have_one_freedom_however_redundant() {
    let mut planar = scene(include_str!("../../../scenes/guided-four-bar.toml"));
    let (n, m, r) = rank::<2>(&planar);
    assert_eq!((n - r, m - r), (0, 0), "guided");
    planar.guides.clear();
    let (n, m, r) = rank::<2>(&planar);
    assert_eq!((n - r, m - r), (1, 0));
    let mut spatial = scene(include_str!("../../../scenes/spatial-four-bar.toml"));
    let (n, _, r) = rank::<3>(&spatial);
    assert_eq!(n - r, 1);
    // A second equal joint adds no rows. A second hinge on the same axis adds only redundant rows.
    for shift in [0.0, 0.1] {
        let mut again = spatial.joints[1].clone();
        again.name = format!("again-{shift}");
        let axis = again.axes[0].unwrap_or_default();
        for p in &mut again.points {
            (0..3).for_each(|k| p[k] += shift * axis[k]);
        }
        spatial.joints.push(again);
        let (n, _, r) = rank::<3>(&spatial);
        assert_eq!(n - r, 1, "shifted by {shift}");
    }
}

/// Scene with `n` independent copies of a scene, at the same places.
fn copies(one: &Scene<f64>, n: usize) -> Scene<f64> {
    let mut many = one.clone();
    for k in 1..n {
        let shift = |body| match body {
            BodyId::Ground => BodyId::Ground,
            BodyId::Body(b) => BodyId::Body(b + k * one.bodies.len()),
        };
        many.bodies.extend(one.bodies.iter().cloned());
        many.joints.extend(one.joints.iter().cloned().map(|mut joint| {
            joint.bodies = joint.bodies.map(shift);
            joint
        }));
    }
    many
}

#[test]
fn the_rank_of_many_redundant_loops_is_that_of_one_as_often() {
    let mut one = scene(include_str!("../../../scenes/spatial-four-bar.toml"));
    one.initials.clear();
    one.outputs.clear();
    let (n, m, r) = rank::<3>(&one);
    assert!(r < m);
    // The Jacobian of sixty copies is too large for dense elimination.
    assert_eq!(rank::<3>(&copies(&one, 60)), (60 * n, 60 * m, 60 * r));
}

#[test]
fn degrees_of_freedom_are_those_of_the_joints() {
    let kinds = [
        ("revolute", "axis = [0.0, 1.0, 0.2]", 1),
        ("spherical", "", 3),
        ("universal", "axes = [[1.0, 0.0, 0.0], [0.2, 1.0, 0.0]]", 2),
        ("prismatic", "axis = [0.0, 1.0, 0.2]", 1),
        ("cylindrical", "axis = [0.0, 1.0, 0.2]", 2),
        ("planar", "axis = [0.0, 1.0, 0.2]\ndirection = [1.0, 0.0, 0.0]", 3),
        ("free", "", 6),
        ("weld", "", 0),
    ];
    for (kind, axes, dof) in kinds {
        for first in ["ground", "base"] {
            let text = format!(
                "[scene]\nname = \"{kind}\"\ndimension = 3\nduration = 1.0\n[[body]]\nname = \"x\"\nmass = 1.0\ncenter = [0.4, 0.3, 0.2]\ninertia = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0]\n[[body]]\nname = \"base\"\nmass = 1.0\ncenter = [0.0, -0.3, 0.2]\ninertia = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0]\n[[joint]]\nname = \"j\"\nkind = \"{kind}\"\nbodies = [\"{first}\", \"x\"]\nat = [0.1, 0.2, 0.3]\n{axes}\n"
            );
            let (n, m, r) = rank::<3>(&scene(&text));
            assert_eq!((n - r, m - r), (dof + 6, 0), "{kind} on {first}");
        }
    }
}

#[test]
fn the_elements_of_a_hub_stay_small_however_many_joints_it_has() {
    let mut text = String::from(
        "[scene]\nname = \"hub\"\ndimension = 2\nduration = 1.0\n[[body]]\nname = \"hub\"\nmass = 1.0\ncenter = [0.0, 0.0]\ninertia = 0.5\n",
    );
    for i in 0..200 {
        let (y, x) = (0.03 * f64::from(i)).sin_cos();
        text += &format!(
            "[[body]]\nname = \"b{i}\"\nmass = 1.0\ncenter = [{:?}, {:?}]\ninertia = 0.1\n[[joint]]\nname = \"j{i}\"\nkind = \"revolute\"\nbodies = [\"hub\", \"b{i}\"]\nat = [{x:?}, {y:?}]\n",
            1.5 * x,
            1.5 * y
        );
    }
    let scene = scene(&text);
    let model = model::<2>(&scene);
    let widest = (0..model.n_elements()).map(|e| model.clique(e).len()).max();
    assert_eq!(widest, Some(8), "two basis points and two that depend on them");
    let (n, m, r) = rank::<2>(&scene);
    assert_eq!((n - r, m - r), (203, 0));
}

/// The effects of a chain are stored next to their bodies. The remembered angle of each is found, whatever the order of the
/// effects.
#[test]
fn remembered_angles_are_found_where_effects_act_along_a_chain() {
    let mut text = String::from("[scene]\nname = \"chain\"\ndimension = 2\nduration = 1.0\n");
    for i in 0..9 {
        text += &format!(
            "[[body]]\nname = \"rod-{i}\"\nrod = {{ from = [{i}.0, 0.0], to = [{}.0, 0.0] }}\nmass = 1.0\n",
            i + 1
        );
    }
    for i in 0..9 {
        let before = if i == 0 { "ground".to_owned() } else { format!("rod-{}", i - 1) };
        text += &format!(
            "[[joint]]\nname = \"pin-{i}\"\nkind = \"revolute\"\nbodies = [\"{before}\", \"rod-{i}\"]\nat = [{i}.0, 0.0]\n"
        );
    }
    for i in [7, 2, 0, 5] {
        text += &format!(
            "[[effect]]\nname = \"spring-{i}\"\nkind = \"torsion-spring\"\njoint = \"pin-{i}\"\nstiffness = 1.0\n"
        );
    }
    let model: NaturalModel<f64, 2> = mbs_testkit::model(&mbs_testkit::scene(&text));
    let mut found: Vec<usize> = (0..4).filter_map(|e| model.memory_of_effect(e)).collect();
    found.sort_unstable();
    assert_eq!(found, [0, 1, 2, 3], "four angles, each with a place of its own");
    assert_eq!(model.memory_of_effect(4), None);
    let owners: Vec<_> = model.remembered().map(|(owner, _)| owner).collect();
    assert_eq!(owners, (0..4).map(mbs_core::model::Owner::Effect).collect::<Vec<_>>());
}

/// The bodies of a small mechanism form one element. Its unknowns and rows still belong to the bodies and joints that they come
/// from.
#[test]
fn unknowns_of_a_small_mechanism_belong_to_their_bodies() {
    use mbs_core::model::Owner::Body;
    let text = "[scene]\nname = \"two rods\"\ndimension = 2\nduration = 1.0\n\
        [[body]]\nname = \"upper\"\nrod = { from = [0.0, 0.0], to = [1.0, 0.0] }\nmass = 1.0\n\
        [[body]]\nname = \"lower\"\nrod = { from = [1.0, 0.0], to = [2.0, 0.0] }\nmass = 1.0\n\
        [[joint]]\nname = \"pin\"\nkind = \"revolute\"\nbodies = [\"ground\", \"upper\"]\nat = [0.0, 0.0]\n\
        [[joint]]\nname = \"knee\"\nkind = \"revolute\"\nbodies = [\"upper\", \"lower\"]\nat = [1.0, 0.0]\n";
    let model: NaturalModel<f64, 2> = mbs_testkit::model(&mbs_testkit::scene(text));
    assert_eq!(model.n_elements(), 1);
    let unknowns: Vec<_> = (0..4).map(|u| model.owner_of_unknown(u)).collect();
    assert_eq!(unknowns, [Body(0), Body(0), Body(1), Body(1)]);
    assert_eq!([0, 1].map(|row| model.owner_of_row(row)), [Body(0), Body(1)]);
}

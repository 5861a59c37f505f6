//! Assembly of a start: prescribed values hold exactly, other values change as little as possible, and contradictions are named.

mod sparse_rank;

use mbs_core::Cliques;
use mbs_core::model::{Load, Model, Owner};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{BodyId, JointId, Scene};
use mbs_core::start::{Assembled, AssemblyError, assemble};
use mbs_sparse::{Multifrontal, Options};
use mbs_testkit::{
    PLANAR, SPATIAL, close, dot, in_null_space, jacobian, plus, reference, residual, scene,
};

type V = [f64; 3];

/// Largest error of prescribed coordinates and rates [m, rad, m/s, rad/s].
const HELD: f64 = 1e-10;

fn start<const D: usize>(
    scene: &Scene<f64>,
) -> Result<(NaturalModel<f64, D>, Assembled<f64>), AssemblyError> {
    let model = NaturalModel::<f64, D>::new(scene)?;
    let mut solver = Multifrontal::analyse(&model, Options::default());
    let assembled =
        assemble(scene, &model, |p| Multifrontal::analyse(p, Options::default()), &mut solver)?;
    Ok((model, assembled))
}

/// Scene of a body x on a joint of this kind, on the ground or on a moving base. `rest` has further lines.
fn one_joint(kind: &str, axes: &str, first: &str, rest: &str) -> String {
    let base = if first == "base" {
        "[[body]]\nname = \"base\"\nmass = 1.5\ncenter = [0.0, -0.3, 0.2]\ninertia = [0.1, 0.15, 0.12, 0.01, 0.0, 0.0]\n"
    } else {
        ""
    };
    format!(
        "[scene]\nname = \"{kind}\"\ndimension = 3\nduration = 1.0\n{base}[[body]]\nname = \"x\"\nmass = 1.0\ncenter = [0.4, 0.3, 0.2]\ninertia = [0.1, 0.12, 0.11, 0.0, 0.01, 0.0]\n[[joint]]\nname = \"j\"\nkind = \"{kind}\"\nbodies = [\"{first}\", \"x\"]\nat = [0.1, 0.2, 0.3]\n{axes}\n[[initial]]\njoint = \"j\"\n{rest}\n"
    )
}

fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: V) -> V {
    let l = dot(&a, &a).sqrt();
    a.map(|x| x / l)
}

/// Vector x rotated by the rotation vector w (Rodrigues' formula).
fn turned(w: V, x: V) -> V {
    let angle = dot(&w, &w).sqrt();
    if angle < 1e-300 {
        return x;
    }
    let n = w.map(|w| w / angle);
    let (s, c) = angle.sin_cos();
    let nx = cross(n, x);
    std::array::from_fn(|i| x[i] * c + nx[i] * s + n[i] * dot(&n, &x) * (1.0 - c))
}

/// Frame of a body, in which vectors have components; global axes for the ground.
struct Frame<'a>(&'a NaturalModel<f64, 3>, &'a [f64], BodyId);

impl Frame<'_> {
    fn point(&self, p: V) -> V {
        self.0.point(self.2, p).value(self.1).into()
    }
    fn point_rate(&self, v: &[f64], p: V) -> V {
        self.0.point(self.2, p).rate(v).into()
    }
    fn direction(&self, d: V) -> V {
        self.0.direction(self.2, d).value(self.1).into()
    }
    fn direction_rate(&self, v: &[f64], d: V) -> V {
        self.0.direction(self.2, d).rate(v).into()
    }
    fn spin(&self, v: &[f64]) -> V {
        let mut w = [0.0; 3];
        for i in 0..3 {
            let e = std::array::from_fn(|k| f64::from(u8::from(k == i)));
            let part = cross(self.direction(e), self.direction_rate(v, e));
            (0..3).for_each(|k| w[k] += 0.5 * part[k]);
        }
        w
    }
    /// Components of a global vector in the body's axes.
    fn seen(&self, x: V) -> V {
        std::array::from_fn(|i| {
            let e = std::array::from_fn(|k| f64::from(u8::from(k == i)));
            dot(&x, &self.direction(e))
        })
    }
}

const AT: V = [0.1, 0.2, 0.3];

/// Checks the pose of body x relative to the first body. `rotation` rotates the directions of x, and `shift` is the displacement of
/// its place.
fn check_pose(first: &str, text: &str, rotation: impl Fn(V) -> V, shift: V) {
    let scene = scene(text);
    let (model, assembled) = start::<3>(&scene).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let q = &assembled.state.q;
    let (x, base) = (
        BodyId::Body(scene.bodies.len() - 1),
        if first == "base" { BodyId::Body(0) } else { BodyId::Ground },
    );
    let (x, base) = (Frame(&model, q, x), Frame(&model, q, base));
    for i in 0..3 {
        let e = std::array::from_fn(|k| f64::from(u8::from(k == i)));
        close(text, &base.seen(x.direction(e)), &rotation(e), HELD);
    }
    let gap = plus(&x.point(AT), -1.0, &base.point(AT));
    close(text, &base.seen([gap[0], gap[1], gap[2]]), &shift, HELD);
}

#[test]
fn held_values_are_met_for_every_joint_also_beyond_half_a_turn() {
    for first in ["ground", "base"] {
        let axis = unit([0.3, 1.0, 0.2]);
        let line = "axis = [0.3, 1.0, 0.2]";
        for angle in [0.2, -1.5, 3.0, 4.5, -7.0, 20.0] {
            let text = one_joint("revolute", line, first, &format!("value = {angle:?}"));
            check_pose(first, &text, |e| turned(axis.map(|a| a * angle), e), [0.0; 3]);
            let text = one_joint("cylindrical", line, first, &format!("value = [0.4, {angle:?}]"));
            check_pose(first, &text, |e| turned(axis.map(|a| a * angle), e), axis.map(|a| a * 0.4));
            let planar = "axis = [0.3, 1.0, 0.2]\ndirection = [1.0, 0.1, 0.0]";
            let text =
                one_joint("planar", planar, first, &format!("value = [0.4, -0.3, {angle:?}]"));
            let along = dot(&[1.0, 0.1, 0.0], &axis);
            let d = unit(std::array::from_fn(|i| [1.0, 0.1, 0.0][i] - along * axis[i]));
            let s = cross(axis, d);
            let shift = std::array::from_fn(|i| 0.4 * d[i] - 0.3 * s[i]);
            check_pose(first, &text, |e| turned(axis.map(|a| a * angle), e), shift);
            let axes = "axes = [[1.0, 0.3, 0.0], [0.1, 1.0, 0.5]]";
            let text = one_joint("universal", axes, first, &format!("value = [{angle:?}, 0.7]"));
            let (a, b) = (unit([1.0, 0.3, 0.0]), unit([0.1, 1.0, 0.5]));
            let both = |e| turned(a.map(|a| a * angle), turned(b.map(|b| b * 0.7), e));
            check_pose(first, &text, both, [0.0; 3]);
        }
        let text = one_joint("prismatic", line, first, "value = -1.7");
        check_pose(first, &text, |e| e, axis.map(|a| a * -1.7));
    }
}

#[test]
fn held_rotation_vectors_are_met_for_spherical_and_free_joints() {
    for first in ["ground", "base"] {
        for w in
            [[0.1, 0.2, -0.1], [1.0, -1.0, 2.0], [0.0, 3.1, 0.0], [2.0, 2.0, -1.5], [0.0, 0.0, 0.0]]
        {
            let text = one_joint("spherical", "", first, &format!("value = {w:?}"));
            check_pose(first, &text, |e| turned(w, e), [0.0; 3]);
            let all = [0.5, -0.2, 0.7, w[0], w[1], w[2]];
            let text = one_joint("free", "", first, &format!("value = {all:?}"));
            check_pose(first, &text, |e| turned(w, e), [0.5, -0.2, 0.7]);
        }
    }
}

#[test]
fn held_rates_are_met_for_every_joint() {
    let (axis, line) = (unit([0.3, 1.0, 0.2]), "axis = [0.3, 1.0, 0.2]");
    let (a, b) = (unit([1.0, 0.3, 0.0]), unit([0.1, 1.0, 0.5]));
    let scaled = |x: V, s: f64| x.map(|x| x * s);
    let sum = |x: V, y: V| -> V { std::array::from_fn(|i| x[i] + y[i]) };
    let planar = "axis = [0.3, 1.0, 0.2]\ndirection = [1.0, 0.1, 0.0]";
    let along = dot(&[1.0, 0.1, 0.0], &axis);
    let d = unit(std::array::from_fn(|i| [1.0, 0.1, 0.0][i] - along * axis[i]));
    let shift = sum(scaled(d, 0.4), scaled(cross(axis, d), -0.3));
    let universal = "axes = [[1.0, 0.3, 0.0], [0.1, 1.0, 0.5]]";
    let none = [0.0; 3];
    let cases: [(&str, &str, &str, V, V); 7] = [
        ("revolute", line, "rate = 2.0", scaled(axis, 2.0), none),
        ("prismatic", line, "rate = 2.0", none, scaled(axis, 2.0)),
        ("cylindrical", line, "rate = [2.0, -3.0]", scaled(axis, -3.0), scaled(axis, 2.0)),
        ("universal", universal, "rate = [2.0, -3.0]", sum(scaled(a, 2.0), scaled(b, -3.0)), none),
        ("planar", planar, "rate = [0.4, -0.3, 5.0]", scaled(axis, 5.0), shift),
        ("spherical", "", "rate = [0.4, -0.3, 5.0]", [0.4, -0.3, 5.0], none),
        ("free", "", "rate = [0.5, -0.2, 0.7, 0.4, -0.3, 5.0]", [0.4, -0.3, 5.0], [0.5, -0.2, 0.7]),
    ];
    for (kind, axes, rate, spin, slide) in cases {
        for first in ["ground", "base"] {
            let scene = scene(&one_joint(kind, axes, first, rate));
            let (model, assembled) = start::<3>(&scene).unwrap_or_else(|e| panic!("{kind}: {e}"));
            let s = &assembled.state;
            let x = Frame(&model, &s.q, BodyId::Body(scene.bodies.len() - 1));
            let base =
                Frame(&model, &s.q, if first == "base" { BodyId::Body(0) } else { BodyId::Ground });
            let wb = if first == "base" { base.spin(&s.v) } else { none };
            close(kind, &plus(&x.spin(&s.v), -1.0, &wb), &spin, HELD);
            let gap = plus(&x.point_rate(&s.v, AT), -1.0, &base.point_rate(&s.v, AT));
            close(kind, &gap, &slide, HELD);
        }
    }
}

#[test]
fn universal_rates_hold_at_a_turned_configuration() {
    let axes = "axes = [[1.0, 0.3, 0.0], [0.1, 1.0, 0.5]]";
    let text = one_joint("universal", axes, "ground", "value = [1.1, 0.7]\nrate = [2.0, -3.0]");
    let (model, assembled) = start::<3>(&scene(&text)).unwrap_or_else(|e| panic!("{e}"));
    let x = Frame(&model, &assembled.state.q, BodyId::Body(0));
    let (a, b) = (unit([1.0, 0.3, 0.0]), unit([0.1, 1.0, 0.5]));
    let b = turned(a.map(|a| a * 1.1), b);
    let w: V = std::array::from_fn(|i| 2.0 * a[i] - 3.0 * b[i]);
    close("spin", &x.spin(&assembled.state.v), &w, HELD);
}

#[test]
fn held_velocity_and_angular_velocity_of_a_body_are_met() {
    let text = "[scene]\nname = \"b\"\ndimension = 3\nduration = 1.0\n[[body]]\nname = \"x\"\nmass = 1.0\ncenter = [0.4, 0.3, 0.2]\ninertia = [0.1, 0.12, 0.11, 0.0, 0.01, 0.0]\n[[initial]]\nbody = \"x\"\nat = [1.0, 1.0, 0.0]\nvelocity = [1.0, -2.0, 0.5]\nangular_velocity = [3.0, 1.0, -2.0]\n";
    let (model, assembled) = start::<3>(&scene(text)).unwrap_or_else(|e| panic!("{e}"));
    let (s, x) = (&assembled.state, Frame(&model, &assembled.state.q, BodyId::Body(0)));
    close("velocity", &x.point_rate(&s.v, [1.0, 1.0, 0.0]), &[1.0, -2.0, 0.5], HELD);
    close("spin", &x.spin(&s.v), &[3.0, 1.0, -2.0], HELD);
}

#[test]
fn a_consistent_state_is_left_untouched() {
    fn check<const D: usize>(text: &str) {
        let scene = scene(text);
        let (model, assembled) =
            start::<D>(&scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
        assert_eq!(assembled.state.q, reference(&model), "{}", scene.name);
        assert_eq!(assembled.change.to_bits(), 0.0_f64.to_bits());
    }
    check::<2>(include_str!("../../../scenes/double-pendulum.toml"));
    check::<2>(include_str!("../../../scenes/n-four-bar-10.toml"));
    check::<3>(include_str!("../../../scenes/spatial-four-bar.toml"));
    check::<3>(include_str!("../../../scenes/spinning-top.toml"));
    check::<3>(include_str!("../../../scenes/spatial-chain-20.toml"));
    check::<2>(PLANAR);
    check::<3>(SPATIAL);
}

/// Angle of a planar direction of a body [rad].
fn heading(model: &NaturalModel<f64, 2>, q: &[f64], body: usize) -> f64 {
    let d = model.direction(BodyId::Body(body), [1.0, 0.0, 0.0]).value(q);
    d[1].atan2(d[0])
}

#[test]
fn a_four_bar_keeps_its_branch_through_a_turn_of_its_crank() {
    let text = include_str!("../../../scenes/guided-four-bar.toml");
    for turns in 0..24 {
        let angle = 0.3 * f64::from(turns);
        let mut scene = scene(text);
        scene.guides.clear();
        let held = format!(
            "[scene]\nname = \"h\"\ndimension = 2\nduration = 1.0\n[[body]]\nname = \"x\"\nmass = 1.0\ncenter = [0.0, 0.0]\ninertia = 1.0\n[[joint]]\nname = \"j\"\nkind = \"revolute\"\nbodies = [\"ground\", \"x\"]\nat = [0.0, 0.0]\n[[initial]]\njoint = \"j\"\nvalue = {angle:?}\nrate = 1.0\n"
        );
        scene.initials = mbs_testkit::scene(&held).initials;
        let (model, assembled) = start::<2>(&scene).unwrap_or_else(|e| panic!("{angle}: {e}"));
        let q = &assembled.state.q;
        let turned = heading(&model, q, 0) - angle;
        assert!(turned.sin().abs() < HELD && turned.cos() > 0.0);
        let at = |body, p| model.point(BodyId::Body(body), p).value(q);
        let (b, c, d) = (at(0, [0.18, 0.24, 0.0]), at(1, [0.868, 0.576, 0.0]), [0.7, 0.0]);
        // The coupler and the rocker have the same orientation as in the reference configuration.
        let area = (c[0] - b[0]) * (d[1] - b[1]) - (c[1] - b[1]) * (d[0] - b[0]);
        assert!(area < -1e-3, "area {area} at {angle}");
    }
}

#[test]
fn contradicting_entries_are_named() {
    // The prescribed angle of the coupler contradicts that of the crank.
    let mut four_bar = scene(include_str!("../../../scenes/guided-four-bar.toml"));
    four_bar.guides.clear();
    let mut add = |joint: usize, value: Option<f64>, rate: Option<f64>| {
        let target = mbs_core::scene::InitialTarget::Joint {
            joint: JointId::new(joint),
            value: value.map(|x| vec![x]),
            rate: rate.map(|x| vec![x]),
        };
        four_bar.initials.push(mbs_core::scene::InitialCondition { target });
    };
    add(0, Some(0.1), None);
    add(1, Some(0.9), None);
    match start::<2>(&four_bar).err() {
        Some(AssemblyError::Position {
            initial: Some(i),
            owner: Owner::Joint(j),
            residual,
            ..
        }) => {
            assert_eq!(i, j);
            assert!(i < 2 && residual > 1e-3);
        }
        other => panic!("{other:?}"),
    }
    four_bar.initials.clear();
    let mut add = |joint: usize, rate: f64| {
        let target = mbs_core::scene::InitialTarget::Joint {
            joint: JointId::new(joint),
            value: None,
            rate: Some(vec![rate]),
        };
        four_bar.initials.push(mbs_core::scene::InitialCondition { target });
    };
    add(0, 1.0);
    add(3, 5.0);
    match start::<2>(&four_bar).err() {
        Some(AssemblyError::Velocity { initial: Some(i), owner: Owner::Joint(_), .. }) => {
            assert!(i < 2)
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_gap_of_a_millionth_of_the_size_is_refused_and_one_of_rounding_is_not() {
    let mut four_bar = scene(include_str!("../../../scenes/guided-four-bar.toml"));
    four_bar.guides.clear();
    let mut hold = |values: &[f64]| {
        four_bar.initials.clear();
        for (joint, &value) in values.iter().enumerate() {
            let value = Some(vec![value]);
            let target = mbs_core::scene::InitialTarget::Joint {
                joint: JointId::new(joint),
                value,
                rate: None,
            };
            four_bar.initials.push(mbs_core::scene::InitialCondition { target });
        }
        start::<2>(&four_bar)
    };
    // At 1.5 rad the two prescribed angles are compatible only at the end of the assembly.
    for angle in [0.1, 0.3, 1.5] {
        let (model, assembled) = hold(&[angle]).unwrap_or_else(|e| panic!("{e}"));
        let [crank, coupler] = [0, 1].map(|body| heading(&model, &assembled.state.q, body));
        let found = hold(&[angle, coupler - crank]);
        assert!(found.is_ok(), "{angle}: {:?}", found.err());
        match hold(&[angle, coupler - crank + 1e-6]).err() {
            Some(AssemblyError::Position { residual, .. }) => {
                assert!(residual < 1e-5, "{residual:e}");
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn a_force_that_meets_no_inertia_is_refused_by_name() {
    let text = "[scene]\nname = \"m\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n[[body]]\nname = \"heavy\"\nmass = 1.0\ncenter = [1.0, 0.0]\ninertia = 0.1\n[[body]]\nname = \"ghost\"\nmass = 0.0\ncenter = [1.5, 0.0]\n[[joint]]\nname = \"j\"\nkind = \"revolute\"\nbodies = [\"ground\", \"heavy\"]\nat = [0.0, 0.0]\n[[joint]]\nname = \"k\"\nkind = \"revolute\"\nbodies = [\"heavy\", \"ghost\"]\nat = [1.0, 0.0]\n[[effect]]\nkind = \"force\"\nbody = \"ghost\"\nat = [2.0, 0.0]\nvalue = [0.0, 1.0]\n";
    let text = text.replace("center = [1.5, 0.0]\n", "center = [1.5, 0.0]\ninertia = 0.0\n");
    match start::<2>(&scene(&text)).err() {
        Some(AssemblyError::NoInertia { owner: Owner::Body(1) | Owner::Effect(0) }) => {}
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_massless_link_that_joints_determine_assembles() {
    let text = "[scene]\nname = \"m\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n[[body]]\nname = \"left\"\nmass = 1.0\ncenter = [0.0, 0.5]\ninertia = 0.1\n[[body]]\nname = \"right\"\nmass = 1.0\ncenter = [1.0, 0.5]\ninertia = 0.1\n[[body]]\nname = \"link\"\nmass = 0.0\ncenter = [0.5, 1.0]\ninertia = 0.0\n[[joint]]\nname = \"a\"\nkind = \"revolute\"\nbodies = [\"ground\", \"left\"]\nat = [0.0, 0.0]\n[[joint]]\nname = \"b\"\nkind = \"revolute\"\nbodies = [\"ground\", \"right\"]\nat = [1.0, 0.0]\n[[joint]]\nname = \"c\"\nkind = \"revolute\"\nbodies = [\"left\", \"link\"]\nat = [0.0, 1.0]\n[[joint]]\nname = \"d\"\nkind = \"revolute\"\nbodies = [\"link\", \"right\"]\nat = [1.0, 1.0]\n[[initial]]\njoint = \"a\"\nvalue = 0.4\nrate = 2.0\n";
    let (_, assembled) = start::<2>(&scene(text)).unwrap_or_else(|e| panic!("{e}"));
    assert!(assembled.residual[2] < 1e-9);
}

/// Checks that the assembled change of position (or the velocity) is M-orthogonal to every admissible motion.
fn check_least<const D: usize>(
    scene: &Scene<f64>,
    holds: impl Fn(&NaturalModel<f64, D>, &[f64]) -> Vec<Vec<f64>>,
) {
    let (model, assembled) = start::<D>(scene).unwrap_or_else(|e| panic!("{e}"));
    let s = &assembled.state;
    assert_eq!(assembled.stages, 1, "one stage, so that the change is least");
    let mut terms = model.terms();
    model.set_inputs(0.0, s, &mut terms);
    model.evaluate(&s.q, &mut terms);
    let mut rows = jacobian(&model, &terms);
    rows.extend(holds(&model, &s.q));
    let change = plus(&s.q, -1.0, &reference(&model));
    for x in [&change, &s.v] {
        let load = Load { mass: Some(x), multipliers: None, force: 0.0 };
        let momentum = residual(&model, &terms, &load);
        let size = dot(&momentum, &momentum).sqrt();
        assert!(size > 1e-4, "something moved");
        let free = in_null_space(&rows, &momentum);
        assert!(
            dot(&free, &free).sqrt() < 1e-9 * size,
            "{:e} of {size:e}",
            dot(&free, &free).sqrt()
        );
    }
}

#[test]
fn what_is_not_held_changes_least() {
    // A double pendulum with a free tip, whose elbow angle is prescribed.
    let text = "[scene]\nname = \"d\"\ndimension = 2\nduration = 1.0\n[[body]]\nname = \"u\"\nmass = 1.0\ncenter = [0.5, 0.1]\ninertia = 0.1\n[[body]]\nname = \"l\"\nmass = 2.0\ncenter = [1.5, -0.1]\ninertia = 0.2\n[[joint]]\nname = \"p\"\nkind = \"revolute\"\nbodies = [\"ground\", \"u\"]\nat = [0.0, 0.0]\n[[joint]]\nname = \"e\"\nkind = \"revolute\"\nbodies = [\"u\", \"l\"]\nat = [1.0, 0.0]\n[[initial]]\njoint = \"e\"\nvalue = 0.2\nrate = 1.5\n";
    let scene = scene(text);
    check_least::<2>(&scene, |model, q| {
        // Gradient of the elbow's angle, by differences of its cosine and sine: a direction of one body relative to the other.
        let n = model.n_unknowns();
        let angle = |q: &[f64]| {
            let u = model.direction(BodyId::Body(0), [1.0, 0.0, 0.0]).value(q);
            let l = model.direction(BodyId::Body(1), [1.0, 0.0, 0.0]).value(q);
            (u[0] * l[1] - u[1] * l[0]).atan2(u[0] * l[0] + u[1] * l[1])
        };
        let mut row = vec![0.0; n];
        for i in 0..n {
            let (mut a, mut b) = (q.to_vec(), q.to_vec());
            a[i] -= 1e-5;
            b[i] += 1e-5;
            row[i] = (angle(&b) - angle(&a)) / 2e-5;
        }
        vec![row]
    });
}

#[test]
fn redundant_loops_assemble_away_from_the_reference() {
    let mut scene = scene(include_str!("../../../scenes/spatial-four-bar.toml"));
    if let mbs_core::scene::InitialTarget::Joint { value, .. } = &mut scene.initials[0].target {
        *value = Some(vec![2.5]);
    }
    let (_, assembled) = start::<3>(&scene).unwrap_or_else(|e| panic!("{e}"));
    assert!(assembled.residual[0] < 1e-11 && assembled.residual[1] < 1e-10);
}

#[test]
fn accelerations_solve_the_equations_of_motion() {
    fn check<const D: usize>(text: &str) {
        let (model, assembled) = start::<D>(&scene(text)).unwrap_or_else(|e| panic!("{e}"));
        let s = &assembled.state;
        let mut terms = model.terms();
        model.set_inputs(0.0, s, &mut terms);
        model.evaluate(&s.q, &mut terms);
        model.evaluate_forces(&s.q, &s.v, &mut terms);
        model.evaluate_bias(&s.q, &s.v, &mut terms);
        let load = Load { mass: Some(&s.a), multipliers: Some(&s.lambda), force: 1.0 };
        let left = residual(&model, &terms, &load);
        close("M a + J^T lambda - Q", &left, &vec![0.0; left.len()], 1e-8);
        let acceleration = plus(&mbs_testkit::rates(&model, &terms, &s.a), 1.0, &terms.phi_bias);
        close("phi''", &acceleration, &vec![0.0; acceleration.len()], 1e-8);
    }
    check::<2>(PLANAR);
    check::<3>(SPATIAL);
}

#[test]
fn a_torsion_spring_remembers_the_turns_it_starts_with() {
    let text = one_joint(
        "revolute",
        "axis = [0.3, 1.0, 0.2]",
        "ground",
        "value = 20.0\n[[effect]]\nkind = \"torsion-spring\"\njoint = \"j\"\nstiffness = 2.0",
    );
    let (_, assembled) = start::<3>(&scene(&text)).unwrap_or_else(|e| panic!("{e}"));
    assert!((assembled.state.memory[0] - 20.0).abs() < HELD, "{:?}", assembled.state.memory);
}

#[test]
fn a_scene_of_a_millimetre_assembles_as_one_of_a_metre() {
    for size in [1e-3, 1.0, 1e3] {
        let mut scene = scene(include_str!("../../../scenes/spatial-four-bar.toml"));
        for body in &mut scene.bodies {
            body.center = body.center.map(|x| x * size);
            if let mbs_core::scene::Inertia::Spatial(six) = &mut body.inertia {
                *six = six.map(|x| x * size * size);
            }
        }
        for joint in &mut scene.joints {
            joint.points = joint.points.map(|p| p.map(|x| x * size));
        }
        if let mbs_core::scene::InitialTarget::Joint { value, .. } = &mut scene.initials[0].target {
            *value = Some(vec![0.6]);
        }
        let found = start::<3>(&scene);
        assert!(found.is_ok(), "size {size}: {:?}", found.err());
    }
}

#[test]
fn a_chain_of_forty_joints_that_are_all_held_assembles() {
    let mut text = String::from("[scene]\nname = \"c\"\ndimension = 2\nduration = 1.0\n");
    for i in 0..40 {
        let before = if i == 0 { "ground".to_owned() } else { format!("b{}", i - 1) };
        text += &format!(
            "[[body]]\nname = \"b{i}\"\nmass = 1.0\ncenter = [{}, 0.0]\ninertia = 0.003\n[[joint]]\nname = \"j{i}\"\nkind = \"revolute\"\nbodies = [\"{before}\", \"b{i}\"]\nat = [{}, 0.0]\n[[initial]]\njoint = \"j{i}\"\nvalue = 0.02\nrate = 0.1\n",
            0.2 * f64::from(i) + 0.1,
            0.2 * f64::from(i)
        );
    }
    let (model, assembled) = start::<2>(&scene(&text)).unwrap_or_else(|e| panic!("{e}"));
    assert!((heading(&model, &assembled.state.q, 39) - 0.8).abs() < HELD);
}

//! Starts from partly prescribed values: the library finds the smallest mass-weighted change of the reference configuration, at
//! every size.

mod judge;

use judge::{Body, Joint, M, Mechanism, V, add, cross, times};
use mbs_core::Real;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::BodyId;
use mbs_core::start::assemble;
use mbs_sparse::{Multifrontal, Options};
use mbs_testkit::{Random, scene_in};

/// Allowed error, relative to the size and to the largest rate. Ten roundings, times the condition 100 of the joints, are a
/// hundredth of it.
const RIGHT: f64 = 1e-10;
/// Allowed error in single precision, relative to the size and to the largest rate.
const RIGHT_IN_F32: f64 = 1e-4;

/// Motion of each body: centre, two directions, and their rates.
type Found = Vec<[V; 6]>;

fn unit(x: V) -> V {
    let length = x.iter().map(|x| x * x).sum::<f64>().sqrt();
    x.map(|x| x / length)
}

fn vector(random: &mut Random, is_planar: bool, size: f64) -> V {
    let x = [random.next(), random.next(), random.next()].map(|x| x * size);
    if is_planar { [x[0], x[1], 0.0] } else { x }
}

/// Body close to `at`, with a positive definite second moment.
fn body(random: &mut Random, is_planar: bool, at: V) -> Body {
    let mut moment: M = [[0.0; 3]; 3];
    for i in 0..3 {
        moment[i][i] = 0.03 + 0.02 * random.next();
    }
    if is_planar {
        let half = moment[0][0];
        moment = [[half, 0.0, 0.0], [0.0, half, 0.0], [0.0; 3]];
    } else {
        let off = 0.004 * random.next();
        (moment[0][1], moment[1][0]) = (off, off);
    }
    let center = add(at, 1.0, vector(random, is_planar, 0.4));
    Body { mass: 1.2 + random.next(), center, moment }
}

/// Random tree of `n` joints, some of them with prescribed values. With `is_loop` the last one closes a loop with the ground.
fn mechanism(seed: u64, is_planar: bool, is_loop: bool) -> Mechanism {
    let mut random = Random::new(seed);
    let n = if is_loop && is_planar { 4 } else { 3 + random.below(2) };
    let (mut bodies, mut joints) = (Vec::new(), Vec::<Joint>::new());
    let mut at = vector(&mut random, is_planar, 0.3);
    for k in 0..n {
        let kinds: &[&str] = match (is_planar, is_loop) {
            (true, true) => &["revolute"],
            (true, false) => &["revolute", "revolute", "prismatic"],
            (false, true) => &["universal", "spherical", "cylindrical"],
            (false, false) => &["revolute", "prismatic", "cylindrical", "universal", "spherical"],
        };
        let kind = kinds[random.below(kinds.len())];
        let axis = unit(vector(&mut random, is_planar, 1.0));
        let other = cross(axis, unit(add(axis, 2.0, vector(&mut random, false, 1.0))));
        let axes = if is_planar && kind == "revolute" {
            [[0.0, 0.0, 1.0]; 2]
        } else {
            [axis, unit(other)]
        };
        let first = if is_loop { k.checked_sub(1) } else { random.below(k + 1).checked_sub(1) };
        let size = if is_loop { 0.25 } else { 1.4 };
        let mut number = |n: usize| -> Vec<f64> {
            (0..n)
                .map(|i| {
                    let is_slide = kind == "prismatic" || (kind == "cylindrical" && i == 0);
                    random.next() * if is_slide { 0.3 } else { size }
                })
                .collect()
        };
        let count = match kind {
            "revolute" | "prismatic" => 1,
            "spherical" => 3,
            _ => 2,
        };
        let (value, rate) = (number(count), number(count));
        // one prescribed joint in a loop leaves freedoms to be found
        let holds = |random: &mut Random| {
            if is_loop { k == 1 } else { random.next() > 0.0 }
        };
        let value = holds(&mut random).then_some(value);
        let rate = (holds(&mut random) && kind != "spherical").then_some(rate);
        joints.push(Joint { kind, first, at, axes, value, rate });
        bodies.push(body(&mut random, is_planar, at));
        at = add(at, 1.0, vector(&mut random, is_planar, 0.8));
    }
    let cuts = if is_loop { vec![(None, n - 1, at)] } else { Vec::new() };
    Mechanism { is_planar, bodies, joints, cuts }
}

/// Scene text with lengths multiplied by `size`, and masses by `mass`.
fn text(m: &Mechanism, size: f64, mass: f64) -> String {
    let dimension = if m.is_planar { 2 } else { 3 };
    let mut text = format!("[scene]\nname = \"s\"\ndimension = {dimension}\nduration = 1.0\n");
    let list = |x: &[f64]| format!("{x:?}");
    let place = |x: V| list(&x.map(|x| x * size)[..dimension]);
    let name = |b: Option<usize>| b.map_or("ground".to_owned(), |b| format!("b{b}"));
    for (b, body) in m.bodies.iter().enumerate() {
        let e = &body.moment;
        let scale = mass * size * size;
        let trace = e[0][0] + e[1][1] + e[2][2];
        let inertia = if m.is_planar {
            format!("{:?}", trace * scale)
        } else {
            let d: V = std::array::from_fn(|i| (trace - e[i][i]) * scale);
            list(&[d[0], d[1], d[2], -e[0][1] * scale, -e[0][2] * scale, -e[1][2] * scale])
        };
        let (center, mass) = (place(body.center), body.mass * mass);
        text += &format!(
            "[[body]]\nname = \"b{b}\"\nmass = {mass:?}\ncenter = {center}\ninertia = {inertia}\n"
        );
    }
    for (j, joint) in m.joints.iter().enumerate() {
        let (kind, first, at) = (joint.kind, name(joint.first), place(joint.at));
        let axes = match kind {
            "spherical" => String::new(),
            "universal" => format!("axes = [{}, {}]", list(&joint.axes[0]), list(&joint.axes[1])),
            "revolute" if m.is_planar => String::new(),
            _ => format!("axis = {}", list(&joint.axes[0][..dimension])),
        };
        text += &format!(
            "[[joint]]\nname = \"j{j}\"\nkind = \"{kind}\"\nbodies = [\"{first}\", \"b{j}\"]\nat = {at}\n{axes}\n"
        );
        let scaled = |x: &[f64]| {
            let is_slide = |i| kind == "prismatic" || (kind == "cylindrical" && i == 0);
            let x = x.iter().enumerate().map(|(i, x)| if is_slide(i) { x * size } else { *x });
            let x: Vec<f64> = x.collect();
            if x.len() == 1 { format!("{:?}", x[0]) } else { list(&x) }
        };
        if joint.value.is_some() || joint.rate.is_some() {
            text += &format!("[[initial]]\njoint = \"j{j}\"\n");
        }
        for (key, x) in [("value", &joint.value), ("rate", &joint.rate)] {
            if let Some(x) = x {
                text += &format!("{key} = {}\n", scaled(x));
            }
        }
    }
    let kind = if m.is_planar { "revolute" } else { "spherical" };
    for (c, &(first, second, at)) in m.cuts.iter().enumerate() {
        let (first, second, at) = (name(first), name(Some(second)), place(at));
        text += &format!(
            "[[joint]]\nname = \"c{c}\"\nkind = \"{kind}\"\nbodies = [\"{first}\", \"{second}\"]\nat = {at}\n"
        );
    }
    text
}

/// Motion that the library finds, in units of size one; empty if the library refuses the scene.
fn found<T: Real, const D: usize>(m: &Mechanism, size: f64, mass: f64) -> Found {
    let text = text(m, size, mass);
    let scene = scene_in::<T>(&text);
    let model = NaturalModel::<T, D>::new(&scene).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let analyse = Options::default();
    let mut solver = Multifrontal::analyse(&model, analyse);
    let start = assemble(&scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver);
    let state = match start {
        Ok(start) => start.state,
        Err(_) => return Vec::new(),
    };
    let seen = |b: usize, (x, is_point): (V, bool)| {
        let (body, to) = (BodyId::Body(b), x.map(T::from_f64));
        let x = if is_point { model.point(body, to) } else { model.direction(body, to) };
        [x.value(&state.q), x.rate(&state.v)].map(|v| {
            std::array::from_fn(|i| {
                if i < D { v[i].to_f64() / if is_point { size } else { 1.0 } } else { 0.0 }
            })
        })
    };
    let all = |b: usize| {
        // the centre as rounded to the precision of the scene
        let center = scene.bodies[b].center.map(Real::to_f64);
        let [c, cd] = seen(b, (center, true));
        let [x, xd] = seen(b, ([1.0, 0.0, 0.0], false));
        let [y, yd] = seen(b, ([0.0, 1.0, 0.0], false));
        [c, x, y, cd, xd, yd]
    };
    (0..m.bodies.len()).map(all).collect()
}

/// Motion of the reference solution; `None` if one of its stages fails.
fn expected(m: &Mechanism) -> Option<Found> {
    let (poses, z) = m.positions()?;
    let rates = m.velocities(&z);
    let all = poses.iter().zip(&rates).zip(&m.bodies).map(|((pose, [v, w]), body)| {
        let [x, y] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|e| times(&pose.turn, e));
        [pose.point(body.center), x, y, *v, cross(*w, x), cross(*w, y)]
    });
    Some(all.collect())
}

/// Largest difference of two motions. Rates are relative to the largest rate.
fn apart(a: &Found, b: &Found) -> f64 {
    let rates = b.iter().flat_map(|x| x[3..].iter().flatten());
    let fastest = rates.fold(1.0_f64, |s, x| s.max(x.abs()));
    let mut apart = if a.is_empty() { f64::INFINITY } else { 0.0 };
    for (a, b) in a.iter().zip(b) {
        for k in 0..6 {
            for i in 0..3 {
                apart = apart.max((a[k][i] - b[k][i]).abs() / if k < 3 { 1.0 } else { fastest });
            }
        }
    }
    apart
}

fn starts_are_least<const D: usize>(is_loop: bool) {
    let (mut judged, mut wrong) = (0, Vec::new());
    for seed in 1..=40 {
        let m = mechanism(seed, D == 2, is_loop);
        let Some(expected) = expected(&m) else { continue };
        judged += 1;
        for size in [1e-4, 1e-3, 0.03, 1.0, 10.0, 100.0, 1e4] {
            for mass in [1.0, size * size * size] {
                let error = apart(&found::<f64, D>(&m, size, mass), &expected);
                if !(error <= RIGHT) {
                    wrong.push(format!("{error:e} at seed {seed}, size {size}, mass {mass}"));
                }
            }
            let error = apart(&found::<f32, D>(&m, size, 1.0), &expected);
            if !(error <= RIGHT_IN_F32) {
                wrong.push(format!("{error:e} at seed {seed}, size {size} in f32"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(judged >= 36, "the judge ended in {judged} of 40");
}

#[test]
fn planar_trees_start_with_the_least_change_at_every_size() {
    starts_are_least::<2>(false);
}

#[test]
fn spatial_trees_start_with_the_least_change_at_every_size() {
    starts_are_least::<3>(false);
}

#[test]
fn planar_loops_start_with_the_least_change_at_every_size() {
    starts_are_least::<2>(true);
}

#[test]
fn spatial_loops_start_with_the_least_change_at_every_size() {
    starts_are_least::<3>(true);
}

//! The bound of the number of operations compared with counts. A number type counts the operations of a step.

use crate::ropes_and_cams::{HOIST, SUMS, WINCH};
use crate::signals::{ARM, LINE};
use crate::support::counted::{Counted, done};
use crate::support::start;
use mbs_core::scene::Scene;
use mbs_nostd::export::{Collected, bytes};
use mbs_nostd::format::Axes;
use mbs_nostd::operation_bound::{self, Operations};
use mbs_nostd::{Bounds, Planar, Solver, Spatial, Tables, Unwatched};
use mbs_recursive::rows::Row;
use mbs_testkit::file;

type Room<S> = Solver<Counted, S, 64, 80, 48, 160, 4096, 4096, 2, 24, 4, 24, 6, 8>;
type RoomTables<S> = Tables<Counted, S, 64, 48, 160, 512, 64, 64, 24, 80, 40, 16>;

/// Returns a scene of the repository or of this test.
fn scene(name: &str) -> Scene<f64> {
    if name == "planar-rows" {
        mbs_testkit::scene(include_str!("planar-rows.toml"))
    } else {
        file(name)
    }
}

/// Counts the operations of some steps of a scene. Returns the bound and the count of each step.
fn counted<S: Axes<Counted> + Axes<f64>, const D: usize>(
    name: &str,
    bounds: Bounds,
) -> (Operations, Vec<Operations>) {
    counted_of::<S, D>(&scene(name), bounds)
}

fn counted_of<S: Axes<Counted> + Axes<f64>, const D: usize>(
    scene: &Scene<f64>,
    bounds: Bounds,
) -> (Operations, Vec<Operations>) {
    let (tree, begin) = start::<S, D>(scene);
    let name = &scene.name;
    let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
    let text = bytes(&collected.model(), false).expect("a scene without own laws");
    // The same model is read again, with numbers of the counting type.
    let tables = Box::new(RoomTables::<S>::read(&text).unwrap_or_else(|e| panic!("{name}: {e}")));
    let model = tables.model();
    let mut solver = Box::new(Room::<S>::new(&model).unwrap_or_else(|e| panic!("{name}: {e}")));
    solver.bounds = bounds;
    let mut steps = Vec::new();
    for _ in 0..200 {
        done();
        let report = solver.step(&model, Counted(1e-3), &mut Unwatched);
        steps.push(done());
        report.unwrap_or_else(|e| panic!("{name}: {e}"));
    }
    (operation_bound::step(model.model(), bounds), steps)
}

fn is_exact<S: Axes<Counted> + Axes<f64>, const D: usize>(name: &str) {
    for (evaluations, sweeps, projections) in [(1, 0, 1), (2, 1, 1), (3, 0, 2)] {
        let bounds = Bounds { evaluations, sweeps, projections };
        let (bound, steps) = counted::<S, D>(name, bounds);
        // The first steps from rest are left out. They may have no rotation, and the functions of rotations then take another branch.
        for step in &steps[3..] {
            // Table entries are not arithmetic operations, so the number type does not count them.
            assert_eq!(*step, Operations { entries: 0, ..bound }, "{name} {bounds:?}");
        }
    }
}

#[test]
fn the_formula_is_the_count_of_every_step_without_branching_effects() {
    is_exact::<Planar, 2>("double-pendulum");
    is_exact::<Planar, 2>("four-bar");
    is_exact::<Planar, 2>("two-four-bars");
    is_exact::<Planar, 2>("slider-crank");
    is_exact::<Planar, 2>("guided-four-bar");
    is_exact::<Planar, 2>("n-four-bar-10");
    is_exact::<Planar, 2>("andrews");
    is_exact::<Planar, 2>("planar-rows");
    is_exact::<Planar, 2>("geared-arm");
    is_exact::<Spatial, 3>("free-body");
    is_exact::<Spatial, 3>("spatial-four-bar");
    is_exact::<Spatial, 3>("rssr");
    is_exact::<Spatial, 3>("spatial-chain-20");
    is_exact::<Spatial, 3>("six-joint-arm");
}

#[test]
fn the_scene_of_planar_rows_cuts_a_prismatic_joint_and_a_distance() {
    let (tree, _) = start::<Planar, 2>(&scene("planar-rows"));
    let rows = tree.mechanism().loops.rows;
    assert!(rows.iter().any(|row| matches!(row, Row::Gap { .. })), "{rows:?}");
    assert!(rows.iter().any(|row| matches!(row, Row::Length { .. })), "{rows:?}");
}

fn is_bound(name: &str, (bound, steps): (Operations, Vec<Operations>)) {
    for step in steps {
        assert!(step.products <= bound.products, "{name}: {step:?} {bound:?}");
        assert!(step.sums <= bound.sums, "{name}: {step:?} {bound:?}");
        assert!(step.quotients <= bound.quotients, "{name}: {step:?} {bound:?}");
        assert!(step.roots <= bound.roots, "{name}: {step:?} {bound:?}");
        assert!(step.turns <= bound.turns, "{name}: {step:?} {bound:?}");
    }
}

#[test]
fn couplings_stay_below_the_bound() {
    let text = include_str!("couplings.toml");
    for (sweeps, projections) in [(0, 1), (2, 2)] {
        let bounds = Bounds { evaluations: 2, sweeps, projections };
        is_bound("couplings", counted_of::<Planar, 2>(&mbs_testkit::scene(text), bounds));
    }
}

#[test]
fn curves_and_lines_stay_below_the_bound() {
    for (evaluations, sweeps, projections) in [(1, 0, 1), (2, 2, 2)] {
        let bounds = Bounds { evaluations, sweeps, projections };
        for text in [HOIST, &format!("{HOIST}{SUMS}")] {
            let counts = counted_of::<Planar, 2>(&mbs_testkit::scene(text), bounds);
            is_bound("hoist", counts);
        }
        let counts = counted_of::<Spatial, 3>(&mbs_testkit::scene(WINCH), bounds);
        is_bound("winch", counts);
    }
}

/// Returns a scene with a wheel, a ball and a blade of free bodies, in space or in the plane. They roll on the ground and on each other.
fn rolling(dimension: usize) -> String {
    let [at, inertia] = if dimension == 2 {
        ["[0.1, 0.3]", "0.02"]
    } else {
        ["[0.1, 0.0, 0.3]", "[0.02, 0.02, 0.02, 0.0, 0.0, 0.0]"]
    };
    let body = |name: &str| {
        format!("[[body]]\nname = \"{name}\"\nmass = 1.0\ncenter = {at}\ninertia = {inertia}\n")
    };
    let mut text = format!(
        "[scene]\nname = \"rolling\"\ndimension = {dimension}\nduration = 1.0\n{}{}",
        body("a"),
        body("b")
    );
    let axis = if dimension == 2 { "" } else { "axis = [0.0, 1.0, 0.1]\n" };
    let blade = at.replacen("0.1", "1.0", 1);
    for (kind, on) in [("wheel", "ground"), ("blade", "b")] {
        let shape = if kind == "wheel" {
            format!("center = {at}\n{axis}radius = 0.3\n")
        } else {
            format!("at = {at}\ndirection = {blade}\n")
        };
        text += &format!("[[rolling]]\nkind = \"{kind}\"\nbody = \"a\"\n{shape}on = \"{on}\"\n");
    }
    text + "[[initial]]\nbody = \"a\"\nangular_velocity = "
        + if dimension == 2 { "2.0\n" } else { "[0.1, 2.0, 0.3]\n" }
}

#[test]
fn rows_of_what_rolls_stay_below_the_bound() {
    for (evaluations, sweeps, projections) in [(1, 0, 1), (2, 2, 2)] {
        let bounds = Bounds { evaluations, sweeps, projections };
        let planar = mbs_testkit::scene(&rolling(2));
        is_bound("planar", counted_of::<Planar, 2>(&planar, bounds));
        let spatial = mbs_testkit::scene(&rolling(3));
        is_bound("spatial", counted_of::<Spatial, 3>(&spatial, bounds));
    }
}

#[test]
fn laws_on_sums_stay_below_the_bound() {
    // without couplings, because the counts of their rows are larger than the actual numbers of operations
    let text = include_str!("couplings.toml");
    let alone = text.split("[[coupling]]").next().expect("what stands before");
    let effect =
        "[[effect]]\nkind = \"torsion-spring\"\nstiffness = 9.0\ndamping = 0.3\nfree_value = 0.2\n";
    let of = |joint: &str| format!("{{ joint = \"{joint}\", factor = -1.5 }}");
    for joints in [&["a"][..], &["a", "b"], &["a", "b", "a", "b"]] {
        let terms: Vec<_> = joints.iter().map(|joint| of(joint)).collect();
        let text = format!("{alone}{effect}terms = [{}]\n", terms.join(", "));
        let bounds = Bounds { evaluations: 2, ..Bounds::default() };
        is_bound("sums", counted_of::<Planar, 2>(&mbs_testkit::scene(&text), bounds));
    }
}

#[test]
fn operations_on_signals_stay_below_the_bound() {
    for text in [ARM, LINE] {
        let bounds = Bounds { evaluations: 2, ..Bounds::default() };
        is_bound("signals", counted_of::<Planar, 2>(&mbs_testkit::scene(text), bounds));
    }
}

#[test]
fn a_train_of_wheels_on_one_carrier_costs_a_work_linear_in_its_length() {
    let products = |n: usize| {
        let mut text = String::from("[scene]\ndimension = 2\nduration = 1.0\n");
        let mut body = |name: &str, parent: &str, x: f64| {
            text += &format!(
                "[[body]]\nname = \"{name}\"\nmass = 1.0\ncenter = [{x:.2}, 0.0]\ninertia = 0.1\n\
                 [[joint]]\nname = \"j-{name}\"\nkind = \"revolute\"\nbodies = [\"{parent}\", \"{name}\"]\nat = [{x:.2}, 0.0]\n"
            );
        };
        body("carrier", "ground", 0.0);
        (0..n).for_each(|i| body(&format!("w{i}"), "carrier", 0.1 * (i + 1) as f64));
        for i in 1..n {
            let joints = format!("[\"j-w{}\", \"j-w{i}\"]", i - 1);
            text +=
                &format!("[[coupling]]\nkind = \"gear\"\njoints = {joints}\nteeth = [20, 21]\n");
        }
        let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(&text));
        let collected = Collected::new(&tree, &begin, &[]).expect("no signal moves");
        operation_bound::step(&collected.model(), Bounds::default()).products
    };
    let [ten, twenty, forty] = [10, 20, 40].map(products);
    assert_eq!(forty - twenty, 2 * (twenty - ten));
}

#[test]
fn effects_that_branch_stay_below_the_bound() {
    for name in ["iltis-slalom", "iltis-ramp-steer-30", "iltis-suspension", "iltis-stairs"] {
        is_bound(name, counted::<Spatial, 3>(name, Bounds::default()));
    }
}

#[test]
fn a_wheel_on_and_above_roads_of_every_kind_stays_below_the_bound() {
    let car = include_str!("../../../scenes/quarter-car.toml");
    let given = "[{ kind = \"bump\", start = 5.0, length = 5.0, amplitude = 0.02 }]";
    assert!(car.contains(given), "the road of the scene is replaced");
    let table =
        "points = [[-2.0, 0.1], [-0.3, 0.02], [0.2, 0.0], [0.5, 0.04], [0.9, 0.01], [1.3, 0.2]]";
    for features in [
        "[{ kind = \"bump\", start = -0.3, length = 1.0, amplitude = 0.05 }]",
        "[{ kind = \"ramp\", start = 0.1, length = 0.6, height = 0.1, rounding = 0.3 }]",
        "[{ kind = \"stairs\", start = 0.1, tread = 0.1, riser = 0.3, height = 0.05, count = 3 }]",
        &format!("[{{ kind = \"table\", {table} }}]"),
        &format!("[{{ kind = \"table\", {table} }}, {{ kind = \"flat\", height = -0.1 }}]"),
        "[{ kind = \"bump\", start = -0.2, length = 0.8, amplitude = 0.03 }, \
          { kind = \"bump\", start = 0.2, length = 0.8, amplitude = 0.03 }]",
    ] {
        for height in ["0.0", "0.4"] {
            let above =
                format!("[[initial]]\njoint = \"wheel-slide\"\nvalue = {height}\nrate = 0.0\n");
            let text = car.replace(given, features) + &above;
            let counts = counted_of::<Planar, 2>(&mbs_testkit::scene(&text), Bounds::default());
            is_bound(&format!("{features} from {height} m"), counts);
        }
    }
}

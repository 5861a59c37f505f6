//! The bound, by a number that counts what is done with it.

#[path = "support/counted.rs"]
mod counted;
mod support;

use counted::{Counted, done};
use mbs_core::scene::Scene;
use mbs_nostd::bound::{self, Operations};
use mbs_nostd::export::{Gathered, bytes};
use mbs_nostd::record::Axes;
use mbs_nostd::{Bounds, Planar, Solver, Spatial, Tables, Unwatched};
use mbs_recursive::rows::Row;
use support::{file, read, start};

type Room<S> = Solver<Counted, S, 64, 80, 48, 160, 4096, 4096, 2, 8>;
type RoomTables<S> = Tables<Counted, S, 64, 48, 160, 512, 64, 64, 8, 80>;

/// A scene of the repository or of this test.
fn scene(name: &str) -> Scene<f64> {
    if name == "planar-rows" { read(include_str!("planar-rows.toml"), name) } else { file(name) }
}

/// Counts each of some steps of a scene beside the bound.
fn counted<S: Axes<Counted> + Axes<f64>, const D: usize>(
    name: &str,
    bounds: Bounds,
) -> (Operations, Vec<Operations>) {
    let (tree, begin) = start::<S, D>(&scene(name));
    let gathered = Gathered::new(&tree, &begin, &[]);
    let text = bytes(&gathered.model(), false).expect("a scene without own laws");
    // The same numbers again, as counting ones.
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
    (bound::step(model.model(), bounds), steps)
}

fn is_exact<S: Axes<Counted> + Axes<f64>, const D: usize>(name: &str) {
    for (evaluations, sweeps, projections) in [(1, 0, 1), (2, 1, 1), (3, 0, 2)] {
        let bounds = Bounds { evaluations, sweeps, projections };
        let (bound, steps) = counted::<S, D>(name, bounds);
        // The first steps from rest may not turn yet.
        for step in &steps[3..] {
            assert_eq!(*step, bound, "{name} {bounds:?}");
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

fn is_bound(name: &str) {
    let (bound, steps) = counted::<Spatial, 3>(name, Bounds::default());
    for step in steps {
        assert!(step.products <= bound.products, "{name}: {step:?} {bound:?}");
        assert!(step.sums <= bound.sums, "{name}: {step:?} {bound:?}");
        assert!(step.quotients <= bound.quotients, "{name}: {step:?} {bound:?}");
        assert!(step.roots <= bound.roots, "{name}: {step:?} {bound:?}");
        assert!(step.turns <= bound.turns, "{name}: {step:?} {bound:?}");
    }
}

#[test]
fn effects_that_branch_stay_below_the_bound() {
    for name in ["iltis-slalom", "iltis-ramp-steer-30", "iltis-suspension", "iltis-stairs"] {
        is_bound(name);
    }
}

//! Comparison with the augmented Lagrangian, which solves the same equations of a step by another method, and invariances of a motion.

use crate::common::{Index, Run, distance};
use mbs_classical::{Options, StepError};
use mbs_core::model::{Model, Owner};
use mbs_core::scene::Scene;
use mbs_core::step::Step;
use mbs_testkit::retell::{turn_scene, turned};
use mbs_testkit::scenes::{
    CHAIN, DOUBLE, FREE, GUIDED, N_FOUR_BAR, REDUNDANT, SIMPLE, SLIDER, TOP, TWO_FOUR_BARS,
};
use mbs_testkit::{PLANAR, SPATIAL, centres, scene, scene_in, solver, start};

/// Allowed difference of two solutions of the same step equations, over some hundred steps of a regular motion [m].
const SAME: f64 = 1e-9;
/// Allowed difference [m] where rounding errors grow with the motion, or where the projections leave different residuals.
const NEAR: f64 = 1e-7;

/// Returns the centres of mass and the work after `n` steps of the augmented Lagrangian.
fn augmented<const D: usize>(scene: &Scene<f64>, dt: f64, n: usize) -> (Vec<[f64; 3]>, f64) {
    let (model, mut state) = start::<D>(scene);
    let mut w = mbs_augmented::Workspace::new(&model, solver(&model));
    let options = mbs_augmented::Options::index3();
    for i in 0..n {
        let size = Step { dt, length: model.length() };
        mbs_augmented::index3::step(&model, size, &options, &mut state, &mut w)
            .unwrap_or_else(|e| panic!("{}: step {i}: {e}", scene.name));
    }
    (centres(scene, &model, &state), state.work)
}

#[track_caller]
fn assert_same<const D: usize>(text: &str, (dt, n): (f64, usize), tolerance: f64) {
    let scene = scene(text);
    let run = Run::<f64, D>::new(&scene, Index::Three).steps(dt, n);
    let (points, work) = augmented::<D>(&scene, dt, n);
    let off = distance(&run.points(), &points);
    assert!(off < tolerance, "{}: {off:e} m", scene.name);
    let worth = work.abs().max(1.0);
    assert!((run.state.work - work).abs() < tolerance * 10.0 * worth, "{}", scene.name);
}

#[test]
fn index3_moves_as_the_augmented_lagrangian_does() {
    assert_same::<2>(&SIMPLE, (1e-3, 1000), SAME);
    assert_same::<2>(&DOUBLE, (1e-3, 500), SAME);
    assert_same::<2>(&SLIDER, (1e-3, 500), NEAR);
    assert_same::<2>(&GUIDED, (1e-3, 500), SAME);
    assert_same::<2>(&N_FOUR_BAR, (1e-3, 500), SAME);
    assert_same::<2>(&TWO_FOUR_BARS, (1e-3, 1500), NEAR);
    assert_same::<3>(&FREE, (1e-3, 500), SAME);
    assert_same::<3>(&TOP, (1e-3, 500), NEAR);
    assert_same::<3>(&CHAIN, (1e-3, 200), NEAR);
}

#[test]
fn index3_moves_alike_with_every_effect_and_guide() {
    fn check<const D: usize>(text: &str, regularisation: Option<f64>) {
        let scene = scene(text);
        let mut run = Run::<f64, D>::new(&scene, Index::Three);
        run.options.regularisation = regularisation;
        let run = run.steps(1e-3, 100);
        let (points, work) = augmented::<D>(&scene, 1e-3, 100);
        let off = distance(&run.points(), &points);
        assert!(off < NEAR, "{}: {off:e} m", scene.name);
        // The classical reactions balance the forces at the projected velocities. This changes the work by 8 to 20 dt^2.
        assert!(
            (run.state.work - work).abs() < 4e-5,
            "{}: {} J, {work} J",
            scene.name,
            run.state.work
        );
    }
    check::<2>(PLANAR, Some(1e-8));
    check::<3>(SPATIAL, None);
}

#[test]
fn index1_is_as_near_to_index3_as_their_steps_are_to_the_motion() {
    for text in [&*DOUBLE, &SLIDER, &GUIDED] {
        let scene = scene(text);
        let off = |dt: f64, n: usize| {
            let one = Run::<f64, 2>::new(&scene, Index::One).steps(dt, n);
            let three = Run::<f64, 2>::new(&scene, Index::Three).steps(dt, n);
            distance(&one.points(), &three.points())
        };
        let (coarse, fine) = (off(1e-3, 500), off(5e-4, 1000));
        assert!(fine < 1e-4 && fine < coarse / 3.0 + SAME, "{}: {coarse:e}, {fine:e}", scene.name);
    }
}

/// A planar four-bar linkage whose coupler has neither mass nor inertia.
const MASSLESS: &str = "[scene]\nname = \"massless link\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n[[body]]\nname = \"left\"\nmass = 1.0\ncenter = [0.0, 0.5]\ninertia = 0.1\n[[body]]\nname = \"right\"\nmass = 1.0\ncenter = [1.0, 0.5]\ninertia = 0.1\n[[body]]\nname = \"link\"\nmass = 0.0\ncenter = [0.5, 1.0]\ninertia = 0.0\n[[joint]]\nname = \"a\"\nkind = \"revolute\"\nbodies = [\"ground\", \"left\"]\nat = [0.0, 0.0]\n[[joint]]\nname = \"b\"\nkind = \"revolute\"\nbodies = [\"ground\", \"right\"]\nat = [1.0, 0.0]\n[[joint]]\nname = \"c\"\nkind = \"revolute\"\nbodies = [\"left\", \"link\"]\nat = [0.0, 1.0]\n[[joint]]\nname = \"d\"\nkind = \"revolute\"\nbodies = [\"link\", \"right\"]\nat = [1.0, 1.0]\n[[initial]]\njoint = \"a\"\nvalue = 0.4\nrate = 2.0\n";

#[test]
fn a_body_without_mass_is_no_matter() {
    assert_same::<2>(MASSLESS, (1e-3, 500), SAME);
    Run::<f64, 2>::new(&scene(MASSLESS), Index::One).steps(1e-3, 100);
}

#[test]
fn redundant_constraints_are_refused_by_name_and_nothing_changed() {
    for index in [Index::One, Index::Three] {
        let mut run = Run::<f64, 3>::new(&scene(&REDUNDANT), index);
        let before = run.state.clone();
        let error = run.step(1e-3).expect_err("three conditions are redundant");
        let StepError::RankLost { row, pivot } = error else { panic!("{error}") };
        assert!(pivot.abs() < 1e-12, "{pivot:e}");
        // Joints share points and axes. So the redundant rows are rows of the three bodies of the loop, not of the joints.
        let owner = Model::<f64>::owner_of_row(&run.model, row as usize);
        assert!(matches!(owner, Owner::Body(0..=2)), "{owner:?}");
        assert_eq!(run.state, before);
    }
}

#[test]
fn regularised_redundant_constraints_move_as_the_augmented_lagrangian_does() {
    let scene = scene(&REDUNDANT);
    let (expected, _) = augmented::<3>(&scene, 1e-3, 500);
    for regularisation in [1e-6, 1e-8, 1e-9] {
        let mut run = Run::<f64, 3>::new(&scene, Index::Three);
        run.options = Options { regularisation: Some(regularisation), ..Options::index3() };
        let run = run.steps(1e-3, 500);
        let off = distance(&run.points(), &expected);
        assert!(off < SAME, "{regularisation:e}: {off:e} m");
        let most = run.state.lambda.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(most < 100.0, "{regularisation:e}: multipliers grow to {most:e} N");
    }
}

#[test]
fn regularisation_does_not_change_a_motion_without_redundancy() {
    let scene = scene(&SLIDER);
    let expected = Run::<f64, 2>::new(&scene, Index::Three).steps(1e-3, 300).points();
    let mut run = Run::<f64, 2>::new(&scene, Index::Three);
    run.options.regularisation = Some(1e-6);
    assert!(distance(&run.steps(1e-3, 300).points(), &expected) < NEAR);
}

#[test]
fn a_turned_scene_moves_alike() {
    for text in [&*CHAIN, &TOP] {
        let plain = scene(text);
        let other = turn_scene(&plain);
        for index in [Index::One, Index::Three] {
            let expected: Vec<_> = Run::<f64, 3>::new(&plain, index).steps(1e-3, 200).points();
            let expected: Vec<_> = expected.into_iter().map(turned).collect();
            let found = Run::<f64, 3>::new(&other, index).steps(1e-3, 200).points();
            let off = distance(&found, &expected);
            assert!(off < NEAR, "{}: {off:e} m", plain.name);
        }
    }
}

#[test]
fn single_precision_stays_near_double_precision() {
    // Error that single precision may cause in half a second [m].
    const SINGLE: f64 = 1e-3;
    let expected = Run::<f64, 2>::new(&scene(&DOUBLE), Index::Three).steps(2e-3, 250).points();
    let found = Run::<f32, 2>::new(&scene_in(&DOUBLE), Index::Three).steps(2e-3, 250).points();
    assert!(distance(&found, &expected) < SINGLE);
    let expected = Run::<f64, 3>::new(&scene(&TOP), Index::Three).steps(1e-3, 300).points();
    let found = Run::<f32, 3>::new(&scene_in(&TOP), Index::Three).steps(1e-3, 300).points();
    assert!(distance(&found, &expected) < SINGLE);
}

#[test]
fn a_dense_solver_gives_the_same_motion() {
    use mbs_classical::{Saddle, Workspace, index3};
    let scene = scene(&SLIDER);
    let expected = Run::<f64, 2>::new(&scene, Index::Three).steps(1e-3, 100).points();
    let mut run = Run::<f64, 2>::new(&scene, Index::Three);
    let solver = mbs_core::dense::Dense::new(&Saddle::new(&run.model));
    let mut w = Workspace::new(&run.model, solver);
    for _ in 0..100 {
        let size = Step { dt: 1e-3, length: run.model.length() };
        index3::step(&run.model, size, &run.options, &mut run.state, &mut w).unwrap();
    }
    assert!(distance(&run.points(), &expected) < SAME);
}

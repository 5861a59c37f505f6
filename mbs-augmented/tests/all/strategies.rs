//! Each strategy of index-3, compared with a closed form or with exact counts; docs/INDEX3.md names these tests.
#![allow(clippy::print_stdout, reason = "what is measured is shown with --nocapture")]

use mbs_augmented::{Options, Workspace, index3};
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{BodyId, Scene};
use mbs_core::step::Step;
use mbs_sparse::Multifrontal;
use mbs_testkit::{dot, file, in_null_space, invariant, jacobian, solver, start};

type Work = Workspace<f64, Multifrontal<f64>>;

/// Makes `n` steps of `dt` [s]. Returns the numbers of iterations, factorisations and solutions.
fn run<const D: usize>(
    scene: &Scene<f64>,
    (dt, n): (f64, u32),
    options: &Options<f64>,
    mut each: impl FnMut(&NaturalModel<f64, D>, &State<f64>, &Work),
) -> [u32; 3] {
    let (model, mut state) = start::<D>(scene);
    let mut work = Workspace::new(&model, solver(&model));
    let step = Step { dt, length: model.length() };
    let mut counts = [0; 3];
    for k in 0..n {
        let report = index3::step(&model, step, options, &mut state, &mut work)
            .unwrap_or_else(|e| panic!("{}: step {k}: {e}", scene.name));
        let of_step = [report.iterations, report.factorizations, report.solves];
        counts.iter_mut().zip(of_step).for_each(|(sum, count)| *sum += count);
        each(&model, &state, &work);
    }
    println!("{}: {n} steps of {dt} s: {counts:?}", scene.name);
    counts
}

/// Contraction of a correction with one row: with s = c m, (1 + s J M^-1 J^T)^-1 = 1 / (1 + c). The predicted row is longer by 1e-6 of its
/// length.
#[test]
fn a_correction_leaves_one_part_in_1_plus_c_whatever_mass_and_step() {
    let mut scene = file("simple-pendulum");
    for mass in [1e-3, 1.0, 1e3] {
        scene.bodies[0].mass = mass;
        for dt in [1e-2, 1e-5] {
            run::<2>(&scene, (dt, 2), &Options::index3(), |_, _, work| {
                let left = work.history().contraction * (1.0 + 1e6);
                assert!((left - 1.0).abs() < 1e-4, "{mass} kg, {dt} s: {left}");
            });
        }
    }
}

/// With steps of 1/700 s, one step ends close to a singular position. There the penalties of regular motion do not determine one
/// multiplier, and corrections do not shrink.
#[test]
fn steps_that_end_next_to_a_singular_position_converge_with_penalties_raised_for_it() {
    let mut factor = 0.0_f64;
    run::<2>(&file("two-four-bars"), (1.0 / 700.0, 600), &Options::index3(), |_, _, work| {
        factor = factor.max(work.history().penalty_factor);
    });
    println!("largest penalty factor: {factor:e}");
    assert!(factor > 1e3, "{factor:e}");
}

/// Relative difference of the energy error between the two strategies of projection, for the double pendulum at 1e-2 s [-]. The energy
/// error is 4e-3 J. With a factor from before a large correction, the energy error would differ by 6e-4 of its size.
const SAME_ENERGY: f64 = 1e-6;

#[test]
fn a_reused_factor_projects_as_an_exact_one_does() {
    let of = |adaptive_penalty| {
        let (mut first, mut error) = (None, 0.0);
        let options = Options { adaptive_penalty, ..Options::index3() };
        run::<2>(&file("double-pendulum"), (1e-2, 100), &options, |model, state, _| {
            let energy = invariant(model, state);
            error = energy - *first.get_or_insert(energy);
        });
        error
    };
    // without an adapted penalty all projections are exact
    let (reused, exact) = (of(true), of(false));
    assert!((reused - exact).abs() < SAME_ENERGY * exact.abs(), "{reused:e} J, {exact:e} J");
}

/// A step under constraints alone has one factor. It serves two corrections, the power iteration for the penalties and both projections. A
/// second factor would show that corrections or projections need one of their own. A third correction would show that multipliers start
/// from zero. On the two four-bars, velocities would need two sweeps if the first sweep were not scaled.
#[test]
fn a_step_under_constraints_alone_has_one_factor_two_corrections_and_a_sweep_at_each_level() {
    let counts = |name| run::<2>(&file(name), (1e-3, 100), &Options::index3(), |_, _, _| {});
    assert_eq!(counts("n-four-bar-10"), [200, 100, 500]);
    assert_eq!(counts("two-four-bars"), [200, 100, 500]);
}

/// A step under effects has two factors: one for its corrections, and one of the mass for its projections. Steps in which wheels reach the
/// bump have more, because the tangents of the tires change there. Corrections end below the truncation error of the rule. With the tolerance
/// alone there would be 273 corrections.
///
/// The vehicle and its motion are symmetric. Only rounding errors move it off its plane, unless a projection is not orthogonal in the mass.
/// With projections by the factor of the corrections it moves off by 1e-5 m.
#[test]
fn a_vehicle_meets_a_bump_in_few_factors_and_stays_in_its_plane() {
    let mut off = 0.0_f64;
    let options = Options::index3();
    let counts = run::<3>(&file("iltis-bump-5"), (1e-2, 60), &options, |model, state, _| {
        let origin = model.point(BodyId::Body(0), [0.0; 3]).value(&state.q);
        off = off.max(origin[1].abs());
    });
    assert!(off < 1e-9, "{off:e} m off its plane");
    assert_eq!(counts, [233, 142, 706]);
}

/// Multipliers x with J^T x = 0 are not determined by the motion. Without the filter, extrapolation lets them grow to nearly all of the
/// multipliers. The test measures the part of the multipliers that is orthogonal, in the metric 1 / s, to the determined multipliers.
#[test]
fn multipliers_that_no_constraint_determines_do_not_grow() {
    let mut most = 0.0_f64;
    run::<3>(&file("spatial-four-bar"), (1e-3, 500), &Options::index3(), |model, state, _| {
        let (mut terms, mut reference) = (model.terms(), vec![0.0; model.n_extended()]);
        let mut masses = vec![0.0; model.n_constraints()];
        model.write_reference(&mut reference);
        model.evaluate(&reference, &mut terms);
        model.effective_masses(&terms, &mut masses);
        let roots: Vec<f64> = masses.iter().map(|m| m.sqrt()).collect();
        model.evaluate(&state.q, &mut terms);
        let rows = jacobian(model, &terms);
        let column = |i: usize| rows.iter().zip(&roots).map(|(row, root)| row[i] * root).collect();
        let columns: Vec<Vec<f64>> = (0..rows[0].len()).map(column).collect();
        let scaled: Vec<f64> = state.lambda.iter().zip(&roots).map(|(x, root)| x / root).collect();
        let free = in_null_space(&columns, &scaled);
        most = most.max((dot(&free, &free) / dot(&scaled, &scaled)).sqrt());
    });
    println!("undetermined part of the multipliers: {most:e}");
    assert!(most < 1e-2, "{most:e}");
}

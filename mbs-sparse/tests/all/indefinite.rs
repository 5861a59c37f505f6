//! Saddle systems compared with a dense solution: multipliers without diagonal, coordinates without mass, delayed pivots, and singular
//! matrices, for which the error names an unknown.

use crate::common::{Random, Saddle, Sum};
use mbs_math::blocks::Inertia;
use mbs_math::dense::Dense;
use mbs_math::dense::front::Thresholds;
use mbs_sparse::{Indefinite, Options, Real, SymmetricSolver};
use proptest::prelude::*;

/// Allowed residual of a stable factorisation, relative to |T| |x| [-]: EPSILON times growth, with a margin for 100 unknowns.
const BACKWARD: f64 = 1e-12;
/// Allowed residual of a stable factorisation in single precision, relative to |T| |x| [-].
const BACKWARD_F32: f64 = 5e-4;
/// Allowed error of the components of a null vector [-]. The error comes from a pivot of a few rounding units.
const NULL: f64 = 1e-10;

fn every_option() -> [Options; 2] {
    [Options::default(), Options { dense_up_to: 0, ..Options::default() }]
}

fn norm(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// Returns the largest row sum of |T|.
fn norm_of(saddle: &Saddle) -> f64 {
    let t = saddle.sum.dense();
    let n = saddle.sum.n;
    (0..n).map(|i| t[i * n..(i + 1) * n].iter().map(|x| x.abs()).sum()).fold(0.0, f64::max)
}

fn right_hand_side(n: usize) -> Vec<f64> {
    let mut random = Random(7);
    (0..n).map(|_| random.next()).collect()
}

/// Returns the backward error |b - T x| / (|T| |x| + |b|).
fn backward_error(saddle: &Saddle, x: &[f64], b: &[f64]) -> f64 {
    let product = saddle.sum.times(x);
    let r: Vec<f64> = b.iter().zip(&product).map(|(b, p)| b - p).collect();
    norm(&r) / (norm_of(saddle) * norm(x) + norm(b))
}

fn solve<T: Real, S: SymmetricSolver<T>>(solver: &mut S, saddle: &Saddle, b: &[f64]) -> Vec<f64> {
    solver.factor(saddle).unwrap_or_else(|e| panic!("{e}"));
    let mut x: Vec<T> = b.iter().map(|&b| T::from_f64(b)).collect();
    let mut scratch = vec![T::ZERO; solver.n_scratch()];
    solver.solve(&mut x, &mut scratch);
    x.iter().map(|x| x.to_f64()).collect()
}

#[track_caller]
fn assert_solves(saddle: &Saddle) {
    let (n, m) = (saddle.n_primal, saddle.sum.n - saddle.n_primal);
    let b = right_hand_side(n + m);
    for is_told in [true, false] {
        let told = Saddle { n_primal: if is_told { n } else { n + m }, ..saddle.clone() };
        for options in every_option() {
            let mut solver = Indefinite::<f64>::analyse(&told, options);
            let x = solve(&mut solver, saddle, &b);
            let error = backward_error(saddle, &x, &b);
            assert!(error < BACKWARD, "{options:?}, told {is_told}: {error:e}");
            let inertia = Inertia { positive: n, negative: m, zero: 0 };
            assert_eq!(solver.inertia(), inertia, "told {is_told}");
        }
    }
    let mut dense = Dense::<f64>::new(saddle);
    let x = solve(&mut dense, saddle, &b);
    assert!(backward_error(saddle, &x, &b) < BACKWARD);
    assert_eq!(
        SymmetricSolver::<f64>::inertia(&dense),
        Inertia { positive: n, negative: m, zero: 0 }
    );
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    #[test]
    fn random_saddles_solve_as_a_dense_matrix_does(
        length in 1_usize..12, size in 4_usize..9, rows in 0_usize..3, seed in 0_u64..1_000_000,
    ) {
        let overlap = size / 2 - 1;
        assert_solves(&Saddle::chain((length, size, overlap), rows, seed));
    }

    #[test]
    fn random_saddles_without_any_order_solve_too(
        length in 1_usize..10, rows in 1_usize..3, seed in 0_u64..1_000_000,
    ) {
        assert_solves(&Saddle::chain((length, 7, 2), rows, seed).shuffled(seed));
    }
}

#[test]
fn stars_and_long_chains_solve() {
    assert_solves(&Saddle::star(5, 4, 2));
    assert_solves(&Saddle::star(9, 6, 3));
    assert_solves(&Saddle::chain((60, 12, 6), 5, 3));
}

#[test]
fn a_regular_saddle_delays_nothing() {
    for saddle in [Saddle::chain((40, 12, 6), 5, 3), Saddle::star(6, 8, 3)] {
        let mut solver = Indefinite::<f64>::analyse(&saddle, Options::default());
        solver.factor(&saddle).unwrap();
        assert_eq!(solver.delays().delayed, 0);
        assert_eq!(solver.delays().stored, solver.counters().stored);
        assert!(solver.counters().largest_front <= 30, "{:?}", solver.counters());
        assert!(solver.weakest().ratio > 1e-3);
    }
}

#[test]
fn coordinates_without_mass_that_rows_determine_are_solved() {
    // Every fourth coordinate has no mass. The rows of its element determine it.
    for rows in [2, 3] {
        let mut saddle = Saddle::chain((20, 9, 3), rows, 5);
        saddle.remove_mass(|u| u % 6 == 4);
        assert_solves(&saddle);
    }
}

#[test]
fn a_chain_of_pairs_without_diagonal_is_solved_by_pairs() {
    // The blocks [0 1; 1 0] form a chain without any diagonal entry.
    let n = 40;
    let cliques = (0..n - 1).map(|i| vec![i, i + 1]).collect();
    let blocks = (0..n - 1).map(|i| vec![0.0, if i % 2 == 0 { 1.0 } else { 0.7 }, 0.0]).collect();
    let sum = Sum { n: n as usize, cliques, blocks, residuals: Vec::new() };
    let saddle = Saddle { n_primal: sum.n, sum };
    let b = right_hand_side(saddle.sum.n);
    for options in every_option() {
        let mut solver = Indefinite::<f64>::analyse(&saddle, options);
        let x = solve(&mut solver, &saddle, &b);
        assert!(backward_error(&saddle, &x, &b) < BACKWARD);
        assert_eq!(solver.inertia(), Inertia { positive: 20, negative: 20, zero: 0 });
    }
}

#[test]
fn a_row_given_twice_is_named_whatever_the_scale() {
    for factor in [1.0, -3.0, 1e-4, 1e5] {
        for length in [1, 2, 15] {
            let mut saddle = Saddle::chain((length, 9, 3), 2, 5);
            let (first, copy) = saddle.repeat_row(length / 2, factor);
            for options in every_option() {
                let mut solver = Indefinite::<f64>::analyse(&saddle, options);
                let error = solver.factor(&saddle).expect_err("a row repeats another");
                assert!([first, copy].contains(&error.unknown), "{error}: {first}, {copy}");
                assert_eq!(solver.inertia().zero, 1);
                assert_eq!(error.unknown, solver.weakest().unknown);
                let (mut x, mut scratch) = (vec![0.0; saddle.sum.n], vec![0.0; solver.n_scratch()]);
                solver.null_vector(&mut x, &mut scratch);
                // The null vector has a one at the named row, -factor or -1/factor at the other row of the pair, and zeros elsewhere.
                let scale = norm(&x);
                let product = norm(&saddle.sum.times(&x)) / scale.min(1.0);
                assert!(product < NULL * norm_of(&saddle), "{product:e}");
                for (u, x) in x.iter().enumerate() {
                    let is_part = u as u32 == first || u as u32 == copy;
                    assert!(is_part || x.abs() < NULL * scale, "{u}: {x}");
                }
            }
        }
    }
}

#[test]
fn a_row_that_three_others_add_up_to_is_refused() {
    let mut saddle = Saddle::chain((8, 9, 3), 3, 5);
    let rows = saddle.add_sum_of_rows(3);
    let mut solver = Indefinite::<f64>::analyse(&saddle, Options::default());
    let error = solver.factor(&saddle).expect_err("rows depend on each other");
    assert!(rows.contains(&error.unknown), "{error}: {rows:?}");
}

#[test]
fn a_coordinate_that_nothing_determines_is_named() {
    let mut saddle = Saddle::chain((8, 6, 2), 1, 5);
    // Coordinate 9 is in element 2 only, and no row of that element contains it.
    saddle.remove_mass(|u| u == 9);
    saddle.clear_rows_at(9);
    for options in every_option() {
        let mut solver = Indefinite::<f64>::analyse(&saddle, options);
        let error = solver.factor(&saddle).expect_err("nothing holds coordinate 9");
        assert_eq!((error.unknown, error.pivot), (9, 0.0));
    }
}

#[test]
fn almost_dependent_rows_show_in_the_weakest_pivot() {
    let mut last = f64::INFINITY;
    for turn in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5] {
        let mut saddle = Saddle::chain((8, 9, 3), 2, 5);
        let (first, copy) = saddle.repeat_row(4, 1.0);
        saddle.turn_row(copy, turn);
        let mut solver = Indefinite::<f64>::analyse(&saddle, Options::default());
        solver.factor(&saddle).unwrap_or_else(|e| panic!("{turn}: {e}"));
        let weakest = solver.weakest();
        // The pivot is proportional to the square of the angle between the rows.
        assert!(weakest.ratio < 3.0 * turn * turn && weakest.ratio > 1e-4 * turn * turn);
        assert!(weakest.ratio < last && [first, copy].contains(&weakest.unknown));
        last = weakest.ratio;
    }
}

#[test]
fn the_order_inside_a_clique_does_not_matter() {
    let saddle = Saddle::chain((10, 8, 3), 2, 9);
    let b = right_hand_side(saddle.sum.n);
    let mut solver = Indefinite::<f64>::analyse(&saddle, Options::default());
    let expected = solve(&mut solver, &saddle, &b);
    let turned = saddle.with_turned_cliques();
    let mut solver = Indefinite::<f64>::analyse(&turned, Options::default());
    let x = solve(&mut solver, &turned, &b);
    let error = x.iter().zip(&expected).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
    assert!(error < 1e-10 * norm(&expected), "{error:e}");
}

#[test]
fn blocks_of_very_different_size_are_equilibrated() {
    let mut saddle = Saddle::chain((12, 9, 3), 2, 5);
    for (e, block) in saddle.sum.blocks.iter_mut().enumerate() {
        let factor = 10_f64.powi(3 * (e as i32 % 5) - 6);
        block.iter_mut().for_each(|x| *x *= factor);
    }
    assert_solves(&saddle);
}

#[test]
fn single_precision_solves_to_its_own_rounding() {
    for saddle in [Saddle::chain((20, 12, 6), 5, 3), Saddle::star(5, 4, 2)] {
        let b = right_hand_side(saddle.sum.n);
        let mut solver = Indefinite::<f32>::analyse(&saddle, Options::default());
        let x = solve(&mut solver, &saddle, &b);
        assert!(backward_error(&saddle, &x, &b) < BACKWARD_F32);
    }
}

#[test]
fn refinement_repairs_a_factorisation_with_loose_thresholds() {
    let mut saddle = Saddle::chain((30, 9, 3), 2, 11);
    saddle.shrink_mass(1e-6);
    let b = right_hand_side(saddle.sum.n);
    let thresholds = Thresholds { growth: 1e-9, ..Thresholds::default() };
    let solver = Indefinite::<f64>::analyse(&saddle, Options::default());
    let mut solver = solver.with_thresholds(thresholds);
    let mut x = solve(&mut solver, &saddle, &b);
    let before = backward_error(&saddle, &x, &b);
    let (mut r, mut scratch) = (b.clone(), vec![0.0; solver.n_scratch()]);
    solver.refine(&mut x, &mut r, &mut scratch);
    let after = backward_error(&saddle, &x, &b);
    assert!(after < 1e-15 && after <= before, "{before:e}, {after:e}");
}

#[test]
fn a_solver_recovers_after_a_failure() {
    let good = Saddle::chain((10, 9, 3), 2, 5);
    let mut bad = good.clone();
    bad.sum.blocks[3].fill(f64::NAN);
    let b = right_hand_side(good.sum.n);
    let mut solver = Indefinite::<f64>::analyse(&good, Options::default());
    let expected = solve(&mut solver, &good, &b);
    assert!(solver.factor(&bad).is_err());
    assert_eq!(solve(&mut solver, &good, &b), expected);
}

#[test]
fn no_unknowns_are_no_failure() {
    let sum = Sum { n: 0, cliques: vec![vec![]], blocks: vec![vec![]], residuals: vec![vec![]] };
    let saddle = Saddle { sum, n_primal: 0 };
    let mut solver = Indefinite::<f64>::analyse(&saddle, Options::default());
    solver.factor(&saddle).unwrap();
    solver.solve(&mut [], &mut []);
    assert_eq!(solver.inertia(), Inertia::default());
}

//! The dense solver, compared with solutions by hand.

use super::*;

/// Bound of the rounding errors of a few operations on numbers of order one [-].
const ROUNDING: f64 = 1e-14;

struct One {
    n: usize,
    block: Vec<f64>,
    clique: Vec<u32>,
}

impl Cliques for One {
    fn n_unknowns(&self) -> usize {
        self.n
    }
    fn n_elements(&self) -> usize {
        1
    }
    fn clique(&self, _: usize) -> &[u32] {
        &self.clique
    }
}

impl BlockSource<f64> for One {
    fn write_block(&self, _: usize, block: &mut [f64]) {
        block.copy_from_slice(&self.block);
    }
    fn write_residual(&self, _: usize, residual: &mut [f64]) {
        residual.fill(1.0);
    }
}

fn one(clique: &[u32], block: &[f64]) -> One {
    One { n: clique.len(), block: block.to_vec(), clique: clique.to_vec() }
}

fn solve(source: &One, b: &[f64]) -> (Dense<f64>, Vec<f64>) {
    let mut solver = Dense::new(source);
    SymmetricSolver::factor(&mut solver, source).expect("a regular matrix");
    let (mut x, mut scratch) = (b.to_vec(), vec![0.0; b.len()]);
    SymmetricSolver::solve(&solver, &mut x, &mut scratch);
    (solver, x)
}

#[test]
fn a_pair_without_any_diagonal_is_solved() {
    // System [0 2; 2 0] (x, y) = (6, 4): x = 2, y = 3.
    let (solver, x) = solve(&one(&[0, 1], &[0.0, 2.0, 0.0]), &[6.0, 4.0]);
    assert!((x[0] - 2.0).abs() < ROUNDING && (x[1] - 3.0).abs() < ROUNDING);
    assert_eq!(solver.inertia(), Inertia { positive: 1, negative: 1, zero: 0 });
}

#[test]
fn a_pendulum_hanging_still_has_its_weight_in_the_multiplier() {
    // System [[m, 0, 0], [0, m, -1], [0, -1, 0]] (x'', y'', lambda) = (0, -m g, 0): lambda = m g.
    let (m, g) = (3.0, 9.81);
    let (solver, x) = solve(&one(&[0, 1, 2], &[m, 0.0, 0.0, m, -1.0, 0.0]), &[0.0, -m * g, 0.0]);
    assert!(x[0].abs() < ROUNDING && x[1].abs() < ROUNDING);
    assert!((x[2] - m * g).abs() < 1e2 * ROUNDING);
    assert_eq!(solver.inertia(), Inertia { positive: 2, negative: 1, zero: 0 });
}

#[test]
fn the_order_of_a_clique_does_not_matter() {
    let (_, x) = solve(&one(&[1, 0], &[0.0, 2.0, 5.0]), &[1.0, 2.0]);
    // System T = [5 2; 2 0]: 2 x = 2, 5 x + 2 y = 1.
    assert!((x[0] - 1.0).abs() < ROUNDING && (x[1] + 2.0).abs() < ROUNDING);
}

#[test]
fn a_row_given_twice_is_named_with_its_combination() {
    // The system has M = 1 and two rows J = (1), (3) of one coordinate. Only the sum lambda_1 + 3 lambda_2 is determined.
    let source = one(&[0, 1, 2], &[1.0, 1.0, 3.0, 0.0, 0.0, 0.0]);
    let mut solver = Dense::new(&source);
    let error = SymmetricSolver::factor(&mut solver, &source).expect_err("singular");
    assert!(error.unknown == 1 || error.unknown == 2, "{error}");
    assert!(error.pivot.abs() < ROUNDING);
    assert_eq!(solver.inertia().zero, 1);
    let (mut x, mut scratch) = ([0.0; 3], [0.0; 3]);
    solver.null_vector(&mut x, &mut scratch);
    assert!(x[0].abs() < ROUNDING && (x[1] + 3.0 * x[2]).abs() < ROUNDING, "{x:?}");
    assert!((x[error.unknown as usize] - 1.0).abs() < ROUNDING);
}

#[test]
fn a_coordinate_without_mass_or_row_is_named() {
    let source = one(&[0, 1], &[1.0, 0.0, 0.0]);
    let mut solver = Dense::new(&source);
    let error = SymmetricSolver::factor(&mut solver, &source).expect_err("singular");
    assert_eq!(error, FactorError { unknown: 1, pivot: 0.0 });
}

#[test]
fn a_number_that_is_none_is_refused() {
    let source = one(&[0, 1], &[1.0, f64::NAN, 1.0]);
    let mut solver = Dense::new(&source);
    assert!(SymmetricSolver::factor(&mut solver, &source).is_err());
    assert!(SpdSolver::factor(&mut solver, &source).is_err());
}

#[test]
fn a_definite_matrix_has_its_pivots_in_order_and_an_indefinite_one_is_refused() {
    let source = one(&[0, 1], &[4.0, 2.0, 3.0]);
    let mut solver = Dense::new(&source);
    SpdSolver::factor(&mut solver, &source).expect("positive definite");
    assert_eq!(solver.pivots(), [4.0, 2.0]);
    let (mut x, mut scratch) = ([8.0, 7.0], [0.0; 2]);
    SpdSolver::solve(&solver, &mut x, &mut scratch);
    assert!((x[0] - 1.25).abs() < ROUNDING && (x[1] - 1.5).abs() < ROUNDING);
    let source = one(&[0, 1], &[1.0, 2.0, 1.0]);
    let error = SpdSolver::factor(&mut Dense::new(&source), &source);
    assert_eq!(error, Err(FactorError { unknown: 1, pivot: -3.0 }));
}

#[test]
fn a_refined_solution_is_a_solution() {
    let source = one(&[0, 1, 2], &[1e-8, 1.0, 0.0, 1e6, 2.0, 0.0]);
    let b = [1.0, 2.0, 3.0];
    let (solver, mut x) = solve(&source, &b);
    let (mut r, mut scratch) = (b, [0.0; 3]);
    solver.refine(&mut x, &mut r, &mut scratch);
    let mut r = b;
    solver.subtract_product(&x, &mut r);
    assert!(r.iter().all(|r| r.abs() < 1e-9), "{r:?} of 1e6");
}

//! The multifrontal solution compared with a dense one, for every kind of graph.

use crate::common::{Random, Sum, dense_solve};
use mbs_sparse::{Multifrontal, Options, Pivoting, SpdSolver};
use proptest::prelude::*;

/// Allowed difference of two solutions, relative to the largest entry [-]. It is a condition number below 1e3 times EPSILON, with a margin
/// for 100 unknowns.
const AGREE: f64 = 1e-11;
/// Allowed difference of two solutions in single precision, relative to the largest entry [-].
const AGREE_F32: f64 = 2e-3;

fn right_hand_side(n: usize) -> Vec<f64> {
    let mut random = Random(7);
    (0..n).map(|_| random.next()).collect()
}

fn solve(sum: &Sum, options: Options, b: &[f64]) -> Vec<f64> {
    let mut solver = Multifrontal::<f64>::analyse(sum, options);
    solver.factor(sum).expect("positive definite");
    let mut x = b.to_vec();
    let mut scratch = vec![f64::NAN; solver.n_scratch()];
    solver.solve(&mut x, &mut scratch);
    x
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let scale = b.iter().fold(f64::MIN_POSITIVE, |m, x| m.max(x.abs()));
    a.iter().zip(b).fold(0.0, |m: f64, (x, y)| m.max((x - y).abs())) / scale
}

fn all_options() -> [Options; 4] {
    let plain = Options::default();
    let pivoted = Options { pivoting: Pivoting::Diagonal, ..plain };
    [plain, pivoted, Options { dense_up_to: 0, ..plain }, Options { dense_up_to: 0, ..pivoted }]
}

fn assert_agrees_with_dense(sum: &Sum) {
    let b = right_hand_side(sum.n);
    let expected = dense_solve(&sum.dense(), &b);
    for options in all_options() {
        let error = distance(&solve(sum, options, &b), &expected);
        assert!(error < AGREE, "{options:?}: {error:e}");
    }
}

/// Returns random cliques of up to five unknowns; every unknown is in at least one.
fn random_cliques(n: usize, n_elements: usize, seed: u64) -> Vec<Vec<u32>> {
    let mut random = Random(seed);
    let mut cliques: Vec<Vec<u32>> = (0..n as u32).map(|u| vec![u]).collect();
    for _ in 0..n_elements {
        let mut clique = Vec::new();
        for _ in 0..1 + random.below(5) {
            let u = random.below(n) as u32;
            if !clique.contains(&u) {
                clique.push(u);
            }
        }
        cliques.push(clique);
    }
    cliques
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    #[test]
    fn random_sums_solve_as_a_dense_matrix_does(n in 1_usize..60, m in 0_usize..80, seed in 0_u64..1_000_000) {
        assert_agrees_with_dense(&Sum::random(n, random_cliques(n, m, seed), seed));
    }
}

#[test]
fn chains_and_stars_solve_as_a_dense_matrix_does() {
    assert_agrees_with_dense(&Sum::chain(1, 12, 6));
    assert_agrees_with_dense(&Sum::chain(2, 12, 6));
    assert_agrees_with_dense(&Sum::chain(20, 12, 6));
    assert_agrees_with_dense(&Sum::chain(40, 5, 2));
    assert_agrees_with_dense(&Sum::star(4, 6));
    assert_agrees_with_dense(&Sum::star(7, 3));
}

#[test]
fn separate_pieces_solve_as_a_dense_matrix_does() {
    let mut cliques: Vec<Vec<u32>> = (0..10).map(|i| vec![3 * i, 3 * i + 2, 3 * i + 1]).collect();
    cliques.extend((0..10).map(|i| vec![3 * i + 1]));
    assert_agrees_with_dense(&Sum::random(30, cliques, 3));
}

#[test]
fn one_unknown_is_one_division() {
    let sum = Sum { n: 1, cliques: vec![vec![0]], blocks: vec![vec![4.0]], ..Sum::default() };
    for options in all_options() {
        assert_eq!(solve(&sum, options, &[1.0]), [0.25]);
    }
}

#[test]
fn repeated_cliques_add_up() {
    let mut sum = Sum::chain(5, 6, 3);
    let once = solve(&sum, Options::default(), &right_hand_side(sum.n));
    let (cliques, blocks) = (sum.cliques.clone(), sum.blocks.clone());
    sum.cliques.extend(cliques);
    sum.blocks.extend(blocks);
    let twice = solve(&sum, Options::default(), &right_hand_side(sum.n));
    let doubled: Vec<f64> = twice.iter().map(|x| 2.0 * x).collect();
    assert!(distance(&doubled, &once) < AGREE);
}

#[test]
fn the_order_of_the_elements_changes_only_rounding() {
    let sum = Sum::star(5, 4);
    let mut turned = sum.clone();
    turned.cliques.reverse();
    turned.blocks.reverse();
    let b = right_hand_side(sum.n);
    for options in all_options() {
        assert!(distance(&solve(&turned, options, &b), &solve(&sum, options, &b)) < AGREE);
    }
}

#[test]
fn single_precision_solves_to_its_own_rounding() {
    let sum = Sum::chain(20, 12, 6);
    let expected = solve(&sum, Options::default(), &right_hand_side(sum.n));
    for options in all_options() {
        let mut solver = Multifrontal::<f32>::analyse(&sum, options);
        solver.factor(&sum).unwrap();
        let mut x: Vec<f32> = right_hand_side(sum.n).iter().map(|&b| b as f32).collect();
        let mut scratch = vec![0.0; solver.n_scratch()];
        solver.solve(&mut x, &mut scratch);
        let x: Vec<f64> = x.iter().map(|&x| f64::from(x)).collect();
        assert!(distance(&x, &expected) < AGREE_F32);
    }
}

#[test]
fn residuals_are_gathered_in_element_order() {
    let sum = Sum::star(3, 3);
    let mut solver = Multifrontal::<f64>::analyse(&sum, Options::default());
    let mut f = vec![f64::NAN; sum.n];
    solver.assemble(&sum, &mut f);
    let mut expected = vec![0.0; sum.n];
    for (clique, residual) in sum.cliques.iter().zip(&sum.residuals) {
        for (&u, r) in clique.iter().zip(residual) {
            expected[u as usize] += r;
        }
    }
    assert_eq!(f, expected);
}

//! Properties of the analysis: the order is a permutation, and the pivots belong to it. Fill and fronts do not grow faster than the size of
//! the model.

use crate::common::{Random, Sum};
use mbs_sparse::{Counters, Multifrontal, Options, Pivoting, SpdSolver};

/// Allowed relative difference of pivots, which are sums of at most a hundred products [-].
const ROUNDING: f64 = 1e-11;

fn counters(sum: &Sum) -> Counters {
    Multifrontal::<f64>::analyse(sum, Options::default()).counters()
}

/// Returns the pivots of the dense elimination of `t` in the order `order`.
fn dense_pivots(t: &[f64], order: &[u32]) -> Vec<f64> {
    let n = order.len();
    let mut a: Vec<f64> =
        (0..n * n).map(|k| t[order[k / n] as usize * n + order[k % n] as usize]).collect();
    for k in 0..n {
        for i in k + 1..n {
            let l = a[i * n + k] / a[k * n + k];
            for j in k + 1..n {
                a[i * n + j] -= l * a[k * n + j];
            }
        }
    }
    (0..n).map(|k| a[k * n + k]).collect()
}

#[test]
fn pivots_are_those_of_the_stated_order() {
    for sum in [Sum::chain(1, 9, 3), Sum::chain(20, 12, 6), Sum::star(5, 4)] {
        for pivoting in [Pivoting::None, Pivoting::Diagonal] {
            let options = Options { pivoting, ..Options::default() };
            let mut solver = Multifrontal::<f64>::analyse(&sum, options);
            solver.factor(&sum).unwrap();
            let mut sorted = solver.elimination_order().to_vec();
            sorted.sort_unstable();
            assert!(sorted.iter().enumerate().all(|(k, &u)| k == u as usize));
            let expected = dense_pivots(&sum.dense(), solver.elimination_order());
            for (pivot, expected) in solver.pivots().iter().zip(&expected) {
                assert!((pivot - expected).abs() <= ROUNDING * expected, "{pivot} {expected}");
            }
        }
    }
}

#[test]
fn diagonal_pivoting_takes_the_largest_first() {
    let blocks = vec![vec![2.0, 0.0, 0.0, 5.0, 0.0, 3.0]];
    let sum = Sum { n: 3, cliques: vec![vec![0, 1, 2]], blocks, ..Sum::default() };
    let options = Options { pivoting: Pivoting::Diagonal, ..Options::default() };
    let mut solver = Multifrontal::<f64>::analyse(&sum, options);
    solver.factor(&sum).unwrap();
    assert_eq!(solver.elimination_order(), [1, 2, 0]);
    assert_eq!(solver.pivots(), [5.0, 3.0, 2.0]);
}

#[test]
fn a_dense_front_counts_its_textbook_flops() {
    // n divisions, n (n - 1) / 2 scalings and twice (n - 1) n (n + 1) / 6 multiply-subtracts: 4 + 6 + 20.
    let c = counters(&Sum::random(4, vec![vec![0, 1], vec![0, 1, 2, 3]], 1));
    assert_eq!((c.n, c.n_elements, c.n_fronts, c.largest_front), (4, 2, 1, 4));
    assert_eq!((c.nonzeros, c.flops, c.extend_adds), (10, 30, 0));
}

#[test]
fn a_chain_has_no_fill() {
    // 19 fronts of 6 pivots and 12 unknowns, and one of 12 pivots: L has the entries of the blocks and no others.
    let c = counters(&Sum::chain(20, 12, 6));
    assert_eq!((c.n, c.n_fronts, c.largest_front), (126, 20, 12));
    assert_eq!(c.nonzeros, 19 * (21 + 36) + 78);
}

#[test]
fn sixty_thousand_unknowns_of_a_chain_keep_small_fronts() {
    let sum = Sum::chain(10_000, 12, 6);
    let c = counters(&sum);
    assert_eq!(c.n, 60_006);
    assert_eq!(c.nonzeros, 9_999 * (21 + 36) + 78);
    assert_eq!(c.largest_front, 12);
}

#[test]
fn a_hub_of_many_branches_is_eliminated_last() {
    let c = counters(&Sum::star(100, 27));
    assert!(c.largest_front <= 18, "{c:?}");
    assert!(c.nonzeros < 60 * c.n / 6, "{c:?}");
}

#[test]
fn fill_of_a_net_grows_less_than_its_size_to_the_power_of_three_halves() {
    let net = |m: u32| {
        let at = |i: u32, j: u32| i * m + j;
        let squares = (0..m - 1).flat_map(|i| {
            (0..m - 1).map(move |j| vec![at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)])
        });
        Sum::random((m * m) as usize, squares.collect(), 4)
    };
    let (small, large) = (counters(&net(20)), counters(&net(40)));
    assert!(large.nonzeros < 8 * small.nonzeros, "{small:?} {large:?}");
}

#[test]
fn large_models_solve_to_rounding() {
    let mut random = Random(3);
    let sum = Sum::star(30, 300);
    let expected: Vec<f64> = (0..sum.n).map(|_| random.next()).collect();
    let mut x = sum.times(&expected);
    let mut solver = Multifrontal::<f64>::analyse(&sum, Options::default());
    solver.factor(&sum).unwrap();
    let mut scratch = vec![0.0; solver.n_scratch()];
    solver.solve(&mut x, &mut scratch);
    let error = x.iter().zip(&expected).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
    assert!(error < ROUNDING, "{error:e}");
}

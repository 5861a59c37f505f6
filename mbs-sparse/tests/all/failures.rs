//! Matrices that are not positive definite are refused: the error has the unknown and its pivot.

use crate::common::Sum;
use mbs_sparse::{FactorError, Multifrontal, Options, Pivoting, SpdSolver};

fn every_option() -> [Options; 4] {
    let plain = Options::default();
    let pivoted = Options { pivoting: Pivoting::Diagonal, ..plain };
    [plain, pivoted, Options { dense_up_to: 0, ..plain }, Options { dense_up_to: 0, ..pivoted }]
}

fn failure(sum: &Sum, options: Options) -> FactorError {
    Multifrontal::<f64>::analyse(sum, options).factor(sum).expect_err("not positive definite")
}

#[test]
fn an_unknown_of_no_element_is_named() {
    let mut sum = Sum::chain(4, 6, 3);
    let lonely = sum.n as u32;
    sum.n += 1;
    for options in every_option() {
        assert_eq!(failure(&sum, options), FactorError { unknown: lonely, pivot: 0.0 });
    }
}

#[test]
fn many_unknowns_of_no_element_do_not_become_one_dense_front() {
    let sum = Sum { n: 50_000, ..Sum::default() };
    let mut solver = Multifrontal::<f64>::analyse(&sum, Options::default());
    assert_eq!(solver.counters().largest_front, 1);
    assert_eq!(solver.factor(&sum), Err(FactorError { unknown: 0, pivot: 0.0 }));
}

#[test]
fn an_indefinite_sum_is_refused() {
    // [1 2; 2 1] has the eigenvalues 3 and -1; its second pivot is 1 - 2 * 2.
    let blocks = vec![vec![1.0, 2.0, 1.0]];
    let sum = Sum { n: 2, cliques: vec![vec![0, 1]], blocks, ..Sum::default() };
    for options in every_option() {
        assert_eq!(failure(&sum, options), FactorError { unknown: 1, pivot: -3.0 });
    }
}

#[test]
fn a_number_that_is_none_is_refused() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mut sum = Sum::chain(20, 12, 6);
        sum.blocks[7][0] = bad;
        for options in every_option() {
            assert!(!failure(&sum, options).pivot.is_finite());
        }
    }
}

#[test]
fn a_solver_recovers_after_a_failure() {
    let good = Sum::chain(20, 12, 6);
    let mut bad = good.clone();
    bad.blocks[3][0] = -1e3;
    for options in every_option() {
        let mut solver = Multifrontal::<f64>::analyse(&good, options);
        let mut fresh = solver.clone();
        assert!(solver.factor(&bad).is_err());
        assert!(solver.factor(&good).is_ok());
        fresh.factor(&good).unwrap();
        assert_eq!(solver.pivots(), fresh.pivots());
    }
}

#[test]
fn no_unknowns_are_no_failure() {
    for options in every_option() {
        let sum = Sum { n: 0, cliques: vec![vec![]], ..Sum::default() };
        let sum = Sum { blocks: vec![vec![]], residuals: vec![vec![]], ..sum };
        let mut solver = Multifrontal::<f64>::analyse(&sum, options);
        solver.factor(&sum).unwrap();
        solver.assemble(&sum, &mut []);
        solver.solve(&mut [], &mut []);
        assert!(solver.pivots().is_empty());
    }
}

#[test]
#[should_panic(expected = "element 0 names unknown 2, but there are 2")]
fn an_unknown_outside_the_model_is_a_mistake_of_the_caller() {
    let sum = Sum { n: 2, cliques: vec![vec![0, 2]], ..Sum::default() };
    drop(Multifrontal::<f64>::analyse(&sum, Options::default()));
}

#[test]
#[should_panic(expected = "element 0 names unknown 1 twice")]
fn an_unknown_named_twice_is_a_mistake_of_the_caller() {
    let sum = Sum { n: 2, cliques: vec![vec![1, 1]], ..Sum::default() };
    drop(Multifrontal::<f64>::analyse(&sum, Options::default()));
}

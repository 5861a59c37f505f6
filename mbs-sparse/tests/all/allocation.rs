//! No memory is allocated after the analysis: a counting allocator counts zero calls in `factor`, `solve` and `assemble`.

use crate::common::{Saddle, Sum};
use mbs_sparse::{Indefinite, Multifrontal, Options, Pivoting, SpdSolver, SymmetricSolver};
use mbs_testkit::allocations as counter;

fn allocations(work: impl FnOnce()) -> u64 {
    let before = counter::count();
    work();
    counter::count() - before
}

#[test]
fn factor_solve_and_assemble_do_not_allocate() {
    assert_eq!(allocations(|| drop(std::hint::black_box(Box::new(1)))), 1);
    for sum in [Sum::chain(1, 4, 2), Sum::chain(30, 12, 6), Sum::star(6, 5)] {
        for pivoting in [Pivoting::None, Pivoting::Diagonal] {
            let options = Options { pivoting, ..Options::default() };
            let mut solver = Multifrontal::<f64>::analyse(&sum, options);
            let (mut x, mut scratch) = (vec![0.0; sum.n], vec![0.0; solver.n_scratch()]);
            let count = allocations(|| {
                solver.assemble(&sum, &mut x);
                solver.factor(&sum).unwrap();
                solver.solve(&mut x, &mut scratch);
                assert!(!solver.pivots().is_empty() && !solver.elimination_order().is_empty());
            });
            assert_eq!(count, 0);
        }
    }
}

/// Returns the allocations of a factorisation and of all calls that may follow it.
fn allocations_of(solver: &mut Indefinite<f64>, saddle: &Saddle) -> u64 {
    let n = saddle.sum.n;
    let (mut x, mut b, mut scratch) = (vec![0.0; n], vec![1.0; n], vec![0.0; solver.n_scratch()]);
    allocations(|| {
        solver.assemble(saddle, &mut x);
        solver.factor(saddle).expect("regular");
        solver.solve(&mut x, &mut scratch);
        solver.refine(&mut x, &mut b, &mut scratch);
        solver.null_vector(&mut b, &mut scratch);
        assert!(solver.weakest().ratio > 0.0 && solver.inertia().zero == 0);
    })
}

#[test]
fn a_saddle_without_delays_never_allocates() {
    for saddle in [Saddle::chain((1, 5, 2), 1, 3), Saddle::chain((30, 12, 6), 5, 3)] {
        let mut solver = Indefinite::<f64>::analyse(&saddle, Options::default());
        assert_eq!(allocations_of(&mut solver, &saddle), 0);
        assert_eq!(solver.delays().delayed, 0);
    }
}

#[test]
fn a_saddle_with_delays_allocates_at_most_once() {
    // This analysis does not know which unknowns are multipliers. So it places them too early.
    let mut saddle = Saddle::chain((60, 12, 6), 5, 3);
    saddle.n_primal = saddle.sum.n;
    let mut solver = Indefinite::<f64>::analyse(&saddle, Options::default());
    allocations_of(&mut solver, &saddle);
    assert!(solver.delays().delayed > 20, "{:?}", solver.delays());
    assert_eq!(allocations_of(&mut solver, &saddle), 0);
}

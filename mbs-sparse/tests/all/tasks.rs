//! Trees of fronts divided into tasks: the solution is right, and its bits are the same for every team.

use crate::common::{Forking, Sum};
use mbs_sparse::{Alone, Multifrontal, Options, Ordering, Pivoting, SpdSolver, Team};

fn sums() -> Vec<(&'static str, Sum)> {
    vec![
        ("chain", Sum::chain(60, 12, 6)),
        ("chain of planar links", Sum::chain(90, 4, 2)),
        ("star", Sum::star(8, 12)),
        ("wide star", Sum::star(40, 3)),
        ("grid", Sum::grid(12, 15, 3)),
        ("tree", Sum::tree(7, 6)),
        ("forest", Sum::forest(9, 12)),
    ]
}

/// Returns the number of tasks, and the residual, solution and pivots of one factorisation.
fn solved<W: Team>(team: W, sum: &Sum, options: Options) -> (usize, [Vec<f64>; 3]) {
    let mut solver = Multifrontal::<f64, W>::on(team, sum, options);
    let mut f = vec![0.0; sum.n];
    solver.assemble(sum, &mut f);
    let mut x = f.clone();
    solver.factor(sum).expect("positive definite");
    let mut scratch = vec![f64::NAN; solver.n_scratch()];
    solver.solve(&mut x, &mut scratch);
    (solver.counters().n_tasks, [f, x, solver.pivots().to_vec()])
}

fn options() -> impl Iterator<Item = Options> {
    let grains = [0, 300, 1_000, 5_000, u64::MAX];
    grains.into_iter().flat_map(|grain| {
        [Pivoting::None, Pivoting::Diagonal].map(|pivoting| Options {
            grain,
            pivoting,
            ..Options::default()
        })
    })
}

#[test]
fn tasks_of_any_size_give_the_solution_of_the_sum() {
    for (name, sum) in sums() {
        for options in options() {
            let (n_tasks, [f, x, _]) = solved(Alone, &sum, options);
            let is_chain = name.starts_with("chain") && options.ordering == Ordering::Chosen;
            let is_cut = options.grain <= 300 && !is_chain;
            assert!(!is_cut || n_tasks > 4, "{name}: {n_tasks}");
            assert!(options.grain < u64::MAX || n_tasks == 1, "{name}");
            // Blocks k I + sum g g^T have condition numbers below a hundred.
            let largest = f.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            for (b, f) in sum.times(&x).iter().zip(&f) {
                assert!((b - f).abs() < 1e-12 * largest, "{name}, {options:?}");
            }
        }
    }
}

#[test]
fn a_team_gives_the_bits_of_one() {
    for (name, sum) in sums() {
        for options in options() {
            let (n_tasks, one) = solved(Alone, &sum, options);
            for _ in 0..3 {
                let (n_tasks_of_team, team) = solved(Forking, &sum, options);
                assert_eq!(n_tasks, n_tasks_of_team);
                let bits = |v: &[Vec<f64>; 3]| {
                    v.clone().map(|v| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>())
                };
                assert!(bits(&one) == bits(&team), "{name}, {options:?}");
            }
        }
    }
}

#[test]
fn of_several_bad_pivots_the_first_of_the_plan_is_named_by_every_team() {
    let mut sum = Sum::forest(9, 12);
    for block in &mut sum.blocks {
        block[0] = -1e3;
    }
    let options = Options { grain: 0, ..Options::default() };
    let one = Multifrontal::<f64>::analyse(&sum, options).factor(&sum).expect_err("indefinite");
    for _ in 0..5 {
        let team = Multifrontal::<f64, _>::on(Forking, &sum, options).factor(&sum);
        assert_eq!(team.expect_err("indefinite"), one);
    }
}

#[test]
fn a_long_chain_is_cut_in_two_for_nothing_and_in_many_parts_for_at_most_three_times_the_work() {
    let sum = Sum::chain(2_000, 12, 6);
    let counters = |ordering| {
        let options = Options { ordering, ..Options::default() };
        Multifrontal::<f64>::analyse(&sum, options).counters()
    };
    let serial = counters(Ordering::MinimumDegree);
    let chosen = counters(Ordering::Chosen);
    assert!(chosen.parallelism > 1.9 && chosen.n_tasks >= 3, "{chosen:?}");
    assert!(chosen.flops as f64 <= 1.01 * serial.flops as f64, "{chosen:?}, {serial:?}");
    let parts = counters(Ordering::Dissection(5));
    assert!(parts.parallelism > 16.0, "{parts:?}");
    assert!(parts.flops < 3 * serial.flops, "{parts:?}, {serial:?}");
}

#[test]
fn many_branches_of_little_work_are_gathered_into_tasks() {
    let counters = Multifrontal::<f64>::analyse(&Sum::star(100, 27), Options::default()).counters();
    assert!(counters.n_tasks > 8 && counters.n_tasks < 100, "{counters:?}");
}

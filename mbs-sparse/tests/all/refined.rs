//! Refined solutions compared with known ones and with a factor in double-double, for condition numbers that are too large for `f64`.
//!
//! ```text
//! T = sum of random blocks of order one + s sum_k g_k g_k^T,   fewer g than unknowns: cond(T) about s
//! ```
#![allow(clippy::print_stdout, reason = "what is measured is shown with --nocapture")]

use crate::common::{Random, Sum};
use mbs_math::real::DoubleDouble as Pair;
use mbs_math::refined::{ALL, Refined, RefinementError};
use mbs_sparse::{BlockSource, Cliques, Multifrontal, Options, Real, SpdSolver};

/// Blocks of masses, and rows with a penalty.
struct Stiff {
    masses: Sum,
    rows: Vec<(Vec<u32>, Vec<f64>)>,
    penalty: f64,
}

impl Stiff {
    /// Creates a chain of `length` masses, with two rows between neighbours.
    fn chain(length: usize, penalty: f64, seed: u64) -> Self {
        let masses = Sum::chain(length, 6, 2);
        let mut random = Random(seed);
        let rows = |e: &Vec<u32>| [e[..4].to_vec(), e[2..].to_vec()];
        let rows = masses.cliques.iter().flat_map(rows);
        let rows = rows.map(|clique| (clique, (0..4).map(|_| random.next()).collect())).collect();
        Self { masses, rows, penalty }
    }

    /// Returns the same sum with renumbered unknowns, and its elements in another order.
    fn renamed(&self, names: &[u32]) -> Self {
        let rename = |clique: &Vec<u32>| clique.iter().map(|&u| names[u as usize]).collect();
        let mut masses = self.masses.clone();
        masses.cliques = masses.cliques.iter().map(rename).collect();
        masses.cliques.reverse();
        masses.blocks.reverse();
        masses.residuals.reverse();
        let rows = self.rows.iter().rev().map(|(clique, g)| (rename(clique), g.clone())).collect();
        Self { masses, rows, penalty: self.penalty }
    }

    /// Returns the product T x in double-double numbers.
    fn times(&self, x: &[Pair]) -> Vec<Pair> {
        let mut b = vec![Pair::ZERO; x.len()];
        for e in 0..self.n_elements() {
            let clique = self.clique(e);
            let mut block = vec![Pair::ZERO; clique.len() * (clique.len() + 1) / 2];
            self.write_block(e, &mut block);
            let mut entries = block.iter();
            for (j, &v) in clique.iter().enumerate() {
                for &u in &clique[j..] {
                    let &entry = entries.next().expect("a packed triangle");
                    b[u as usize] += entry * x[v as usize];
                    if u != v {
                        b[v as usize] += entry * x[u as usize];
                    }
                }
            }
        }
        b
    }
}

impl Cliques for Stiff {
    fn n_unknowns(&self) -> usize {
        self.masses.n
    }
    fn n_elements(&self) -> usize {
        self.masses.cliques.len() + self.rows.len()
    }
    fn clique(&self, element: usize) -> &[u32] {
        let n = self.masses.cliques.len();
        if element < n { self.masses.clique(element) } else { &self.rows[element - n].0 }
    }
}

impl BlockSource<Pair> for Stiff {
    fn write_block(&self, element: usize, block: &mut [Pair]) {
        let n = self.masses.cliques.len();
        if element < n {
            return self.masses.write_block(element, block);
        }
        let (g, mut entries) = (&self.rows[element - n].1, block.iter_mut());
        for j in 0..g.len() {
            for (&gi, entry) in g[j..].iter().zip(entries.by_ref()) {
                *entry = Pair::from_f64(self.penalty) * Pair::from_f64(gi) * Pair::from_f64(g[j]);
            }
        }
    }
    fn write_residual(&self, element: usize, residual: &mut [Pair]) {
        for (place, r) in residual.iter_mut().enumerate() {
            *r = Pair::from_f64(f64::from(self.clique(element)[place]) + element as f64);
        }
    }
}

type Solver = Refined<Pair, Multifrontal<f64>>;

fn refined(sum: &Stiff, most: u32) -> Solver {
    let mut solver = Refined::new(sum, Multifrontal::analyse(sum, Options::default()), most);
    solver.factor(sum).expect("positive pivots");
    solver
}

fn wide(sum: &Stiff, b: &[Pair]) -> Vec<Pair> {
    let mut solver = Multifrontal::<Pair>::analyse(sum, Options::default());
    solver.factor(sum).expect("positive definite");
    let (mut x, mut scratch) = (b.to_vec(), vec![Pair::ZERO; solver.n_scratch()]);
    solver.solve(&mut x, &mut scratch);
    x
}

fn solve(solver: &Solver, b: &[Pair]) -> (Vec<Pair>, Result<u32, RefinementError>) {
    let (mut x, mut scratch) = (b.to_vec(), vec![Pair::ZERO; solver.n_scratch()]);
    let told = solver.refine(&mut x, &mut scratch);
    (x, told)
}

/// Returns the largest difference relative to the largest entry.
fn distance(a: &[Pair], b: &[Pair]) -> f64 {
    let size = |x: Pair| x.to_f64().abs();
    let whole = b.iter().fold(0.0, |most: f64, &x| most.max(size(x)));
    a.iter().zip(b).fold(0.0, |most: f64, (&a, &b)| most.max(size(a - b))) / whole
}

fn known(n: usize) -> Vec<Pair> {
    let mut random = Random(11);
    (0..n).map(|_| Pair::from_f64(random.next()) / Pair::from_f64(3.0)).collect()
}

/// Returns the error allowed for a backward stable solution in double-double: the condition number times EPSILON, with a margin for the
/// size of the sum.
fn bound(penalty: f64) -> f64 {
    100.0 * penalty * Pair::EPSILON.to_f64()
}

#[test]
fn refined_solutions_have_the_digits_of_a_factor_in_pairs_for_conditions_up_to_1e14() {
    for exponent in (2..=14).step_by(2) {
        let penalty = 10_f64.powi(exponent);
        for seed in 0..5 {
            let sum = Stiff::chain(12, penalty, seed);
            let x = known(sum.n_unknowns());
            let b = sum.times(&x);
            let (got, told) = solve(&refined(&sum, ALL), &b);
            let (off, other) = (distance(&got, &x), distance(&wide(&sum, &b), &x));
            println!("s = {penalty:e}: {told:?}, off by {off:.1e}; a factor in pairs {other:.1e}");
            assert!(told.is_ok() && off < bound(penalty), "s = {penalty:e}: {off:e}");
            assert!(other < bound(penalty), "s = {penalty:e}: {other:e}");
        }
    }
}

#[test]
fn what_claims_to_be_refined_is_and_hopeless_conditions_are_refused() {
    let mut refused = 0;
    for exponent in 15..=22 {
        let penalty = 10_f64.powi(exponent);
        for seed in 0..5 {
            let sum = Stiff::chain(12, penalty, seed);
            let inner = Multifrontal::analyse(&sum, Options::default());
            let mut solver: Solver = Refined::new(&sum, inner, ALL);
            let x = known(sum.n_unknowns());
            let (off, told) = match solver.factor(&sum) {
                Ok(()) => {
                    let (got, told) = solve(&solver, &sum.times(&x));
                    (distance(&got, &x), told.map_err(|e| e.to_string()))
                }
                Err(error) => (f64::NAN, Err(error.to_string())),
            };
            println!("s = {penalty:e}: {told:?}, off by {off:.1e}");
            assert!(told.is_err() || off < bound(penalty), "s = {penalty:e}: {told:?} {off:e}");
            assert!(told.is_err() || exponent < 18, "s = {penalty:e}: eps of f64 times s is 200");
            refused += u32::from(told.is_err());
        }
    }
    assert!(refused >= 25, "{refused}");
}

#[test]
fn names_of_unknowns_and_the_order_of_elements_do_not_matter() {
    let penalty = 1e10;
    let sum = Stiff::chain(12, penalty, 3);
    let n = sum.n_unknowns();
    // 7 and n are coprime, so that `names` is a permutation.
    assert_ne!(n % 7, 0);
    let names: Vec<u32> = (0..n).map(|u| ((7 * u + 3) % n) as u32).collect();
    let other = sum.renamed(&names);
    let b = known(n);
    let mut renamed = b.clone();
    names.iter().zip(&b).for_each(|(&u, &b)| renamed[u as usize] = b);
    let (x, told) = solve(&refined(&sum, ALL), &b);
    let (y, other_told) = solve(&refined(&other, ALL), &renamed);
    assert!(told.is_ok() && other_told.is_ok());
    let back: Vec<Pair> = names.iter().map(|&u| y[u as usize]).collect();
    assert!(distance(&back, &x) < bound(penalty), "{:e}", distance(&back, &x));
}

#[test]
fn residuals_are_summed_in_pairs_as_the_wide_solver_sums_them() {
    let sum = Stiff::chain(5, 1.0, 1);
    let n = sum.n_unknowns();
    let [mut f, mut expected] = [vec![Pair::ONE; n], vec![Pair::ONE; n]];
    refined(&sum, ALL).assemble(&sum, &mut f);
    Multifrontal::<Pair>::analyse(&sum, Options::default()).assemble(&sum, &mut expected);
    assert_eq!(f, expected);
}

#[test]
fn one_correction_has_the_digits_of_the_factor_and_too_few_are_said_to_be() {
    let sum = Stiff::chain(12, 1e6, 2);
    let x = known(sum.n_unknowns());
    let b = sum.times(&x);
    let (got, told) = solve(&refined(&sum, 1), &b);
    let off = distance(&got, &x);
    // The expected error is the condition number 1e6 times EPSILON of `f64`. The lower limit excludes an error that is smaller by chance.
    assert!(told == Ok(1) && (1e-17..1e-8).contains(&off), "{told:?} {off:e}");

    let solver = refined(&sum, 2);
    let (_, told) = solve(&solver, &b);
    assert!(matches!(told, Err(RefinementError::Unfinished { corrections: 2, .. })), "{told:?}");

    let mut scratch = vec![Pair::ZERO; solver.n_scratch()];
    solver.solve(&mut b.clone(), &mut scratch);
    solver.solve(&mut vec![Pair::ZERO; b.len()], &mut scratch);
    let tally = solver.take_tally();
    assert_eq!((tally.solutions, tally.corrections, tally.failed), (2, 1, 1));
    assert_eq!(tally.failure, told.err());
    assert_eq!(solver.take_tally().solutions, 0, "asked for once");
}

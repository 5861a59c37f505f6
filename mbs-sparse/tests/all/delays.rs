//! Indefinite systems divided into tasks, with pivots delayed from task to task: the bits are the same for every team.

use crate::common::{Forking, Saddle};
use mbs_sparse::{Alone, Indefinite, Options, Ordering, SymmetricSolver, Team};

/// Returns saddle systems in two forms. In one, the analysis knows the multipliers. In the other, it does not, and places many multipliers
/// before their coordinates, so that their pivots are delayed.
fn saddles() -> Vec<(String, Saddle)> {
    let mut light = Saddle::chain((20, 9, 3), 3, 5);
    light.remove_mass(|u| u % 6 == 4);
    let named = [
        ("chain", Saddle::chain((60, 12, 6), 5, 3)),
        ("star", Saddle::star(9, 6, 3)),
        ("shuffled chain", Saddle::chain((40, 7, 2), 2, 11).shuffled(4)),
        ("coordinates without mass", light),
    ];
    let of = |(name, saddle): (&str, Saddle)| {
        let untold = Saddle { n_primal: saddle.sum.n, ..saddle.clone() };
        [(name.to_owned(), saddle), (format!("{name}, untold"), untold)]
    };
    named.into_iter().flat_map(of).collect()
}

fn options() -> impl Iterator<Item = Options> {
    let orderings = [Ordering::MinimumDegree, Ordering::Dissection(3)];
    let grains = [0, 1_000, 10_000, u64::MAX];
    grains.into_iter().flat_map(move |grain| {
        orderings.map(|ordering| Options { grain, ordering, ..Options::default() })
    })
}

/// All results of a factorisation.
struct Factored {
    /// Residual, solution, null vector, and ratio of the weakest pivot.
    numbers: [Vec<f64>; 4],
    weakest: u32,
    delayed: usize,
    between_tasks: usize,
    n_tasks: usize,
}

fn factored<W: Team>(team: W, saddle: &Saddle, options: Options) -> Factored {
    let mut solver = Indefinite::<f64, W>::on(team, saddle, options);
    let mut f = vec![0.0; saddle.sum.n];
    solver.assemble(saddle, &mut f);
    let mut x = f.clone();
    solver.factor(saddle).expect("regular");
    let mut scratch = vec![f64::NAN; solver.n_scratch()];
    solver.solve(&mut x, &mut scratch);
    let mut null = vec![f64::NAN; saddle.sum.n];
    solver.null_vector(&mut null, &mut scratch);
    let weakest = solver.weakest();
    Factored {
        numbers: [f, x, null, vec![weakest.ratio]],
        weakest: weakest.unknown,
        delayed: solver.delays().delayed,
        between_tasks: solver.delays().between_tasks,
        n_tasks: solver.counters().n_tasks,
    }
}

fn bits(numbers: &[Vec<f64>; 4]) -> Vec<Vec<u64>> {
    numbers.iter().map(|v| v.iter().map(|x| x.to_bits()).collect()).collect()
}

#[test]
fn tasks_of_any_size_give_the_solution_and_a_team_its_bits() {
    let mut delayed_between_tasks = 0;
    for (name, saddle) in saddles() {
        for options in options() {
            let one = factored(Alone, &saddle, options);
            // A chain without dissection has no forks.
            let is_cut = options.grain == 0 && options.ordering == Ordering::Dissection(3);
            assert!(!is_cut || one.n_tasks > 4, "{name}: {}", one.n_tasks);
            delayed_between_tasks += one.between_tasks;
            let [f, x, ..] = &one.numbers;
            let largest = |v: &[f64]| v.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            // Entries are of order 10 at most; the largest value of the solution determines the rounding error.
            let size = largest(f) + 10.0 * largest(x);
            for (b, f) in saddle.sum.times(x).iter().zip(f) {
                assert!((b - f).abs() < 1e-11 * size, "{name}, {options:?}");
            }
            for _ in 0..3 {
                let team = factored(Forking, &saddle, options);
                assert!(bits(&one.numbers) == bits(&team.numbers), "{name}, {options:?}");
                assert_eq!((one.weakest, one.delayed), (team.weakest, team.delayed), "{name}");
            }
        }
    }
    assert!(delayed_between_tasks > 100, "{delayed_between_tasks}");
}

#[test]
fn a_row_given_twice_is_named_with_its_combination_however_the_tree_is_cut() {
    let mut saddle = Saddle::chain((40, 9, 3), 2, 7);
    let (first, second) = saddle.repeat_row(17, 2.0);
    for options in options() {
        let mut named = Vec::new();
        for _ in 0..3 {
            let mut solver = Indefinite::<f64, _>::on(Forking, &saddle, options);
            let error = solver.factor(&saddle).expect_err("singular");
            assert!([first, second].contains(&error.unknown), "{options:?}: {error}");
            let mut null = vec![f64::NAN; saddle.sum.n];
            solver.null_vector(&mut null, &mut vec![f64::NAN; solver.n_scratch()]);
            let sum = null[first as usize] + 2.0 * null[second as usize];
            assert!(sum.abs() < 1e-9, "{options:?}: {sum:e}");
            named.push(error.unknown);
        }
        assert!(named.iter().all(|&unknown| unknown == named[0]));
    }
}

//! Cost and operations of one step of index-3, for `cargo xtask profile`; and steps without any measurement, for callgrind.
//!
//! ```text
//! bench profile rates                    operations and bytes that this machine does in a second
//! bench profile step SCENE FROM TO       steps FROM to TO of the scene's run: counts, CPU time, operations, bytes
//! bench profile bare SCENE N             N steps and nothing else
//! ```

use crate::bench::clocked::{ClockedModel, ClockedSolver};
use crate::bench::counted::Counted;
use crate::bench::lane::Sums;
use crate::bench::rates;
use crate::bench::request::say;
use crate::bench::scenes::{self, Prepared};
use crate::bench::tally::Tally;
use cpu_time::ProcessTime;
use mbs_augmented::{Options, Workspace, index3};
use mbs_core::model::{Model, State, Terms};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::Dimension;
use mbs_core::step::Step;
use mbs_core::{Cliques, Real, SpdSolver};
use mbs_sparse::{Counters, Multifrontal};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// Number of steps that are timed together. They take a few milliseconds, in which interruptions by other processes are rare.
const TOGETHER: u32 = 25;
/// Least number of timings of each stretch of steps [-]. Chosen, not tuned.
const LEAST: u32 = 10;
/// Time of all timings of a stretch [s]. Chosen, not tuned.
const SECONDS: f64 = 2.0;

/// Makes the measurement that the words name.
pub(crate) fn measure(words: &[String]) -> Result<(), String> {
    let number = |word: &String| word.parse::<u32>().map_err(|e| format!("`{word}`: {e}"));
    match words {
        [word] if word == "rates" => say(&rates::measure()),
        [word, scene, from, to] if word == "step" => {
            let window = [number(from)?, number(to)?];
            match dimension(scene)? {
                Dimension::Planar => say(&step_line::<2>(scene, window)?),
                Dimension::Spatial => say(&step_line::<3>(scene, window)?),
            }
        }
        [word, scene, n] if word == "bare" => match dimension(scene)? {
            Dimension::Planar => bare::<2>(scene, number(n)?)?,
            Dimension::Spatial => bare::<3>(scene, number(n)?)?,
        },
        _ => return Err("expected `rates`, `step SCENE FROM TO` or `bare SCENE N`".to_owned()),
    }
    Ok(())
}

fn dimension(scene: &str) -> Result<Dimension, String> {
    Ok(scenes::read::<f64>(scene)?.dimension)
}

/// A scene's run from its start, step by step.
#[derive(Debug, Clone)]
struct Walk<T, M, S> {
    model: M,
    step: Step<T>,
    state: State<T>,
    workspace: Workspace<T, S>,
}

/// The walk whose steps are timed, with plain doubles.
type Plain<const D: usize> = Walk<f64, NaturalModel<f64, D>, Multifrontal<f64>>;

impl<T: Real, M: Model<T>, S: SpdSolver<T>> Walk<T, M, S> {
    fn new<const D: usize>(prepared: &Prepared<D, T>, model: M, solver: S) -> Self {
        let step = Step { dt: T::from_f64(prepared.dt), length: prepared.model.length() };
        let workspace = Workspace::new(&model, solver);
        Self { model, step, state: prepared.start.clone(), workspace }
    }

    /// Makes a number of steps, and adds to the counts.
    fn go(&mut self, n: u32, sums: &mut Sums) -> Result<(), String> {
        let (options, Self { model, step, state, workspace }) = (Options::index3(), self);
        for _ in 0..n {
            let report = index3::step(model, *step, &options, state, workspace);
            sums.add(&report.map_err(|e| format!("step {}: {e}", sums.steps + 1))?);
        }
        Ok(())
    }
}

fn solver<T: Real>(cliques: &impl Cliques) -> Multifrontal<T> {
    Multifrontal::analyse(cliques, mbs_sparse::Options::default())
}

fn plain<const D: usize>(prepared: &Prepared<D>) -> Plain<D> {
    Walk::new(prepared, prepared.model.clone(), solver(&prepared.model))
}

fn bare<const D: usize>(scene: &str, n: u32) -> Result<(), String> {
    let prepared = Prepared::<D>::new(scenes::read(scene)?)?;
    plain(&prepared).go(n, &mut Sums::default())
}

/// The result of one scene as a line.
fn step_line<const D: usize>(scene: &str, [from, to]: [u32; 2]) -> Result<Value, String> {
    let prepared = Prepared::<D>::new(scenes::read(scene)?)?;
    let to = to.min(prepared.n_steps).max(from + 1);
    let mut walk = plain(&prepared);
    walk.go(from, &mut Sums::default())?;
    let (seconds, sums) = timed(&walk, to - from)?;
    let (tally, counted) = counted::<D>(scene, [from, to])?;
    if counted != sums {
        return Err(format!("{scene}: counting numbers went another way: {counted:?}, {sums:?}"));
    }
    let sizes = Sizes::of(&prepared, &walk);
    let each = |x: u64| share(x, sums.steps);
    let phases: Map<_, _> =
        tally.phases().map(|(name, done)| (name.to_owned(), json!(each(done.total())))).collect();
    let all = tally.all();
    Ok(json!({
        "kind": "step", "scene": scene, "step": prepared.dt, "from": from, "to": to,
        "unknowns": prepared.model.n_unknowns(), "rows": prepared.model.n_constraints(),
        "seconds": seconds / f64::from(to - from), "work": sums.json(),
        "factor_flops": sizes.counters.flops, "entries": sizes.counters.nonzeros,
        "stored": sizes.counters.stored, "fronts": sizes.counters.n_fronts,
        "products": each(all.products), "sums": each(all.sums), "quotients": each(all.quotients),
        "roots": each(all.roots), "turns": each(all.turns), "operations": phases,
        "cliques": cliques(&prepared.model), "set": sizes.set(), "moved": each(sizes.moved(&sums)),
    }))
}

/// Number of elements, by their number of unknowns.
fn cliques(model: &impl Cliques) -> BTreeMap<usize, usize> {
    let mut sizes = BTreeMap::new();
    for e in 0..model.n_elements() {
        *sizes.entry(model.clique(e).len()).or_default() += 1;
    }
    sizes
}

#[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn share(x: u64, steps: u64) -> f64 {
    x as f64 / steps.max(1) as f64
}

/// CPU time of `n` steps of a walk [s], and their counts. The time is the sum over stretches of the least of many timings.
fn timed<const D: usize>(walk: &Plain<D>, n: u32) -> Result<(f64, Sums), String> {
    let (mut least, mut all, mut turns) = (Vec::new(), 0.0, 0);
    loop {
        let (mut walk, mut sums, mut at) = (walk.clone(), Sums::default(), 0);
        let mut stretch = 0;
        while at < n {
            let together = TOGETHER.min(n - at);
            let clock = ProcessTime::now();
            walk.go(together, &mut sums)?;
            let seconds = clock.elapsed().as_secs_f64();
            match least.get_mut(stretch) {
                None => least.push(seconds),
                Some(least) => *least = seconds.min(*least),
            }
            (all, at, stretch) = (all + seconds, at + together, stretch + 1);
        }
        turns += 1;
        if turns >= LEAST && all > SECONDS {
            return Ok((least.iter().sum(), sums));
        }
    }
}

/// Makes the same steps with numbers that count their operations.
fn counted<const D: usize>(scene: &str, [from, to]: [u32; 2]) -> Result<(Tally, Sums), String> {
    let prepared = Prepared::<D, Counted>::new(scenes::read(scene)?)?;
    let (tally, mut sums) = (Tally::default(), Sums::default());
    let (clock, inner) = (&tally, &prepared.model);
    let model = ClockedModel { model: inner.clone(), clock };
    let mut walk = Walk::new(&prepared, model, ClockedSolver { solver: solver(inner), clock });
    walk.go(from, &mut Sums::default())?;
    tally.forget();
    walk.go(to - from, &mut sums)?;
    tally.end();
    Ok((tally, sums))
}

/// Amount of data that a step reads and writes, in numbers of eight bytes.
struct Sizes {
    counters: Counters,
    /// Numbers of the Jacobian, and of all terms.
    jacobian: usize,
    terms: usize,
    /// Numbers of the state and of scratch vectors.
    vectors: usize,
}

impl Sizes {
    fn of<const D: usize>(prepared: &Prepared<D>, walk: &Plain<D>) -> Self {
        let model = &prepared.model;
        let (n, e, m) = (model.n_unknowns(), model.n_extended(), model.n_constraints());
        let Terms { phi, phi_t, phi_bias, jacobian, force, measures, .. } = walk.workspace.terms();
        let measures = size_of_val(&measures[..]) / size_of::<f64>();
        let rows = phi.len() + phi_t.len() + phi_bias.len();
        let scratch = walk.workspace.solver().n_scratch();
        Self {
            counters: walk.workspace.solver().counters(),
            jacobian: jacobian.len(),
            terms: rows + jacobian.len() + force.len() + measures,
            // ten numbers for each coordinate: q, q_low, v, a, a_aux; dq, q, v, a, change; eleven for each row: lambda, the lambda before,
            // reaction, phi; lambda, sigma, mu, rates, penalty, masses, probe; two for each unknown: f and the pivots; scratch of the sweeps
            vectors: 10 * e + 11 * m + 2 * n + scratch,
        }
    }

    /// Bytes of fronts, terms, vectors and the factor's Jacobian. The model's own tables are left out.
    fn set(&self) -> usize {
        8 * (self.counters.stored + self.terms + self.jacobian + self.vectors)
    }

    /// Least number of bytes that a step moves between memory and processor. A factorisation reads the Jacobian, writes all fronts and
    /// reads them again. A solution reads the Jacobian for its right-hand side, and the factor twice. An iteration writes the Jacobian.
    fn moved(&self, sums: &Sums) -> u64 {
        let Counters { stored, nonzeros, .. } = self.counters;
        let numbers = sums.factorizations * (self.jacobian + 2 * stored) as u64
            + sums.solves * (self.jacobian + 2 * nonzeros) as u64
            + sums.iterations * self.jacobian as u64;
        8 * numbers
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::clocked::Phase;
    use crate::bench::counted::done;
    use crate::bench::scenes::tests::chain;
    use mbs_core::BlockSource;

    #[test]
    fn a_walk_counts_the_same_work_in_both_numbers() {
        let prepared = Prepared::<3>::new(chain(12)).unwrap();
        let mut walk = plain(&prepared);
        walk.go(2, &mut Sums::default()).unwrap();
        let mut sums = Sums::default();
        walk.clone().go(3, &mut sums).unwrap();
        let (tally, counted) = counted::<3>("chain-12", [2, 5]).unwrap();
        assert_eq!(counted, sums);
        // each sweep has a product and a sum for each entry of L, and each pivot a product; a few more operations sum separate rows
        let Counters { n, nonzeros, flops, .. } = walk.workspace.solver().counters();
        let of = |phase: Phase| tally.phases().nth(phase as usize).unwrap().1.total();
        let sweeps = sums.solves * (4 * nonzeros - 3 * n) as u64;
        assert!((sweeps..sweeps * 11 / 10).contains(&of(Phase::Solves)), "{sweeps}");
        // besides elimination, a factorisation evaluates and adds blocks
        let blocks = of(Phase::Factorisation) - sums.factorizations * flops;
        assert!(blocks > 0 && blocks < sums.factorizations * flops, "{blocks}");
        let all: u64 = tally.phases().map(|(_, done)| done.total()).sum();
        assert_eq!(tally.all().total(), all);
    }

    /// Blocks of constants, whose evaluation has no operations.
    struct Given<'a, M>(&'a M);

    impl<M: Cliques + Sync> BlockSource<Counted> for Given<'_, M> {
        fn write_block(&self, element: usize, block: &mut [Counted]) {
            block.fill(Counted::ZERO);
            let (mut at, n) = (0, self.0.clique(element).len());
            for k in 0..n {
                block[at] = Counted::ONE;
                at += n - k;
            }
        }
        fn write_residual(&self, _: usize, _: &mut [Counted]) {}
    }

    #[test]
    fn an_elimination_takes_little_more_operations_than_its_formula() {
        let prepared = Prepared::<3>::new(chain(12)).unwrap();
        let model = &prepared.model;
        let mut solver = solver::<Counted>(model);
        done();
        solver.factor(&Given(model)).unwrap();
        let counted = done().total();
        let Counters { flops, extend_adds, .. } = solver.counters();
        let triangle = |e| model.clique(e).len() * (model.clique(e).len() + 1) / 2;
        let adds: usize = (0..model.n_elements()).map(triangle).sum();
        // the sums that assemble blocks are counted separately: at most one for each of their entries
        let least = counted - extend_adds - adds as u64;
        assert!(least < flops && flops < counted, "{counted} {flops} {extend_adds} {adds}");
    }

    #[test]
    fn words_that_ask_for_nothing_are_refused() {
        let words = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<_>>();
        assert!(measure(&words("step chain-12 1")).is_err());
        assert!(measure(&words("bare chain-12 x")).is_err());
    }
}

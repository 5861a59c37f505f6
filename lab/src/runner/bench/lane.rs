//! Steps of a scene by one combination of formulation, solver and team, with or without a clock.

use crate::bench::clocked::{Clock, ClockedModel, ClockedSolver, watched};
use crate::bench::race::{Runner, timed};
use crate::bench::scenes::Prepared;
use mbs_augmented::{IndexChange, Options, Workspace, index1, index3};
use mbs_core::model::{Model, State};
use mbs_core::step::{Step, StepError, StepReport};
use mbs_core::team::{Alone, Team};
use mbs_core::{Real, SpdSolver};
use mbs_parallel::Pool;
use mbs_sparse::Multifrontal;
use serde_json::{Value, json};

/// Augmented Lagrangian formulation whose steps of fixed length are measured.
#[derive(Debug, Clone, Copy)]
#[allow(clippy::large_enum_variant, reason = "there is one in each lane")]
pub(crate) enum Method {
    One,
    Three,
    Both(IndexChange<f64>),
}

impl Method {
    /// Finds the method of a name. `None` for other formulations, which are measured by the steps of `mbs run`.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "index-1" => Self::One,
            "index-3" => Self::Three,
            "multi-index" => Self::Both(IndexChange::new(Options::index1(), Options::index3())),
            _ => return None,
        })
    }

    fn step<M: Model<f64>, S: SpdSolver<f64>>(
        &mut self,
        model: &M,
        step: Step<f64>,
        s: &mut State<f64>,
        w: &mut Workspace<f64, S>,
    ) -> Result<StepReport<f64>, StepError> {
        match self {
            Self::One => index1::step(model, step, &Options::index1(), s, w),
            Self::Three => index3::step(model, step, &Options::index3(), s, w),
            Self::Both(change) => {
                w.save();
                change.prepare(model, step, 0, s, w);
                let report = change.step(model, step, s, w)?;
                change.tried(step.dt);
                change.accept();
                Ok(report)
            }
        }
    }
}

/// Counted work, summed over steps.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Sums {
    pub(crate) steps: u64,
    pub(crate) iterations: u64,
    pub(crate) factorizations: u64,
    pub(crate) solves: u64,
}

impl Sums {
    pub(crate) fn add<T: Real>(&mut self, report: &StepReport<T>) {
        self.steps += 1;
        self.iterations += u64::from(report.iterations);
        self.factorizations += u64::from(report.factorizations);
        self.solves += u64::from(report.solves);
    }

    /// Returns the counts as JSON, averaged over the steps.
    pub(crate) fn json(&self) -> Value {
        #[allow(clippy::cast_precision_loss, reason = "counts of steps")]
        let each = |sum: u64| sum as f64 / self.steps.max(1) as f64;
        json!({
            "steps": self.steps, "iterations": each(self.iterations),
            "factorizations": each(self.factorizations), "solves": each(self.solves),
        })
    }
}

/// Name of a lane: its team, number of threads, and order of elimination.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Name {
    pub(crate) team: &'static str,
    pub(crate) threads: usize,
    /// Order of elimination, by name.
    pub(crate) order: String,
}

/// Function that makes a number of steps and adds to the counts.
type Steps<'a> = Box<dyn FnMut(u32, &mut Sums) -> Result<(), String> + Send + 'a>;

/// A lane: one combination by which a scene is stepped, with its name and clock.
pub(crate) struct Lane<'a> {
    pub(crate) name: Name,
    pub(crate) clock: Option<&'a Clock>,
    pub(crate) sums: Sums,
    steps: Steps<'a>,
    /// Pool in which the steps are made; `None` for the caller's thread.
    pool: Option<&'a Pool>,
}

impl<'a> Lane<'a> {
    /// Makes a lane on the caller's thread.
    pub(crate) fn alone<const D: usize>(
        prepared: &'a Prepared<D>,
        method: Method,
        solver: Multifrontal<f64>,
        (order, clock): (&str, Option<&'a Clock>),
    ) -> Self {
        let name = Name { team: Alone.word(), threads: 1, order: order.to_owned() };
        let steps = steps(prepared.model.clone(), solver, prepared, method, clock);
        Self { name, clock, sums: Sums::default(), steps, pool: None }
    }

    /// Makes a lane of a thread team.
    pub(crate) fn shared<const D: usize, W: Named>(
        prepared: &'a Prepared<D>,
        method: Method,
        solver: Multifrontal<f64>,
        (team, clock): (&'a W, Option<&'a Clock>),
    ) -> Self {
        let name = Name { team: team.word(), threads: team.size(), order: "chosen".to_owned() };
        let model = prepared.model.with_team(team);
        let steps = steps(model, solver.with_team(team), prepared, method, clock);
        Self { name, clock, sums: Sums::default(), steps, pool: team.pool() }
    }
}

impl Runner for Lane<'_> {
    fn run(&mut self, n: u32) -> Result<f64, String> {
        let (steps, sums) = (&mut self.steps, &mut self.sums);
        let mut run = || timed(|| steps(n, sums));
        match self.pool {
            // the time of entering the pool is not part of the step
            Some(pool) => pool.enter(run),
            None => run(),
        }
    }

    fn reset(&mut self) {
        self.sums = Sums::default();
        if let Some(clock) = self.clock {
            clock.reset();
        }
    }
}

/// A team with its name.
pub(crate) trait Named: Team + Send {
    /// Name of the team in the lines.
    fn word(&self) -> &'static str;
    /// Pool in which the team's steps must be made, if there is one.
    fn pool(&self) -> Option<&Pool> {
        None
    }
}

impl Named for Alone {
    fn word(&self) -> &'static str {
        "alone"
    }
}

impl Named for mbs_parallel::ThreadTeam {
    fn word(&self) -> &'static str {
        "crew"
    }
}

impl Named for Pool {
    fn word(&self) -> &'static str {
        "pool"
    }
    fn pool(&self) -> Option<&Pool> {
        Some(self)
    }
}

/// Makes the steps, with a clock or without.
fn steps<'a, const D: usize, M: Model<f64> + Send + 'a, S: SpdSolver<f64> + Send + 'a>(
    model: M,
    solver: S,
    prepared: &'a Prepared<D>,
    method: Method,
    clock: Option<&'a Clock>,
) -> Steps<'a> {
    match clock {
        None => stepping(model, solver, prepared, method, None),
        Some(clock) => {
            let (model, solver) = (ClockedModel { model, clock }, ClockedSolver { solver, clock });
            stepping(model, solver, prepared, method, Some(clock))
        }
    }
}

/// Steps through the scene's run, from its start again when it ends.
fn stepping<'a, const D: usize, M: Model<f64> + Send + 'a, S: SpdSolver<f64> + Send + 'a>(
    model: M,
    solver: S,
    prepared: &'a Prepared<D>,
    mut method: Method,
    clock: Option<&'a Clock>,
) -> Steps<'a> {
    let mut workspace = Workspace::new(&model, solver);
    let mut state = prepared.start.clone();
    let (step, mut done) = (Step { dt: prepared.dt, length: prepared.model.length() }, 0);
    Box::new(move |n, sums| {
        for _ in 0..n {
            if done == prepared.n_steps {
                state.copy_from(&prepared.start);
                done = 0;
            }
            let report = watched(clock, || method.step(&model, step, &mut state, &mut workspace));
            let report = report.map_err(|e| format!("step {}: {e}", done + 1))?;
            sums.add(&report);
            done += 1;
        }
        Ok(())
    })
}

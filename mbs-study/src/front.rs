//! Studies of a mechanism that need several runs.

use crate::auto::{Processor, plan, run_plan};
use crate::compare::results::Comparison;
use crate::compare::{self, Earlier, Request as Compare};
use crate::estimate::estimate;
use crate::remedy::name_what_runs;
use crate::sweep::{Columns, Row, Study};
use core::num::NonZeroUsize;
use mbs::inside::PreparedRun;
use mbs::{Mechanism, Method, Number, PathError, Run, RunResult, SimulationError, Watchers};
use mbs_scene::{SceneFile, SweepSource};
use std::io;
use std::path::Path;

/// Runs a mechanism, also with a goal or an estimate. For a goal, short trial runs choose the method. Without a goal, an estimate of the
/// errors follows the run, if requested. All other options have the effect that they have in [`mbs::run`].
///
/// With a goal, a run that stops is repeated by the next method of the ranking. The settings of the last run are in
/// [`settings`](RunResult::settings).
///
/// # Errors
/// [`SimulationError`] for a mechanism or options that are refused, and for an interrupt while the method is chosen.
///
/// # Examples
/// ```
/// use mbs::{Body, GROUND, Goal, Joint, Mechanism, Run};
/// let mut m = Mechanism::planar("pendulum");
/// m.set_gravity([0.0, -9.81]);
/// let bob = m.add(Body::planar([1.0, 0.0], 1.0, 0.0));
/// m.add(Joint::revolute([GROUND, bob], [0.0, 0.0]).named("pivot"));
/// let result = mbs_study::run(&m, &Run::new().duration(1.0).goal(Goal::error(1e-4)))?;
/// let angle = result.table().column("pivot").unwrap().last().unwrap();
/// // let go at the horizontal, the bob has turned by -2.9758 rad after 1 s
/// assert!((angle + 2.9758).abs() < 1e-3 && result.summary().chosen.is_some());
/// # Ok::<(), mbs::SimulationError>(())
/// ```
pub fn run(m: &Mechanism, options: &Run) -> Result<RunResult, SimulationError> {
    run_with(m, options, &mut Watchers::default())
}

/// Runs a mechanism as [`run`] does, with watchers.
///
/// # Errors
/// Those of [`run`].
pub fn run_with(
    m: &Mechanism,
    options: &Run,
    watchers: &mut Watchers<'_, '_>,
) -> Result<RunResult, SimulationError> {
    let prepared = PreparedRun::new(m, options)?;
    prepared.check(watchers)?;
    let clock = &mut Processor::new(prepared.settings.threads);
    if options.goal.is_some() {
        let plan = plan(&prepared, clock)?;
        let (outcome, settings) = run_plan(&prepared, &plan, watchers)?;
        return Ok(prepared.result(outcome, settings));
    }
    let mut result = prepared.run(watchers)?;
    if options.estimate {
        let (outcome, settings) = result.outcome_mut();
        estimate(&prepared.scene, settings, outcome, clock);
        name_what_runs(&prepared.scene, (&prepared.method, settings), outcome);
    }
    Ok(result)
}

/// Compares every formulation, integrator and step on a mechanism by cost and error. The reference of the errors is made by a method that is
/// not compared.
///
/// Cost: many runs. An empty list of options means all; short lists and a short duration reduce the cost. The reference needs the feature
/// `dd`. An empty list of precisions also needs `f32`. Both features are on by default.
///
/// # Errors
/// [`SimulationError`] for a mechanism that is refused, that has a part in code, or for which no reference can be made. Runs that fail are
/// results, not errors.
///
/// # Examples
/// ```no_run
/// use mbs::{FormulationKind, Mechanism};
/// use mbs_study::{Compare, compare};
/// let m = Mechanism::read("scenes/double-pendulum.toml")?;
/// let formulations = vec![FormulationKind::Index3, FormulationKind::Recursive];
/// let found = compare(&m, &Compare { formulations, duration: Some(1.0), ..Compare::default() })?;
/// for method in &found.methods {
///     for run in &method.runs {
///         println!("{}: step {} s, error {:?}", method.name, run.setting, run.error);
///     }
/// }
/// # Ok::<(), mbs::SimulationError>(())
/// ```
pub fn compare(m: &Mechanism, options: &Compare) -> Result<Comparison, SimulationError> {
    m.check()?;
    let document = m.to_file()?;
    Ok(compare::compare(&document, options, None, (None, Earlier::default()), &mut ())?)
}

/// Sweep: numbers of a mechanism that are varied, and the combination of their values.
///
/// ```
/// use mbs::{Body, GROUND, Joint, Mechanism};
/// use mbs_study::{Sweep, sweep};
/// let mut m = Mechanism::planar("pendulum");
/// m.set_gravity([0.0, -9.81]).set_duration(0.5);
/// let bob = m.add(Body::planar([1.0, 0.0], 1.0, 0.0).named("bob"));
/// m.add(Joint::revolute([GROUND, bob], [0.0, 0.0]).named("pivot"));
/// let runs = sweep(&m, &Sweep::grid().vary("body.bob.center.0", [0.5, 1.0, 2.0]))?;
/// let angles = runs.column("pivot").unwrap();
/// // a longer pendulum falls more slowly
/// assert!(angles[0] < angles[1] && angles[1] < angles[2]);
/// # Ok::<(), mbs::SimulationError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    source: SweepSource,
    method: Method,
    threads: Option<NonZeroUsize>,
}

impl Sweep {
    /// Makes a sweep over all combinations of the values. The values of the last path change fastest.
    #[must_use]
    pub fn grid() -> Self {
        Self::of(SweepSource::grid())
    }

    /// Makes a sweep that combines the first values of all paths, then the second values, and so on. All paths need the same number of values.
    #[must_use]
    pub fn zip() -> Self {
        Self::of(SweepSource::zip())
    }

    fn of(source: SweepSource) -> Self {
        Self { source, method: Method::default(), threads: None }
    }

    /// Reads a sweep file as `mbs sweep` does.
    ///
    /// # Errors
    /// [`SimulationError`] if the file cannot be read. Its content is checked by [`sweep`] only.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, SimulationError> {
        Ok(Self::of(SceneFile::read(path)?.into()))
    }

    /// Varies a number by its path, in the form of [`Mechanism::set`]. The path is also the name of a column.
    #[must_use]
    pub fn vary<N: Into<Number>>(
        mut self,
        path: &str,
        values: impl IntoIterator<Item = N>,
    ) -> Self {
        self.source.vary(path, values.into_iter().map(Into::into).collect());
        self
    }

    /// Sets the method of all runs. Settings that it leaves open are taken from the mechanism.
    #[must_use]
    pub fn method(self, method: Method) -> Self {
        Self { method, ..self }
    }

    /// Sets the number of threads, at least one. Default: all processors.
    #[must_use]
    pub fn threads(self, n: usize) -> Self {
        Self { threads: NonZeroUsize::new(n.max(1)), ..self }
    }
}

/// Results of the runs of a sweep, in the order of its members.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepResult {
    columns: Columns,
    rows: Vec<Row>,
}

impl SweepResult {
    /// Names of the columns: `member`, the varied paths, and the status of each run. Then each output has its last value (`NAME`), its
    /// smallest (`NAME.min`) and its largest (`NAME.max`), as in the table of `mbs sweep`.
    #[must_use]
    pub fn names(&self) -> &[String] {
        self.columns.header()
    }

    /// Numbers of a column, one for each run; NaN if a run has no number there.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let place = self.names().iter().position(|n| n == name)?;
        Some(self.rows.iter().map(|row| self.columns.numbers(row)[place]).collect())
    }

    /// Runs that did not complete: member from 0, error code and message.
    pub fn failures(&self) -> impl Iterator<Item = (usize, &str, &str)> {
        self.rows.iter().filter_map(|row| {
            let (code, message) = row.failure.as_ref()?;
            Some((row.member, &**code, &**message))
        })
    }

    /// Returns the number of runs.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// True if the result has no runs.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Writes the result as `mbs sweep` writes `table.csv`.
    ///
    /// # Errors
    /// Errors of the writer `sink`.
    pub fn write_csv(&self, sink: impl io::Write) -> io::Result<()> {
        let rows: Vec<_> = self.rows.iter().map(|row| self.columns.cells(row)).collect();
        self.columns.write_csv(sink, rows.iter())
    }
}

/// Runs a mechanism with all values of a sweep, on several threads. A run that fails has a row too.
///
/// The rows do not depend on the number of threads.
///
/// # Errors
/// [`SimulationError`] for a path or value that is refused, with its path in code or its place in the file. A mechanism with a part in code
/// is refused too.
pub fn sweep(m: &Mechanism, sweep: &Sweep) -> Result<SweepResult, SimulationError> {
    m.check()?;
    let is_finite = |values: &[Number]| values.iter().all(|value| value.to_f64().is_finite());
    if let Some((path, _)) = sweep.source.varied().find(|(_, values)| !is_finite(values)) {
        return Err(PathError::NotFinite { path: path.to_owned() }.into());
    }
    let study = Study::new(m.to_file()?, &sweep.source, &sweep.method)?;
    let rows = study.rows(sweep.threads, &mut ())?;
    Ok(SweepResult { columns: study.columns().clone(), rows })
}

//! Sweeps: many runs of one scene with varied numbers, on several threads. Finished runs are not lost if the process is killed.
//!
//! A [`Study`] is a checked scene with its sweep. [`Study::run`] runs the members that the journal of a directory lacks, and writes the table
//! when all are finished.

mod collection;
mod join;
pub(crate) mod member;
#[cfg(feature = "parquet")]
mod parquet;
mod parts;
mod table;

pub use crate::journal::JournalError;
pub use collection::Collection;
pub use member::Row;
pub use parts::{PartsError, SweepPart};
pub use table::{Columns, Failures};

use crate::journal::{Head, Kind};
use core::fmt::{self, Display, Formatter};
use core::num::NonZeroUsize;
use core::ops::ControlFlow;
use mbs::folder::{PART, WriteError, write_whole};
use mbs::record::Channel;
use mbs::results::ResultTable;
use mbs::{Method, Precision, ResolvedMethod, SettingsError};
use mbs_core::scene::{SETTINGS, Setting};
use mbs_parallel::ensemble::{Ensemble, EnsembleError, Panicked, available};
use mbs_parallel::most_threads;
use mbs_scene::{ReadError, SceneFile, SceneSweep, SweepFault, SweepRefusal, SweepSource};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Kind of the journal of a sweep.
const KIND: Kind = Kind {
    file: "sweep.journal",
    title: "mbs sweep journal",
    of: ["a sweep", "another sweep"],
    hashes: &["the scene", "the sweep", "an option"],
};

/// Scene with its sweep, checked and ready to run.
#[derive(Debug)]
pub struct Study {
    scene: SceneFile,
    sweep: SceneSweep,
    overrides: Method,
    settings: ResolvedMethod,
    columns: Columns,
    #[doc(hidden)]
    pub head: Head,
}

/// Reason why a study is refused.
#[derive(Debug)]
#[non_exhaustive]
pub enum StudyError {
    /// Refused scene or sweep file, with the place in the file.
    Read(ReadError),
    /// Refused path or number that a program varies.
    Path {
        /// Path of the numbers; empty if there are none.
        path: String,
        /// Fault of the path or of a number.
        fault: SweepFault,
    },
    /// Refused settings of the runs.
    Settings(SettingsError),
    /// Option that sets a number that the sweep varies; the path of this number.
    Varied(&'static str),
    /// Refused precision: members run in numbers of the hardware, not in double-double.
    Pairs,
}

/// Reason why members could not be run, or their table could not be written.
#[derive(Debug)]
#[non_exhaustive]
pub enum SweepError {
    /// Threads that the system does not provide.
    Threads(EnsembleError),
    /// Journal that cannot be used.
    Journal(JournalError),
    /// File that cannot be written.
    Write(WriteError),
    /// Parts that cannot be joined.
    Parts(PartsError),
    /// Sweep that was interrupted: number of members in the journal, and of all members.
    Interrupted([usize; 2]),
}

/// Outcome of a sweep.
#[derive(Debug)]
pub struct Report {
    /// Number of members of the sweep.
    pub members: usize,
    /// Number of members whose run completed.
    pub completed: usize,
    /// Number of members that an earlier start of the same sweep had finished.
    pub resumed: usize,
    /// Members whose run failed, by error code.
    pub failures: Failures,
    /// Number of threads that ran members.
    pub threads: usize,
    /// Time from the first member to the table [s].
    pub wall_seconds: f64,
    /// CPU time of the members that ran now [s].
    pub cpu_seconds: f64,
    /// Rows of the table, as texts.
    pub rows: Vec<Vec<String>>,
    /// Paths of the tables written.
    pub tables: Vec<PathBuf>,
    /// Reason why a table could not be written, if so. The journal has all members.
    pub lost: Option<WriteError>,
}

/// Rows by member, from 0, as texts.
type Rows = BTreeMap<usize, Vec<String>>;

/// Task of a sweep: the members to run, the directory, and the threads.
#[derive(Debug, Clone, Copy)]
pub struct SweepTask<'a> {
    /// Directory of journal and table.
    pub out: &'a Path,
    /// Number of threads of the sweep. Default: all processors.
    pub threads: Option<NonZeroUsize>,
    /// True if an earlier journal is discarded, even the journal of another sweep.
    pub anew: bool,
    /// Part of the sweep to run, without a table. Default: all members.
    pub part: Option<SweepPart>,
}

/// Observer of the progress of a sweep; its function does nothing by default.
pub trait Watch {
    /// Receives the number of finished members, of failed ones among them, and of all.
    fn finished(&mut self, done: usize, failed: usize, members: usize) {
        let _ = (done, failed, members);
    }
}

impl Watch for () {}

impl Study {
    /// Applies a sweep to a scene and checks its values.
    ///
    /// Cost: the scene is read once for each value of a list, and a few times for each range.
    ///
    /// # Errors
    /// Errors of the scene, the sweep or the settings. Errors that depend on a combination of values are found when the member runs.
    pub fn new(
        scene: SceneFile,
        sweep: &SweepSource,
        overrides: &Method,
    ) -> Result<Self, StudyError> {
        let data = scene.scene::<f64>().map_err(StudyError::Read)?;
        let settings = ResolvedMethod::new(&data, overrides).map_err(StudyError::Settings)?;
        if settings.precision == Precision::DoubleDouble {
            return Err(StudyError::Pairs);
        }
        let columns = Columns::new(&Channel::of_scene(&data));
        let options = format!("{overrides:?}");
        let head = Head::new(KIND, &[&scene.whole_text(), &sweep.text(), &options]);
        let sweep = SceneSweep::new(sweep, &scene, columns.taken())?;
        let varied = |path: &str| sweep.varies(&scene, path);
        let is_given = |row: &&Setting| overrides.value(row.name).is_some() && varied(row.path);
        if let Some(row) = SETTINGS.iter().find(is_given) {
            return Err(StudyError::Varied(row.path));
        }
        let check = sweep.check(&scene, |scene| match ResolvedMethod::new(scene, overrides) {
            Err(error @ SettingsError::NotPositive { .. }) => {
                Err((error.to_string(), error.hint()))
            }
            _ => Ok(()),
        });
        check?;
        let columns = columns.with_parameters(sweep.names());
        Ok(Self { scene, sweep, overrides: overrides.clone(), settings, columns, head })
    }

    /// Returns the number of members.
    #[must_use]
    pub fn n_members(&self) -> usize {
        self.sweep.n_members()
    }

    /// Columns of the table.
    #[must_use]
    pub fn columns(&self) -> &Columns {
        &self.columns
    }

    /// Settings of the scene before its numbers are varied.
    #[must_use]
    pub fn settings(&self) -> &ResolvedMethod {
        &self.settings
    }

    /// Runs one member on this thread; `index` is from 0.
    #[must_use]
    pub fn member(&self, index: usize) -> Row {
        member::run(&self.scene, &self.sweep, &self.overrides, index)
    }

    /// Runs one member again on this thread and returns its rows; `index` is from 0. `None` if the member does not start.
    #[must_use]
    pub fn member_rows(&self, index: usize) -> Option<ResultTable> {
        member::rows(&self.scene, &self.sweep, &self.overrides, index)
    }

    /// Runs the members that are not in the journal of the directory, on several threads, and writes the table. For a part no table is
    /// written.
    ///
    /// Except for CPU times, rows do not depend on the number of threads. A finished member is written to the journal before the next result
    /// is processed. Killing the process loses only members that are running.
    ///
    /// # Errors
    /// Threads that the system does not provide; a journal of another scene, sweep or version; a journal in use; a directory that cannot be
    /// written; an interrupt.
    pub fn run(&self, task: &SweepTask<'_>, watch: &mut impl Watch) -> Result<Report, SweepError> {
        self.run_jobs(task, watch, |i| self.member(i))
    }

    /// Runs all members on several threads (default: all processors), without files. Rows are in the order of the members. After an
    /// interrupt, rows are missing.
    ///
    /// # Errors
    /// Threads that the system does not provide.
    pub fn rows(
        &self,
        threads: Option<NonZeroUsize>,
        watch: &mut impl Watch,
    ) -> Result<Vec<Row>, EnsembleError> {
        let all: Vec<usize> = (0..self.n_members()).collect();
        let (mut rows, mut failed) = (BTreeMap::new(), 0);
        self.ensemble(threads, all.len())?.run(
            &all,
            |i| self.member(i),
            |i, row| {
                if self.overrides.interrupt.is_set() {
                    return ControlFlow::Break(());
                }
                let row = row.unwrap_or_else(|panic| self.panicked(i, &panic));
                failed += usize::from(row.failure.is_some());
                rows.insert(i, row);
                watch.finished(rows.len(), failed, all.len());
                ControlFlow::Continue(())
            },
        );
        Ok(rows.into_values().collect())
    }

    /// Makes threads for `n` members.
    fn ensemble(&self, threads: Option<NonZeroUsize>, n: usize) -> Result<Ensemble, EnsembleError> {
        let most = NonZeroUsize::new(n.min(most_threads())).unwrap_or(NonZeroUsize::MIN);
        Ensemble::new(Some(threads.unwrap_or_else(available).min(most)))
    }

    /// Runs the members as [`Self::run`] does, with a given function for one member.
    ///
    /// # Errors
    /// Those of [`Self::run`].
    #[doc(hidden)]
    pub fn run_jobs(
        &self,
        task: &SweepTask<'_>,
        watch: &mut impl Watch,
        job: impl Fn(usize) -> Row + Sync,
    ) -> Result<Report, SweepError> {
        let mut collection = self.collect_part(task.out, task.anew, task.part)?;
        let part = task.part.unwrap_or(SweepPart::WHOLE);
        let members = part.members(self.n_members());
        let n_members = members.len();
        let todo: Vec<usize> = members.filter(|i| !collection.rows.contains_key(i)).collect();
        let ensemble = self.ensemble(task.threads, todo.len()).map_err(SweepError::Threads)?;
        let is_failed = |row: &&Vec<String>| !self.columns.is_completed(row);
        let mut failed = collection.rows.values().filter(is_failed).count();
        let mut taken = Ok(());
        watch.finished(collection.rows.len(), failed, n_members);
        ensemble.run(&todo, job, |i, row: Result<Row, Panicked>| {
            // an interrupted run has no result
            if self.overrides.interrupt.is_set() {
                return ControlFlow::Break(());
            }
            let row = row.unwrap_or_else(|panic| self.panicked(i, &panic));
            taken = self.take(&mut collection, self.columns.cells(&row));
            if taken.is_err() {
                return ControlFlow::Break(());
            }
            failed += usize::from(row.failure.is_some());
            watch.finished(collection.rows.len(), failed, n_members);
            ControlFlow::Continue(())
        });
        taken?;
        let done = collection.rows.len();
        if done < n_members && self.overrides.interrupt.is_set() {
            return Err(SweepError::Interrupted([done, n_members]));
        }
        Ok(self.report_of(collection, ensemble.threads(), task.part.is_none()))
    }

    /// Makes the row of a member without a result: its run ended every process that tried it.
    #[must_use]
    pub fn lost(&self, index: usize) -> Row {
        let values = self.sweep.values(index).map(str::to_owned).collect();
        let message = "the processes that ran this member ended before it did";
        Row::failed(index, values, "worker-lost", message)
    }

    /// Returns the report of the sweep, with all rows.
    fn report(
        &self,
        (rows, resumed): (Rows, usize),
        (threads, begun, cpu_seconds): (usize, Instant, f64),
        tables: Result<Vec<PathBuf>, WriteError>,
    ) -> Report {
        let (tables, lost) = match tables {
            Ok(tables) => (tables, None),
            Err(error) => (Vec::new(), Some(error)),
        };
        Report {
            members: rows.len(),
            completed: rows.values().filter(|row| self.columns.is_completed(row)).count(),
            resumed,
            failures: self.columns.failures(rows.values()),
            threads,
            wall_seconds: begun.elapsed().as_secs_f64(),
            cpu_seconds,
            rows: rows.into_values().collect(),
            tables,
            lost,
        }
    }

    /// Makes the row of a member that panicked.
    fn panicked(&self, index: usize, panic: &Panicked) -> Row {
        let values = self.sweep.values(index).map(str::to_owned).collect();
        Row::failed(index, values, "panicked", &panic.to_string())
    }

    /// Writes the tables of the sweep. A table file is complete at every time.
    fn write(&self, out: &Path, rows: &Rows) -> Result<Vec<PathBuf>, WriteError> {
        let put = |name: &str, bytes: std::io::Result<Vec<u8>>| {
            let path = out.join(name);
            let failed = |error| WriteError { path: path.clone(), bytes: 0, error };
            let done = bytes.map_err(failed).and_then(|bytes| write_whole(out, name, &bytes));
            done.map(|()| path.clone())
        };
        let mut csv = Vec::new();
        let written = self.columns.write_csv(&mut csv, rows.values());
        #[allow(unused_mut, reason = "with the feature `parquet` there are two")]
        let mut tables = vec![put("table.csv", written.map(|()| csv))?];
        #[cfg(feature = "parquet")]
        {
            let mut table = Vec::new();
            let written = parquet::write(&mut table, &self.columns, rows);
            tables.push(put("table.parquet", written.map(|()| table))?);
        }
        let _ = std::fs::remove_dir(out.join(PART));
        Ok(tables)
    }
}

/// Returns the complete rows by member. Members with an incomplete row run again.
pub fn whole_rows(lines: Vec<Vec<String>>, n_cells: usize, n_members: usize) -> Rows {
    let rows = lines.into_iter().filter_map(|cells| {
        let member = cells.first()?.parse::<usize>().ok()?.checked_sub(1)?;
        (cells.len() == n_cells && member < n_members).then_some((member, cells))
    });
    rows.collect()
}

impl From<SweepRefusal> for StudyError {
    fn from(refusal: SweepRefusal) -> Self {
        match refusal {
            SweepRefusal::File(error) => Self::Read(error),
            SweepRefusal::Numbers { path, fault } => Self::Path { path, fault },
        }
    }
}

impl From<PartsError> for SweepError {
    fn from(error: PartsError) -> Self {
        Self::Parts(error)
    }
}

impl From<JournalError> for SweepError {
    fn from(error: JournalError) -> Self {
        match error {
            JournalError::Io(error) => {
                Self::Write(WriteError { path: PathBuf::from(KIND.file), bytes: 0, error })
            }
            other => Self::Journal(other),
        }
    }
}

impl Display for StudyError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read(error) => write!(f, "{error}"),
            Self::Path { path, fault } if path.is_empty() => write!(f, "{fault}"),
            Self::Path { path, fault } => write!(f, "`{path}`: {fault}"),
            Self::Settings(error) => write!(f, "{error}"),
            Self::Varied(path) => write!(f, "the sweep varies `{path}`, which is given as well"),
            Self::Pairs => write!(f, "a sweep runs in `f32` or `f64`, not in `dd`"),
        }
    }
}

impl Display for SweepError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Threads(error) => write!(f, "{error}"),
            Self::Journal(error) => write!(f, "{error}"),
            Self::Write(error) => write!(f, "{error}"),
            Self::Parts(error) => write!(f, "{error}"),
            Self::Interrupted([done, members]) => write!(
                f,
                "interrupted by a signal: {done} of {members} members are finished and kept"
            ),
        }
    }
}

impl core::error::Error for StudyError {}
impl core::error::Error for SweepError {}

//! Checked run: a mechanism and the options of its run.

use super::conflict::RunConflict;
use super::mechanism::Mechanism;
use super::options::{Run, Watchers};
use super::result::RunResult;
use crate::checkpoint::CheckpointWriter;
use crate::erased::SimulationError;
use crate::erased::inputs::Inputs;
use crate::erased::scene_run::SceneRun;
use crate::names::Names;
use crate::precision::ReadScene;
use crate::settings::{Method, ResolvedMethod};
use mbs_core::scene::Scene;
use mbs_steps::realtime::{Clock, SystemClock};
use mbs_steps::run::Outcome;
use std::borrow::Cow;
use std::sync::OnceLock;

/// Checked run: the settings suit the scene, and the options do not contradict each other.
#[derive(Debug)]
pub struct PreparedRun<'a> {
    mechanism: Cow<'a, Mechanism>,
    options: &'a Run,
    /// Requested method, completed by the settings of the checkpoint if the run resumes from one.
    pub method: Method,
    /// Scene in `f64`, in which inputs follow the given table.
    pub scene: Scene<f64>,
    /// Settings of the run. With a goal, trial runs choose other settings later.
    pub settings: ResolvedMethod,
}

impl<'a> PreparedRun<'a> {
    /// Checks mechanism and options, and decides the settings that both leave open.
    ///
    /// # Errors
    /// [`SimulationError`] for a mechanism, an option or a checkpoint that is refused.
    pub fn new(m: &'a Mechanism, options: &'a Run) -> Result<Self, SimulationError> {
        RunConflict::check(options, m.functions().len())?;
        let method = match &options.resume {
            Some(from) => from.overrides(&options.method).map_err(SimulationError::not_resumed)?,
            None => options.method.clone(),
        };
        let mechanism = match &options.inputs {
            Some(table) => Cow::Owned(m.following(table)?),
            None => Cow::Borrowed(m),
        };
        let own = m.resolve()?;
        // settings are checked against the scene without the table: a table may begin and end at other times than the run
        let settings = ResolvedMethod::new(&own, &method)?;
        settings.check_step(&own, &method)?;
        let scene = if options.inputs.is_some() { mechanism.resolve()? } else { own };
        let settings = match &options.resume {
            Some(from) => from.settle(settings).map_err(SimulationError::not_resumed)?,
            None => settings,
        };
        Ok(Self { mechanism, options, method, scene, settings })
    }

    /// Checks that the options allow the watchers of the run.
    ///
    /// # Errors
    /// [`SimulationError`] with a [`RunConflict`].
    pub fn check(&self, watchers: &Watchers<'_, '_>) -> Result<(), SimulationError> {
        Ok(RunConflict::check_watchers(self.options, watchers)?)
    }

    /// Options of the run.
    pub fn options(&self) -> &Run {
        self.options
    }

    /// Reads the scene in the precision of the run.
    ///
    /// # Errors
    /// [`SimulationError`] where the scene cannot be read in this precision.
    pub fn read(&self) -> Result<ReadScene<'_>, SimulationError> {
        ReadScene::of(&*self.mechanism, Cow::Borrowed(&self.scene), self.settings.precision)
    }

    /// Runs the mechanism to the end of its duration.
    ///
    /// # Errors
    /// [`SimulationError`] in four cases: the options do not allow the watchers, another run uses the folder of checkpoints, the checkpoint
    /// belongs to another mechanism or method, or the pacing is refused.
    pub fn run(&self, watchers: &mut Watchers<'_, '_>) -> Result<RunResult, SimulationError> {
        self.check(watchers)?;
        let checkpoints = self.options.checkpoints.as_ref();
        let writer = checkpoints.map(|(folder, every)| CheckpointWriter::new(folder, *every));
        let mut writer = writer.transpose().map_err(SimulationError::not_resumed)?;
        let read = self.read()?;
        let outcome = self.outcome(&read, &self.settings, (watchers, writer.as_mut()))?;
        if let Some(writer) = &mut writer {
            writer.release();
        }
        let settings = self.settings.clone();
        Ok(RunResult { checkpoints: writer, ..self.result(outcome, settings) })
    }

    /// Runs the mechanism with given settings. Their precision must be that of `read`.
    ///
    /// # Errors
    /// Those of [`run`](Self::run).
    pub fn run_by(
        &self,
        read: &ReadScene<'_>,
        settings: &ResolvedMethod,
        watchers: &mut Watchers<'_, '_>,
    ) -> Result<Outcome, SimulationError> {
        self.check(watchers)?;
        self.outcome(read, settings, (watchers, None))
    }

    /// Makes the result of a run from its outcome and the settings that it was made with.
    pub fn result(&self, outcome: Outcome, settings: ResolvedMethod) -> RunResult {
        let mechanism = match &self.mechanism {
            Cow::Owned(driven) => Some(driven.clone()),
            Cow::Borrowed(_) => None,
        };
        let names = Names::new(&self.scene);
        let (checkpoints, table) = (None, OnceLock::new());
        RunResult { outcome, settings, names, mechanism, checkpoints, table }
    }

    fn outcome(
        &self,
        read: &ReadScene<'_>,
        settings: &ResolvedMethod,
        (watchers, writer): (&mut Watchers<'_, '_>, Option<&mut CheckpointWriter>),
    ) -> Result<Outcome, SimulationError> {
        let mut system = SystemClock::new();
        let clock: &mut dyn Clock = match &mut watchers.clock {
            Some(clock) => *clock,
            None => &mut system,
        };
        let run = SceneRun {
            settings,
            names: &Names::new(&self.scene),
            keep: self.options.keep(),
            functions: self.mechanism.functions(),
            observers: (&mut *watchers.observers, Inputs::new(&self.scene)),
            progress: watchers.progress.as_deref_mut().map(|listener| listener as _),
            checkpoints: (self.options.resume.as_ref(), writer),
            pace: self.options.pacing.as_ref().map(|pacing| (pacing, clock)),
        };
        run.run(read)
    }
}

//! Trial runs of a scene, timed by a given clock.

use super::trial::{Aim, Bench, Rows, Trial, TrialEnd};
use crate::compare::course::Course;
use crate::compare::ladder::{Instants, work};
use crate::compare::method::{Control, MethodCase};
use crate::compare::results::{output_scales, row_distance};
use core::ops::ControlFlow;
use mbs::inside::{Alarm, AssembledScene, Channels, DEFAULT_STEP, continue_if, drive};
use mbs::record::{Channel, RunError};
use mbs::typed::{Simulation, StepObserver};
use mbs::{Method, Names, ResolvedMethod, SettingsError, StopError};
use mbs_core::Real;
use mbs_core::cluster::scene_length;
use mbs_core::control::Accepted;
use mbs_core::scene::Scene;
use mbs_core::step::StepError;

/// Number of steps between two readings of the clock, unless each step is timed [-]. The shortest steps take less time than one reading.
const STRIDE: u64 = 8;
/// Limit of steps in the first interval, for an integrator with its own step control [-]. The clock is not read within an interval, so only
/// this limit ends an interval with far too many steps.
const FIRST_STEPS: u32 = 1000;

/// Clock that a pilot measures time by: the processor's clock, or a clock that counts work.
pub trait Clock {
    /// Time since an arbitrary start [s].
    fn seconds(&mut self) -> f64;

    /// Receives the work of each step as a nominal time [s], which is the same in every run. The default does nothing.
    fn worked(&mut self, nominal: f64) {
        let _ = nominal;
    }
}

/// Test bench for trial runs of one scene.
pub(crate) struct SceneBench<'a, T: Real, const D: usize> {
    scene: &'a Scene<T>,
    base: &'a Method,
    instants: Instants,
    channels: Vec<Channel>,
    length: f64,
    /// Assembled scene that all trials begin from, or the error that stopped its assembly.
    ready: &'a Result<AssembledScene<T, D>, Box<RunError>>,
    clock: &'a mut dyn Clock,
    begun: f64,
}

impl<'a, T: Real, const D: usize> SceneBench<'a, T, D> {
    /// Makes a bench whose elapsed time starts at `spent` [s], the time that was used before.
    pub(crate) fn new(
        (scene, base): (&'a Scene<T>, &'a Method),
        ready: &'a Result<AssembledScene<T, D>, Box<RunError>>,
        instants: Instants,
        (clock, spent): (&'a mut dyn Clock, f64),
    ) -> Self {
        let begun = clock.seconds() - spent;
        let channels = Channel::of_scene(scene);
        let length = scene_length(scene).to_f64();
        Self { scene, base, instants, channels, length, ready, clock, begun }
    }

    /// Makes a simulation at its start, with its outputs and its energy alarm.
    fn start(
        &self,
        method: &MethodCase,
        setting: f64,
    ) -> Result<(Simulation<T, D>, Channels<T, D>, f64), Box<RunError>> {
        let settings = settings(self.scene, self.base, method, (setting, self.instants));
        let settings = settings.map_err(|e| Box::new(refused(&e)))?;
        let ready = self.ready.as_ref().map_err(Clone::clone)?;
        let simulation = Simulation::<T, D>::of(self.scene, &settings, ready.clone());
        let both = simulation.and_then(|simulation| {
            let channels = Channels::new(self.scene, simulation.model())?;
            Ok((simulation, channels, settings.energy_alarm))
        });
        both.map_err(|e| Box::new(e.report(0.0, &Names::new(self.scene))))
    }

    /// Runs a method over the span of the trials. The trial is given up after `limit` [s].
    fn run(&mut self, method: &MethodCase, setting: f64, aim: Aim, limit: f64) -> Trial {
        let started = self.start(method, setting);
        let (mut simulation, channels, alarm) = match started {
            Ok(started) => started,
            Err(error) => return not_started(*error),
        };
        let [coordinates, constraints, _] = simulation.sizes();
        let n_columns = self.channels.iter().map(|c| c.components.len()).sum();
        let begun = self.clock.seconds();
        let mut recorder = Recorder {
            channels: (aim != Aim::Time).then_some(channels),
            alarm: Alarm::new(alarm),
            row: vec![T::ZERO; n_columns],
            rows: Vec::new(),
            clock: &mut *self.clock,
            per_iteration: work(1, coordinates + constraints),
            is_fine: aim == Aim::Steps,
            begun,
            limit,
            last: begun,
            slowest: 0.0,
            steps: 0,
            reached: 0.0,
            is_late: false,
        };
        let between = method.is_fixed().then(|| self.instants.steps_between(setting));
        let is_own = method.control == Control::Own;
        let course = Course { instants: self.instants, between };
        let mut stretches = course.stretches();
        let interrupt = &self.base.interrupt;
        let mut end = Ok(());
        if is_own {
            // one call of the integrator may cover a whole interval; only the limit of its internal steps ends it
            simulation.formulation_mut().set_max_steps(FIRST_STEPS);
            end = drive(&mut simulation, stretches.next(), interrupt, &mut recorder);
            let steps = recorder.steps_in(limit);
            simulation.formulation_mut().set_max_steps(steps.max(FIRST_STEPS));
        }
        if end.is_ok() && !recorder.is_late {
            end = drive(&mut simulation, stretches, interrupt, &mut recorder);
        }
        let Recorder { rows, steps, reached, slowest, is_late, .. } = recorder;
        let seconds = self.clock.seconds() - begun;
        let end = match end {
            Ok(()) if !is_late => TrialEnd::Done,
            Err(StopError::Step(StepError::StepTooSmall { .. }, _))
                if is_own && seconds >= 0.5 * limit =>
            {
                TrialEnd::GivenUp
            }
            Err(error) if !is_late => {
                TrialEnd::Stopped(error.report(reached, &Names::new(self.scene)))
            }
            _ => TrialEnd::GivenUp,
        };
        let slowest = (aim == Aim::Steps).then_some(slowest);
        let span = self.instants.time(self.instants.count);
        Trial { rows, seconds, steps, reached: (reached / span).min(1.0), slowest, end }
    }
}

impl<T: Real, const D: usize> Bench for SceneBench<'_, T, D> {
    fn trial(&mut self, method: &MethodCase, setting: f64, aim: Aim, limit: f64) -> Trial {
        self.run(method, setting, aim, limit)
    }

    fn spent(&mut self) -> f64 {
        self.clock.seconds() - self.begun
    }

    fn distance(&self, reference: &Rows, rows: &Rows) -> f64 {
        let scales = output_scales(&self.channels, reference, self.length);
        let distances = reference.iter().zip(rows).map(|(a, b)| row_distance(&scales, a, b)[0]);
        let largest = distances.fold(0.0, |most: f64, d| if d.is_nan() { d } else { most.max(d) });
        if reference.len() == rows.len() && largest.is_finite() { largest } else { f64::INFINITY }
    }
}

fn not_started(error: RunError) -> Trial {
    let end = TrialEnd::NotStarted(error);
    Trial { rows: Vec::new(), seconds: 0.0, steps: 0, reached: 0.0, slowest: None, end }
}

fn refused(error: &SettingsError) -> RunError {
    RunError {
        code: "settings-refused".to_owned(),
        message: error.to_string(),
        hint: error.hint(),
        ..RunError::default()
    }
}

/// Returns the settings of a run with a method. Settings that the method does not decide are the caller's.
pub(crate) fn settings<T: Real>(
    scene: &Scene<T>,
    base: &Method,
    method: &MethodCase,
    (setting, instants): (f64, Instants),
) -> Result<ResolvedMethod, SettingsError> {
    let duration = base.duration.unwrap_or(scene.duration.to_f64());
    let of_scene = scene.solver.step.map_or(DEFAULT_STEP, Real::to_f64).min(duration);
    let step = if method.is_fixed() {
        instants.interval / instants.steps_between(setting) as f64
    } else {
        of_scene
    };
    let overrides = Method {
        events: base.events,
        energy_alarm: base.energy_alarm,
        duration: base.duration,
        penalty: base.penalty.filter(|_| method.formulation.scene_penalty().is_some()),
        interrupt: base.interrupt.clone(),
        threads: base.threads.filter(|_| method.formulation.row().threads),
        ..method.overrides(setting, step, instants.interval)
    };
    ResolvedMethod::new(scene, &overrides)
}

/// Recorder of a trial, which stops the trial after its time limit.
struct Recorder<'a, T: Real, const D: usize> {
    channels: Option<Channels<T, D>>,
    alarm: Alarm,
    row: Vec<T>,
    rows: Rows,
    clock: &'a mut dyn Clock,
    per_iteration: f64,
    /// True if the clock is read at every step.
    is_fine: bool,
    begun: f64,
    /// Longest time that the trial may take [s].
    limit: f64,
    last: f64,
    slowest: f64,
    steps: u64,
    reached: f64,
    is_late: bool,
}

impl<T: Real, const D: usize> Recorder<'_, T, D> {
    /// Number of steps that fit into a time [s] at the rate of the steps so far.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a rough count")]
    fn steps_in(&mut self, limit: f64) -> u32 {
        (self.steps as f64 * limit / (self.clock.seconds() - self.begun)) as u32
    }
}

impl<T: Real, const D: usize> StepObserver<T, D> for Recorder<'_, T, D> {
    fn step(
        &mut self,
        simulation: &Simulation<T, D>,
        accepted: &Accepted<T>,
        is_last: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        let report = &accepted.attempt.report;
        self.clock.worked(f64::from(report.iterations) * self.per_iteration);
        let before = self.steps;
        self.steps += u64::from(report.steps.max(1));
        self.reached = simulation.state().t.to_f64();
        if self.is_fine || before / STRIDE != self.steps / STRIDE {
            let now = self.clock.seconds();
            self.slowest = self.slowest.max(now - self.last);
            self.is_late = now - self.begun > self.limit;
            self.last = now;
        }
        let Some(channels) = &mut self.channels else { return Ok(continue_if(!self.is_late)) };
        channels.track(simulation)?;
        let stop = self.alarm.rings(simulation, is_last);
        if self.is_fine {
            self.last = self.clock.seconds();
        }
        stop.map_or(Ok(continue_if(!self.is_late)), Err)
    }

    fn instant(&mut self, simulation: &Simulation<T, D>) -> Result<ControlFlow<()>, StopError> {
        if let Some(channels) = &mut self.channels {
            channels.write(simulation, &mut self.row)?;
            self.rows.push(self.row.iter().copied().map(Real::to_f64).collect());
            if self.is_fine {
                self.last = self.clock.seconds();
            }
        }
        Ok(continue_if(!self.is_late))
    }
}

//! Trials of a scene, on a clock that is given.

use super::trial::{Aim, Bench, End, Rows, Time, Trial};
use crate::compare::course::Course;
use crate::compare::ladder::{Instants, count, work};
use crate::compare::method::{Control, MethodCase};
use crate::compare::results::{output_scales, row_distance};
use core::ops::ControlFlow;
use mbs::Names;
use mbs::StopError;
use mbs::inside::Alarm;
use mbs::inside::AssembledScene;
use mbs::inside::Channels;
use mbs::inside::DEFAULT_STEP;
use mbs::inside::{continue_if, drive};
use mbs::record::{Channel, RunError};
use mbs::typed::Simulation;
use mbs::typed::StepObserver;
use mbs::{InSpace, Plane};
use mbs::{Method, Settings, SettingsError};
use mbs_core::Real;
use mbs_core::cluster::scene_length;
use mbs_core::control::Accepted;
use mbs_core::scene::Scene;
use mbs_core::step::StepError;

/// The clock is read every so many steps where each takes no longer than this [s], and steps are not timed one by one.
const STRIDE: u64 = 8;
const SOON: f64 = 1e-5;
/// The first interval of an integrator that controls its own steps is cut into so many, to see how long it takes.
const CAUTIOUS: u64 = 4;
/// A trial is begun where its first interval promises no more than so many times what it may take.
const DOUBT: f64 = 10.0;
/// Steps that it may try in a piece of that.
const FEW: u32 = 300;

/// What a pilot measures time by: a processor's clock, or one that counts work.
pub trait Clock {
    /// Time since some beginning [s].
    fn seconds(&mut self) -> f64;

    /// Told of the work of each step [s, nominal: the same every time].
    fn worked(&mut self, nominal: f64) {
        let _ = nominal;
    }
}

/// A scene on the bench.
pub(crate) struct SceneBench<'a, T: Real, const D: usize> {
    scene: &'a Scene<T>,
    base: &'a Method,
    instants: Instants,
    channels: Vec<Channel>,
    length: f64,
    /// What all trials begin from, or why none can.
    ready: &'a Result<AssembledScene<T, D>, Box<RunError>>,
    clock: &'a mut dyn Clock,
    begun: f64,
    /// Steps that an integrator of its own control may try in an interval.
    most_steps: Option<u32>,
}

impl<'a, T: Real, const D: usize> SceneBench<'a, T, D>
where
    Plane<D>: InSpace<T>,
{
    /// A bench on which so many seconds were spent before.
    pub(crate) fn new(
        (scene, base): (&'a Scene<T>, &'a Method),
        ready: &'a Result<AssembledScene<T, D>, Box<RunError>>,
        instants: Instants,
        (clock, spent): (&'a mut dyn Clock, f64),
    ) -> Self {
        let begun = clock.seconds() - spent;
        let channels = Channel::of_scene(scene);
        let length = scene_length(scene).to_f64();
        Self { scene, base, instants, channels, length, ready, clock, begun, most_steps: None }
    }

    /// A simulation ready to step, with its outputs and its alarm.
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

    /// Runs the span, with so many steps between two instants where they are counted.
    fn run(
        &mut self,
        (method, between): (&MethodCase, Option<u64>),
        setting: f64,
        aim: Aim,
        time: Time,
    ) -> Trial {
        let started = self.start(method, setting);
        let (mut simulation, channels, alarm) = match started {
            Ok(started) => started,
            Err(error) => return Trial { end: End::NotStarted(*error), ..nothing() },
        };
        if let Some(most) = self.most_steps {
            simulation.formulation_mut().set_max_steps(most);
        }
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
            is_slow: true,
            time,
            begun,
            span: self.instants.time(self.instants.count),
            last: begun,
            slowest: 0.0,
            steps: 0,
            reached: 0.0,
            is_late: false,
        };
        let course = Course { instants: self.instants, between };
        let end = drive(&mut simulation, course.stretches(), &self.base.interrupt, &mut recorder);
        let Recorder { rows, steps, reached, slowest, is_late, span, .. } = recorder;
        let seconds = self.clock.seconds() - begun;
        let end = match end {
            Err(_) if is_late => End::GivenUp,
            Err(StopError::Step(StepError::StepTooSmall { .. }, _))
                if self.most_steps.is_some() =>
            {
                End::GivenUp
            }
            Err(error) => End::Stopped(error.report(reached, &Names::new(self.scene))),
            Ok(()) if is_late => End::GivenUp,
            Ok(()) => End::Done,
        };
        let slowest = (aim == Aim::Steps).then_some(slowest);
        Trial { rows, seconds, steps, reached: (reached / span).min(1.0), slowest, end }
    }
}

impl<T: Real, const D: usize> Bench for SceneBench<'_, T, D>
where
    Plane<D>: InSpace<T>,
{
    fn trial(&mut self, method: &MethodCase, setting: f64, aim: Aim, time: Time) -> Trial {
        if method.control == Control::Own && aim == Aim::Rows {
            // one step of it may be a whole interval, which nothing interrupts
            let whole = self.instants;
            self.instants = Instants { count: 1, ..whole };
            self.most_steps = Some(FEW);
            let probe =
                self.run((method, Some(CAUTIOUS)), setting, Aim::Time, Time::strictly(time.most));
            self.instants = whole;
            let share = 1.0 / count(whole.count);
            // pieces take more steps, and the first ones the search for their length
            if probe.end != End::Done || probe.seconds > DOUBT * share * time.most {
                let reached = probe.reached * share * DOUBT;
                return Trial { reached, end: late(probe.end), ..probe };
            }
            #[allow(clippy::cast_precision_loss, reason = "a rough number")]
            let a_step = probe.seconds / probe.steps.max(1) as f64;
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "capped")]
            let steps = (time.at_last / a_step).clamp(f64::from(FEW), 1e6) as u32;
            self.most_steps = Some(steps);
            let trial = self.run((method, None), setting, aim, time);
            self.most_steps = None;
            return trial;
        }
        self.most_steps = None;
        let between = method.is_fixed().then(|| self.instants.steps_between(setting));
        self.run((method, between), setting, aim, time)
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

fn late(end: End) -> End {
    if end == End::Done { End::GivenUp } else { end }
}

fn nothing() -> Trial {
    let end = End::GivenUp;
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

/// Settings of a run with a method, beside what the caller asks for.
pub(crate) fn settings<T: Real>(
    scene: &Scene<T>,
    base: &Method,
    method: &MethodCase,
    (setting, instants): (f64, Instants),
) -> Result<Settings, SettingsError> {
    let duration = base.duration.unwrap_or(scene.duration.to_f64());
    let of_scene = scene.solver.step.map_or(DEFAULT_STEP, Real::to_f64).min(duration);
    let step = if method.is_fixed() {
        instants.interval / count(instants.steps_between(setting) as usize)
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
    Settings::new(scene, &overrides)
}

/// Records a trial, and gives it up when its time is over.
struct Recorder<'a, T: Real, const D: usize> {
    channels: Option<Channels<T, D>>,
    alarm: Alarm,
    row: Vec<T>,
    rows: Rows,
    clock: &'a mut dyn Clock,
    per_iteration: f64,
    /// Is every step timed?
    is_fine: bool,
    /// Do a few steps take so long that the clock is read after each?
    is_slow: bool,
    time: Time,
    begun: f64,
    span: f64,
    last: f64,
    slowest: f64,
    steps: u64,
    reached: f64,
    is_late: bool,
}

impl<T: Real, const D: usize> StepObserver<T, D> for Recorder<'_, T, D>
where
    Plane<D>: InSpace<T>,
{
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
        if self.is_fine || self.is_slow || before / STRIDE != self.steps / STRIDE {
            let now = self.clock.seconds();
            self.is_slow =
                now - self.last > SOON * if self.is_slow { 1.0 } else { count(STRIDE as usize) };
            self.slowest = self.slowest.max(now - self.last);
            self.is_late = self.time.is_over(now - self.begun, self.reached / self.span);
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
            channels.write(simulation.state(), &mut self.row)?;
            self.rows.push(self.row.iter().copied().map(Real::to_f64).collect());
            if self.is_fine {
                self.last = self.clock.seconds();
            }
        }
        Ok(continue_if(!self.is_late))
    }
}

//! One run of a scene: either recorded, with its steps timed one by one, or timed as a whole.

use super::clocked::step_times;
use super::course::Course;
use super::ladder::work;
use super::layout::moved;
use crate::compare::results::{Energy, RunEntry, Status};
use core::ops::ControlFlow;
use core::time::Duration;
use cpu_time::ThreadTime;
use mbs::inside::{Alarm, Channels, ReadScene, SceneWork, continue_if, drive};
use mbs::record::Channel;
use mbs::typed::{Simulation, StepObserver};
use mbs::{Interrupt, Names, Precision, PrecisionError, ResolvedMethod, StopError};
use mbs_core::Real;
use mbs_core::control::Accepted;
use mbs_core::scene::Scene;
use mbs_scene::SceneFile;
use std::borrow::Cow;

/// Shortest time of a run that is timed only once [s]. A shorter run is repeated, and the shortest time counts. Chosen, not tuned.
const SHORT: f64 = 0.01;
/// Largest number of repetitions within one timing. Chosen, not tuned.
const MOST_FRESH: u32 = 10;
/// Largest number of steps that an integrator with its own step control tries between two instants. No clock is read between them. In
/// double-double, an integrator that fails at a kink of a force would otherwise take hours.
const MOST_OWN_STEPS: u32 = 2000;

/// Scene in each of the precisions that runs need.
#[derive(Debug)]
pub(super) struct Scenes {
    pub(super) double: Scene<f64>,
    read: Vec<(Precision, ReadScene<'static>)>,
    n_columns: usize,
    /// Interrupt by which the caller ends all runs.
    pub(super) interrupt: Interrupt,
}

/// Recorded results of a run.
#[derive(Debug, Default)]
pub(super) struct Recorded {
    /// All components of all channels at the instants that the run reached.
    pub(super) rows: Vec<Vec<f64>>,
    /// Entry of the run, without its errors and without timings of the whole run.
    pub(super) entry: RunEntry,
    /// Nominal time of the run, the same in every repetition [s].
    pub(super) work: f64,
    /// Whether the run was given up because it exceeded its time limit.
    pub(super) is_given_up: bool,
    /// Whether the run failed before its first step.
    pub(super) is_not_started: bool,
}

impl Scenes {
    /// Reads the scene in `f64` and in each precision that is named. Runs use the scenes in these precisions.
    pub(super) fn new(
        document: &SceneFile,
        precisions: &[Precision],
    ) -> Result<Self, PrecisionError> {
        let double = document.scene::<f64>()?;
        let read = |precision: Precision| {
            let scene = ReadScene::of(document, Cow::Borrowed(&double), precision)?;
            Ok((precision, scene.into_owned()))
        };
        let others = precisions.iter().copied().filter(|&precision| precision != Precision::F64);
        let precisions = [Precision::F64].into_iter().chain(others);
        let read = precisions.map(read).collect::<Result<_, PrecisionError>>()?;
        let n_columns = Channel::of_scene(&double).iter().map(|c| c.components.len()).sum();
        Ok(Self { double, read, n_columns, interrupt: Interrupt::default() })
    }

    fn of(&self, precision: Precision) -> Option<&ReadScene<'static>> {
        self.read.iter().find(|(of, _)| *of == precision).map(|(_, scene)| scene)
    }

    /// Settings of a run that the common interrupt can end.
    fn interruptible(&self, settings: &ResolvedMethod) -> ResolvedMethod {
        ResolvedMethod { interrupt: self.interrupt.clone(), ..settings.clone() }
    }

    /// Runs and records the scene, for at most `most` seconds of CPU time.
    pub(super) fn recorded(
        &self,
        settings: &ResolvedMethod,
        course: &Course,
        most: f64,
    ) -> Recorded {
        let Some(scene) = self.of(settings.precision) else {
            return Recorded { is_not_started: true, ..Recorded::default() };
        };
        let settings = &self.interruptible(settings);
        scene.work(ToRecord { settings, course, n_columns: self.n_columns, most })
    }

    /// CPU time of all steps from a new start [s]. If this time is short, several runs are made, and the shortest time is returned. Each value
    /// of `turn` places stack and heap elsewhere in memory.
    pub(super) fn timed(
        &self,
        settings: &ResolvedMethod,
        course: &Course,
        turn: u32,
    ) -> Option<f64> {
        let settings = &self.interruptible(settings);
        self.of(settings.precision)?.work(ToTime { settings, course, turn })
    }
}

/// A run that is timed.
struct ToTime<'a> {
    settings: &'a ResolvedMethod,
    course: &'a Course,
    turn: u32,
}

impl SceneWork for ToTime<'_> {
    type Done = Option<f64>;

    fn done<T: Real, const D: usize>(self, scene: &Scene<T>) -> Option<f64> {
        timed::<T, D>(scene, self.settings, self.course, self.turn)
    }
}

/// A run that is recorded.
struct ToRecord<'a> {
    settings: &'a ResolvedMethod,
    course: &'a Course,
    n_columns: usize,
    most: f64,
}

impl SceneWork for ToRecord<'_> {
    type Done = Recorded;

    fn done<T: Real, const D: usize>(self, scene: &Scene<T>) -> Recorded {
        recorded::<T, D>(scene, self.settings, self.course, (self.n_columns, self.most))
    }
}

fn timed<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    course: &Course,
    turn: u32,
) -> Option<f64> {
    let (mut least, mut sum) = (None::<f64>, 0.0);
    for k in 0..MOST_FRESH {
        let seconds = moved(turn * MOST_FRESH + k, || {
            let mut simulation = Simulation::<T, D>::new(scene, settings).ok()?;
            let clock = ThreadTime::now();
            drive(&mut simulation, course.stretches(), &settings.interrupt, &mut ()).ok()?;
            Some(clock.elapsed().as_secs_f64())
        })?;
        least = Some(least.map_or(seconds, |least| least.min(seconds)));
        sum += seconds;
        if sum >= SHORT {
            break;
        }
    }
    least
}

fn recorded<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    course: &Course,
    (n_columns, most): (usize, f64),
) -> Recorded {
    let started = Simulation::<T, D>::new(scene, settings).and_then(|simulation| {
        let channels = Channels::new(scene, simulation.model())?;
        Ok((simulation, channels))
    });
    let (mut simulation, channels) = match started {
        Ok(both) => both,
        Err(error) => {
            let failure = Some(error.report(0.0, &Names::new(scene)));
            let entry = RunEntry { status: Status::Failed, failure, ..RunEntry::default() };
            return Recorded { entry, is_not_started: true, ..Recorded::default() };
        }
    };
    simulation.formulation_mut().set_max_steps(MOST_OWN_STEPS);
    let mut recorder = Recorder {
        channels,
        alarm: Alarm::new(settings.energy_alarm),
        row: vec![T::ZERO; n_columns],
        rows: Vec::new(),
        most: Duration::from_secs_f64(most),
        violation: simulation.start.residual.map(Real::to_f64),
        steps: 0,
        iterations: 0,
        reached: 0.0,
        times: Vec::new(),
        is_given_up: false,
        last: Duration::ZERO,
        start: ThreadTime::now(),
    };
    let end = drive(&mut simulation, course.stretches(), &settings.interrupt, &mut recorder);
    recorder.finish(&simulation, end.err(), &Names::new(scene))
}

/// Recorder of a run.
struct Recorder<T: Real, const D: usize> {
    channels: Channels<T, D>,
    alarm: Alarm,
    row: Vec<T>,
    rows: Vec<Vec<f64>>,
    most: Duration,
    violation: [f64; 3],
    steps: u64,
    iterations: u64,
    reached: f64,
    times: Vec<f64>,
    is_given_up: bool,
    /// Time at which the next step begins.
    last: Duration,
    start: ThreadTime,
}

impl<T: Real, const D: usize> StepObserver<T, D> for Recorder<T, D> {
    fn step(
        &mut self,
        simulation: &Simulation<T, D>,
        accepted: &Accepted<T>,
        is_last: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        let now = self.start.elapsed();
        let report = &accepted.attempt.report;
        let steps = report.steps.max(1);
        self.times.push((now - self.last).as_secs_f64() / f64::from(steps));
        self.steps += u64::from(steps);
        self.iterations += u64::from(report.iterations);
        self.reached = simulation.state().t.to_f64();
        for (most, v) in self.violation.iter_mut().zip(report.violation) {
            *most = most.max(v.to_f64());
        }
        self.channels.track(simulation)?;
        let stop = self.alarm.rings(simulation, is_last);
        self.last = self.start.elapsed();
        stop.map_or(Ok(continue_if(true)), Err)
    }

    fn instant(&mut self, simulation: &Simulation<T, D>) -> Result<ControlFlow<()>, StopError> {
        self.channels.write(simulation, &mut self.row)?;
        self.rows.push(self.row.iter().copied().map(Real::to_f64).collect());
        self.last = self.start.elapsed();
        self.is_given_up = self.last > self.most;
        Ok(continue_if(!self.is_given_up))
    }
}

impl<T: Real, const D: usize> Recorder<T, D> {
    fn finish(
        self,
        simulation: &Simulation<T, D>,
        stop: Option<StopError>,
        names: &Names,
    ) -> Recorded {
        let invariant = simulation.invariant();
        let finite = |x: f64| x.is_finite().then_some(x);
        let [coordinates, constraints, _] = simulation.sizes();
        let mean_step = if self.steps > 0 { self.reached / self.steps as f64 } else { 0.0 };
        let entry = RunEntry {
            status: if stop.is_some() { Status::Failed } else { Status::Completed },
            failure: stop.map(|error| error.report(self.reached, names)),
            steps: self.steps,
            mean_step,
            iterations: self.iterations,
            clocked_seconds: self.times.iter().sum(),
            energy: Energy {
                max_error: finite(invariant.max_error()),
                turned_over: finite(invariant.turned_over()),
                drift: finite(invariant.drift()),
                scatter: finite(invariant.scatter()),
            },
            violation: self.violation.map(|v| if v.is_finite() { v } else { f64::MAX }),
            step_times: step_times(self.times, reading()),
            ..RunEntry::default()
        };
        Recorded {
            rows: self.rows,
            work: work(self.iterations, coordinates + constraints),
            entry,
            is_given_up: self.is_given_up,
            is_not_started: false,
        }
    }
}

/// CPU time of one reading of the clock: the median of many.
fn reading() -> f64 {
    let clock = ThreadTime::now();
    let mut times: Vec<Duration> = (0..101)
        .map(|_| {
            let before = clock.elapsed();
            clock.elapsed() - before
        })
        .collect();
    times.sort();
    times[times.len() / 2].as_secs_f64()
}

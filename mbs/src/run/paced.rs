//! A run that keeps up with a clock: each task simulates one period, at a level of a ladder.
//!
//! Everything is built before the loop begins. The run's own simulation is level 0; a level without some effects has a simulation
//! of its own, which takes the state over when the level changes, and shows it to the run's after each step: outputs are measured
//! there. The state, the clock of the simulation and the rows are those of simulated time, whatever the clock of the loop does.

use super::{Outcome, Run, multiple};
use crate::realtime::summary;
use crate::recorder::Keep;
use crate::settings::Settings;
use crate::simulation::Simulation;
use crate::stop::StopError;
use core::ops::ControlFlow;
use core::time::Duration;
use mbs_core::Real;
use mbs_core::formulation::SwitchError;
use mbs_core::outputs::Reactions;
use mbs_core::scene::Scene;
use mbs_realtime::{Clock, Pacer, Task, Work};
use mbs_scene::{Channel, Component, Degraded};
use std::time::Instant;

/// The column that says at which level a row was simulated.
const LEVEL: &str = "realtime-level";

/// How simulated time is cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Track<T> {
    /// Length of a period in the precision of the run and in `f64` [s].
    pub(crate) period: (T, f64),
    /// Periods, the last of which may be shorter.
    pub(crate) periods: u64,
    /// Steps of a period at level 0; `None`: their lengths are controlled.
    pub(crate) steps: Option<u32>,
    /// Is the level a column?
    pub(crate) tells_level: bool,
}

/// A level of the ladder.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Rung {
    /// Steps of a period are so many times halved in number.
    pub(crate) halvings: u32,
    /// Effects that are off.
    pub(crate) off: Vec<usize>,
    /// What was measured of it.
    pub(crate) told: Degraded,
}

impl Rung {
    /// Steps of a period.
    pub(crate) fn steps(&self, of: u32) -> u32 {
        of.div_ceil(1 << self.halvings.min(30)).max(1)
    }

    /// The scene of this level.
    pub(crate) fn scene<T: Real>(&self, scene: &Scene<T>) -> Scene<T> {
        let mut scene = scene.clone();
        for &effect in &self.off {
            scene.effects[effect].enabled = false;
        }
        scene
    }
}

/// Runs a scene at the pace of a clock; `rungs` are the levels, the first that of everything.
///
/// # Errors
/// [`SwitchError`] where a level cannot take the state over, with the effect that it was the last to leave out.
pub(crate) fn paced<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &Settings,
    track: &Track<T>,
    (pacer, rungs): (&mut Pacer, &[Rung]),
    clock: &mut impl Clock,
) -> Result<Outcome, (usize, SwitchError)> {
    let mut channels = Channel::of_scene(scene);
    if track.tells_level {
        let one = Component { label: String::new(), unit: "level".to_owned() };
        channels.push(Channel { name: LEVEL.to_owned(), components: vec![one] });
    }
    let mut run = match Run::<T, D>::new(scene, settings, channels, (track.periods, Keep::Rows)) {
        Ok(run) => run,
        Err(outcome) => return Ok(*outcome),
    };
    run.level = track.tells_level.then_some(0.0);
    let levels: Result<Vec<_>, _> =
        rungs.iter().map(|rung| Level::new(&run, rung, track.steps)).collect();
    let levels = match levels {
        Ok(levels) => levels,
        Err(Unready::Refused(refusal)) => return Err(refusal),
        Err(Unready::Stopped(error)) => return Ok(run.finish(Duration::ZERO, Some(*error))),
    };
    run.recorder.reserve(track.periods);
    run.figure.reserve(settings.duration);
    let run = match run.started() {
        Ok(run) => run,
        Err(outcome) => return Ok(*outcome),
    };
    let mut paced = Paced { run, levels, at: 0, track: *track };
    let error = pacer.run(track.periods, clock, &mut paced).err();
    let report = pacer.report();
    let mut run = paced.run;
    run.realtime = Some(summary(pacer, track, rungs));
    Ok(run.finish(report.busy, error))
}

/// Why a level is not there.
enum Unready {
    /// It cannot take the state over; the effect that was last left out.
    Refused((usize, SwitchError)),
    /// It does not start.
    Stopped(Box<StopError>),
}

impl From<StopError> for Unready {
    fn from(error: StopError) -> Self {
        Self::Stopped(Box::new(error))
    }
}

/// What a level steps, where it is not the run's own simulation.
struct Level<T: Real, const D: usize> {
    simulation: Option<Box<Simulation<T, D>>>,
    /// Of its effects; while it runs, those of the full scene.
    reactions: Option<Reactions<T, D>>,
    /// Steps of a period, where their lengths are fixed.
    steps: Option<u32>,
}

impl<T: Real, const D: usize> Level<T, D> {
    /// Builds what a level needs beside the run.
    fn new(run: &Run<'_, T, D>, rung: &Rung, steps: Option<u32>) -> Result<Self, Unready> {
        let steps = steps.map(|steps| rung.steps(steps));
        let Some(&last) = rung.off.last() else {
            return Ok(Self { simulation: None, reactions: None, steps });
        };
        let scene = rung.scene(run.scene);
        let simulation = Simulation::new(&scene, run.settings)?;
        let taken = simulation.takes_over(&run.simulation);
        taken.map_err(|refusal| Unready::Refused((last, refusal)))?;
        let needed = Reactions::<T, D>::needed(run.scene);
        let reactions = needed.then(|| Reactions::new(&scene, run.simulation.model()));
        let reactions = reactions.transpose().map_err(StopError::Reaction)?;
        Ok(Self { simulation: Some(Box::new(simulation)), reactions, steps })
    }
}

/// A run in the hands of a pacer.
struct Paced<'a, T: Real, const D: usize> {
    run: Run<'a, T, D>,
    levels: Vec<Level<T, D>>,
    /// The level of the last task.
    at: usize,
    track: Track<T>,
}

impl<T: Real, const D: usize> Work for Paced<'_, T, D> {
    type Error = StopError;

    fn step(&mut self, task: Task) -> Result<ControlFlow<()>, StopError> {
        if task.level != self.at {
            self.change(task.level)?;
        }
        #[allow(clippy::cast_precision_loss, reason = "there are few levels")]
        let level = task.level as f64;
        self.run.level = self.run.level.map(|lowest| lowest.max(level));
        let k = task.index + 1;
        self.period(k)?;
        let is_last = k == self.track.periods;
        self.run.finish_step((k, is_last), &mut ())?;
        self.run.heed(is_last)?;
        Ok(ControlFlow::Continue(()))
    }
}

impl<T: Real, const D: usize> Paced<'_, T, D> {
    /// Goes on at another level. No allocation.
    fn change(&mut self, to: usize) -> Result<(), StopError> {
        let Self { run, levels, at, .. } = self;
        let from = core::mem::replace(at, to);
        let was_own = levels[from].simulation.is_none();
        if !was_own {
            run.measures.exchange(&mut levels[from].reactions);
        }
        let level = &mut levels[to];
        let error = match &mut level.simulation {
            Some(simulation) => {
                run.measures.exchange(&mut level.reactions);
                let taken = simulation.take_over(&run.simulation);
                taken.map_err(|error| simulation.explain(error))
            }
            None if was_own => Ok(()),
            None => run.simulation.resume().map_err(|error| run.simulation.explain(error)),
        };
        error.or_else(|stop| run.stop(stop))
    }

    /// Period `k` from 1, in its steps.
    fn period(&mut self, k: u64) -> Result<(), StopError> {
        let Track { period, periods, .. } = self.track;
        let is_last = k == periods;
        let from = multiple(T::ZERO, k - 1, period);
        let to = if is_last { self.run.lengths.duration } else { multiple(T::ZERO, k, period) };
        let mut clock = Instant::now();
        let Some(n) = self.levels[self.at].steps else { return self.controlled(to, &mut clock) };
        // The length of a whole period is exact; that between two multiples is rounded.
        let is_whole = !is_last || (to - from - period.0).abs() <= period.0 * T::from_f64(1e-9);
        let whole = if is_whole { period.0 } else { to - from };
        let h = whole / T::from_f64(f64::from(n));
        for j in 1..=n {
            let end = if j == n { to } else { from + h * T::from_f64(f64::from(j)) };
            self.step(h, Some(end), &mut clock)?;
        }
        Ok(())
    }

    /// Steps of controlled lengths to an instant.
    fn controlled(&mut self, to: T, clock: &mut Instant) -> Result<(), StopError> {
        while self.run.simulation.state().t < to {
            let rest = to - self.run.simulation.state().t;
            if self.step(rest, None, clock)? {
                break;
            }
        }
        self.set_time(to);
        Ok(())
    }

    /// A step of at most `rest` [s]; says whether it took the whole.
    fn step(&mut self, rest: T, to: Option<T>, clock: &mut Instant) -> Result<bool, StopError> {
        let Some(simulation) = &mut self.levels[self.at].simulation else {
            return self.run.step(rest, to, clock);
        };
        let accepted = match simulation.advance(rest) {
            Ok(accepted) => accepted,
            Err(error) => {
                let stop = simulation.explain(error);
                return self.run.stop(stop).map(|()| true);
            }
        };
        if let Some(to) = to {
            simulation.set_time(to);
        }
        self.run.simulation.show(simulation);
        self.run.made(&accepted, clock)?;
        Ok(accepted.is_last)
    }

    /// Sets the clocks of the simulation that runs and of the run.
    fn set_time(&mut self, to: T) {
        if let Some(simulation) = &mut self.levels[self.at].simulation {
            simulation.set_time(to);
        }
        self.run.simulation.set_time(to);
        self.run.reached = to.to_f64();
        self.run.mark.t = self.run.reached;
        self.run.recorder.end_at(self.run.reached);
    }
}

//! Run that a clock paces. Each task simulates one period, at a level of the degradation ladder.
//!
//! All memory is allocated before the loop begins. The run's simulation makes the steps at level 0. Each level that omits effects has a
//! separate simulation, which copies the state when the level changes. After each step of a separate simulation, the run's simulation
//! copies the new state, and outputs are measured there. State and rows depend on simulated time only, not on the clock.

use super::record::Record;
use super::{Outcome, Run};
use crate::driver::{Fixed, Plant, StepObserver, Stretch, drive, multiple};
use crate::interrupt::Interrupt;
use crate::realtime::summary;
use crate::record::{Channel, Degraded};
use crate::recorder::RecordRows;
use crate::settings::ResolvedMethod;
use crate::settings::length::SAME_LENGTH;
use crate::simulation::Simulation;
use crate::stop::StopError;
use core::ops::ControlFlow;
use core::time::Duration;
use mbs_core::Real;
use mbs_core::control::Accepted;
use mbs_core::formulation::SwitchError;
use mbs_core::outputs::Forces;
use mbs_core::scene::Scene;
use mbs_core::step::StepError;
use mbs_realtime::{Clock, Pacer, Task, Work};
use mbs_scene::Component;

/// Name of the column that has the level at which the row was simulated.
const LEVEL: &str = "realtime-level";

/// Division of the simulated time into periods and steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PacedSchedule<T> {
    /// Length of a period in the precision of the run and in `f64` [s].
    pub period: (T, f64),
    /// Number of periods; the last one may be shorter.
    pub periods: u64,
    /// Number of steps of a period at level 0; `None` with step control.
    pub steps: Option<u32>,
    /// True if the rows have a column with the level.
    pub has_level: bool,
}

/// A level of the degradation ladder.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PacedLevel {
    /// Number of times that the number of steps per period is halved.
    pub halvings: u32,
    /// Indices of the effects that are switched off.
    pub off: Vec<usize>,
    /// Measured costs and changes of the level.
    pub measured: Degraded,
}

impl PacedLevel {
    /// Number of steps of a period at this level; `of` is the number at level 0.
    pub fn steps(&self, of: u32) -> u32 {
        of.div_ceil(1 << self.halvings.min(30)).max(1)
    }

    /// The scene of this level, without the effects that are off.
    pub fn scene<T: Real>(&self, scene: &Scene<T>) -> Scene<T> {
        let mut scene = scene.clone();
        for &effect in &self.off {
            scene.effects[effect].enabled = false;
        }
        scene
    }
}

/// Runs a scene at the pace of a clock. `rungs` are the levels, beginning with the full scene.
///
/// # Errors
/// [`SwitchError`] if a level cannot copy the state, with the index of the effect that was omitted last.
pub fn paced<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    track: &PacedSchedule<T>,
    (pacer, rungs): (&mut Pacer, &[PacedLevel]),
    clock: &mut impl Clock,
) -> Result<Outcome, (usize, SwitchError)> {
    let mut channels = Channel::of_scene(scene);
    if track.has_level {
        let one = Component { label: String::new(), unit: "level".to_owned() };
        channels.push(Channel { name: LEVEL.to_owned(), quantity: "level", components: vec![one] });
    }
    let mut run =
        match Run::<T, D>::new(scene, settings, channels, (track.periods, RecordRows::All)) {
            Ok(run) => run,
            Err(outcome) => return Ok(*outcome),
        };
    run.record.level = track.has_level.then_some(0.0);
    run.record.periods = Some(track.periods);
    let levels: Result<Vec<_>, _> =
        rungs.iter().map(|rung| Level::new(&run, rung, track.steps)).collect();
    let levels = match levels {
        Ok(levels) => levels,
        Err(Unready::Refused(refusal)) => return Err(refusal),
        Err(Unready::Stopped(error)) => return Ok(run.finish(Duration::ZERO, Some(*error))),
    };
    run.record.recorder.reserve(track.periods);
    run.record.motion.reserve(settings.duration);
    let Run { simulation, record } = match run.started() {
        Ok(run) => run,
        Err(outcome) => return Ok(*outcome),
    };
    let ladder = Ladder { simulation, levels, at: 0 };
    let mut paced = Paced { ladder, record, track: *track };
    let error = pacer.run(track.periods, clock, &mut paced).err();
    let report = pacer.report();
    let Paced { ladder: Ladder { simulation, .. }, mut record, .. } = paced;
    record.realtime = Some(summary(pacer, track, rungs));
    Ok(Run { simulation, record }.finish(report.busy, error))
}

/// Reason why a level cannot be used.
enum Unready {
    /// The level cannot copy the state. The values are the index of the effect that was omitted last, and the reason.
    Refused((usize, SwitchError)),
    /// The simulation of the level does not start.
    Stopped(Box<StopError>),
}

impl From<StopError> for Unready {
    fn from(error: StopError) -> Self {
        Self::Stopped(Box::new(error))
    }
}

/// Level at run time: its simulation, its forces and its number of steps. The simulation is `None` if the level uses the run's simulation.
struct Level<T: Real, const D: usize> {
    simulation: Option<Box<Simulation<T, D>>>,
    /// Forces of the level's effects; while the level runs, they are exchanged with the forces of the full scene.
    forces: Option<Forces<T, D>>,
    /// Number of steps of a period; `None` with step control.
    steps: Option<u32>,
}

impl<T: Real, const D: usize> Level<T, D> {
    /// Builds the simulation and forces of a level, if it omits effects.
    fn new(run: &Run<'_, T, D>, rung: &PacedLevel, steps: Option<u32>) -> Result<Self, Unready> {
        let steps = steps.map(|steps| rung.steps(steps));
        let Some(&last) = rung.off.last() else {
            return Ok(Self { simulation: None, forces: None, steps });
        };
        let scene = rung.scene(run.record.scene);
        let simulation = Simulation::new(&scene, run.record.settings)?;
        let taken = simulation.takes_over(&run.simulation);
        taken.map_err(|refusal| Unready::Refused((last, refusal)))?;
        let forces = Forces::new(&scene, run.simulation.model()).map_err(StopError::Reaction)?;
        Ok(Self { simulation: Some(Box::new(simulation)), forces: Some(forces), steps })
    }
}

/// The run's simulation, and the simulations of the other levels.
struct Ladder<T: Real, const D: usize> {
    simulation: Simulation<T, D>,
    levels: Vec<Level<T, D>>,
    /// Index of the level that makes the steps.
    at: usize,
}

impl<T: Real, const D: usize> Plant<T, D> for Ladder<T, D> {
    fn stepped(&mut self) -> &mut Simulation<T, D> {
        self.levels[self.at].simulation.as_deref_mut().unwrap_or(&mut self.simulation)
    }

    fn shown(&self) -> &Simulation<T, D> {
        &self.simulation
    }

    fn advance(&mut self, rest: T) -> Result<Accepted<T>, StepError> {
        let accepted = self.stepped().advance(rest)?;
        if let Some(simulation) = &self.levels[self.at].simulation {
            self.simulation.show(simulation);
        }
        Ok(accepted)
    }

    fn set_time(&mut self, t: T) {
        self.stepped().set_time(t);
        self.simulation.set_time(t);
    }
}

impl<T: Real, const D: usize> Ladder<T, D> {
    /// Changes to another level of the ladder. No allocation.
    fn change(&mut self, to: usize, record: &mut Record<'_, T, D>) -> Result<(), StopError> {
        let Self { simulation: own, levels, at } = self;
        let from = core::mem::replace(at, to);
        let was_own = levels[from].simulation.is_none();
        if !was_own {
            record.measures.exchange(&mut levels[from].forces);
        }
        let level = &mut levels[to];
        match &mut level.simulation {
            Some(simulation) => {
                record.measures.exchange(&mut level.forces);
                simulation.take_over(own).map_err(|error| simulation.explain(error))
            }
            None if was_own => Ok(()),
            None => own.resume().map_err(|error| own.explain(error)),
        }
    }
}

/// A paced run as the work of a pacer.
struct Paced<'a, T: Real, const D: usize> {
    ladder: Ladder<T, D>,
    record: Record<'a, T, D>,
    track: PacedSchedule<T>,
}

impl<T: Real, const D: usize> Work for Paced<'_, T, D> {
    type Error = StopError;

    fn step(&mut self, task: Task) -> Result<ControlFlow<()>, StopError> {
        let Self { ladder, record, .. } = self;
        if task.level != ladder.at
            && let Err(stop) = ladder.change(task.level, record)
        {
            record.end(&ladder.simulation, Some(&stop));
            return Err(stop);
        }
        #[allow(clippy::cast_precision_loss, reason = "there are few levels")]
        let level = task.level as f64;
        record.level = record.level.map(|lowest| lowest.max(level));
        let stretch = self.period(task.index + 1);
        self.record.begin_step();
        let never = Interrupt::default();
        drive(&mut self.ladder, [stretch], &never, &mut self.record)?;
        let is_last = task.index + 1 == self.track.periods;
        if !is_last && self.record.settings.interrupt.is_set() {
            let stop = StopError::Interrupted;
            self.record.end(&self.ladder.simulation, Some(&stop));
            return Err(stop);
        }
        Ok(ControlFlow::Continue(()))
    }
}

impl<T: Real, const D: usize> Paced<'_, T, D> {
    /// Stretch of simulated time of period `k`, counted from 1.
    fn period(&self, k: u64) -> Stretch<T> {
        let PacedSchedule { period, periods, .. } = self.track;
        let is_last = k == periods;
        let at = |k| multiple((T::ZERO, 0.0), k, period);
        let from = at(k - 1);
        let to = if is_last { self.record.lengths.duration } else { at(k) };
        // A full period has exactly the given length, because the difference of two multiples would have rounding errors.
        let is_whole =
            !is_last || (to - from - period.0).abs() <= period.0 * T::from_f64(SAME_LENGTH);
        let whole = if is_whole { period.0 } else { to - from };
        let fixed = |n: u32| {
            let h = whole / T::from_f64(f64::from(n));
            Fixed { n: n.into(), from: (from, from.to_f64()), dt: (h, h.to_f64()) }
        };
        let fixed = self.ladder.levels[self.ladder.at].steps.map(fixed);
        Stretch { fixed, is_last, ..Stretch::to(to) }
    }
}

//! Comparison run: the same scene by another method, compared at some of the original run's rows.

use core::ops::ControlFlow;
use mbs::inside::{
    Alarm, AssembledScene, Channels, Stretch, continue_if, drive, poses, shortest_period,
};
use mbs::typed::{Simulation, StepObserver};
use mbs::{Interrupt, Names, ResolvedMethod, StopError};
use mbs_core::control::Accepted;
use mbs_core::scene::Scene;
use mbs_core::step::{StepError, StepReport};
use mbs_sparse::Multifrontal;

/// Fraction of its largest work that a comparison run does before it may end for too much predicted work [-]. In the first steps the integrator
/// still searches for the step length.
const PROBE: f64 = 0.1;
/// Factor by which the predicted work of a comparison run may exceed the limit at first [-]. The factor falls to one when the limit is
/// reached. Chosen, not tuned.
const BEHIND: f64 = 1.8;
/// Number of last measurements from which the remaining work is predicted [-]. Vibration that decays after the start takes more work. Chosen,
/// not tuned.
const RECENT: usize = 8;
/// Fraction of the largest work that a comparison run may do between two measurements [-]. It may always make [`FEW_STEPS`]. Chosen, not
/// tuned.
const AT_ONCE: f64 = 0.1;
/// Number of states at which the stiffest force is searched. Chosen, not tuned.
const STATES: usize = 5;
/// Largest rotation between two measurements [rad], since measured angles are known within half a revolution only.
const TURN: f64 = 1.5;
/// Number of steps between two measurements that a comparison run with controlled steps may always make [-]. Chosen, not tuned.
const FEW_STEPS: f64 = 64.0;
/// Number of evaluations in a step of the integrator of order 8 [-]. The last evaluation is also the first of the next step.
const EVALUATIONS: f64 = 12.0;
/// Largest number of steps between two measurements [-]: the default limit of an integrator.
const MOST_STEPS: f64 = 1e6;

/// End of a comparison run.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum End {
    /// Comparison run that covers the whole run.
    Whole,
    /// Comparison run that would take too much work.
    Late,
    /// Comparison run that stopped: time [s] and reason.
    Stopped(f64, String),
    /// Comparison run that did not start: reason.
    NotStarted(String),
}

/// Speed of the motion, relative to the step of the original run.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pace {
    /// Largest rotation of a body in a step [rad], and the index of this body.
    pub(super) turn: (f64, usize),
    /// Smallest number of steps in a period of the stiffest force.
    pub(super) steps_per_period: Option<f64>,
}

impl Pace {
    /// Takes the maxima of another comparison run into account.
    pub(super) fn take(&mut self, other: &Self) {
        if other.turn.0 > self.turn.0 {
            self.turn = other.turn;
        }
        let both = self.steps_per_period.into_iter().chain(other.steps_per_period);
        self.steps_per_period = both.reduce(f64::min);
    }
}

/// Result of a comparison run.
#[derive(Debug)]
pub(super) struct Seen {
    /// Components at the instants that the run reached.
    pub(super) values: Vec<Vec<f64>>,
    /// Speed of the motion, relative to the step of the original run.
    pub(super) pace: Pace,
    /// Number of iterations and steps made.
    work: f64,
    /// Nominal time of these iterations and steps [s].
    pub(super) seconds: f64,
    pub(super) end: End,
}

/// Original run, for which comparison runs are made.
pub(super) struct Look<'a, const D: usize> {
    pub(super) scene: &'a Scene<f64>,
    pub(super) ready: &'a AssembledScene<f64, D>,
    /// Time and components of each row of the run.
    pub(super) rows: &'a [(f64, Vec<f64>)],
    /// Number of steps of the run.
    pub(super) n_steps: f64,
    /// Function that returns the run's step at a time [s], or zero if the integrator controls the step itself.
    pub(super) step_at: &'a dyn Fn(f64) -> f64,
}

impl<const D: usize> Look<'_, D> {
    /// Makes a comparison run with these settings, compared at the rows `instants`. Fixed steps have a length of about `step` [s]. The
    /// nominal time is limited to `most` [s]. `of_one` is the nominal time of an iteration or step in a model of given sizes [s].
    pub(super) fn at(
        &self,
        settings: &ResolvedMethod,
        (instants, step): (&[usize], Option<f64>),
        (most, of_one): (f64, &dyn Fn([usize; 3]) -> f64),
    ) -> Seen {
        let mut seen = Seen {
            values: Vec::new(),
            pace: Pace::default(),
            work: 0.0,
            seconds: 0.0,
            end: End::Whole,
        };
        let end = match self.start(settings) {
            Ok((simulation, channels)) => {
                let of_one = of_one(simulation.sizes());
                let most = most / of_one;
                let limit = Limit { most, interrupt: &settings.interrupt };
                let alarm = Alarm::new(settings.energy_alarm);
                let solver = self.ready.solver.clone();
                let eye = Eye { look: self, simulation, channels, alarm, step, solver, limit };
                let end = eye.follow(instants, &mut seen);
                seen.seconds = of_one * seen.work;
                end
            }
            Err(error) => Err(End::NotStarted(error.report(0.0, &Names::new(self.scene)).message)),
        };
        seen.end = end.err().unwrap_or(End::Whole);
        seen
    }

    fn start(
        &self,
        settings: &ResolvedMethod,
    ) -> Result<(Simulation<f64, D>, Channels<f64, D>), StopError> {
        let simulation = Simulation::<f64, D>::of(self.scene, settings, self.ready.clone())?;
        let channels = Channels::new(self.scene, simulation.model())?;
        Ok((simulation, channels))
    }

    /// Length of the run [s].
    fn span(&self) -> f64 {
        self.rows.last().map_or(0.0, |(t, _)| *t)
    }
}

/// State of a comparison run.
struct Eye<'a, const D: usize> {
    look: &'a Look<'a, D>,
    simulation: Simulation<f64, D>,
    channels: Channels<f64, D>,
    alarm: Alarm,
    step: Option<f64>,
    solver: Multifrontal<f64>,
    limit: Limit<'a>,
}

/// Limit of the work of a comparison run.
#[derive(Clone, Copy)]
struct Limit<'a> {
    /// Largest number of iterations and steps.
    most: f64,
    interrupt: &'a Interrupt,
}

impl Limit<'_> {
    /// True if the work or an interrupt ends the comparison run.
    fn is_reached(&self, work: f64) -> bool {
        work > self.most || self.interrupt.is_set()
    }

    /// True if the comparison run needs too much work. `seen` has, for each measurement, the completed fraction of the run and the work up to
    /// it.
    fn is_behind(&self, seen: &[(f64, f64)]) -> bool {
        let Some(&(share, work)) = seen.last() else { return false };
        let (before, done) = seen[seen.len().saturating_sub(RECENT + 1)];
        // the smaller of the mean and the recent rate counts: single fast phases and the start may take more work than the rest
        let rate = (work / share).min((work - done) / (share - before));
        let left = (1.0 - share) * rate;
        let taken = work / self.most;
        taken > PROBE && work + left > (BEHIND + (1.0 - BEHIND) * taken) * self.most
    }
}

impl<const D: usize> Eye<'_, D> {
    fn follow(mut self, instants: &[usize], seen: &mut Seen) -> Result<(), End> {
        let n = self.look.rows.first().map_or(0, |(_, row)| row.len());
        let mut row = vec![0.0; n];
        let span = self.look.span();
        let mut rate = self.turning(0.0, &mut seen.pace);
        let mut works = vec![(0.0, 0.0)];
        for (k, &i) in instants.iter().enumerate() {
            if k.is_multiple_of(instants.len().div_ceil(STATES)) {
                self.stiffness(&mut seen.pace);
            }
            let (t, _) = &self.look.rows[i];
            self.reach((*t, rate), *t >= span, &mut seen.work)?;
            rate = self.turning(*t, &mut seen.pace);
            let written = self.channels.write(&self.simulation, &mut row);
            written.map_err(|error| stopped(self.look.scene, &self.simulation, &error))?;
            seen.values.push(row.clone());
            works.push((t / span, seen.work));
            if *t < span && self.limit.is_behind(&works) {
                return Err(End::Late);
            }
        }
        Ok(())
    }

    /// Makes steps up to a time `to` [s]. `rate` is the largest angular velocity of a body [rad/s].
    fn reach(&mut self, (to, rate): (f64, f64), is_last: bool, work: &mut f64) -> Result<(), End> {
        let from = self.simulation.state().t;
        let rest = to - from;
        let pieces = match self.step {
            Some(step) => (rest / step).round().max(1.0),
            None => (rest * rate / TURN).ceil().clamp(1.0, self.look.n_steps.max(1.0)),
        };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
        let (count, most) = (
            pieces as u64,
            (FEW_STEPS + AT_ONCE * self.limit.most / EVALUATIONS).min(MOST_STEPS) as u32,
        );
        if self.step.is_none() {
            self.simulation.formulation_mut().set_max_steps(most);
        }
        let end = |j: u64| if j == count { to } else { from + rest * (j as f64 / pieces) };
        let piece = |j| Stretch { is_last: is_last && j == count, ..Stretch::to(end(j)) };
        let Self { look, simulation, channels, alarm, step, limit, .. } = self;
        let to = (to, is_last);
        let mut glance = Glance { channels, alarm, limit: *limit, to, late: false, work };
        let stretches = (1..=count).map(piece);
        match drive(simulation, stretches, &Interrupt::default(), &mut glance) {
            Ok(()) if glance.late => Err(End::Late),
            Ok(()) => Ok(()),
            Err(StopError::Step(StepError::StepTooSmall { .. }, _)) if step.is_none() => {
                *glance.work += EVALUATIONS * f64::from(most);
                Err(End::Late)
            }
            Err(stop) => Err(stopped(look.scene, simulation, &stop)),
        }
    }

    /// Returns the largest angular velocity of a body [rad/s], and updates the largest rotation in a step of the original run.
    fn turning(&self, t: f64, most: &mut Pace) -> f64 {
        let (model, state) = (self.simulation.model(), self.simulation.state());
        let step = (self.look.step_at)(t);
        let mut largest: f64 = 0.0;
        for (body, pose) in poses(self.look.scene, model, state).iter().enumerate() {
            let rate = pose.omega.iter().fold(0.0, |sum: f64, x| libm::hypot(sum, *x));
            largest = largest.max(rate);
            if rate * step > most.turn.0 {
                most.turn = (rate * step, body);
            }
        }
        largest
    }

    /// Updates the smallest number of steps in a period of the stiffest force.
    fn stiffness(&mut self, most: &mut Pace) {
        let (model, state) = (self.simulation.model(), self.simulation.state());
        let step = (self.look.step_at)(state.t);
        let period = shortest_period(model, &mut self.solver, state);
        let steps_per_period = period.map(|period| period / step).filter(|n| n.is_finite());
        most.take(&Pace { steps_per_period, ..Pace::default() });
    }
}

/// Work of a step: its iterations or evaluations, plus the steps themselves.
fn counted(report: &StepReport<f64>) -> f64 {
    f64::from(report.iterations) + f64::from(report.steps)
}

/// Makes the `End` of a comparison run that stopped with an error.
fn stopped<const D: usize>(
    scene: &Scene<f64>,
    simulation: &Simulation<f64, D>,
    error: &StopError,
) -> End {
    let t = simulation.state().t;
    End::Stopped(t, error.report(t, &Names::new(scene)).message)
}

/// Observer of the steps of a comparison run up to a row.
struct Glance<'a, const D: usize> {
    channels: &'a mut Channels<f64, D>,
    alarm: &'a mut Alarm,
    limit: Limit<'a>,
    /// Number of iterations and steps so far.
    work: &'a mut f64,
    /// Time of the row [s], and whether the comparison run ends there.
    to: (f64, bool),
    late: bool,
}

impl<const D: usize> StepObserver<f64, D> for Glance<'_, D> {
    fn step(
        &mut self,
        now: &Simulation<f64, D>,
        accepted: &Accepted<f64>,
        _: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        *self.work += counted(&accepted.attempt.report);
        self.late = now.state().t < self.to.0 && self.limit.is_reached(*self.work);
        Ok(continue_if(!self.late))
    }

    fn instant(&mut self, now: &Simulation<f64, D>) -> Result<ControlFlow<()>, StopError> {
        self.channels.track(now)?;
        let t = now.state().t;
        let (to, is_last) = self.to;
        if let Some(stop) = self.alarm.rings(now, is_last && t >= to) {
            return Err(stop);
        }
        Ok(ControlFlow::Continue(()))
    }
}

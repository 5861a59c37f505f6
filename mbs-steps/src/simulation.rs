//! Simulation of a scene: its model, its state and its formulation, ready to make steps.

mod carry;
mod checkpoint;

use crate::checkpoint::{SimulationSnapshot, inputs};
use crate::control::Control;
use crate::methods::{Demands, Request};
use crate::ready::AssembledScene;
use crate::settings::ResolvedMethod;
use crate::signal_ends::SignalEnds;
use crate::stop::StopError;
use mbs_core::control::{Accepted, Invariant, Limit, TrialStep};
use mbs_core::effects::{Field, Value};
use mbs_core::formulation::{Formulation, energies};
use mbs_core::implicit::check_lines;
use mbs_core::inputs::SignalGraph;
use mbs_core::model::{Model, Owner, State};
use mbs_core::natural::NaturalModel;
use mbs_core::once::find;
use mbs_core::scene::{EffectKind, Scene, Signal};
use mbs_core::start::Assembled;
use mbs_core::step::{InputError, Step, StepError, largest};
use mbs_core::{Real, instances};

/// Scene that is ready to step, in D dimensions and in the scalar T. The state is also written in natural coordinates, whatever the
/// formulation, because outputs are measured in natural coordinates. A clone makes bitwise the same steps and does not change the original.
/// Original and clone use the same thread team.
#[derive(Debug, Clone)]
pub struct Simulation<T: Real, const D: usize> {
    model: NaturalModel<T, D>,
    state: State<T>,
    formulation: Box<dyn Formulation<T, D>>,
    /// Result of the assembly; it contains the state at the start.
    pub start: Assembled<T>,
    sizes: [usize; 3],
    initial_energy: [f64; 2],
    control: Option<Box<Control<T, D>>>,
    /// Times at which signals end a step. They serve integrators that control their internal steps within a step of the run.
    ends: Option<SignalEnds<T>>,
    invariant: Invariant,
    advance: Advance<T, D>,
}

type Build<T, const D: usize> =
    fn(&Scene<T>, &ResolvedMethod, AssembledScene<T, D>) -> Result<Simulation<T, D>, StopError>;
type Advance<T, const D: usize> = fn(&mut Simulation<T, D>, T) -> Result<Accepted<T>, StepError>;
instances!(BUILD: Build<T, D> = Simulation::<T, D>::build);

impl<T: Real, const D: usize> Simulation<T, D> {
    /// Builds the model of a scene, assembles it, and allocates all memory that a step needs.
    ///
    /// # Errors
    /// [`StopError`] when there is no model, no consistent start, or the formulation cannot run the scene.
    pub fn new(scene: &Scene<T>, settings: &ResolvedMethod) -> Result<Self, StopError> {
        Self::of(scene, settings, AssembledScene::new(scene)?)
    }

    /// Builds the simulation of a scene whose model is assembled.
    #[doc(hidden)]
    pub fn of(
        scene: &Scene<T>,
        settings: &ResolvedMethod,
        ready: AssembledScene<T, D>,
    ) -> Result<Self, StopError> {
        find::<Build<T, D>>(BUILD).ok_or(StopError::NotBuilt)?(scene, settings, ready)
    }

    fn build(
        scene: &Scene<T>,
        settings: &ResolvedMethod,
        mut ready: AssembledScene<T, D>,
    ) -> Result<Self, StopError> {
        let natural = (!settings.formulation.row().relative).then(|| ready.sizes());
        let AssembledScene { model, solver, start, .. } = ready;
        let mut state = start.state.clone();
        let demands = Demands {
            integrator: settings.integrator,
            penalty: settings.penalty,
            tolerance: settings.tolerance,
            threads: settings.threads,
            step: settings.lengths(scene).step,
        };
        let request = Request { scene, demands, model: &model, solver, state: &mut state };
        let formulation = settings.formulation.build(request)?;
        let sizes = formulation.sizes().or(natural).unwrap_or_default();
        let [kinetic, potential, _] = energies_at(&*formulation, &model, &state);
        let control = Control::new(scene, settings, &model, &state);
        let control = control.map_err(|e| StopError::Start(e.into()))?.map(Box::new);
        let has_ends = settings.events && settings.integrator.controls_its_step();
        let ends = has_ends.then(|| SignalEnds::new(&model));
        let is_damped =
            scene.effects.iter().any(|effect| effect.enabled && effect.kind.dissipates());
        let (ground, epsilon) = (ground(scene, settings, &model), T::EPSILON.to_f64());
        let invariant = Invariant::new([kinetic, potential, 0.0], ground, epsilon);
        let invariant = invariant.with_dampers(is_damped);
        let initial_energy = [kinetic, potential];
        Ok(Self {
            model,
            state,
            formulation,
            start,
            sizes,
            initial_energy,
            control,
            ends,
            invariant,
            advance: Self::advance_here,
        })
    }
}

impl<T: Real, const D: usize> Simulation<T, D> {
    /// Makes one step: of length `rest` [s] if steps are fixed, of at most `rest` with step control.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    pub fn advance(&mut self, rest: T) -> Result<Accepted<T>, StepError> {
        (self.advance)(self, rest)
    }

    fn advance_here(&mut self, rest: T) -> Result<Accepted<T>, StepError> {
        self.formulation.codes(&self.model).forget();
        let made = self.advance_by(rest);
        let failed = self.formulation.codes(&self.model).failed();
        if let Some(control) = &mut self.control {
            control.note(failed, self.state.t);
        }
        made.map_err(|error| {
            let before = || self.control.as_ref()?.failed_before(self.state.t);
            let is_short = matches!(error, StepError::StepTooSmall { .. });
            match failed.or_else(|| before().filter(|_| is_short)) {
                Some(failed) => failed.into(),
                None => self.collapsing(rest).unwrap_or(error),
            }
        })
    }

    /// Returns the error of a part of a rope that has lost its length, if the failed step would shorten a part to zero. With step control,
    /// the motion is extrapolated over at most twice the length of the last step.
    fn collapsing(&self, rest: T) -> Option<StepError> {
        let State { v, a, dt, .. } = &self.state;
        let h = if *dt > T::ZERO { rest.min(T::TWO * *dt) } else { rest };
        let way = |(v, a): (&T, &T)| (*v + *a * h * T::HALF) * h;
        let dq: Vec<T> = v.iter().zip(a).map(way).collect();
        check_lines(&self.model, &self.state, &dq).err()
    }

    fn advance_by(&mut self, rest: T) -> Result<Accepted<T>, StepError> {
        let Self { model, state, formulation, control, ends, invariant, .. } = self;
        let formulation = &mut **formulation;
        // The step is checked here, because the formulation next prepares its index for the step.
        let step = Step { dt: rest, length: model.length() }.checked()?;
        if let Some(control) = control {
            formulation.take_inputs(model, state)?;
            return control.step((model, formulation), state, invariant, rest);
        }
        let (report, energies) = match ends {
            Some(ends) => ends.advance((model, formulation), step, state)?,
            None => formulation.advance(model, step, state)?,
        };
        let change = invariant.change(energies);
        invariant.mark(state.t.to_f64(), energies);
        let t = state.t;
        let attempt = TrialStep { report, t, energies, error: 0.0, acceleration_energy: [0.0; 2] };
        Ok(Accepted {
            attempt,
            step: rest,
            rejected: 0,
            change,
            limit: Limit::Largest,
            is_last: true,
        })
    }

    /// True if the step size is controlled.
    pub fn is_controlled(&self) -> bool {
        self.control.is_some()
    }

    /// Energy invariant, which is monitored over all steps so far.
    pub fn invariant(&self) -> &Invariant {
        &self.invariant
    }

    /// Returns the index (1 or 3) of the next step, and the number of index changes so far; `None` for a formulation of fixed index.
    pub fn index(&self) -> Option<(u8, u32)> {
        self.formulation.index()
    }

    /// Sets the time of the state [s]. The caller gives a multiple of the step, because a sum of many steps would accumulate rounding
    /// errors.
    pub fn set_time(&mut self, t: T) {
        self.state.t = t;
        self.formulation.set_time(t);
    }

    /// Sets the input of `scene.effects[effect]` between two steps: a force, a torque, or the input of a user-defined law. The value holds
    /// until it is set again. It acts during the whole next step, so acceleration and power at the beginning of that step include it. If
    /// the new input changes the energy that a law stores, the change counts as work.
    ///
    /// # Errors
    /// [`InputError`] if the effect has no input ([`Signal::Input`]), or if a component is not finite. Then no input is set.
    pub fn set_input(&mut self, effect: usize, value: [T; 3]) -> Result<(), InputError> {
        self.model.prescribed().set_input(&mut self.state.inputs, effect, value)
    }

    /// Sets the value, rate and acceleration that `scene.guides[guide]` has at the end of the next step. With step control, the first
    /// internal step of the next [`step`](Self::step) uses them.
    ///
    /// # Errors
    /// [`InputError`] if the guide is no input ([`Motion::Input`](mbs_core::scene::Motion::Input)), or if a component is not finite. Then
    /// no input is set.
    pub fn set_guide(&mut self, guide: usize, motion: [T; 3]) -> Result<(), InputError> {
        self.model.prescribed().set_guide(&mut self.state.inputs, guide, motion)
    }

    /// Sets `scene.signals[signal]` between two steps, as [`set_input`](Self::set_input) does.
    ///
    /// # Errors
    /// [`InputError`] if the signal is no input ([`SignalKind::Input`](mbs_core::scene::SignalKind::Input)), or if the value is not finite.
    /// Then no input is set.
    pub fn set_signal(&mut self, signal: usize, value: T) -> Result<(), InputError> {
        self.model.prescribed().set_signal(&mut self.state.inputs, signal, value)
    }

    /// Returns the angle or displacement of coordinate `number` of a joint, with full turns counted; `None` if it is no coordinate of the
    /// formulation. A tree has all joint coordinates, except those of cut joints and of rotations in space.
    pub fn coordinate(&self, joint: usize, number: usize) -> Option<T> {
        self.formulation.coordinate(joint, number)
    }

    /// True if the formulation steps relative coordinates (those of a tree) instead of natural coordinates.
    pub fn has_own_coordinates(&self) -> bool {
        self.formulation.terms().is_none()
    }

    /// Model in natural coordinates, in which outputs are measured.
    pub fn model(&self) -> &NaturalModel<T, D> {
        &self.model
    }

    /// The state in natural coordinates.
    pub fn state(&self) -> &State<T> {
        &self.state
    }

    /// Formulation of the simulation; a formulation's options are changed through its concrete type.
    pub fn formulation_mut(&mut self) -> &mut dyn Formulation<T, D> {
        &mut *self.formulation
    }

    /// Snapshot of all data that the next step depends on.
    pub fn snapshot(&self) -> SimulationSnapshot<T> {
        SimulationSnapshot {
            state: self.state.clone(),
            formulation: self.formulation.history(),
            control: self.control.as_ref().map(|control| control.snapshot()),
            invariant: self.invariant.history(),
            inputs: inputs(self.model.prescribed(), &self.state.inputs),
        }
    }

    /// Restores a snapshot; returns false if the snapshot belongs to another simulation.
    pub fn restore_snapshot(&mut self, snapshot: &SimulationSnapshot<T>) -> bool {
        let SimulationSnapshot {
            state,
            formulation,
            control,
            invariant,
            inputs: [courses, guides, signals],
        } = snapshot;
        let mut is_ours = match (&mut self.control, control) {
            (Some(present), Some(control)) => present.restore(control),
            (present, control) => present.is_none() && control.is_none(),
        };
        if !is_ours || self.formulation.set_history(formulation).is_err() {
            return false;
        }
        self.state.copy_from(state);
        self.invariant.set_history(*invariant);
        for &(effect, value) in courses {
            is_ours &= self.set_input(effect, value).is_ok();
        }
        for &(guide, motion) in guides {
            is_ours &= self.set_guide(guide, motion).is_ok();
        }
        for &(signal, [value, ..]) in signals {
            is_ours &= self.set_signal(signal, value).is_ok();
        }
        is_ours
    }

    /// Kinetic energy, potential energy, and work of dampers, guides and signals since the start [J].
    ///
    /// Cost: before the first step, one evaluation of the model and the allocation of its memory.
    pub fn energies(&self) -> [f64; 3] {
        energies_at(&*self.formulation, &self.model, &self.state)
    }

    /// Kinetic energy, potential energy and work since the start [J], evaluated again. The cost is that of monitoring the invariant in one
    /// step.
    #[doc(hidden)]
    pub fn watched_energies(&mut self) -> [f64; 3] {
        self.formulation.watch();
        self.formulation.energies(&self.model, &self.state)
    }

    /// Kinetic energy, potential energy and work at the start [J].
    pub fn initial_energies(&self) -> [f64; 3] {
        [self.initial_energy[0], self.initial_energy[1], 0.0]
    }

    /// Number of coordinates, number of constraints and rank of the constraints, in the formulation that runs.
    pub fn sizes(&self) -> [usize; 3] {
        self.sizes
    }

    /// Number of threads that work on a step.
    pub fn threads(&self) -> usize {
        self.formulation.threads()
    }

    /// Converts the error of a failed step to a `StopError` that names the joint or body concerned.
    pub fn explain(&self, error: StepError) -> StopError {
        let unknown = |u| self.formulation.owner_of_unknown(&self.model, u);
        StopError::step(error, unknown, |row| self.formulation.owner_of_row(&self.model, row))
    }

    /// Returns the owner of the constraint with the largest force. Without multipliers it is the owner of the coordinate with the largest
    /// acceleration.
    pub fn most_loaded(&self) -> Owner {
        let is_known = self.state.reaction.iter().any(|&x| x != T::ZERO);
        if is_known {
            return self.model.owner_of_row(largest(&self.state.reaction) as usize);
        }
        let n = mbs_core::Cliques::n_unknowns(&self.model);
        if n == 0 {
            // The model has no unknowns, because all bodies are welded to the ground.
            return Owner::Body(0);
        }
        self.model.owner_of_unknown(largest(&self.state.a[..n]) as usize)
    }
}

/// Energies at a state. Before the first step the formulation has not evaluated its terms, so the model is evaluated here.
fn energies_at<T: Real, const D: usize>(
    formulation: &dyn Formulation<T, D>,
    model: &NaturalModel<T, D>,
    state: &State<T>,
) -> [f64; 3] {
    match formulation.terms() {
        Some(_) if state.dt == T::ZERO => {
            // Inputs that are set for the next step do not act at this state yet, so the applied inputs are used.
            let mut now = state.clone();
            now.inputs.clone_from(&state.applied);
            energies(model, &now, None)
        }
        _ => formulation.energies(model, state),
    }
}

/// Largest velocity that counts as rounding error, in units of the machine precision of positions per step [-]. Chosen, not tuned.
const ROUNDINGS: f64 = 64.0;

/// Reference energy of the scene [J], to which energy errors are compared. It is the work of weight and prescribed forces over the length
/// of the scene, plus a small kinetic energy of all masses. This kinetic energy is that of the fastest motion that does not matter, divided
/// by the square root of machine precision. A motion does not matter if it is too slow to show in the run, or is a rounding error of
/// positions in a step.
fn ground<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    model: &NaturalModel<T, D>,
) -> f64 {
    let (length, epsilon) = (model.length().to_f64(), T::EPSILON.to_f64().max(f64::EPSILON));
    let mass: f64 = scene.bodies.iter().map(|body| body.mass.to_f64()).sum();
    let gravity = scene.gravity.map_or(0.0, |g| size(g));
    let peaks = peaks(scene, settings.duration);
    let loads: f64 = scene.effects.iter().map(|effect| given(&effect.kind, length, &peaks)).sum();
    let slow = epsilon.sqrt() / settings.duration.max(settings.step_max);
    let rounded = ROUNDINGS * epsilon / settings.step_max;
    let still = 0.5 * mass * length * length * (slow * slow + rounded * rounded);
    mass * gravity * length + loads + still / epsilon.sqrt()
}

/// Work of the largest force or torque that an effect prescribes [J], over the length of the scene or over one radian.
fn given<T: Real>(kind: &EffectKind<T>, length: f64, peaks: &[f64]) -> f64 {
    let largest = |signal: &Signal<T>| match signal {
        Signal::Constant(value) | Signal::Input(value) => size(*value),
        Signal::Table(rows) => rows.iter().map(|(_, value)| size(*value)).fold(0.0, f64::max),
        Signal::Named(of) => {
            let squares = of.iter().flatten().map(|s| peaks[s.index()] * peaks[s.index()]);
            squares.sum::<f64>().sqrt()
        }
    };
    let given = |(field, value): (&Field, Value<T>)| match value {
        // The force that a law computes from an input without unit is unknown, so it adds no energy.
        Value::Signal(_) if field.unit.is_empty() => 0.0,
        Value::Signal(signal) if field.unit == "N" => largest(&signal) * length,
        Value::Signal(signal) => largest(&signal),
        _ => 0.0,
    };
    kind.row().fields.iter().zip(kind.values()).map(given).sum()
}

/// Number of instants at which the signals of a run are sampled [-]. Chosen, not tuned.
const PEAK_INSTANTS: u32 = 256;

/// Largest absolute value of each signal, sampled at equidistant instants of a run. Inputs have their initial values.
fn peaks<T: Real>(scene: &Scene<T>, duration: f64) -> Vec<f64> {
    let signals = SignalGraph::new(&scene.signals);
    let mut peaks = vec![0.0_f64; signals.len()];
    for i in 0..=if peaks.is_empty() { 0 } else { PEAK_INSTANTS } {
        let t = duration * f64::from(i) / f64::from(PEAK_INSTANTS);
        for (peak, [value, ..]) in peaks.iter_mut().zip(signals.values(T::from_f64(t))) {
            *peak = peak.max(value.to_f64().abs());
        }
    }
    peaks
}

/// Euclidean length of a vector.
fn size<T: Real>(x: [T; 3]) -> f64 {
    x.iter().map(|x| x.to_f64() * x.to_f64()).sum::<f64>().sqrt()
}

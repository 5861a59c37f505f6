//! Work that a caller asks of a tree: steps, energies, efforts, mass matrix, reactions.

use crate::build::own_tables::own;
use crate::build::tree::{TreeModel, TreePlace};
use crate::host::state::{Explicit, TreeState, Workspace};
use crate::link::indexing::Outside;
use crate::link::options::Options;
use crate::passes::energy_balance;
use crate::passes::evaluate::{Level, accelerations, evaluate_rows};
use crate::passes::failure::failure;
use crate::passes::feedback::follow_motion;
use crate::passes::inverse;
use crate::passes::slices::{Inputs, Store, TreeSlices};
use crate::passes::{kinematics, rotor};
use crate::rows::Row;
use crate::space::{Numbers, Space};
use crate::step::bounded::{self, BoundedReport, Bounds, Unwatched};
use crate::step::{explicit, trapezoidal};
use mbs_core::Real;
use mbs_core::algebra::{Vector, cross};
use mbs_core::ode::{Adaptive, Extrapolation, Method, Radau, Tableau};
use mbs_core::step::{Step, StepError, StepReport};

/// Advances `state` by one step of length `dt` [s] of the trapezoidal rule, or another of the Newmark and generalised-alpha families.
///
/// Cost: see [`trapezoidal::step`]; no allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn step<T: Real, S: Space<T>>(
    model: &TreeModel<T, S>,
    dt: T,
    options: &Options<T>,
    state: &mut TreeState<T>,
    workspace: &mut Workspace<T, S>,
) -> Result<StepReport<T>, StepError> {
    check(dt, options)?;
    model.take_inputs(options, state, workspace)?;
    let m = model.mechanism();
    let mut s = workspace.store();
    let start = state.start();
    let start = (start, &state.a_aux[..]);
    let report = trapezoidal::step(&m, &model.inputs(state), (dt, options), start, &mut s);
    let report = report.map_err(|error| model.with_effect(error))?;
    // Work by the trapezoidal rule in time.
    let power = own(energy_balance::power(&m, &mut s));
    state.work += (state.power + power) * dt * T::HALF;
    take(options, (dt, power), &s, state);
    Ok(report)
}

/// Advances `state` by one step of length `dt` [s] of bounded work: what a controller does, here on the host.
///
/// The ledger of work is not kept.
///
/// Cost: see [`bounded::step`]; no allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn bounded_step<T: Real, S: Space<T>>(
    model: &TreeModel<T, S>,
    (dt, options, bounds): (T, &Options<T>, Bounds),
    state: &mut TreeState<T>,
    workspace: &mut Workspace<T, S>,
) -> Result<BoundedReport<T>, StepError> {
    check(dt, options)?;
    model.take_inputs(options, state, workspace)?;
    let m = model.mechanism();
    let mut s = workspace.store();
    let start = state.start();
    let start = (start, &mut Unwatched);
    let report = bounded::step(&m, &model.inputs(state), (dt, options, bounds), start, &mut s);
    let report = report.map_err(|error| model.with_effect(error))?;
    take(options, (dt, state.power), &s, state);
    Ok(report)
}

/// Advances `state` by one step of length `dt` [s] of the Runge-Kutta method of order 4.
///
/// Cost: see [`explicit::rk4`]; no allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn rk4_step<T: Real, S: Space<T>>(
    model: &TreeModel<T, S>,
    dt: T,
    options: &Options<T>,
    state: &mut TreeState<T>,
    workspace: &mut Workspace<T, S>,
) -> Result<StepReport<T>, StepError> {
    check(dt, options)?;
    model.take_inputs(options, state, workspace)?;
    let m = model.mechanism();
    let (mut s, scratch) = workspace.parts();
    let start = state.start();
    let memory = (start, &mut scratch.y[..], &mut scratch.scratch[..]);
    let report = explicit::rk4(&m, &model.inputs(state), (dt, options), memory, &mut s);
    let report = report.map_err(|error| model.with_effect(error))?;
    state.work += work(scratch);
    let power = own(energy_balance::power(&m, &mut s));
    take(options, (dt, power), &s, state);
    Ok(report)
}

/// Advances `state` by exactly `dt` [s] with the pair 5(4) of Dormand and Prince, in as many steps as `options.error` asks for.
///
/// The first step tried is `options.first_step`; the workspace remembers the last good one for the next call. No step is longer
/// than `dt`.
///
/// Cost: six evaluations for each step tried, with loops up to seven and about a quarter to take from its error what a projection takes
/// from the state; no allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn rk54_step<T: Real, S: Space<T>>(
    model: &TreeModel<T, S>,
    dt: T,
    options: &Options<T>,
    state: &mut TreeState<T>,
    workspace: &mut Workspace<T, S>,
) -> Result<StepReport<T>, StepError> {
    controlled(model, (dt, options), (state, workspace), |e| &mut e.pair, Tableau::dormand_prince)
}

/// Advances `state` by exactly `dt` [s] with the method 8(5,3) of Dormand and Prince, in as many steps as `options.error` asks for.
///
/// Steps are chosen as in [`rk54_step`]. For six digits and more, where the motion is smooth.
///
/// Cost: twelve evaluations for each step tried, and a half with loops; no allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn rk853_step<T: Real, S: Space<T>>(
    model: &TreeModel<T, S>,
    dt: T,
    options: &Options<T>,
    state: &mut TreeState<T>,
    workspace: &mut Workspace<T, S>,
) -> Result<StepReport<T>, StepError> {
    controlled(
        model,
        (dt, options),
        (state, workspace),
        |e| &mut e.eighth,
        Tableau::dormand_prince_8,
    )
}

/// Advances `state` by exactly `dt` [s] by extrapolation, in as many steps as `options.error` asks for, of the order that it is
/// worth.
///
/// Steps are chosen as in [`rk54_step`]. For reference runs: in double-double the error may be 1e-28.
///
/// Cost: k² evaluations for each step tried with k columns, one more with loops; no allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn extrapolated_step<T: Real, S: Space<T>>(
    model: &TreeModel<T, S>,
    dt: T,
    options: &Options<T>,
    state: &mut TreeState<T>,
    workspace: &mut Workspace<T, S>,
) -> Result<StepReport<T>, StepError> {
    let method = || Extrapolation::for_tolerance(options.error);
    controlled(model, (dt, options), (state, workspace), |e| &mut e.extrapolation, method)
}

/// Advances `state` by exactly `dt` [s] with collocation at three Radau points, implicit and of order 5, in as many steps as
/// `options.error` asks for.
///
/// Steps are chosen as in [`rk54_step`], of one length where possible. For stiff effects, which do not limit the step.
///
/// Cost: about ten evaluations for each step; for n components n + 1 more where slopes are found anew, and (n/2)³ products five
/// times where the step changes. The first call allocates 4 n² numbers, others nothing.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn radau5_step<T: Real, S: Space<T>>(
    model: &TreeModel<T, S>,
    dt: T,
    options: &Options<T>,
    state: &mut TreeState<T>,
    workspace: &mut Workspace<T, S>,
) -> Result<StepReport<T>, StepError> {
    let (n, leading) = (workspace.explicit.y.len(), model.n_coordinates);
    let method = || Radau::new(n, leading);
    controlled(model, (dt, options), (state, workspace), |e| &mut e.radau, method)
}

/// Advances by a method whose driver is remembered in `slot`, and made by the first call.
fn controlled<T: Real, S: Space<T>, M: Method<T>>(
    model: &TreeModel<T, S>,
    (dt, options): (T, &Options<T>),
    (state, workspace): (&mut TreeState<T>, &mut Workspace<T, S>),
    slot: impl Fn(&mut Explicit<T>) -> &mut Option<Adaptive<T, M>>,
    method: impl FnOnce() -> M,
) -> Result<StepReport<T>, StepError> {
    check(dt, options)?;
    model.take_inputs(options, state, workspace)?;
    let first = options.first_step.unwrap_or(dt);
    let known = slot(&mut workspace.explicit).take();
    let mut driver = known.unwrap_or_else(|| Adaptive::new(method(), first));
    let m = model.mechanism();
    let (mut s, scratch) = workspace.parts();
    let start = state.start();
    let memory = (start, &mut scratch.y[..], &mut scratch.scratch[..]);
    let report =
        explicit::controlled(&m, &model.inputs(state), (dt, options, &mut driver), memory, &mut s);
    *slot(scratch) = Some(driver);
    let report = report.map_err(|error| model.with_effect(error))?;
    state.work += work(scratch);
    let power = own(energy_balance::power(&m, &mut s));
    take(options, (dt, power), &s, state);
    Ok(report)
}

/// Is the step one that can be made, with options in their ranges? The tree's length has no part in it.
fn check<T: Real>(dt: T, options: &Options<T>) -> Result<(), StepError> {
    Step { dt, length: T::ONE }.checked()?;
    Ok(options.validate()?)
}

/// The work of an explicit step.
fn work<T: Real>(scratch: &Explicit<T>) -> T {
    scratch.y.last().copied().unwrap_or(T::ZERO)
}

/// The end of a step enters the state.
fn take<T: Real, S: Space<T>>(
    options: &Options<T>,
    (dt, power): (T, T),
    s: &Store<'_, T, S>,
    state: &mut TreeState<T>,
) {
    for ((aux, a), &next) in state.a_aux.iter_mut().zip(&mut state.a).zip(&*s.zdd) {
        *aux = options.integrator.auxiliary(next, [*a, *aux]);
        *a = next;
    }
    state.applied.copy_from_slice(&state.inputs);
    state.t += dt;
    state.power = power;
    state.z.copy_from_slice(s.z);
    state.v.copy_from_slice(s.v);
    state.lambda.copy_from_slice(s.lambda);
    state.signals.copy_from_slice(s.signals.ends);
}

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// The error with the effect of a load in place of its number.
    fn with_effect(&self, error: StepError) -> StepError {
        let of = |load: u32| {
            let effect = self.effects.get(load as usize).copied().unwrap_or(usize::MAX);
            u32::try_from(effect).unwrap_or(u32::MAX)
        };
        match error {
            StepError::Overturned { effect } => StepError::Overturned { effect: of(effect) },
            StepError::TwistOpen { effect } => StepError::TwistOpen { effect: of(effect) },
            StepError::LineCollapsed { effect, part } => {
                StepError::LineCollapsed { effect: of(effect), part }
            }
            error => error,
        }
    }

    /// Evaluates accelerations and multipliers of a state at its coordinates and velocities, without projection.
    ///
    /// Cost: one evaluation; no allocation.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    pub fn accelerate(
        &self,
        options: &Options<T>,
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
    ) -> Result<(), StepError> {
        let m = self.mechanism();
        let mut s = workspace.store();
        s.z.copy_from_slice(&state.z);
        s.v.copy_from_slice(&state.v);
        self.inputs(state).evaluate(state.t, s.guides, s.courses);
        own(s.begin_signals(T::ZERO, &state.signals));
        accelerations(&m, options, Level::Fine, &mut s).map_err(|fault| failure(&m, fault))?;
        state.set_accelerations(s.zdd);
        state.lambda.copy_from_slice(s.lambda);
        state.signals.copy_from_slice(s.signals.ends);
        Ok(())
    }

    /// Makes accelerations, multipliers and power those of the inputs that are set now, if others were set since the last step; says
    /// whether they were. What springs store under another input is booked as work. Every step begins with this; a caller that
    /// keeps a state to go back to calls it before.
    ///
    /// Cost: nothing without a change, else one evaluation; no allocation.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    pub fn take_inputs(
        &self,
        options: &Options<T>,
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
    ) -> Result<bool, StepError> {
        if !self.prescribed.differs(&state.inputs, &state.applied) {
            return Ok(false);
        }
        self.take_loads(options, state, workspace, state.t)?;
        Ok(true)
    }

    /// Makes the accelerations of a state, just before a signal jumps, those just after, at time `to` [s].
    ///
    /// Cost: one evaluation; no allocation.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    pub fn pass_jump(
        &self,
        options: &Options<T>,
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
        to: T,
    ) -> Result<(), StepError> {
        self.take_loads(options, state, workspace, to)?;
        state.t = to;
        Ok(())
    }

    /// From the loads of a state to those of the inputs that are set, at time `to` [s].
    fn take_loads(
        &self,
        options: &Options<T>,
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
        to: T,
    ) -> Result<(), StepError> {
        let m = self.mechanism();
        let mut s = workspace.store();
        self.place_in(state, &mut s);
        let before = own(energy_balance::potential(&m, &s.instant(&m)));
        let at_end = (&state.applied[..], &state.inputs[..]);
        self.prescribed.write_end(to, at_end, (s.guides, s.courses));
        own(s.begin_signals(T::ZERO, &state.signals));
        accelerations(&m, options, Level::Fine, &mut s).map_err(|fault| failure(&m, fault))?;
        let after = own(energy_balance::potential(&m, &s.instant(&m)));
        state.power = own(energy_balance::power(&m, &mut s));
        state.work += after - before;
        for ((aux, a), &new) in state.a_aux.iter_mut().zip(&mut state.a).zip(&*s.zdd) {
            *aux = if aux == a { new } else { new + (*aux - *a) };
            *a = new;
        }
        state.lambda.copy_from_slice(s.lambda);
        state.signals.copy_from_slice(s.signals.ends);
        self.prescribed.apply(&state.inputs, &mut state.applied);
        Ok(())
    }

    /// Kinetic and potential energy of a state [J].
    ///
    /// Cost: one outward pass; no allocation.
    pub fn energies(&self, state: &TreeState<T>, workspace: &mut Workspace<T, S>) -> [T; 2] {
        let m = self.mechanism();
        let mut s = workspace.store();
        self.place_in(state, &mut s);
        let rotors = own(kinetic(&m, (s.v, s.guides)));
        [
            energy_balance::kinetic(m.links, s.placed) + rotors,
            own(energy_balance::potential(&m, &s.instant(&m))),
        ]
    }

    /// Puts a state into the scratch.
    pub(crate) fn place_in(&self, state: &TreeState<T>, s: &mut Store<'_, T, S>) {
        s.z.copy_from_slice(&state.z);
        s.v.copy_from_slice(&state.v);
        s.lambda.copy_from_slice(&state.lambda);
        self.prescribed.write(state.t, &state.applied, s.guides, s.courses);
        own(kinematics(&self.links, (s.z, s.v, s.guides), s.placed));
        own(s.begin_signals(T::ZERO, &state.signals));
        own(follow_motion(&self.mechanism(), s));
    }

    /// Puts a state with its accelerations into the scratch and finds the forces through all joints.
    fn balance(&self, state: &TreeState<T>, s: &mut Store<'_, T, S>) {
        let m = self.mechanism();
        self.place_in(state, s);
        s.a[0] = S::motion(S::Spin::zero(), -m.gravity);
        own(inverse::spread(m.links, s.placed, &state.a, s.a));
        own(evaluate_rows(&m, s));
        own(inverse::forces(&m, s));
        own(rotor::add_efforts(&m, (&state.a, s.guides), s.condensed));
    }

    /// The force and moment [N, N m] of the first body of each joint on the second, at the joint's place on the second, global axes.
    /// Guides are included, effects along the joint are not; zero for welds and free joints. Where rows of loops repeat each other
    /// the multipliers are those of least norm.
    ///
    /// Cost: an outward and an inward pass; no allocation.
    ///
    /// # Panics
    /// If there are fewer places than joints.
    pub fn reactions(
        &self,
        state: &TreeState<T>,
        workspace: &mut Workspace<T, S>,
        out: &mut [[Vector<T, 3>; 2]],
    ) {
        let mut s = workspace.store();
        self.balance(state, &mut s);
        out.fill([Vector::zeros(); 2]);
        for seat in &self.seats {
            let Some(joint) = seat.branch.joint else { continue };
            let link = seat.link as usize;
            if self.links[link].kind == crate::link::LinkKind::Free {
                continue;
            }
            let through = s.condensed[link].force - along(seat, &s);
            let force = S::point_into(&S::point(&through));
            let moment = S::spin_into(&S::spin(&through));
            // On the child about its origin, the joint's place on it; turned round, about the place on the parent side.
            out[joint] = if seat.branch.is_reversed {
                let apart = s.placed[link].position - self.parent_place(seat, &s);
                let arm = S::point_into(&apart);
                [-force, -(moment + cross(&arm, &force))]
            } else {
                [force, moment]
            };
        }
        let n = self.rows.len();
        for lap in self.mechanism().loops.cut() {
            let (joint, second) = (lap.joint as usize, lap.links[1] as usize);
            let mut total = S::Motion::zero();
            for k in lap.first as usize..(lap.first + lap.n) as usize {
                total -= s.gradient[n + k] * s.lambda[k];
            }
            let arm = S::rotate(&s.placed[second].rotation, &lap.points[1]);
            let total = S::gathered(&total, &-arm);
            out[joint] = [S::point_into(&S::point(&total)), S::spin_into(&S::spin(&total))];
        }
    }

    /// The effort of `scene.couplings[coupling]`: the force along a coordinate is its factor times this [N m or N, by one of the factor].
    /// Nothing of one whose joints are all guided.
    #[must_use]
    pub fn coupling_effort(&self, state: &TreeState<T>, coupling: usize) -> Option<T> {
        let (_, coupled) = self.loops.split_at_checked(self.couplings.n_cut as usize)?;
        let lap = coupled.iter().find(|lap| lap.joint as usize == coupling)?;
        let row = lap.first as usize;
        let Some(Row::Coupled(of)) = self.rows.get(row) else { return None };
        Some(-*state.lambda.get(row)? * of.inverse)
    }

    /// The joint's place on the parent, from the base.
    fn parent_place(&self, seat: &TreePlace, s: &Store<'_, T, S>) -> S::Point {
        let first = &self.links[seat.first as usize];
        let parent = &s.placed[first.parent as usize];
        parent.position + S::rotate(&parent.rotation, &first.offset)
    }
}

/// Kinetic energy of the rotors [J].
fn kinetic<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    (v, guides): (&[T], &[[T; 3]]),
) -> Result<T, Outside> {
    let mut twice = T::ZERO;
    for rotor in m.rotors {
        let rate = rotor::of_link(m.links, rotor.link, v, (guides, 1))?;
        twice += rotor.inertia * rate * rate;
    }
    Ok(twice * T::HALF)
}

/// Returns the wrench of effects and rotors along the coordinates of a joint, on its last link about its origin.
fn along<T: Real, S: Space<T>>(place: &TreePlace, s: &Store<'_, T, S>) -> S::Motion {
    let mut sum = S::Motion::zero();
    for link in place.first as usize..=place.link as usize {
        let p = &s.placed[link];
        sum = S::gathered(&sum, &-p.arm) + p.freedom * s.condensed[link].effort;
    }
    sum
}

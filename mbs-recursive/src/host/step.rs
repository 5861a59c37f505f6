//! Steps of a tree on the host, by each of its methods.

use crate::build::own_tables::own;
use crate::build::tree::TreeModel;
use crate::host::state::{Explicit, TreeState, Workspace};
use crate::link::options::Options;
use crate::passes::energy_balance;
use crate::passes::slices::{Inputs, Start, Store, TreeSlices};
use crate::space::Space;
use crate::step::bounded::{self, BoundedReport, Bounds, Unwatched};
use crate::step::{explicit, trapezoidal};
use mbs_core::Real;
use mbs_core::ode::{Adaptive, Extrapolation, Method, Radau, Tableau};
use mbs_core::step::{Step, StepError, StepReport};

/// Method of a step.
///
/// A method with error control advances by exactly the requested length, in as many steps as `options.error` requires. The first step tried
/// has the length `options.first_step`, or the requested length if that is `None`. No step is longer than the requested length. The
/// workspace stores the last accepted step length for the next call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TreeMethod {
    /// The trapezoidal rule, or another of the Newmark and generalised-alpha families by `options.integrator`.
    ///
    /// Cost: see [`trapezoidal::step`].
    Trapezoidal,
    /// The Runge-Kutta method of order 4.
    ///
    /// Cost: see [`explicit::rk4`].
    Rk4,
    /// The pair 5(4) of Dormand and Prince, with error control.
    ///
    /// Cost: six evaluations for each step tried. With loops the cost is at most 7.25 evaluations, because the error is projected too.
    Rk54,
    /// The method 8(5,3) of Dormand and Prince, with error control: for errors of 1e-6 and below in smooth motions.
    ///
    /// Cost: twelve evaluations for each step tried; with loops 12.5 evaluations.
    Rk853,
    /// Extrapolation with error control, which chooses its order by cost. This method is for reference runs: in double-double numbers the
    /// required error may be as small as 1e-28.
    ///
    /// Cost: k² evaluations for each step tried with k columns; one more with loops.
    Extrapolation,
    /// Radau collocation with three points and error control, implicit and of order 5. Stiff effects do not limit its step. The step length
    /// is kept constant where possible.
    ///
    /// Cost: about ten evaluations for each step. With n components, a new Jacobian takes n + 1 more evaluations. A change of the step
    /// length takes 5 (n/2)³ multiplications. The first call allocates 4 n² numbers.
    Radau5,
}

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Advances `state` by one step of length `dt` [s] with a method.
    ///
    /// Cost: see the [`TreeMethod`]. The step allocates only where the documentation of the method says so.
    ///
    /// # Errors
    /// [`StepError`]; the inputs are then applied by [`TreeModel::take_inputs`], and the state is otherwise unchanged.
    pub fn step(
        &self,
        method: TreeMethod,
        dt: T,
        options: &Options<T>,
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
    ) -> Result<StepReport<T>, StepError> {
        self.begin_step((dt, options), state, workspace)?;
        let (m, inputs) = (self.mechanism(), self.inputs(state));
        let (mut s, scratch) = workspace.parts();
        let start = (state.start(), &state.a_aux[..]);
        let report = make(&m, &inputs, (method, dt, options), (start, &mut *scratch), &mut s);
        let report = report.map_err(|error| self.with_effect(error))?;
        let power = own(energy_balance::power(&m, &mut s));
        state.work += if method == TreeMethod::Trapezoidal {
            // The power is integrated by the trapezoidal rule.
            (state.power + power) * dt * T::HALF
        } else {
            scratch.y.last().copied().unwrap_or(T::ZERO)
        };
        take(options, (dt, power), &s, state);
        Ok(report)
    }

    /// Advances `state` by one step of length `dt` [s] with a bounded number of operations, as a controller does.
    ///
    /// The state's `work` is not updated.
    ///
    /// Cost: see [`bounded::step`]; no allocation.
    ///
    /// # Errors
    /// [`StepError`]; the inputs are then applied by [`TreeModel::take_inputs`], and the state is otherwise unchanged.
    pub fn bounded_step(
        &self,
        (dt, options, bounds): (T, &Options<T>, Bounds),
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
    ) -> Result<BoundedReport<T>, StepError> {
        self.begin_step((dt, options), state, workspace)?;
        let (m, mut s) = (self.mechanism(), workspace.store());
        let start = (state.start(), &mut Unwatched);
        let report = bounded::step(&m, &self.inputs(state), (dt, options, bounds), start, &mut s);
        let report = report.map_err(|error| self.with_effect(error))?;
        take(options, (dt, state.power), &s, state);
        Ok(report)
    }

    /// Checks that the step can be made, and applies the inputs that are set now.
    fn begin_step(
        &self,
        (dt, options): (T, &Options<T>),
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
    ) -> Result<(), StepError> {
        Step { dt, length: T::ONE }.checked()?;
        options.validate()?;
        self.take_inputs(options, state, workspace).map(drop)
    }

    /// Returns the error with the index of the scene's effect in place of the index of the load.
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
}

/// Makes one step of a method and writes the state at the end of the step into `s`. For every method except the trapezoidal rule, the last
/// entry of `y` is the work done.
fn make<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    (method, dt, options): (TreeMethod, T, &Options<T>),
    ((start, aux), scratch): ((Start<'_, T>, &[T]), &mut Explicit<T>),
    s: &mut Store<'_, T, S>,
) -> Result<StepReport<T>, StepError> {
    let Explicit { y, scratch, pair, eighth, extrapolation, radau } = scratch;
    let n = y.len();
    let memory = (start, &mut y[..], &mut scratch[..]);
    match method {
        TreeMethod::Trapezoidal => trapezoidal::step(m, inputs, (dt, options), (memory.0, aux), s),
        TreeMethod::Rk4 => explicit::rk4(m, inputs, (dt, options), memory, s),
        TreeMethod::Rk54 => {
            let driver = driver(pair, (dt, options), Tableau::dormand_prince);
            explicit::controlled(m, inputs, (dt, options, driver), memory, s)
        }
        TreeMethod::Rk853 => {
            let driver = driver(eighth, (dt, options), Tableau::dormand_prince_8);
            explicit::controlled(m, inputs, (dt, options, driver), memory, s)
        }
        TreeMethod::Extrapolation => {
            let new = || Extrapolation::for_tolerance(options.error);
            let driver = driver(extrapolation, (dt, options), new);
            explicit::controlled(m, inputs, (dt, options, driver), memory, s)
        }
        TreeMethod::Radau5 => {
            let driver = driver(radau, (dt, options), || Radau::new(n, m.n_coordinates));
            explicit::controlled(m, inputs, (dt, options, driver), memory, s)
        }
    }
}

/// Returns the driver of a method with error control. Its first call makes the driver, which then remembers the length of its steps.
fn driver<'a, T: Real, M: Method<T>>(
    known: &'a mut Option<Adaptive<T, M>>,
    (dt, options): (T, &Options<T>),
    method: impl FnOnce() -> M,
) -> &'a mut Adaptive<T, M> {
    known.get_or_insert_with(|| Adaptive::new(method(), options.first_step.unwrap_or(dt)))
}

/// Copies the result of a step into the state.
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

//! Steps of the mechanism as a first-order system. The explicit Runge-Kutta method of order 4 has a fixed step. The pair 5(4), the method
//! 8(5,3), extrapolation and implicit Radau collocation have error control.
//!
//! ```text
//! y = (z, ż, x, W),   y' = (ż or ½ q ω for rotations, z̈, x', power)      x: states of signals
//! ```
//!
//! Positions and velocities are projected onto the loops after each accepted step. Quaternions are normalised at the end. The methods are
//! implemented in [`mbs_core::ode`].

use crate::link::indexing::Outside;
use crate::link::options::{Closure, Options};
use crate::link::{Link, LinkKind};
use crate::passes::collapse::check_lines;
use crate::passes::energy_balance;
use crate::passes::evaluate::{Level, accelerations, is_redundant, is_tight};
use crate::passes::failure::failure;
use crate::passes::overturned::check_rotations;
use crate::passes::slices::{Counts, Inputs, Start, Store, TreeSlices};
use crate::space::{Numbers, Space};
use crate::step::project::{self, project};
use crate::step::trapezoidal::violations;
use mbs_core::Real;
use mbs_core::ode::{self, Adaptive, EndState, Method, OdeError, Rates};
use mbs_core::step::{StepError, StepReport, Stop};

/// A mechanism as a system of first-order differential equations.
struct System<'r, 'a, 'b, T: Real, S: Space<T>, I> {
    m: &'r TreeSlices<'a, T, S>,
    inputs: &'r I,
    options: &'r Options<T>,
    s: &'r mut Store<'b, T, S>,
    evaluations: u32,
    /// True if a shorter step is tried after a failed evaluation, as error control does.
    is_patient: bool,
    /// Level of the residual at which sweeps for the accelerations end. With error control it is a hundredth of the required error.
    level: Level,
    last_failure: Option<StepError>,
}

impl<'r, 'a, 'b, T: Real, S: Space<T>, I: Inputs<T>> System<'r, 'a, 'b, T, S, I> {
    /// Makes the system of a mechanism. `level` is the accuracy of the accelerations: rounding for a fixed step, a fraction of the required
    /// error with error control.
    fn new(
        m: &'r TreeSlices<'a, T, S>,
        inputs: &'r I,
        (options, level): (&'r Options<T>, Level),
        s: &'r mut Store<'b, T, S>,
    ) -> Self {
        let is_patient = level == Level::Rates;
        Self { m, inputs, options, s, evaluations: 0, is_patient, level, last_failure: None }
    }

    /// Sets time and state, and evaluates the inputs at that time.
    fn set(&mut self, t: T, y: &[T]) {
        let (nz, nv) = (self.m.n_coordinates, self.m.n_freedoms);
        self.inputs.evaluate(t, self.s.guides, self.s.courses);
        self.s.z.copy_from_slice(&y[..nz]);
        self.s.v.copy_from_slice(&y[nz..nz + nv]);
        self.s.signals.dt = T::ZERO;
        let states = &y[nz + nv..][..self.m.feedback.n_states];
        for (start, &x) in self.s.signals.starts.iter_mut().zip(states) {
            *start = [x, T::ZERO];
        }
    }

    /// Projects the state at the end of a step, with the inertias of the last stage. The violations that remain are at most `share` times
    /// their scales.
    fn clean(&mut self, t: T, y: &mut [T], share: T) -> Result<EndState, StepError> {
        if self.m.loops.loops.is_empty() || self.options.closure != Closure::Constraints {
            return Ok(EndState::Kept);
        }
        let (nz, nv) = (self.m.n_coordinates, self.m.n_freedoms);
        self.set(t, y);
        project(self.m, (self.options, share), self.s).map_err(|fault| failure(self.m, fault))?;
        y[..nz].copy_from_slice(self.s.z);
        y[nz..nz + nv].copy_from_slice(self.s.v);
        Ok(if is_tight(self.s) { EndState::Changed } else { EndState::Projected })
    }

    /// Evaluates the accelerations at the end of the step and returns its report.
    fn finish(&mut self, t: T, y: &[T]) -> Result<StepReport<T>, StepError> {
        self.set(t, y);
        normalise(self.m.links, self.s.z);
        let left = accelerations(self.m, self.options, Level::Fine, self.s)
            .map_err(|fault| failure(self.m, fault))?;
        let [position, velocity, _] = violations(self.m, self.s);
        Ok(StepReport {
            iterations: self.evaluations + 1,
            factorizations: self.s.counts.condensations,
            solves: self.s.counts.responses,
            stop: Stop::Explicit,
            violation: [position, velocity, left],
            ..StepReport::default()
        })
    }
}

impl<T: Real, S: Space<T>, I: Inputs<T>> Rates<T> for System<'_, '_, '_, T, S, I> {
    type Error = StepError;

    fn n(&self) -> usize {
        n_components(self.m)
    }

    fn rates(&mut self, t: T, y: &[T], dy: &mut [T]) -> Result<(), StepError> {
        let (nz, nv) = (self.m.n_coordinates, self.m.n_freedoms);
        self.evaluations += 1;
        self.set(t, y);
        let projects = self.evaluations > 1
            && self.options.closure == Closure::Constraints
            && is_redundant(self.s);
        let ready = if projects {
            // The inertias of this stage make the projected rates a smooth function of y.
            accelerations(self.m, self.options, Level::Once, self.s)
                .and_then(|_| project(self.m, (self.options, project::rounding()), self.s))
                .map(|_| ())
        } else {
            Ok(())
        };
        let done = ready.and_then(|()| accelerations(self.m, self.options, self.level, self.s));
        if let Err(fault) = done {
            let failure = failure(self.m, fault);
            // If the state has NaN or infinity, the error is a consequence of an earlier error and is not stored.
            if y.iter().all(|y| y.is_finite()) {
                self.last_failure = Some(failure);
            }
            if self.is_patient {
                // NaN rates make the step controller try a shorter step.
                dy.fill(T::from_f64(f64::NAN));
                return Ok(());
            }
            return Err(failure);
        }
        coordinate_rates(self.m.links, self.s.z, self.s.v, &mut dy[..nz]);
        dy[nz..nz + nv].copy_from_slice(self.s.zdd);
        let (of_signals, work) = dy[nz + nv..].split_at_mut(self.m.feedback.n_states);
        of_signals.iter_mut().zip(&*self.s.signals.ends).for_each(|(to, [_, rate])| *to = *rate);
        work[0] = energy_balance::power(self.m, self.s)
            .map_err(|outside| failure(self.m, outside.into()))?;
        Ok(())
    }

    fn fine_rates(&mut self, t: T, y: &[T], dy: &mut [T]) -> Result<(), StepError> {
        let level = core::mem::replace(&mut self.level, Level::Fine);
        let done = self.rates(t, y, dy);
        self.level = level;
        done
    }

    fn keep(&mut self, error: &mut [T]) -> Result<(), StepError> {
        if self.m.loops.loops.is_empty() || self.options.closure != Closure::Constraints {
            return Ok(());
        }
        let (nz, nv) = (self.m.n_coordinates, self.m.n_freedoms);
        let failed = |outside: Outside| failure(self.m, outside.into());
        let (places, rest) = error.split_at_mut(nz);
        // Away from singular positions this part of the position error is of higher order in the step length, so that it is not removed.
        // The projection is over freedoms. Trees with quaternions have more coordinates than freedoms, so that it does not apply to them.
        if nz == nv && is_tight(self.s) {
            project::keep(self.m, places, self.s).map_err(failed)?;
        }
        project::keep(self.m, &mut rest[..nv], self.s).map_err(failed)
    }
}

/// Number of components of the vector y.
#[must_use]
pub fn n_components<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> usize {
    m.n_coordinates + m.n_freedoms + m.feedback.n_states + 1
}

/// Computes the rates z' from z and v.
fn coordinate_rates<T: Real, S: Space<T>>(links: &[Link<T, S>], z: &[T], v: &[T], rates: &mut [T]) {
    for link in links.iter().skip(1) {
        let (at, from) = (link.z as usize, link.v as usize);
        match link.kind {
            LinkKind::Revolute | LinkKind::Prismatic => rates[at] = v[from],
            LinkKind::Ball => S::rotation_rate(&z[at..], &v[from..], &mut rates[at..]),
            LinkKind::Free => {
                S::rotation_rate(&z[at..], &v[from..], &mut rates[at..]);
                let place = at + S::FREE - S::Point::N;
                for i in 0..S::Point::N {
                    rates[place + i] = v[from + S::Spin::N + i];
                }
            }
            LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => {}
        }
    }
}

/// Normalises all quaternions to unit length.
fn normalise<T: Real, S: Space<T>>(links: &[Link<T, S>], z: &mut [T]) {
    for link in links.iter().skip(1) {
        if matches!(link.kind, LinkKind::Ball | LinkKind::Free) {
            S::normalise_rotation(&mut z[link.z as usize..]);
        }
    }
}

/// Writes the vector y at the start of a step.
fn begin<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>, start: &Start<'_, T>, y: &mut [T]) {
    let (nz, nv) = (m.n_coordinates, m.n_freedoms);
    y[..nz].copy_from_slice(start.z);
    y[nz..nz + nv].copy_from_slice(start.v);
    let (of_signals, work) = y[nz + nv..].split_at_mut(m.feedback.n_states);
    of_signals.iter_mut().zip(start.signals).for_each(|(to, [x, _])| *to = *x);
    work[0] = T::ZERO;
}

/// Makes one step of order 4. The state at the end is written to `s.z`, `s.v`, `s.zdd` and `s.lambda`. The work done is the last entry of
/// `y`.
///
/// `y` has [`n_components`] numbers. The length of `scratch` is at least [`mbs_core::ode::rk4_scratch`] for this number.
///
/// Cost: five evaluations; no allocation.
///
/// # Errors
/// [`StepError`].
pub fn rk4<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    (dt, options): (T, &Options<T>),
    (start, y, scratch): (Start<'_, T>, &mut [T], &mut [T]),
    s: &mut Store<'_, T, S>,
) -> Result<StepReport<T>, StepError> {
    s.counts = Counts::default();
    begin(m, &start, y);
    let mut system = System::new(m, inputs, (options, Level::Fine), s);
    ode::rk4_step(&mut system, start.t, dt, y, scratch)?;
    system.clean(start.t + dt, y, project::rounding())?;
    let report = system.finish(start.t + dt, y)?;
    check_rotations(m, inputs, (&start, dt), s)?;
    check_lines(m, inputs, (&start, dt), s)?;
    Ok(report)
}

/// Advances by exactly `dt` [s] with the driver's method, in as many steps as the tolerance requires.
///
/// `scratch` has at least [`Method::n_scratch`] numbers.
///
/// Cost: the method's evaluations for each step tried, and one more with loops; no allocation.
///
/// # Errors
/// [`StepError`]. If even the shortest step fails, the error is the cause of the last failure.
pub fn controlled<T: Real, S: Space<T>, M: Method<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    (dt, options, driver): (T, &Options<T>, &mut Adaptive<T, M>),
    (start, y, scratch): (Start<'_, T>, &mut [T], &mut [T]),
    s: &mut Store<'_, T, S>,
) -> Result<StepReport<T>, StepError> {
    s.counts = Counts::default();
    begin(m, &start, y);
    let before = driver.counts();
    let mut control = ode::Options::new(options.error);
    control.max_steps = options.max_steps;
    let mut system = System::new(m, inputs, (options, Level::Rates), s);
    let done =
        driver.advance(&mut system, (start.t, dt), (y, scratch), &control, |system, t, y| {
            system.last_failure = None;
            // Near a singular position a small violation of rows means a large position error: the violation divided by the root of a small
            // pivot.
            let is_fine = t == start.t + dt || is_tight(system.s);
            let share =
                if is_fine { project::rounding() } else { project::share_of(options.error) };
            system.clean(t, y, share)
        });
    match done {
        Ok(()) => {}
        Err(OdeError::Rates { error, .. }) => return Err(error),
        Err(OdeError::StepTooSmall { step, .. }) => {
            return Err(system.last_failure.unwrap_or(StepError::StepTooSmall { step }));
        }
        Err(_) => return Err(StepError::StepTooSmall { step: driver.step().to_f64() }),
    }
    let after = driver.counts();
    let mut report = system.finish(start.t + dt, y)?;
    let count = |n: u64| u32::try_from(n).unwrap_or(u32::MAX);
    report.steps = count(after.accepted - before.accepted);
    report.rejected = count(after.rejected - before.rejected);
    check_rotations(m, inputs, (&start, dt), s)?;
    check_lines(m, inputs, (&start, dt), s)?;
    Ok(report)
}

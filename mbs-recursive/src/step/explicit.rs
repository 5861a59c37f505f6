//! Steps of a first-order system. Explicit Runge-Kutta of order 4 has a fixed step; the pair 5(4), the method 8(5,3), extrapolation
//! and the implicit collocation at Radau points have error control.
//!
//! ```text
//! y = (z, ż, x, W),   y' = (ż or ½ q ω for rotations, z̈, x', power)      x: states of signals
//! ```
//!
//! Positions and velocities are projected on the loops after each accepted step, quaternions made unit at the end. The stages
//! are those of [`mbs_core::ode`].

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

/// A mechanism as a system of first order.
struct System<'r, 'a, 'b, T: Real, S: Space<T>, I> {
    m: &'r TreeSlices<'a, T, S>,
    inputs: &'r I,
    options: &'r Options<T>,
    s: &'r mut Store<'b, T, S>,
    evaluations: u32,
    /// Error control tries a shorter step where an evaluation fails.
    is_patient: bool,
    /// Residual at which sweeps for the accelerations end: with error control a hundredth of its error.
    level: Level,
    last_failure: Option<StepError>,
}

impl<'r, 'a, 'b, T: Real, S: Space<T>, I: Inputs<T>> System<'r, 'a, 'b, T, S, I> {
    /// Makes the system with the level of its accelerations: to rounding with a fixed step, else to the error's.
    fn new(
        m: &'r TreeSlices<'a, T, S>,
        inputs: &'r I,
        (options, level): (&'r Options<T>, Level),
        s: &'r mut Store<'b, T, S>,
    ) -> Self {
        let is_patient = level == Level::Rates;
        Self { m, inputs, options, s, evaluations: 0, is_patient, level, last_failure: None }
    }

    /// Takes over time and state.
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

    /// Projects the end of a step until no more than this share is left, with the inertias of its last stage.
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

    /// Accelerations at the end, and what was done.
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
            // With the inertias of this very stage, so that the projected rates are a smooth function of y.
            accelerations(self.m, self.options, Level::Once, self.s)
                .and_then(|_| project(self.m, (self.options, project::rounding()), self.s))
                .map(|_| ())
        } else {
            Ok(())
        };
        let done = ready.and_then(|()| accelerations(self.m, self.options, self.level, self.s));
        if let Err(fault) = done {
            let failure = failure(self.m, fault);
            // Numbers that follow from a failed stage say nothing.
            if y.iter().all(|y| y.is_finite()) {
                self.last_failure = Some(failure);
            }
            if self.is_patient {
                // No number: the step is tried shorter.
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
        // Elsewhere what is taken from positions is less by a step; coordinates of rotations are not those of freedoms.
        if nz == nv && is_tight(self.s) {
            project::keep(self.m, places, self.s).map_err(failed)?;
        }
        project::keep(self.m, &mut rest[..nv], self.s).map_err(failed)
    }
}

/// Number of components of y.
#[must_use]
pub fn n_components<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> usize {
    m.n_coordinates + m.n_freedoms + m.feedback.n_states + 1
}

/// z' from z and v.
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

/// Makes quaternions unit.
fn normalise<T: Real, S: Space<T>>(links: &[Link<T, S>], z: &mut [T]) {
    for link in links.iter().skip(1) {
        if matches!(link.kind, LinkKind::Ball | LinkKind::Free) {
            S::normalise_rotation(&mut z[link.z as usize..]);
        }
    }
}

/// y at the start of a step.
fn begin<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>, start: &Start<'_, T>, y: &mut [T]) {
    let (nz, nv) = (m.n_coordinates, m.n_freedoms);
    y[..nz].copy_from_slice(start.z);
    y[nz..nz + nv].copy_from_slice(start.v);
    let (of_signals, work) = y[nz + nv..].split_at_mut(m.feedback.n_states);
    of_signals.iter_mut().zip(start.signals).for_each(|(to, [x, _])| *to = *x);
    work[0] = T::ZERO;
}

/// Makes one step of order 4: the end is in `s.z`, `s.v`, `s.zdd`, `s.lambda`, the work done in the last place of `y`.
///
/// `y` has [`n_components`] numbers, `scratch` at least [`mbs_core::ode::rk4_scratch`] of them.
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

/// Advances by exactly `dt` [s] with the driver's method, in as many steps as the tolerance asks for.
///
/// `scratch` has at least [`Method::n_scratch`] numbers.
///
/// Cost: the method's evaluations for each step tried, one more with loops; no allocation.
///
/// # Errors
/// [`StepError`]; where no step is short enough, what made the last one fail.
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
            // Near a singular position what is left of rows leaves positions off by it over the root of a small pivot.
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

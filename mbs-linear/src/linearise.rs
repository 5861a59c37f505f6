//! Linearisation of the equations of motion in independent coordinates about a state.
//!
//! ```text
//! z'' = f(z, z'):   q(z) on the constraints, q'(z, z') with J q' + phi_t = 0,  M q'' + J^T lambda = Q,  J q'' + bias = 0
//! K_r = -df/dz,   C_r = -df/dz'         (inertia 1, see `tangent_coordinates`)
//! d/dt (z, z') = A (z, z') + ...,   A = [[0, 1], [-K_r, -C_r]]        (with states of signals: see `signals`)
//! ```
//!
//! Derivatives are central differences of fourth order of the equations of motion themselves. The tangents that effects provide for implicit
//! steps are not used, because they may be symmetrised or clipped. The differences include stiffness that acts through multipliers alone,
//! such as that of a pendulum.
//!
//! For a state at rest in equilibrium, and for a uniform translation (a vehicle that drives straight), A is constant and its eigenvalues are
//! properties of the mechanism. Where bodies rotate, A changes along the motion and depends on the choice of z: see [`Linear::turning`].

use crate::error::LinearError;
use crate::linear::Linear;
use crate::options::LinearOptions;
use crate::tangent_coordinates::TangentCoordinates;
use crate::watch::Watch;
use crate::workspace::Workspace;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::algebra::norm_inf;
use mbs_core::model::{Load, Model, State};
use mbs_core::{Real, SymmetricSolver};

/// Motion of guides and signals at the time of a linearisation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Instant {
    /// Guides keep their values at that time; rates and accelerations are zero, as in an equilibrium.
    Rest,
    /// Guides move as prescribed at that time.
    Motion,
}

/// Largest number of sweeps that close the constraints near the state [-]. Chosen, not tuned.
const SWEEPS: u32 = 60;
/// Largest displacement that closes the constraints, relative to a difference of coordinates [-]. The curvature of constraints alone causes
/// about 1e-4.
const CURVED: f64 = 0.1;
/// Largest displacement that closes the constraints, relative to a difference and per unit of the difference's length [-]. If the
/// displacement is longer, the difference is made shorter. At the default length of 1e-4 the largest ratio is 0.001. The modes of a chain
/// of 60 links then have nine correct digits. They have five correct digits at ten times this value.
const FLAT: f64 = 10.0;
/// Smallest factor that makes a difference shorter in one trial [-]. Chosen, not tuned.
const SHORTER: f64 = 1.0 / 64.0;
/// Largest number of lengths that are tried for a difference [-]. Chosen, not tuned.
const LENGTHS: u32 = 4;
/// Displacement that counts as rounding error, in units of EPSILON times the coordinates [-]. Chosen, not tuned.
const ROUNDED: f64 = 16.0;
/// Rounding error of accelerations, in units of EPSILON times their terms [-]. Chosen, not tuned.
const NOISE: f64 = 16.0;
/// Constraint violation at which sweeps without progress may end, relative to the rounding error of a row [-]. Chosen, not tuned.
const STALLED: f64 = 1e3;

/// Linearises about the consistent state `s`. Time and measured angles are constant.
///
/// At a corner of a force law (a contact that begins, a damper with two branches at rest) the result is the mean of both sides. Near a
/// corner the result is a value between those of both sides. Differences are shorter where the constraints are strongly curved, as those of
/// a long chain are.
///
/// Cost for f freedoms: 4 f + 1 factorisations, 9 f evaluations, and 4 more evaluations for each state of a signal. The dense split of the
/// n coordinates costs n^3 operations. Allocates.
///
/// # Errors
/// [`LinearError`] if the constraints are not satisfied, a singular position is close, or the state lacks inertia.
pub fn linearise<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    how: (Instant, &LinearOptions<T>),
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<Linear<T>, LinearError> {
    let mut field = Field::checked(model, how, s, w)?;
    let (linear, _) = field.linear(how.1.step)?;
    Ok(Linear { basis: field.tangent.basis, ..linear })
}

/// Returns the central difference of fourth order, (8 (f(h) - f(-h)) - (f(2h) - f(-2h))) / 12 h.
pub(crate) fn difference<T: Real>(
    h: T,
    mut f: impl FnMut(T) -> Result<Vec<T>, LinearError>,
) -> Result<Vec<T>, LinearError> {
    let (two, eight, twelve) = (T::TWO, T::from_f64(8.0), T::from_f64(12.0));
    let [a, b, c, d] = [f(h)?, f(-h)?, f(two * h)?, f(-two * h)?];
    let slope = |i: usize| (eight * (a[i] - b[i]) - (c[i] - d[i])) / (twelve * h);
    Ok((0..a.len()).map(slope).collect())
}

/// Accelerations z'' as a function of z and z'.
pub(crate) struct Field<'a, T, M, S> {
    pub(crate) model: &'a M,
    pub(crate) w: &'a mut Workspace<T, S>,
    pub(crate) start: &'a State<T>,
    pub(crate) tangent: TangentCoordinates<T>,
    /// Present position and velocity; extended vectors, which include known coordinates.
    pub(crate) q: Vec<T>,
    pub(crate) v: Vec<T>,
    /// Accelerations (an extended vector) and multipliers at the last evaluation.
    pub(crate) a: Vec<T>,
    pub(crate) lambda: Vec<T>,
    /// Largest acceleration that a single force would cause, in sizes of coordinates [1/s^2].
    pub(crate) lively: T,
    /// Length of the shortest difference so far, in sizes of coordinates [-].
    shortest: T,
    /// Measure of the outputs at each state; `None` if no outputs are required.
    pub(crate) watch: Option<Watch<'a, T>>,
}

/// Derivatives by coordinates or by velocities; matrices are stored column by column.
pub(crate) struct Slopes<T> {
    /// Derivatives of the accelerations, as -z''.
    pub(crate) forces: Vec<T>,
    /// Derivatives of the rates x' of the states of signals.
    signals: Vec<T>,
    /// Derivatives of the outputs.
    pub(crate) outputs: Vec<T>,
}

impl<'a, T: Real, M: Model<T>, S: SymmetricSolver<T>> Field<'a, T, M, S> {
    pub(crate) fn new(
        model: &'a M,
        instant: Instant,
        s: &'a State<T>,
        w: &'a mut Workspace<T, S>,
    ) -> Result<Self, LinearError> {
        let n = w.n;
        model.set_inputs(s.t, s, &mut w.terms);
        if instant == Instant::Rest {
            for guide in &mut w.terms.guides {
                *guide = [guide[0], T::ZERO, T::ZERO];
            }
        }
        model.evaluate(&s.q, &mut w.terms);
        let mut jacobian = vec![T::ZERO; w.m * n];
        let (mut unit, mut rates) = (vec![T::ZERO; model.n_extended()], vec![T::ZERO; w.m]);
        for i in 0..n {
            unit[i] = T::ONE;
            model.multiply_jacobian(&w.terms, &unit, &mut rates);
            unit[i] = T::ZERO;
            for (k, &x) in rates.iter().enumerate() {
                jacobian[k * n + i] = x;
            }
        }
        let mut local = Vec::new();
        let rows = (jacobian, |row| model.is_velocity_row(row));
        let tangent = TangentCoordinates::new(&w.sizes, rows, |x| {
            unit[..n].copy_from_slice(x);
            let load = Load { mass: Some(&unit), multipliers: None, force: T::ZERO };
            let mut product = vec![T::ZERO; n];
            for e in 0..model.n_elements() {
                let clique = model.clique(e);
                local.resize(clique.len(), T::ZERO);
                model.write_residual(&w.terms, &load, e, &mut local);
                for (&u, &x) in clique.iter().zip(&local) {
                    product[u as usize] += x;
                }
            }
            product
        });
        let tangent = tangent.map_err(|unknown| LinearError::NoInertia {
            unknown: u32::try_from(unknown).unwrap_or(u32::MAX),
        })?;
        let (q, v) = (s.q.clone(), s.v.clone());
        let (a, lambda) = (Vec::new(), Vec::new());
        let (lively, shortest, watch) = (T::ZERO, T::ONE, None);
        let mut field =
            Self { model, w, start: s, tangent, q, v, a, lambda, lively, shortest, watch };
        // The factorisation also sets the sizes of the rows.
        field.factor()?;
        field.close()?;
        field.factor()?;
        Ok(field)
    }

    /// Creates a field after a check of options and motion.
    pub(crate) fn checked(
        model: &'a M,
        (instant, options): (Instant, &LinearOptions<T>),
        s: &'a State<T>,
        w: &'a mut Workspace<T, S>,
    ) -> Result<Self, LinearError> {
        options.validate()?;
        let is_moving = s.v.iter().any(|v| !v.is_zero());
        if model.has_velocity_rows() && is_moving {
            return Err(LinearError::Rolls);
        }
        Self::new(model, instant, s, w)
    }

    /// Returns the linearised motion without its basis, and the values of the outputs with their derivatives by z, z' and the states x of
    /// signals.
    pub(crate) fn linear(&mut self, reach: T) -> Result<(Linear<T>, [Vec<T>; 2]), LinearError> {
        let (f, start) = (self.tangent.n_freedoms(), self.start);
        let acceleration = self.at_rest_of(&start.v)?;
        let values = self.measured()?;
        let turning = norm_inf(&self.w.terms.phi_bias);
        let by_places = self.by_places(reach)?;
        self.return_to(&start.q)?;
        let by_speeds = self.by_speeds(reach)?;
        let rates = [by_places.signals, by_speeds.signals].concat();
        let (signals, by_signals) = self.signals(reach, rates)?;
        let (stiffness, damping, basis) = (by_places.forces, by_speeds.forces, Vec::new());
        let noise = self.noise(&stiffness);
        let (n_freedoms, lively) = (f, self.lively);
        let linear = Linear {
            n_freedoms,
            stiffness,
            damping,
            basis,
            acceleration,
            turning,
            noise,
            lively,
            signals,
        };
        Ok((linear, [values, [by_places.outputs, by_speeds.outputs, by_signals].concat()]))
    }

    /// Returns the derivatives by z, from differences that move coordinates by `reach` of their sizes.
    pub(crate) fn by_places(&mut self, reach: T) -> Result<Slopes<T>, LinearError> {
        let mut change = vec![T::ZERO; self.tangent.n_freedoms()];
        self.by_each(reach, Self::flat, |field, j, z| {
            change[j] = z;
            let accelerations = field.displaced(&change);
            change[j] = T::ZERO;
            accelerations
        })
    }

    /// Returns the derivatives by z', from differences of velocities.
    fn by_speeds(&mut self, reach: T) -> Result<Slopes<T>, LinearError> {
        self.by_each(reach, |_, _, h| Ok(h), Self::hurried)
    }

    /// Returns the derivatives of the function `accelerations` by each freedom. `lengths` computes the length of a freedom's difference
    /// from the longest length.
    fn by_each(
        &mut self,
        reach: T,
        mut lengths: impl FnMut(&mut Self, usize, T) -> Result<T, LinearError>,
        mut accelerations: impl FnMut(&mut Self, usize, T) -> Result<Vec<T>, LinearError>,
    ) -> Result<Slopes<T>, LinearError> {
        let (f, n) = (self.tangent.n_freedoms(), self.model.n_signal_states());
        let [mut forces, mut signals, mut outputs] =
            [Vec::with_capacity(f * f), Vec::new(), Vec::new()];
        for j in 0..f {
            let extent = self.w.extent(self.tangent.direction(j));
            let h = lengths(self, j, reach / extent)?;
            self.shortest = self.shortest.min(h * extent);
            let slope = difference(h, |z| {
                let answer = accelerations(self, j, z)?;
                self.with_the_rest(answer)
            })?;
            forces.extend(slope[..f].iter().map(|&x| -x));
            signals.extend_from_slice(&slope[f..f + n]);
            outputs.extend_from_slice(&slope[f + n..]);
        }
        Ok(Slopes { forces, signals, outputs })
    }

    /// Returns the outputs at the last evaluated state; empty where no outputs are measured.
    fn measured(&mut self) -> Result<Vec<T>, LinearError> {
        let motion = [&self.q[..], &self.v, &self.a, &self.lambda];
        let at = (self.model, &self.w.terms);
        self.watch.as_mut().map_or(Ok(Vec::new()), |watch| watch.outputs(at, motion))
    }

    /// Appends two results of the last evaluation to the accelerations: the rates of the states of signals, and the outputs.
    pub(crate) fn with_the_rest(&mut self, mut answer: Vec<T>) -> Result<Vec<T>, LinearError> {
        answer.extend(self.signal_rates());
        answer.extend(self.measured()?);
        Ok(answer)
    }

    /// Returns the rounding error to be expected in a stiffness that is computed from differences [1/s^2].
    pub(crate) fn noise(&self, stiffness: &[T]) -> T {
        T::EPSILON * T::from_f64(NOISE) * (norm_inf(stiffness) + self.lively / self.shortest)
    }

    /// Returns a length for the difference of a freedom, at most `h`. Within that length the constraints are nearly flat.
    fn flat(&mut self, freedom: usize, mut h: T) -> Result<T, LinearError> {
        let reach = h * self.w.extent(self.tangent.direction(freedom));
        let flat = (reach * T::from_f64(FLAT)).min(T::from_f64(CURVED));
        let mut last = None;
        let mut change = vec![T::ZERO; self.tangent.n_freedoms()];
        for _ in 0..LENGTHS {
            change[freedom] = T::TWO * h;
            let [way, bend, _] = self.shifted(&change)?;
            let bend = bend / way;
            if bend <= flat {
                return Ok(h);
            }
            if last.is_some_and(|last| bend > last * T::HALF) {
                break;
            }
            last = Some(bend);
            h *= (flat / bend * T::HALF).max(T::from_f64(SHORTER));
        }
        Err(LinearError::Singular { freedom })
    }

    /// Returns z'' at the position of the state, with the velocity `v`.
    pub(crate) fn at_rest_of(&mut self, v: &[T]) -> Result<Vec<T>, LinearError> {
        self.v.copy_from_slice(v);
        self.acceleration()
    }

    /// Returns to the position `q` and factors there, for differences of velocities.
    pub(crate) fn return_to(&mut self, q: &[T]) -> Result<(), LinearError> {
        self.q.copy_from_slice(q);
        self.close()?;
        self.factor()
    }

    /// Returns z'' at the position and the velocity of the state.
    pub(crate) fn acceleration_at_start(&mut self) -> Result<Vec<T>, LinearError> {
        let v = self.start.v.clone();
        self.at_rest_of(&v)
    }

    /// Returns how far a change of z moves coordinates, relative to their sizes [-].
    pub(crate) fn extent(&self, change: &[T]) -> T {
        let mut way = vec![T::ZERO; self.w.n];
        for (j, &z) in change.iter().enumerate() {
            way.iter_mut().zip(self.tangent.direction(j)).for_each(|(way, &b)| *way += b * z);
        }
        self.w.extent(&way)
    }

    /// Changes z and closes the constraints. Returns three lengths relative to the sizes of coordinates: the total displacement, the
    /// displacement that closes the constraints, and its rounding error.
    fn shifted(&mut self, change: &[T]) -> Result<[T; 3], LinearError> {
        self.q.copy_from_slice(&self.start.q);
        for (j, &z) in change.iter().enumerate() {
            for (q, &b) in self.q.iter_mut().zip(self.tangent.direction(j)) {
                *q += b * z;
            }
        }
        let n = self.w.n;
        let open = self.q.clone();
        self.close()?;
        let extent = |from: &[T]| {
            let way: Vec<T> = self.q[..n].iter().zip(from).map(|(&q, &from)| q - from).collect();
            self.w.extent(&way)
        };
        let rounding = (T::ONE + self.w.extent(&self.q[..n])) * T::EPSILON;
        Ok([extent(&self.start.q), extent(&open), rounding * T::from_f64(ROUNDED)])
    }

    /// Returns z'' after a change of z.
    pub(crate) fn displaced(&mut self, change: &[T]) -> Result<Vec<T>, LinearError> {
        let [way, bend, least] = self.shifted(change)?;
        self.v.copy_from_slice(&self.start.v);
        // The displacement that closes the constraints is of second order in z, unless a row is close to dependence.
        if bend > least + way * T::from_f64(CURVED) {
            let freedom = change.iter().position(|&z| z != T::ZERO).unwrap_or(0);
            return Err(LinearError::Singular { freedom });
        }
        self.factor()?;
        self.acceleration()
    }

    /// Returns z'' after a change of one z'.
    fn hurried(&mut self, freedom: usize, z: T) -> Result<Vec<T>, LinearError> {
        self.v.copy_from_slice(&self.start.v);
        for (v, &b) in self.v.iter_mut().zip(self.tangent.direction(freedom)) {
            *v += b * z;
        }
        self.acceleration()
    }

    /// Moves `q` onto the constraints without a change of z; the terms are then evaluated at `q`.
    pub(crate) fn close(&mut self) -> Result<(), LinearError> {
        let n = self.w.n;
        let floor = (T::ONE + self.w.extent(&self.q[..n])) * T::EPSILON;
        let (mut last, mut stalls) = (None, 0);
        for _ in 0..SWEEPS {
            self.model.evaluate(&self.q, &mut self.w.terms);
            let violation = self.w.openness(&self.w.terms.phi);
            let is_stalled = last.is_some_and(|last| violation > last * T::HALF);
            stalls = if is_stalled { stalls + 1 } else { 0 };
            // The last sweep may be one without progress. One sweep makes direction vectors unit vectors. After it, the height of a large
            // wheel still has the error of their length.
            let is_last = violation <= floor * T::from_f64(STALLED) || stalls > 1;
            if is_stalled && is_last || violation == T::ZERO {
                break;
            }
            last = Some(violation);
            self.tangent.correct(&self.w.terms.phi, &mut self.q[..n]);
        }
        self.model.evaluate(&self.q, &mut self.w.terms);
        if self.w.openness(&self.w.terms.phi) <= floor * T::from_f64(STALLED) {
            return Ok(());
        }
        let violation = norm_inf(&self.w.terms.phi);
        Err(LinearError::NotClosed { violation: violation.to_f64() })
    }

    pub(crate) fn factor(&mut self) -> Result<(), LinearError> {
        let result = self.w.factor(self.model, T::ZERO, (&[], &[]));
        result.map_err(|error| LinearError::NoInertia { unknown: error.unknown })
    }

    /// Moves v onto the constraints and returns z'' at (q, v). The matrix must be factored at q.
    fn acceleration(&mut self) -> Result<Vec<T>, LinearError> {
        let (n, m) = (self.w.n, self.w.m);
        self.model.evaluate_phi_t(&self.q, &mut self.w.terms);
        let mut rates = vec![T::ZERO; m];
        let mut last = None;
        for _ in 0..SWEEPS {
            self.model.multiply_jacobian(&self.w.terms, &self.v, &mut rates);
            rates.iter_mut().zip(&self.w.terms.phi_t).for_each(|(r, &b)| *r += b);
            let violation = self.w.openness(&rates);
            if last.is_some_and(|last| violation > last * T::HALF) || violation == T::ZERO {
                break;
            }
            last = Some(violation);
            self.tangent.correct(&rates, &mut self.v[..n]);
        }
        self.model.evaluate_forces(&self.q, &self.v, &mut self.w.terms);
        self.model.evaluate_bias(&self.q, &self.v, &mut self.w.terms);
        let mut a = vec![T::ZERO; self.model.n_extended()];
        let (mut lambda, mut residual) = (vec![T::ZERO; m], vec![T::ZERO; n]);
        let (mut last, mut open, mut left) = (None, T::ZERO, T::ZERO);
        // Each correction removes the error that rounding and the regularisation of the rows left. The first correction is the answer
        // itself, and it is small near an equilibrium. Forces on coordinates without mass act through their constraint rows alone. So the
        // second correction may be as large as the first.
        for sweep in 0..SWEEPS {
            self.w.residual(self.model, Some(&a), &lambda, &mut residual);
            self.model.multiply_jacobian(&self.w.terms, &a, &mut rates);
            for (f, &r) in self.w.f.iter_mut().zip(&residual) {
                *f = -r;
            }
            for k in 0..m {
                self.w.f[n + k] = -(rates[k] + self.w.terms.phi_bias[k]);
            }
            (open, left) = (self.w.openness(&self.w.f[n..]), norm_inf(&self.w.f[n..]));
            self.w.solve();
            let correction = self.w.extent(&self.w.f[..n]);
            if !correction.is_finite() {
                return Err(LinearError::NotFinite);
            }
            for (a, &d) in a.iter_mut().zip(&self.w.f[..n]) {
                *a += d;
            }
            for (l, &e) in lambda.iter_mut().zip(&self.w.f[n..]) {
                *l += e;
            }
            if last.is_some_and(|last| correction > last * T::HALF) || correction == T::ZERO {
                break;
            }
            last = (sweep > 0).then_some(correction);
        }
        if self.lively == T::ZERO {
            self.w.residual(self.model, Some(&a), &lambda, &mut residual);
            self.lively = self.w.liveliness(self.model);
        }
        // A large rounding error is allowed in a coordinate that has hardly any inertia. A row that remains violated is an error.
        if !(open <= self.lively.max(self.w.extent(&a[..n])) * T::EPSILON.sqrt()) {
            return Err(LinearError::NotSettled { left: left.to_f64() });
        }
        let answer = self.tangent.reduce(&a[..n]);
        (self.a, self.lambda) = (a, lambda);
        Ok(answer)
    }
}

//! Linearisation of the equations of motion in independent coordinates about a state.
//!
//! ```text
//! z'' = f(z, z'):   q(z) on the constraints, q'(z, z') with J q' + phi_t = 0,  M q'' + J^T lambda = Q,  J q'' + bias = 0
//! K_r = -df/dz,   C_r = -df/dz'         (inertia 1, see `chart`)
//! d/dt (z, z') = A (z, z') + ...,   A = [[0, 1], [-K_r, -C_r]]
//! ```
//!
//! Derivatives are central differences of fourth order of the equations of motion themselves, not of the tangent that the
//! effects offer to implicit steps: those may be symmetrised or clipped, and a stiffness through multipliers alone, as a
//! pendulum's, comes by itself.
//!
//! About a state at rest in equilibrium, and about a uniform translation (a vehicle that drives straight), A is constant and
//! its eigenvalues belong to the mechanism. Where bodies turn, A changes along the motion and depends on the choice of z:
//! [`Linear::turning`] tells.

use crate::chart::Chart;
use crate::error::LinearError;
use crate::options::LinearOptions;
use crate::workspace::Workspace;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::algebra::norm_inf;
use mbs_core::model::{Load, Model, State};
use mbs_core::{Real, SymmetricSolver};

/// What guides and courses do meanwhile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Instant {
    /// Guides are held at their values of that time: rates and accelerations are zero, as in an equilibrium.
    Rest,
    /// Guides move as they do at that time.
    Motion,
}

/// Equations of motion linearised about a state, z'' + C_r z' + K_r z = f; matrices are stored column by column.
#[derive(Debug, Clone, PartialEq)]
pub struct Linear<T> {
    /// Freedoms f.
    pub n_freedoms: usize,
    /// -dz''/dz [1/s^2], f x f.
    pub stiffness: Vec<T>,
    /// -dz''/dz' [1/s], f x f.
    pub damping: Vec<T>,
    /// dq/dz, n x f, with B^T M B = 1.
    pub basis: Vec<T>,
    /// z'' at the state: zero in an equilibrium.
    pub acceleration: Vec<T>,
    /// Largest acceleration that the constraints ask for because bodies turn [m/s^2]: zero at rest and in translation.
    ///
    /// Where it is not, the coefficients change along the motion, and eigenvalues hold for an instant and for these z alone.
    pub turning: T,
    /// Rounding to be expected in `stiffness` [1/s^2]: eigenvalues whose square is of this size are zero.
    pub noise: T,
}

impl<T: Real> Linear<T> {
    /// A of d/dt (z, z') = A (z, z'), 2f x 2f, column by column.
    #[must_use]
    pub fn state_matrix(&self) -> Vec<T> {
        let f = self.n_freedoms;
        let mut a = vec![T::ZERO; 4 * f * f];
        for j in 0..f {
            a[(f + j) * 2 * f + j] = T::ONE;
            for i in 0..f {
                a[j * 2 * f + f + i] = -self.stiffness[j * f + i];
                a[(f + j) * 2 * f + f + i] = -self.damping[j * f + i];
            }
        }
        a
    }
}

/// Sweeps that close constraints next to the state.
const SWEEPS: u32 = 60;
/// Closing the constraints moves by this share of a difference at most: the curvature of the constraints takes some 1e-4.
const CURVED: f64 = 0.1;

/// Linearises about the consistent state `s` of a scene of the given `length` [m]. Time and measured angles stand still.
///
/// At a kink of a force (a contact that begins, a damper with two branches at rest) the mean of both sides is given.
///
/// Cost: 4 f + 1 factorisations and 8 f evaluations for f freedoms, and n^3 operations for the dense split; allocates.
///
/// # Errors
/// [`LinearError`] when the state is not closed, stands next to a singular position, or lacks inertia.
pub fn linearise<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    length: T,
    (instant, options): (Instant, &LinearOptions<T>),
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<Linear<T>, LinearError> {
    options.validate()?;
    model.set_inputs(s.t, &mut w.terms);
    if instant == Instant::Rest {
        for guide in &mut w.terms.guides {
            *guide = [guide[0], T::ZERO, T::ZERO];
        }
    }
    let mut field = Field::new(model, length, s, w)?;
    let f = field.chart.n_freedoms();
    let acceleration = field.at_rest_of(&s.v)?;
    let turning = norm_inf(&field.w.terms.phi_bias);
    let reach = options.step * length;
    let (mut stiffness, mut damping) = (Vec::new(), Vec::new());
    for j in 0..f {
        let size = norm_inf(field.chart.direction(j));
        let h = reach / size;
        let slope = difference(h, |z| field.displaced(j, z))?;
        stiffness.extend(slope.into_iter().map(|x| -x));
    }
    field.return_to(s)?;
    for j in 0..f {
        let h = reach / norm_inf(field.chart.direction(j));
        let slope = difference(h, |z| field.hurried(j, z))?;
        damping.extend(slope.into_iter().map(|x| -x));
    }
    let noise = T::EPSILON * T::from_f64(16.0) * (norm_inf(&stiffness) + field.lively / reach);
    let basis = field.chart.basis;
    Ok(Linear { n_freedoms: f, stiffness, damping, basis, acceleration, turning, noise })
}

/// (8 (f(h) - f(-h)) - (f(2h) - f(-2h))) / 12 h
fn difference<T: Real>(
    h: T,
    mut f: impl FnMut(T) -> Result<Vec<T>, LinearError>,
) -> Result<Vec<T>, LinearError> {
    let (two, eight, twelve) = (T::TWO, T::from_f64(8.0), T::from_f64(12.0));
    let [a, b, c, d] = [f(h)?, f(-h)?, f(two * h)?, f(-two * h)?];
    let slope = |i: usize| (eight * (a[i] - b[i]) - (c[i] - d[i])) / (twelve * h);
    Ok((0..a.len()).map(slope).collect())
}

/// z'' as a function of z and z'.
struct Field<'a, T, M, S> {
    model: &'a M,
    w: &'a mut Workspace<T, S>,
    length: T,
    start: &'a State<T>,
    chart: Chart<T>,
    /// Position and velocity at hand, extended.
    q: Vec<T>,
    v: Vec<T>,
    /// Largest acceleration that a force would give alone [m/s^2].
    lively: T,
}

impl<'a, T: Real, M: Model<T>, S: SymmetricSolver<T>> Field<'a, T, M, S> {
    fn new(
        model: &'a M,
        length: T,
        s: &'a State<T>,
        w: &'a mut Workspace<T, S>,
    ) -> Result<Self, LinearError> {
        let n = w.n;
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
        let chart = Chart::new(n, jacobian, |x| {
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
        let chart = chart.map_err(|unknown| LinearError::NoInertia {
            unknown: u32::try_from(unknown).unwrap_or(u32::MAX),
        })?;
        let (q, v) = (s.q.clone(), s.v.clone());
        let mut field = Self { model, w, length, start: s, chart, q, v, lively: T::ZERO };
        field.close()?;
        field.factor()?;
        Ok(field)
    }

    /// z'' at the state itself, with the velocity `v`.
    fn at_rest_of(&mut self, v: &[T]) -> Result<Vec<T>, LinearError> {
        self.v.copy_from_slice(v);
        self.acceleration()
    }

    /// Back to the position of the state, for velocities to be changed there.
    fn return_to(&mut self, s: &State<T>) -> Result<(), LinearError> {
        self.q.copy_from_slice(&s.q);
        self.close()?;
        self.factor()
    }

    /// z'' with one z changed.
    fn displaced(&mut self, freedom: usize, z: T) -> Result<Vec<T>, LinearError> {
        self.q.copy_from_slice(&self.start.q);
        self.v.copy_from_slice(&self.start.v);
        for (q, &b) in self.q.iter_mut().zip(self.chart.direction(freedom)) {
            *q += b * z;
        }
        let open = self.q.clone();
        self.close()?;
        // Of second order in z, unless a row is next to being dependent.
        let moved = self.q.iter().zip(&open).fold(T::ZERO, |m, (&a, &b)| m.max((a - b).abs()));
        if moved > norm_inf(self.chart.direction(freedom)) * z.abs() * T::from_f64(CURVED) {
            return Err(LinearError::Singular { freedom });
        }
        self.factor()?;
        self.acceleration()
    }

    /// z'' with one z' changed.
    fn hurried(&mut self, freedom: usize, z: T) -> Result<Vec<T>, LinearError> {
        self.v.copy_from_slice(&self.start.v);
        for (v, &b) in self.v.iter_mut().zip(self.chart.direction(freedom)) {
            *v += b * z;
        }
        self.acceleration()
    }

    /// Moves `q` onto the constraints without changing z; the terms are those of `q` then.
    fn close(&mut self) -> Result<(), LinearError> {
        let floor = (self.length + norm_inf(&self.q)) * T::EPSILON;
        let n = self.w.n;
        let mut last = None;
        for _ in 0..SWEEPS {
            self.model.evaluate(&self.q, &mut self.w.terms);
            let violation = norm_inf(&self.w.terms.phi);
            if last.is_some_and(|last| violation > last * T::HALF) || violation == T::ZERO {
                break;
            }
            last = Some(violation);
            self.chart.correct(&self.w.terms.phi, &mut self.q[..n]);
        }
        self.model.evaluate(&self.q, &mut self.w.terms);
        let violation = norm_inf(&self.w.terms.phi);
        if violation <= floor * T::from_f64(1e3) {
            return Ok(());
        }
        Err(LinearError::NotClosed { violation: violation.to_f64() })
    }

    fn factor(&mut self) -> Result<(), LinearError> {
        let result = self.w.factor(self.model, T::ZERO, &[]);
        result.map_err(|error| LinearError::NoInertia { unknown: error.unknown })
    }

    /// z'' at (q, v), v moved onto the constraints first; the matrix is factored at q.
    fn acceleration(&mut self) -> Result<Vec<T>, LinearError> {
        let (n, m) = (self.w.n, self.w.m);
        let terms = &mut self.w.terms;
        self.model.evaluate_phi_t(&self.q, terms);
        let mut rates = vec![T::ZERO; m];
        let mut last = None;
        for _ in 0..SWEEPS {
            self.model.multiply_jacobian(terms, &self.v, &mut rates);
            rates.iter_mut().zip(&terms.phi_t).for_each(|(r, &b)| *r += b);
            let violation = norm_inf(&rates);
            if last.is_some_and(|last| violation > last * T::HALF) || violation == T::ZERO {
                break;
            }
            last = Some(violation);
            self.chart.correct(&rates, &mut self.v[..n]);
        }
        self.model.evaluate_forces(&self.q, &self.v, &self.start.memory, terms);
        self.model.evaluate_bias(&self.q, &self.v, terms);
        let mut a = vec![T::ZERO; self.model.n_extended()];
        let (mut lambda, mut residual) = (vec![T::ZERO; m], vec![T::ZERO; n]);
        let (mut last, mut open) = (None, T::ZERO);
        // Corrections: each removes what rounding and the regularisation of the rows left.
        for _ in 0..SWEEPS {
            self.w.residual(self.model, Some(&a), &lambda, &mut residual);
            self.model.multiply_jacobian(&self.w.terms, &a, &mut rates);
            for (f, &r) in self.w.f.iter_mut().zip(&residual) {
                *f = -r;
            }
            for k in 0..m {
                self.w.f[n + k] = -(rates[k] + self.w.terms.phi_bias[k]);
            }
            open = norm_inf(&self.w.f[n..]);
            self.w.solve();
            let correction = norm_inf(&self.w.f[..n]);
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
            last = Some(correction);
        }
        if self.lively == T::ZERO {
            self.w.residual(self.model, Some(&a), &lambda, &mut residual);
            self.lively = self.w.liveliness(self.model);
        }
        // What rounding leaves of a coordinate with hardly any inertia is no fault; rows that stay open are.
        if !(open <= self.lively.max(norm_inf(&a)) * T::EPSILON.sqrt()) {
            return Err(LinearError::NotSettled { left: open.to_f64() });
        }
        Ok(self.chart.reduce(&a[..n]))
    }
}

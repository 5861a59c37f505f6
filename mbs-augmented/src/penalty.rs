//! The penalties of a step: proportional to effective masses, and raised where a combination of constraints is weakly determined.
//!
//! ```text
//! s_k = c m_k,      m_k = 1 / (J M^-1 J^T)_kk
//! u <- (1 + s H)^-1 u = u - s J T^-1 J^T u,      H = J M^-1 J^T,      rho = |u_new| / |u|
//! ```

use crate::equations::Equations;
use crate::options::Penalty;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::model::{Model, Terms};
use mbs_core::team::{Team, add, norm_inf, on_stretches, sum};
use mbs_core::{FactorError, Real, SpdSolver};

/// Largest contraction of the weakest combination of constraints: the fraction of its multiplier that one correction leaves [-]. Two
/// corrections then leave 1e-5 of an extrapolated multiplier, which is below the truncation error of the rule.
const MAX_CONTRACTION: f64 = 0.003;
/// Contraction up to which a combination counts as well determined [-]. It is a third of the largest one, so that a search for other
/// combinations begins in time.
const WELL_DETERMINED: f64 = 0.001;
/// Contraction below which raised penalties fall again, relative to `MAX_CONTRACTION` [-]. The distance of a factor of ten prevents that
/// they are raised again at once.
const FALLING: f64 = 0.1;
/// Factor on raised penalties in each step in which they may fall [-]. A penalty factor of 1e8 falls to one in fourteen steps.
const FALL: f64 = 0.25;
/// Largest penalty, times EPSILON [effective masses]. Above it, the rounding errors of T^-1 look like a lost direction.
const MAX_PENALTY: f64 = 0.2;
/// Factor on penalties that were too small for a step [-], a power of two. On a logarithmic scale it is midway between the penalties of
/// regular motion and the largest ones. Friction that holds arms of parts without mass needs a factor of 100 or more. An arm of light
/// rotors in a singular position needs 10,000.
const STRENGTHENED: f64 = 16_384.0;
/// Smallest factor by which one trial lowers penalties, after T was not positive definite [-]. It is four binary digits.
const LOWERING: f64 = 1.0 / 16.0;

/// The penalties of a step.
#[derive(Debug, Clone)]
pub(crate) struct PenaltyScale<T> {
    /// Penalty s of each row [kg].
    pub(crate) weights: Vec<T>,
    /// Effective mass m_k of each row in the reference configuration [kg].
    masses: Vec<T>,
    /// Penalty c from the options, or one for a fixed alpha [effective masses].
    base: T,
    /// Factor on the penalty, adapted from step to step [-].
    pub(crate) factor: T,
    /// Factor on the penalty after a step has failed; 1 if none has failed [-].
    pub(crate) strength: T,
}

impl<T: Real> PenaltyScale<T> {
    /// Creates the penalties for `model`, whose `terms` are those of the reference configuration.
    pub(crate) fn new(model: &impl Model<T>, terms: &Terms<T>) -> Self {
        let mut masses = vec![T::ZERO; model.n_constraints()];
        model.effective_masses(terms, &mut masses);
        let (weights, base, factor, strength) = (masses.clone(), T::ONE, T::ONE, T::ONE);
        Self { weights, masses, base, factor, strength }
    }

    /// Sets the penalties at the start of a step: scaled ones times `factor`, a fixed alpha times `unit`.
    pub(crate) fn begin<M: Model<T>>(
        &mut self,
        model: &M,
        (penalty, unit, factor): (Penalty<T>, T, T),
    ) {
        let strength = self.strength;
        (self.base, self.factor) = (penalty.factor() * strength, factor);
        let masses = &self.masses;
        on_stretches(model.team(), [&mut self.weights], |first, [weights]| {
            for (weight, &mass) in weights.iter_mut().zip(&masses[first..]) {
                *weight = match penalty {
                    Penalty::Scaled(c) => c * strength * factor * mass,
                    Penalty::Fixed(alpha) => alpha * unit,
                };
            }
        });
    }

    /// Returns the energy of the penalties, 1/2 x^T s x [P2 (29)].
    pub(crate) fn energy<W: Team>(&self, team: &W, x: &[T]) -> T {
        let part = |from: usize, to: usize| {
            let pairs = x[from..to].iter().zip(&self.weights[from..to]);
            pairs.fold(T::ZERO, |sum, (&x, &s)| sum + s * x * x)
        };
        sum(team, x.len(), part) * T::HALF
    }

    /// Multiplies all penalties by a factor.
    pub(crate) fn scale(&mut self, by: T) {
        self.weights.iter_mut().for_each(|s| *s *= by);
        self.factor *= by;
    }

    /// Multiplies the penalties of the rows that constrain velocities.
    pub(crate) fn scale_velocity_rows(&mut self, model: &impl Model<T>, by: T) {
        let rows = self.weights.iter_mut().enumerate();
        rows.filter(|(row, _)| model.is_velocity_row(*row)).for_each(|(_, s)| *s *= by);
    }

    /// Makes the scaled penalties larger for the following steps, because they were too small for a step. Returns false if they were
    /// already larger.
    pub(crate) fn strengthen(&mut self) -> bool {
        let was_strengthened = self.strength > T::ONE;
        self.strength = T::from_f64(STRENGTHENED);
        !was_strengthened
    }

    /// Resets raised penalties to those of the options. Returns whether any were raised.
    pub(crate) fn restore(&mut self) -> bool {
        let was_raised = self.factor > T::ONE;
        if was_raised {
            self.scale(T::ONE / self.factor);
        }
        was_raised
    }

    /// Returns the factor by which penalties may still be raised.
    fn room(&self) -> T {
        T::from_f64(MAX_PENALTY) / T::EPSILON / (self.factor * self.base)
    }

    /// Raises the penalties by the factor rho / (1 - rho) / [`MAX_CONTRACTION`], where rho is `contraction`. A correction then leaves the
    /// largest allowed fraction. The largest allowed penalty limits the factor. Returns whether the penalties changed.
    pub(crate) fn raise(&mut self, contraction: T) -> bool {
        let rho = contraction.min(T::ONE);
        let growth = rho / (T::ONE - rho).max(T::EPSILON) / T::from_f64(MAX_CONTRACTION);
        let growth = growth.min(self.room());
        if growth > T::ONE {
            self.scale(growth);
        }
        growth > T::ONE
    }

    /// Factors W = M + J^T s J. Raised penalties may be so large that the mass is lost to rounding in this sum. They are then lowered until
    /// W is positive definite.
    pub(crate) fn factor<M: Model<T>, S: SpdSolver<T>>(
        &mut self,
        model: &M,
        equations: &mut Equations<T, S>,
    ) -> Result<(), FactorError> {
        loop {
            match equations.factor_mass(model, &self.weights) {
                Err(_) if self.factor > T::ONE => {
                    self.scale((T::ONE / self.factor).max(T::from_f64(LOWERING)));
                }
                result => return result,
            }
        }
    }
}

/// Estimate of the weakest combination of constraints. Each step continues the iteration of the last step.
#[derive(Debug, Clone)]
pub(crate) struct PenaltyAdaptation<T> {
    /// Weakest combination u, of which a correction leaves the largest fraction; one weight for each row.
    pub(crate) weakest_combination: Vec<T>,
    /// Fraction rho of the weakest combination that one correction left in the last step [-].
    pub(crate) contraction: T,
    /// Fixed combination of all rows. It is added to a well-determined u so that the iteration can find any other combination.
    probe_seed: Vec<T>,
}

impl<T: Real> PenaltyAdaptation<T> {
    /// Starts from a combination of all `m` rows.
    pub(crate) fn new(m: usize) -> Self {
        Self {
            weakest_combination: vec![T::ONE; m],
            contraction: T::ZERO,
            probe_seed: probe_seed(m),
        }
    }

    /// Returns the penalty factor at the start of a step. A raised factor falls if all combinations were well determined in the last step.
    pub(crate) fn carried(&self, factor: T) -> T {
        let is_falling = self.contraction < T::from_f64(FALLING * MAX_CONTRACTION);
        if is_falling { (factor * T::from_f64(FALL)).max(T::ONE) } else { factor }
    }

    /// True if penalties are not raised, and one correction leaves little of every combination of multipliers.
    pub(crate) fn is_well_conditioned(&self, scale: &PenaltyScale<T>) -> bool {
        scale.factor <= T::ONE && self.contraction <= T::from_f64(WELL_DETERMINED)
    }

    /// Makes one power iteration for the weakest combination u of constraints, starting from that of the last step. If u is well
    /// determined, a small multiple of a combination of all rows is first added to u, so that other combinations can be found.
    ///
    /// Raises the penalties until a correction leaves at most [`MAX_CONTRACTION`] of u. In two cases they are not raised. First, a combination
    /// that no allowed penalty determines is redundant. Second, if the model has rows of velocities, a redundant combination looks
    /// weak rather than redundant at predicted positions.
    ///
    /// Returns whether the penalties changed, so that T must be factored anew. Needs T factored. Cost: one solve.
    pub(crate) fn adapt_penalty<M: Model<T>, S: SpdSolver<T>>(
        &mut self,
        model: &M,
        equations: &mut Equations<T, S>,
        scale: &mut PenaltyScale<T>,
    ) -> bool {
        let u = &mut self.weakest_combination;
        let size = norm_inf(model.team(), u);
        if size > T::ZERO {
            let inverse = T::ONE / size;
            u.iter_mut().for_each(|u| *u *= inverse);
        }
        if !(self.contraction > T::from_f64(WELL_DETERMINED)) {
            add(model.team(), u, &self.probe_seed);
        }
        let size = norm_inf(model.team(), u);
        // u <- u - s J T^-1 J^T u
        equations.mu.copy_from_slice(u);
        equations.assemble(model, None, T::ZERO);
        equations.solve();
        equations.multiply_correction(model);
        let (weights, mu) = (&scale.weights, &equations.mu);
        on_stretches(model.team(), [&mut u[..]], |first, [u]| {
            for k in 0..u.len() {
                u[k] -= weights[first + k] * mu[first + k];
            }
        });
        let rho = norm_inf(model.team(), u) / size;
        self.contraction = rho;
        if !rho.is_finite() {
            self.contraction = T::ZERO;
            u.fill(T::ZERO);
        }
        let most = T::from_f64(MAX_CONTRACTION);
        // A combination that even the largest penalty cannot determine does not count as weak. It is redundant, or so close to a singular
        // position that its loss does no harm.
        let is_weak = rho > most && rho / (T::ONE - rho).max(T::EPSILON) < scale.room() * most;
        is_weak && !model.has_velocity_rows() && scale.raise(rho)
    }
}

/// Returns a fixed pseudo-random combination of all rows, with weights of at most one half. So no combination is orthogonal to it by
/// symmetry.
fn probe_seed<T: Real>(m: usize) -> Vec<T> {
    let mut seed = 1_u32;
    let next = |_| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        T::from_f64(f64::from(seed) / f64::from(u32::MAX) - 0.5)
    };
    (0..m).map(next).collect()
}

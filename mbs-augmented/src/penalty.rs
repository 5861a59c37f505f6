//! The penalties of a step: in proportion to effective masses, and raised where the constraints lose a direction.
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

/// Largest part that one correction may leave of the multiplier of the weakest combination of constraints [-]. Two corrections then leave
/// 1e-5 of an extrapolated multiplier, below what the rule errs by.
const MAX_CONTRACTION: f64 = 0.003;
/// Contraction up to which a combination counts as well determined [-]: a third of the largest, so that others are looked for in time.
const WELL_DETERMINED: f64 = 0.001;
/// Contraction below which raised penalties fall again, in parts of the largest [-]: a decade of room against raising them at once.
const FALLING: f64 = 0.1;
/// Factor on raised penalties in each step in which they may fall [-]: back from 1e8 in fourteen steps.
const FALL: f64 = 0.25;
/// Largest penalty, times EPSILON [effective masses]: above, rounding of T^-1 looks like a lost direction.
const MAX_PENALTY: f64 = 0.2;
/// Factor on penalties that were too small for a step [-]. The middle, in digits, between those of regular motion and the largest: arms of
/// parts without mass that friction holds take 100 times or more, an arm of light rotors in a singular position 10,000 times. A power of two.
const STRENGTHENED: f64 = 16_384.0;
/// Least factor on penalties that are lowered after T was not positive definite [-]: four binary digits at a time.
const LOWERING: f64 = 1.0 / 16.0;

/// The penalties of a step.
#[derive(Debug, Clone)]
pub(crate) struct PenaltyScale<T> {
    /// s of each row [kg], m.
    pub(crate) weights: Vec<T>,
    /// Effective mass m_k of each row in the reference configuration [kg], m.
    masses: Vec<T>,
    /// c as the options have it, or one for a fixed alpha [effective masses].
    base: T,
    /// Factor on it, as it has adapted [-].
    pub(crate) factor: T,
    /// Factor on it since a step failed, else one [-].
    pub(crate) strength: T,
}

impl<T: Real> PenaltyScale<T> {
    /// For `model`, whose `terms` are those of the reference configuration.
    pub(crate) fn new(model: &impl Model<T>, terms: &Terms<T>) -> Self {
        let mut masses = vec![T::ZERO; model.n_constraints()];
        model.effective_masses(terms, &mut masses);
        let (weights, base, factor, strength) = (masses.clone(), T::ONE, T::ONE, T::ONE);
        Self { weights, masses, base, factor, strength }
    }

    /// The penalties that a step begins with, raised by `factor`; a fixed alpha times `unit`.
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

    /// 1/2 x^T s x [P2 (29)].
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

    /// Multiplies the penalties of rows of velocities.
    pub(crate) fn scale_velocity_rows(&mut self, model: &impl Model<T>, by: T) {
        let rows = self.weights.iter_mut().enumerate();
        rows.filter(|(row, _)| model.is_velocity_row(*row)).for_each(|(_, s)| *s *= by);
    }

    /// Penalties were too small for a step: those in proportion to masses are larger from now on. Returns whether they were not before.
    pub(crate) fn strengthen(&mut self) -> bool {
        let was_strengthened = self.strength > T::ONE;
        self.strength = T::from_f64(STRENGTHENED);
        !was_strengthened
    }

    /// Takes raised penalties back; returns whether there were any.
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

    /// Raises the penalties so that what leaves `contraction` leaves the largest one allowed, by rho / (1 - rho) / [`MAX_CONTRACTION`], as
    /// far as there is room. Returns whether they changed.
    pub(crate) fn raise(&mut self, contraction: T) -> bool {
        let rho = contraction.min(T::ONE);
        let growth = rho / (T::ONE - rho).max(T::EPSILON) / T::from_f64(MAX_CONTRACTION);
        let growth = growth.min(self.room());
        if growth > T::ONE {
            self.scale(growth);
        }
        growth > T::ONE
    }

    /// Factors W = M + J^T s J, whose penalties may have been raised. Where they are too large for the digits there are, so that the mass is
    /// lost beside them, they are lowered until W is positive definite.
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

/// Follows the weakest combination of constraints from step to step.
#[derive(Debug, Clone)]
pub(crate) struct PenaltyAdaptation<T> {
    /// Weakest combination u, of which one correction leaves most, m.
    pub(crate) weakest_combination: Vec<T>,
    /// Part rho of the weakest combination that one correction left in the last step [-].
    pub(crate) contraction: T,
    /// Combination of all rows that is added to the weakest one where that is well determined, so that no combination stays out of sight, m.
    probe_seed: Vec<T>,
}

impl<T: Real> PenaltyAdaptation<T> {
    /// Begins with a combination of all `m` rows.
    pub(crate) fn new(m: usize) -> Self {
        Self {
            weakest_combination: vec![T::ONE; m],
            contraction: T::ZERO,
            probe_seed: probe_seed(m),
        }
    }

    /// Returns the factor that a step begins with: a raised factor falls where the last step determined all combinations well.
    pub(crate) fn carried(&self, factor: T) -> T {
        let is_falling = self.contraction < T::from_f64(FALLING * MAX_CONTRACTION);
        if is_falling { (factor * T::from_f64(FALL)).max(T::ONE) } else { factor }
    }

    /// Are all combinations of multipliers well determined, by penalties that are not raised?
    pub(crate) fn is_well_conditioned(&self, scale: &PenaltyScale<T>) -> bool {
        scale.factor <= T::ONE && self.contraction <= T::from_f64(WELL_DETERMINED)
    }

    /// Makes one power iteration for the weakest combination u of constraints, from the last step's, or where that is well determined from
    /// it and a part of all. Raises the penalties until a correction leaves at most [`MAX_CONTRACTION`] of it, unless there are rows of
    /// velocities: at predicted positions these look weak where they are lost. A combination that no allowed penalty determines is
    /// redundant and left.
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
        // What even the largest penalty cannot determine is redundant, or so near a singular position that nothing is lost.
        let is_weak = rho > most && rho / (T::ONE - rho).max(T::EPSILON) < scale.room() * most;
        is_weak && !model.has_velocity_rows() && scale.raise(rho)
    }
}

/// A part of all combinations, up to a half of each row, always the same: none is out of sight by symmetry.
fn probe_seed<T: Real>(m: usize) -> Vec<T> {
    let mut seed = 1_u32;
    let next = |_| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        T::from_f64(f64::from(seed) / f64::from(u32::MAX) - 0.5)
    };
    (0..m).map(next).collect()
}

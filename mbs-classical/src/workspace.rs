//! Workspace of a step, made once: the saddle system, its factor, and the diagnosis of failed factorisations.

use crate::options::Options;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::implicit::{Newton, StepEnd, StepScratch, commit};
use mbs_core::integrator::{Integrator, Rule};
use mbs_core::model::{Load, Model, Owner, State, Tangent, Terms};
use mbs_core::saddle::{Saddle, SaddleSystem};
use mbs_core::step::{Counts, OptionError, StepError, StepReport, Stop, largest};
use mbs_core::team::{norm_inf, on_elements, subtract};
use mbs_core::{FactorError, Real, SymmetricSolver};

/// Workspace of the classical steps over a solver `S`. After [`Workspace::new`] only the solver may allocate, if it delays more pivots than
/// in all earlier factorisations.
#[derive(Debug, Clone)]
pub struct Workspace<T, S> {
    solver: S,
    saddle: Saddle,
    pub(crate) terms: Terms<T>,
    /// Jacobian rows of all elements.
    jacobian: Vec<T>,
    /// The end of the step. The stored accelerations are a/a' in index-3 and a in index-1.
    pub(crate) end: StepEnd<T>,
    /// Sum of the corrections of a projection, x - x*; an extended vector, which includes known coordinates.
    pub(crate) change: Vec<T>,
    /// Right-hand side, then correction: n coordinates, then m multipliers.
    pub(crate) f: Vec<T>,
    scratch: Vec<T>,
    /// Null vector of the matrix for its weakest pivot: n coordinates, then m multipliers.
    null: Vec<T>,
    /// Multipliers, one for each row: lambda / a' in index-3, lambda in index-1.
    pub(crate) lambda: Vec<T>,
    pub(crate) sigma: Vec<T>,
    pub(crate) mu: Vec<T>,
    pub(crate) rates: Vec<T>,
    /// Products J^T mu and |J|^T |mu|, one after the other.
    sums: Vec<T>,
    /// Regularisation delta of each row; empty where delta is zero.
    delta: Vec<T>,
    masses: Vec<T>,
    pub(crate) n: usize,
    pub(crate) counts: Counts,
}

/// Ratio of the weakest pivot below which a singular position may be close [-]. The ratio is defined at the option `rank`. It is
/// proportional to the square of the distance, so it falls below this value within 0.03 rad.
const MAX_PIVOT_OF_BRANCH: f64 = 1e-3;
/// Ratio |J^T mu| / (|J|^T |mu|) below which rows are nearly dependent [-]. It is zero in a singular position. It is of order one where the
/// tangent is only badly scaled, for instance by a fast spin.
const MAX_CANCELLATION: f64 = 0.1;
/// Ratio of the weakest pivot below which lost rank explains why an iteration does not converge [-]. The ratio falls below this value
/// within 0.01 rad of a singular position.
const MAX_PIVOT_OF_FAILURE: f64 = 1e-4;
/// Ratio of a row's multiplier in a null vector to the largest one, above which the row counts as dependent [-]. Rounding errors of a null
/// vector are smaller.
const MIN_PART_OF_ROW: f64 = 1e-3;
/// Factor on a correction in its comparison with the distance of two branches [-]. A correction larger than a quarter of the distance may
/// end on either branch.
const BRANCH_DISTANCE: f64 = 4.0;

/// Vector that M multiplies in a residual.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mass {
    None,
    Acceleration,
    Change,
}

impl<T: Real, S: SymmetricSolver<T>> Workspace<T, S> {
    /// Creates a workspace for `model`, with a solver analysed for its [`Saddle`].
    pub fn new(model: &impl Model<T>, solver: S) -> Self {
        let (n, e, m) = (model.n_unknowns(), model.n_extended(), model.n_constraints());
        let zeros = |k| vec![T::ZERO; k];
        let saddle = Saddle::new(model);
        let mut terms = model.terms();
        let start = State::at_rest(model);
        model.set_inputs(start.t, &start, &mut terms);
        model.evaluate(&start.q, &mut terms);
        let mut masses = zeros(m);
        model.effective_masses(&terms, &mut masses);
        let mut this = Self {
            jacobian: zeros(saddle.n_jacobian()),
            scratch: zeros(solver.n_scratch()),
            solver,
            saddle,
            terms,
            end: StepEnd::new(model),
            change: zeros(e),
            f: zeros(n + m),
            sums: zeros(2 * n),
            null: zeros(n + m),
            lambda: zeros(m),
            sigma: zeros(m),
            mu: zeros(m),
            rates: zeros(m),
            delta: Vec::with_capacity(m),
            masses,
            n,
            counts: Counts::default(),
        };
        // The first factorisation shows the solver how many pivots it delays, so that the solver reserves memory. Its result is not needed
        // here.
        let _ = this.factor(model, (T::ZERO, T::ZERO), false, T::ZERO);
        this
    }

    /// The terms of the model at the last evaluation.
    pub fn terms(&self) -> &Terms<T> {
        &self.terms
    }

    /// Terms of the model at the last evaluation, for a caller that restores them. The next step depends only on them and on the state.
    pub fn terms_mut(&mut self) -> &mut Terms<T> {
        &mut self.terms
    }

    /// Solver of the equations.
    pub fn solver(&self) -> &S {
        &self.solver
    }

    /// Begins a step: sets counts to zero, and delta from its option.
    pub(crate) fn begin(&mut self, regularisation: Option<T>) {
        self.counts = Counts::default();
        self.delta.clear();
        if let Some(delta) = regularisation {
            self.delta.extend(self.masses.iter().map(|&mass| delta / mass));
        }
    }

    /// Applies corrections: q += x d, v += y d, a += d, lambda += d_lambda, with (d, d_lambda) = -f.
    pub(crate) fn correct<M: Model<T>>(&mut self, model: &M, weights: (T, T)) {
        let (d, d_lambda) = self.f.split_at(self.n);
        self.end.correct(model, weights, d);
        subtract(model.team(), &mut self.lambda, d_lambda);
    }

    /// Evaluates phi and J at the present q, and forces at the present q and v.
    pub(crate) fn evaluate<M: Model<T>>(&mut self, model: &M, compensated: bool, s: &State<T>) {
        self.end.evaluate(model, compensated, s, &mut self.terms);
        self.end.evaluate_forces(model, &mut self.terms);
    }

    /// Factors the saddle matrix with the given weights of stiffness and damping. Fails if the ratio of the weakest pivot is below `rank`.
    pub(crate) fn factor<M: Model<T>>(
        &mut self,
        model: &M,
        (stiffness, damping): (T, T),
        geometric: bool,
        rank: T,
    ) -> Result<(), StepError> {
        self.counts.factorizations += 1;
        let (terms, starts) = (&self.terms, self.saddle.jacobian_starts());
        on_elements(model.team(), starts, &mut self.jacobian, |e, rows| {
            model.write_jacobian(terms, e, rows);
        });
        let geometric = geometric.then_some(&self.lambda[..]);
        let system = SaddleSystem {
            model,
            saddle: &self.saddle,
            terms: &self.terms,
            tangent: Tangent { stiffness, damping, penalty: &[], geometric },
            jacobian: &self.jacobian,
            delta: &self.delta,
            load: Load { mass: None, multipliers: None, force: T::ZERO },
            rates: &[],
        };
        let result = self.solver.factor(&system);
        let weakest = self.solver.weakest();
        match result {
            Err(error) => Err(self.diagnose(model, error)),
            Ok(()) if self.delta.is_empty() && weakest.ratio < rank.to_f64() => {
                let error = FactorError { unknown: weakest.unknown, pivot: weakest.ratio };
                match self.diagnose(model, error) {
                    lost @ StepError::RankLost { .. } => Err(lost),
                    // A coordinate almost without inertia also has a weak pivot, but no rank is lost.
                    _ => Ok(()),
                }
            }
            Ok(()) => Ok(()),
        }
    }

    /// True if W is positive definite on the motions with J x = 0.
    pub(crate) fn is_positive(&self) -> bool {
        self.solver.inertia().negative == self.lambda.len()
    }

    /// Diagnoses a weak pivot by a null vector x of the matrix. If rows depend on each other, x consists of multipliers. The error then
    /// names one of the rows, if possible a joint's row. Otherwise x consists of coordinates that nothing determines.
    fn diagnose<M: Model<T>>(&mut self, model: &M, error: FactorError) -> StepError {
        if !error.pivot.is_finite() {
            return StepError::NotFinite { unknown: error.unknown.min(self.last_coordinate()) };
        }
        self.solver.null_vector(&mut self.null, &mut self.scratch);
        if !self.has_dependent_rows(model, error.unknown) {
            let is_coordinate = (error.unknown as usize) < self.n;
            let unknown = if is_coordinate { error.unknown } else { largest(&self.null[..self.n]) };
            return StepError::Singular(FactorError { unknown, ..error });
        }
        let rows = &self.null[self.n..];
        let most = norm_inf(model.team(), rows);
        let part = |row: &usize| rows[*row].abs() > most * T::from_f64(MIN_PART_OF_ROW);
        let is_of_joint = |row: &usize| matches!(model.owner_of_row(*row), Owner::Joint(_));
        let row = (0..rows.len())
            .find(|row| part(row) && is_of_joint(row))
            .or_else(|| (error.unknown as usize).checked_sub(self.n))
            .unwrap_or_else(|| largest(rows) as usize);
        StepError::RankLost { row: u32::try_from(row).unwrap_or(u32::MAX), pivot: error.pivot }
    }

    /// True if the null vector, with a one at `unknown`, shows dependent or nearly dependent rows. A small pivot alone does not show them.
    /// Pivots are also small for a light body that carries heavy bodies, and for a coordinate that nothing determines.
    fn has_dependent_rows<M: Model<T>>(&mut self, model: &M, unknown: u32) -> bool {
        let most = norm_inf(model.team(), &self.null[self.n..]);
        let has_rows = unknown as usize >= self.n || most > T::EPSILON.sqrt();
        has_rows && !(self.cancellation(model) > T::from_f64(MAX_CANCELLATION))
    }

    /// Checks that a correction cannot change the branch. Two branches cross at a singular position. Their distance equals the distance of
    /// the mechanism from that position. The part of the correction in `f` along the direction in which the branches differ must be small
    /// relative to this distance.
    ///
    /// ```text
    /// x with T x = 0 nearly,   part = (x.d / x.x) |x|_max,   (4 part / length)^2 <= weakest pivot
    /// ```
    pub(crate) fn check_branch<M: Model<T>>(
        &mut self,
        model: &M,
        length: T,
    ) -> Result<(), StepError> {
        let weakest = self.solver.weakest();
        let ratio = T::from_f64(weakest.ratio);
        if !self.delta.is_empty() || ratio > T::from_f64(MAX_PIVOT_OF_BRANCH) {
            return Ok(());
        }
        self.solver.null_vector(&mut self.null, &mut self.scratch);
        if !self.has_dependent_rows(model, weakest.unknown) {
            return Ok(());
        }
        let (x, d) = (&self.null[..self.n], &self.f[..self.n]);
        let (mut along, mut square) = (T::ZERO, T::ZERO);
        for (&x, &d) in x.iter().zip(d) {
            along += x * d;
            square += x * x;
        }
        let part = along.abs() * norm_inf(model.team(), x) / square * T::from_f64(BRANCH_DISTANCE)
            / length;
        if square > T::ZERO && part * part > ratio {
            let error = FactorError { unknown: weakest.unknown, pivot: weakest.ratio };
            return Err(self.diagnose(model, error));
        }
        Ok(())
    }

    /// Returns the cancellation |J^T mu| / (|J|^T |mu|), each summed over the coordinates, for the multipliers mu of the null vector. It is
    /// small if rows are dependent or nearly dependent.
    fn cancellation<M: Model<T>>(&mut self, model: &M) -> T {
        let (sums, sizes) = self.sums.split_at_mut(self.n);
        sums.fill(T::ZERO);
        sizes.fill(T::ZERO);
        for e in 0..model.n_elements() {
            let clique = model.clique(e);
            let jacobian = self.jacobian[self.saddle.jacobian(e)].chunks_exact(clique.len());
            for (k, row) in model.rows(e).zip(jacobian) {
                let mu = self.null[self.n + k];
                for (&i, &j) in clique.iter().zip(row) {
                    sums[i as usize] += j * mu;
                    sizes[i as usize] += (j * mu).abs();
                }
            }
        }
        let sum = |x: &[T]| x.iter().fold(T::ZERO, |s, &x| s + x.abs());
        sum(sums) / sum(sizes).max(T::EPSILON)
    }

    /// Ends an iteration after the allowed number of corrections. The result is accepted if the last correction is small relative to the
    /// displacement of the step. Otherwise the error is lost rank close to a singular position, and no convergence elsewhere.
    pub(crate) fn exhausted<M: Model<T>>(
        &mut self,
        model: &M,
        newton: &Newton<T>,
    ) -> Result<(u32, T, Stop), StepError> {
        if newton.is_accepted() {
            return Ok(newton.ended(Stop::Tolerance));
        }
        let weakest = self.solver.weakest();
        if weakest.ratio < MAX_PIVOT_OF_FAILURE {
            let error = FactorError { unknown: weakest.unknown, pivot: weakest.ratio };
            if let lost @ StepError::RankLost { .. } = self.diagnose(model, error) {
                return Err(lost);
            }
        }
        Err(newton.failure(&self.f[..self.n]))
    }

    fn last_coordinate(&self) -> u32 {
        u32::try_from(self.n.saturating_sub(1)).unwrap_or(u32::MAX)
    }

    /// Solves in place with the factor: `f` = T^-1 (f, rates).
    pub(crate) fn solve(&mut self) {
        self.counts.solves += 1;
        self.solver.solve(&mut self.f, &mut self.scratch);
    }

    /// Assembles f = (M x + J^T mu - force Q, rates); the second part is zero unless `has_rates`.
    pub(crate) fn assemble<M: Model<T>>(
        &mut self,
        model: &M,
        mass: Mass,
        force: T,
        has_rates: bool,
    ) {
        let mass = match mass {
            Mass::None => None,
            Mass::Acceleration => Some(&self.end.a[..]),
            Mass::Change => Some(&self.change[..]),
        };
        let tangent =
            Tangent { stiffness: T::ZERO, damping: T::ZERO, penalty: &[], geometric: None };
        let system = SaddleSystem {
            model,
            saddle: &self.saddle,
            terms: &self.terms,
            tangent,
            jacobian: &self.jacobian,
            delta: &self.delta,
            load: Load { mass, multipliers: Some(&self.mu), force },
            rates: if has_rates { &self.rates } else { &[] },
        };
        self.solver.assemble(&system, &mut self.f);
    }
}

impl<T: Real, S: SymmetricSolver<T>> StepScratch<T> for Workspace<T, S> {
    fn checked(options: &Options<T>) -> Result<(&Integrator<T>, bool), OptionError> {
        options.validate()?;
        Ok((&options.integrator, options.compensated))
    }

    fn reached(&self) -> (&StepEnd<T>, &Terms<T>) {
        (&self.end, &self.terms)
    }

    fn commit<M: Model<T>>(
        &mut self,
        model: &M,
        (rule, compensated, unit): (&Rule<T>, bool, T),
        s: &mut State<T>,
    ) {
        let mu = &self.mu;
        let multipliers = (&self.lambda[..], unit, |row: usize, _| mu[row]);
        commit(model, (rule, compensated), &self.end, multipliers, &mut self.terms, s);
    }

    fn report(&mut self, newton: (u32, T, Stop), violation: [T; 3]) -> StepReport<T> {
        StepReport::of_newton(newton, self.counts, violation)
    }
}

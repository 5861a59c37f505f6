//! The three levels, one after the other.

use super::error::AssemblyError;
use super::hold::Hold;
use super::problem::{Level, Problem, Sweep};
use crate::Real;
use crate::algebra::norm_inf;
use crate::blocks::{Cliques, SpdSolver};
use crate::model::{Load, Model, Owner, State, System, Tangent, Terms};
use crate::natural::NaturalModel;
use crate::scene::Scene;
use alloc::vec;
use alloc::vec::Vec;

/// A consistent state, and what was done to get it.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembled<T> {
    /// The state: positions, velocities, accelerations and multipliers satisfy everything.
    pub state: State<T>,
    /// Largest change of a coordinate from the reference configuration [m or -].
    pub change: T,
    /// Largest residual of joints and held values before any change [m or rad].
    pub residual_before: T,
    /// Largest residuals after: position, velocity, acceleration.
    pub residual: [T; 3],
    /// Continuation stages taken.
    pub stages: u32,
}

/// Sweeps allowed at each level and stage.
const MAX_SWEEPS: u32 = 60;
/// Factor on all penalties after a slow sweep: long chains of light links hardly feel some combinations of rows.
pub(super) const RAISE: f64 = 30.0;
/// A sweep that leaves more than this share of a residual is slow.
const SLOW: f64 = 0.3;
/// Sweeps without halving the smallest residual after which positions are given up: what contradicts itself drifts away.
const PATIENCE: u32 = 10;
/// Largest held angle of one continuation stage [rad], or slide in scene lengths.
const STAGE: f64 = 0.25;

/// Assembles a scene: `make_start` analyses a solver for the start problem, `solver` is analysed for the model.
///
/// # Errors
/// [`AssemblyError`] says which joint or entry cannot be met.
pub fn assemble<T: Real, const D: usize, S: SpdSolver<T>>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    make_start: impl FnOnce(&Problem<'_, T, D>) -> S,
    solver: &mut impl SpdSolver<T>,
) -> Result<Assembled<T>, AssemblyError> {
    let mut state = State::at_rest(model);
    let problem = Problem::new(model, Hold::all(scene, model));
    let start_solver = make_start(&problem);
    let mut assembly = Assembly::new(problem, start_solver);
    let (residual_before, stages) = assembly.positions(&mut state)?;
    assembly.velocities(&mut state)?;
    let residual = [assembly.largest_position(), assembly.worst(), T::ZERO];
    let mut terms = assembly.problem.terms;
    let acceleration = accelerations(model, solver, &mut state, &mut terms)?;
    let mut reference = vec![T::ZERO; model.n_extended()];
    model.write_reference(&mut reference);
    let change = reference.iter().zip(&state.q).fold(T::ZERO, |c, (&r, &q)| c.max((q - r).abs()));
    let residual = [residual[0], residual[1], acceleration];
    Ok(Assembled { state, change, residual_before, residual, stages })
}

/// Velocities and accelerations at positions that are given, as [`assemble`] makes them: those that the scene holds, else the
/// smallest. `state.q` must meet the constraints, with guides at their values of time zero; held positions are not asked for.
/// Returns the largest residuals of position, velocity and acceleration.
///
/// # Errors
/// [`AssemblyError`] says which joint or entry cannot be met.
pub fn restart<T: Real, const D: usize, S: SpdSolver<T>>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    make_start: impl FnOnce(&Problem<'_, T, D>) -> S,
    solver: &mut impl SpdSolver<T>,
    state: &mut State<T>,
) -> Result<[T; 3], AssemblyError> {
    let problem = Problem::new(model, Hold::all(scene, model));
    let start_solver = make_start(&problem);
    let mut assembly = Assembly::new(problem, start_solver);
    assembly.drive(&state.q, T::ONE);
    assembly.problem.scale_penalties();
    let position = norm_inf(&assembly.problem.terms.phi);
    state.v.fill(T::ZERO);
    assembly.velocities(state)?;
    let velocity = assembly.worst();
    let mut terms = assembly.problem.terms;
    Ok([position, velocity, accelerations(model, solver, state, &mut terms)?])
}

struct Assembly<'a, T: Real, S, const D: usize> {
    problem: Problem<'a, T, D>,
    solver: S,
    guides: Vec<[T; 3]>,
    f: Vec<T>,
    scratch: Vec<T>,
    change: Vec<T>,
    sigma: Vec<T>,
    mu: Vec<T>,
    rates: Vec<T>,
    length: T,
}

impl<'a, T: Real, S: SpdSolver<T>, const D: usize> Assembly<'a, T, S, D> {
    fn new(mut problem: Problem<'a, T, D>, solver: S) -> Self {
        let (n, e) = (problem.n_unknowns(), problem.model.n_extended());
        let m = problem.model.n_constraints();
        let rows = m + problem.holds.len();
        let model = problem.model;
        model.set_inputs(T::ZERO, &mut problem.terms);
        let guides = problem.terms.guides.clone();
        let zeros = |k| vec![T::ZERO; k];
        Self {
            guides,
            f: zeros(n),
            scratch: zeros(solver.n_scratch()),
            solver,
            change: zeros(e),
            sigma: zeros(rows),
            mu: zeros(rows),
            rates: zeros(m),
            length: model.length(),
            problem,
        }
    }

    /// Guides at the share `tau` of their initial values, as if they had been driven there.
    fn drive(&mut self, q: &[T], tau: T) {
        for (value, full) in self.problem.terms.guides.iter_mut().zip(&self.guides) {
            *value = [full[0] * tau, full[1], full[2]];
        }
        self.problem.evaluate(q, tau);
    }

    fn stages(&self) -> u32 {
        let holds = self.problem.holds.iter().map(|h| h.distance(self.length));
        let guides = self.guides.iter().map(|g| g[0].abs());
        let far = holds.chain(guides).fold(T::ZERO, T::max).to_f64() / STAGE;
        let mut stages = 1;
        while f64::from(stages) < far && stages < 1000 {
            stages += 1;
        }
        stages
    }

    fn positions(&mut self, s: &mut State<T>) -> Result<(T, u32), AssemblyError> {
        self.drive(&s.q, T::ONE);
        self.problem.scale_penalties();
        let before = self.largest_position();
        let stages = self.stages();
        for stage in 1..=stages {
            let tau = T::from_f64(f64::from(stage) / f64::from(stages));
            self.drive(&s.q, tau);
            self.close(s, tau, stage == stages)?;
            let (model, terms) = (self.problem.model, &mut self.problem.terms);
            if model.has_forces() {
                model.evaluate_forces(&s.q, &s.v, &s.memory, terms);
                model.remember(terms, &mut s.memory);
            }
        }
        Ok((before, stages))
    }

    /// Closes everything at one stage by sweeps of the correction form.
    fn close(&mut self, s: &mut State<T>, tau: T, is_last: bool) -> Result<(), AssemblyError> {
        let n = self.f.len();
        let floor = self.length * T::EPSILON * T::from_f64(8.0);
        self.sigma.fill(T::ZERO);
        self.change.fill(T::ZERO);
        let mut residual = self.largest_position();
        let (mut best, mut idle) = (residual, 0);
        for sweep in 0..MAX_SWEEPS {
            if residual <= floor || idle > PATIENCE {
                break;
            }
            self.load_positions();
            match self.sweep(Level::Position) {
                // Coordinates that drifted far away drown the mass: that is no lack of inertia.
                Err(_) if sweep > 0 => break,
                result => result?,
            }
            for i in 0..n {
                s.q[i] -= self.f[i];
                self.change[i] -= self.f[i];
            }
            self.drive(&s.q, tau);
            self.grow_positions();
            let left = self.largest_position();
            let stalls =
                left > residual * T::HALF && norm_inf(&self.f) <= self.length * T::from_f64(1e-9);
            residual = left;
            if stalls && residual <= self.length * accepted() {
                break;
            }
            if left < best * T::HALF {
                (best, idle) = (left, 0);
            } else {
                idle += 1;
            }
        }
        if residual <= self.length * accepted::<T>()
            || (!is_last && residual <= self.length * T::from_f64(1e-3))
        {
            return Ok(());
        }
        let (owner, initial) = self.culprit(Level::Position);
        Err(AssemblyError::Position { residual: residual.to_f64(), owner, initial })
    }

    fn velocities(&mut self, s: &mut State<T>) -> Result<(), AssemblyError> {
        let model = self.problem.model;
        model.evaluate_phi_t(&s.q, &mut self.problem.terms);
        self.sigma.fill(T::ZERO);
        self.change.fill(T::ZERO);
        self.measure_rates(&s.v);
        let scale = self.worst();
        let floor = scale * T::EPSILON * T::from_f64(16.0);
        let (mut residual, mut raises) = (scale, raises::<T>());
        for _ in 0..MAX_SWEEPS {
            if residual <= floor {
                break;
            }
            self.load_rates();
            self.sweep(Level::Velocity)?;
            for i in 0..self.f.len() {
                s.v[i] -= self.f[i];
                self.change[i] -= self.f[i];
            }
            self.measure_rates(&s.v);
            self.grow_rates();
            let left = self.worst();
            let (stalls, is_slow) =
                (left > residual * T::HALF, left > residual * T::from_f64(SLOW));
            residual = left;
            if stalls && residual <= scale * accepted() {
                break;
            }
            if is_slow && residual > scale * accepted() && raises > 0 {
                self.problem.raise_penalties();
                raises -= 1;
            }
        }
        if residual <= scale * accepted() {
            return Ok(());
        }
        let (owner, initial) = self.culprit(Level::Velocity);
        Err(AssemblyError::Velocity { residual: residual.to_f64(), owner, initial })
    }

    /// mu = sigma + s phi.
    fn load_positions(&mut self) {
        let (p, m) = (&self.problem, self.rates.len());
        for k in 0..m {
            self.mu[k] = self.sigma[k] + p.penalty[k] * p.terms.phi[k];
        }
        for h in 0..p.holds.len() {
            self.mu[m + h] = self.sigma[m + h] + p.hold_penalty() * p.residuals[h];
        }
    }

    fn grow_positions(&mut self) {
        let (p, m) = (&self.problem, self.rates.len());
        for k in 0..m {
            self.sigma[k] += p.penalty[k] * p.terms.phi[k];
        }
        for h in 0..p.holds.len() {
            self.sigma[m + h] += p.hold_penalty() * p.residuals[h];
        }
    }

    fn measure_rates(&mut self, v: &[T]) {
        let p = &mut self.problem;
        p.model.multiply_jacobian(&p.terms, v, &mut self.rates);
        for (r, &b) in self.rates.iter_mut().zip(&p.terms.phi_t) {
            *r += b;
        }
        p.hold_rates(v);
    }

    fn load_rates(&mut self) {
        let (p, m) = (&self.problem, self.rates.len());
        for k in 0..m {
            self.mu[k] = self.sigma[k] + p.penalty[k] * self.rates[k];
        }
        for h in 0..p.holds.len() {
            self.mu[m + h] = self.sigma[m + h] + p.hold_penalty() * p.residuals[h];
        }
    }

    fn grow_rates(&mut self) {
        let (p, m) = (&self.problem, self.rates.len());
        for k in 0..m {
            self.sigma[k] += p.penalty[k] * self.rates[k];
        }
        for h in 0..p.holds.len() {
            self.sigma[m + h] += p.hold_penalty() * p.residuals[h];
        }
    }

    fn largest_position(&self) -> T {
        norm_inf(&[norm_inf(&self.problem.terms.phi), norm_inf(&self.problem.residuals)])
    }

    fn worst(&self) -> T {
        norm_inf(&[norm_inf(&self.rates), norm_inf(&self.problem.residuals)])
    }

    /// f = W^-1 of the residual.
    fn sweep(&mut self, level: Level) -> Result<(), AssemblyError> {
        let system =
            Sweep { problem: &self.problem, level, change: &self.change, multipliers: &self.mu };
        self.solver.factor(&system).map_err(|e| AssemblyError::NoInertia {
            owner: self.problem.model.owner_of_unknown(e.unknown as usize),
        })?;
        self.solver.assemble(&system, &mut self.f);
        self.solver.solve(&mut self.f, &mut self.scratch);
        Ok(())
    }

    /// Where the largest residual is.
    fn culprit(&self, level: Level) -> (Owner, Option<usize>) {
        let p = &self.problem;
        let rows = if level == Level::Position { &p.terms.phi } else { &self.rates };
        let largest = |x: &[T]| {
            (0..x.len()).max_by(|&i, &j| {
                x[i].abs().partial_cmp(&x[j].abs()).unwrap_or(core::cmp::Ordering::Equal)
            })
        };
        let (row, hold) = (largest(rows), largest(&p.residuals));
        let size = |x: &[T], i: Option<usize>| i.map_or(T::ZERO, |i| x[i].abs());
        match hold {
            // A held row near the largest residual is what the user wrote: name that.
            Some(h) if size(&p.residuals, hold) * T::from_f64(10.0) >= size(rows, row) => {
                (p.holds[h].owner, Some(p.holds[h].initial))
            }
            _ => (p.model.owner_of_row(row.unwrap_or(0)), None),
        }
    }
}

/// How often penalties may be raised: in double precision to 1e9 effective masses, in others not at all.
fn raises<T: Real>() -> u32 {
    if T::EPSILON < T::from_f64(1e-12) { 2 } else { 0 }
}

/// Residual that counts as closed, relative to the scene's length or the largest speed.
fn accepted<T: Real>() -> T {
    T::from_f64(1e-11).max(T::EPSILON * T::from_f64(256.0))
}

/// Accelerations and multipliers at (q, v) of `s` by the index-1 equations, in correction form; sets multipliers, carried
/// phi and power. Returns the acceleration residual left.
///
/// # Errors
/// [`AssemblyError::NoInertia`] or [`AssemblyError::Acceleration`].
pub fn accelerations<T: Real, M: Model<T>>(
    model: &M,
    solver: &mut impl SpdSolver<T>,
    s: &mut State<T>,
    terms: &mut Terms<T>,
) -> Result<T, AssemblyError> {
    let (n, m) = (model.n_unknowns(), model.n_constraints());
    model.set_inputs(s.t, terms);
    model.evaluate(&s.q, terms);
    model.evaluate_forces(&s.q, &s.v, &s.memory, terms);
    model.evaluate_phi_t(&s.q, terms);
    model.evaluate_bias(&s.q, &s.v, terms);
    let mut penalty = vec![T::ZERO; m];
    model.effective_masses(terms, &mut penalty);
    penalty.iter_mut().for_each(|p| *p *= T::from_f64(1e6));
    let (mut f, mut scratch) = (vec![T::ZERO; n], vec![T::ZERO; solver.n_scratch()]);
    let (mut lambda, mut mu, mut rates) = (vec![T::ZERO; m], vec![T::ZERO; m], vec![T::ZERO; m]);
    factor(model, solver, terms, &penalty)?;
    check_pivots(model, solver, terms, &penalty)?;
    let (mut last, mut raises) = (None, raises::<T>());
    for _ in 0..MAX_SWEEPS {
        model.multiply_jacobian(terms, &s.a, &mut rates);
        for k in 0..m {
            rates[k] += terms.phi_bias[k];
            mu[k] = lambda[k] + penalty[k] * rates[k];
        }
        let load = Load { mass: Some(&s.a), multipliers: Some(&mu), force: T::ONE };
        let tangent = tangent(&penalty);
        solver.assemble(&System { model, terms: &*terms, tangent, load }, &mut f);
        solver.solve(&mut f, &mut scratch);
        for i in 0..n {
            s.a[i] -= f[i];
        }
        model.multiply_jacobian(terms, &s.a, &mut rates);
        for k in 0..m {
            rates[k] += terms.phi_bias[k];
            lambda[k] += penalty[k] * rates[k];
        }
        let correction = norm_inf(&f);
        let is_slow = last.is_some_and(|last| correction > last * T::HALF);
        last = Some(correction);
        if is_slow && raises > 0 && !(norm_inf(&rates) <= limit(&s.a)) {
            penalty.iter_mut().for_each(|p| *p *= T::from_f64(RAISE));
            factor(model, solver, terms, &penalty)?;
            raises -= 1;
            last = None;
        } else if is_slow {
            break;
        }
    }
    let residual = norm_inf(&rates);
    if !(residual <= limit(&s.a)) {
        let row = (0..m).find(|&k| !(rates[k].abs() < residual)).unwrap_or(0);
        let owner = model.owner_of_row(row);
        return Err(AssemblyError::Acceleration { residual: residual.to_f64(), owner });
    }
    s.a_aux.copy_from_slice(&s.a);
    for x in [&mut s.lambda, &mut s.lambda_previous, &mut s.reaction] {
        x.copy_from_slice(&lambda);
    }
    s.phi.copy_from_slice(&terms.phi);
    model.remember(terms, &mut s.memory);
    s.power = model.power(&s.q, &s.v, &s.reaction, terms);
    Ok(residual)
}

/// Acceleration residual that is accepted.
fn limit<T: Real>(a: &[T]) -> T {
    (T::ONE + norm_inf(a)) * T::from_f64(1e-9).max(T::EPSILON * T::from_f64(1e4))
}

fn tangent<T: Real>(penalty: &[T]) -> Tangent<'_, T> {
    Tangent { stiffness: T::ZERO, damping: T::ZERO, penalty, geometric: None }
}

/// Factors M + J^T alpha J.
fn factor<T: Real, M: Model<T>>(
    model: &M,
    solver: &mut impl SpdSolver<T>,
    terms: &Terms<T>,
    penalty: &[T],
) -> Result<(), AssemblyError> {
    let load = Load { mass: None, multipliers: None, force: T::ZERO };
    let system = System { model, terms, tangent: tangent(penalty), load };
    solver.factor(&system).map_err(|e| no_inertia(model, e.unknown))
}

fn no_inertia<T: Real>(model: &impl Model<T>, unknown: u32) -> AssemblyError {
    AssemblyError::NoInertia { owner: model.owner_of_unknown(unknown as usize) }
}

/// A pivot that is rounding of the diagonal it came from means that nothing determines the coordinate.
fn check_pivots<T: Real, M: Model<T>>(
    model: &M,
    solver: &impl SpdSolver<T>,
    terms: &Terms<T>,
    penalty: &[T],
) -> Result<(), AssemblyError> {
    let tangent = tangent(penalty);
    let mut diagonal = vec![T::ZERO; model.n_unknowns()];
    let mut block = Vec::new();
    for e in 0..model.n_elements() {
        let clique = model.clique(e);
        let k = clique.len();
        block.clear();
        block.resize(k * (k + 1) / 2, T::ZERO);
        model.write_block(terms, &tangent, e, &mut block);
        for (j, &u) in clique.iter().enumerate() {
            diagonal[u as usize] += block[crate::natural::packed(k, j, j)];
        }
    }
    for (&u, &pivot) in solver.elimination_order().iter().zip(solver.pivots()) {
        if pivot <= diagonal[u as usize] * T::EPSILON * T::from_f64(32.0) {
            return Err(no_inertia(model, u));
        }
    }
    Ok(())
}

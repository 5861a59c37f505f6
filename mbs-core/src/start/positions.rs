//! Positions of the start. Continuation in stages approaches the prescribed values. Then all other coordinates are changed as little as
//! possible from the reference configuration.
//!
//! ```text
//! stage:  q <- the positions nearest to the end of the last stage with phi(q) = 0 and the fraction tau of the prescribed values
//! least:  min (q - q_ref)^T M (q - q_ref)  from the last stage:  M (q - q_ref) + J^T sigma = 0,  phi(q) = 0, by Newton's method
//! ```
//!
//! q_ref is the reference configuration, tau the fraction of the prescribed values, sigma the multipliers. The stages only select the
//! branch of the assembly; their lengths do not influence the result.

use super::error::AssemblyError;
use super::hold::StartRow;
use super::place::Placement;
use super::problem::{Level, MAX_SWEEPS, SLOW_RATIO, raises};
use super::sweeps::Assembly;
use crate::Real;
use crate::blocks::{Cliques, SpdSolver};
use crate::effects::action::{Action, Actions};
use crate::mechanism::{Scene, given_values};
use crate::model::{Model, Owner, State};
use crate::natural::NaturalModel;
use crate::outputs::start_values;
use alloc::vec::Vec;

/// Number of consecutive sweeps that do not halve the smallest residual, after which the search ends [-]. Initial conditions that
/// contradict each other never converge. Chosen, not tuned.
const MAX_IDLE_SWEEPS: u32 = 10;
/// Largest prescribed angle of one continuation stage [rad], or slide in scene lengths. Chosen, not tuned: stages with too large
/// corrections are halved.
const MAX_STAGE: f64 = 0.25;
/// Largest correction of a coordinate in a stage, relative to its size [-]. A larger correction may lead to another branch. Chosen, not
/// tuned.
const MAX_STAGE_CORRECTION: f64 = 1.0;
/// Largest number of halvings of a stage before the path ends [-]. Chosen, not tuned.
const HALVINGS: i32 = 10;
/// Largest residual that a stage before the last one may leave, relative to the rows' spreads [-]. Chosen, not tuned: the last stage
/// removes it.
const MAX_STAGE_GAP: f64 = 1e-6;
/// Residual or correction, relative to sizes, below which rows are almost linear [-]: their curvature then contributes 1e-6. A slow sweep
/// then means that the penalty is too small.
const STRAIGHT: f64 = 1e-3;
/// Largest correction of a sweep towards the smallest change, relative to the coordinates' sizes [-]. Chosen, not tuned.
const MAX_CORRECTION: f64 = 0.25;
/// Largest number of sweeps towards the smallest change [-]: flat minima need some dozens.
const MAX_STEPS: u32 = 400;
/// Correction below which Newton's method reaches machine precision next, in square roots of machine precision [-]: corrections decrease
/// quadratically.
const CLOSE: f64 = 1e-2;
/// Ratio of two consecutive corrections above which the damping is increased [-]. Chosen, not tuned.
const GROWING: f64 = 0.9;
/// Damping, relative to the masses, above which the search fails [-]. Chosen, not tuned.
const MAX_DAMPING: f64 = 1e6;
/// Damping, relative to the masses, below which it is set to zero [-]. Chosen, not tuned.
const LEAST_DAMPING: f64 = 0.1;
/// Factor on the damping after a correction that is smaller than the last [-]. Chosen, not tuned.
const DAMPING_FADE: f64 = 0.25;

impl<T: Real, S: SpdSolver<T>, const D: usize> Assembly<'_, T, S, D> {
    /// Assembles the start positions. Returns the largest residual before, and the number of stages.
    pub(super) fn positions(
        &mut self,
        scene: &Scene<T>,
        s: &mut State<T>,
    ) -> Result<(T, u32), AssemblyError> {
        self.turns = given_turns(scene, self.problem.model);
        self.drive(&s.q, T::ONE);
        self.problem.scale_rows();
        let before = self.largest_position();
        if self.worst(&self.rows) <= self.rounding(&s.q) * T::from_f64(8.0) {
            self.remember(s);
            return Ok((before, 1));
        }
        let stages = self.stages();
        let placement = Placement::new(scene, self.problem.model.clusters());
        if let Some(placement) = placement
            && self.place(&placement, stages, s)
        {
            if !placement.is_complete {
                self.least(s)?;
            }
            return Ok((before, stages));
        }
        let stages = self.follow(scene, stages, s)?;
        self.least(s)?;
        Ok((before, stages))
    }

    fn stages(&self) -> u32 {
        let holds = self.problem.holds.iter().map(|h| h.distance(self.length));
        let guides = self.guides.iter().map(|g| g[0].abs());
        let far = holds.chain(guides).fold(T::ZERO, T::max).to_f64() / MAX_STAGE;
        let mut stages = 1;
        while f64::from(stages) < far && stages < 1000 {
            stages += 1;
        }
        stages
    }

    /// Places an open tree. Returns true if its rows are satisfied; otherwise `s` is unchanged.
    fn place(&mut self, placement: &Placement<'_, T>, stages: u32, s: &mut State<T>) -> bool {
        let (q, memory) = (s.q.clone(), s.memory.clone());
        for stage in 1..=stages {
            let tau = T::from_f64(f64::from(stage) / f64::from(stages));
            self.problem.model.write_motions(&placement.motions(tau), s);
            self.remember(s);
            self.problem.model.write_rotors(s);
        }
        self.drive(&s.q, T::ONE);
        self.problem.scale_rows();
        let is_met =
            self.worst(&self.rows) <= self.accepted(&s.q) || self.close(s, T::ONE, true).is_ok();
        if !is_met {
            (s.q, s.memory) = (q, memory);
        }
        is_met
    }

    /// Sets the turns of effects' angles as for outputs: from prescribed values, or else within half a turn of the reference configuration.
    pub(super) fn count_turns(&mut self, scene: &Scene<T>, s: &mut State<T>) {
        remember_given(scene, self.problem.model, &self.turns, s);
        self.remember(s);
    }

    /// Remembers the angles at the present positions, with the turns nearest to the last stage.
    fn remember(&mut self, s: &mut State<T>) {
        let (model, terms) = (self.problem.model, &mut self.problem.terms);
        if !s.memory.is_empty() {
            terms.angles.copy_from_slice(&s.memory);
            model.evaluate_forces(&s.q, &s.v, terms);
            model.remember(&s.q, terms, &mut s.memory);
        }
    }

    /// Approaches the prescribed values in at least `stages` stages. Returns the number of stages.
    fn follow(
        &mut self,
        scene: &Scene<T>,
        stages: u32,
        s: &mut State<T>,
    ) -> Result<u32, AssemblyError> {
        let longest = T::ONE / T::from_f64(f64::from(stages));
        let shortest = longest * T::from_f64(libm::ldexp(1.0, -HALVINGS));
        let (mut tau, mut step, mut taken) = (T::ZERO, longest, 0);
        let (mut closed, mut last) = (T::ZERO, s.q.clone());
        while tau < T::ONE {
            let is_last = tau + step > T::ONE - shortest * T::HALF;
            let next = if is_last { T::ONE } else { tau + step };
            self.drive(&s.q, next);
            let end = self.close(s, next, is_last);
            if let Err(Stop::Jump(error)) = end {
                s.q.copy_from_slice(&last);
                step *= T::HALF;
                if step < shortest {
                    return Err(self.stopped((error, scene), closed));
                }
                continue;
            }
            match end {
                Ok(()) => closed = next,
                Err(Stop::Gap(error)) if is_last => {
                    // If the residual at the end is small, the path did not stop early.
                    let is_small = self.worst(&self.rows) <= T::from_f64(STRAIGHT);
                    let closed = if is_small { T::ONE } else { closed };
                    return Err(self.stopped((error, scene), closed));
                }
                Err(_) => {}
            }
            self.remember(s);
            last.copy_from_slice(&s.q);
            (tau, taken) = (next, taken + 1);
            step = (step + step).min(longest);
        }
        Ok(taken)
    }

    /// Satisfies all rows of one stage by sweeps of corrections. The rows must have been evaluated at `tau`. Several prescribed values may
    /// be compatible only at the end. Earlier stages then accept a compromise by least squares.
    fn close(&mut self, s: &mut State<T>, tau: T, is_last: bool) -> Result<(), Stop> {
        let n = self.problem.n_unknowns();
        self.problem.lower_penalties();
        self.sigma.fill(T::ZERO);
        self.change.fill(T::ZERO);
        let mut residual = self.worst(&self.rows);
        let (mut best, mut idle, mut raises) = (residual, 0, raises::<T>());
        let mut correction = T::ZERO;
        for _ in 0..MAX_SWEEPS {
            let floor = self.rounding(&s.q) * T::from_f64(8.0);
            if residual <= floor || idle > MAX_IDLE_SWEEPS {
                break;
            }
            self.load();
            self.factor(Level::Position, None, T::ZERO).map_err(Stop::Jump)?;
            self.solve(Level::Position);
            correction = self.largest(&self.f);
            if !(correction <= T::from_f64(MAX_STAGE_CORRECTION)) {
                return Err(Stop::Jump(self.gap()));
            }
            self.grow(Level::Position);
            self.correct(s, T::ONE);
            self.drive(&s.q, tau);
            let left = self.worst(&self.rows);
            let (stalls, is_slow) =
                (left > residual * T::HALF, left > residual * T::from_f64(SLOW_RATIO));
            residual = left;
            if stalls && residual <= self.accepted(&s.q) {
                break;
            }
            if is_slow && correction <= T::from_f64(STRAIGHT) && raises > 0 {
                self.problem.raise_penalties();
                raises -= 1;
            }
            if left < best * T::HALF {
                (best, idle) = (left, 0);
            } else {
                idle += 1;
            }
        }
        if !is_last && residual <= self.accepted(&s.q).max(T::from_f64(MAX_STAGE_GAP)) {
            return Ok(());
        }
        let moved: Vec<T> = (0..n).map(|i| s.q[i] - self.reference[i]).collect();
        if self.is_met(Level::Position, self.accepted(&s.q), &moved) {
            return Ok(());
        }
        // Close to a singular position corrections are larger than the residual that they remove. At a compromise they are zero.
        let is_compromise = correction <= residual * T::from_f64(STRAIGHT);
        Err(if is_compromise { Stop::Gap(self.gap()) } else { Stop::Jump(self.gap()) })
    }

    /// Applies the fraction `part` of the correction.
    fn correct(&mut self, s: &mut State<T>, part: T) {
        for i in 0..self.problem.n_unknowns() {
            s.q[i] -= self.f[i] * part;
            self.change[i] -= self.f[i] * part;
        }
    }

    /// Moves an assembled mechanism to the assembled positions with the smallest change from the reference configuration. Curvature of the
    /// rows may make the matrix indefinite, or corrections may grow. Damping then turns Newton's method towards steepest descent.
    fn least(&mut self, s: &mut State<T>) -> Result<(), AssemblyError> {
        let n = self.problem.n_unknowns();
        self.drive(&s.q, T::ONE);
        self.problem.scale_rows();
        self.sigma.fill(T::ZERO);
        let (mut damping, mut last, mut waits) = (T::ZERO, None, 0);
        let close = T::EPSILON.sqrt() * T::from_f64(CLOSE);
        let mut correction = T::ZERO;
        for _ in 0..MAX_STEPS {
            for i in 0..n {
                self.change[i] = s.q[i] - self.reference[i];
            }
            self.load();
            let q = s.q.clone();
            if self.factor(Level::Position, Some(&q), damping).is_err() {
                damping = (damping + damping).max(T::HALF);
                if damping > T::from_f64(MAX_DAMPING) {
                    self.factor(Level::Position, None, T::ZERO)?;
                    return Err(self.gap());
                }
                continue;
            }
            self.solve(Level::Position);
            self.grow(Level::Position);
            correction = self.largest(&self.f);
            if !correction.is_finite() {
                return Err(self.gap());
            }
            self.correct(s, (T::from_f64(MAX_CORRECTION) / correction).min(T::ONE));
            self.drive(&s.q, T::ONE);
            self.remember(s);
            if correction <= T::EPSILON * T::from_f64(4.0) {
                break;
            }
            let grows = last.is_some_and(|last| correction > last * T::from_f64(GROWING));
            let stalls = last.is_some_and(|last| correction > last * T::HALF);
            last = Some(correction);
            if stalls && correction <= close && damping == T::ZERO {
                waits += 1;
                if waits > 2 {
                    break;
                }
            }
            if grows && correction > close {
                damping = (damping + damping).max(T::HALF);
            } else {
                let is_left = damping > T::from_f64(LEAST_DAMPING);
                damping = if is_left { damping * T::from_f64(DAMPING_FADE) } else { T::ZERO };
            }
        }
        // Weakly determined combinations of coordinates keep an error of machine precision times their condition number.
        if !(correction <= T::EPSILON.sqrt()) {
            return Err(AssemblyError::NotLeast { correction: correction.to_f64() });
        }
        if self.worst(&self.rows) > self.accepted(&s.q) {
            self.factor(Level::Position, None, T::ZERO)?;
        }
        let moved: Vec<T> = (0..n).map(|i| s.q[i] - self.reference[i]).collect();
        if self.is_met(Level::Position, self.accepted(&s.q), &moved) {
            return Ok(());
        }
        Err(self.gap())
    }

    /// Error for rows that are not satisfied. It contains the largest residual.
    fn gap(&self) -> AssemblyError {
        let (residual, owner, initial) = self.culprit();
        AssemblyError::Position { residual: residual.to_f64(), owner, initial, reached: None }
    }

    /// Error of a path that stopped, with the coordinate that was being approached. All rows were satisfied up to `tau`.
    fn stopped(&self, (error, scene): (AssemblyError, &Scene<T>), tau: T) -> AssemblyError {
        let AssemblyError::Position { residual, mut owner, mut initial, .. } = error else {
            return error;
        };
        let is_guided =
            |joint: &usize| scene.guides.iter().any(|guide| guide.joint.index() == *joint);
        if initial.is_none() && !matches!(&owner, Owner::Joint(joint) if is_guided(joint)) {
            // The largest prescribed value is the entry that the user can most likely change.
            let far = |hold: &StartRow<T, D>| hold.distance(self.length).to_f64();
            let holds = self.problem.holds.iter();
            if let Some(hold) = holds.max_by(|a, b| far(a).total_cmp(&far(b))) {
                (owner, initial) = (hold.owner, Some(hold.initial));
            }
        }
        let held = self.problem.holds.iter().filter(|hold| hold.owner == owner);
        let guided = scene.guides.iter().zip(&self.guides).filter(
            |(guide, _)| matches!(owner, Owner::Joint(joint) if joint == guide.joint.index()),
        );
        let guided = guided.map(|(_, value)| value[0]);
        let targets = held.map(StartRow::target).chain(guided);
        let largest = targets.fold(T::ZERO, |a: T, b| if b.abs() > a.abs() { b } else { a });
        let reached = (largest != T::ZERO && tau < T::ONE - T::from_f64(STRAIGHT))
            .then(|| [(largest * tau).to_f64(), largest.to_f64()]);
        let missing = reached.map_or(0.0, |[reached, value]| (value - reached).abs());
        let residual = residual.max(missing);
        AssemblyError::Position { residual, owner, initial, reached }
    }
}

/// Angles that couplings remember and that the scene determines: the index in the memory of the state, and the angle.
pub(super) fn given_turns<T: Real, const D: usize>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
) -> Vec<(usize, T)> {
    let given = given_values(scene);
    let angles = model.coupled_angles().filter_map(|((joint, number), sign, place)| {
        given[joint][number].map(|value| (place, value * sign))
    });
    angles.collect()
}

/// Reason why a stage ended before all rows were satisfied.
enum Stop {
    /// Corrections were too large, or did not end. Shorter stages may succeed.
    Jump(AssemblyError),
    /// A residual remains: prescribed values contradict each other or the joints.
    Gap(AssemblyError),
}

/// Sets the angles that a state remembers to those that the scene determines. `turns` are the angles of couplings.
pub(super) fn remember_given<T: Real, const D: usize>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    turns: &[(usize, T)],
    s: &mut State<T>,
) {
    let starts = start_values(scene);
    // A scene with a model always has valid actions.
    let actions = Actions::new(scene).map(|actions| actions.list).unwrap_or_default();
    for (effect, action) in actions {
        let Action::Angle { joint, number, .. } = action else { continue };
        let start = starts[joint].get(number);
        if let (Some(place), Some(&start)) = (model.memory_of_effect(effect), start) {
            s.memory[place] = start;
        }
    }
    for &(place, angle) in turns {
        s.memory[place] = angle;
    }
}

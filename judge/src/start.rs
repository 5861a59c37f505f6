//! State at the start. Values that the scene gives hold. All others follow by the least mass-weighted change from the reference
//! configuration and from zero velocities.
//!
//! ```text
//! least  Σ ½ ∫ |displacement of each particle|² dm = Σ ½ m |r - r₀|² + tr S - tr R S + Σ ½ I θ² of rotors,   S = ½ tr(I) E - I
//! ```
//!
//! Here m, I, r and R are mass, inertia, centre of mass and rotation of a body, r₀ is r in the reference configuration, and E is the unit
//! matrix. For rotors, I is the moment of inertia and θ the angle.
//!
//! Newton's method solves the conditions of the minimum, with second derivatives by differences. Given values grow from zero in stages.
//! Each stage measures the change from the reference configuration. A negative curvature along allowed motions is made positive. So no step
//! increases the change, and no saddle point is accepted as a minimum.

use crate::dense::Square;
use crate::motion::{Mechanism, Owner, State};
use crate::rows::{Places, Row, six};
use crate::scene::{Coupling, InitialCondition, Measure};
use crate::vector::{
    UNIT, Vector, ZERO, compose, conjugate, cross, exponential, logarithm, product, rotation,
    scale, sub,
};

/// Largest growth of given values in a stage, in radians or in lengths of the mechanism. Chosen, not tuned.
const STAGE: f64 = 0.15;
/// Smallest fraction of a stage before the start fails [-]. Chosen, not tuned.
const LEAST_STAGE: f64 = 1e-3;
/// Largest number of iterations of a stage. Chosen, not tuned: Newton's method needs few.
const MOST_ITERATIONS: usize = 40;
/// Curvature that is added where the least curvature is negative, beside twice its magnitude [-]. Chosen, not tuned.
const CURVED: f64 = 0.1;
/// Displacement from a saddle point along the direction of negative curvature, in radians or lengths of the mechanism. Chosen, not tuned.
const ASIDE: f64 = 0.03;
/// Largest curvature that may be an error of second differences, so that its sign is unknown [-]. Chosen, not tuned.
const FLAT: f64 = 1e-6;
/// Increments of the differences for second derivatives, in radians or lengths of the mechanism. Chosen, not tuned.
const DIFFERENCE: f64 = 1e-5;

/// Reason why there is no start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoStart {
    /// Given values that cannot be met: the largest fraction of them that was reached.
    Values(f64),
    /// Given rates that contradict each other or the constraints.
    Rates,
}

/// Positions with multipliers of all rows.
struct Trial {
    state: State,
    multipliers: Vec<f64>,
}

/// A step of Newton's method.
struct Correction {
    /// Changes of the bodies' places.
    moves: Vec<[f64; 6]>,
    /// Multipliers after the step.
    multipliers: Vec<f64>,
    /// A direction of negative curvature, if there is one.
    falls: Option<Vec<[f64; 6]>>,
}

impl Mechanism {
    /// The state at t = 0.
    ///
    /// # Errors
    /// [`NoStart`] where given values or rates cannot be met.
    pub fn start(&self) -> Result<State, NoStart> {
        let mut trial = Trial { state: self.reference(), multipliers: Vec::new() };
        let largest = self.largest_value();
        let mut stage = (STAGE / largest.max(1e-300)).min(1.0);
        let mut share = 0.0;
        while share < 1.0 {
            let next = (share + stage).min(1.0);
            match self.least_change(&trial, next) {
                Some(found) => {
                    trial = found;
                    share = next;
                }
                None => {
                    stage *= 0.5;
                    if stage < LEAST_STAGE * (STAGE / largest.max(1e-300)).min(1.0) {
                        return Err(NoStart::Values(share));
                    }
                }
            }
        }
        let mut state = trial.state;
        self.meet(&mut state);
        state.turns = self.given_turns(&state.turns);
        self.count_turns(&mut state);
        let places = self.places(&state);
        let held = self.held_rates(&state, &places);
        if self.project_velocities(&mut state, None, &held) > 1e-8 {
            return Err(NoStart::Rates);
        }
        // a second projection removes the error that elimination left
        self.project_velocities(&mut state, None, &held);
        Ok(state)
    }

    /// Corrects the positions until all rows are zero to machine precision. Near a singular position, rates are very sensitive to errors of
    /// positions.
    fn meet(&self, state: &mut State) {
        for _ in 0..2 {
            let places = self.places(state);
            let rows = self.start_rows(state, &places, 1.0);
            let saddle = self.saddle(&places, &rows, &[]);
            let right: Vec<f64> = rows.iter().map(|row| -row.value).collect();
            let none = vec![[0.0; 6]; state.frames.len()];
            let (moves, _, _) = self.solve(&saddle, &none, &right);
            state.frames.iter_mut().zip(&moves).for_each(|(frame, m)| frame.moved(m));
            self.count_turns(state);
        }
    }

    /// Returns the values from which angles of joints are followed: given or guided values; for joints of couplings the values found;
    /// otherwise zero.
    fn given_turns(&self, found: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let n = self.scene.joints.len();
        let mut turns = vec![[0.0; 3]; n];
        turns.extend_from_slice(&found[n..]);
        for term in self.scene.couplings.iter().flat_map(|c| &c.terms) {
            if let Measure::Coordinate(joint, _) = term.measure {
                turns[joint] = found[joint];
            }
        }
        for coupling in &self.scene.couplings {
            if let Some((joint, ..)) = coupling.passed {
                turns[joint] = found[joint];
            }
        }
        let mut give = |joint: usize, first: usize, value: &[f64]| {
            let turning = self.scene.joints[joint].turning(self.scene.planar);
            for (to, i) in turns[joint].iter_mut().zip(turning) {
                if let Some(x) = i.checked_sub(first).and_then(|i| value.get(i)) {
                    *to = *x;
                }
            }
        };
        for guide in &self.scene.guides {
            give(guide.joint, guide.coordinate, &[guide.law.at(0.0)[0]]);
        }
        for guide in &self.scene.guided_turns {
            let first = self.scene.joints[guide.joint].turning(self.scene.planar).start;
            give(guide.joint, first, &guide.laws.each_ref().map(|law| law.at(0.0)[0]));
        }
        for initial in &self.scene.initials {
            if let InitialCondition::Joint { joint, value: Some(value), .. } = initial {
                give(*joint, 0, value);
            }
        }
        turns
    }

    fn largest_value(&self) -> f64 {
        let (mut largest, length) = (0.0_f64, self.length());
        let mut note = |joint: usize, i: usize, x: f64| {
            let slides = i < self.scene.joints[joint].turning(self.scene.planar).start;
            largest = largest.max(x.abs() / if slides { length } else { 1.0 });
        };
        for initial in &self.scene.initials {
            if let InitialCondition::Joint { joint, value: Some(value), .. } = initial {
                value.iter().enumerate().for_each(|(i, x)| note(*joint, i, *x));
            }
        }
        for guide in &self.scene.guides {
            note(guide.joint, guide.coordinate, guide.law.at(0.0)[0]);
        }
        for law in self.scene.guided_turns.iter().flat_map(|guide| &guide.laws) {
            largest = largest.max(law.at(0.0)[0].abs());
        }
        for coupling in &self.scene.couplings {
            let unit = coupling.terms.iter().fold(0.0_f64, |a, term| a.max(term.factor.abs()));
            largest = largest.max(given(coupling).abs() / unit.max(f64::MIN_POSITIVE));
        }
        largest
    }

    /// Rows of constraints, guides and given values. The given values are multiplied by `share`.
    fn start_rows(&self, state: &State, places: &Places, share: f64) -> Vec<Row> {
        let now = self.now(state, places);
        let (mut rows, mut guides) = (Vec::new(), self.scene.guides.iter());
        for (owner, mut row) in self.rows_at(&now, share) {
            let whole = match owner {
                Owner::Joint(_) | Owner::Rolling(..) | Owner::Turn(..) => 0.0,
                Owner::Coupling(k) => given(&self.scene.couplings[k]),
                Owner::Guide(..) => guides.next().map_or(0.0, |guide| guide.law.at(0.0)[0]),
            };
            row.value += (1.0 - share) * whole;
            if !row.of_rates {
                rows.push(row);
            }
        }
        for initial in &self.scene.initials {
            let InitialCondition::Joint { joint, value: Some(value), .. } = initial else {
                continue;
            };
            let data = &self.scene.joints[*joint];
            let mut coordinates = now.coordinates(*joint);
            let first = data.first_of_ball(self.scene.planar).unwrap_or(coordinates.len());
            for (row, x) in coordinates.iter_mut().zip(value).take(first) {
                row.value -= share * x;
            }
            if first < coordinates.len() {
                let target: Vector =
                    [0, 1, 2].map(|i| share * value.get(first + i).copied().unwrap_or(0.0));
                let [q1, q2] = now.quaternions(data.bodies);
                let left = logarithm(compose(
                    exponential(scale(-1.0, target)),
                    compose(conjugate(q1), q2),
                ));
                let turn = rotation(q2);
                for i in 0..3 {
                    let e = [turn[0][i], turn[1][i], turn[2][i]];
                    coordinates[first + i] = places.about(data.bodies, e, None).with_value(left[i]);
                }
            }
            rows.extend(coordinates);
        }
        rows
    }

    /// Gradient of the change from the reference configuration, less Jᵀ times the multipliers. It is zero at the minimum.
    fn balance(&self, state: &State, rows: &[Row], multipliers: &[f64]) -> Vec<[f64; 6]> {
        let gradient = |(f, b): (&crate::rows::Frame, &crate::scene::Body)| {
            let half = 0.5 * (0..3).map(|i| b.inertia[i][i]).sum::<f64>();
            let s = [0, 1, 2].map(|i| [0, 1, 2].map(|j| half * UNIT[i][j] - b.inertia[i][j]));
            let a = product(&rotation(f.q), &s);
            let turning = [a[2][1] - a[1][2], a[0][2] - a[2][0], a[1][0] - a[0][1]];
            six(scale(b.mass, sub(f.r, b.center)), turning)
        };
        let mut sum: Vec<[f64; 6]> =
            state.frames.iter().zip(&self.scene.bodies).map(gradient).collect();
        let mut add = |row: &Row, factor: f64| {
            for (body, part) in &row.parts {
                if let Some(b) = body {
                    sum[*b].iter_mut().zip(part).for_each(|(x, p)| *x += factor * p);
                }
            }
        };
        rows.iter().zip(multipliers).for_each(|(row, lambda)| add(row, -lambda));
        let places = self.places(state);
        for (inertia, row) in self.rotors(&self.now(state, &places)) {
            add(&row, inertia * row.value);
        }
        sum
    }

    /// Finds the least change by Newton's method from a trial, with the given values multiplied by `share`.
    fn least_change(&self, from: &Trial, share: f64) -> Option<Trial> {
        let mut trial = Trial { state: from.state.clone(), multipliers: from.multipliers.clone() };
        let length = self.length();
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let places = self.places(&trial.state);
            let rows = self.start_rows(&trial.state, &places, share);
            trial.multipliers.resize(rows.len(), 0.0);
            let Correction { mut moves, multipliers, falls } =
                self.correction(&trial, &rows, share);
            let size_of = |moves: &[[f64; 6]]| {
                let all = moves.iter().flat_map(|m| m.iter().enumerate());
                all.fold(0.0_f64, |a, (i, x)| a.max(x.abs() / if i < 3 { length } else { 1.0 }))
            };
            let mut size = size_of(&moves);
            if !size.is_finite() {
                return None;
            }
            if let Some(aside) = falls.filter(|_| size < 1e-6) {
                let part = ASIDE / size_of(&aside);
                moves = aside.iter().map(|m| m.map(|x| part * x)).collect();
                size = ASIDE;
            }
            let damp = (0.3 / size).min(1.0);
            for (frame, m) in trial.state.frames.iter_mut().zip(&moves) {
                frame.moved(&m.map(|x| damp * x));
            }
            for (old, new) in trial.multipliers.iter_mut().zip(multipliers) {
                *old += damp * (new - *old);
            }
            self.count_turns(&mut trial.state);
            if size < 1e-13 || (size < 1e-10 && size > 0.3 * last) {
                let moved = self.start_rows(&trial.state, &self.places(&trial.state), share);
                let open = moved.iter().fold(0.0_f64, |a, r| a.max(r.value.abs()));
                return (open < 1e-9 * length.max(1.0)).then_some(trial);
            }
            last = size;
        }
        None
    }

    /// A step of Newton's method.
    fn correction(&self, trial: &Trial, rows: &[Row], share: f64) -> Correction {
        let mut matrix = self.second(trial, rows, share);
        let curvature = self.curvature(&matrix, rows).filter(|c| c.least < -FLAT);
        if let Some(curvature) = &curvature {
            for i in 0..self.n_velocities() {
                *matrix.at(i, i) += CURVED - 2.0 * curvature.least;
            }
        }
        let saddle = self.factor_with(matrix, rows, false);
        let zero: Vec<f64> = rows.iter().map(|r| -r.value).collect();
        let loads: Vec<[f64; 6]> = self
            .balance(&trial.state, rows, &vec![0.0; rows.len()])
            .iter()
            .map(|g| g.map(|x| -x))
            .collect();
        let (moves, multipliers, _) = self.solve(&saddle, &loads, &zero);
        let falls = curvature.map(|curvature| self.of_bodies(&curvature.along));
        Correction { moves, multipliers, falls }
    }

    /// Second derivatives, by differences and in scaled velocities: those of the change, less those of the rows times their multipliers.
    fn second(&self, trial: &Trial, rows: &[Row], share: f64) -> Square {
        let n = self.n_velocities();
        let mut matrix = Square::zero(n + rows.len());
        let length = self.length();
        for (b, of) in self.columns().iter().enumerate() {
            for (i, column) in of.iter().enumerate() {
                let Some(c) = *column else { continue };
                let step = DIFFERENCE * if i < 3 { length } else { 1.0 };
                let [ahead, behind] = [step, -step].map(|step| {
                    let mut state = trial.state.clone();
                    let mut by = [0.0; 6];
                    by[i] = step;
                    state.frames[b].moved(&by);
                    let rows = self.start_rows(&state, &self.places(&state), share);
                    self.balance(&state, &rows, &trial.multipliers)
                });
                for ((a, z), of) in ahead.iter().zip(&behind).zip(self.columns()) {
                    for (k, row) in of.iter().enumerate() {
                        if let Some(r) = *row {
                            let scales = self.scale(r) * self.scale(c);
                            *matrix.at(r, c) = (a[k] - z[k]) / (2.0 * step) * scales;
                        }
                    }
                }
            }
        }
        matrix
    }

    /// Rows of given rates.
    fn held_rates(&self, state: &State, places: &Places) -> Vec<Row> {
        let now = self.now(state, places);
        let mut rows = Vec::new();
        for initial in &self.scene.initials {
            match initial {
                InitialCondition::Joint { joint, rate: Some(rate), .. } => {
                    for (mut row, x) in now.coordinates(*joint).into_iter().zip(rate) {
                        row.given[0] = *x;
                        rows.push(row);
                    }
                }
                InitialCondition::Joint { .. } => {}
                InitialCondition::Body { body, velocity, angular } => {
                    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
                    let mut hold = |part: [f64; 6], x: f64| {
                        let mut row = Row::new(vec![(Some(*body), part)], 0.0, 0.0);
                        row.given[0] = x;
                        rows.push(row);
                    };
                    let some = if self.scene.planar { 2 } else { 3 };
                    if let Some([at, v]) = velocity {
                        let arm = places.seat(Some(*body), *at).arm;
                        (0..some).for_each(|i| hold(six(axes[i], cross(arm, axes[i])), v[i]));
                    }
                    if let Some(w) = angular {
                        let first = if self.scene.planar { 2 } else { 0 };
                        (first..3).for_each(|i| hold(six(ZERO, axes[i]), w[i]));
                    }
                }
            }
        }
        rows
    }
}

/// Returns the value of a coupling's sum at the start.
fn given(coupling: &Coupling) -> f64 {
    coupling.value + coupling.law.as_ref().map_or(0.0, |law| law.at(0.0)[0])
}

//! Accelerations and multipliers of a state, by one dense saddle system.
//!
//! ```text
//! M a - Jᵀ λ = Q - ω × I ω,    J a = given - bias
//! ```
//!
//! M has masses and inertias I, J the gradients of the rows, and Q the loads; a are accelerations, ω angular velocities, λ multipliers.
//! Unknowns are scaled by the square roots of masses and moments of inertia, and rows to length one. So pivots have the order of one, and a
//! small pivot shows that rows depend on each other.

use crate::dense::{Factors, Square};
use crate::loads::{Loads, Now};
use crate::rows::{Frame, Places, Row};
use crate::scene::{Effect, Scene, Seat};
use crate::vector::{Vector, ZERO, add, cross, dot, product, scale, sub, times, transpose};

/// A state of motion.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Time of the state [s].
    pub t: f64,
    /// Frames of the bodies.
    pub frames: Vec<Frame>,
    /// Angles of each joint, or its rotation vector, followed over whole turns; then the angles that couplings measure.
    pub turns: Vec<[f64; 3]>,
    /// States of the signals.
    pub memory: Vec<f64>,
    /// Work of all forces that have no potential [J].
    pub work: f64,
}

/// Accelerations of a state, with reactions, energies and their uniqueness.
#[derive(Debug, Clone)]
pub struct Moved {
    /// Acceleration and angular acceleration of each body.
    pub accelerations: Vec<[f64; 6]>,
    /// Reaction of each joint: force and moment of its first body on its second, about the joint's place, with the guide's effort.
    pub reactions: Vec<[f64; 6]>,
    /// Efforts of guides on the coordinates of each joint.
    pub efforts: Vec<[f64; 6]>,
    /// The multiplier of each coupling.
    pub couplings: Vec<f64>,
    /// True for each coupling whose multiplier is unique.
    pub unique_couplings: Vec<bool>,
    /// The force on each body that rolls, at its contact.
    pub contacts: Vec<Vector>,
    /// True for each contact whose force is unique.
    pub unique_contacts: Vec<bool>,
    /// True if constraint rows depend on each other.
    pub is_redundant: bool,
    /// True for each joint whose reaction is unique.
    pub unique: Vec<bool>,
    /// True for each body that can rotate without inertia, such as a thin rod about its own line.
    pub idle: Vec<bool>,
    /// Kinetic and stored energy [J].
    pub energy: [f64; 2],
    /// Power of all forces that have no potential [W].
    pub power: f64,
    /// Smallest pivot of the factors: a measure of the distance to a singular position.
    pub least_pivot: f64,
    /// Largest part of the loads that no inertia or reaction balances, relative to the largest load.
    pub unmet: f64,
}

/// Mechanism: a scene with the indices and scales of its velocities.
#[derive(Debug, Clone)]
pub struct Mechanism {
    /// Scene of the mechanism.
    pub scene: Scene,
    /// Indices of the velocities of each body.
    columns: Vec<[Option<usize>; 6]>,
    n: usize,
    /// Scale of each velocity: 1/√(mass or moment of inertia).
    scales: Vec<f64>,
}

/// Owner of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Owner {
    /// Joint by its index.
    Joint(usize),
    /// Coupling by its index.
    Coupling(usize),
    /// Contact that rolls, along a direction on its body.
    Rolling(usize, Vector),
    /// A guide of a coordinate of a joint.
    Guide(usize, usize),
    /// A guide of the rotation vector of a joint, along a direction.
    Turn(usize, Vector),
}

/// A factored saddle system with the scales of its rows.
#[derive(Debug)]
pub(crate) struct Saddle {
    pub(crate) factors: Factors,
    row_scales: Vec<f64>,
    n: usize,
}

impl Mechanism {
    /// Makes the mechanism of a scene.
    #[must_use]
    pub fn new(scene: Scene) -> Self {
        let mut n = 0;
        let used: &[usize] = if scene.planar { &[0, 1, 5] } else { &[0, 1, 2, 3, 4, 5] };
        let mut columns = Vec::new();
        for _ in &scene.bodies {
            let mut of = [None; 6];
            for &i in used {
                of[i] = Some(n);
                n += 1;
            }
            columns.push(of);
        }
        let spin = |b: &crate::scene::Body| (0..3).map(|i| b.inertia[i][i]).fold(0.0, f64::max);
        let largest = scene.bodies.iter().map(|b| b.mass).fold(1e-30, f64::max);
        let largest_spin = scene.bodies.iter().map(spin).fold(1e-30, f64::max);
        let mut scales = vec![1.0; n];
        for (body, of) in scene.bodies.iter().zip(&columns) {
            let mass = body.mass.max(1e-6 * largest);
            let inertia = spin(body).max(1e-6 * largest_spin);
            for (i, column) in of.iter().enumerate() {
                if let Some(c) = column {
                    scales[*c] = 1.0 / if i < 3 { mass } else { inertia }.sqrt();
                }
            }
        }
        let mut mechanism = Self { scene, columns, n, scales };
        mechanism.fill_limits();
        mechanism
    }

    /// The reference configuration without velocities.
    #[must_use]
    pub fn reference(&self) -> State {
        let still = |b: &crate::scene::Body| Frame {
            r: b.center,
            q: [1.0, 0.0, 0.0, 0.0],
            angle: 0.0,
            v: ZERO,
            w: ZERO,
        };
        let frames = self.scene.bodies.iter().map(still).collect();
        let turns = vec![[0.0; 3]; self.scene.joints.len() + self.scene.wheels.len()];
        let memory = self.scene.signals.iter().map(|signal| signal.start).collect();
        State { t: 0.0, frames, turns, memory, work: 0.0 }
    }

    pub(crate) fn columns(&self) -> &[[Option<usize>; 6]] {
        &self.columns
    }

    pub(crate) fn n_velocities(&self) -> usize {
        self.n
    }

    pub(crate) fn scale(&self, column: usize) -> f64 {
        self.scales[column]
    }

    pub(crate) fn places(&self, state: &State) -> Places {
        Places::new(&self.scene, &state.frames)
    }

    pub(crate) fn now<'a>(&'a self, state: &'a State, places: &'a Places) -> Now<'a> {
        let State { t, frames, turns, memory, .. } = state;
        Now { scene: &self.scene, places, frames, turns, t: *t, memory }
    }

    /// All constraint rows, each with its owner.
    pub(crate) fn rows(&self, now: &Now<'_>) -> Vec<(Owner, Row)> {
        self.rows_at(now, 1.0)
    }

    /// All constraint rows, each with its owner. The rotation vectors that guides prescribe are multiplied by `share`.
    pub(crate) fn rows_at(&self, now: &Now<'_>, share: f64) -> Vec<(Owner, Row)> {
        let mut rows = Vec::new();
        for (j, joint) in self.scene.joints.iter().enumerate() {
            let own = joint.rows(now.places, self.scene.planar);
            rows.extend(own.into_iter().map(|row| (Owner::Joint(j), row)));
        }
        for (k, coupling) in self.scene.couplings.iter().enumerate() {
            rows.push((Owner::Coupling(k), now.coupling(coupling)));
        }
        for (k, rolling) in self.scene.rollings.iter().enumerate() {
            let own = now.rolling(rolling);
            rows.extend(own.into_iter().map(|(along, row)| (Owner::Rolling(k, along), row)));
        }
        rows.extend(now.guided(share));
        rows
    }

    /// The inertias of rotors, each with the row of its coordinate.
    pub(crate) fn rotors(&self, now: &Now<'_>) -> Vec<(f64, Row)> {
        let effects = self.scene.effects.iter();
        let rotors = effects.filter_map(|effect| match effect {
            Effect::Rotor(joint, number, inertia) => {
                Some((*inertia, now.coordinates(*joint).swap_remove(*number)))
            }
            _ => None,
        });
        rotors.collect()
    }

    /// Inertia of a body in global axes.
    pub(crate) fn inertia(&self, b: usize, places: &Places) -> [[f64; 3]; 3] {
        let turn = &places.of(Some(b)).turn;
        product(&product(turn, &self.scene.bodies[b].inertia), &transpose(turn))
    }

    /// Kinetic energy of a body [J].
    pub(crate) fn kinetic_energy(&self, b: usize, state: &State, places: &Places) -> f64 {
        let (frame, mass) = (&state.frames[b], self.scene.bodies[b].mass);
        let momentum = times(&self.inertia(b, places), frame.w);
        0.5 * (mass * dot(frame.v, frame.v) + dot(frame.w, momentum))
    }

    /// The gradient of a row in scaled velocities.
    pub(crate) fn dense_row(&self, row: &Row) -> Vec<(usize, f64)> {
        self.dense_parts(&row.parts)
    }

    fn dense_parts(&self, parts: &[(Option<usize>, [f64; 6])]) -> Vec<(usize, f64)> {
        let mut entries = Vec::with_capacity(12);
        for (body, part) in parts {
            let Some(b) = body else { continue };
            for (i, column) in self.columns[*b].iter().enumerate() {
                if let Some(c) = column
                    && part[i] != 0.0
                {
                    entries.push((*c, part[i] * self.scales[*c]));
                }
            }
        }
        entries
    }

    /// Mass matrix in scaled velocities: M = masses of bodies + Σ I g gᵀ, for rotors with inertia I and gradient g of their coordinate. The
    /// matrix has room for the constraint rows.
    fn masses(&self, places: &Places, n_rows: usize, rotors: &[(f64, Row)]) -> Square {
        let mut matrix = Square::zero(self.n + n_rows);
        for (b, of) in self.columns.iter().enumerate() {
            let inertia = self.inertia(b, places);
            for i in 0..6 {
                for j in 0..6 {
                    let (Some(r), Some(c)) = (of[i], of[j]) else { continue };
                    let entry = match (i < 3, j < 3) {
                        (true, true) if i == j => self.scene.bodies[b].mass,
                        (false, false) => inertia[i - 3][j - 3],
                        _ => 0.0,
                    };
                    *matrix.at(r, c) = entry * self.scales[r] * self.scales[c];
                }
            }
        }
        for (inertia, row) in rotors {
            let entries = self.dense_row(row);
            for (r, x) in &entries {
                for (c, y) in &entries {
                    *matrix.at(*r, *c) += inertia * x * y;
                }
            }
        }
        matrix
    }

    /// Factors [[M, -Jᵀ], [J, 0]] in scaled velocities, with the masses M and the gradients J of the rows.
    pub(crate) fn saddle(&self, places: &Places, rows: &[Row], rotors: &[(f64, Row)]) -> Saddle {
        self.factor_with(self.masses(places, rows.len(), rotors), rows, false)
    }

    /// Adds rows to a scaled mass matrix and factors it. With `seated` the forces of multipliers act at the attachment points of the
    /// couplings, otherwise along the gradients of the rows.
    pub(crate) fn factor_with(&self, mut matrix: Square, rows: &[Row], seated: bool) -> Saddle {
        let mut row_scales = Vec::with_capacity(rows.len());
        for (k, row) in rows.iter().enumerate() {
            let entries = self.dense_row(row);
            let length = entries.iter().map(|e| e.1 * e.1).sum::<f64>().sqrt();
            let scale = if length > 0.0 { 1.0 / length } else { 1.0 };
            for (c, x) in &entries {
                *matrix.at(self.n + k, *c) += x * scale;
            }
            let acts = row.acts.as_ref().filter(|_| seated);
            for (c, x) in acts.map_or(entries, |parts| self.dense_parts(parts)) {
                *matrix.at(c, self.n + k) -= x * scale;
            }
            row_scales.push(scale);
        }
        Saddle { factors: matrix.factor(), row_scales, n: self.n }
    }

    /// Solves a saddle system for loads on bodies and right-hand sides of rows. Returns changes of bodies, multipliers and the residual
    /// that remains.
    pub(crate) fn solve(
        &self,
        saddle: &Saddle,
        loads: &[[f64; 6]],
        rows: &[f64],
    ) -> (Vec<[f64; 6]>, Vec<f64>, f64) {
        let mut b = vec![0.0; saddle.n + rows.len()];
        for (load, of) in loads.iter().zip(&self.columns) {
            for (x, column) in load.iter().zip(of) {
                if let Some(c) = column {
                    b[*c] = x * self.scales[*c];
                }
            }
        }
        let scaled = rows.iter().zip(&saddle.row_scales).map(|(x, s)| x * s);
        b[saddle.n..].iter_mut().zip(scaled).for_each(|(b, x)| *b = x);
        let (x, unmet) = saddle.factors.solve(&b);
        let multipliers =
            x[saddle.n..].iter().zip(&saddle.row_scales).map(|(x, s)| x * s).collect();
        (self.of_bodies(&x), multipliers, unmet)
    }

    /// Changes of bodies from scaled changes.
    pub(crate) fn of_bodies(&self, x: &[f64]) -> Vec<[f64; 6]> {
        let of_body =
            |of: &[Option<usize>; 6]| of.map(|c| c.map_or(0.0, |c| x[c] * self.scales[c]));
        self.columns.iter().map(of_body).collect()
    }

    /// Accelerations, reactions, energies and power of a state.
    #[must_use]
    pub fn evaluate(&self, state: &State) -> Moved {
        self.evaluate_among(state, None)
    }

    /// Returns accelerations, reactions, energies and power, computed with the rows that `among` marks. The other rows depend on these.
    pub(crate) fn evaluate_among(&self, state: &State, among: Option<&[bool]>) -> Moved {
        let places = self.places(state);
        let now = self.now(state, &places);
        let mut loads = now.loads();
        let rotors = self.rotors(&now);
        let mut kinetic = 0.0;
        for (inertia, row) in &rotors {
            // a rotor with inertia I and gradient g has the load g · I (g · a + bias), with the accelerations a; this is the part of the
            // bias
            loads.along(row, -inertia * row.bias);
            kinetic += 0.5 * inertia * row.rate(&places).powi(2);
        }
        let Loads { mut on, potential, mut power } = loads;
        for (body, part) in now.pretensions() {
            let of = body.map(|b| &mut on[b]);
            of.into_iter().flatten().zip(part).for_each(|(x, more)| *x += more);
        }
        for (b, frame) in state.frames.iter().enumerate() {
            let momentum = times(&self.inertia(b, &places), frame.w);
            kinetic += self.kinetic_energy(b, state, &places);
            let gyroscopic = cross(frame.w, momentum);
            (0..3).for_each(|i| on[b][i + 3] -= gyroscopic[i]);
        }
        let all = self.rows(&now);
        let kept = |i: usize| among.is_none_or(|kept| kept[i]);
        let rows = all.into_iter().enumerate().filter(|(i, _)| kept(*i)).map(|(_, row)| row);
        let (owners, mut rows): (Vec<Owner>, Vec<Row>) = rows.unzip();
        let masses = self.masses(&places, rows.len(), &rotors);
        let mut saddle = self.factor_with(masses.clone(), &rows, true);
        let right: Vec<f64> = rows.iter().map(|r| r.given[1] - r.bias).collect();
        let (mut accelerations, mut multipliers, mut unmet) = self.solve(&saddle, &on, &right);
        if self.turn_teeth(&now, &owners, &mut rows, &multipliers) {
            saddle = self.factor_with(masses, &rows, true);
            (accelerations, multipliers, unmet) = self.solve(&saddle, &on, &right);
        }
        let mut moved = self.blank();
        for ((&owner, row), lambda) in owners.iter().zip(&rows).zip(&multipliers) {
            power += lambda * row.given[0];
            let Some(joint) = self.give(owner, *lambda, &mut moved) else { continue };
            let wrench = self.wrench(joint, row, *lambda, &places);
            moved.reactions[joint].iter_mut().zip(wrench).for_each(|(r, w)| *r += w);
        }
        for vector in saddle.factors.kernel() {
            self.open(&vector, &owners, &mut moved);
        }
        let least_pivot = saddle.factors.least_pivot;
        Moved { accelerations, energy: [kinetic, potential], power, least_pivot, unmet, ..moved }
    }

    /// Adds a multiplier to the reaction or effort of its owner. Returns the joint that carries the multiplier.
    fn give(&self, owner: Owner, lambda: f64, moved: &mut Moved) -> Option<usize> {
        match owner {
            Owner::Coupling(k) => {
                moved.couplings[k] = lambda;
                None
            }
            Owner::Rolling(k, along) => {
                moved.contacts[k] = add(moved.contacts[k], scale(lambda, along));
                None
            }
            Owner::Guide(joint, coordinate) => {
                moved.efforts[joint][coordinate] = lambda;
                Some(joint)
            }
            Owner::Turn(joint, along) => {
                let first = self.scene.joints[joint].turning(self.scene.planar).start;
                let effort = moved.efforts[joint][first..].iter_mut();
                effort.zip(along).for_each(|(x, a)| *x += lambda * a);
                Some(joint)
            }
            Owner::Joint(joint) => Some(joint),
        }
    }

    /// Corrects the forces of teeth whose multiplier is negative, since teeth are pushed apart for both signs of the effort. Returns true
    /// if there is such a row.
    fn turn_teeth(
        &self,
        now: &Now<'_>,
        owners: &[Owner],
        rows: &mut [Row],
        multipliers: &[f64],
    ) -> bool {
        let mut any = false;
        for ((owner, row), multiplier) in owners.iter().zip(rows).zip(multipliers) {
            let Owner::Coupling(k) = owner else { continue };
            let coupling = &self.scene.couplings[*k];
            if matches!(coupling.seat, Seat::Teeth(..)) && *multiplier < 0.0 {
                row.acts = now.seated(coupling, row, -1.0);
                any = true;
            }
        }
        any
    }

    /// Motion with zero accelerations, loads and energies, in which every reaction is unique.
    fn blank(&self) -> Moved {
        let (n_bodies, n_joints) = (self.scene.bodies.len(), self.scene.joints.len());
        let (n_couplings, n_rollings) = (self.scene.couplings.len(), self.scene.rollings.len());
        Moved {
            accelerations: vec![[0.0; 6]; n_bodies],
            reactions: vec![[0.0; 6]; n_joints],
            efforts: vec![[0.0; 6]; n_joints],
            couplings: vec![0.0; n_couplings],
            unique_couplings: vec![true; n_couplings],
            contacts: vec![ZERO; n_rollings],
            unique_contacts: vec![true; n_rollings],
            unique: vec![true; n_joints],
            idle: vec![false; n_bodies],
            is_redundant: false,
            energy: [0.0; 2],
            power: 0.0,
            least_pivot: f64::INFINITY,
            unmet: 0.0,
        }
    }

    /// Marks reactions that a null vector of the matrix leaves undetermined.
    fn open(&self, vector: &[f64], owners: &[Owner], moved: &mut Moved) {
        for (x, &owner) in vector[self.n..].iter().zip(owners) {
            let is_open = x.abs() >= 1e-6;
            moved.is_redundant |= is_open;
            match owner {
                Owner::Joint(joint) | Owner::Guide(joint, _) | Owner::Turn(joint, _) => {
                    moved.unique[joint] &= !is_open;
                }
                Owner::Coupling(k) => moved.unique_couplings[k] &= !is_open,
                Owner::Rolling(k, _) => moved.unique_contacts[k] &= !is_open,
            }
        }
        for (of, idle) in self.columns.iter().zip(&mut moved.idle) {
            *idle |= of.iter().flatten().any(|&c| vector[c].abs() > 1e-6);
        }
    }

    /// Returns the force and moment of a multiplier on the second body, about the joint's place.
    fn wrench(&self, joint: usize, row: &Row, lambda: f64, places: &Places) -> [f64; 6] {
        let joint = &self.scene.joints[joint];
        let place = joint.place(places);
        let (part, sign) = if joint.bodies[1].is_some() { (1, 1.0) } else { (0, -1.0) };
        let (body, gradient) = row.parts[part];
        let g = gradient.map(|x| sign * lambda * x);
        let force: Vector = [g[0], g[1], g[2]];
        let about = add([g[3], g[4], g[5]], cross(sub(places.of(body).r, place), force));
        crate::rows::six(force, about)
    }

    /// The largest residual of position rows, and that of velocity rows.
    #[must_use]
    pub fn violation(&self, state: &State) -> [f64; 2] {
        let places = self.places(state);
        let rows = self.rows(&self.now(state, &places));
        rows.iter().fold([0.0; 2], |[p, v], (_, row)| {
            [row.value.abs().max(p), (row.rate(&places) - row.given[0]).abs().max(v)]
        })
    }
}

//! Joint reactions from the equilibrium of every body. They do not depend on the coordinates and the formulation of the motion.
//!
//! ```text
//! on body b, about its centre of mass c:
//!   sum_j +-R_j + applied = [m (c'' - g);  I omega' + omega x I omega]
//! R_j = W_j r_j       W_j: unit wrenches that joint j can transmit, at its point on the second body;  r_j: their unknown magnitudes
//! applied             wrenches of effects, inertia of rotors, and c_k f_k' lambda of each term of a coupling with the unknown effort lambda;
//!                     once lambda is known, also the force that pushes teeth apart at a pitch point
//! ```
//!
//! Welded bodies are treated like all other bodies. If the equations leave reactions open, the solution is the one of smallest norm. The
//! norm uses forces, and moments over the scene's length.

use super::coupled_sum::CoupledSum;
use super::error::ReactionError;
use super::inertia::BodyInertia;
use super::leaf_elimination::{Block, eliminate_leaves};
use super::load::Loads;
use super::minimum_norm::MinimumNorm;
use super::rotor::RotorTorque;
use super::wrench::{Applied, Wrench, WrenchBasis};
use crate::Real;
use crate::algebra::{Matrix, Vector, cross, raised};
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::{ModelError, NaturalModel};
use crate::scene::BodyId;
use alloc::vec;
use alloc::vec::Vec;

/// Largest number of wrench components of one dense elimination [-]. It takes 0.17 s for each state, measured on a ring of 199 planar
/// bodies.
pub const LARGEST_BLOCK: usize = 400;

/// Reactions of all joints of a scene at a state.
///
/// Trees are solved body by body from their leaves. Each group of connected loops is solved by one dense elimination.
#[derive(Debug, Clone)]
pub struct Reactions<T: Real, const D: usize> {
    bodies: Vec<Placed<T, D>>,
    /// Wrench that the unsolved joints of each body must supply, about the body's centre of mass.
    missing: Vec<Wrench<T>>,
    /// Joints of the scene, then its rolling contacts.
    joints: Vec<WrenchBasis<T, D>>,
    n_joints: usize,
    couplings: Vec<CoupledSum<T, D>>,
    loads: Loads<T, D>,
    rotors: Vec<RotorTorque<T, D>>,
    blocks: Vec<Block>,
    length: T,
    system: MinimumNorm<T>,
    /// Directions of the wrenches in the present block, joint by joint.
    directions: Vec<Wrench<T>>,
    wrenches: Vec<Wrench<T>>,
    is_unique: Vec<bool>,
    /// Effort of each coupling, and whether the motion determines it.
    efforts: Vec<(T, bool)>,
    residual: T,
    /// Index of each body in the present block.
    place_in_block: Vec<usize>,
}

/// A body with its position at a state.
#[derive(Debug, Clone)]
struct Placed<T: Real, const D: usize> {
    body: BodyInertia<T, D>,
    /// Acceleration of the body by gravity [m/s^2].
    gravity: Vector<T, 3>,
    /// Rotation matrix and centre of mass at the state.
    turned: Matrix<T, 3>,
    at: Vector<T, 3>,
}

impl<T: Real, const D: usize> Reactions<T, D> {
    /// Prepares a checked scene and allocates all memory.
    ///
    /// # Errors
    /// [`ReactionError::Model`] if the scene's dimension is not D. [`ReactionError::TooLarge`] if connected loops have more than
    /// [`LARGEST_BLOCK`] wrench components. Trees of any size are allowed.
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Result<Self, ReactionError> {
        if scene.dimension.count() != D {
            return Err(ModelError::Dimension.into());
        }
        let n_joints = scene.joints.len();
        let rollings = (0..scene.rollings.len()).map(|i| WrenchBasis::of_rolling(scene, model, i));
        let joints: Vec<WrenchBasis<T, D>> = (0..n_joints)
            .map(|joint| WrenchBasis::new(scene, model, joint))
            .chain(rollings)
            .collect();
        let pairs: Vec<_> =
            joints.iter().map(|j| (j.n_directions() > 0).then_some(j.bodies)).collect();
        let couplings: Vec<_> =
            (0..scene.couplings.len()).map(|i| CoupledSum::new(scene, model, i)).collect();
        let acted_on = couplings.iter().map(CoupledSum::bodies);
        let blocks = eliminate_leaves(scene.bodies.len(), &pairs, acted_on);
        let unknowns = |block: &Block| {
            let of_joints = block.joints.iter().map(|&j| joints[j].n_directions());
            of_joints.sum::<usize>() + block.couplings.len()
        };
        let columns = blocks.iter().map(unknowns).max().unwrap_or(0);
        let rows = blocks.iter().map(|b| b.bodies.len()).max().unwrap_or(0) * Self::ROWS;
        if columns > LARGEST_BLOCK {
            return Err(ReactionError::TooLarge { unknowns: columns, limit: LARGEST_BLOCK });
        }
        Ok(Self {
            bodies: (0..scene.bodies.len()).map(|b| Placed::new(scene, model, b)).collect(),
            missing: vec![Wrench::zero(); scene.bodies.len()],
            loads: Loads::new(scene, model).map_err(ModelError::from)?.0,
            rotors: RotorTorque::all(scene, model),
            length: model.length(),
            system: MinimumNorm::new(rows, columns),
            directions: Vec::with_capacity(columns),
            wrenches: vec![Wrench::zero(); joints.len()],
            is_unique: vec![true; joints.len()],
            efforts: vec![(T::ZERO, false); couplings.len()],
            residual: T::ZERO,
            place_in_block: vec![usize::MAX; scene.bodies.len()],
            joints,
            n_joints,
            couplings,
            blocks,
        })
    }

    /// Number of equations of one body.
    const ROWS: usize = 3 * (D - 1);

    /// Evaluates all reactions at a consistent state.
    ///
    /// Cost: a few hundred operations for each body of a tree, and about 2 m n^2 for loops with m equations and n wrench components. No
    /// allocation.
    pub fn update(&mut self, state: &State<T>) {
        for (body, missing) in self.bodies.iter_mut().zip(&mut self.missing) {
            *missing = body.update(state);
        }
        self.apply_loads(state);
        self.residual = T::ZERO;
        let blocks = core::mem::take(&mut self.blocks);
        for block in &blocks {
            self.assemble(block, state);
            let mut residual = self.system.solve();
            if self.load_bearings(block, state) {
                self.assemble(block, state);
                residual = self.system.solve();
            }
            self.residual = self.residual.max(residual);
            self.distribute(block, state);
        }
        self.blocks = blocks;
    }

    /// Reaction of a joint at the last update: the wrench of the first body on the second, about the joint's point on the second body. It
    /// includes the effort of a guide. Axes are global. Planar: [Fx, Fy, Mz] in the first three places. Spatial: [Fx, Fy, Fz, Mx, My, Mz]
    /// [N, N m].
    ///
    /// # Panics
    /// If there is no such joint.
    #[must_use]
    pub fn reaction(&self, joint: usize) -> [T; 6] {
        let Wrench { force: f, moment: m } = &self.wrenches[joint];
        match D {
            2 => [f[0], f[1], m[2], T::ZERO, T::ZERO, T::ZERO],
            _ => [f[0], f[1], f[2], m[0], m[1], m[2]],
        }
    }

    /// True if the motion at the last update determined the joint's reaction. Otherwise the reaction is the one of smallest norm.
    ///
    /// # Panics
    /// If there is no such joint.
    #[must_use]
    pub fn is_unique(&self, joint: usize) -> bool {
        self.is_unique[joint]
    }

    /// Contact force on a rolling body at the last update, in global axes [N]. It acts at the lowest point of a disc or ball, or at the
    /// point of a blade.
    ///
    /// # Panics
    /// If there is no such rolling contact.
    #[must_use]
    pub fn rolling_force(&self, rolling: usize) -> [T; 3] {
        self.wrenches[self.n_joints + rolling].force.into()
    }

    /// Component of the contact force along the plane's normal, towards the body [N]. It is negative if the contact pulls.
    ///
    /// # Panics
    /// If there is no such rolling contact.
    #[must_use]
    pub fn rolling_push(&self, rolling: usize) -> T {
        let index = self.n_joints + rolling;
        let contact = &self.joints[index];
        let on = rotation_of(&self.bodies, contact.bodies[0]);
        self.wrenches[index].force.dot(&contact.normal(&on))
    }

    /// True if the motion at the last update determined the contact force. Otherwise the force is the one of smallest norm.
    ///
    /// # Panics
    /// If there is no such rolling contact.
    #[must_use]
    pub fn is_rolling_unique(&self, rolling: usize) -> bool {
        self.is_unique[self.n_joints + rolling]
    }

    /// Effort of a coupling at the last update: the generalised force on each of its terms divided by the term's factor [N, N m].
    ///
    /// # Panics
    /// If there is no such coupling.
    #[must_use]
    pub fn effort(&self, coupling: usize) -> T {
        self.efforts[coupling].0
    }

    /// True if the motion at the last update determined the coupling's effort. Otherwise the effort is the one of smallest norm.
    ///
    /// # Panics
    /// If there is no such coupling.
    #[must_use]
    pub fn is_effort_unique(&self, coupling: usize) -> bool {
        self.efforts[coupling].1
    }

    /// Largest force, or moment over the scene's length, that no reactions balance [N]. It measures the inconsistency of the state.
    #[must_use]
    pub fn residual(&self) -> T {
        self.residual
    }

    fn apply_loads(&mut self, state: &State<T>) {
        let Self { bodies, missing, loads, rotors, .. } = self;
        let mut take = |applied| take_off(bodies, missing, applied);
        let (loads, law_inputs) = loads.at(state);
        for load in loads {
            load.apply((state, &law_inputs), &|body| rotation_of(bodies, body), &mut take);
        }
        for rotor in rotors {
            rotor.apply(state, &mut take);
        }
    }

    /// Assembles the equilibrium of a block's bodies, with the wrench components of its joints as unknowns.
    fn assemble(&mut self, block: &Block, state: &State<T>) {
        let Self { bodies, joints, directions, system, place_in_block, .. } = self;
        directions.clear();
        for &j in &block.joints {
            let joint = &joints[j];
            let turned = joint.bodies.map(|b| rotation_of(bodies, b));
            joint.directions(&state.q, [&turned[0], &turned[1]], &mut |w| directions.push(w));
        }
        let n_columns = directions.len() + block.couplings.len();
        system.begin(block.bodies.len() * Self::ROWS, n_columns);
        for (place, &b) in block.bodies.iter().enumerate() {
            place_in_block[b] = place;
            let right = rows::<T, D>(&self.missing[b], self.length);
            for (i, &x) in right[..Self::ROWS].iter().enumerate() {
                system.right()[place * Self::ROWS + i] = x;
            }
        }
        let mut column = 0;
        for &j in &block.joints {
            let turned = joints[j].bodies.map(|b| rotation_of(bodies, b));
            let at = joints[j].place(&state.q, [&turned[0], &turned[1]]);
            for direction in &directions[column..column + joints[j].n_directions()] {
                for (body, sign) in joints[j].bodies.into_iter().zip([-T::ONE, T::ONE]) {
                    let BodyId::Body(b) = body else { continue };
                    // The other body of a leaf's joint is not in the block.
                    if block.bodies.binary_search(&b).is_err() {
                        continue;
                    }
                    let wrench = direction.scaled(sign).shifted(&(at - bodies[b].at));
                    let entries = rows::<T, D>(&wrench, self.length);
                    for (i, &x) in entries[..Self::ROWS].iter().enumerate() {
                        *system.entry(place_in_block[b] * Self::ROWS + i, column) = x;
                    }
                }
                column += 1;
            }
        }
        for &i in &block.couplings {
            let coupling = &self.couplings[i];
            coupling.apply(T::ONE / coupling.scale(), state, &mut |(body, at, wrench)| {
                let BodyId::Body(b) = body else { return };
                let arm = at.map_or_else(Vector::zeros, |at| at - bodies[b].at);
                let entries = rows::<T, D>(&wrench.shifted(&arm), self.length);
                for (row, &x) in entries[..Self::ROWS].iter().enumerate() {
                    *system.entry(place_in_block[b] * Self::ROWS + row, column) += x;
                }
            });
            column += 1;
        }
    }

    /// Applies the wrenches of couplings that load bearings only, at the efforts of a solved block. They do not change the efforts. Returns
    /// whether there are any.
    fn load_bearings(&mut self, block: &Block, state: &State<T>) -> bool {
        let Self { bodies, joints, missing, couplings, system, .. } = self;
        let of_joints: usize = block.joints.iter().map(|&j| joints[j].n_directions()).sum();
        let mut is_loaded = false;
        for (&i, &solved) in block.couplings.iter().zip(&system.solution()[of_joints..]) {
            couplings[i].load_bearings(solved / couplings[i].scale(), state, &mut |applied| {
                is_loaded = true;
                take_off(bodies, missing, applied);
            });
        }
        is_loaded
    }

    /// Stores the wrenches and efforts of a solved block, and subtracts them from the missing wrenches of its bodies.
    fn distribute(&mut self, block: &Block, state: &State<T>) {
        let mut column = 0;
        for &j in &block.joints {
            let mut wrench = Wrench::zero();
            let columns = column..column + self.joints[j].n_directions();
            for k in columns.clone() {
                wrench.add(&self.directions[k].scaled(self.system.solution()[k]));
            }
            self.is_unique[j] = columns.clone().all(|k| self.system.is_determined(k));
            self.wrenches[j] = wrench;
            column = columns.end;
            let turned = self.joints[j].bodies.map(|b| rotation_of(&self.bodies, b));
            let at = self.joints[j].place(&state.q, [&turned[0], &turned[1]]);
            for (body, sign) in self.joints[j].bodies.into_iter().zip([T::ONE, -T::ONE]) {
                if let BodyId::Body(b) = body {
                    let arm = at - self.bodies[b].at;
                    self.missing[b].add(&wrench.scaled(sign).shifted(&arm));
                }
            }
        }
        let Self { bodies, missing, couplings, system, efforts, .. } = self;
        for &i in &block.couplings {
            let effort = system.solution()[column] / couplings[i].scale();
            efforts[i] = (effort, system.is_determined(column));
            couplings[i].apply(effort, state, &mut |applied| take_off(bodies, missing, applied));
            column += 1;
        }
    }
}

/// Subtracts an applied wrench from the missing wrench of its body.
fn take_off<T: Real, const D: usize>(
    bodies: &[Placed<T, D>],
    missing: &mut [Wrench<T>],
    (body, at, wrench): Applied<T>,
) {
    if let BodyId::Body(b) = body {
        let arm = at.map_or_else(Vector::zeros, |at| at - bodies[b].at);
        missing[b].add(&wrench.shifted(&arm).scaled(-T::ONE));
    }
}

impl<T: Real, const D: usize> Placed<T, D> {
    fn new(scene: &Scene<T>, model: &NaturalModel<T, D>, body: usize) -> Self {
        let gravity = scene.gravity.map_or_else(Vector::zeros, Vector::<T, 3>::from);
        Self {
            gravity: scene.bodies[body].gravity_scale.map_or(gravity, |scale| gravity * scale),
            body: BodyInertia::new(scene, model, body),
            turned: Matrix::<T, 3>::identity(),
            at: Vector::zeros(),
        }
    }

    /// Updates the body's position to a state. Returns the wrench that all joints and effects together must supply:
    /// [m (c'' - g); I omega' + omega x I omega].
    fn update(&mut self, state: &State<T>) -> Wrench<T> {
        let BodyInertia { frame, center, mass, inertia, .. } = &self.body;
        let r = frame.rotation(&state.q);
        let omega = frame.turning(&state.q, &state.v);
        let alpha = frame.turning(&state.q, &state.a);
        let inertia = r * *inertia * r.transpose();
        self.turned = r;
        self.at = raised(&center.value(&state.q));
        Wrench {
            force: (raised(&center.rate(&state.a)) - self.gravity) * *mass,
            moment: inertia * alpha + cross(&omega, &(inertia * omega)),
        }
    }
}

/// Entries of a wrench in the equations: planar [Fx, Fy, Mz / length], spatial all six, with moments over the length.
fn rows<T: Real, const D: usize>(wrench: &Wrench<T>, length: T) -> [T; 6] {
    let (f, m) = (&wrench.force, wrench.moment * (T::ONE / length));
    match D {
        2 => [f[0], f[1], m[2], T::ZERO, T::ZERO, T::ZERO],
        _ => [f[0], f[1], f[2], m[0], m[1], m[2]],
    }
}

fn rotation_of<T: Real, const D: usize>(bodies: &[Placed<T, D>], body: BodyId) -> Matrix<T, 3> {
    match body {
        BodyId::Ground => Matrix::<T, 3>::identity(),
        BodyId::Body(b) => bodies[b].turned,
    }
}

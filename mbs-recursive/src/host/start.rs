//! Conversion between the coordinates of a tree and the motions of the bodies.

use crate::build::TreeError;
use crate::build::graph::Branch;
use crate::build::own_tables::own;
use crate::build::tree::{Part, TreeModel, TreePlace, parts};
use crate::host::state::{TreeState, Workspace};
use crate::link::joint::write;
use crate::link::options::{Closure, Options};
use crate::link::{LinkKind, LinkMotion};
use crate::passes::evaluate::{Level, accelerations};
use crate::passes::failure::failure;
use crate::passes::slices::{Inputs, TreeSlices};
use crate::passes::{inverse, kinematics};
use crate::space::{Numbers, Space};
use crate::step::project::onto_loops;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::algebra::{Matrix, Vector, across, cross, rotation_vector};
use mbs_core::model::State;
use mbs_core::natural::{NaturalModel, unwrap, unwrap_rotation};
use mbs_core::outputs::start_values;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::Scene;
use mbs_core::step::StepError;

/// Reason why a tree cannot start.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum StartError {
    /// Error: the scene cannot be made into a tree.
    Tree(TreeError),
    /// Error: the start cannot be made consistent with the constraints.
    Step(StepError),
}

impl core::fmt::Display for StartError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Tree(error) => write!(f, "{error}"),
            Self::Step(error) => write!(f, "at the start: {error}"),
        }
    }
}

impl core::error::Error for StartError {}

impl From<TreeError> for StartError {
    fn from(error: TreeError) -> Self {
        Self::Tree(error)
    }
}

impl From<StepError> for StartError {
    fn from(error: StepError) -> Self {
        Self::Step(error)
    }
}

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Returns the state of an assembled mechanism. Coordinates are computed from natural ones and projected onto the loops. Accelerations
    /// are evaluated. Of all angles that differ by whole turns, the angle nearest to the scene's start value is chosen.
    ///
    /// # Errors
    /// [`StartError`] if the loops cannot be closed, or if they are in a singular position.
    pub fn start<const D: usize>(
        &self,
        scene: &Scene<T>,
        natural: &NaturalModel<T, D>,
        state: &State<T>,
    ) -> Result<TreeState<T>, StartError> {
        let motions: Vec<_> =
            (0..scene.bodies.len()).map(|body| natural.motion(scene, body, state)).collect();
        let mut start = self.read(scene, state.t, &motions);
        start.inputs.copy_from_slice(&state.inputs);
        start.signals.copy_from_slice(&state.signals);
        self.take_turns(scene, natural, state, &mut start);
        self.settle(&mut start, &mut Workspace::new(self))?;
        Ok(start)
    }

    /// Makes the state of an assembled mechanism at time `t` from one motion for each of the scene's bodies.
    ///
    /// # Errors
    /// Fails as [`start`](Self::start) does.
    ///
    /// # Panics
    /// If there are fewer motions than bodies.
    pub fn start_from(
        &self,
        scene: &Scene<T>,
        t: T,
        motions: &[RigidMotion<T>],
    ) -> Result<TreeState<T>, StartError> {
        let mut state = self.read(scene, t, motions);
        self.settle(&mut state, &mut Workspace::new(self))?;
        Ok(state)
    }

    /// Computes coordinates and velocities from one motion for each of the scene's bodies, at the state's time. Of all angles that differ
    /// by whole turns, the angle nearest to the angle in the state is chosen.
    ///
    /// # Panics
    /// If there are fewer motions than bodies.
    pub fn read_motions(
        &self,
        scene: &Scene<T>,
        motions: &[RigidMotion<T>],
        state: &mut TreeState<T>,
    ) {
        for seat in &self.seats {
            let own = &self.links[seat.link as usize];
            let mut values: Vec<T> = match own.kind {
                LinkKind::Free if S::DIMENSION == 2 && seat.branch.is_reversed => {
                    vec![-state.z[own.z as usize]]
                }
                LinkKind::Free if S::DIMENSION == 2 => vec![state.z[own.z as usize]],
                // A quaternion does not count whole turns.
                LinkKind::Ball | LinkKind::Free => Vec::new(),
                LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => {
                    continue;
                }
                _ => {
                    let chain = &self.links[seat.first as usize..=seat.link as usize];
                    chain.iter().map(|link| state.z[link.z as usize]).collect()
                }
            };
            if seat.branch.is_reversed {
                values.reverse();
            }
            self.read_seat((scene, &values), seat, motions, state);
        }
    }

    /// Returns a state with the coordinates and velocities of given motions.
    fn read(&self, scene: &Scene<T>, t: T, motions: &[RigidMotion<T>]) -> TreeState<T> {
        let mut state = TreeState::at_rest(self);
        state.t = t;
        let starts = start_values(scene);
        for seat in &self.seats {
            let values = seat.branch.joint.map_or(&[][..], |joint| &starts[joint]);
            self.read_seat((scene, values), seat, motions, &mut state);
        }
        state
    }

    /// Projects the positions of a state onto the constraints of the loops. The change of the positions is the smallest in the norm of the
    /// mass matrix. All other numbers of the state are unchanged.
    ///
    /// Cost: a few projections; no allocation.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    pub fn close_loops(
        &self,
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
    ) -> Result<(), StepError> {
        let m = TreeSlices { loads: &[], ..self.mechanism() };
        let mut s = workspace.store();
        s.z.copy_from_slice(&state.z);
        s.v.fill(T::ZERO);
        self.prescribed.write(state.t, &state.applied, s.guides, s.courses);
        onto_loops(&m, &Options::default(), &mut s).map_err(|fault| failure(&m, fault))?;
        state.z.copy_from_slice(s.z);
        Ok(())
    }

    /// Projects positions and velocities onto the constraints of the loops, then evaluates accelerations and multipliers.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    pub fn settle(
        &self,
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
    ) -> Result<(), StepError> {
        let (m, options) = (self.mechanism(), Options::default());
        let mut s = workspace.store();
        s.z.copy_from_slice(&state.z);
        s.v.copy_from_slice(&state.v);
        self.inputs(state).evaluate(state.t, s.guides, s.courses);
        own(s.begin_signals(T::ZERO, &state.signals));
        let fault = |fault| failure(&m, fault);
        onto_loops(&m, &options, &mut s).map_err(fault)?;
        accelerations(&m, &options, Level::Fine, &mut s).map_err(fault)?;
        state.power = own(crate::passes::energy_balance::power(&m, &mut s));
        state.signals.copy_from_slice(s.signals.ends);
        state.applied.copy_from_slice(&state.inputs);
        state.z.copy_from_slice(s.z);
        state.v.copy_from_slice(s.v);
        state.set_accelerations(s.zdd);
        state.lambda.copy_from_slice(s.lambda);
        Ok(())
    }

    /// Computes coordinates and velocities of a cluster's joint.
    fn read_seat(
        &self,
        (scene, values): (&Scene<T>, &[T]),
        seat: &TreePlace,
        motions: &[RigidMotion<T>],
        state: &mut TreeState<T>,
    ) {
        let still = RigidMotion::at_rest(self.base);
        let motion = |cluster: usize| motions[self.clusters.clusters[cluster].bodies[0]];
        let child = motion(seat.branch.cluster);
        let parent = seat.branch.parent.map_or(still, motion);
        let origin = &self.origins[seat.link as usize];
        let [position, velocity, _] = child.point(origin);
        let link = &self.links[seat.link as usize];
        match link.kind {
            LinkKind::Free => {
                let (z, v) = (&mut state.z[link.z as usize..], &mut state.v[link.v as usize..]);
                let rotation = S::rotation_from(&child.rotation);
                S::write_rotation(&rotation, z);
                orient::<T, S>(&child.rotation, turned(&seat.branch, values), z);
                if S::DIMENSION == 2 {
                    z[0] = unwrap(z[0], turned(&seat.branch, values)[2]);
                }
                let spin = S::spin_from(&child.omega);
                own(write(&S::unrotate_spin(&rotation, &spin), v, 0));
                let place = S::FREE - S::Point::N;
                own(write(&S::point_from(&(position - self.base)), z, place));
                own(write(&S::point_from(&velocity), v, S::Spin::N));
            }
            LinkKind::Revolute
            | LinkKind::Prismatic
            | LinkKind::Ball
            | LinkKind::GuidedRevolute
            | LinkKind::GuidedPrismatic
            | LinkKind::GuidedBall => {
                let [hold, hold_rate, _] = parent.point(origin);
                let gap = [position - hold, velocity - hold_rate];
                let is_guided = link.kind.is_guided();
                let chain = parts(scene, &seat.branch, is_guided);
                if !is_guided {
                    self.read_chain(seat, &chain, (&parent, &child, gap), values, state);
                }
            }
        }
    }

    /// Computes the angles and slides of a joint that consists of several parts, from the parent to the child.
    fn read_chain(
        &self,
        seat: &TreePlace,
        chain: &[Part<T>],
        (parent, child, [gap, gap_rate]): (&RigidMotion<T>, &RigidMotion<T>, [Vector<T, 3>; 2]),
        values: &[T],
        state: &mut TreeState<T>,
    ) {
        let mut rotation: Matrix<T, 3> = parent.rotation;
        let turning = child.omega - parent.omega;
        let turns: Vec<usize> =
            (0..chain.len()).filter(|&k| chain[k].kind == LinkKind::Revolute).collect();
        let mut axes = vec![Vector::<T, 3>::zeros(); chain.len()];
        for (k, part) in chain.iter().enumerate() {
            let at = seat.first as usize + k;
            let z = &mut state.z[self.links[at].z as usize];
            axes[k] = rotation * part.axis;
            if part.kind == LinkKind::Revolute {
                // The angle is measured by the rotation of one direction about the axis. The direction is the next revolute axis, because
                // later parts do not rotate it about this axis. Without a next revolute axis, any direction across the axis is used.
                let next = turns.iter().find(|&&j| j > k).map(|&j| chain[j].axis);
                let shown = next.unwrap_or_else(|| across(&part.axis));
                let v = shown - part.axis * part.axis.dot(&shown);
                let w = cross(&part.axis, &v);
                let seen = rotation.transpose() * (child.rotation * shown);
                *z = unwrap(w.dot(&seen).atan2(v.dot(&seen)), values[part.number]);
                rotation *= mbs_core::algebra::rotation(&(part.axis * *z));
            } else if part.kind == LinkKind::Ball {
                let relative = rotation.transpose() * child.rotation;
                let z = &mut state.z[self.links[at].z as usize..];
                S::write_rotation(&S::rotation_from(&relative), z);
                orient::<T, S>(&relative, turned(&seat.branch, values), z);
                rotation = child.rotation;
            } else {
                *z = gap.dot(&axes[k]);
            }
        }
        // Rates: first the rates of the revolute parts from ω = Σ n z', then the rates of the slides, in the frame that carries the slides.
        let mut rates = vec![T::ZERO; chain.len()];
        match turns[..] {
            [j] => rates[j] = turning.dot(&axes[j]),
            [i, j] => {
                let c = axes[i].dot(&axes[j]);
                let [x, y] = [i, j].map(|k| turning.dot(&axes[k]));
                let scale = T::ONE / (T::ONE - c * c);
                (rates[i], rates[j]) = ((x - c * y) * scale, (y - c * x) * scale);
            }
            _ => {}
        }
        let mut spin = parent.omega;
        for (k, part) in chain.iter().enumerate() {
            let v = &mut state.v[self.links[seat.first as usize + k].v as usize..];
            if part.kind == LinkKind::Ball {
                // A joint with a ball has no revolute part, but may have slides.
                let own = child.rotation.transpose() * turning;
                crate::build::own_tables::own(write(&S::spin_from(&own), v, 0));
                spin = child.omega;
                continue;
            }
            if part.kind == LinkKind::Revolute {
                spin += axes[k] * rates[k];
            } else {
                rates[k] = (gap_rate - cross(&spin, &gap)).dot(&axes[k]);
            }
            v[0] = rates[k];
        }
    }

    /// Writes one motion for each of the scene's bodies.
    ///
    /// Cost: two outward passes; no allocation.
    ///
    /// # Panics
    /// If `motions` has fewer entries than the scene has bodies.
    pub fn write_motions(
        &self,
        state: &TreeState<T>,
        workspace: &mut Workspace<T, S>,
        motions: &mut [RigidMotion<T>],
    ) {
        let s = workspace.store();
        self.prescribed.write(state.t, &state.applied, s.guides, s.courses);
        own(kinematics(&self.links, (&state.z, &state.v, s.guides), s.placed));
        s.a[0] = S::Motion::zero();
        own(inverse::spread(&self.links, s.placed, &state.a, s.a));
        for (to, &link) in motions.iter_mut().zip(&self.link_of_body) {
            let link = link as usize;
            let (p, a): (&LinkMotion<T, S>, _) = (&s.placed[link], &s.a[link]);
            *to = RigidMotion {
                origin: self.origins[link],
                position: S::point_into(&p.position) + lifted::<T, S>(&self.base),
                rotation: S::rotation_into(&p.rotation),
                omega: S::spin_into(&S::spin(&p.velocity)),
                velocity: S::point_into(&S::point(&p.velocity)),
                angular_acceleration: S::spin_into(&S::spin(a)),
                acceleration: S::point_into(&S::point(a)),
            };
        }
    }

    /// Returns the number of independent equations of the loops at a state. The mechanism has [`n_freedoms`](Self::n_freedoms) minus this
    /// number of freedoms.
    ///
    /// # Errors
    /// [`StepError`] if the accelerations cannot be evaluated at the state.
    pub fn rank(
        &self,
        state: &TreeState<T>,
        workspace: &mut Workspace<T, S>,
    ) -> Result<usize, StepError> {
        /// Regularisation of the rows when the rank is determined, in units of machine precision [-]. Chosen, not tuned.
        const SHARP: f64 = 256.0;
        let m = self.mechanism();
        let options = Options { closure: Closure::Constraints, ..Options::default() };
        // The pivot of a redundant row is ε times the sum of squared weights of the rows that it depends on. The weights may be in the
        // thousands, so ε must be small.
        let regularisation = T::EPSILON * T::from_f64(SHARP);
        let sharp = Options { regularisation, ..options };
        let mut s = workspace.store();
        s.z.copy_from_slice(&state.z);
        s.v.copy_from_slice(&state.v);
        self.prescribed.write(state.t, &state.applied, s.guides, s.courses);
        own(s.begin_signals(T::ZERO, &state.signals));
        if accelerations(&m, &sharp, Level::Once, &mut s).is_err() {
            accelerations(&m, &options, Level::Once, &mut s).map_err(|fault| failure(&m, fault))?;
        }
        let least = T::EPSILON.sqrt();
        let counted = s.loops.pivots.iter().filter(|&&pivot| pivot > least).count();
        // the rank is at most the number of freedoms
        Ok(counted.min(self.n_freedoms()))
    }
}

/// Returns the rotation vector of a branch's child relative to its parent. It consists of the last coordinates of the joint, with opposite
/// sign if the joint is reversed.
fn turned<T: Real>(branch: &Branch, values: &[T]) -> Vector<T, 3> {
    let sign = if branch.is_reversed { -T::ONE } else { T::ONE };
    let mut last = Vector::<T, 3>::zeros();
    last.iter_mut().rev().zip(values.iter().rev()).for_each(|(to, x)| *to = *x * sign);
    last
}

/// Returns a vector in which the components that do not exist in this space are zero.
fn lifted<T: Real, S: Space<T>>(x: &Vector<T, 3>) -> Vector<T, 3> {
    S::point_into(&S::point_from(x))
}

/// Chooses the sign of the quaternion in `z`, so that its rotation vector is the one nearest to `last`. The scalar part is negative if the
/// angle of this rotation vector is above half a turn.
fn orient<T: Real, S: Space<T>>(rotation: &Matrix<T, 3>, last: Vector<T, 3>, z: &mut [T]) {
    let Some((q, _)) = z.split_first_chunk_mut::<4>().filter(|_| S::DIMENSION == 3) else { return };
    let w = unwrap_rotation(&rotation_vector(rotation), &last);
    let is_over = w.dot(&w).sqrt() > T::PI;
    if (q[0] < T::ZERO) != is_over {
        q.iter_mut().for_each(|x| *x = -*x);
    }
}

//! Evaluations of a tree at a state: accelerations, new inputs, energies, reactions.

use crate::build::own_tables::own;
use crate::build::tree::{TreeModel, TreePlace};
use crate::host::state::{TreeState, Workspace};
use crate::link::indexing::Outside;
use crate::link::options::Options;
use crate::passes::energy_balance;
use crate::passes::evaluate::{Level, accelerations, evaluate_rows};
use crate::passes::failure::failure;
use crate::passes::feedback::follow_motion;
use crate::passes::inverse;
use crate::passes::slices::{Inputs, Store, TreeSlices};
use crate::passes::{kinematics, rotor};
use crate::rows::Row;
use crate::space::{Numbers, Space};
use mbs_core::Real;
use mbs_core::algebra::{Vector, cross};
use mbs_core::step::StepError;

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Evaluates accelerations and multipliers of a state at its coordinates and velocities, without projection.
    ///
    /// Cost: one evaluation; no allocation.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    pub fn accelerate(
        &self,
        options: &Options<T>,
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
    ) -> Result<(), StepError> {
        let m = self.mechanism();
        let mut s = workspace.store();
        s.z.copy_from_slice(&state.z);
        s.v.copy_from_slice(&state.v);
        self.inputs(state).evaluate(state.t, s.guides, s.courses);
        own(s.begin_signals(T::ZERO, &state.signals));
        accelerations(&m, options, Level::Fine, &mut s).map_err(|fault| failure(&m, fault))?;
        state.set_accelerations(s.zdd);
        state.lambda.copy_from_slice(s.lambda);
        state.signals.copy_from_slice(s.signals.ends);
        Ok(())
    }

    /// Applies inputs that were set since the last step: evaluates accelerations, multipliers and power with the new inputs. Returns true
    /// if an input has changed. New inputs may change the energy stored in springs; this change is counted as work. Every step begins with
    /// this call. A caller that may return to the state before a step calls this function before it copies the state.
    ///
    /// Cost: nothing if no input changed, otherwise one evaluation; no allocation.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    pub fn take_inputs(
        &self,
        options: &Options<T>,
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
    ) -> Result<bool, StepError> {
        if !self.prescribed.differs(&state.inputs, &state.applied) {
            return Ok(false);
        }
        self.take_loads(options, state, workspace, state.t)?;
        Ok(true)
    }

    /// Replaces the accelerations before the jump of a signal by the accelerations after the jump, at time `to` [s].
    ///
    /// Cost: one evaluation; no allocation.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    pub fn pass_jump(
        &self,
        options: &Options<T>,
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
        to: T,
    ) -> Result<(), StepError> {
        self.take_loads(options, state, workspace, to)?;
        state.t = to;
        Ok(())
    }

    /// Evaluates a state with the loads of the inputs that are set now, at time `to` [s].
    fn take_loads(
        &self,
        options: &Options<T>,
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
        to: T,
    ) -> Result<(), StepError> {
        let m = self.mechanism();
        let mut s = workspace.store();
        self.place_in(state, &mut s);
        let before = own(energy_balance::potential(&m, &s.instant(&m)));
        let at_end = (&state.applied[..], &state.inputs[..]);
        self.prescribed.write_end(to, at_end, (s.guides, s.courses));
        own(s.begin_signals(T::ZERO, &state.signals));
        accelerations(&m, options, Level::Fine, &mut s).map_err(|fault| failure(&m, fault))?;
        let after = own(energy_balance::potential(&m, &s.instant(&m)));
        state.power = own(energy_balance::power(&m, &mut s));
        state.work += after - before;
        for ((aux, a), &new) in state.a_aux.iter_mut().zip(&mut state.a).zip(&*s.zdd) {
            *aux = if aux == a { new } else { new + (*aux - *a) };
            *a = new;
        }
        state.lambda.copy_from_slice(s.lambda);
        state.signals.copy_from_slice(s.signals.ends);
        self.prescribed.apply(&state.inputs, &mut state.applied);
        Ok(())
    }

    /// Kinetic and potential energy of a state [J].
    ///
    /// Cost: one outward pass; no allocation.
    pub fn energies(&self, state: &TreeState<T>, workspace: &mut Workspace<T, S>) -> [T; 2] {
        let m = self.mechanism();
        let mut s = workspace.store();
        self.place_in(state, &mut s);
        let rotors = own(kinetic(&m, (s.v, s.guides)));
        [
            energy_balance::kinetic(m.links, s.placed) + rotors,
            own(energy_balance::potential(&m, &s.instant(&m))),
        ]
    }

    /// Copies a state into the scratch and places the links.
    pub(crate) fn place_in(&self, state: &TreeState<T>, s: &mut Store<'_, T, S>) {
        s.z.copy_from_slice(&state.z);
        s.v.copy_from_slice(&state.v);
        s.lambda.copy_from_slice(&state.lambda);
        self.prescribed.write(state.t, &state.applied, s.guides, s.courses);
        own(kinematics(&self.links, (s.z, s.v, s.guides), s.placed));
        own(s.begin_signals(T::ZERO, &state.signals));
        own(follow_motion(&self.mechanism(), s));
    }

    /// Copies a state with its accelerations into the scratch and evaluates the forces through all joints.
    fn balance(&self, state: &TreeState<T>, s: &mut Store<'_, T, S>) {
        let m = self.mechanism();
        self.place_in(state, s);
        s.a[0] = S::motion(S::Spin::zero(), -m.gravity);
        own(inverse::spread(m.links, s.placed, &state.a, s.a));
        own(evaluate_rows(&m, s));
        own(inverse::forces(&m, s));
        own(rotor::add_efforts(&m, (&state.a, s.guides), s.condensed));
    }

    /// Writes the reaction of each joint: force [N] and moment [N m] of the first body on the second, in global axes. The moment is about
    /// the joint's point on the second body. Forces of guides are included; effects along the joint are not included. Reactions of welds
    /// and free joints are zero. If rows of loops are redundant, the multipliers are those of least norm.
    ///
    /// Cost: an outward and an inward pass; no allocation.
    ///
    /// # Panics
    /// If `out` has fewer entries than the scene has joints.
    pub fn reactions(
        &self,
        state: &TreeState<T>,
        workspace: &mut Workspace<T, S>,
        out: &mut [[Vector<T, 3>; 2]],
    ) {
        let mut s = workspace.store();
        self.balance(state, &mut s);
        out.fill([Vector::zeros(); 2]);
        for seat in &self.seats {
            let Some(joint) = seat.branch.joint else { continue };
            let link = seat.link as usize;
            if self.links[link].kind == crate::link::LinkKind::Free {
                continue;
            }
            let through = s.condensed[link].force - along(seat, &s);
            let force = S::point_into(&S::point(&through));
            let moment = S::spin_into(&S::spin(&through));
            // The wrench acts on the child, about the child's origin, which is the joint's point. For a reversed joint it acts on the
            // parent, about the joint's point on the parent.
            out[joint] = if seat.branch.is_reversed {
                let apart = s.placed[link].position - self.parent_place(seat, &s);
                let arm = S::point_into(&apart);
                [-force, -(moment + cross(&arm, &force))]
            } else {
                [force, moment]
            };
        }
        let n = self.rows.len();
        for lap in self.mechanism().loops.cut() {
            let (joint, second) = (lap.joint as usize, lap.links[1] as usize);
            let mut total = S::Motion::zero();
            for k in lap.first as usize..(lap.first + lap.n) as usize {
                total -= s.gradient[n + k] * s.lambda[k];
            }
            let arm = S::rotate(&s.placed[second].rotation, &lap.points[1]);
            let total = S::gathered(&total, &-arm);
            out[joint] = [S::point_into(&S::point(&total)), S::spin_into(&S::spin(&total))];
        }
    }

    /// Returns the effort of `scene.couplings[coupling]`. The effort times a coordinate's factor is the force along this coordinate [N m or
    /// N, per unit of the factor]. Returns `None` for a coupling whose joints are all guided.
    #[must_use]
    pub fn coupling_effort(&self, state: &TreeState<T>, coupling: usize) -> Option<T> {
        let (_, coupled) = self.loops.split_at_checked(self.couplings.n_cut as usize)?;
        let lap = coupled.iter().find(|lap| lap.joint as usize == coupling)?;
        let row = lap.first as usize;
        let Some(Row::Coupled(of)) = self.rows.get(row) else { return None };
        Some(-*state.lambda.get(row)? * of.inverse)
    }

    /// Returns the position of the joint's point on the parent, relative to the base of the tree [m].
    fn parent_place(&self, seat: &TreePlace, s: &Store<'_, T, S>) -> S::Point {
        let first = &self.links[seat.first as usize];
        let parent = &s.placed[first.parent as usize];
        parent.position + S::rotate(&parent.rotation, &first.offset)
    }
}

/// Returns the kinetic energy of the rotors [J].
fn kinetic<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    (v, guides): (&[T], &[[T; 3]]),
) -> Result<T, Outside> {
    let mut twice = T::ZERO;
    for rotor in m.rotors {
        let rate = rotor::of_link(m.links, rotor.link, v, (guides, 1))?;
        twice += rotor.inertia * rate * rate;
    }
    Ok(twice * T::HALF)
}

/// Returns the wrench of effects and rotors along a joint's coordinates. The wrench acts on the joint's last link, about the origin of this
/// link.
fn along<T: Real, S: Space<T>>(place: &TreePlace, s: &Store<'_, T, S>) -> S::Motion {
    let mut sum = S::Motion::zero();
    for link in place.first as usize..=place.link as usize {
        let p = &s.placed[link];
        sum = S::gathered(&sum, &-p.arm) + p.freedom * s.condensed[link].effort;
    }
    sum
}

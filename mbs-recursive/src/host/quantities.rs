//! Equations of motion of a tree at any state, as matrices and efforts. Effects are included on request only.
//!
//! ```text
//! M v̇ + c + g = τ + Jᵀ λ,   J v̇ + J̇ v = 0        g: gravity,   c: velocity products and motion of guided joints
//! τ = bᵀ f                                        by the passes of `inverse`
//! ```

use crate::build::TreeModel;
use crate::build::own_tables::own;
use crate::host::state::{TreeState, Workspace};
use crate::host::under_efforts::accelerations_under;
use crate::link::options::Options;
use crate::loops::Loops;
use crate::passes::evaluate::Level;
use crate::passes::failure::failure;
use crate::passes::inverse;
use crate::passes::slices::TreeSlices;
use crate::passes::{kinematics, rotor};
use crate::space::{Numbers, Space};
use core::ops::Range;
use mbs_core::Real;
use mbs_core::step::StepError;

/// Selection of terms of the efforts M v̇ + c + g.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EffortTerms {
    /// All terms minus the efforts of effects. The result is zero if the accelerations are those of the free motion.
    WithEffects,
    /// All terms, without effects.
    WithoutEffects,
    /// Gravity g alone, at zero velocity.
    Gravity,
    /// Inertia M v̇ alone, at zero velocity and without gravity.
    Inertia,
}

/// Links of one joint of the tree, or of a free body without a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct JointLinks<T> {
    /// Index of the joint: `scene.joints[joint]`; `None` for a free body without a joint.
    pub joint: Option<usize>,
    /// Index of the body that the joint carries. If several welded bodies are carried, this is the first of them.
    pub body: usize,
    /// Links of the joint from the parent to the child, one for each freedom. A ball or a free joint has one link.
    pub links: Range<usize>,
    /// True if the parent is the joint's second body. The links are then in reverse order of the joint's coordinates.
    pub is_reversed: bool,
    /// The origin of the last link in the reference configuration [m].
    pub origin: [T; 3],
}

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Returns the joints of the tree with their links, parents first. Cut joints are not included.
    pub fn joint_links(&self) -> impl Iterator<Item = JointLinks<T>> + '_ {
        self.seats.iter().map(|seat| JointLinks {
            joint: seat.branch.joint,
            body: self.clusters.clusters[seat.branch.cluster].bodies[0],
            links: seat.first as usize..seat.link as usize + 1,
            is_reversed: seat.branch.is_reversed,
            origin: self.origins[seat.link as usize].into(),
        })
    }

    /// Writes the efforts along all freedoms that cause the accelerations `a` of the state, with all loops open [N m for angles, N for
    /// slides].
    ///
    /// Cost: two outward passes and an inward one; no allocation.
    ///
    /// # Panics
    /// If the length of `efforts` is not the number of freedoms.
    pub fn write_efforts(
        &self,
        (state, terms): (&TreeState<T>, EffortTerms),
        workspace: &mut Workspace<T, S>,
        efforts: &mut [T],
    ) {
        let none = Loops { loops: &[], rows: &[], ..self.mechanism().loops };
        let loads = match terms {
            EffortTerms::WithEffects => &self.loads[..],
            EffortTerms::WithoutEffects | EffortTerms::Gravity => self.weights(),
            EffortTerms::Inertia => &[],
        };
        let m = TreeSlices { loads, loops: none, ..self.mechanism() };
        let mut s = workspace.store();
        self.place_in(state, &mut s);
        s.a[0] = S::motion(S::Spin::zero(), -m.gravity);
        if matches!(terms, EffortTerms::Gravity | EffortTerms::Inertia) {
            s.v.fill(T::ZERO);
            s.guides.iter_mut().for_each(|[_, rate, second]| (*rate, *second) = (T::ZERO, T::ZERO));
            own(kinematics(m.links, (s.z, s.v, s.guides), s.placed));
        }
        if terms == EffortTerms::Inertia {
            s.a[0] = S::Motion::zero();
        }
        // The velocities `s.v` are zero in this case. Used as accelerations too, they give the efforts of gravity alone.
        let a = if terms == EffortTerms::Gravity { &*s.v } else { &state.a };
        own(inverse::spread(m.links, s.placed, a, s.a));
        own(inverse::forces(&m, &mut s));
        let a = if terms == EffortTerms::Gravity { &*s.v } else { &state.a };
        own(rotor::add_efforts(&m, (a, s.guides), s.condensed));
        for (i, link) in self.links.iter().enumerate().skip(1) {
            if !link.kind.is_guided() {
                let out = &mut efforts[link.v as usize..];
                own(inverse::effort(link, &s.placed[i], &s.condensed[i], out));
            }
        }
    }

    /// Evaluates accelerations and multipliers of a state under given efforts along the freedoms and gravity, without effects.
    ///
    /// Cost: one evaluation; no allocation.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    ///
    /// # Panics
    /// If there are fewer efforts than freedoms.
    pub fn accelerate_under(
        &self,
        efforts: &[T],
        state: &mut TreeState<T>,
        workspace: &mut Workspace<T, S>,
    ) -> Result<(), StepError> {
        let m = TreeSlices { loads: self.weights(), ..self.mechanism() };
        let mut s = workspace.store();
        s.z.copy_from_slice(&state.z);
        s.v.copy_from_slice(&state.v);
        self.prescribed.write(state.t, &state.applied, s.guides, s.courses);
        let level = Level::Fine;
        let left = accelerations_under(&m, &Options::default(), (level, efforts), &mut s);
        left.map_err(|fault| failure(&m, fault))?;
        state.set_accelerations(s.zdd);
        state.lambda.copy_from_slice(s.lambda);
        Ok(())
    }
}

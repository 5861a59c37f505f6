//! [`NaturalModel`]: elements of each kind in contiguous arrays, collected in groups.

use super::basis::Basis;
use super::coordinate_sets::CoordinateSet;
use super::forces::{BodyTorque, MeasureElement, PointForce};
use super::group::Group;
use super::incidence::Incidence;
use super::on_body::BodyElement;
use crate::Real;
use crate::algebra::{Coef, Vector};
use crate::blocks::Cliques;
use crate::cluster::Clusters;
use crate::effects::action::Tables;
use crate::elements::{
    Coupled, CoupledTerm, Distance, Dot, Guided, Linear, RollingRows, Signed, Span, Term,
};
use crate::inputs::{Feedback, Prescribed};
use crate::laws::code::Codes;
use crate::measure::PreparedCurve;
use crate::model::Owner;
use alloc::vec::Vec;

/// Mechanism in natural coordinates of D dimensions: shared points and unit vectors, constant mass matrix.
///
/// Built from a scene by [`NaturalModel::new`](Self::new), and constant afterwards.
#[derive(Debug, Clone)]
pub struct NaturalModel<T: Real, const D: usize> {
    pub(super) n_unknowns: usize,
    pub(super) n_rows: usize,
    pub(super) n_jacobian: usize,
    /// Extended coordinates (unknowns, then constants) of the reference configuration.
    pub(super) reference: Vec<T>,
    /// Gravity and constant forces on the extended coordinates, with the potential V = -weight.q.
    pub(super) weight: Vec<T>,
    pub(super) pool: Vec<Term<T>>,
    pub(super) distances: Vec<Distance<T>>,
    pub(super) dots: Vec<Dot<T>>,
    pub(super) linears: Vec<Linear>,
    pub(super) guided: Vec<Guided>,
    pub(super) coupled: Vec<Coupled<T>>,
    pub(super) rollings: Vec<RollingRows<T>>,
    /// Unknowns that the rows of each rolling use.
    pub(super) rolling_cliques: Vec<Span>,
    pub(super) coupled_terms: Vec<CoupledTerm<T>>,
    pub(super) coupled_measures: Vec<Signed<T>>,
    pub(super) curves: Vec<PreparedCurve<T>>,
    /// Joint and coordinate number, sign, and place in the memory of each angle that couplings remember.
    pub(super) coupled_angles: Vec<((usize, usize), T, u32)>,
    /// Measures of the motion that signals use; `feedback` has the operations that compute the signals from them.
    pub(super) measured: Vec<Signed<T>>,
    /// Spans of measures: the sum of a span's measures is one measured number of a signal.
    pub(super) measured_numbers: Vec<Span>,
    pub(super) feedback: Feedback<T>,
    pub(super) rotors: Vec<NaturalRotor<T>>,
    pub(super) groups: Vec<Group>,
    pub(super) slots: Vec<u32>,
    pub(super) cliques: Vec<u32>,
    pub(super) mass: Vec<Coef<T>>,
    pub(super) blocks: Vec<T>,
    /// Constant parts of the force store.
    pub(super) constant_force: Vec<T>,
    pub(super) measures: Vec<MeasureElement<T>>,
    pub(super) body_elements: Vec<BodyElement<T>>,
    /// Number of measures of all laws; the measures of laws on one body come last.
    pub(super) n_measures: usize,
    pub(super) tables: Tables<T>,
    pub(super) prescribed: Prescribed<T>,
    pub(super) n_memory: usize,
    /// Owner and place of each remembered angle, in the order of the effects.
    pub(super) angles: Vec<(Owner, u32)>,
    /// Number of the first of the three measures of each rotation in space, with its owner.
    pub(super) rotations: Vec<(u32, Owner)>,
    /// Numbers of the measures of sums that have lines or twists, each with its owner.
    pub(super) lines: Vec<(u32, Owner)>,
    pub(super) point_forces: Vec<PointForce>,
    pub(super) torques: Vec<BodyTorque>,
    pub(super) row_owner: Vec<Owner>,
    /// Entities that each row uses.
    pub(super) coordinate_sets: Vec<CoordinateSet>,
    pub(super) unknown_owner: Vec<Owner>,
    pub(super) clusters: Clusters<T>,
    pub(super) bases: Vec<Basis<T>>,
    /// First extended coordinate of each entity of the builder.
    pub(super) entity_at: Vec<u32>,
    /// Unknown entities, each with one body that has it.
    pub(super) carried: Vec<Carried<T>>,
    /// The scene's length [m].
    pub(super) length: T,
    pub(super) incidence: Incidence,
    /// Cursors at the beginning of each part, and at the end.
    pub(super) cursors: Vec<Cursor>,
    /// True if the residual of every group fits on the stack.
    pub(super) is_small: bool,
    /// True if the model is one dense group with all unknowns in their order.
    pub(super) is_whole: bool,
}

impl<T: Real, const D: usize> Cliques for NaturalModel<T, D> {
    fn n_unknowns(&self) -> usize {
        self.n_unknowns
    }
    fn n_elements(&self) -> usize {
        self.groups.len()
    }
    #[inline(always)]
    fn clique(&self, element: usize) -> &[u32] {
        self.groups[element].clique.of(&self.cliques)
    }
}

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Length of the scene [m], to which tolerances are relative.
    pub fn length(&self) -> T {
        self.length
    }

    /// Prescribed motions of guides, signals and effects. They name the places of a state's inputs, and set them.
    #[must_use]
    pub fn prescribed(&self) -> &Prescribed<T> {
        &self.prescribed
    }

    /// User-defined laws that are objects.
    #[must_use]
    pub fn codes(&self) -> &Codes {
        self.tables.codes()
    }

    /// Number of constraint elements of each kind: (distance, dot product, linear, guided).
    #[must_use]
    pub fn n_elements_by_kind(&self) -> [usize; 4] {
        [self.distances.len(), self.dots.len(), self.linears.len(), self.guided.len()]
    }
}

/// A rotor in the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NaturalRotor<T> {
    /// Index of the rotor in `scene.effects`.
    pub effect: usize,
    /// Unknown of the rotor, which equals the joint's coordinate.
    pub unknown: usize,
    /// Inertia of the rotor at the joint [kg m^2; for a slide kg].
    pub inertia: T,
    /// Place of the joint's coordinate in the table of coupling measures.
    pub(super) measure: usize,
}

/// Unknown entity, with one of the bodies that have it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Carried<T: Real> {
    /// First coordinate of the entity.
    pub(super) at: u32,
    /// Index of the body.
    pub(super) body: usize,
    pub(super) is_point: bool,
    pub(super) reference: Vector<T, 3>,
}

impl<T: Real> Carried<T> {
    /// First coordinate of the entity if it is a point; `None` for a direction.
    pub(super) fn point(&self) -> Option<usize> {
        self.is_point.then_some(self.at as usize)
    }
}

/// Place in every table at which a group begins.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Cursor {
    pub(super) group: usize,
    pub(super) row: usize,
    pub(super) jacobian: usize,
    pub(super) force: usize,
    pub(super) distance: usize,
    pub(super) dot: usize,
    pub(super) linear: usize,
    pub(super) guided: usize,
    pub(super) coupled: usize,
    pub(super) rolling: usize,
    pub(super) measure: usize,
    pub(super) body_element: usize,
    pub(super) body_measure: usize,
    pub(super) point_force: usize,
    pub(super) torque: usize,
}

//! Last pass of construction, which numbers the coordinates and fills the tables of a [`NaturalModel`].

use super::basis::Combination;
use super::build::Builder;
use super::coordinate_sets::CoordinateSet;
use super::element::{DENSE, ROOM};
use super::group::{Group, index, packed};
use super::incidence::Incidence;
use super::merge::merged;
use super::model::NaturalModel;
use super::motion::carriers;
use super::row_builder::{GroupDraft, RowDraft};
use super::sharing::Entity;
use crate::Real;
use crate::algebra::{Coef, Vector};
use crate::cluster::Clusters;
use crate::effects::action::Actions;
use crate::elements::{Coupled, Distance, Dot, Guided, GuidedMotion, Linear, NONE, Span, Term};
use crate::inputs::Feedback;
use crate::model::Owner;
use alloc::vec;
use alloc::vec::Vec;

/// Numbers the coordinates and fills the tables of the model.
pub(super) fn layout<T: Real, const D: usize>(
    builder: Builder<'_, T>,
    actions: Actions<T>,
    feedback: Feedback<T>,
) -> NaturalModel<T, D> {
    let Builder { entities, groups, measured, rotors, clusters, bases, shared, length, .. } =
        builder;
    let owners = owners(&groups, &entities);
    let groups = merged(groups, &entities, D);
    let mut layout = Layout::<T, D>::new((entities, &owners), &groups, (clusters, length), actions);
    for group in layout.near_their_bodies(&groups) {
        layout.add(group);
    }
    for draft in &measured {
        layout.add_measured(draft);
    }
    let mut model = layout.model;
    model.feedback = feedback;
    number_measures(&mut model);
    model.angles.sort_by_key(|&(owner, _)| effect_of(owner));
    model.cursors = model.cursors();
    model.incidence = Incidence::of::<D>(&model.groups, &model.slots, &model.coordinate_sets);
    model.is_whole = is_whole(&model);
    model.is_small = model.groups.iter().all(|g| g.clique.len() <= ROOM);
    let owners = (&model.clusters, bases.as_slice(), shared.as_slice());
    model.carried = carriers(&layout.entities, owners, &model.entity_at);
    model.bases = bases;
    model.place_rotors(&rotors);
    model
}

pub(super) struct Layout<T: Real, const D: usize> {
    pub(super) model: NaturalModel<T, D>,
    entities: Vec<Entity<T>>,
    /// Spans of the distinct masses (G) and mass blocks that the tables have so far.
    masses: Vec<(Span, Span)>,
}

/// Number of latest masses that are searched for an equal one [-], so that equal bodies read one cached copy. Chosen, not tuned.
const RECENT: usize = 16;

/// Entities of a group, in the order of the columns of its Jacobian rows.
pub(super) struct Columns<'a> {
    pub(super) slots: &'a [usize],
}

impl Columns<'_> {
    pub(super) fn of(&self, entity: usize) -> usize {
        self.slots.iter().position(|&s| s == entity).unwrap_or(usize::MAX)
    }
}

impl<T: Real, const D: usize> Layout<T, D> {
    /// Order of the entities: unknown ones first, in the order in which the groups use them, then constants. Also returns the place
    /// of each entity.
    fn order(entities: &[Entity<T>], groups: &[GroupDraft<T>]) -> (Vec<usize>, Vec<u32>) {
        let mut entity_at = vec![u32::MAX; entities.len()];
        let mut order = Vec::new();
        let used = groups.iter().flat_map(|group| group.slots(entities));
        let unknown = used.filter(|&e| !entities[e].is_constant);
        for e in unknown.chain((0..entities.len()).filter(|&e| entities[e].is_constant)) {
            if entity_at[e] == u32::MAX {
                entity_at[e] = index(order.len() * D);
                order.push(e);
            }
        }
        (order, entity_at)
    }

    /// Model with its coordinates, to which no group has been added.
    fn new(
        (entities, owners): (Vec<Entity<T>>, &[Owner]),
        groups: &[GroupDraft<T>],
        (clusters, length): (Clusters<T>, T),
        actions: Actions<T>,
    ) -> Self {
        let (order, entity_at) = Self::order(&entities, groups);
        let unknown = |&&e: &&usize| !entities[e].is_constant;
        let unknown_owner: Vec<_> = order.iter().filter(unknown).map(|&e| owners[e]).collect();
        let n_unknowns = unknown_owner.len() * D;
        let at = |&e: &usize| entities[e].at.iter().copied().take(D);
        let reference: Vec<T> = order.iter().flat_map(at).collect();
        let model = NaturalModel {
            n_unknowns,
            n_rows: 0,
            n_jacobian: 0,
            weight: vec![T::ZERO; reference.len()],
            reference,
            pool: Vec::new(),
            distances: Vec::new(),
            dots: Vec::new(),
            linears: Vec::new(),
            guided: Vec::new(),
            coupled: Vec::new(),
            rollings: Vec::new(),
            rolling_cliques: Vec::new(),
            coupled_terms: Vec::new(),
            coupled_measures: Vec::new(),
            curves: Vec::new(),
            coupled_angles: Vec::new(),
            measured: Vec::new(),
            measured_numbers: Vec::new(),
            feedback: Feedback::default(),
            rotors: Vec::new(),
            groups: Vec::new(),
            slots: Vec::new(),
            cliques: Vec::new(),
            mass: Vec::new(),
            blocks: Vec::new(),
            constant_force: Vec::new(),
            measures: Vec::new(),
            body_elements: Vec::new(),
            n_measures: 0,
            tables: actions.tables,
            prescribed: actions.prescribed,
            n_memory: 0,
            angles: Vec::new(),
            rotations: Vec::new(),
            lines: Vec::new(),
            point_forces: Vec::new(),
            torques: Vec::new(),
            row_owner: Vec::new(),
            coordinate_sets: Vec::new(),
            unknown_owner,
            clusters,
            bases: Vec::new(),
            entity_at,
            carried: Vec::new(),
            length,
            incidence: Incidence::default(),
            cursors: Vec::new(),
            is_small: false,
            is_whole: false,
        };
        Self { model, entities, masses: Vec::new() }
    }

    /// Groups in the order of the last unknown that each one uses. Joints and effects then follow the bodies that they act on. A
    /// pass over all groups then reads neighbouring memory.
    fn near_their_bodies<'a>(&self, groups: &'a [GroupDraft<T>]) -> Vec<&'a GroupDraft<T>> {
        let last = |group: &GroupDraft<T>| {
            let unknown = |&e: &usize| !self.entities[e].is_constant;
            let places = group.slots(&self.entities).into_iter().filter(unknown);
            places.map(|e| self.model.entity_at[e]).max()
        };
        let mut order: Vec<_> = groups.iter().collect();
        order.sort_by_cached_key(|group| last(group));
        order
    }

    fn add(&mut self, draft: &GroupDraft<T>) {
        let slots = draft.slots(&self.entities);
        let n_unknown = slots.iter().filter(|&&e| !self.entities[e].is_constant).count();
        let columns = Columns { slots: &slots };
        self.add_weight(&draft.forces);
        if n_unknown == 0 {
            return;
        }
        let m = &mut self.model;
        let slot_span = extend(&mut m.slots, slots.iter().map(|&e| m.entity_at[e]));
        let unknowns = &slots[..n_unknown];
        let clique = extend(
            &mut m.cliques,
            unknowns
                .iter()
                .flat_map(|&e| (0..D).map(move |i| (e, i)))
                .map(|(e, i)| m.entity_at[e] + index(i)),
        );
        let mut group = Group {
            slots: slot_span,
            n_unknown: index(n_unknown),
            clique,
            rows: Span { start: index(m.n_rows), end: index(m.n_rows) },
            jacobian: index(m.n_jacobian),
            width: index(slots.len() * D),
            mass: Span::default(),
            is_mass_turned: false,
            block: Span::default(),
            force: Span::default(),
            distances: empty(m.distances.len()),
            dots: empty(m.dots.len()),
            measures: empty(m.measures.len()),
            has_body_law: false,
            owner: draft.owner,
        };
        for (k, row) in draft.rows.iter().enumerate() {
            if self.is_live(row) {
                let owner = draft.row_owners.get(k).copied().unwrap_or(draft.owner);
                self.add_row((row, owner), &columns, &group);
            }
        }
        self.add_mass(draft, unknowns, &mut group);
        self.add_forces(draft, &columns, n_unknown, &mut group);
        let m = &mut self.model;
        group.distances.end = index(m.distances.len());
        group.dots.end = index(m.dots.len());
        group.rows.end = index(m.n_rows);
        m.groups.push(group);
    }

    /// Adds gravity and constant forces to the weights, also those on constant entities, because their potential needs them.
    fn add_weight(&mut self, forces: &[(usize, Vector<T, 3>)]) {
        for (e, f) in forces {
            let at = self.model.entity_at[*e] as usize;
            for i in 0..D {
                self.model.weight[at + i] += f[i];
            }
        }
    }

    /// True if the row has unknowns. A row without unknowns constrains nothing.
    fn is_live(&self, row: &RowDraft<T>) -> bool {
        row.entities().iter().any(|&e| !self.entities[e].is_constant)
    }

    pub(super) fn span(&mut self, x: &Combination<T>, columns: &Columns<'_>) -> Span {
        let m = &mut self.model;
        extend(
            &mut m.pool,
            x.iter().map(|&(e, coef)| Term {
                entity: m.entity_at[e],
                column: index(columns.of(e) * D),
                coef,
            }),
        )
    }

    /// Reserves `n` rows and their part of the Jacobian store.
    fn claim(&mut self, n: usize, owner: Owner, group: &Group) -> (u32, Span) {
        let m = &mut self.model;
        let (row, start) = (m.n_rows, m.n_jacobian);
        m.n_rows += n;
        m.n_jacobian += n * group.width as usize;
        m.row_owner.extend(core::iter::repeat_n(owner, n));
        (index(row), Span { start: index(start), end: index(m.n_jacobian) })
    }

    fn add_row(
        &mut self,
        (draft, owner): (&RowDraft<T>, Owner),
        columns: &Columns<'_>,
        group: &Group,
    ) {
        let n = draft.n_rows(D);
        let (row, place) = self.claim(n, owner, group);
        let n_unknown = group.n_unknown as usize;
        let touched = draft.entities().into_iter().map(|e| columns.of(e));
        let reach = CoordinateSet::of(touched.filter(|&at| at < n_unknown), n_unknown, D);
        self.model.coordinate_sets.extend(core::iter::repeat_n(reach, n));
        match draft {
            RowDraft::Distance { ends, length } => {
                let at = |e: usize| place.start + index(columns.of(e) * D);
                let (ends, places) = (ends.map(|e| self.model.entity_at[e]), ends.map(at));
                let inverse = T::ONE / *length;
                self.model.distances.push(Distance { ends, places, row, length: *length, inverse });
            }
            RowDraft::Dot { x, y, scale, constant } => {
                let (x, y) = (self.span(x, columns), self.span(y, columns));
                let (scale, constant) = (*scale, *constant);
                self.model.dots.push(Dot { x, y, scale, constant, row, place });
            }
            RowDraft::Linear { x } => {
                let x = self.span(x, columns);
                self.model.linears.push(Linear { x, row, place });
            }
            RowDraft::GuidedAngle { x1, x2, y, guide } => {
                let (x1, x2) = (self.span(x1, columns), self.span(x2, columns));
                let y = self.span(y, columns);
                let motion = GuidedMotion::Angle { x1, x2 };
                self.model.guided.push(Guided { motion, y, guide: index(*guide), row, place });
            }
            RowDraft::GuidedSlide { x, y, guide } => {
                let (x, y) = (self.span(x, columns), self.span(y, columns));
                let motion = GuidedMotion::Slide { x };
                self.model.guided.push(Guided { motion, y, guide: index(*guide), row, place });
            }
            RowDraft::GuidedRotation { x, y, number, guide } => {
                let x = x.each_ref().map(|x| self.span(x, columns));
                let [y, other] = y.each_ref().map(|y| self.span(y, columns));
                let motion = GuidedMotion::Rotation { x, y: other, number: index(*number) };
                self.model.guided.push(Guided { motion, y, guide: index(*guide), row, place });
            }
            RowDraft::Coupled { terms, inverse, guide, form } => {
                let terms = self.coupled_terms(terms, columns);
                let guide = guide.map_or(NONE, index);
                let (inverse, form) = (*inverse, *form);
                self.model.coupled.push(Coupled { terms, inverse, guide, form, row, place });
            }
            RowDraft::Rolling(draft) => self.add_rolling(draft, (columns, group), (row, place)),
        }
    }

    /// Writes G of the unknown entities and the constant mass block. Equal masses use one entry.
    fn add_mass(&mut self, draft: &GroupDraft<T>, unknowns: &[usize], group: &mut Group) {
        let Some((basis, g)) = &draft.mass else { return };
        let nb = basis.len();
        let place = |e: usize| basis.iter().position(|&b| b == e);
        let k = unknowns.len() * D;
        let mut block = vec![T::ZERO; k * (k + 1) / 2];
        let mut coefs = Vec::with_capacity(unknowns.len() * unknowns.len());
        for (i, &ei) in unknowns.iter().enumerate() {
            for (j, &ej) in unknowns.iter().enumerate() {
                let c = match (place(ei), place(ej)) {
                    (Some(a), Some(b)) => g[a * nb + b],
                    _ => Coef::zero(),
                };
                coefs.push(c);
                if i >= j {
                    for a in 0..D {
                        for b in 0..D {
                            if i > j || a >= b {
                                block[packed(k, i * D + a, j * D + b)] = entry(c, a, b);
                            }
                        }
                    }
                }
            }
        }
        group.is_mass_turned = coefs.iter().any(|c| !c.im.is_zero());
        let m = &mut self.model;
        let is_like = |other: &&(Span, Span)| {
            other.0.of(&m.mass) == coefs.as_slice() && other.1.of(&m.blocks) == block.as_slice()
        };
        let like = self.masses.iter().rev().take(RECENT).find(is_like).copied();
        (group.mass, group.block) = like.unwrap_or_else(|| {
            let mass = extend(&mut m.mass, coefs.into_iter());
            (mass, extend(&mut m.blocks, block.into_iter()))
        });
        if like.is_none() {
            self.masses.push((group.mass, group.block));
        }
    }
}

/// Owner of each entity: the owner of the first group that uses it, before groups are merged. Any owner for an unused entity.
fn owners<T: Real>(groups: &[GroupDraft<T>], entities: &[Entity<T>]) -> Vec<Owner> {
    let mut owners = vec![None; entities.len()];
    for group in groups {
        for e in group.slots(entities) {
            owners[e].get_or_insert(group.owner);
        }
    }
    owners.into_iter().map(|owner| owner.unwrap_or(Owner::Body(0))).collect()
}

/// True if the model is one dense group with all unknowns in their order.
fn is_whole<T: Real, const D: usize>(model: &NaturalModel<T, D>) -> bool {
    let [group] = &model.groups[..] else { return false };
    let clique = group.clique.of(&model.cliques);
    clique.len() <= DENSE
        && clique.len().is_multiple_of(2)
        && clique.len() == model.n_unknowns
        && clique.iter().enumerate().all(|(k, &u)| k == u as usize)
}

/// Index of an effect; `usize::MAX` for an owner that is no effect.
pub(super) fn effect_of(owner: Owner) -> usize {
    if let Owner::Effect(effect) = owner { effect } else { usize::MAX }
}

/// Numbers the measures of laws on one body after the measures of scalar laws.
fn number_measures<T: Real, const D: usize>(model: &mut NaturalModel<T, D>) {
    let n = index(model.measures.len());
    let shift = |span: &mut Span| (span.start, span.end) = (span.start + n, span.end + n);
    for element in &mut model.body_elements {
        shift(&mut element.measures);
    }
    for group in model.groups.iter_mut().filter(|group| group.has_body_law) {
        shift(&mut group.measures);
    }
    model.n_measures += n as usize;
}

/// Entry (a, b) of the matrix alpha 1 + beta J, J the quarter turn in the plane.
fn entry<T: Real>(c: Coef<T>, a: usize, b: usize) -> T {
    match (a, b) {
        (0, 1) => -c.im,
        (1, 0) => c.im,
        _ if a == b => c.re,
        _ => T::ZERO,
    }
}

fn empty(at: usize) -> Span {
    Span { start: index(at), end: index(at) }
}

pub(super) fn extend<U>(table: &mut Vec<U>, items: impl Iterator<Item = U>) -> Span {
    let start = index(table.len());
    table.extend(items);
    Span { start, end: index(table.len()) }
}

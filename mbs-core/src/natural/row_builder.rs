//! Builders of groups and rows, which refer to entities by number before the coordinates are numbered.

use super::basis::Combination;
use super::sharing::{Entity, EntityKind};
use crate::Real;
use crate::algebra::{Coef, Vector};
use crate::effects::{BodyLaw, Law};
use crate::elements::CoupledForm;
use crate::measure::{PreparedCurve, RollingInput};
use crate::model::Owner;
use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;

/// Constraint row, or D rows, in terms of entities.
#[derive(Debug, Clone)]
pub(crate) enum RowDraft<T: Real> {
    Distance {
        ends: [usize; 2],
        length: T,
    },
    Dot {
        x: Combination<T>,
        y: Combination<T>,
        scale: T,
        constant: T,
    },
    Linear {
        x: Combination<T>,
    },
    GuidedAngle {
        x1: Combination<T>,
        x2: Combination<T>,
        y: Combination<T>,
        guide: usize,
    },
    GuidedSlide {
        x: Combination<T>,
        y: Combination<T>,
        guide: usize,
    },
    /// Component `number` of a guided rotation vector, whose first guide is `guide`: three axes of the first body, two of the
    /// second.
    GuidedRotation {
        x: [Combination<T>; 3],
        y: [Combination<T>; 2],
        number: usize,
        guide: usize,
    },
    Coupled {
        terms: Vec<CoupledDraft<T>>,
        inverse: T,
        guide: Option<usize>,
        form: CoupledForm,
    },
    Rolling(Box<RollingDraft<T>>),
}

/// Rolling in terms of entities. Each frame has a point, and one direction for each dimension. The rolling body's frame comes
/// first, then the frame of the plane's body.
#[derive(Debug, Clone)]
pub(crate) struct RollingDraft<T: Real> {
    pub(crate) input: RollingInput<T>,
    pub(crate) n_rows: usize,
    pub(crate) frames: [(Combination<T>, Vec<Combination<T>>); 2],
}

/// Term of a coupling in terms of entities.
#[derive(Debug, Clone)]
pub(crate) struct CoupledDraft<T: Real> {
    pub(crate) factor: T,
    pub(crate) measures: Vec<MeasureDraft<T>>,
    pub(crate) curve: PreparedCurve<T>,
}

/// Quantity that a term of a coupling measures, by combinations of entities.
#[derive(Debug, Clone)]
pub(crate) enum MeasureDraft<T: Real> {
    Angle { x1: Combination<T>, x2: Combination<T>, y: Combination<T>, sign: T, of: (usize, usize) },
    Slide { x: Combination<T>, y: Combination<T> },
    Length { x: Combination<T>, reference: T },
    Swing { a: Combination<T>, b: Combination<T> },
    Twist { first: [Combination<T>; 2], second: [Combination<T>; 2] },
}

impl<T: Real> MeasureDraft<T> {
    pub(super) fn combinations(&self) -> Vec<&Combination<T>> {
        match self {
            Self::Angle { x1, x2, y, .. } => alloc::vec![x1, x2, y],
            Self::Slide { x, y } => alloc::vec![x, y],
            Self::Length { x, .. } => alloc::vec![x],
            Self::Swing { a, b } => alloc::vec![a, b],
            Self::Twist { first, second } => first.iter().chain(second).collect(),
        }
    }
}

/// Combinations that the terms of a sum use.
fn combinations_of<T: Real>(terms: &[CoupledDraft<T>]) -> Vec<&Combination<T>> {
    let measures = terms.iter().flat_map(|term| &term.measures);
    measures.flat_map(MeasureDraft::combinations).collect()
}

impl<T: Real> RowDraft<T> {
    /// Combinations of the row, whose entities it uses; none for a distance, which uses entities directly.
    pub(crate) fn combinations(&self) -> Vec<&Combination<T>> {
        match self {
            Self::Distance { .. } => Vec::new(),
            Self::Dot { x, y, .. } | Self::GuidedSlide { x, y, .. } => alloc::vec![x, y],
            Self::Linear { x } => alloc::vec![x],
            Self::GuidedAngle { x1, x2, y, .. } => alloc::vec![x1, x2, y],
            Self::GuidedRotation { x, y, .. } => x.iter().chain(y).collect(),
            Self::Coupled { terms, .. } => combinations_of(terms),
            Self::Rolling(draft) => {
                let of_frame = |(point, axes)| core::iter::once(point).chain(axes);
                draft.frames.iter().map(|(point, axes)| (point, axes)).flat_map(of_frame).collect()
            }
        }
    }

    /// Number of rows of the draft in `dimension` dimensions.
    pub(crate) fn n_rows(&self, dimension: usize) -> usize {
        match self {
            Self::Linear { .. } => dimension,
            Self::Rolling(draft) => draft.n_rows,
            _ => 1,
        }
    }

    /// Entities that the row uses, in order, with repetitions.
    pub(crate) fn entities(&self) -> Vec<usize> {
        match self {
            Self::Distance { ends, .. } => ends.to_vec(),
            _ => self.combinations().into_iter().flatten().map(|(e, _)| *e).collect(),
        }
    }
}

/// Measure or load of an effect group, by combinations of entities.
#[derive(Debug, Clone)]
pub(crate) enum EffectDraft<T: Real> {
    Length {
        x: Combination<T>,
        law: Law<T>,
    },
    Along {
        x: Combination<T>,
        d: Combination<T>,
        offset: T,
        law: Law<T>,
    },
    Rotation {
        frames: [Vec<Combination<T>>; 2],
        number: u32,
        law: Law<T>,
    },
    Angle {
        x1: Combination<T>,
        x2: Combination<T>,
        y: Combination<T>,
        law: Law<T>,
    },
    Sum {
        terms: Vec<CoupledDraft<T>>,
        law: Law<T>,
    },
    Force {
        point: Combination<T>,
        frame: Option<Vec<Combination<T>>>,
        course: u32,
    },
    Torque {
        frame: Vec<Combination<T>>,
        course: u32,
    },
    BodyLoad {
        point: Combination<T>,
        frame: Option<Vec<Combination<T>>>,
        axis: [T; 3],
        law: BodyLaw<T>,
    },
}

impl<T: Real> EffectDraft<T> {
    pub(crate) fn combinations(&self) -> Vec<&Combination<T>> {
        match self {
            Self::Length { x, .. } => alloc::vec![x],
            Self::Along { x, d, .. } => alloc::vec![x, d],
            Self::Rotation { frames, .. } => frames.iter().flatten().collect(),
            Self::Angle { x1, x2, y, .. } => alloc::vec![x1, x2, y],
            Self::Sum { terms, .. } => combinations_of(terms),
            Self::Force { point, frame, .. } | Self::BodyLoad { point, frame, .. } => {
                let mut all = alloc::vec![point];
                all.extend(frame.iter().flatten());
                all
            }
            Self::Torque { frame, .. } => frame.iter().collect(),
        }
    }
}

/// Group of a model that is being built.
#[derive(Debug, Clone)]
pub(crate) struct GroupDraft<T: Real> {
    /// Owner of the group. After a merge, the owner of the first merged group.
    pub(crate) owner: Owner,
    /// Entities with mass, and their matrix G.
    pub(crate) mass: Option<(Vec<usize>, Vec<Coef<T>>)>,
    /// Constant generalised forces (gravity and constant point forces): entity and force [N].
    pub(crate) forces: Vec<(usize, Vector<T, 3>)>,
    pub(crate) rows: Vec<RowDraft<T>>,
    /// Owner of each row; rows beyond the end of this list belong to the owner of the group.
    pub(crate) row_owners: Vec<Owner>,
    pub(crate) effects: Vec<EffectDraft<T>>,
}

impl<T: Real> GroupDraft<T> {
    pub(crate) fn new(owner: Owner) -> Self {
        Self {
            owner,
            mass: None,
            forces: Vec::new(),
            rows: Vec::new(),
            row_owners: Vec::new(),
            effects: Vec::new(),
        }
    }

    /// Distinct entities of the group: unknown ones first, then constants, each part in order of first use.
    pub(crate) fn slots(&self, entities: &[Entity<T>]) -> Vec<usize> {
        let mut seen: Vec<usize> = Vec::new();
        let mut visit = |e: usize| {
            if !seen.contains(&e) {
                seen.push(e);
            }
        };
        if let Some((basis, _)) = &self.mass {
            basis.iter().for_each(|&e| visit(e));
        }
        self.forces.iter().for_each(|(e, _)| visit(*e));
        self.rows.iter().flat_map(RowDraft::entities).for_each(&mut visit);
        for effect in &self.effects {
            effect.combinations().into_iter().flatten().for_each(|(e, _)| visit(*e));
        }
        let (unknown, constant): (Vec<usize>, Vec<usize>) =
            seen.into_iter().partition(|&e| !entities[e].is_constant);
        unknown.into_iter().chain(constant).collect()
    }
}

/// Constant entities by their value, so that the search for a ground point does not scan all of them.
#[derive(Debug, Default)]
pub(crate) struct Constants {
    of_value: BTreeMap<(bool, [u64; 3]), Vec<usize>>,
}

impl Constants {
    /// Collects the constant entities among `entities`.
    pub(crate) fn new<T: Real>(entities: &[Entity<T>]) -> Self {
        let mut new = Self::default();
        for (e, entity) in entities.iter().enumerate().filter(|(_, entity)| entity.is_constant) {
            new.of_value.entry(key(&entity.at, entity.kind)).or_default().push(e);
        }
        new
    }

    /// First constant entity with the value `at`. A missing one is added.
    pub(crate) fn entity<T: Real>(
        &mut self,
        at: Vector<T, 3>,
        kind: EntityKind,
        entities: &mut Vec<Entity<T>>,
    ) -> usize {
        let candidates = self.of_value.entry(key(&at, kind)).or_default();
        // Values of a precision beyond f64 may differ and have the same key.
        if let Some(&found) = candidates.iter().find(|&&e| entities[e].at == at) {
            return found;
        }
        entities.push(Entity { kind, at, is_constant: true });
        candidates.push(entities.len() - 1);
        entities.len() - 1
    }
}

/// Key of a constant by its value. Equal values have equal keys: adding zero makes -0 and +0 equal.
fn key<T: Real>(at: &Vector<T, 3>, kind: EntityKind) -> (bool, [u64; 3]) {
    let bits = |i: usize| (at[i].to_f64() + 0.0).to_bits();
    (kind == EntityKind::Point, [bits(0), bits(1), bits(2)])
}

/// Difference a - b of combinations. Coefficients of one entity are added, and zero coefficients dropped.
pub(crate) fn difference<T: Real>(a: &Combination<T>, b: &Combination<T>) -> Combination<T> {
    let mut result = a.clone();
    for &(e, c) in b {
        match result.iter_mut().find(|(r, _)| *r == e) {
            Some((_, coef)) => *coef = coef.minus(c),
            None => result.push((e, Coef::zero().minus(c))),
        }
    }
    result.retain(|(_, c)| !c.is_zero());
    result
}

/// Product C^T F in three dimensions. A planar coefficient rotates the first two components.
pub(crate) fn lifted<T: Real>(c: Coef<T>, f: &Vector<T, 3>) -> Vector<T, 3> {
    let c = c.conj();
    Vector::<T, 3>::new(f[0] * c.re - f[1] * c.im, f[0] * c.im + f[1] * c.re, f[2] * c.re)
}

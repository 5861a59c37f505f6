//! Check of a model when it is loaded: every index in its tables must refer to an existing entry.

mod couplings;
mod plan;
mod signals;

use crate::elements;
use crate::inputs::{Motion, SignalLaw};
use crate::model::Model;
use mbs_core::Real;
use mbs_core::effects::bushing;
use mbs_core::laws::Part;
use mbs_recursive::link::plan::Span;
use mbs_recursive::link::{LinkKind, curves};
use mbs_recursive::loads::{Load, Measure, sum};
use mbs_recursive::passes::slices::TreeSlices;
use mbs_recursive::passes::{feedback, rotor};
use mbs_recursive::rows::{Row, coupled};
use mbs_recursive::space::Space;

/// Reason why a model cannot be loaded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LoadError {
    /// The model is larger than the memory reserved for it.
    Capacity {
        /// Name of the size that is too large.
        of: &'static str,
        /// Size that the model needs.
        needed: usize,
        /// Largest size that the memory allows.
        capacity: usize,
    },
    /// An index in a table is out of range, or this build does not contain the effect.
    Index {
        /// Name of the table.
        table: &'static str,
        /// Index of the entry in the table.
        entry: usize,
    },
    /// An effect depends on an angle of a ball joint, which tables for controllers do not support.
    Sum {
        /// Index of the entry in the table of effects.
        entry: usize,
    },
    /// A guide prescribes a rotation vector, which tables for controllers do not support.
    GuidedBall {
        /// Index of the link whose joint is guided.
        link: usize,
    },
    /// The model has a machine element that this build does not contain.
    Feature {
        /// The Cargo feature that adds the element.
        feature: &'static str,
    },
    /// The bytes are not a model of this version and dimension.
    Format,
    /// The bytes contain a law that this build does not support, or a malformed entry.
    Record {
        /// Number of bytes before the entry that cannot be read.
        byte: usize,
    },
    /// The bytes end before the end of the model, or continue after it.
    Length,
}

impl core::fmt::Display for LoadError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Capacity { of, needed, capacity } => {
                write!(f, "the model has {needed} {of}, and there is room for {capacity}")
            }
            Self::Index { table, entry } => {
                write!(
                    f,
                    "entry {entry} of the table of {table} points outside of the model, or has an effect whose feature is off in \
                     this build"
                )
            }
            Self::Sum { entry } => write!(
                f,
                "the sum of entry {entry} of the table of effects has an angle of a ball, and cannot be written for a controller"
            ),
            Self::GuidedBall { link } => write!(
                f,
                "the rotation vector of link {link} is guided, which cannot be written for a controller"
            ),
            Self::Feature { feature } => write!(
                f,
                "the model needs the feature `{feature}` of mbs-nostd, which is off in this build"
            ),
            Self::Format => {
                write!(f, "not a model of this version, or of the other dimension")
            }
            Self::Record { byte } => write!(
                f,
                "byte {byte} begins what is no entry, or an effect whose feature is off in this build"
            ),
            Self::Length => write!(f, "the model does not end where its text does"),
        }
    }
}

impl core::error::Error for LoadError {}

/// Sizes of a model, or the largest sizes for which a solver has memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Sizes {
    /// Number of links, including the ground.
    pub links: usize,
    /// Number of coordinates of all links.
    pub coordinates: usize,
    /// Number of freedoms of all joints.
    pub freedoms: usize,
    /// Number of rows of loops.
    pub rows: usize,
    /// Number of entries of the blocks of Λ, the matrix of the loops' rows.
    pub blocks: usize,
    /// Number of gains of rows at joints.
    pub gains: usize,
    /// Number of guides of joints.
    pub guides: usize,
    /// Number of signals, including those that only effects use.
    pub courses: usize,
    /// Number of states of signals.
    pub states: usize,
    /// Number of signals if there are operations on signals; otherwise zero.
    pub followed: usize,
    /// Largest number of sides of a row: branches along which the row is carried inward. Cut joints have two. A coupling has one for each
    /// branch that carries its joints and points.
    pub sides: usize,
}

impl Sizes {
    /// Checks that a model of these sizes fits into `room`.
    ///
    /// # Errors
    /// [`LoadError::Capacity`] names the size that is too large.
    pub fn fit(&self, room: &Self) -> Result<(), LoadError> {
        for (of, needed, capacity) in [
            ("links", self.links, room.links),
            ("coordinates", self.coordinates, room.coordinates),
            ("freedoms", self.freedoms, room.freedoms),
            ("rows", self.rows, room.rows),
            ("numbers in blocks", self.blocks, room.blocks),
            ("gains", self.gains, room.gains),
            ("guides", self.guides, room.guides),
            ("courses", self.courses, room.courses),
            ("states of signals", self.states, room.states),
            ("courses with operations", self.followed, room.followed),
            ("sides of rows", self.sides, room.sides),
        ] {
            if needed > capacity {
                return Err(LoadError::Capacity { of, needed, capacity });
            }
        }
        Ok(())
    }

    /// Returns the sizes of a mechanism.
    #[must_use]
    pub fn of<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> Self {
        let plan = &m.loops.plan;
        let n = |lap: u32| m.loops.loops.get(lap as usize).map_or(0, |lap| lap.n as usize);
        let (mut blocks, mut gains) = (0, 0);
        for (i, station) in plan.stations.iter().enumerate() {
            let freedoms = m.links.get(i).map_or(0, |link| link.kind.n_freedoms::<T, S>());
            for pass in plan.passes.get(station.passes.range()).unwrap_or(&[]) {
                let own = n(pass.lap).saturating_mul(freedoms);
                gains = gains.max((pass.gain as usize).saturating_add(own));
            }
        }
        for lap in m.loops.loops {
            let own = (lap.n as usize).saturating_mul(lap.n as usize);
            blocks = blocks.max((lap.block as usize).saturating_add(own));
        }
        for end in plan.ends {
            for coupling in plan.couplings.get(end.couplings.range()).unwrap_or(&[]) {
                let own = n(coupling.lap).saturating_mul(n(end.lap));
                blocks = blocks.max((coupling.block as usize).saturating_add(own));
            }
        }
        Self {
            links: m.links.len(),
            coordinates: m.n_coordinates,
            freedoms: m.n_freedoms,
            rows: m.loops.rows.len(),
            blocks,
            gains,
            guides: 0,
            courses: 0,
            states: m.feedback.n_states,
            followed: 0,
            sides: n_sides(m),
        }
    }
}

/// A model whose tables were checked: every index in them refers to an existing entry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Checked<'a, T: Real, S: Space<T>> {
    model: Model<'a, T, S>,
    sizes: Sizes,
}

impl<'a, T: Real, S: Space<T>> Checked<'a, T, S> {
    /// Checks every index in the tables of a model.
    ///
    /// Cost: linear in the size of the tables. The check is made once, when a model is loaded.
    ///
    /// # Errors
    /// [`LoadError::Index`] names the table and the entry. [`LoadError::Feature`] names a feature that this build lacks.
    pub fn new(model: &Model<'a, T, S>) -> Result<Self, LoadError> {
        if let Some(feature) = elements::missing(model) {
            return Err(LoadError::Feature { feature });
        }
        let prescriptions = &model.prescriptions;
        let courses = prescriptions.courses.len();
        let sizes = Sizes {
            guides: prescriptions.guides.len(),
            courses,
            followed: if model.mechanism.feedback.steps.is_empty() { 0 } else { courses },
            ..Sizes::of(&model.mechanism)
        };
        let look = Look { m: &model.mechanism, sizes };
        look.links()?;
        look.loops()?;
        look.plan()?;
        look.loads()?;
        if coupled::HAS_LINES {
            look.starts()?;
        }
        if curves::IS_BUILT || feedback::IS_BUILT {
            look.curves()?;
        }
        if rotor::IS_BUILT {
            look.rotors()?;
        }
        look.prescriptions(model)?;
        if feedback::IS_BUILT {
            look.signals(model)?;
        }
        look.start(model)?;
        Ok(Self { model: *model, sizes })
    }

    /// Makes a checked model without a new check. The tables of `model` must have been checked with these `sizes`, and must not have
    /// changed since.
    pub(crate) fn again(model: Model<'a, T, S>, sizes: Sizes) -> Self {
        Self { model, sizes }
    }

    /// Returns the model whose tables were checked.
    #[must_use]
    pub fn model(&self) -> &Model<'a, T, S> {
        &self.model
    }

    /// Returns the sizes of the model.
    #[must_use]
    pub fn sizes(&self) -> Sizes {
        self.sizes
    }

    /// Returns the number of slopes of curves that a step stores: one for each term up to the last term with a curve.
    #[must_use]
    pub fn n_slopes(&self) -> usize {
        if curves::IS_BUILT { self.model.mechanism.loops.couplings.n_slopes() } else { 0 }
    }

    /// Returns the effects that act on a rung of the degradation ladder. `None` if all effects act.
    pub(crate) fn kept_on(&self, rung: u32) -> Option<&'a [Load<T, S>]> {
        let kept = self.model.rungs.get((rung as usize).checked_sub(1)?)?;
        self.model.mechanism.loads.get(..*kept as usize)
    }
}

/// Tables that are being checked, with the sizes that limit their indices.
struct Look<'a, 'b, T: Real, S: Space<T>> {
    m: &'a TreeSlices<'b, T, S>,
    sizes: Sizes,
}

/// Returns the error for an entry with an index out of range.
fn fault(table: &'static str, entry: usize) -> LoadError {
    LoadError::Index { table, entry }
}

/// Returns the number of sides if `side` is the index of the last side.
fn sides(side: u32) -> usize {
    (side as usize).saturating_add(1)
}

/// Smallest number of sides of a row [-]: a cut joint has one side at each of its two bodies.
pub(crate) const MIN_SIDES: usize = 2;

/// Returns the largest number of sides of a row. A side that begins on the ground passes no joint, so the sides of the starts are also
/// read.
pub(crate) fn n_sides<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> usize {
    let passes = m.loops.plan.passes.iter().map(|pass| pass.side);
    let starts = if coupled::HAS_LINES { m.loops.couplings.starts } else { &[] };
    passes
        .chain(starts.iter().map(|start| start.side))
        .fold(MIN_SIDES, |most, side| most.max(sides(side)))
}

/// Returns the error for `entry` of `table` if `holds` is false.
fn ensure(holds: bool, table: &'static str, entry: usize) -> Result<(), LoadError> {
    if holds { Ok(()) } else { Err(fault(table, entry)) }
}

/// True if `n` entries, beginning at `first`, end at or before `end`.
fn ends_by(first: u32, n: usize, end: usize) -> bool {
    (first as usize).checked_add(n).is_some_and(|last| last <= end)
}

impl<T: Real, S: Space<T>> Look<'_, '_, T, S> {
    fn links(&self) -> Result<(), LoadError> {
        ensure(!self.m.links.is_empty(), "links", 0)?;
        for (i, link) in self.m.links.iter().enumerate().skip(1) {
            let holds = (link.parent as usize) < i
                && ends_by(link.z, link.kind.n_coordinates::<T, S>(), self.sizes.coordinates)
                && ends_by(link.v, link.kind.n_freedoms::<T, S>(), self.sizes.freedoms)
                && (!link.kind.is_guided() || (link.v as usize) < self.sizes.guides)
                && (link.kind != LinkKind::Ball || S::DIMENSION == 3);
            ensure(holds, "links", i)?;
            if link.kind == LinkKind::GuidedBall {
                return Err(LoadError::GuidedBall { link: i });
            }
        }
        Ok(())
    }

    fn loops(&self) -> Result<(), LoadError> {
        for (i, lap) in self.m.loops.loops.iter().enumerate() {
            let links = self.sizes.links;
            let holds = lap.links.iter().all(|&link| (link as usize) < links)
                && (lap.ancestor as usize) < links
                && ends_by(lap.first, lap.n as usize, self.sizes.rows);
            ensure(holds, "loops", i)?;
            if coupled::IS_BUILT
                && let Some(Row::Coupled(row)) = self.m.loops.rows.get(lap.first as usize)
            {
                self.coupling((i, lap), row)?;
            }
        }
        for (i, row) in self.m.loops.rows.iter().enumerate() {
            let Row::Coincidence { axis } = row else { continue };
            ensure((*axis as usize) < S::DIMENSION, "rows", i)?;
        }
        Ok(())
    }

    fn loads(&self) -> Result<(), LoadError> {
        let is_link = |link: u32| (link as usize) < self.sizes.links;
        let is_course = |course: u32| (course as usize) < self.sizes.courses;
        for (i, load) in self.m.loads.iter().enumerate() {
            let holds = match load {
                Load::Between { links, gauge, law } => {
                    let has_angle = match gauge {
                        Measure::Turn => S::DIMENSION == 2,
                        Measure::Rotation { number } => {
                            bushing::IS_BUILT && S::DIMENSION == 3 && *number < 3
                        }
                        Measure::Length { .. } | Measure::Along { .. } => true,
                    };
                    links.iter().all(|&link| is_link(link))
                        && has_angle
                        && law.fits(&self.m.tables, self.sizes.courses)
                }
                Load::Angle { link, law } => {
                    self.has_one_coordinate(*link) && law.fits(&self.m.tables, self.sizes.courses)
                }
                Load::Constant { link, .. } => is_link(*link),
                Load::Force { link, course, .. } | Load::Torque { link, course } => {
                    is_link(*link) && is_course(*course)
                }
                Load::Sum(sum) => {
                    if sum::IS_BUILT {
                        self.sum((i, sum))?;
                    }
                    true
                }
                Load::BodyLoad(load) => {
                    is_link(load.link) && load.law.fits(&self.m.tables, self.sizes.courses)
                }
            };
            ensure(holds, "effects", i)?;
        }
        Ok(())
    }

    /// True if the link's joint has one coordinate.
    fn has_one_coordinate(&self, link: u32) -> bool {
        self.m
            .links
            .get(link as usize)
            .is_some_and(|link| link.kind.is_guided() || link.kind.n_freedoms::<T, S>() == 1)
    }

    fn rotors(&self) -> Result<(), LoadError> {
        for (i, rotor) in self.m.rotors.iter().enumerate() {
            ensure(rotor.link > 0 && self.has_one_coordinate(rotor.link), "rotors", i)?;
        }
        Ok(())
    }

    fn prescriptions(&self, model: &Model<'_, T, S>) -> Result<(), LoadError> {
        let laws = &model.prescriptions;
        for (i, law) in laws.guides.iter().enumerate() {
            let Motion::Table(part) = law else { continue };
            let (knots, curvatures) = laws.knots;
            let holds = is_part(*part, knots.len()) && is_part(*part, curvatures.len());
            ensure(holds, "guides", i)?;
        }
        for (i, law) in laws.courses.iter().enumerate() {
            let (knots, curvatures) = laws.knots;
            let holds = match law {
                SignalLaw::Table(part) => is_part(*part, laws.rows.len()),
                SignalLaw::Spline(part) => {
                    is_part(*part, knots.len()) && is_part(*part, curvatures.len())
                }
                _ => true,
            };
            ensure(holds, "courses", i)?;
        }
        Ok(())
    }

    fn start(&self, model: &Model<'_, T, S>) -> Result<(), LoadError> {
        let begin = &model.start;
        ensure(begin.z.len() == self.sizes.coordinates, "coordinates", begin.z.len())?;
        ensure(begin.v.len() == self.sizes.freedoms, "velocities", begin.v.len())?;
        ensure(begin.a.len() == self.sizes.freedoms, "accelerations", begin.a.len())?;
        for (i, &kept) in model.rungs.iter().enumerate() {
            ensure(kept as usize <= self.m.loads.len(), "rungs", i)?;
        }
        Ok(())
    }
}

/// True if a range is valid for a list with `end` entries.
fn is_within(span: Span, end: usize) -> bool {
    span.first <= span.end && span.end as usize <= end
}

fn is_part(part: Part, end: usize) -> bool {
    ends_by(part.first, part.n as usize, end)
}

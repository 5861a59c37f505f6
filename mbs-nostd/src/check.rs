//! Models are checked once, when they are loaded: afterwards every number in their tables points into them.

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

/// Reason why a model is not loaded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LoadError {
    /// A model is larger than what is to hold it.
    Capacity {
        /// Name of what the model has too much of.
        of: &'static str,
        /// Number that the model needs.
        needed: usize,
        /// Number that there is room for.
        capacity: usize,
    },
    /// A number in a table points outside of what it is to point into, or this build leaves the effect out.
    Index {
        /// Name of the table.
        table: &'static str,
        /// Number of the entry in the table.
        entry: usize,
    },
    /// An effect on an angle of a ball, which no controller has.
    Sum {
        /// The entry in the table of effects.
        entry: usize,
    },
    /// A guided rotation vector, which no controller has.
    GuidedBall {
        /// Number of the link whose joint is guided.
        link: usize,
    },
    /// The model has a machine element that this build leaves out.
    Feature {
        /// The Cargo feature that brings it.
        feature: &'static str,
    },
    /// The text is not a model of this version and dimension.
    Format,
    /// The text has a law that this build leaves out, or the text is not what a model is written as.
    Record {
        /// Number of bytes in the text before the entry that cannot be read.
        byte: usize,
    },
    /// The text ends before the model does, or continues after it.
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

/// Sizes that a model has, or may have at most.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Sizes {
    /// Links, the ground among them.
    pub links: usize,
    /// Number of coordinates.
    pub coordinates: usize,
    /// Number of freedoms.
    pub freedoms: usize,
    /// Number of rows of loops.
    pub rows: usize,
    /// Numbers in blocks of Λ.
    pub blocks: usize,
    /// Gains of rows at joints.
    pub gains: usize,
    /// Number of guides.
    pub guides: usize,
    /// Number of signals, those of effects alone included.
    pub courses: usize,
    /// Number of states of signals.
    pub states: usize,
    /// Courses, where there are operations on them; else none.
    pub followed: usize,
    /// Sides of rows: two, or as many branches as a coupling has joints and points on.
    pub sides: usize,
}

impl Sizes {
    /// Checks that a model of these sizes fits into `room`.
    ///
    /// # Errors
    /// [`LoadError::Capacity`] names what there is too much of.
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

    /// The sizes of a mechanism.
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

/// A model whose tables fit each other: every number in them has been looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Checked<'a, T: Real, S: Space<T>> {
    model: Model<'a, T, S>,
    sizes: Sizes,
}

impl<'a, T: Real, S: Space<T>> Checked<'a, T, S> {
    /// Looks at every number.
    ///
    /// Cost: linear in the tables. Once, when a model is loaded.
    ///
    /// # Errors
    /// [`LoadError::Index`] names the table and the entry, [`LoadError::Feature`] what is off in this build.
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

    /// Makes a checked model again: the tables of `model` have not changed since they were checked with these `sizes`.
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

    /// Returns the number of slopes of curves that a step remembers: one for each term up to the last with a curve.
    #[must_use]
    pub fn n_slopes(&self) -> usize {
        if curves::IS_BUILT { self.model.mechanism.loops.couplings.n_slopes() } else { 0 }
    }

    /// The effects that are kept on a rung, where these are not all.
    pub(crate) fn kept_on(&self, rung: u32) -> Option<&'a [Load<T, S>]> {
        let kept = self.model.rungs.get((rung as usize).checked_sub(1)?)?;
        self.model.mechanism.loads.get(..*kept as usize)
    }
}

/// Tables under check, with the sizes that their numbers must stay within.
struct Look<'a, 'b, T: Real, S: Space<T>> {
    m: &'a TreeSlices<'b, T, S>,
    sizes: Sizes,
}

/// An entry that points outside.
fn fault(table: &'static str, entry: usize) -> LoadError {
    LoadError::Index { table, entry }
}

/// Sides up to that of this number.
fn sides(side: u32) -> usize {
    (side as usize).saturating_add(1)
}

/// Sides that every row has [-]: those of a cut joint, at its two bodies.
pub(crate) const MIN_SIDES: usize = 2;

/// The most sides that a row has. A side that begins on the ground passes no joint.
pub(crate) fn n_sides<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> usize {
    let passes = m.loops.plan.passes.iter().map(|pass| pass.side);
    let starts = if coupled::HAS_LINES { m.loops.couplings.starts } else { &[] };
    passes
        .chain(starts.iter().map(|start| start.side))
        .fold(MIN_SIDES, |most, side| most.max(sides(side)))
}

/// Returns the fault of `entry` in `table` unless `holds`.
fn ensure(holds: bool, table: &'static str, entry: usize) -> Result<(), LoadError> {
    if holds { Ok(()) } else { Err(fault(table, entry)) }
}

/// Do `n` entries from `first` end by `end`?
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

    /// Has a link's joint one coordinate?
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

/// Is a range one of a list of `end` entries?
fn is_within(span: Span, end: usize) -> bool {
    span.first <= span.end && span.end as usize <= end
}

fn is_part(part: Part, end: usize) -> bool {
    ends_by(part.first, part.n as usize, end)
}

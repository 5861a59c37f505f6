//! Models are checked once, when they are loaded: afterwards every number in their tables points into them.

mod signals;

use crate::inputs::{Motion, SignalLaw};
use crate::model::Model;
use mbs_core::Real;
use mbs_core::effects::bushing;
use mbs_core::laws::Part;
use mbs_recursive::coupled::{CoupledRow, NONE, SumMeasure};
use mbs_recursive::link::LinkKind;
use mbs_recursive::loads::{Load, Measure, SumLoad};
use mbs_recursive::plan::Span;
use mbs_recursive::rows::{ClosedLoop, Row};
use mbs_recursive::slices::TreeSlices;
use mbs_recursive::space::Space;

/// What keeps a model from being loaded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LoadError {
    /// A model is larger than what is to hold it.
    Capacity {
        /// Of what there is too much.
        of: &'static str,
        /// What the model needs.
        needed: usize,
        /// What there is.
        capacity: usize,
    },
    /// A number in a table points outside of what it is to point into, or this build leaves the effect out.
    Index {
        /// The table.
        table: &'static str,
        /// The entry.
        entry: usize,
    },
    /// A coupling of lengths, with curves, or of joints on more than two branches, which no controller holds.
    Coupling {
        /// `scene.couplings[coupling]`.
        coupling: usize,
    },
    /// An effect on a sum with lengths or curves, which no controller has.
    Sum {
        /// The entry in the table of effects.
        entry: usize,
    },
    /// The text is not a model of this version and dimension.
    Format,
    /// The text has a law that this build leaves out, or the text is not what a model is written as.
    Record {
        /// Where in the text.
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
            Self::Coupling { coupling } => {
                write!(f, "coupling {coupling} cannot be written for a controller")
            }
            Self::Sum { entry } => write!(
                f,
                "the sum of entry {entry} of the table of effects has a length, an angle of a ball or a curve, and cannot be written for a controller"
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

/// How large a model is, or may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Sizes {
    /// Links, the ground among them.
    pub links: usize,
    /// Coordinates.
    pub coordinates: usize,
    /// Freedoms.
    pub freedoms: usize,
    /// Rows of loops.
    pub rows: usize,
    /// Numbers in blocks of Λ.
    pub blocks: usize,
    /// Gains of rows at joints.
    pub gains: usize,
    /// Guides.
    pub guides: usize,
    /// Courses.
    pub courses: usize,
    /// States of signals.
    pub states: usize,
    /// Courses, where there are operations on them; else none.
    pub followed: usize,
}

impl Sizes {
    /// Is there room?
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
    /// [`LoadError::Index`] names the table and the entry.
    pub fn new(model: &Model<'a, T, S>) -> Result<Self, LoadError> {
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
        look.rotors()?;
        look.prescriptions(model)?;
        look.signals(model)?;
        look.start(model)?;
        Ok(Self { model: *model, sizes })
    }

    /// What was checked before: the tables of `model` have not changed since.
    pub(crate) fn again(model: Model<'a, T, S>, sizes: Sizes) -> Self {
        Self { model, sizes }
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &Model<'a, T, S> {
        &self.model
    }

    /// How large it is.
    #[must_use]
    pub fn sizes(&self) -> Sizes {
        self.sizes
    }

    /// The mechanism with the effects that are kept on a rung, and how many rungs there are.
    pub(crate) fn on_rung(&self, rung: u32) -> (TreeSlices<'a, T, S>, u32) {
        let mut mechanism = self.model.mechanism;
        let rungs = self.model.rungs;
        if let Some(&kept) = (rung as usize).checked_sub(1).and_then(|i| rungs.get(i)) {
            let loads: &'a [Load<T, S>] = mechanism.loads;
            mechanism.loads = loads.get(..kept as usize).unwrap_or(loads);
        }
        (mechanism, u32::try_from(rungs.len()).unwrap_or(u32::MAX))
    }
}

/// What is looked at.
struct Look<'a, 'b, T: Real, S: Space<T>> {
    m: &'a TreeSlices<'b, T, S>,
    sizes: Sizes,
}

/// An entry that points outside.
fn fault(table: &'static str, entry: usize) -> LoadError {
    LoadError::Index { table, entry }
}

/// A coupling that no controller holds.
fn unheld<T: Real, S: Space<T>>(lap: &ClosedLoop<T, S>) -> LoadError {
    LoadError::Coupling { coupling: lap.joint as usize }
}

/// `Ok` if so.
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
            if let Some(Row::Coupled(row)) = self.m.loops.rows.get(lap.first as usize) {
                self.coupling((i, lap), row)?;
            }
        }
        for (i, row) in self.m.loops.rows.iter().enumerate() {
            let Row::Coincidence { axis } = row else { continue };
            ensure((*axis as usize) < S::DIMENSION, "rows", i)?;
        }
        Ok(())
    }

    /// A coupling of joint coordinates without curves.
    fn coupling(
        &self,
        (i, lap): (usize, &ClosedLoop<T, S>),
        row: &CoupledRow<T>,
    ) -> Result<(), LoadError> {
        let terms = self.m.loops.couplings.terms.get(row.terms.range()).unwrap_or(&[]);
        let is_known = row.guide == NONE || (row.guide as usize) < self.sizes.guides;
        ensure(is_known && lap.n == 1 && !terms.is_empty(), "loops", i)?;
        for term in terms {
            let SumMeasure::Joint { link, side } = term.of else { return Err(unheld(lap)) };
            ensure(
                self.has_one(link).is_some_and(|is_guided| !is_guided || side == NONE),
                "loops",
                i,
            )?;
            if term.curve != NONE || (side != NONE && side > 1) {
                return Err(unheld(lap));
            }
        }
        Ok(())
    }

    /// Is a link that has one coordinate guided? Others have none.
    fn has_one(&self, link: u32) -> Option<bool> {
        let kind = self.m.links.get(link as usize).filter(|_| link > 0)?.kind;
        let n = kind.n_freedoms::<T, S>();
        (n < 2).then_some(n == 0)
    }

    /// A sum of joint coordinates without curves.
    fn sum(&self, (i, sum): (usize, &SumLoad<T>)) -> Result<(), LoadError> {
        let terms = self.m.loops.couplings.terms.get(sum.terms.range());
        ensure(terms.is_some_and(|terms| !terms.is_empty()), "effects", i)?;
        for term in terms.unwrap_or(&[]) {
            let (SumMeasure::Joint { link, .. }, NONE) = (term.of, term.curve) else {
                return Err(LoadError::Sum { entry: i });
            };
            ensure(self.has_one(link).is_some(), "effects", i)?;
        }
        ensure(sum.law.fits(&self.m.tables, self.sizes.courses), "effects", i)
    }

    fn plan(&self) -> Result<(), LoadError> {
        let (plan, n) = (&self.m.loops.plan, self.m.loops.loops.len());
        ensure(n == 0 || plan.stations.len() == self.sizes.links, "stations", 0)?;
        let is_within = |span: Span, end: usize| span.first <= span.end && span.end as usize <= end;
        let is_lap = |lap: u32| (lap as usize) < n;
        for (i, station) in plan.stations.iter().enumerate() {
            let holds = is_within(station.passes, plan.passes.len())
                && is_within(station.pairs, plan.pairs.len())
                && is_within(station.ends, plan.ends.len());
            ensure(holds, "stations", i)?;
        }
        for (i, pass) in plan.passes.iter().enumerate() {
            ensure(is_lap(pass.lap) && pass.side < 2, "passes", i)?;
        }
        for (i, pair) in plan.pairs.iter().enumerate() {
            let rows = |pass: u32| {
                let pass = plan.passes.get(pass as usize)?;
                Some(self.m.loops.loops.get(pass.lap as usize)?.n as usize)
            };
            let holds = match (rows(pair.row), rows(pair.column)) {
                (Some(rows), Some(columns)) => {
                    ends_by(pair.block, rows * columns, self.sizes.blocks)
                }
                _ => false,
            };
            ensure(holds, "pairs", i)?;
        }
        for (i, end) in plan.ends.iter().enumerate() {
            let holds = is_lap(end.lap)
                && is_within(end.couplings, plan.couplings.len())
                && is_within(end.updates, plan.updates.len());
            ensure(holds, "ends", i)?;
        }
        for (i, coupling) in plan.couplings.iter().enumerate() {
            ensure(is_lap(coupling.lap) && coupling.side < 2, "couplings", i)?;
        }
        for (i, update) in plan.updates.iter().enumerate() {
            let holds = [update.row, update.column]
                .iter()
                .all(|&coupling| (coupling as usize) < plan.couplings.len())
                && (update.block as usize) < self.sizes.blocks;
            ensure(holds, "updates", i)?;
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
                    self.sum((i, sum))?;
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

fn is_part(part: Part, end: usize) -> bool {
    ends_by(part.first, part.n as usize, end)
}

//! [`Tables`]: a model read from bytes into memory of fixed capacity.

use crate::check::{Checked, LoadError, Sizes};
use crate::format::{Axes, Reader, Record};
use crate::inputs::{Motion, Prescriptions, SignalLaw};
use crate::model::{Model, StartState};
use heapless::Vec;
use mbs_core::Real;
use mbs_core::feedback::FeedbackStep;
use mbs_core::laws::entry::Entry;
use mbs_core::laws::{CurvatureEntry, FeatureEntry, KnotEntry, LawInputs, LawTables, PieceEntry};
use mbs_recursive::link::curves::CurveTable;
use mbs_recursive::link::plan::{End, LoopCoupling, Pair, Pass, Plan, Station, Update};
use mbs_recursive::link::{Link, LinkRotor};
use mbs_recursive::loads::Load;
use mbs_recursive::loops::Loops;
use mbs_recursive::passes::feedback::FeedbackSlices;
use mbs_recursive::passes::slices::TreeSlices;
use mbs_recursive::rows::Row;
use mbs_recursive::rows::closed_loop::ClosedLoop;
use mbs_recursive::rows::coupled::{Couplings, LinePoint, LinkStart, SumTerm};
use mbs_recursive::space::Space;

/// First numbers of a model's bytes: the mark of the format, and the version.
pub(crate) const HEAD: [u32; 2] = [u32::from_le_bytes(*b"MBSN"), 2];
/// Number added to the version if the bytes contain rotors [-].
pub(crate) const WITH_ROTORS: u32 = 1;
/// Number added to the version if the bytes contain operations on signals [-].
pub(crate) const WITH_SIGNALS: u32 = 2;
/// Number added to the version if the bytes contain curves that do not belong to operations on signals [-].
pub(crate) const WITH_CURVES: u32 = 4;
/// Number added to the version if the bytes contain points of lines and their links [-].
pub(crate) const WITH_LINES: u32 = 8;

/// True if this is a valid combination of optional parts. Curves may occur only once.
fn are_known(parts: u32) -> bool {
    let twice = WITH_SIGNALS + WITH_CURVES;
    parts <= WITH_ROTORS + WITH_SIGNALS + WITH_CURVES + WITH_LINES && parts & twice != twice
}

/// A model that was read from bytes, in arrays of fixed capacity. The parameters are the largest sizes: `L` links, `K` loops with `R` rows,
/// `P` entries in each list of the plan, `E` effects, `X` entries in each table of laws. `I` limits guides and signals, `Q` coordinates and
/// freedoms. `F` limits operations on signals, their states and measured coordinates, and all curves. `W` limits the points of lines and
/// their links.
///
/// A model in flash needs no such memory, because `mbs export --rust` writes its tables as constants.
#[derive(Debug, Clone)]
pub struct Tables<
    T: Real,
    S: Space<T>,
    const L: usize,
    const K: usize,
    const R: usize,
    const P: usize,
    const E: usize,
    const X: usize,
    const I: usize,
    const Q: usize,
    const F: usize = 0,
    const W: usize = 0,
> {
    sizes: Sizes,
    links: Vec<Link<T, S>, L>,
    stations: Vec<Station, L>,
    loops: Vec<ClosedLoop<T, S>, K>,
    rows: Vec<Row<T, S>, R>,
    terms: Vec<SumTerm<T>, P>,
    passes: Vec<Pass, P>,
    pairs: Vec<Pair, P>,
    ends: Vec<End, K>,
    couplings: Vec<LoopCoupling, P>,
    updates: Vec<Update, P>,
    loads: Vec<Load<T, S>, E>,
    rotors: Vec<LinkRotor<T>, L>,
    pieces: Vec<PieceEntry<T>, X>,
    features: Vec<FeatureEntry<T>, X>,
    road: (Vec<KnotEntry<T>, X>, Vec<CurvatureEntry<T>, X>),
    guides: Vec<Motion<T>, I>,
    courses: Vec<SignalLaw<T>, I>,
    knots: (Vec<[T; 2], X>, Vec<T, X>),
    course_rows: Vec<[T; 4], X>,
    operations: Vec<FeedbackStep<T>, F>,
    measured: Vec<u32, F>,
    curves: Vec<CurveTable<T>, F>,
    curve_knots: (Vec<[T; 2], X>, Vec<T, X>),
    points: Vec<LinePoint<T, S>, W>,
    starts: Vec<LinkStart, W>,
    rungs: Vec<u32, E>,
    z: Vec<T, Q>,
    v: Vec<T, Q>,
    a: Vec<T, Q>,
    states: Vec<[T; 2], F>,
    floor: [T; 2],
    n_cut: u32,
    gravity: S::Point,
    base: S::Point,
    length: T,
    n: [usize; 2],
    t: T,
}

/// Reads the length of a list, then its entries.
fn list<X: Record, const N: usize>(
    of: &'static str,
    from: &mut Reader<'_>,
) -> Result<Vec<X, N>, LoadError> {
    list_by(of, from, X::read)
}

/// Reads a list of entries to which laws refer. In a build without the effect the list must be empty.
fn entries<T: Real + Record, X: Entry<T>, const N: usize>(
    of: &'static str,
    from: &mut Reader<'_>,
) -> Result<Vec<X, N>, LoadError> {
    list_by(of, from, X::of)
}

#[inline(always)]
fn list_by<'a, X, const N: usize>(
    of: &'static str,
    from: &mut Reader<'a>,
    read: impl Fn(&mut Reader<'a>) -> Result<X, LoadError>,
) -> Result<Vec<X, N>, LoadError> {
    let n = u32::read(from)? as usize;
    let mut list = Vec::new();
    for _ in 0..n {
        let too_many = |_| LoadError::Capacity { of, needed: n, capacity: N };
        list.push(read(from)?).map_err(too_many)?;
    }
    Ok(list)
}

impl<
    T: Real + Record,
    S: Axes<T>,
    const L: usize,
    const K: usize,
    const R: usize,
    const P: usize,
    const E: usize,
    const X: usize,
    const I: usize,
    const Q: usize,
    const F: usize,
    const W: usize,
> Tables<T, S, L, K, R, P, E, X, I, Q, F, W>
{
    /// Reads a model, and checks every index in its tables.
    ///
    /// Cost: linear in the number of bytes; no allocation.
    ///
    /// # Errors
    /// [`LoadError`].
    pub fn read(bytes: &[u8]) -> Result<Self, LoadError> {
        let from = &mut Reader::new(bytes);
        let head = <[u32; 4]>::read(from)?;
        let [magic, version, dimension, width] = head;
        let parts = version.wrapping_sub(HEAD[1]);
        let is_known = magic == HEAD[0] && are_known(parts) && (width == 4 || width == 8);
        if !is_known || dimension as usize != S::DIMENSION {
            return Err(LoadError::Format);
        }
        from.set_double(width == 8);
        let mut tables = Self {
            sizes: Sizes::default(),
            links: list("links", from)?,
            stations: list("links", from)?,
            loops: list("loops", from)?,
            rows: list("rows", from)?,
            terms: list("terms of couplings", from)?,
            passes: list("passes", from)?,
            pairs: list("pairs", from)?,
            ends: list("loops", from)?,
            couplings: list("couplings", from)?,
            updates: list("updates", from)?,
            loads: list("effects", from)?,
            rotors: Vec::new(),
            pieces: entries::<T, _, X>("pieces", from)?,
            features: entries::<T, _, X>("parts of roads", from)?,
            road: (
                entries::<T, _, X>("knots of roads", from)?,
                entries::<T, _, X>("knots of roads", from)?,
            ),
            guides: list("guides", from)?,
            courses: list("courses", from)?,
            knots: (list("knots", from)?, list("knots", from)?),
            course_rows: list("rows of courses", from)?,
            operations: Vec::new(),
            measured: Vec::new(),
            curves: Vec::new(),
            curve_knots: (Vec::new(), Vec::new()),
            points: Vec::new(),
            starts: Vec::new(),
            rungs: list("rungs", from)?,
            z: list("coordinates", from)?,
            v: list("freedoms", from)?,
            a: list("freedoms", from)?,
            states: Vec::new(),
            floor: Record::read(from)?,
            n_cut: Record::read(from)?,
            gravity: Record::read(from)?,
            base: Record::read(from)?,
            length: Record::read(from)?,
            n: Record::read(from)?,
            t: Record::read(from)?,
        };
        tables.read_parts(parts, from)?;
        if !from.is_at_end() {
            return Err(LoadError::Length);
        }
        tables.sizes = Checked::new(&tables.unchecked())?.sizes();
        Ok(tables)
    }

    /// Reads the optional parts that a model of this version has.
    fn read_parts(&mut self, parts: u32, from: &mut Reader<'_>) -> Result<(), LoadError> {
        if parts & WITH_ROTORS != 0 {
            self.rotors = list("rotors", from)?;
        }
        if parts & WITH_SIGNALS != 0 {
            self.operations = list("operations on signals", from)?;
            self.measured = list("measured coordinates", from)?;
            self.read_curves(from)?;
            self.states = list("states of signals", from)?;
        }
        if parts & WITH_CURVES != 0 {
            self.read_curves(from)?;
        }
        if parts & WITH_LINES != 0 {
            self.points = list("points of lines", from)?;
            self.starts = list("links of lines", from)?;
        }
        Ok(())
    }

    fn read_curves(&mut self, from: &mut Reader<'_>) -> Result<(), LoadError> {
        self.curves = list("curves", from)?;
        self.curve_knots = (list("knots of curves", from)?, list("numbers of curves", from)?);
        Ok(())
    }

    /// Returns the model, which was checked when it was read.
    #[must_use]
    pub fn model(&self) -> Checked<'_, T, S> {
        Checked::again(self.unchecked(), self.sizes)
    }

    /// Returns the tables to which the rows of couplings refer.
    #[allow(clippy::needless_update, reason = "with `alloc` there is a field more")]
    fn couplings_of_rows(&self) -> Couplings<'_, T, S> {
        Couplings {
            n_cut: self.n_cut,
            terms: &self.terms,
            points: &self.points,
            starts: &self.starts,
            curves: &self.curves,
            knots: &self.curve_knots.0,
            numbers: &self.curve_knots.1,
            ..Couplings::none()
        }
    }

    fn unchecked(&self) -> Model<'_, T, S> {
        let plan = Plan {
            stations: &self.stations,
            passes: &self.passes,
            pairs: &self.pairs,
            ends: &self.ends,
            couplings: &self.couplings,
            updates: &self.updates,
        };
        let tables = LawInputs::courses(&[]).with(LawTables {
            pieces: &self.pieces,
            features: &self.features,
            knots: (&self.road.0, &self.road.1),
        });
        Model {
            mechanism: TreeSlices {
                links: &self.links,
                loops: Loops {
                    loops: &self.loops,
                    rows: &self.rows,
                    plan,
                    floor: self.floor,
                    couplings: self.couplings_of_rows(),
                },
                loads: &self.loads,
                rotors: &self.rotors,
                tables,
                feedback: FeedbackSlices {
                    steps: &self.operations,
                    links: &self.measured,
                    measures: &[],
                    n_states: self.states.len(),
                    signals: &[],
                },
                gravity: self.gravity,
                base: self.base,
                length: self.length,
                n_coordinates: self.n[0],
                n_freedoms: self.n[1],
            },
            prescriptions: Prescriptions {
                guides: &self.guides,
                courses: &self.courses,
                knots: (&self.knots.0, &self.knots.1),
                rows: &self.course_rows,
            },
            start: StartState {
                t: self.t,
                z: &self.z,
                v: &self.v,
                a: &self.a,
                signals: &self.states,
            },
            rungs: &self.rungs,
        }
    }
}

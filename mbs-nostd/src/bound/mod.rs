//! The bound: operations of one step, from the structure of a model alone.
//!
//! ```text
//! step         inputs + (E + 1) reach + E evaluation + P projection          E evaluations, P projections, σ further sweeps
//!              (+ inputs + evaluation where courses are written between steps)
//! evaluation   Σ links [place, inertia, eliminate, advance, (+ inward shift unless on the ground)]
//!              + Σ loops [rows, passes, elimination, opening, residual] + effects [spread, forces ahead] + σ (response + residual)
//! response     Σ links [impulse, advance (+ shift)] + Σ loops [passes and eliminations of l alone, opening]
//! projection   Σ links place + Σ loops rows + 2 response + move
//! ```
//!
//! Counts are exact for mechanisms without effects, and with springs and dampers: no branch of the kernels depends on numbers. Of other effects the branch that costs most is counted, and on roads
//! that are not level the longest search for the nearest point: there the count is a bound.
//!
//! Products, sums and differences, quotients, roots, and calls of sine with cosine or of the arc tangent are counted; changes of
//! sign, comparisons and copies are not: they are in the instructions of the others.

mod effects;
mod joints;
mod loops;

use crate::inputs::SignalLaw;
use crate::model::Model;
use core::ops::{Add, AddAssign, Mul};
use mbs_core::Real;
use mbs_recursive::bounded::Bounds;
use mbs_recursive::link::Link;
use mbs_recursive::space::{Numbers, Space};

/// Counts of arithmetic operations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Operations {
    /// Products.
    pub products: u64,
    /// Sums and differences.
    pub sums: u64,
    /// Quotients.
    pub quotients: u64,
    /// Square roots.
    pub roots: u64,
    /// Sines with their cosines, and arc tangents.
    pub turns: u64,
    /// Entries of Λ, l and gains that the kernels of loops look up by number: no arithmetic, but instructions.
    pub entries: u64,
}

impl Operations {
    /// None.
    pub const NONE: Self = Self::new(0, 0);

    /// Products and sums.
    pub(crate) const fn new(products: u64, sums: u64) -> Self {
        Self { products, sums, quotients: 0, roots: 0, turns: 0, entries: 0 }
    }

    /// Entries that are looked up.
    pub(crate) const fn entries(entries: u64) -> Self {
        Self { entries, ..Self::NONE }
    }

    /// With quotients, roots and turns.
    pub(crate) const fn and(self, quotients: u64, roots: u64, turns: u64) -> Self {
        Self { quotients, roots, turns, ..self }
    }

    /// All operations, each counted as one; entries are none.
    #[must_use]
    pub const fn total(&self) -> u64 {
        self.products + self.sums + self.quotients + self.roots + self.turns
    }

    /// The bound of instructions of a Cortex-M whose arithmetic unit has the precision: 7 for two products or sums with their loads,
    /// stores and part of the loops, 16 for a quotient, 40 to find an entry. In single precision a root is an instruction between moves, and turns
    /// need no doubles; in double precision both are functions of libm. Angles beyond 6400 rad, in double precision 1e6 rad, cost more.
    #[must_use]
    pub const fn instructions(&self, is_double: bool) -> u64 {
        let (root, turn) = if is_double { (140, 400) } else { (20, 120) };
        (self.products + self.sums) * 7 / 2
            + self.quotients * 16
            + self.roots * root
            + self.turns * turn
            + self.entries * 40
    }
}

impl Add for Operations {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            products: self.products + other.products,
            sums: self.sums + other.sums,
            quotients: self.quotients + other.quotients,
            roots: self.roots + other.roots,
            turns: self.turns + other.turns,
            entries: self.entries + other.entries,
        }
    }
}

impl AddAssign for Operations {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul<u64> for Operations {
    type Output = Self;
    fn mul(self, n: u64) -> Self {
        Self {
            products: self.products * n,
            sums: self.sums * n,
            quotients: self.quotients * n,
            roots: self.roots * n,
            turns: self.turns * n,
            entries: self.entries * n,
        }
    }
}

/// A length as a count.
pub(crate) const fn count(n: usize) -> u64 {
    n as u64
}

/// The operations of one step within `bounds`.
///
/// Cost: linear in the tables.
#[must_use]
pub fn step<T: Real, S: Space<T>>(model: &Model<'_, T, S>, bounds: Bounds) -> Operations {
    let m = &model.mechanism;
    let freedoms = count(m.n_freedoms);
    let has_loops = !m.loops.loops.is_empty();
    let evaluations = u64::from(bounds.evaluations.max(1));
    // h² β and h γ; the time at the end, for inputs and for the state.
    let mut total = Operations::new(3, 2) + effects::inputs(&model.prescriptions);
    let reach = Operations::new(7, 6) * freedoms + moves::<T, S>(m.links);
    total += reach * (evaluations + 1);
    // What the accelerations changed by, and its scale.
    let mut evaluation = Operations::new(1, freedoms);
    for link in skip_ground(m.links) {
        evaluation += joints::evaluation::<T, S>(link);
    }
    if !m.loads.is_empty() {
        for link in skip_ground(m.links) {
            evaluation += joints::spread::<T, S>(link.kind);
        }
        for load in m.loads {
            evaluation += effects::load(m, load);
        }
    }
    if has_loops {
        let residual = loops::residual::<T, S>(count(m.loops.rows.len()));
        let answer = response(m)
            + Operations::new(
                0,
                count(S::Motion::N * m.links.len() + m.n_freedoms + m.loops.rows.len()),
            );
        evaluation += loops::rows(m) + loops::evaluation(m) + residual;
        evaluation += (residual + answer) * u64::from(bounds.sweeps);
        let mut projection = loops::rows(m) + response(m) * 2 + moves::<T, S>(m.links);
        for link in skip_ground(m.links) {
            projection += joints::place::<T, S>(link.kind);
        }
        projection += Operations::new(0, freedoms);
        total += projection * u64::from(bounds.projections);
    }
    let written = |course: &SignalLaw<T>| matches!(course, SignalLaw::Input(_));
    if model.prescriptions.courses.iter().any(written) {
        // A step after a course was written begins with an evaluation.
        total += evaluation + effects::inputs(&model.prescriptions);
    }
    total + evaluation * evaluations
}

fn skip_ground<T: Real, S: Space<T>>(links: &[Link<T, S>]) -> impl Iterator<Item = &Link<T, S>> {
    links.iter().skip(1)
}

/// Coordinates moved along freedoms.
fn moves<T: Real, S: Space<T>>(links: &[Link<T, S>]) -> Operations {
    let mut sum = Operations::NONE;
    for link in skip_ground(links) {
        sum += joints::moved::<T, S>(link.kind);
    }
    sum
}

/// A response to rows alone.
fn response<T: Real, S: Space<T>>(m: &mbs_recursive::mechanism::Mechanism<'_, T, S>) -> Operations {
    let mut sum = loops::response(m);
    for link in skip_ground(m.links) {
        sum += joints::response::<T, S>(link);
    }
    sum
}

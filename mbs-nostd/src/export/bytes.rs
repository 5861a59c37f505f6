//! A model as bytes, in the format that `Tables::read` reads.

use crate::format::{Axes, Bytes, Record};
use crate::model::Model;
use crate::tables::{HEAD, WITH_CURVES, WITH_LINES, WITH_ROTORS, WITH_SIGNALS};
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::laws::entry::{Entry, EntryWriter};
use mbs_recursive::rows::coupled::Couplings;

impl Bytes {
    /// Writes a list of table entries to which laws refer.
    fn entries<T: Real + Record, X: Entry<T>>(&mut self, list: &[X]) -> bool {
        list.len().write(self) && list.iter().all(|entry| entry.numbers(self))
    }

    /// Writes the length of a list, then its entries. Returns false if an entry cannot be written.
    fn list<X: Record>(&mut self, list: &[X]) -> bool {
        list.len().write(self) && list.iter().all(|entry| entry.write(self))
    }

    /// Writes the operations on signals, with the tables to which they refer.
    fn signals<T: Real + Record, S: Axes<T>>(&mut self, model: &Model<'_, T, S>) -> bool {
        let feedback = &model.mechanism.feedback;
        self.list(feedback.steps)
            && self.list(feedback.links)
            && self.curves(&model.mechanism.loops.couplings)
            && self.list(model.start.signals)
    }

    /// Writes curves, with their knots and numbers.
    fn curves<T: Real + Record, S: Axes<T>>(&mut self, of: &Couplings<'_, T, S>) -> bool {
        self.list(of.curves) && self.list(of.knots) && self.list(of.numbers)
    }
}

/// Returns the bytes of a model, in single or double precision. `None` if the model has an effect that cannot be written, for example a
/// user-defined law.
#[must_use]
pub fn bytes<T: Real + Record, S: Axes<T>>(
    model: &Model<'_, T, S>,
    is_single: bool,
) -> Option<Vec<u8>> {
    let m = &model.mechanism;
    let (plan, laws, begin) = (&m.loops.plan, &model.prescriptions, &model.start);
    let tables = m.tables.tables();
    let to = &mut Bytes { bytes: Vec::new(), is_single };
    let width = if is_single { 4 } else { 8 };
    let couplings = &m.loops.couplings;
    let (has_rotors, has_signals) = (!m.rotors.is_empty(), !m.feedback.steps.is_empty());
    let (has_curves, has_lines) =
        (!has_signals && !couplings.curves.is_empty(), !couplings.points.is_empty());
    let parts = [
        (has_rotors, WITH_ROTORS),
        (has_signals, WITH_SIGNALS),
        (has_curves, WITH_CURVES),
        (has_lines, WITH_LINES),
    ];
    let version = parts.iter().filter(|(has_it, _)| *has_it).fold(HEAD[1], |sum, (_, x)| sum + x);
    let done = [HEAD[0], version].write(to)
        && [S::DIMENSION, width].write(to)
        && to.list(m.links)
        && to.list(plan.stations)
        && to.list(m.loops.loops)
        && to.list(m.loops.rows)
        && to.list(couplings.terms)
        && to.list(plan.passes)
        && to.list(plan.pairs)
        && to.list(plan.ends)
        && to.list(plan.couplings)
        && to.list(plan.updates)
        && to.list(m.loads)
        && to.entries::<T, _>(tables.pieces)
        && to.entries::<T, _>(tables.features)
        && to.entries::<T, _>(tables.knots.0)
        && to.entries::<T, _>(tables.knots.1)
        && to.list(laws.guides)
        && to.list(laws.courses)
        && to.list(laws.knots.0)
        && to.list(laws.knots.1)
        && to.list(laws.rows)
        && to.list(model.rungs)
        && to.list(begin.z)
        && to.list(begin.v)
        && to.list(begin.a)
        && m.loops.floor.write(to)
        && couplings.n_cut.write(to)
        && m.gravity.write(to)
        && m.base.write(to)
        && m.length.write(to)
        && [m.n_coordinates, m.n_freedoms].write(to)
        && begin.t.write(to)
        && (!has_rotors || to.list(m.rotors))
        && (!has_signals || to.signals(model))
        && (!has_curves || to.curves(couplings))
        && (!has_lines || (to.list(couplings.points) && to.list(couplings.starts)));
    done.then(|| core::mem::take(&mut to.bytes))
}

impl<T: Real + Record> EntryWriter<T> for Bytes {
    fn real(&mut self, x: T) {
        self.put_real(x.to_f64());
    }
    fn word(&mut self, x: u32) {
        self.put(&x.to_le_bytes());
    }
    fn flag(&mut self, x: bool) {
        self.put(&u32::from(x).to_le_bytes());
    }
    fn tag(&mut self, tag: u32) {
        self.put(&tag.to_le_bytes());
    }
    fn none(&mut self) {
        self.put(&0_u32.to_le_bytes());
    }
    fn some(&mut self) {
        self.put(&1_u32.to_le_bytes());
    }
}

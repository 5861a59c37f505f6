//! Writing and reading of histories and states on a tape.

use super::tape::{Tape, Walked, holds};
use mbs_core::Real;
use mbs_core::history::{Entry, Numbers, Shape};
use mbs_core::model::State;

/// Writing and reading of data types that several parts of a checkpoint contain.
pub(super) trait Parts: Tape {
    /// Writes or reads the history of a formulation (the values that its next step depends on), in order and without their names.
    fn history<T: Real>(&mut self, entries: &mut [Entry<T>]) -> Walked {
        entries.iter_mut().try_for_each(|Entry { shape, numbers, .. }| match numbers {
            Numbers::Reals(x) => array(self, *shape, (x, 8), Self::real),
            Numbers::Floats(x) => array(self, *shape, (x, 8), Self::float),
            Numbers::Counts(x) => array(self, *shape, (x, 8), Self::count),
            Numbers::Small(x) => array(self, *shape, (x, 4), Self::small),
            Numbers::Flags(x) => array(self, *shape, (x, 1), Self::flag),
            Numbers::Part { is_some, entries } => {
                self.flag(is_some)?;
                if *is_some { self.history(entries) } else { Ok(()) }
            }
        })
    }

    /// Writes or reads the stored values of the step control by error estimates.
    fn errors(&mut self, (memory, was_rejected): &mut (Option<f64>, bool)) -> Walked {
        self.option(memory, Tape::float)?;
        self.flag(was_rejected)
    }

    /// Writes or reads a state in natural coordinates.
    fn state<T: Real>(&mut self, state: &mut State<T>) -> Walked {
        let State {
            t,
            dt,
            q,
            q_low,
            v,
            a,
            a_aux,
            lambda,
            lambda_previous,
            reaction,
            phi,
            memory,
            inputs: _,
            applied,
            signals,
            work,
            power,
        } = state;
        [t, dt, work, power].into_iter().try_for_each(|x| self.real(x))?;
        [q, q_low, v, a, a_aux, lambda, lambda_previous, reaction, phi, memory]
            .into_iter()
            .try_for_each(|x| self.reals(x))?;
        let (threes, ones) = applied.as_chunks_mut::<3>();
        self.places(threes, |tape, value| tape.reals(value))?;
        // Empty lists are not written, so a scene without signals needs no bytes for them.
        for numbers in [ones, signals.as_flattened_mut()] {
            if !numbers.is_empty() {
                self.reals(numbers)?;
            }
        }
        Ok(())
    }
}

impl<P: Tape> Parts for P {}

/// Writes or reads an array of values that need at least `size` bytes each.
fn array<P: Tape, E: Copy + Default + PartialEq>(
    tape: &mut P,
    shape: Shape,
    (x, size): (&mut Vec<E>, usize),
    mut each: impl FnMut(&mut P, &mut E) -> Walked,
) -> Walked {
    match shape {
        Shape::Fixed => {}
        Shape::Constant => {
            let is = x.clone();
            x.iter_mut().try_for_each(|x| each(tape, x))?;
            return holds(*x == is);
        }
        Shape::Rows(width) => same(tape, x.len() / width)?,
        Shape::Arrays(width) => {
            same(tape, x.len() / width)?;
            return x.chunks_mut(width).try_for_each(|row| {
                same(tape, width)?;
                row.iter_mut().try_for_each(|x| each(tape, x))
            });
        }
        Shape::List(width) => {
            let mut n = (x.len() / width) as u64;
            tape.count(&mut n)?;
            if let Some(left) = tape.left() {
                holds(n <= (left / (size * width)) as u64)?;
                x.resize(usize::try_from(n).unwrap_or(0) * width, E::default());
            }
        }
    }
    x.iter_mut().try_for_each(|x| each(tape, x))
}

/// Writes or reads a number of rows. Reading fails if the number differs from the model's number `n`.
fn same(tape: &mut impl Tape, n: usize) -> Walked {
    let mut found = n as u64;
    tape.count(&mut found)?;
    holds(found == n as u64)
}

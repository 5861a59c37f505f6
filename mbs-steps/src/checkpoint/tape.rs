//! Tapes: byte streams to which values are written, or from which values are read. One function for each type does both, so that writing
//! and reading always agree. Numbers are little-endian. A list is stored after its length.
//!
//! Invalid bytes cause an error and no panic. A list is never longer than the remaining bytes allow. A physical value is finite, and a
//! count is small enough to increase without overflow.

use super::CheckpointError;
use crate::precision::is_finer;
use core::time::Duration;
use mbs_core::Real;

/// Result of writing or reading on a tape.
pub type Walked = Result<(), CheckpointError>;

/// Largest 64-bit count in a file. A larger count could overflow during the run.
const MAX_U64: u64 = 1 << 60;
/// Largest 32-bit count in a file. A larger count could overflow during the run.
const MAX_U32: u32 = 1 << 30;

/// Bytes to which values are written, or from which values are read.
#[allow(
    clippy::missing_errors_doc,
    reason = "each fails with a `CheckpointError` where the bytes are not those of the item"
)]
pub trait Tape: Sized {
    /// Writes the given bytes, or replaces them by bytes that are read.
    fn bytes(&mut self, bytes: &mut [u8]) -> Walked;

    /// Number of bytes that remain to be read; `None` for a tape that writes.
    fn left(&self) -> Option<usize>;

    /// Writes or reads a count.
    fn count(&mut self, x: &mut u64) -> Walked {
        let mut bytes = x.to_le_bytes();
        self.bytes(&mut bytes)?;
        *x = u64::from_le_bytes(bytes);
        holds(*x <= MAX_U64)
    }

    /// Writes or reads 64 bits of any value.
    fn word(&mut self, x: &mut u64) -> Walked {
        let mut bytes = x.to_le_bytes();
        self.bytes(&mut bytes)?;
        *x = u64::from_le_bytes(bytes);
        Ok(())
    }

    /// Writes or reads a count of 32 bits.
    fn small(&mut self, x: &mut u32) -> Walked {
        let mut bytes = x.to_le_bytes();
        self.bytes(&mut bytes)?;
        *x = u32::from_le_bytes(bytes);
        holds(*x <= MAX_U32)
    }

    /// Writes or reads an index, which must be less than `below`.
    fn index(&mut self, x: &mut usize, below: usize) -> Walked {
        let mut count = *x as u64;
        self.count(&mut count)?;
        *x = usize::try_from(count).map_err(|_| CheckpointError::Misfit)?;
        holds(*x < below)
    }

    /// Writes or reads a Boolean as one byte.
    fn flag(&mut self, x: &mut bool) -> Walked {
        let mut byte = [u8::from(*x)];
        self.bytes(&mut byte)?;
        *x = byte == [1];
        holds(byte[0] <= 1)
    }

    /// Writes or reads a number, which may be infinite or NaN.
    fn float(&mut self, x: &mut f64) -> Walked {
        let mut bits = x.to_bits();
        self.word(&mut bits)?;
        *x = f64::from_bits(bits);
        Ok(())
    }

    /// Writes or reads several numbers, which may be infinite or NaN.
    fn floats(&mut self, x: &mut [f64]) -> Walked {
        x.iter_mut().try_for_each(|x| self.float(x))
    }

    /// Writes or reads a physical value with all its bits; it must be finite.
    fn real<T: Real>(&mut self, x: &mut T) -> Walked {
        let [mut near, mut rest] = x.parts();
        self.float(&mut near)?;
        if is_finer::<T>() {
            self.float(&mut rest)?;
        }
        *x = T::from_parts([near, rest]);
        holds(self.left().is_none() || x.is_finite())
    }

    /// Writes or reads physical values; their number is the length of the slice.
    fn reals<T: Real>(&mut self, x: &mut [T]) -> Walked {
        self.places(x, Self::real)
    }

    /// Writes or reads a duration in nanoseconds.
    fn duration(&mut self, x: &mut Duration) -> Walked {
        let mut nanoseconds = u64::try_from(x.as_nanos()).unwrap_or(MAX_U64).min(MAX_U64);
        self.count(&mut nanoseconds)?;
        *x = Duration::from_nanos(nanoseconds);
        Ok(())
    }

    /// Writes or reads items; their number is the length of the slice.
    fn places<E>(
        &mut self,
        x: &mut [E],
        mut each: impl FnMut(&mut Self, &mut E) -> Walked,
    ) -> Walked {
        let mut n = x.len() as u64;
        self.count(&mut n)?;
        holds(n == x.len() as u64)?;
        x.iter_mut().try_for_each(|x| each(self, x))
    }

    /// Writes or reads a list of items that need at least `size` bytes each.
    fn list<E: Default>(
        &mut self,
        list: &mut Vec<E>,
        size: usize,
        mut each: impl FnMut(&mut Self, &mut E) -> Walked,
    ) -> Walked {
        let mut n = list.len() as u64;
        self.count(&mut n)?;
        if let Some(left) = self.left() {
            holds(n <= (left / size) as u64)?;
            list.clear();
            list.resize_with(usize::try_from(n).unwrap_or(0), E::default);
        }
        list.iter_mut().try_for_each(|x| each(self, x))
    }

    /// Writes or reads an optional item.
    fn option<E: Default>(
        &mut self,
        x: &mut Option<E>,
        each: impl FnOnce(&mut Self, &mut E) -> Walked,
    ) -> Walked {
        let mut is_some = x.is_some();
        self.flag(&mut is_some)?;
        if self.left().is_some() {
            *x = is_some.then(E::default);
        }
        x.as_mut().map_or(Ok(()), |x| each(self, x))
    }

    /// Writes or reads a text.
    fn text(&mut self, text: &mut String) -> Walked {
        let mut bytes = core::mem::take(text).into_bytes();
        self.list(&mut bytes, 1, |tape, byte| tape.bytes(core::slice::from_mut(byte)))?;
        *text = String::from_utf8(bytes).map_err(|_| CheckpointError::Misfit)?;
        Ok(())
    }

    /// Writes or reads one of the given words, or `None`.
    fn word_of(&mut self, x: &mut Option<&'static str>, words: &[&'static str]) -> Walked {
        let mut place = x.and_then(|x| words.iter().position(|w| *w == x)).unwrap_or(words.len());
        self.index(&mut place, words.len() + 1)?;
        *x = words.get(place).copied();
        Ok(())
    }
}

/// Returns the error `Misfit` if a condition does not hold.
pub fn holds(does: bool) -> Walked {
    if does { Ok(()) } else { Err(CheckpointError::Misfit) }
}

/// Tape that writes into memory.
#[derive(Debug, Default)]
pub struct Pen(pub Vec<u8>);

impl Tape for Pen {
    fn bytes(&mut self, bytes: &mut [u8]) -> Walked {
        self.0.extend_from_slice(bytes);
        Ok(())
    }

    fn left(&self) -> Option<usize> {
        None
    }
}

/// Tape that reads from memory.
#[derive(Debug)]
pub struct Eye<'a>(pub &'a [u8]);

impl Tape for Eye<'_> {
    fn bytes(&mut self, bytes: &mut [u8]) -> Walked {
        let (head, rest) = self.0.split_at_checked(bytes.len()).ok_or(CheckpointError::Misfit)?;
        bytes.copy_from_slice(head);
        self.0 = rest;
        Ok(())
    }

    fn left(&self) -> Option<usize> {
        Some(self.0.len())
    }
}

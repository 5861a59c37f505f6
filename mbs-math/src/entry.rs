//! Traits of values that are written as numbers in a fixed order, into tables of controllers, and read from them.

use crate::Real;

/// Reader of a sequence of numbers, from which entries are read.
pub trait EntryReader<T> {
    /// Error when a number cannot be read.
    type Error;

    /// Reads a real number.
    ///
    /// # Errors
    /// The reader's error at the end of the numbers.
    fn real(&mut self) -> Result<T, Self::Error>;

    /// Reads a count or an index.
    ///
    /// # Errors
    /// The reader's error at the end of the numbers.
    fn word(&mut self) -> Result<u32, Self::Error>;

    /// The error for a number that was read and is not valid at its place.
    fn fault(&self) -> Self::Error;
}

/// Writer of values, as bytes or as an expression of Rust. The methods with an empty default write parts of the expression that have no
/// bytes.
pub trait EntryWriter<T> {
    /// Writes a real number.
    fn real(&mut self, x: T);
    /// Writes a count or an index.
    fn word(&mut self, x: u32);
    /// Writes a Boolean value.
    fn flag(&mut self, x: bool);
    /// Writes the number of an enum variant. The expression has the variant's name instead.
    fn tag(&mut self, tag: u32);
    /// Writes an optional value that does not exist, `None`.
    fn none(&mut self);
    /// Begins an optional value that exists. The value is written next, and [`text`](Self::text) closes it.
    fn some(&mut self);
    /// Begins a struct or an enum variant of this name.
    fn open(&mut self, _name: &'static str) {}
    /// Begins a field, by its name or by its index in a tuple.
    fn field(&mut self, _name: &'static str) {}
    /// Ends a struct or an enum variant.
    fn close(&mut self) {}
    /// Writes text of the expression, such as words and brackets.
    fn text(&mut self, _text: &'static str) {}
}

/// A value that consists of numbers in a fixed order.
pub trait Entry<T>: Sized {
    /// Reads the value from a reader.
    ///
    /// # Errors
    /// The errors of the reader.
    fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error>;

    /// Writes the numbers of the value; returns `false` when the value does not consist of numbers.
    fn numbers<W: EntryWriter<T>>(&self, to: &mut W) -> bool;
}

/// Type without values, for an entry that the build does not support.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Absent {}

/// Entry type of a table that is always empty, for any scalar.
pub trait NoEntry {
    /// Entry type of the table, [`Absent`].
    type Entry;
}

impl<T> NoEntry for core::marker::PhantomData<T> {
    type Entry = Absent;
}

impl<T> Entry<T> for Absent {
    fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
        Err(from.fault())
    }
    fn numbers<W: EntryWriter<T>>(&self, _: &mut W) -> bool {
        match *self {}
    }
}

impl<T: Real> Entry<T> for T {
    fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
        from.real()
    }
    fn numbers<W: EntryWriter<T>>(&self, to: &mut W) -> bool {
        to.real(*self);
        true
    }
}

impl<T: Real> Entry<T> for u32 {
    fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
        from.word()
    }
    fn numbers<W: EntryWriter<T>>(&self, to: &mut W) -> bool {
        to.word(*self);
        true
    }
}

impl<T: Real> Entry<T> for usize {
    fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
        Ok(from.word()? as Self)
    }
    fn numbers<W: EntryWriter<T>>(&self, to: &mut W) -> bool {
        u32::try_from(*self).is_ok_and(|x| Entry::<T>::numbers(&x, to))
    }
}

impl<T: Real> Entry<T> for bool {
    fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
        match from.word()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(from.fault()),
        }
    }
    fn numbers<W: EntryWriter<T>>(&self, to: &mut W) -> bool {
        to.flag(*self);
        true
    }
}

impl<T: Real, const N: usize> Entry<T> for [T; N] {
    fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
        let mut all = [T::ZERO; N];
        for x in &mut all {
            *x = from.real()?;
        }
        Ok(all)
    }
    fn numbers<W: EntryWriter<T>>(&self, to: &mut W) -> bool {
        to.text("[");
        for (i, x) in self.iter().enumerate() {
            to.text(if i > 0 { ", " } else { "" });
            to.real(*x);
        }
        to.text("]");
        true
    }
}

impl<T: Real, X: Entry<T>> Entry<T> for Option<X> {
    fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
        Ok(if <bool as Entry<T>>::of(from)? { Some(X::of(from)?) } else { None })
    }
    fn numbers<W: EntryWriter<T>>(&self, to: &mut W) -> bool {
        let Some(x) = self else {
            to.none();
            return true;
        };
        to.some();
        let is_written = x.numbers(to);
        to.text(")");
        is_written
    }
}

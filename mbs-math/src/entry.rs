//! Values as numbers in a fixed order: the traits of what is written into tables of controllers and read again.

use crate::Real;

/// Reader of the numbers of an entry.
pub trait EntryReader<T> {
    /// Why there is none.
    type Error;

    /// Reads a real number.
    ///
    /// # Errors
    /// At the end.
    fn real(&mut self) -> Result<T, Self::Error>;

    /// A count or a place.
    ///
    /// # Errors
    /// At the end.
    fn word(&mut self) -> Result<u32, Self::Error>;

    /// The last number is none that can stand there.
    fn fault(&self) -> Self::Error;
}

/// Writer of numbers, as bytes or as an expression of Rust. What is for the expression alone is left out of bytes.
pub trait EntryWriter<T> {
    /// Writes a real number.
    fn real(&mut self, x: T);
    /// A count or a place.
    fn word(&mut self, x: u32);
    /// Writes a claim, true or false.
    fn flag(&mut self, x: bool);
    /// The number of a variant, which an expression names.
    fn tag(&mut self, tag: u32);
    /// Writes that there is nothing, `None`.
    fn none(&mut self);
    /// Something, which is written next; [`text`](Self::text) closes it.
    fn some(&mut self);
    /// Begins a struct, or a variant.
    fn open(&mut self, _name: &'static str) {}
    /// Begins a field by its name, or by its place in a tuple.
    fn field(&mut self, _name: &'static str) {}
    /// Ends a struct, or a variant.
    fn close(&mut self) {}
    /// Writes words and brackets.
    fn text(&mut self, _text: &'static str) {}
}

/// Value that is made of numbers in a fixed order.
pub trait Entry<T>: Sized {
    /// Reads the value from a reader.
    ///
    /// # Errors
    /// Those of the reader.
    fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error>;

    /// Writes the value's numbers; false if it is not made of numbers.
    fn numbers<W: EntryWriter<T>>(&self, to: &mut W) -> bool;
}

/// Entry that a build cannot have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Absent {}

/// The entry of a table that is always empty, for any scalar.
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

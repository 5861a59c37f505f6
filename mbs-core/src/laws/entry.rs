//! Conversion of laws to the lists of numbers in tables of controllers, and back.

use super::Part;
use crate::Real;
pub use mbs_math::entry::{Absent, Entry, EntryReader, EntryWriter, NoEntry};

impl<T: Real> Entry<T> for Part {
    fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
        Ok(Self { first: from.word()?, n: from.word()? })
    }
    fn numbers<W: EntryWriter<T>>(&self, to: &mut W) -> bool {
        to.open("Part");
        to.field("first");
        to.word(self.first);
        to.field("n");
        to.word(self.n);
        to.close();
        true
    }
}

/// Declares the numbers of a struct or of an enum's variants: field names, or places in a tuple.
macro_rules! entry {
    ($Name:ident $(<$S:ident>)? { $($field:tt),* $(,)? }) => {
        impl<T: $crate::Real> $crate::laws::entry::Entry<T> for $Name $(<$S>)? {
            fn of<R: $crate::laws::entry::EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
                Ok(Self { $($field: $crate::laws::entry::Entry::<T>::of(from)?),* })
            }
            fn numbers<W: $crate::laws::entry::EntryWriter<T>>(&self, to: &mut W) -> bool {
                to.open(stringify!($Name));
                $(
                    to.field(stringify!($field));
                    if !$crate::laws::entry::Entry::<T>::numbers(&self.$field, to) {
                        return false;
                    }
                )*
                to.close();
                true
            }
        }
    };
    ($Name:ident enum { $($tag:literal $Variant:ident { $($field:tt $own:ident),* }),* $(,)? }) => {
        impl<T: $crate::Real> $crate::laws::entry::Entry<T> for $Name<T> {
            fn of<R: $crate::laws::entry::EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
                match from.word()? {
                    $($tag => Ok(Self::$Variant {
                        $($field: $crate::laws::entry::Entry::<T>::of(from)?),*
                    }),)*
                    _ => Err(from.fault()),
                }
            }
            fn numbers<W: $crate::laws::entry::EntryWriter<T>>(&self, to: &mut W) -> bool {
                match self {
                    $(Self::$Variant { $($field: $own),* } => {
                        to.tag($tag);
                        to.open(concat!(stringify!($Name), "::", stringify!($Variant)));
                        $(
                            to.field(stringify!($field));
                            if !$crate::laws::entry::Entry::<T>::numbers($own, to) {
                                return false;
                            }
                        )*
                        to.close();
                        true
                    })*
                }
            }
        }
    };
}
pub(crate) use entry;

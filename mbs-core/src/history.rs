//! History of a formulation: all that it remembers from step to step, as named arrays, of which checkpoints are made.
//!
//! ```text
//! history:      remembered numbers --Book--> named arrays
//! set_history:  named arrays --the same walk--> remembered numbers
//! ```

use crate::model::{ScalarForce, Terms};
use alloc::vec::Vec;

/// All that the next step depends on beside the state, in a fixed order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History<T> {
    /// Arrays of the history, in the order of the walk.
    pub entries: Vec<Entry<T>>,
}

/// Numbers under one name.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry<T> {
    /// Their name within the formulation.
    pub name: &'static str,
    /// How many they are.
    pub shape: Shape,
    /// Numbers of the array.
    pub numbers: Numbers<T>,
}

/// How many numbers an array has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Fixed number of values, which the formulation always has.
    Fixed,
    /// One number, the same in every history of the formulation.
    Constant,
    /// Rows of this width, as many as the model has.
    Rows(usize),
    /// Rows that are arrays themselves, of this width, as many as the model has.
    Arrays(usize),
    /// Any number of rows of this width.
    List(usize),
}

/// The kinds of numbers.
#[derive(Debug, Clone, PartialEq)]
pub enum Numbers<T> {
    /// Finite numbers of the mechanics, to the last bit.
    Reals(Vec<T>),
    /// Doubles that may be any.
    Floats(Vec<f64>),
    /// Counts, as 64-bit integers.
    Counts(Vec<u64>),
    /// Small counts, as 32-bit integers.
    Small(Vec<u32>),
    /// Flags, each yes or no.
    Flags(Vec<bool>),
    /// Entries that may be missing.
    Part {
        /// Whether the entries are there.
        is_some: bool,
        /// Entries of the part, or what stands in their place.
        entries: Vec<Entry<T>>,
    },
}

/// A history that is of another formulation, of another model, or no history.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RestoreError;

impl core::fmt::Display for RestoreError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("the history belongs to another formulation or another model: restore one that this simulation saved")
    }
}

impl core::error::Error for RestoreError {}

/// The outcome of a walk.
pub type Restored = Result<(), RestoreError>;

/// One walk over what is remembered, which fills a history or reads it back.
#[derive(Debug)]
pub struct Book<'a, T> {
    entries: Entries<'a, T>,
}

#[derive(Debug)]
enum Entries<'a, T> {
    Written(Vec<Entry<T>>),
    Read(core::slice::Iter<'a, Entry<T>>),
}

macro_rules! single {
    ($(#[$doc:meta] $name:ident, $many:ident, $kind:ident, $number:ty;)*) => {
        $(
            #[$doc]
            ///
            /// # Errors
            /// [`RestoreError`] where the history has something else here.
            pub fn $name(&mut self, name: &'static str, x: &mut $number) -> Restored {
                self.$many((name, Shape::Fixed), core::slice::from_mut(x))
            }

            fn $many(&mut self, (name, shape): (&'static str, Shape), x: &mut [$number]) -> Restored {
                match &mut self.entries {
                    Entries::Written(entries) => {
                        entries.push(Entry { name, shape, numbers: Numbers::$kind(x.to_vec()) });
                    }
                    Entries::Read(entries) => match entries.next() {
                        Some(Entry { numbers: Numbers::$kind(kept), .. }) if kept.len() == x.len() => {
                            x.copy_from_slice(kept);
                        }
                        _ => return Err(RestoreError),
                    },
                }
                Ok(())
            }
        )*
    };
}

impl<'a, T: Copy> Book<'a, T> {
    /// Fills a new history by a walk.
    ///
    /// # Errors
    /// Those of the walk.
    pub fn write(walk: impl FnOnce(&mut Self) -> Restored) -> Result<History<T>, RestoreError> {
        let mut book = Self { entries: Entries::Written(Vec::new()) };
        walk(&mut book)?;
        Ok(History { entries: book.written() })
    }

    /// Reads a history, all of it.
    ///
    /// # Errors
    /// Those of the walk, and [`RestoreError`] where entries are left.
    pub fn read(
        history: &'a History<T>,
        walk: impl FnOnce(&mut Self) -> Restored,
    ) -> Result<(), RestoreError> {
        let mut book = Self { entries: Entries::Read(history.entries.iter()) };
        walk(&mut book)?;
        book.check_end()
    }

    fn written(self) -> Vec<Entry<T>> {
        match self.entries {
            Entries::Written(entries) => entries,
            Entries::Read(_) => Vec::new(),
        }
    }

    fn check_end(self) -> Restored {
        match self.entries {
            Entries::Read(entries) if !entries.as_slice().is_empty() => Err(RestoreError),
            _ => Ok(()),
        }
    }

    single! {
        /// A number of the mechanics.
        real, reals, Reals, T;
        /// A double that may be any.
        float, floats, Floats, f64;
        /// A count.
        count, counts, Counts, u64;
        /// A small count.
        small, smalls, Small, u32;
        /// Yes or no.
        flag, flags, Flags, bool;
    }

    /// The number of the formulation's kind: 0 augmented, 1 classical, 2 state space, 3 recursive, and so on.
    ///
    /// # Errors
    /// [`RestoreError`] where the history is of another kind.
    pub fn kind(&mut self, kind: u64) -> Restored {
        let mut x = kind;
        self.counts(("kind", Shape::Constant), core::slice::from_mut(&mut x))?;
        if x == kind { Ok(()) } else { Err(RestoreError) }
    }

    /// Doubles, as many as there always are.
    ///
    /// # Errors
    /// As for [`rows`](Self::rows).
    pub fn doubles(&mut self, name: &'static str, x: &mut [f64]) -> Restored {
        self.floats((name, Shape::Fixed), x)
    }

    /// Numbers, as many as the model has places.
    ///
    /// # Errors
    /// [`RestoreError`] where the history has something else here, or another number of them.
    pub fn rows(&mut self, name: &'static str, x: &mut [T]) -> Restored {
        self.reals((name, Shape::Rows(1)), x)
    }

    /// Vectors, as many as the model has places.
    ///
    /// # Errors
    /// As for [`rows`](Self::rows).
    pub fn vectors(&mut self, name: &'static str, x: &mut [[T; 3]]) -> Restored {
        self.reals((name, Shape::Arrays(3)), x.as_flattened_mut())
    }

    /// Any number of numbers.
    ///
    /// # Errors
    /// [`RestoreError`] where the history has something else here.
    pub fn list(&mut self, name: &'static str, x: &mut Vec<T>) -> Restored {
        if let Some(Numbers::Reals(kept)) = self.next_numbers() {
            x.clone_from(kept);
        }
        self.reals((name, Shape::List(1)), x)
    }

    /// Any number of pairs of small counts.
    ///
    /// # Errors
    /// [`RestoreError`] where the history has something else here.
    pub fn pairs(&mut self, name: &'static str, x: &mut Vec<[u32; 2]>) -> Restored {
        if let Some(Numbers::Small(kept)) = self.next_numbers() {
            x.resize(kept.len() / 2, [0; 2]);
        }
        self.smalls((name, Shape::List(2)), x.as_flattened_mut())
    }

    /// The next numbers of a history that is read.
    fn next_numbers(&self) -> Option<&'a Numbers<T>> {
        match &self.entries {
            Entries::Written(_) => None,
            Entries::Read(entries) => Some(&entries.as_slice().first()?.numbers),
        }
    }

    /// Writes or reads a part that may be missing, by a walk over it.
    ///
    /// # Errors
    /// Those of the walk over it, and [`RestoreError`] where the history has something else here.
    pub fn option<E: Default>(
        &mut self,
        name: &'static str,
        x: &mut Option<E>,
        walk: impl FnOnce(&mut Self, &mut E) -> Restored,
    ) -> Restored {
        if let Entries::Read(all) = &mut self.entries {
            let Some(Entry { numbers: Numbers::Part { is_some, entries }, .. }) = all.next() else {
                return Err(RestoreError);
            };
            *x = is_some.then(E::default);
            let Some(x) = x else { return Ok(()) };
            let mut book = Book { entries: Entries::Read(entries.iter()) };
            walk(&mut book, x)?;
            return book.check_end();
        }
        let (is_some, mut none) = (x.is_some(), E::default());
        let mut book = Self { entries: Entries::Written(Vec::new()) };
        walk(&mut book, x.as_mut().unwrap_or(&mut none))?;
        let numbers = Numbers::Part { is_some, entries: book.written() };
        if let Entries::Written(entries) = &mut self.entries {
            entries.push(Entry { name, shape: Shape::Fixed, numbers });
        }
        Ok(())
    }

    /// Writes or reads what energies are found from: the laws as last evaluated, and the courses.
    ///
    /// # Errors
    /// As for [`rows`](Self::rows).
    pub fn laws(&mut self, terms: &mut Terms<T>) -> Restored {
        let numbers = |m: &ScalarForce<T>| {
            [m.value, m.rate, m.tension, m.stiffness, m.damping, m.transverse, m.drift]
        };
        let mut all: Vec<[T; 7]> = terms.measures.iter().map(numbers).collect();
        self.reals(("laws", Shape::Rows(7)), all.as_flattened_mut())?;
        for (measure, numbers) in terms.measures.iter_mut().zip(all) {
            let [value, rate, tension, stiffness, damping, transverse, drift] = numbers;
            *measure = ScalarForce { value, rate, tension, stiffness, damping, transverse, drift };
        }
        self.vectors("courses", &mut terms.courses)
    }
}

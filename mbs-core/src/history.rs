//! History of a formulation: the numbers that it remembers from step to step, as named arrays. Checkpoints store these arrays.
//!
//! ```text
//! history:      remembered numbers --Book--> named arrays
//! set_history:  named arrays --Book--> remembered numbers      (by the same sequence of calls)
//! ```

use crate::model::{ScalarForce, Terms};
use alloc::vec::Vec;

/// All numbers on which the next step depends in addition to the state, in a fixed order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History<T> {
    /// Arrays of the history, in the order in which the formulation lists them.
    pub entries: Vec<Entry<T>>,
}

/// An array of the history with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry<T> {
    /// Name of the array, unique within the formulation.
    pub name: &'static str,
    /// Number of values in the array.
    pub shape: Shape,
    /// Numbers of the array.
    pub numbers: Numbers<T>,
}

/// Shape of an array: what determines its number of values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Fixed number of values, the same for every model.
    Fixed,
    /// One number, the same in every history of the formulation.
    Constant,
    /// Rows of this width; the model gives the number of rows.
    Rows(usize),
    /// Rows of this width, each stored as an array; the model gives the number of rows.
    Arrays(usize),
    /// Rows of this width; their number may differ from step to step.
    List(usize),
}

/// Values of an array, by the type of their numbers.
#[derive(Debug, Clone, PartialEq)]
pub enum Numbers<T> {
    /// Finite numbers in the scalar of the run, stored exactly.
    Reals(Vec<T>),
    /// Double-precision numbers, which need not be finite.
    Floats(Vec<f64>),
    /// Counts, as 64-bit integers.
    Counts(Vec<u64>),
    /// Small counts, as 32-bit integers.
    Small(Vec<u32>),
    /// Flags, each true or false.
    Flags(Vec<bool>),
    /// A group of entries that may be absent.
    Part {
        /// Whether the group is present.
        is_some: bool,
        /// Entries of the group; placeholders of default values if it is absent.
        entries: Vec<Entry<T>>,
    },
}

/// Error: the data are no history, or the history of another formulation or another model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RestoreError;

impl core::fmt::Display for RestoreError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("the history belongs to another formulation or another model: restore one that this simulation saved")
    }
}

impl core::error::Error for RestoreError {}

/// Result of writing or reading a history.
pub type Restored = Result<(), RestoreError>;

/// Writer or reader of a history. The same sequence of calls fills a history or reads it back.
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
            /// [`RestoreError`] if the history has another entry at this place.
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
    /// Fills a new history with the entries that `walk` writes.
    ///
    /// # Errors
    /// Errors of `walk`.
    pub fn write(walk: impl FnOnce(&mut Self) -> Restored) -> Result<History<T>, RestoreError> {
        let mut book = Self { entries: Entries::Written(Vec::new()) };
        walk(&mut book)?;
        Ok(History { entries: book.written() })
    }

    /// Reads a history to its end with `walk`.
    ///
    /// # Errors
    /// Errors of `walk`, and [`RestoreError`] if `walk` leaves entries unread.
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
        /// Writes or reads one number in the scalar of the run.
        real, reals, Reals, T;
        /// Writes or reads one double-precision number, finite or not.
        float, floats, Floats, f64;
        /// Writes or reads one count.
        count, counts, Counts, u64;
        /// Writes or reads one small count.
        small, smalls, Small, u32;
        /// Writes or reads one flag.
        flag, flags, Flags, bool;
    }

    /// Writes or checks the number of the formulation's kind: 0 augmented, 1 classical, 2 state space, 3 recursive, and so on.
    ///
    /// # Errors
    /// [`RestoreError`] if the history is of another kind.
    pub fn kind(&mut self, kind: u64) -> Restored {
        let mut x = kind;
        self.counts(("kind", Shape::Constant), core::slice::from_mut(&mut x))?;
        if x == kind { Ok(()) } else { Err(RestoreError) }
    }

    /// Writes or reads a fixed number of double-precision numbers.
    ///
    /// # Errors
    /// As for [`rows`](Self::rows).
    pub fn doubles(&mut self, name: &'static str, x: &mut [f64]) -> Restored {
        self.floats((name, Shape::Fixed), x)
    }

    /// Writes or reads numbers, as many as the model determines.
    ///
    /// # Errors
    /// [`RestoreError`] if the history has another entry at this place, or another number of values.
    pub fn rows(&mut self, name: &'static str, x: &mut [T]) -> Restored {
        self.reals((name, Shape::Rows(1)), x)
    }

    /// Writes or reads vectors, as many as the model determines.
    ///
    /// # Errors
    /// As for [`rows`](Self::rows).
    pub fn vectors(&mut self, name: &'static str, x: &mut [[T; 3]]) -> Restored {
        self.reals((name, Shape::Arrays(3)), x.as_flattened_mut())
    }

    /// Writes or reads a list of numbers of any length.
    ///
    /// # Errors
    /// [`RestoreError`] if the history has another entry at this place.
    pub fn list(&mut self, name: &'static str, x: &mut Vec<T>) -> Restored {
        if let Some(Numbers::Reals(kept)) = self.next_numbers() {
            x.clone_from(kept);
        }
        self.reals((name, Shape::List(1)), x)
    }

    /// Writes or reads a list of pairs of small counts, of any length.
    ///
    /// # Errors
    /// [`RestoreError`] if the history has another entry at this place.
    pub fn pairs(&mut self, name: &'static str, x: &mut Vec<[u32; 2]>) -> Restored {
        if let Some(Numbers::Small(kept)) = self.next_numbers() {
            x.resize(kept.len() / 2, [0; 2]);
        }
        self.smalls((name, Shape::List(2)), x.as_flattened_mut())
    }

    /// Values of the next entry of a history that is read; `None` while one is written.
    fn next_numbers(&self) -> Option<&'a Numbers<T>> {
        match &self.entries {
            Entries::Written(_) => None,
            Entries::Read(entries) => Some(&entries.as_slice().first()?.numbers),
        }
    }

    /// Writes or reads a group of entries that may be absent. `walk` writes or reads the entries of the group.
    ///
    /// # Errors
    /// Errors of `walk`, and [`RestoreError`] if the history has another entry at this place.
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

    /// Writes or reads the data from which energies are computed: the scalar laws as last evaluated, and the signals of forces.
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

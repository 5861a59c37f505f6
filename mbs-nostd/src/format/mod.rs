//! Entries of tables as bytes and as Rust source: each type's fields are listed once.
//!
//! ```text
//! numbers      little endian: u32 for counts and places, four or eight bytes for reals (the text's head says which)
//! variants     a u32, then their fields
//! ```

#[cfg(feature = "export")]
mod bytes;
mod laws;
mod macros;
mod numbers;
mod signals;
#[cfg(feature = "export")]
mod source;
mod tables;

#[cfg(feature = "export")]
pub use bytes::Bytes;
pub use numbers::Axes;
#[cfg(feature = "export")]
pub(crate) use source::{Source, close, name, open};

use crate::check::LoadError;

/// Bytes of a model being read, with the place reached.
#[derive(Debug, Clone)]
pub struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    is_double: bool,
}

impl<'a> Reader<'a> {
    /// Reads from the first byte.
    #[must_use]
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, is_double: true }
    }

    /// Says how wide reals are from here on.
    pub(crate) fn set_double(&mut self, is_double: bool) {
        self.is_double = is_double;
    }

    /// The next `N` bytes.
    fn take<const N: usize>(&mut self) -> Result<[u8; N], LoadError> {
        let rest = self.bytes.get(self.at..).unwrap_or(&[]);
        let bytes = rest.first_chunk().ok_or(LoadError::Length)?;
        self.at += N;
        Ok(*bytes)
    }

    /// Returns the fault of an entry that cannot be read and begins `back` bytes before the place reached.
    pub(crate) fn fault(&self, back: usize) -> LoadError {
        LoadError::Record { byte: self.at.saturating_sub(back) }
    }

    /// Has all been read?
    pub(crate) fn is_at_end(&self) -> bool {
        self.at >= self.bytes.len()
    }
}

/// An entry of a table.
pub trait Record: Sized {
    /// Reads an entry.
    ///
    /// # Errors
    /// [`LoadError`].
    fn read(from: &mut Reader<'_>) -> Result<Self, LoadError>;

    /// Writes it as bytes; false if it cannot be written.
    #[cfg(feature = "export")]
    fn write(&self, to: &mut Bytes) -> bool;

    /// Writes it as an expression of Rust.
    #[cfg(feature = "export")]
    fn source(&self, to: &mut alloc::string::String);
}

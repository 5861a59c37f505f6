//! Entries of tables as bytes and as Rust source. Each type lists its fields once, for both formats.
//!
//! ```text
//! numbers      little endian: u32 for counts and indices, four or eight bytes for reals (the head of the text has the width)
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

/// Reader of the bytes of a model, with its position.
#[derive(Debug, Clone)]
pub struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    is_double: bool,
}

impl<'a> Reader<'a> {
    /// Makes a reader that begins at the first byte.
    #[must_use]
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, is_double: true }
    }

    /// Sets the width of reals in the following bytes.
    pub(crate) fn set_double(&mut self, is_double: bool) {
        self.is_double = is_double;
    }

    /// Reads the next `N` bytes.
    fn take<const N: usize>(&mut self) -> Result<[u8; N], LoadError> {
        let rest = self.bytes.get(self.at..).unwrap_or(&[]);
        let bytes = rest.first_chunk().ok_or(LoadError::Length)?;
        self.at += N;
        Ok(*bytes)
    }

    /// Returns the error for a malformed entry that begins `back` bytes before the position of the reader.
    pub(crate) fn fault(&self, back: usize) -> LoadError {
        LoadError::Record { byte: self.at.saturating_sub(back) }
    }

    /// True if all bytes have been read.
    pub(crate) fn is_at_end(&self) -> bool {
        self.at >= self.bytes.len()
    }
}

/// Format of an entry of a table.
pub trait Record: Sized {
    /// Reads an entry from the bytes.
    ///
    /// # Errors
    /// [`LoadError`].
    fn read(from: &mut Reader<'_>) -> Result<Self, LoadError>;

    /// Writes the entry as bytes. Returns false if the entry cannot be written.
    #[cfg(feature = "export")]
    fn write(&self, to: &mut Bytes) -> bool;

    /// Writes the entry as an expression of Rust.
    #[cfg(feature = "export")]
    fn source(&self, to: &mut alloc::string::String);
}

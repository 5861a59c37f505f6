//! Buffer for the bytes of a model.

use alloc::vec::Vec;

/// Buffer for the bytes of a model that is being written.
#[derive(Debug, Clone, Default)]
pub struct Bytes {
    pub(crate) bytes: Vec<u8>,
    pub(crate) is_single: bool,
}

impl Bytes {
    /// Appends bytes without a conversion.
    pub(crate) fn put(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    /// Appends a real number in the precision of the buffer, single or double.
    #[allow(clippy::cast_possible_truncation, reason = "the nearest number of this precision")]
    pub(crate) fn put_real(&mut self, x: f64) {
        if self.is_single {
            self.put(&(x as f32).to_le_bytes());
        } else {
            self.put(&x.to_le_bytes());
        }
    }
}

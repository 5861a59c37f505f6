//! Hashes that detect changed data: FNV-1a of 64 bits, identical on every machine.

use core::fmt;

/// Hash of empty data: the offset basis of FNV-1a, 64 bits.
const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
/// Factor by which the hash is multiplied for each byte: the prime of FNV-1a, 64 bits.
const PRIME: u64 = 0x0100_0000_01b3;

/// Hash of the bytes added so far.
#[derive(Debug, Clone, Copy)]
pub struct Fingerprint(u64);

impl Fingerprint {
    /// Returns the fingerprint of empty data.
    pub(crate) fn new() -> Self {
        Self(BASIS)
    }

    /// Adds bytes to the fingerprint.
    pub fn add(&mut self, bytes: &[u8]) {
        let step = |hash: u64, &byte: &u8| (hash ^ u64::from(byte)).wrapping_mul(PRIME);
        self.0 = bytes.iter().fold(self.0, step);
    }

    /// Returns the fingerprint as a number.
    pub fn get(self) -> u64 {
        self.0
    }
}

impl fmt::Write for Fingerprint {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.add(text.as_bytes());
        Ok(())
    }
}

/// Returns the fingerprint of some bytes.
pub fn fingerprint(bytes: &[u8]) -> u64 {
    let mut all = Fingerprint::new();
    all.add(bytes);
    all.get()
}

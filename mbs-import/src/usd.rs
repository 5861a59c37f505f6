//! Recognises files of USD, which have their own error message.

use crate::source::{Fault, Origin};

/// First bytes of USD files, in text and in binary form.
const BEGINS: [&[u8]; 2] = [b"#usda", b"PXR-USDC"];

/// True if the bytes begin like a file of USD.
pub(crate) fn is_usd(bytes: &[u8]) -> bool {
    BEGINS.iter().any(|begin| bytes.starts_with(begin))
}

/// The error for a file of USD.
pub(crate) fn refusal(source: u16) -> Fault {
    Fault::new(
        Origin::start_of(source),
        "a file of USD, which is not read",
        "export the robot as URDF, MJCF or SDF from the program that wrote it, and give that file",
    )
}

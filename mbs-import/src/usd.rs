//! Files of USD, which are refused by name.

use crate::source::{Fault, Origin};

/// How its text and its binary files begin.
const BEGINS: [&[u8]; 2] = [b"#usda", b"PXR-USDC"];

/// Is it a file of USD?
pub(crate) fn is_usd(bytes: &[u8]) -> bool {
    BEGINS.iter().any(|begin| bytes.starts_with(begin))
}

/// Its refusal.
pub(crate) fn refusal(source: u16) -> Fault {
    Fault::new(
        Origin::start_of(source),
        "a file of USD, which is not read",
        "export the robot as URDF, MJCF or SDF from the program that wrote it, and give that file",
    )
}

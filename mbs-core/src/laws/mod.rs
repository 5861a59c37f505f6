//! Laws as pure functions of numbers and slices: no allocation, no knowledge of scenes.

pub mod guide;
pub mod scalar;

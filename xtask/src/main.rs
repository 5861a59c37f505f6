//! Jobs of this repository.
fn main() {}

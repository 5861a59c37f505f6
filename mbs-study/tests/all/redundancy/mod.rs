//! Dependent constraint equations of mechanisms in code, and of random ones.

mod decompose;
mod mechanisms;
mod random;
mod support;

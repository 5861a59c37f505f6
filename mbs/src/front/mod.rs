//! The front door: one type of each thing, with numbers in f64 whatever computes below.

pub mod tree;

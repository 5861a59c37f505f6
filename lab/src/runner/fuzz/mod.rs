//! Malformed scenes: mutated text and random mechanisms, through reading, building and stepping.

pub mod command;
mod mechanism;
mod mutate;
mod table;
mod torn;
pub mod trial;

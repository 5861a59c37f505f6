//! Jobs of this repository: run a scene, run the tests, run every check, cross-compile the `no_std` crates. Jobs of `lab` use parts of this
//! library.

pub mod bundle;
pub mod check;
pub mod child;
pub mod command;
pub mod debian;
pub mod dist;
mod documentation;
pub mod effects;
mod features;
pub mod lines;
mod lists;
pub mod nostd;
pub mod package;
pub mod pages;
pub mod pick;
pub mod pictures;
pub mod process;
pub mod python;
pub mod races;
pub mod simulate;
pub mod summary;
mod tally;
pub mod test;

//! Families of hard cases by seed, run by every formulation and judged against references.

pub mod case;
pub mod command;
pub mod draft;
pub mod families;
pub mod judge;
pub mod run;
pub mod schedule;
pub mod text;
pub mod vector;

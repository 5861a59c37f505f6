//! Families of difficult cases by seed, which are run in every formulation and compared with references.

pub mod case;
pub mod command;
pub mod draft;
pub mod families;
pub mod judge;
pub mod run;
pub mod schedule;
pub mod text;
pub mod vector;

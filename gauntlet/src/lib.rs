#![doc = include_str!("../README.md")]

pub mod case;
pub mod draft;
pub mod families;
pub mod judge;
pub mod run;
pub mod schedule;
pub mod text;
pub mod vector;

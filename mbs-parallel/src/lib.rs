#![doc = include_str!("../README.md")]

pub mod team;

pub use team::{Crew, Pool, Threads};

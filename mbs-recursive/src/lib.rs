#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod joint;
pub mod link;
pub mod loops;
pub mod passes;
pub mod plan;
pub mod rows;
pub mod space;

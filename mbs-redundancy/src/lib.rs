#![doc = include_str!("../README.md")]
#![allow(clippy::cast_precision_loss, reason = "counts stay far below 2^53")]

#[doc(hidden)]
pub mod decompose;
mod link;
mod linkage;
mod loops;
mod masses;
mod parts;
mod perturb;
mod rank;
mod remedy;
mod residual;
mod sets;

pub use link::Poses;
pub use linkage::{Jacobian, Linkage, reference};
pub use loops::{Corner, Drive, Loop, drives, loops};
pub use masses::{Massless, massless};
pub use parts::Part;
pub use perturb::Nature;
pub use rank::{Rank, UNCERTAIN};
pub use remedy::{JointChange, Remedy};
pub use sets::{Diagnosis, Member, Set, diagnose};

/// Vectors of three components in double precision.
type Vector = mbs_core::algebra::Vector<f64, 3>;

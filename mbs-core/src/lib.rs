#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(feature = "alloc")]
pub mod actions;
#[cfg(feature = "alloc")]
mod check;
#[cfg(feature = "alloc")]
pub mod cluster;
pub mod control;
mod delegate;
pub mod effects;
pub mod elements;
pub mod feedback;
#[cfg(feature = "alloc")]
pub mod formulation;
#[cfg(feature = "alloc")]
pub mod history;
#[cfg(feature = "alloc")]
pub mod implicit;
#[cfg(feature = "alloc")]
pub mod inputs;
pub mod integrator;
pub mod joint;
pub mod laws;
pub mod measure;
#[cfg(feature = "alloc")]
pub mod mechanism;
#[cfg(feature = "alloc")]
pub mod model;
mod named;
#[cfg(feature = "alloc")]
pub mod natural;
#[cfg(feature = "alloc")]
pub mod outputs;
pub mod rigid;
#[cfg(feature = "alloc")]
pub mod saddle;
#[cfg(feature = "alloc")]
pub mod scene;
#[cfg(feature = "alloc")]
pub mod start;
pub mod step;

/// Data of a scene. A build without `alloc` has only the table of joints here.
#[cfg(not(feature = "alloc"))]
pub use joint as scene;
#[cfg(feature = "instances")]
pub use mbs_math::instances;
pub use mbs_math::{
    Alone, BlockSource, Cliques, FactorError, Real, SpdSolver, SymmetricSolver, Team,
};
pub use mbs_math::{algebra, blocks, ode, once, real, team};
#[cfg(feature = "alloc")]
pub use mbs_math::{dense, refined};

/// Items for the tests of this crate. They are no part of its interface.
#[doc(hidden)]
pub mod inside {
    pub use crate::control::energy::Steering;
    pub use crate::laws::feature::spline_hollow;

    #[cfg(feature = "alloc")]
    pub mod natural {
        pub use crate::natural::coordinate_sets::{CoordinateSet, add_pair_square};
        pub use crate::natural::group::add_squares;
        pub use crate::natural::spatial_index::SpatialIndex;
    }

    #[cfg(feature = "alloc")]
    pub mod outputs {
        pub use crate::outputs::cubic::{AT_START, Change, Cubic};
        pub use crate::outputs::event::fading;
        pub use crate::outputs::frame::{carry, normalised};
        pub use crate::outputs::leaf_elimination::{Block, eliminate_leaves};
        pub use crate::outputs::load::Gap;
        pub use crate::outputs::minimum_norm::MinimumNorm;
    }

    #[cfg(feature = "alloc")]
    pub mod check {
        pub use crate::check::body::principal_moments;
    }

    #[cfg(feature = "alloc")]
    pub mod start {
        pub use crate::start::rank::pivoted_rank;
        pub use crate::start::sparse_rank::sparse_rank;
    }
}

#![doc = include_str!("../README.md")]
#![no_std]

extern crate alloc;

mod advance;
mod eigen;
mod equilibrium;
mod error;
mod linear;
mod linearise;
mod matrix;
mod near;
mod options;
mod pivoted;
mod ports;
mod roll;
mod signal_matrices;
mod signals;
mod svd;
mod tangent_coordinates;
mod watch;
mod workspace;

pub use advance::advance;
pub use eigen::eigenvalues;
pub use equilibrium::{Equilibrium, equilibrium};
pub use error::{EquilibriumError, LinearError};
pub use linear::Linear;
pub use linearise::{Instant, linearise};
pub use matrix::Matrix;
pub use mbs_core::saddle::Saddle;
pub use mbs_core::step::OptionError;
pub use near::equilibrium_near;
pub use options::{LinearOptions, Options};
pub use ports::{CoordinateChoice, LinearPorts, Ports, linearise_ports};
pub use signal_matrices::LinearSignals;
pub use signals::rest_signals;
pub use svd::{Svd, singular_values};
pub use watch::OutputMeasure;
pub use workspace::Workspace;

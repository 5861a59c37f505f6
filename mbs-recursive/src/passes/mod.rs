//! Passes over the links of a mechanism: accelerations from forces, forces from accelerations, energies.

pub mod anderson;
pub(crate) mod collapse;
pub(crate) mod coupled_rows;
pub mod energy_balance;
pub(crate) mod evaluate;
pub(crate) mod failure;
pub mod feedback;
pub mod inverse;
pub(crate) mod overturned;
pub mod rotor;
pub mod slices;
mod three_passes;

pub(crate) use three_passes::body;
pub use three_passes::{Factors, accelerate, condense, condense_again, inertias, kinematics};

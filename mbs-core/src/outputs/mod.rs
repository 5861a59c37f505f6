//! Recorded quantities of a motion, computed from a state of the model: points, joint coordinates, reactions and others.
//!
//! This module depends on no formulation and no integrator. [`Measures`] computes outputs from positions, velocities and accelerations.
//! [`Reactions`] follow from the equilibrium of every body, with the efforts of couplings. [`EffectWrenches`] are the wrenches of effects.
//! [`Forces`] has the reactions and effects that outputs need. [`Contacts`] records the instants at which one-sided effects begin and end
//! contact. [`Turns`] checks whether positions determine the rotation of joints in a step. [`Events`] finds kinks of laws within a step, so
//! that the step can be repeated and end at the kink.

mod axes;
mod contact;
mod coordinate;
mod coupled_sum;
pub(crate) mod cubic;
mod drawn_force;
mod error;
pub(crate) mod event;
mod exerted;
mod forces;
pub(crate) mod frame;
mod inertia;
pub(crate) mod leaf_elimination;
pub(crate) mod load;
mod measure;
pub(crate) mod minimum_norm;
mod motion;
mod quantity;
mod reaction;
mod rotor;
mod strand_force;
mod tooth_force;
mod turns;
mod wrench;

pub use crate::scene::{Quantity, RelativePoint, Target, VehicleSide, WheelCarrier};
pub use contact::{Contacts, Instant, MOST_INSTANTS};
pub use coordinate::CoordinateMotion;
pub use error::ReactionError;
pub use event::{EventHistory, Events};
pub use exerted::EffectWrenches;
pub use forces::Forces;
pub use measure::{Measures, start_values};
pub use quantity::{
    Component, ComponentForm, Magnitude, OutputPicture, QUANTITIES, QuantityDefinition,
    QuantityRow, TargetKind, in_radians, magnitudes,
};
pub use reaction::{LARGEST_BLOCK, Reactions};
pub use turns::Turns;
pub use wrench::{JointWrenches, Wrench};

//! Recorded quantities of a motion: points, joint coordinates and reactions, measured from a state of the model.
//!
//! Nothing here depends on a formulation or an integrator. [`Measures`] reads positions, velocities and accelerations.
//! [`Reactions`] closes the balance of every body of the scene from them, with the efforts of couplings. [`EffectWrenches`] has what effects do;
//! [`Forces`] has both, where outputs ask for them, and [`Contacts`]
//! the instants at which one-sided effects touch. [`Turns`] checks whether positions determine how far joints have turned in a step.
//! [`Events`] finds where within a step a law's kink is passed, for steps that are to end there.

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

//! Scene data: what a mechanism *is*, before any coordinates are chosen. Plain data, public fields, SI units.
//!
//! Everything is given in global axes in the *reference configuration* (hard points). Planar scenes keep the
//! third component of every vector at zero. Names live here and nowhere below; references are indices.

pub mod align;
mod check;
mod data;
mod effect;
mod error;
mod fault;
mod output;

pub use data::{
    Body, BodyRef, Dimension, Guide, GuideLaw, Inertia, Initial, InitialTarget, Joint, JointKind,
    Scene, Start, TableEnds,
};
pub use effect::{
    AxisFrame, CalspanCoefficients, Course, Effect, EffectKind, OwnLaw, PolynomialPiece, Road,
    RoadFeature,
};
pub use error::{Entry, SceneError};
pub use fault::SceneFault;
pub use output::{Output, Quantity, SolverChoice};

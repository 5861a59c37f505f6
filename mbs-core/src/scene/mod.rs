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
mod id;
mod output;

pub use data::{
    Body, Dimension, Guide, Inertia, InitialCondition, InitialTarget, Joint, JointKind, Motion,
    Scene, Start, TableEnds,
};
pub use effect::{
    AxisFrame, CalspanCoefficients, Effect, EffectKind, PolynomialPiece, Road, RoadFeature, Signal,
    UserLaw,
};
pub use error::{Entry, SceneError};
pub use fault::SceneFault;
pub use id::{BodyId, EffectId, GROUND, GuideId, InitialId, JointId, OutputId};
pub use output::{Output, Quantity, SolverTable};

//! Scene data: what a mechanism *is*, before any coordinates are chosen. Plain data, public fields, SI units.
//!
//! Everything is given in global axes in the *reference configuration* (hard points). Planar scenes keep the
//! third component of every vector at zero. Names live here and nowhere below; references are indices.
//! The table of joints ([`JOINTS`]) needs no allocation.

#[cfg(feature = "alloc")]
mod advice;
#[cfg(feature = "alloc")]
pub mod align;
#[cfg(feature = "alloc")]
mod axes;
#[cfg(feature = "alloc")]
mod build;
#[cfg(feature = "alloc")]
mod build_signal;
#[cfg(feature = "alloc")]
pub(crate) mod check;
#[cfg(feature = "alloc")]
mod coupling;
#[cfg(feature = "alloc")]
mod coupling_term;
#[cfg(feature = "alloc")]
mod curve;
#[cfg(feature = "alloc")]
mod data;
mod dimension;
#[cfg(feature = "alloc")]
mod drawn;
#[cfg(feature = "alloc")]
mod drawn_kind;
#[cfg(feature = "alloc")]
mod effect;
#[cfg(feature = "alloc")]
mod error;
#[cfg(feature = "alloc")]
mod fault;
#[cfg(feature = "alloc")]
mod frame;
#[cfg(feature = "alloc")]
mod id;
#[cfg(feature = "alloc")]
mod inertia;
mod joint;
#[cfg(feature = "alloc")]
mod joint_limits;
#[cfg(feature = "alloc")]
mod mechanism;
#[cfg(feature = "alloc")]
mod number;
#[cfg(feature = "alloc")]
mod on_terms;
#[cfg(feature = "alloc")]
mod open;
#[cfg(feature = "alloc")]
mod resolve;
#[cfg(feature = "alloc")]
mod rolling;
#[cfg(feature = "alloc")]
mod setting;
#[cfg(feature = "alloc")]
mod shape;
#[cfg(feature = "alloc")]
mod signal;
#[cfg(feature = "alloc")]
mod solver;
#[cfg(feature = "alloc")]
mod table_notes;

#[cfg(feature = "alloc")]
pub use crate::effects::{EffectKind, kinds::*};
#[cfg(feature = "alloc")]
pub use crate::outputs::Quantity;
#[cfg(feature = "alloc")]
pub use axes::transverse;
#[cfg(feature = "alloc")]
pub use build::StartedJoint;
#[cfg(feature = "alloc")]
pub use coupling::{Coupling, CouplingKind, Mesh};
#[cfg(feature = "alloc")]
pub use coupling_term::{BallAngle, CouplingMeasure, CouplingTerm};
#[cfg(feature = "alloc")]
pub use curve::{Curve, CurveShape, TableEnds};
#[cfg(feature = "alloc")]
pub(crate) use data::Surroundings;
#[cfg(feature = "alloc")]
pub use data::{
    Body, Guide, Inertia, InitialCondition, InitialTarget, Joint, JointLimits, Motion, Start,
};
pub use dimension::Dimension;
#[cfg(feature = "alloc")]
pub use drawn_kind::{Drawn, DrawnKind, NotDrawn, NotStrands, Sense};
#[cfg(feature = "alloc")]
pub use effect::{
    AxisFrame, CalspanCoefficients, LongitudinalSlip, PolynomialPiece, Road, RoadFeature, Signal,
    UserLaw,
};
#[cfg(feature = "alloc")]
pub use error::{Entry, SceneError};
#[cfg(feature = "alloc")]
pub use fault::SceneFault;
#[cfg(feature = "alloc")]
pub use frame::BodyFrame;
#[cfg(feature = "alloc")]
pub use id::{
    BodyId, CouplingId, EffectId, GROUND, GuideId, InitialId, JointId, OutputId, RollingId,
    SignalId,
};
#[cfg(feature = "alloc")]
pub(crate) use inertia::steiner;
pub use joint::{Axis, Freedom, JOINTS, JointForm, JointKind, Rotation, Translation};
#[cfg(feature = "alloc")]
pub use mechanism::{Effect, Output, Scene};
#[cfg(feature = "alloc")]
pub use number::{Number, Vector3};
#[cfg(feature = "alloc")]
pub use rolling::{Rolling, RollingKind, RollingPlane};
#[cfg(feature = "alloc")]
pub use setting::{NotASetting, Setting, SettingForm, SettingSlot, SettingValue};
#[cfg(feature = "alloc")]
pub use shape::{BodyShape, ShapeKind};
#[cfg(feature = "alloc")]
pub(crate) use signal::first_of;
#[cfg(feature = "alloc")]
pub use signal::{
    Interpolation, NamedSignal, SignalBreak, SignalKind, Smoothness, signal_breaks, signal_order,
};
#[cfg(feature = "alloc")]
pub use solver::{SETTINGS, SolverTable};
#[cfg(feature = "alloc")]
pub use table_notes::TableNote;

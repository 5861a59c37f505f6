//! Data of a scene: the mechanism, before any coordinates are chosen. Public fields in SI units.
//!
//! All places and directions are in global axes in the *reference configuration* (hard points). Planar scenes have zero as the
//! third component of every vector. Names exist only here; lower layers refer to entries by index. Types from other modules that
//! scenes need, such as [`Scene`] and [`JointKind`], are re-exported here.

mod advice;
mod axes;
mod coupling;
mod coupling_term;
mod curve;
mod data;
mod drawn_kind;
mod effect;
mod error;
mod fault;
mod frame;
mod id;
mod inertia;
mod number;
pub(crate) mod place;
pub(crate) mod quantity;
mod rolling;
mod setting;
mod shape;
mod signal;
mod solver;

pub use crate::check::TableNote;
pub use crate::effects::{EffectKind, kinds::*};
pub use crate::joint::{
    Axis, Dimension, Freedom, JOINTS, JointForm, JointKind, Rotation, Translation,
};
pub use crate::mechanism::{Effect, Output, Scene, StartedJoint, align};
pub use axes::transverse;
pub use coupling::{Coupling, CouplingKind, Mesh};
pub use coupling_term::{BallAngle, CouplingMeasure, CouplingTerm};
pub use curve::{Curve, CurveShape, TableEnds};
pub(crate) use data::Surroundings;
pub use data::{
    Body, Guide, Inertia, InitialCondition, InitialTarget, Joint, JointLimits, Motion, Start,
};
pub use drawn_kind::{Drawn, DrawnKind, NotDrawn, NotStrands, Sense};
pub use effect::{
    AxisFrame, CalspanCoefficients, LongitudinalSlip, PolynomialPiece, Road, RoadFeature, Signal,
    UserLaw,
};
pub use error::{Entry, SceneError};
pub use fault::SceneFault;
pub use frame::BodyFrame;
pub use id::{
    BodyId, CouplingId, EffectId, GROUND, GuideId, InitialId, JointId, OutputId, RollingId,
    SignalId,
};
pub(crate) use inertia::steiner;
pub use number::{Number, Vector3};
pub use quantity::{Quantity, RelativePoint, Target, VehicleSide, WheelCarrier};
pub use rolling::{Rolling, RollingKind, RollingPlane};
pub use setting::{NotASetting, Setting, SettingForm, SettingSlot, SettingValue};
pub use shape::{BodyShape, ShapeKind};
pub(crate) use signal::first_of;
pub use signal::{
    Interpolation, NamedSignal, SignalBreak, SignalKind, Smoothness, signal_breaks, signal_order,
};
pub use solver::{SETTINGS, SolverTable};

//! Names that are used in source files which `mbs export --rust` wrote.

pub use crate::{
    LoadError, Model, Motion, Planar, Prescriptions, Rise, SignalLaw, Solver, Spatial, StartState,
};
pub use mbs_core::algebra::vector;
pub use mbs_core::effects::laws::*;
pub use mbs_core::feedback::{FeedbackOperation, FeedbackStep};
pub use mbs_core::laws::body::BodyLaw;
pub use mbs_core::laws::calspan::Coefficients;
pub use mbs_core::laws::polynomial::Piece;
pub use mbs_core::laws::road::Feature;
pub use mbs_core::laws::scalar::Law;
pub use mbs_core::laws::slip::LongitudinalSlip;
pub use mbs_core::laws::{LawInputs, Part};
pub use mbs_recursive::link::curves::CurveTable;
pub use mbs_recursive::link::plan::{End, LoopCoupling, Pair, Pass, Plan, Span, Station, Update};
pub use mbs_recursive::link::{Link, LinkKind, LinkRotor};
pub use mbs_recursive::loads::{BodyLoad, Load, Measure, SumLoad};
pub use mbs_recursive::loops::Loops;
pub use mbs_recursive::passes::feedback::FeedbackSlices;
pub use mbs_recursive::passes::slices::TreeSlices;
pub use mbs_recursive::rows::Row;
pub use mbs_recursive::rows::closed_loop::ClosedLoop;
pub use mbs_recursive::rows::coupled::{
    CoupledRow, Couplings, LinePoint, LinkStart, SumMeasure, SumTerm,
};

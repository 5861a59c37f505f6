//! What a model that `mbs export --rust` wrote is made of.

pub use crate::{
    Beginning, LoadError, Model, Motion, Planar, Prescriptions, SignalLaw, Solver, Spatial,
};
pub use mbs_core::algebra::vector;
pub use mbs_core::effects::laws::*;
pub use mbs_core::laws::body::BodyLaw;
pub use mbs_core::laws::calspan::Coefficients;
pub use mbs_core::laws::polynomial::Piece;
pub use mbs_core::laws::road::Feature;
pub use mbs_core::laws::scalar::Law;
pub use mbs_core::laws::{Part, Supplies};
pub use mbs_recursive::link::{Kind, Link};
pub use mbs_recursive::loads::{Gauge, Load, OnBody};
pub use mbs_recursive::loops::Loops;
pub use mbs_recursive::mechanism::Mechanism;
pub use mbs_recursive::plan::{Coupling, End, Pair, Pass, Plan, Span, Station, Update};
pub use mbs_recursive::rows::{Loop, Row};

//! What a model that `mbs export --rust` wrote is made of.

pub use crate::{
    Beginning, LoadError, Model, Motion, Planar, Prescriptions, SignalLaw, Solver, Spatial,
};
pub use mbs_core::algebra::vector;
pub use mbs_core::laws::body::BodyLaw;
#[cfg(feature = "tire")]
pub use mbs_core::laws::calspan::Coefficients;
#[cfg(feature = "friction")]
pub use mbs_core::laws::friction::Friction;
#[cfg(feature = "limit")]
pub use mbs_core::laws::limit::Limit;
#[cfg(feature = "polynomial")]
pub use mbs_core::laws::polynomial::Piece;
#[cfg(feature = "tire")]
pub use mbs_core::laws::road::Feature;
pub use mbs_core::laws::scalar::Law;
#[cfg(feature = "speed-hold")]
pub use mbs_core::laws::speed_hold::SpeedHold;
#[cfg(feature = "tire")]
pub use mbs_core::laws::tire::Tire;
pub use mbs_core::laws::{Part, Supplies};
pub use mbs_recursive::link::{Kind, Link};
pub use mbs_recursive::loads::{Gauge, Load, OnBody};
pub use mbs_recursive::loops::Loops;
pub use mbs_recursive::mechanism::Mechanism;
pub use mbs_recursive::plan::{Coupling, End, Pair, Pass, Plan, Span, Station, Update};
pub use mbs_recursive::rows::{Loop, Row};

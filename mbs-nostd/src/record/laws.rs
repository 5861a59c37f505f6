//! Force laws and their tables.

use super::Record;
use super::macros::record_enum;
#[cfg(any(
    feature = "polynomial",
    feature = "tire",
    feature = "limit",
    feature = "friction",
    feature = "speed-hold"
))]
use super::macros::record_struct;
use mbs_core::Real;
use mbs_core::laws::body::BodyLaw;
#[cfg(feature = "tire")]
use mbs_core::laws::calspan::Coefficients;
#[cfg(feature = "friction")]
use mbs_core::laws::friction::Friction;
#[cfg(feature = "limit")]
use mbs_core::laws::limit::Limit;
#[cfg(feature = "polynomial")]
use mbs_core::laws::polynomial::Piece;
#[cfg(feature = "tire")]
use mbs_core::laws::road::Feature;
use mbs_core::laws::scalar::Law;
#[cfg(feature = "speed-hold")]
use mbs_core::laws::speed_hold::SpeedHold;
#[cfg(feature = "tire")]
use mbs_core::laws::tire::Tire;

record_enum!([T: Real + Record] Law<T> = Law {
    0 SpringDamper { stiffness stiffness, damping damping, free free },
    1 Torque { course course },
    #[cfg(feature = "polynomial")]
    2 Polynomial { pieces pieces, of_rate of_rate },
    #[cfg(feature = "bumper")]
    3 Bumper { law law, touch touch },
    #[cfg(feature = "limit")]
    4 Limit { 0 limit },
    #[cfg(feature = "friction")]
    5 Friction { 0 friction },
});

record_enum!([T: Real + Record] BodyLaw<T> = BodyLaw {
    #[cfg(feature = "drag")]
    0 Drag { area_coefficient area_coefficient, density density },
    #[cfg(feature = "speed-hold")]
    1 SpeedHold { 0 hold },
    #[cfg(feature = "tire")]
    2 Tire { 0 tire },
});

#[cfg(feature = "polynomial")]
record_struct!([T: Real + Record] Piece<T> = Piece { lower, upper, middle, coefficients, energy });
#[cfg(feature = "limit")]
record_struct!([T: Real + Record] Limit<T> = Limit { lower, upper, stiffness, damping });
#[cfg(feature = "friction")]
record_struct!([T: Real + Record] Friction<T> = Friction {
    coulomb, r#static, stribeck, viscous, regularisation,
});
#[cfg(feature = "speed-hold")]
record_struct!([T: Real + Record] SpeedHold<T> = SpeedHold { speed, gain, limit });
#[cfg(feature = "tire")]
record_struct!([T: Real + Record] Tire<T> = Tire {
    radius, radial, rolling, side, road, travel, up, leans,
});
#[cfg(feature = "tire")]
record_struct!([T: Real + Record] Coefficients<T> = Coefficients { a, omega, b, skid, trail });
#[cfg(feature = "tire")]
record_enum!([T: Real + Record] Feature<T> = Feature {
    0 Flat { 0 height },
    1 Rise { start start, length length, height height, rounding rounding },
    2 Bump { start start, length length, amplitude amplitude },
    3 Spline { 0 part },
});

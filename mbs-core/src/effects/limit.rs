//! Elastic stops of a joint at both ends of a range: two [`bumper`]s.
//!
//! ```text
//! tension = F(m - upper, m') above the range,   -F(lower - m, -m') below it,   0 within
//! left out: stiffness m/tau^2, damping 2 m/tau     m: the mass that the coordinate moves alone, tau: 20 ms
//! ```
//!
//! Spring and damper of a stop are critically damped. A mass with rate v at the stop compresses it by v tau/e.

use crate::Real;
use crate::laws::LawInputs;
use crate::laws::bumper::{self, Contact};
use crate::laws::entry::entry;
use crate::laws::operations::Operations;
use crate::laws::scalar::{ScalarForce, TensionLaw};

/// Law of a range with a stop at each end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitLaw<T> {
    /// Lower end [rad or m].
    pub lower: T,
    /// Upper end [rad or m].
    pub upper: T,
    /// Stiffness of the stops [N m/rad or N/m].
    pub stiffness: T,
    /// Damping of the stops [N m s/rad or N s/m].
    pub damping: T,
}

entry!(LimitLaw<T> { lower, upper, stiffness, damping });

impl<T: Real> LimitLaw<T> {
    /// Tension at a coordinate and its rate, with derivatives by both.
    #[inline]
    pub fn tension(&self, value: T, rate: T) -> Contact<T> {
        let law = [self.stiffness, self.damping];
        if value > self.upper {
            return bumper::contact(law, value - self.upper, rate);
        }
        let below = bumper::contact(law, self.lower - value, -rate);
        Contact { force: -below.force, ..below }
    }
}

impl<T: Real> TensionLaw<T> for LimitLaw<T> {
    #[inline]
    fn evaluate(&self, value: T, rate: T, _: &LawInputs<'_, T>) -> ScalarForce<T> {
        let contact = self.tension(value, rate);
        ScalarForce {
            value,
            rate,
            tension: contact.force,
            stiffness: contact.stiffness,
            damping: contact.damping,
            ..ScalarForce::default()
        }
    }

    fn operations(&self) -> Operations {
        bumper::OPERATIONS + Operations::new(0, 2)
    }

    #[inline]
    fn energy(&self, value: T, _: &LawInputs<'_, T>) -> T {
        bumper::energy(self.stiffness, (value - self.upper).max(self.lower - value))
    }

    #[inline]
    fn elastic(&self, value: T, _: &LawInputs<'_, T>) -> T {
        let above = (value - self.upper).max(T::ZERO);
        self.stiffness * (above - (self.lower - value).max(T::ZERO))
    }

    fn n_gaps(&self) -> usize {
        2
    }

    fn has_fade(&self) -> bool {
        self.damping > T::ZERO
    }

    fn gaps(&self, value: T, rate: T) -> [[T; 2]; 2] {
        [[value - self.lower, rate], [self.upper - value, -rate]]
    }
}

#[cfg(feature = "alloc")]
pub use data::Limit;
#[cfg(feature = "alloc")]
pub(super) use data::check_range;

#[cfg(feature = "alloc")]
mod data {
    use super::LimitLaw;
    use crate::effects::data::*;

    /// Time in which a stop brings a motion to rest [s]. It contains some steps of 1 to 5 ms, and is short compared with motions of
    /// machines.
    const STOPPING_TIME: f64 = 0.02;

    effect! {
        /// Elastic stops of a joint's coordinate.
        pub struct Limit<T> = ["limit"] {
            /// The joint.
            joint: JointId = Joint(Coordinate), "", Needed;
            /// Its coordinate; needed where it has several.
            coordinate: Option<usize> = Coordinate, "", Nothing;
            /// Whether the stops are at the ends of the joint's own range, whatever `lower` and `upper` are.
            range: bool = Flag, "", Nothing;
            /// Coordinate below which the lower stop pushes.
            lower: T = Number(Any), "rad or m", NeededWithout("range");
            /// Coordinate above which the upper stop pushes.
            upper: T = Number(Any), "rad or m", NeededWithout("range");
            /// Stiffness.
            stiffness: T = Number(NotNegative), "N m/rad or N/m", Open;
            /// Damping while in contact.
            damping: T = Number(NotNegative), "N m s/rad or N s/m", OpenWith("stiffness");
        }
    }

    impl<T: Real> Limit<T> {
        /// Returns the coordinates of the stops, lower and upper [rad or m]. `None` if they are the ends of the joint's range, and
        /// the joint has no range.
        #[must_use]
        pub fn ends(&self, joints: &[Joint<T>]) -> Option<[T; 2]> {
            if !self.range {
                return Some([self.lower, self.upper]);
            }
            joints.get(self.joint.index()).and_then(|joint| joint.limits.range)
        }
    }

    /// Checks that the lower end is below the upper end.
    pub(in crate::effects) fn check_range<T: Real>(
        [lower, upper]: [T; 2],
        place: Place,
    ) -> Result<(), SceneError> {
        if lower < upper {
            return Ok(());
        }
        place.fault("lower", SceneFault::RangeOrder([lower.to_f64(), upper.to_f64()]))
    }

    impl<T: Real> EffectModel<T> for Limit<T> {
        const LAW: &'static str = "a bumper at each end";
        const ABSENT: Option<[&'static str; 2]> =
            Some(["limits", "no limits: joints turn and slide without stops"]);
        const IS_ONE_SIDED: bool = true;
        const ENDS: &'static [&'static str] = &["lower", "upper"];

        fn check(&self, among: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            match self.ends(among.joints) {
                None => place.fault("range", SceneFault::NoRange),
                Some(ends) => check_range(ends, place),
            }
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let &Self { joint, coordinate, stiffness, damping, .. } = self;
            let Some([lower, upper]) = self.ends(to.among.joints) else { return };
            to.on_joint((joint, coordinate), LimitLaw { lower, upper, stiffness, damping });
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        /// Hint for the upper end, which is an angle if the joint rotates.
        fn unit_hints(&self, joints: &[Joint<T>]) -> Vec<UnitHint<T>> {
            let (key, of) = (if self.range { "range" } else { "upper" }, Some(self.joint));
            let upper = self.ends(joints).map(|[_, value]| UnitHint::Angle { key, value, of });
            upper.into_iter().collect()
        }
        /// Stiffness or damping with which the stop brings a motion to rest in `STOPPING_TIME`, critically damped.
        fn open(&self, key: &str, mass: f64) -> Option<f64> {
            match key {
                "stiffness" => Some(mass / (STOPPING_TIME * STOPPING_TIME)),
                "damping" => Some(2.0 * mass / STOPPING_TIME),
                _ => None,
            }
        }
        fn stores_energy(&self) -> bool {
            !self.stiffness.is_zero()
        }
        fn dissipates(&self) -> bool {
            !self.damping.is_zero()
        }
    }
}

//! A wheel on the scene's road. Its law is long: [`tire`](crate::laws::tire).

pub use crate::laws::tire::TireLaw;

#[cfg(feature = "alloc")]
pub use data::Tire;

#[cfg(feature = "alloc")]
mod data {
    use super::TireLaw;
    use crate::algebra::unit;
    use crate::effects::data::*;
    use crate::scene::CalspanCoefficients;

    effect! {
        /// A wheel on the scene's road.
        pub struct Tire<T> = ["tire"] {
            /// The body that carries the wheel.
            body: BodyId = Body, "", Needed;
            /// Centre of the wheel, reference configuration.
            center: [T; 3] = Point, "m", Needed;
            /// Axis of the wheel, fixed in the body, pointing to the left of the direction of travel; in space.
            axis: Option<[T; 3]> = MaybeAxis, "", Nothing;
            /// Radius without load.
            radius: T = Number(Positive), "m", Needed;
            /// Radial stiffness.
            stiffness: T = Number(NotNegative), "N/m", Needed;
            /// Radial damping while in contact.
            damping: T = Number(NotNegative), "N s/m", ZERO;
            /// Force against rolling, as a share of the normal force.
            rolling_resistance: T = Number(NotNegative), "-", ZERO;
            /// Side force and aligning torque; without, only the radial force.
            side: Option<CalspanCoefficients<T>> = Side, "", Nothing;
        }
    }

    impl<T: Real> EffectModel<T> for Tire<T> {
        const LAW: &'static str = "see below";
        const ABSENT: Option<[&'static str; 2]> =
            Some(["tires", "no tires and no road under them"]);
        const IS_ONE_SIDED: bool = true;
        const NEEDS_ROAD: bool = true;

        /// An axis where side force or rolling resistance asks for one; nothing across in the plane.
        fn check(&self, among: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            let side = self.side.as_ref();
            if among.dimension.count() == 2 {
                if side.is_some() {
                    return place.fault("side", SceneFault::NeedsSpatial);
                }
                return match self.axis {
                    Some(_) => place.fault("axis", SceneFault::NotUsed),
                    None => Ok(()),
                };
            }
            match self.axis {
                Some(axis) => place.axis("axis", axis)?,
                None if side.is_some() || !self.rolling_resistance.is_zero() => {
                    return place.fault("axis", SceneFault::Missing);
                }
                None => {}
            }
            side.map_or(Ok(()), |coefficients| calspan(coefficients, place))
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let (roads, travel) = to.roads();
            let law = TireLaw {
                radius: self.radius,
                radial: [self.stiffness, self.damping],
                rolling: self.rolling_resistance,
                side: self.side,
                road: roads[usize::from(self.center[1] < T::ZERO && !to.is_planar())],
                travel,
                up: to.among.dimension.count() - 1,
                leans: self.axis.is_some() && !to.is_planar(),
            };
            let axis = self.axis.map_or_else(|| unit(2).into(), crate::actions::direction_of);
            to.on_body((self.body, self.center), axis, law);
        }
        fn stores_energy(&self) -> bool {
            !self.stiffness.is_zero()
        }
        fn dissipates(&self) -> bool {
            !self.damping.is_zero()
        }
        /// What it does when it rolls.
        fn rest(&mut self, leave: &mut dyn FnMut(&'static str)) -> bool {
            if self.side.take().is_some() {
                leave("side force");
            }
            if self.rolling_resistance > T::ZERO {
                leave("rolling resistance");
            }
            self.rolling_resistance = T::ZERO;
            true
        }
    }

    /// The formulas divide by A0, A2, A4 and the coefficient of friction.
    fn calspan<T: Real>(c: &CalspanCoefficients<T>, place: Place) -> Result<(), SceneError> {
        let rest = [c.omega, c.skid];
        for x in c.a.iter().chain(&c.b).chain(&c.trail).chain(&rest) {
            place.finite("coefficients", *x)?;
        }
        let is_positive = [c.a[0], c.a[2], c.omega, c.b[1], c.skid].iter().all(|x| *x > T::ZERO);
        if is_positive && !c.a[4].is_zero() {
            return Ok(());
        }
        place.fault("coefficients", SceneFault::CalspanRange)
    }
}

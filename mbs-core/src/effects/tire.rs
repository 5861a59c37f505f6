//! Wheel on the scene's road. The law is in its own file, because it is long: [`tire`](crate::laws::tire).

pub use crate::laws::tire::TireLaw;

#[cfg(feature = "alloc")]
pub use data::Tire;

#[cfg(feature = "alloc")]
mod data {
    use super::TireLaw;
    use crate::algebra::unit;
    use crate::effects::data::*;
    use crate::joint::Axis;
    use crate::scene::place::is_parallel;
    use crate::scene::{CalspanCoefficients, LongitudinalSlip};

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
            /// The joint about which the wheel turns on the body that carries it; the tire then acts on the wheel.
            spin: Option<JointId> = Spin, "", Nothing;
            /// Force by slip along the wheel's plane, of the wheel that `spin` names, else of the body itself; without, it rolls freely.
            longitudinal: Option<LongitudinalSlip<T>> = Slip, "", Nothing;
        }
    }

    impl<T: Real> EffectModel<T> for Tire<T> {
        const LAW: &'static str = "see below";
        const ABSENT: Option<[&'static str; 2]> =
            Some(["tires", "no tires and no road under them"]);
        const IS_ONE_SIDED: bool = true;
        const NEEDS_ROAD: bool = true;

        /// Checks that an axis is given if side force, rolling resistance or slip needs it. In the plane it refuses an axis and a
        /// side force.
        fn check(&self, among: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            let side = self.side.as_ref();
            self.check_spin(among, place)?;
            if among.dimension.count() == 2 {
                if side.is_some() {
                    return place.fault("side", SceneFault::NeedsSpatial);
                }
                return match self.axis {
                    Some(_) => place.fault("axis", SceneFault::NotUsed),
                    None => Ok(()),
                };
            }
            match self.wheel_axis(among) {
                Some(axis) => place.axis("axis", axis)?,
                None if side.is_some()
                    || !self.rolling_resistance.is_zero()
                    || self.longitudinal.is_some() =>
                {
                    return place.fault("axis", SceneFault::Missing);
                }
                None => {}
            }
            side.map_or(Ok(()), |coefficients| calspan(coefficients, place))
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let (roads, travel) = to.roads();
            let axis = self.wheel_axis(to.among);
            let body = self.wheel(to.among).map_or(self.body, |(_, wheel)| wheel);
            let law = TireLaw {
                radius: self.radius,
                radial: [self.stiffness, self.damping],
                rolling: self.rolling_resistance,
                side: self.side,
                longitudinal: self.longitudinal,
                road: roads[usize::from(self.center[1] < T::ZERO && !to.is_planar())],
                travel,
                up: to.among.dimension.count() - 1,
                leans: axis.is_some() && !to.is_planar(),
            };
            let axis = axis.map_or_else(|| unit(2).into(), crate::effects::action::direction_of);
            to.on_body((body, self.center), axis, law);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Wheel(self.as_wheel())
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn road_wheel(&self) -> Option<RoadWheel<T>> {
            Some(self.as_wheel())
        }
        fn stores_energy(&self) -> bool {
            !self.stiffness.is_zero()
        }
        fn dissipates(&self) -> bool {
            !self.damping.is_zero()
        }
        /// Removes the forces of rolling: side force, rolling resistance and slip force.
        fn rest(&mut self, leave: &mut dyn FnMut(&'static str)) -> bool {
            if self.side.take().is_some() {
                leave("side force");
            }
            if self.rolling_resistance > T::ZERO {
                leave("rolling resistance");
            }
            if self.longitudinal.take().is_some() {
                leave("force by slip");
            }
            self.rolling_resistance = T::ZERO;
            true
        }
    }

    impl<T: Real> Tire<T> {
        /// Returns the wheel of the tire.
        const fn as_wheel(&self) -> RoadWheel<T> {
            let &Self { body, center, axis, radius, spin, .. } = self;
            RoadWheel { body, center, axis, radius, spin }
        }

        /// Joint about which the wheel rotates, and the rotating body. This is the joint's other body, or the carrier if the other
        /// body is the ground.
        fn wheel<'a>(&self, among: Surroundings<'a, T>) -> Option<(&'a Joint<T>, BodyId)> {
            let joint = among.joints.get(self.spin?.index())?;
            let other = match joint.bodies {
                [carrier, wheel] if carrier == self.body => wheel,
                [wheel, carrier] if carrier == self.body => wheel,
                _ => return None,
            };
            Some((joint, if other == BodyId::Ground { self.body } else { other }))
        }

        /// Axis of the wheel. If it is left out, the axis of the wheel's joint.
        fn wheel_axis(&self, among: Surroundings<'_, T>) -> Option<[T; 3]> {
            if self.axis.is_some() || among.dimension.count() == 2 {
                return self.axis;
            }
            self.wheel(among).map(|(joint, _)| joint.direction(Axis::First).into())
        }

        /// Checks the slip, and that `spin` is a joint of the carrier about the wheel's axis. A wheel with `spin` must have slip.
        fn check_spin(&self, among: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            if let Some(slip) = self.longitudinal {
                place.positive("longitudinal", slip.stiffness)?;
                place.positive("longitudinal", slip.friction)?;
            }
            if self.spin.is_none() {
                return Ok(());
            }
            if self.longitudinal.is_none() {
                return place.fault("spin", SceneFault::NotUsed);
            }
            let Some((joint, _)) = self.wheel(among) else {
                return place.fault("spin", SceneFault::SpinElsewhere);
            };
            let is_about_another = |axis: [T; 3]| {
                among.dimension.count() == 3
                    && !is_parallel(axis, joint.direction(Axis::First).into())
            };
            match self.axis {
                Some(axis) if is_about_another(axis) => place.fault("spin", SceneFault::SpinAxis),
                _ => Ok(()),
            }
        }
    }

    /// Checks the coefficients of the side force. The formulas divide by A0, A2, A4 and the coefficient of friction.
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

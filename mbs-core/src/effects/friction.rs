//! Regularised Stribeck friction, which acts against the rate and is continuous at rest.
//!
//! ```text
//! f = g(r) r / sqrt(r^2 + e^2) + v r,   g = C + (S - C) / (1 + (r / r_s)^2)
//! ```
//!
//! Here r is the rate, C Coulomb friction, S static friction, r_s the Stribeck rate, v the viscous coefficient, and e the
//! regularisation. The fall from S to C is a rational bell. It replaces Stribeck's exponential, differs from it by less than 0.21
//! (S - C), and needs no exponential function. At rest the friction is zero. So a load that only friction holds creeps, at a rate
//! of about e times load over S. All power is dissipated.
//!
//! A signal may scale C and S, as in a brake or clutch. A negative value counts as zero.

use crate::Real;
use crate::laws::LawInputs;
use crate::laws::entry::entry;
use crate::laws::operations::Operations;
use crate::laws::scalar::{ScalarForce, TensionLaw};

/// Law of regularised Stribeck friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionLaw<T> {
    /// Coulomb friction C, at high rates [N m or N].
    pub coulomb: T,
    /// Static friction S, at low rates [N m or N].
    pub r#static: T,
    /// Rate at which friction has fallen by half the difference S - C [rad/s or m/s].
    pub stribeck: T,
    /// Viscous coefficient [N m s/rad or N s/m].
    pub viscous: T,
    /// Rate below which friction tends to zero with the rate [rad/s or m/s].
    pub regularisation: T,
    /// Signal whose first component scales Coulomb and static friction; `None`: they are not scaled.
    pub course: Option<u32>,
}

entry!(FrictionLaw<T> { coulomb, r#static, stribeck, viscous, regularisation, course });

/// Terms that the force and its slope have in common, at one rate.
#[derive(Debug, Clone, Copy)]
struct FrictionParts<T> {
    /// Regularised sign of the rate, r / sqrt(r^2 + e^2).
    share: T,
    /// sqrt(r^2 + e^2).
    root: T,
    /// Level of the friction, g [N m or N].
    level: T,
    /// Rate relative to the Stribeck rate, r / r_s.
    s: T,
    /// Bell function of the rate, 1 / (1 + s^2).
    bell: T,
}

impl<T: Real> FrictionLaw<T> {
    /// Force against the rate, and its derivative by the rate, at least zero. A negative slope, where friction falls with the rate,
    /// could make the tangent matrix indefinite.
    #[inline]
    pub fn force(&self, rate: T) -> (T, T) {
        let parts = self.parts(rate);
        let FrictionParts { share, level, .. } = parts;
        (level * share + self.viscous * rate, self.slope_of(parts, share))
    }

    /// Derivative of the force by the rate, in which one of the two factors r / sqrt(r^2 + e^2) is replaced by w, from -1 to 1:
    ///
    /// ```text
    /// g / sqrt(r^2 + e^2) (1 - w r / sqrt(r^2 + e^2)) + g' r / sqrt(r^2 + e^2) + v
    /// ```
    ///
    /// If w comes from the slope at the last iterate, Newton's method converges from any start. Near the solution w tends to the
    /// replaced factor, so that convergence is as fast as with the tangent (Chan, Golub and Mulet 1999).
    #[inline]
    pub fn slope(&self, rate: T, w: T) -> T {
        self.slope_of(self.parts(rate), w)
    }

    #[inline(always)]
    fn slope_of(&self, parts: FrictionParts<T>, w: T) -> T {
        let FrictionParts { share, root, level, s, bell } = parts;
        let rise = self.r#static - self.coulomb;
        let fall = share * rise * T::TWO * s * bell * bell / self.stribeck;
        (level / root * (T::ONE - w * share) - fall + self.viscous).max(T::ZERO)
    }

    /// Number w of [`slope`](Self::slope) for an iteration that went from the rate `before` to `rate`. Force and slope at `before`
    /// predict it. It is limited to -1 and 1.
    #[inline]
    pub fn foreseen(&self, rate: T, (before, force, slope): (T, T, T)) -> T {
        let level = self.parts(rate).level;
        let foreseen = force + slope * (rate - before) - self.viscous * rate;
        if level > T::ZERO { (foreseen / level).max(-T::ONE).min(T::ONE) } else { T::ZERO }
    }

    /// Returns the law with Coulomb and static friction scaled.
    #[inline]
    fn scaled(&self, share: T) -> Self {
        Self { coulomb: self.coulomb * share, r#static: self.r#static * share, ..*self }
    }

    /// Returns the law with Coulomb and static friction at the current time.
    #[inline]
    fn now(&self, law_inputs: &LawInputs<'_, T>) -> Self {
        let share = self.course.map(|course| law_inputs.course(course)[0].max(T::ZERO));
        share.map_or(*self, |share| self.scaled(share))
    }

    #[inline(always)]
    fn parts(&self, rate: T) -> FrictionParts<T> {
        let (e, s) = (self.regularisation, rate / self.stribeck);
        let bell = T::ONE / (T::ONE + s * s);
        let level = self.coulomb + (self.r#static - self.coulomb) * bell;
        let root = (rate * rate + e * e).sqrt();
        FrictionParts { share: rate / root, root, level, s, bell }
    }
}

impl<T: Real> TensionLaw<T> for FrictionLaw<T> {
    #[inline]
    fn evaluate(&self, value: T, rate: T, law_inputs: &LawInputs<'_, T>) -> ScalarForce<T> {
        let (tension, damping) = self.now(law_inputs).force(rate);
        ScalarForce { value, rate, tension, damping, ..ScalarForce::default() }
    }

    #[inline]
    fn secant(&self, measure: &ScalarForce<T>) -> T {
        measure.secant()
    }

    fn operations(&self) -> Operations {
        let scale = if self.course.is_some() { 2 } else { 0 };
        Operations::new(15 + scale, 9).and(5, 1, 0)
    }

    fn fits(&self, _: &LawInputs<'_, T>, n_courses: usize) -> bool {
        self.course.is_none_or(|course| (course as usize) < n_courses)
    }

    /// Slope that uses the force predicted by the iterate `before`: see [`slope`](FrictionLaw::slope). The tangents do not know the
    /// steep rise between two rates of opposite sign. So an iteration with tangents alone would oscillate across rest. In the first
    /// iteration of a step, `before` has no rate, and the tangent is used.
    #[inline]
    fn look_back(
        &self,
        measure: &mut ScalarForce<T>,
        before: &ScalarForce<T>,
        law_inputs: &LawInputs<'_, T>,
    ) {
        if before.rate != T::ZERO {
            let last = (before.rate, before.tension, before.damping);
            let law = self.now(law_inputs);
            let foreseen = law.foreseen(measure.rate, last);
            measure.damping = law.slope(measure.rate, foreseen);
        }
    }
}

#[cfg(feature = "alloc")]
pub use data::Friction;
#[cfg(feature = "alloc")]
pub(super) use data::{check_levels, leave_levels, rise};

#[cfg(feature = "alloc")]
mod data {
    use super::FrictionLaw;
    use crate::effects::data::*;

    effect! {
        /// Stribeck friction of a joint's coordinate, regularised.
        pub struct Friction<T> = ["friction"] {
            /// The joint.
            joint: JointId = Joint(Coordinate), "", Needed;
            /// Its coordinate; needed where it has several.
            coordinate: Option<usize> = Coordinate, "", Nothing;
            /// Friction of fast motion.
            coulomb: T = Number(NotNegative), "N m or N", Needed;
            /// Friction of slow motion.
            r#static as "static": T = Number(NotNegative), "N m or N", As("coulomb");
            /// Rate at which the one becomes the other.
            stribeck: T = Number(Positive), "rad/s or m/s", Times("10", "regularisation");
            /// Viscous part.
            viscous: T = Number(NotNegative), "N m s/rad or N s/m", ZERO;
            /// Rate below which friction falls to zero with the rate.
            regularisation: T = Number(Positive), "rad/s or m/s", Number("1e-3");
            /// Factor of `coulomb` and `static`: of a brake, or a clutch. Below zero it counts as zero.
            factor as "value": Signal<T> = Signal(Scalar), "-", Number("1");
        }
    }

    /// Checks that static friction is at least Coulomb friction.
    pub(in crate::effects) fn check_levels<T: Real>(
        [slow, fast]: [T; 2],
        place: Place,
    ) -> Result<(), SceneError> {
        if slow >= fast {
            return Ok(());
        }
        place.fault("static", SceneFault::StaticBelowCoulomb([slow.to_f64(), fast.to_f64()]))
    }

    /// Rate below which dry friction rises from zero; `None` for friction that is only viscous.
    pub(in crate::effects) fn rise<T: Real>(levels: [T; 2], regularisation: T) -> Option<T> {
        (levels[0].max(levels[1]) > T::ZERO).then_some(regularisation)
    }

    /// Removes dry friction, and reports it to `leave` if there was any.
    pub(in crate::effects) fn leave_levels<T: Real>(
        levels: [&mut T; 2],
        leave: &mut dyn FnMut(&'static str),
    ) {
        if levels.iter().any(|level| **level > T::ZERO) {
            leave("dry friction");
        }
        levels.into_iter().for_each(|level| *level = T::ZERO);
    }

    impl<T: Real> FrictionLaw<T> {
        /// Returns the law with Coulomb and static friction multiplied by a signal.
        pub(in crate::effects) fn by(self, factor: &Signal<T>, to: &mut Compiler<'_, T>) -> Self {
            match factor {
                Signal::Constant([share, ..]) => self.scaled(share.max(T::ZERO)),
                signal => Self { course: Some(to.course(signal)), ..self },
            }
        }
    }

    impl<T: Real> EffectModel<T> for Friction<T> {
        const LAW: &'static str = "g(q̇) q̇/√(q̇² + e²) + v q̇, g = `value` (C + (S - C)/(1 + (q̇/s)²))";
        const ABSENT: Option<[&'static str; 2]> = Some(["friction", "no friction in joints"]);

        fn check(&self, _: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            check_levels([self.r#static, self.coulomb], place)
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let &Self {
                joint,
                coordinate,
                coulomb,
                r#static,
                regularisation,
                stribeck,
                viscous,
                ..
            } = self;
            let law =
                FrictionLaw { coulomb, r#static, stribeck, viscous, regularisation, course: None };
            let law = law.by(&self.factor, to);
            to.on_joint((joint, coordinate), law);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn sticking(&self) -> Option<T> {
            rise([self.coulomb, self.r#static], self.regularisation)
        }
        fn dissipates(&self) -> bool {
            true
        }
        fn rest(&mut self, leave: &mut dyn FnMut(&'static str)) -> bool {
            let levels = [&mut self.coulomb, &mut self.r#static];
            leave_levels(levels, leave);
            self.viscous > T::ZERO
        }
    }
}

//! User-defined law as a plain function: see [`user`](crate::laws::user).

use crate::Real;
use crate::algebra::Vector;
use crate::laws::LawInputs;
use crate::laws::body::{BodyMotion, UnitWrench, WrenchesLaw, put};
use crate::laws::entry::{Entry, EntryReader, EntryWriter};
use crate::laws::operations::Operations;
use crate::laws::scalar::{ScalarForce, TensionLaw};
use crate::laws::user::{UserBodyLaw, UserScalarLaw};

/// User-defined law of a value and its rate, with its input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UserScalarEntry<T> {
    /// User's law of a value and its rate.
    pub law: UserScalarLaw<T>,
    /// Number of the signal that is the law's input.
    pub course: u32,
}

/// User-defined law on a body, with its input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UserBodyEntry<T> {
    /// User's law on a body.
    pub law: UserBodyLaw<T>,
    /// Number of the signal that is the law's input.
    pub course: u32,
}

/// Implements `Entry` for a law in code, which cannot be written as numbers.
macro_rules! code {
    ($Law:ident) => {
        impl<T> Entry<T> for $Law<T> {
            fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
                Err(from.fault())
            }
            fn numbers<W: EntryWriter<T>>(&self, to: &mut W) -> bool {
                to.text("NotExported");
                false
            }
        }
    };
}
code!(UserScalarEntry);
code!(UserBodyEntry);

impl<T: Real> TensionLaw<T> for UserScalarEntry<T> {
    #[inline]
    fn evaluate(&self, value: T, rate: T, law_inputs: &LawInputs<'_, T>) -> ScalarForce<T> {
        let given = (self.law.evaluate)(value, rate, law_inputs.course(self.course));
        ScalarForce { value, rate, transverse: T::ZERO, drift: T::ZERO, ..given }
    }

    fn operations(&self) -> Operations {
        Operations::NONE
    }

    #[inline]
    fn energy(&self, value: T, law_inputs: &LawInputs<'_, T>) -> T {
        (self.law.energy)(value, law_inputs.course(self.course))
    }

    #[inline]
    fn elastic(&self, value: T, law_inputs: &LawInputs<'_, T>) -> T {
        (self.law.elastic)(value, law_inputs.course(self.course))
    }

    fn may_push(&self) -> bool {
        true
    }
}

impl<T: Real> WrenchesLaw<T> for UserBodyEntry<T> {
    /// Writes the law's wrench for a motion, with the rate of the wrench.
    fn evaluate(
        &self,
        motion: &BodyMotion<T>,
        law_inputs: &LawInputs<'_, T>,
        out: &mut [UnitWrench<T>],
    ) {
        let mut action = (self.law.evaluate)(motion, law_inputs.course(self.course));
        let [force, moment] = [action.force, action.moment].map(Vector::<T, 3>::from);
        action.measure.rate =
            force.dot(&Vector::from(motion.velocity)) + moment.dot(&Vector::from(motion.spin));
        put(out, 0, action);
    }

    fn operations(&self, _: &LawInputs<'_, T>) -> Operations {
        Operations::NONE
    }
}

#[cfg(feature = "alloc")]
pub use data::Own;

#[cfg(feature = "alloc")]
mod data {
    use super::{UserBodyEntry, UserScalarEntry};
    use crate::effects::data::*;
    use crate::effects::reference::{check_coordinate, check_pair, known_body};
    use crate::effects::{EffectData, Field, SignalForm, Value};
    use crate::scene::UserLaw;

    /// User-defined law as an effect, only in scenes built in code.
    #[derive(Debug, Clone, PartialEq)]
    pub struct Own<T> {
        /// Law, with the place at which it acts.
        pub law: UserLaw<T>,
        /// Input of the law.
        pub course: Signal<T>,
    }

    /// Data of a user-defined law. The law is code, so that no scene file contains it and it has no values.
    impl<T> EffectData<T> for Own<T> {
        const NAMES: &'static [&'static str] = &[];
        const FIELDS: &'static [Field] = &[];

        fn values(&self) -> Vec<Value<T>>
        where
            T: Clone,
        {
            Vec::new()
        }
        fn of(_: &mut dyn Iterator<Item = Value<T>>) -> Option<Self> {
            None
        }
    }

    impl<T: Real> EffectModel<T> for Own<T> {
        const LAW: &'static str = "";

        fn name(&self) -> &'static str {
            "own"
        }
        fn check(&self, among: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            place.signal(&self.course, among.signals.len())?;
            match self.law {
                UserLaw::Length { bodies, points, .. } => {
                    check_pair(among, bodies, place)?;
                    place.apart("points", points)
                }
                UserLaw::Joint { joint, .. } => {
                    check_coordinate(among, joint, (Coordinate, None), place)
                }
                UserLaw::Body { body, at, axis, .. } => {
                    known_body(among, body, place)?;
                    place.vector("at", at)?;
                    place.axis("axis", axis)
                }
            }
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let course = to.course(&self.course);
            match self.law {
                UserLaw::Length { bodies, points, law } => {
                    to.length(bodies, points, UserScalarEntry { law, course });
                }
                UserLaw::Joint { joint, law } => {
                    to.on_joint((joint, None), UserScalarEntry { law, course });
                }
                UserLaw::Body { body, at, axis, law } => {
                    let axis = crate::effects::action::direction_of(axis);
                    to.on_body((body, at), axis, UserBodyEntry { law, course });
                }
            }
        }
        /// Returns no picture, because the places of the law are no values.
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn signal(&self) -> Option<(Signal<T>, SignalForm, &'static str)> {
            Some((self.course.clone(), SignalForm::Three, ""))
        }
        fn stores_energy(&self) -> bool {
            true
        }
        fn dissipates(&self) -> bool {
            true
        }
        fn follows_time(&self) -> bool {
            !matches!(self.course, Signal::Constant(_))
        }
    }
}

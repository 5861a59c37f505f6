//! A user-defined law with data on one body: see [`code`](crate::laws::code).
//!
//! ```text
//! force F at the point, moment M: a unit wrench (F, M) with the tension −1, power F.v + M.w
//! ```

#[cfg(not(feature = "alloc"))]
pub use crate::laws::body::NeverLaw as CodeBodyLaw;
#[cfg(feature = "alloc")]
pub use data::LawOnBody;
#[cfg(feature = "alloc")]
pub use law::CodeBodyLaw;

#[cfg(feature = "alloc")]
mod law {
    use crate::Real;
    use crate::algebra::Vector;
    use crate::laws::LawInputs;
    use crate::laws::body::{BodyMotion, UnitWrench, WrenchesLaw, put};
    use crate::laws::code::MeasuredBody;
    use crate::laws::entry::{Entry, EntryReader, EntryWriter};
    use crate::laws::operations::Operations;
    use crate::laws::scalar::ScalarForce;
    use core::marker::PhantomData;

    /// User-defined law on a body, given by its number.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct CodeBodyLaw<T> {
        number: u32,
        /// Number of the signal that is the input, and number of the signal that is the time.
        courses: [u32; 2],
        scalar: PhantomData<T>,
    }

    impl<T: Real> Entry<T> for CodeBodyLaw<T> {
        fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
            Err(from.fault())
        }
        fn numbers<W: EntryWriter<T>>(&self, to: &mut W) -> bool {
            to.text("NotExported");
            false
        }
    }

    impl<T> CodeBodyLaw<T> {
        pub(crate) fn new(number: u32, courses: [u32; 2]) -> Self {
            Self { number, courses, scalar: PhantomData }
        }
    }

    impl<T: Real> WrenchesLaw<T> for CodeBodyLaw<T> {
        #[inline(never)]
        fn evaluate(
            &self,
            motion: &BodyMotion<T>,
            law_inputs: &LawInputs<'_, T>,
            out: &mut [UnitWrench<T>],
        ) {
            let [input, time] = self.courses.map(|course| law_inputs.course(course));
            let numbers = |x: [T; 3]| x.map(T::to_f64);
            let at = MeasuredBody {
                time: time[0].to_f64(),
                position: numbers(motion.position),
                velocity: numbers(motion.velocity),
                axis: numbers(motion.axis),
                angular_velocity: numbers(motion.spin),
                input: numbers(input),
            };
            let wrench = law_inputs.codes().and_then(|codes| codes.wrench(self.number, &at));
            let [force, moment] = wrench.map_or([[T::from_f64(f64::NAN); 3]; 2], |wrench| {
                [wrench.force, wrench.moment].map(|x| x.map(T::from_f64))
            });
            let rate = Vector::from(force).dot(&Vector::from(motion.velocity))
                + Vector::from(moment).dot(&Vector::from(motion.spin));
            let measure = ScalarForce { rate, tension: -T::ONE, ..ScalarForce::default() };
            put(out, 0, UnitWrench { force, moment, measure });
        }

        fn operations(&self, _: &LawInputs<'_, T>) -> Operations {
            Operations::NONE
        }
    }
}

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::laws::code::{BodyLaw, Code};

    effect! {
        /// A user-defined law with data, on a body; in code only.
        pub struct LawOnBody<T> = [] {
            /// The body.
            body: BodyId = Body, "", Needed;
            /// The law's point, reference configuration.
            at: [T; 3] = Point, "m", Needed;
            /// The law's direction, fixed in the body, reference configuration.
            axis: [T; 3] = Axis, "", Needed;
            /// The law.
            law: Code<dyn BodyLaw> = BodyLaw, "", Needed;
            /// Its input.
            input as "value": Signal<T> = Signal(Three), "", Needed;
        }
    }

    impl<T: Real> EffectModel<T> for LawOnBody<T> {
        const LAW: &'static str = "";

        fn name(&self) -> &'static str {
            "law-on-body"
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let law = to.body_code(&self.law, &self.input);
            to.on_body((self.body, self.at), crate::effects::action::direction_of(self.axis), law);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn dissipates(&self) -> bool {
            true
        }
        fn follows_time(&self) -> bool {
            true
        }
    }
}

//! A user-defined law with data, along the line of two points: see [`code`](crate::laws::code).
//!
//! ```text
//! f = f(t, m, m', u),   stored V(t, m, u) = V(t, m, 0, u),   power that is not stored dV/dt − f m'
//! ```

#[cfg(not(feature = "alloc"))]
pub use crate::laws::body::NeverLaw as CodeLaw;
#[cfg(feature = "alloc")]
pub use data::LawOnLine;
#[cfg(feature = "alloc")]
pub use law::CodeLaw;

#[cfg(feature = "alloc")]
mod law {
    use crate::Real;
    use crate::laws::LawInputs;
    use crate::laws::code::{Force, Measured};
    use crate::laws::entry::{Entry, EntryReader, EntryWriter};
    use crate::laws::operations::Operations;
    use crate::laws::scalar::{ScalarForce, TensionLaw};
    use core::marker::PhantomData;

    /// User-defined law of a line or a joint, given by its number.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct CodeLaw<T> {
        number: u32,
        /// Number of the signal that is the input, and number of the signal that is the time.
        courses: [u32; 2],
        scalar: PhantomData<T>,
    }

    impl<T: Real> Entry<T> for CodeLaw<T> {
        fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
            Err(from.fault())
        }
        fn numbers<W: EntryWriter<T>>(&self, to: &mut W) -> bool {
            to.text("NotExported");
            false
        }
    }

    /// Relative change of a value for a difference quotient, and the smallest change [m, rad]: the third root of the rounding
    /// error.
    const CHANGE: [f64; 2] = [6e-6, 6e-9];
    /// Change of time for a difference quotient [s]: near the third root of the rounding error, for times of order one.
    const INSTANT: f64 = 1e-6;

    impl<T: Real> CodeLaw<T> {
        pub(crate) fn new(number: u32, courses: [u32; 2]) -> Self {
            Self { number, courses, scalar: PhantomData }
        }

        fn measured(&self, [value, rate]: [T; 2], law_inputs: &LawInputs<'_, T>) -> Measured {
            let [input, time] = self.courses.map(|course| law_inputs.course(course));
            Measured {
                time: time[0].to_f64(),
                value: value.to_f64(),
                rate: rate.to_f64(),
                input: input.map(T::to_f64),
            }
        }

        fn force(&self, at: &Measured, law_inputs: &LawInputs<'_, T>) -> Force {
            law_inputs.codes().map_or_else(Force::default, |codes| codes.force(self.number, at))
        }
    }

    impl<T: Real> TensionLaw<T> for CodeLaw<T> {
        #[inline(never)]
        fn evaluate(&self, value: T, rate: T, law_inputs: &LawInputs<'_, T>) -> ScalarForce<T> {
            let at = self.measured([value, rate], law_inputs);
            let Force { force, stiffness, damping, .. } = self.force(&at, law_inputs);
            ScalarForce {
                value,
                rate,
                tension: T::from_f64_with(force, &[(stiffness, value), (damping, rate)]),
                stiffness: T::from_f64(stiffness),
                damping: T::from_f64(damping),
                ..ScalarForce::default()
            }
        }

        fn operations(&self) -> Operations {
            Operations::NONE
        }

        #[inline(never)]
        fn energy(&self, value: T, law_inputs: &LawInputs<'_, T>) -> T {
            let at = self.measured([value, T::ZERO], law_inputs);
            T::from_f64(self.force(&at, law_inputs).energy)
        }

        /// Power that the law does not store [W], with the change of its energy by time alone. It uses central differences.
        #[inline(never)]
        fn power(&self, measure: &ScalarForce<T>, law_inputs: &LawInputs<'_, T>) -> T {
            let ScalarForce { value, rate, tension, .. } = *measure;
            let at = self.measured([value, T::ZERO], law_inputs);
            let energy = |at| self.force(&at, law_inputs).energy;
            // If the energy is not finite on one side, its slope counts as zero.
            let slope = |more: Measured, less: Measured, by: f64| {
                Some((energy(more) - energy(less)) / by).filter(|x| x.is_finite()).unwrap_or(0.0)
            };
            let change = (at.value.abs() * CHANGE[0]).max(CHANGE[1]);
            let [more, less] = [at.value + change, at.value - change];
            let [from, to] = [less, more].map(|value| Measured { value, ..at });
            let elastic = slope(to, from, more - less);
            // The time of a run begins at zero.
            let [late, early] = [at.time + INSTANT, (at.time - INSTANT).max(at.time.min(0.0))];
            let [from, to] = [early, late].map(|time| Measured { time, ..at });
            let given = slope(to, from, late - early);
            (T::from_f64(elastic) - tension) * rate + T::from_f64(given)
        }

        fn may_push(&self) -> bool {
            true
        }
    }
}

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::laws::code::{Code, ForceLaw};

    effect! {
        /// A user-defined law with data, along the line of two body points; in code only.
        pub struct LawOnLine<T> = [] {
            /// First and second body.
            bodies: [BodyId; 2] = Bodies, "", Needed;
            /// One point per body, reference configuration.
            points: [[T; 3]; 2] = Points(true), "m", Needed;
            /// The law.
            law: Code<dyn ForceLaw> = ForceLaw, "", Needed;
            /// Its input.
            input as "value": Signal<T> = Signal(Three), "", Needed;
        }
    }

    impl<T: Real> EffectModel<T> for LawOnLine<T> {
        const LAW: &'static str = "";

        fn name(&self) -> &'static str {
            "law-on-line"
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let law = to.force_code(&self.law, &self.input);
            to.length(self.bodies, self.points, law);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Line(LineLook::Actuator)
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn stores_energy(&self) -> bool {
            true
        }
        fn dissipates(&self) -> bool {
            true
        }
        fn follows_time(&self) -> bool {
            true
        }
    }
}

//! Laws of guides and signals: functions of time from tables, or inputs that the program sets between steps.

use mbs_core::Real;
use mbs_core::laws::{Part, guide};
use mbs_core::step::InputError;
use mbs_recursive::passes::feedback;
use mbs_recursive::passes::slices::Inputs;

/// Law of a guide, as a function of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Motion<T> {
    /// An input: the program sets value, rate and acceleration between steps. The variant has the values at the start.
    Input([T; 3]),
    /// Sine over time: amplitude sin(2 pi frequency t + phase).
    Sine {
        /// Amplitude [rad or m].
        amplitude: T,
        /// Frequency of the sine [Hz].
        frequency: T,
        /// Phase of the sine [rad].
        phase: T,
    },
    /// Motion at a constant rate: rate t.
    Ramp {
        /// Rate [rad/s or m/s].
        rate: T,
    },
    /// Cubic spline through a part of the model's knots, with the second derivatives at these knots.
    Table(Part),
    /// Step from one value to another.
    Step(Rise<T>),
}

/// A smooth step: from + (to - from) s^3 (10 - 15 s + 6 s^2), with s = (t - at)/rise limited to the range from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rise<T> {
    /// Value before the step.
    pub from: T,
    /// Value after the step.
    pub to: T,
    /// Time at which the step begins [s].
    pub at: T,
    /// Duration of the step; zero means a jump [s].
    pub rise: T,
}

/// Law of a signal, or of the vector of an effect, as a function of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SignalLaw<T> {
    /// An input: the program sets value, rate and acceleration of a signal, or the vector of an effect, between steps. The variant has the
    /// values at the start.
    Input([T; 3]),
    /// Constant value, with zero derivatives.
    Constant([T; 3]),
    /// Position and speed of a moving road: (speed t, speed, 0) [m, m/s].
    Travel(T),
    /// Linear interpolation in a part of the model's rows.
    Table(Part),
    /// Cubic spline through a part of the model's knots, with its derivatives. If the second derivatives at the knots are zero, the spline
    /// consists of straight lines.
    Spline(Part),
    /// Step from one value to another, with its derivatives.
    Step(Rise<T>),
}

/// Laws of all guides and signals of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prescriptions<'a, T> {
    /// Guides, each as a function of time or as an input.
    pub guides: &'a [Motion<T>],
    /// Signals, each as a function of time or as an input.
    pub courses: &'a [SignalLaw<T>],
    /// Knots (time, value) of guides and signals, and the second derivatives at the knots.
    pub knots: (&'a [[T; 2]], &'a [T]),
    /// Rows (time, vector) of the signals.
    pub rows: &'a [[T; 4]],
}

/// Values that the program sets between steps. Each guide and each signal has an entry. The entry is used only if the guide or signal is an
/// input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Values<const G: usize, const C: usize, T> {
    pub(crate) guides: [[T; 3]; G],
    pub(crate) courses: [[T; 3]; C],
    /// Motions of the guides at the end of the last step.
    pub(crate) ended: [[T; 3]; G],
    /// True for each guide that is an input.
    is_guide: [bool; G],
    is_course: [bool; C],
    /// True if the accelerations were evaluated for other values of the signals.
    pub(crate) has_new: bool,
}

impl<T: Real, const G: usize, const C: usize> Values<G, C, T> {
    /// Returns the values of the inputs at the start.
    pub(crate) fn new(from: &Prescriptions<'_, T>) -> Self {
        let mut values = Self {
            guides: [[T::ZERO; 3]; G],
            courses: [[T::ZERO; 3]; C],
            ended: [[T::ZERO; 3]; G],
            is_guide: [false; G],
            is_course: [false; C],
            has_new: false,
        };
        for ((to, is_input), law) in
            values.guides.iter_mut().zip(&mut values.is_guide).zip(from.guides)
        {
            if let Motion::Input(first) = law {
                (*to, *is_input) = (*first, true);
            }
        }
        for ((to, is_input), law) in
            values.courses.iter_mut().zip(&mut values.is_course).zip(from.courses)
        {
            if let SignalLaw::Input(first) = law {
                (*to, *is_input) = (*first, true);
            }
        }
        values.ended = values.guides;
        values
    }

    /// Prepares for a restart of the model. The accelerations of the start state belong to the inputs at the start, so the values that are
    /// set now may count as new.
    pub(crate) fn restart(&mut self, from: &Prescriptions<'_, T>) {
        let first = Self::new(from);
        (self.ended, self.has_new) = (first.guides, self.courses != first.courses);
    }

    /// Sets a signal that is an input.
    pub(crate) fn set_input(&mut self, number: usize, value: [T; 3]) -> Result<(), InputError> {
        InputError::check(number, &value)?;
        let (Some(to), Some(true)) = (self.courses.get_mut(number), self.is_course.get(number))
        else {
            return Err(InputError::NotAnInput { number });
        };
        self.has_new |= *to != value;
        *to = value;
        Ok(())
    }

    /// Sets a guide that is an input.
    pub(crate) fn set_guide(&mut self, number: usize, motion: [T; 3]) -> Result<(), InputError> {
        InputError::check(number, &motion)?;
        let (Some(to), Some(true)) = (self.guides.get_mut(number), self.is_guide.get(number))
        else {
            return Err(InputError::NotAnInput { number });
        };
        *to = motion;
        Ok(())
    }
}

/// Laws together with the values that the program set, as a step evaluates them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Written<'a, const G: usize, const C: usize, T> {
    pub(crate) laws: Prescriptions<'a, T>,
    pub(crate) guides: &'a [[T; 3]; G],
    pub(crate) courses: &'a [[T; 3]; C],
}

impl<const G: usize, const C: usize, T: Real> Inputs<T> for Written<'_, G, C, T> {
    fn evaluate(&self, t: T, guides: &mut [[T; 3]], courses: &mut [[T; 3]]) {
        for ((to, law), &written) in guides.iter_mut().zip(self.laws.guides).zip(self.guides) {
            *to = guide_at(law, &self.laws, written, t);
        }
        for ((to, law), &written) in courses.iter_mut().zip(self.laws.courses).zip(self.courses) {
            *to = course_at(law, &self.laws, written, t);
        }
    }
}

fn guide_at<T: Real>(
    law: &Motion<T>,
    laws: &Prescriptions<'_, T>,
    written: [T; 3],
    t: T,
) -> [T; 3] {
    let motion = match law {
        Motion::Input(_) => return written,
        Motion::Sine { amplitude, frequency, phase } => {
            guide::sine(*amplitude, *frequency, *phase, t)
        }
        Motion::Ramp { rate } => guide::ramp(*rate, t),
        Motion::Table(part) => return spline(*part, laws, t),
        Motion::Step(rise) if feedback::IS_BUILT => return rise.at(t),
        // This build does not support steps. A model with a step is refused when it is loaded.
        Motion::Step(_) => return [T::ZERO; 3],
    };
    [motion.value, motion.rate, motion.acceleration]
}

impl<T: Real> Rise<T> {
    #[inline(never)]
    fn at(&self, t: T) -> [T; 3] {
        guide::step([self.from, self.to], (t - self.at, self.rise))
    }
}

fn spline<T: Real>(part: Part, laws: &Prescriptions<'_, T>, t: T) -> [T; 3] {
    let at = guide::spline(part.of(laws.knots.0), part.of(laws.knots.1), t);
    [at.value, at.rate, at.acceleration]
}

fn course_at<T: Real>(
    law: &SignalLaw<T>,
    laws: &Prescriptions<'_, T>,
    written: [T; 3],
    t: T,
) -> [T; 3] {
    let rows = match law {
        SignalLaw::Input(_) => return written,
        SignalLaw::Constant(value) => return *value,
        SignalLaw::Travel(speed) => return [*speed * t, *speed, T::ZERO],
        SignalLaw::Spline(part) if feedback::IS_BUILT => return spline(*part, laws, t),
        SignalLaw::Step(rise) if feedback::IS_BUILT => return rise.at(t),
        // This build does not support splines and steps of signals. A model with one of them is refused when it is loaded.
        SignalLaw::Spline(_) | SignalLaw::Step(_) => return [T::ZERO; 3],
        SignalLaw::Table(part) => part.of(laws.rows),
    };
    guide::linear(rows, |&[t, x, y, z]| (t, [x, y, z]), t)
}

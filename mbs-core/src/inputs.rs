//! Prescribed functions of time: guide laws and courses, prepared once.

use crate::Real;
use crate::laws::guide;
use crate::scene::{Motion, Scene, Signal, TableEnds};
use crate::step::InputError;
use alloc::vec;
use alloc::vec::Vec;

/// The guides of a scene and the courses of its effects.
#[derive(Debug, Clone, PartialEq)]
pub struct Prescribed<T> {
    guides: Vec<GuideInput<T>>,
    /// The effect that asked for each course, and the course.
    courses: Vec<(usize, SignalInput<T>)>,
}

impl<T: Real> Prescribed<T> {
    /// The guides of a scene, and no course.
    pub(crate) fn new(scene: &Scene<T>) -> Self {
        let guides = scene.guides.iter().map(|guide| GuideInput::new(&guide.law)).collect();
        Self { guides, courses: Vec::new() }
    }

    /// Adds a course for `scene.effects[effect]` and returns its number.
    pub(crate) fn add(&mut self, effect: usize, course: SignalInput<T>) -> usize {
        self.courses.push((effect, course));
        self.courses.len() - 1
    }

    /// The guides, in the order of the scene.
    #[must_use]
    pub fn guides(&self) -> &[GuideInput<T>] {
        &self.guides
    }

    /// The courses by number, each with the effect that asked for it.
    #[must_use]
    pub fn courses(&self) -> &[(usize, SignalInput<T>)] {
        &self.courses
    }

    /// Number of guides.
    #[must_use]
    pub fn n_guides(&self) -> usize {
        self.guides.len()
    }

    /// Number of courses.
    #[must_use]
    pub fn n_courses(&self) -> usize {
        self.courses.len()
    }

    /// Writes value, rate and acceleration of each guide and the vector of each course at time `t`.
    pub fn write(&self, t: T, guides: &mut [[T; 3]], courses: &mut [[T; 3]]) {
        for (value, guide) in guides.iter_mut().zip(&self.guides) {
            *value = guide.at(t);
        }
        for (value, (_, course)) in courses.iter_mut().zip(&self.courses) {
            *value = course.at(t);
        }
    }

    /// Sets the course of `scene.effects[effect]` from now on.
    ///
    /// # Errors
    /// [`InputError`] where the effect has no input, or a component is not finite.
    pub fn set_course(&mut self, effect: usize, value: [T; 3]) -> Result<(), InputError> {
        InputError::check(effect, &value)?;
        let mut is_set = false;
        for (_, course) in self.courses.iter_mut().filter(|(e, _)| *e == effect) {
            is_set |= course.set(value);
        }
        if is_set { Ok(()) } else { Err(InputError::NotAnInput { number: effect }) }
    }

    /// Sets value, rate and acceleration of `scene.guides[guide]` at the end of the next step.
    ///
    /// # Errors
    /// [`InputError`] where the guide is no input, or a component is not finite.
    pub fn set_guide(&mut self, guide: usize, motion: [T; 3]) -> Result<(), InputError> {
        InputError::check(guide, &motion)?;
        let is_set = self.guides.get_mut(guide).is_some_and(|guide| guide.set(motion));
        if is_set { Ok(()) } else { Err(InputError::NotAnInput { number: guide }) }
    }

    /// The guides and courses that are set between steps, by number: what a state keeps of them, guides first.
    fn guide_inputs(&self) -> impl Iterator<Item = (usize, [T; 3])> + '_ {
        self.guides.iter().enumerate().filter_map(|(i, guide)| match guide.law {
            Motion::Input(motion) => Some((i, motion)),
            _ => None,
        })
    }

    fn course_inputs(&self) -> impl Iterator<Item = (usize, [T; 3])> + '_ {
        self.courses.iter().enumerate().filter_map(|(i, (_, course))| match course.course {
            Signal::Input(value) => Some((i, value)),
            _ => None,
        })
    }

    /// What is set between steps, as it is set now: guides, then courses.
    #[must_use]
    pub fn inputs(&self) -> Vec<[T; 3]> {
        self.guide_inputs().chain(self.course_inputs()).map(|(_, value)| value).collect()
    }

    /// Writes the [`inputs`](Self::inputs) of now: those that a step was made with.
    pub fn keep(&self, kept: &mut [[T; 3]]) {
        if kept.is_empty() {
            return;
        }
        let now = self.guide_inputs().chain(self.course_inputs());
        for (to, (_, value)) in kept.iter_mut().zip(now) {
            *to = value;
        }
    }

    /// The same of courses alone.
    pub fn keep_courses(&self, kept: &mut [[T; 3]]) {
        let first = self.guide_inputs().count();
        for (to, (_, value)) in kept.iter_mut().skip(first).zip(self.course_inputs()) {
            *to = value;
        }
    }

    /// Are courses set to other values than those that were kept?
    #[must_use]
    pub fn differs(&self, kept: &[[T; 3]]) -> bool {
        if kept.is_empty() {
            return false;
        }
        let first = self.guide_inputs().count();
        self.course_inputs().zip(&kept[first..]).any(|((_, now), before)| now != *before)
    }

    /// Writes guides and courses at time `t` where a step has ended that was made with the inputs `kept`; courses as they are set
    /// now, if `is_new`.
    pub fn write_end(
        &self,
        t: T,
        (kept, is_new): (&[[T; 3]], bool),
        (guides, courses): (&mut [[T; 3]], &mut [[T; 3]]),
    ) {
        self.write(t, guides, courses);
        let mut kept = kept.iter();
        for ((i, _), value) in self.guide_inputs().zip(kept.by_ref()) {
            guides[i] = *value;
        }
        if !is_new {
            for ((i, _), value) in self.course_inputs().zip(kept) {
                courses[i] = *value;
            }
        }
    }
}

/// A guide law with its spline prepared.
#[derive(Debug, Clone, PartialEq)]
pub struct GuideInput<T> {
    law: Motion<T>,
    curvature: Vec<T>,
}

impl<T: Real> GuideInput<T> {
    /// Prepares a law.
    #[must_use]
    pub fn new(law: &Motion<T>) -> Self {
        let mut curvature = Vec::new();
        if let Motion::Table { rows, ends } = law {
            curvature.resize(rows.len(), T::ZERO);
            let mut scratch = vec![T::ZERO; rows.len()];
            match ends {
                TableEnds::Natural => guide::spline_curvatures(rows, &mut curvature, &mut scratch),
                TableEnds::Level => guide::level_curvatures(rows, &mut curvature, &mut scratch),
            }
        }
        Self { law: law.clone(), curvature }
    }

    /// The law.
    #[must_use]
    pub fn law(&self) -> &Motion<T> {
        &self.law
    }

    /// Second derivatives at the knots of a table; none for other laws.
    #[must_use]
    pub fn curvature(&self) -> &[T] {
        &self.curvature
    }

    /// Value, rate, acceleration at time `t`. Cost: one law; no allocation.
    pub fn at(&self, t: T) -> [T; 3] {
        let m = match &self.law {
            Motion::Table { rows, .. } => guide::spline(rows, &self.curvature, t),
            Motion::Sine { amplitude, frequency, phase } => {
                guide::sine(*amplitude, *frequency, *phase, t)
            }
            Motion::Ramp { rate } => guide::ramp(*rate, t),
            Motion::Input(motion) => return *motion,
        };
        [m.value, m.rate, m.acceleration]
    }

    /// Sets value, rate and acceleration at the end of the next step; says whether the guide is an input.
    pub fn set(&mut self, motion: [T; 3]) -> bool {
        let is_input = matches!(self.law, Motion::Input(_));
        if is_input {
            self.law = Motion::Input(motion);
        }
        is_input
    }
}

/// A constant or a table, linear between its rows; or the way and speed of a road that moves.
#[derive(Debug, Clone, PartialEq)]
pub struct SignalInput<T> {
    course: Signal<T>,
    /// Speed of (speed t, speed, 0).
    travel: Option<T>,
}

impl<T: Real> SignalInput<T> {
    /// Prepares a course.
    #[must_use]
    pub fn new(course: &Signal<T>) -> Self {
        Self { course: course.clone(), travel: None }
    }

    /// The course (speed t, speed, 0) of a road.
    #[must_use]
    pub fn travel(speed: T) -> Self {
        Self { course: Signal::Constant([T::ZERO; 3]), travel: Some(speed) }
    }

    /// The course; of a road that moves a constant that is not read.
    #[must_use]
    pub fn course(&self) -> &Signal<T> {
        &self.course
    }

    /// The speed of a road that moves [m/s].
    #[must_use]
    pub fn speed(&self) -> Option<T> {
        self.travel
    }

    /// Sets the value from now on; says whether the course is an input.
    pub fn set(&mut self, value: [T; 3]) -> bool {
        let is_input = matches!(self.course, Signal::Input(_));
        if is_input {
            self.course = Signal::Input(value);
        }
        is_input
    }

    /// Value at time `t`.
    pub fn at(&self, t: T) -> [T; 3] {
        if let Some(speed) = self.travel {
            return [speed * t, speed, T::ZERO];
        }
        let rows = match &self.course {
            Signal::Constant(value) | Signal::Input(value) => return *value,
            Signal::Table(rows) => rows,
        };
        guide::linear(rows, |row| *row, t)
    }
}

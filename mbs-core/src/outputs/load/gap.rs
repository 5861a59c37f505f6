//! Gaps of one-sided effects, and the kinks of laws. A gap is positive without contact and negative in contact.
//!
//! ```text
//! bumper   g = m - touch                     g: gap, m: measured length or angle
//! limit    g = m - lower, g = upper - m
//! tire     g = -deflection,                  kinks of the road at places along it, compared with the place of the wheel's centre
//! spring   of polynomial pieces: kinks at the values of m between two pieces
//! ```

use super::apply::motion;
use super::{Load, Measure};
use crate::Real;
use crate::laws::LawInputs;
use crate::laws::bumper::FADE;
use crate::laws::corner::LawCorner;
use crate::model::State;

/// A gap [m or rad] and its rate.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gap<T> {
    /// Value of the gap [m or rad].
    pub value: T,
    /// Rate of the gap [m/s or rad/s].
    pub rate: T,
}

/// Largest number of gaps of one effect [-]: a limit has a lower and an upper one.
pub(in crate::outputs) const MOST_GAPS: usize = 2;

/// Gaps and coordinates of an effect at a state, for the detection of events.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::outputs) struct Reading<T> {
    /// Gaps of the effect. The first [`Load::n_gaps`] are used.
    pub(in crate::outputs) gaps: [Gap<T>; MOST_GAPS],
    /// Coordinates for the kinks of the effect: the wheel's centre along the road and its height, or a length and zero.
    pub(in crate::outputs) place: [Gap<T>; 2],
}

/// Number of values in a [`Reading`] [-].
pub(in crate::outputs) const N_READING: usize = 8;

impl<T: Real> Reading<T> {
    /// Values of the reading: gaps, then coordinates, each with its rate.
    pub(in crate::outputs) fn numbers(&self) -> [T; N_READING] {
        let [[a, b], [c, d]] = [self.gaps, self.place].map(|of| of.map(|g| [g.value, g.rate]));
        [a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]]
    }

    /// Reading with these [`numbers`](Self::numbers).
    pub(in crate::outputs) fn of_numbers(numbers: &[T; N_READING]) -> Self {
        let gap = |i: usize| Gap { value: numbers[2 * i], rate: numbers[2 * i + 1] };
        Self { gaps: [gap(0), gap(1)], place: [gap(2), gap(3)] }
    }
}

impl<T: Real, const D: usize> Load<T, D> {
    /// Number of gaps; zero for an effect that always acts.
    pub(in crate::outputs) fn n_gaps(&self) -> usize {
        match self {
            Self::Between { law, .. } | Self::Sum { law, .. } => law.n_gaps(),
            Self::OnBody { law, .. } => law.n_gaps(),
            _ => 0,
        }
    }

    /// Depth over which the damper of the contact fades in [m or rad]; `None` if it has none.
    pub(in crate::outputs) fn fade(&self) -> Option<f64> {
        let has_fade = match self {
            Self::Between { law, .. } | Self::Sum { law, .. } => law.has_fade(),
            Self::OnBody { law, .. } => law.has_fade(),
            _ => false,
        };
        has_fade.then_some(FADE)
    }

    /// True if the law may have kinks besides those of its gaps.
    pub(in crate::outputs) fn may_have_kinks(&self) -> bool {
        match self {
            Self::Between { law, .. } | Self::Sum { law, .. } => law.may_have_kinks(),
            Self::OnBody { law, .. } => law.may_have_kinks(),
            _ => false,
        }
    }

    /// Passes to `take` the kinks of the law, in no particular order.
    pub(in crate::outputs) fn kinks(
        &self,
        law_inputs: &LawInputs<'_, T>,
        mut take: impl FnMut(LawCorner<T>),
    ) {
        match self {
            Self::Between { law, .. } | Self::Sum { law, .. } => law.kinks(law_inputs, &mut take),
            Self::OnBody { law, .. } => law.kinks(law_inputs, &mut take),
            _ => {}
        }
    }

    /// Largest distance along the road between a kink and a wheel's centre when the contact point passes the kink [m]. On a slope, centre
    /// and contact point are apart along the road by less than the radius.
    pub(in crate::outputs) fn reach(&self) -> T {
        match self {
            Self::OnBody { law, .. } => law.reach(),
            _ => T::ZERO,
        }
    }

    /// True if the measure is an angle [rad]; false if it is a length [m].
    pub(in crate::outputs) fn is_angular(&self) -> bool {
        match self {
            Self::Between { gauge, .. } => matches!(gauge, Measure::Angle { .. }),
            Self::Sum { sum, .. } => sum.is_angle(),
            _ => false,
        }
    }

    /// Evaluates gaps and coordinates at a state. Cost: one length or angle, or one nearest point of the road.
    pub(in crate::outputs) fn reading(
        &self,
        state: &State<T>,
        law_inputs: &LawInputs<'_, T>,
    ) -> Reading<T> {
        let of = |[value, rate]: [T; 2]| Gap { value, rate };
        let mut reading = Reading::default();
        match self {
            Self::Between { law, .. } | Self::Sum { law, .. }
                if self.n_gaps() > 0 || self.may_have_kinks() =>
            {
                let [value, rate] = self.measure(state);
                reading.gaps = law.gaps(value, rate).map(of);
                reading.place[0] = Gap { value, rate };
            }
            Self::OnBody { point, frame, axis, law, .. }
                if self.n_gaps() > 0 || self.may_have_kinks() =>
            {
                let axis = frame.rotation(&state.q) * axis;
                let [gap, along, up] =
                    law.watch(&motion((point, frame), &axis, state), law_inputs).map(of);
                reading.gaps[0] = gap;
                reading.place = [along, up];
            }
            _ => {}
        }
        reading
    }
}

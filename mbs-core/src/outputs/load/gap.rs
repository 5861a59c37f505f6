//! Gaps of effects that act on one side only, positive apart, negative pressed in; and the kinks of laws.
//!
//! ```text
//! bumper   g = m - touch
//! limit    g = m - lower and upper - m
//! tire     g = -(deflection),   kinks of its road by the centre's place over it
//! spring   by pieces: kinks between them by m
//! ```

#![cfg_attr(
    not(feature = "effects"),
    allow(unused_imports, unused_mut, unused_variables, reason = "not every law has a kink")
)]

use super::apply::motion;
use super::{Gauge, Load};
use crate::Real;
use crate::laws::Supplies;
use crate::laws::body::BodyLaw;
use crate::laws::kink::{self, Kink};
#[cfg(feature = "polynomial")]
use crate::laws::polynomial;
use crate::laws::scalar::Law;
use crate::model::State;

/// A gap [m or rad] and its rate.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::outputs) struct Gap<T> {
    pub(in crate::outputs) value: T,
    pub(in crate::outputs) rate: T,
}

/// Gaps that one effect has at most: those of a limit, lower and upper.
pub(in crate::outputs) const MOST_GAPS: usize = 2;

/// What of an effect is watched, at a state.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::outputs) struct Reading<T> {
    /// Its gaps, [`Load::n_gaps`] of them.
    pub(in crate::outputs) gaps: [Gap<T>; MOST_GAPS],
    /// What tells its kinks: a wheel's centre along its road and up, or a length and zero.
    pub(in crate::outputs) place: [Gap<T>; 2],
}

/// Numbers of a [`Reading`].
pub(in crate::outputs) const N_READING: usize = 8;

impl<T: Real> Reading<T> {
    /// Its numbers.
    pub(in crate::outputs) fn numbers(&self) -> [T; N_READING] {
        let [[a, b], [c, d]] = [self.gaps, self.place].map(|of| of.map(|g| [g.value, g.rate]));
        [a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]]
    }

    /// The reading of these [`numbers`](Self::numbers).
    pub(in crate::outputs) fn of_numbers(numbers: &[T; N_READING]) -> Self {
        let gap = |i: usize| Gap { value: numbers[2 * i], rate: numbers[2 * i + 1] };
        Self { gaps: [gap(0), gap(1)], place: [gap(2), gap(3)] }
    }
}

impl<T: Real, const D: usize> Load<T, D> {
    /// How many gaps it has; none where it acts always.
    pub(in crate::outputs) fn n_gaps(&self) -> usize {
        match self {
            #[cfg(feature = "bumper")]
            Self::Between { law: Law::Bumper { .. }, .. } => 1,
            #[cfg(feature = "limit")]
            Self::Between { law: Law::Limit(_), .. } => 2,
            #[cfg(feature = "tire")]
            Self::OnBody { law: BodyLaw::Tire(_), .. } => 1,
            _ => 0,
        }
    }

    /// The depth over which the damper of its contact fades in [m or rad], if it has one.
    pub(in crate::outputs) fn fade(&self) -> Option<f64> {
        let has_damper = match self {
            #[cfg(feature = "bumper")]
            Self::Between { law: Law::Bumper { law, .. }, .. } => law[1] > T::ZERO,
            #[cfg(feature = "limit")]
            Self::Between { law: Law::Limit(limit), .. } => limit.damping > T::ZERO,
            #[cfg(feature = "tire")]
            Self::OnBody { law: BodyLaw::Tire(tire), .. } => tire.radial[1] > T::ZERO,
            _ => false,
        };
        #[cfg(any(feature = "bumper", feature = "limit", feature = "tire"))]
        if has_damper {
            return Some(crate::laws::bumper::FADE);
        }
        None
    }

    /// Can its law have kinks besides those of its gaps?
    pub(in crate::outputs) fn may_have_kinks(&self) -> bool {
        match self {
            #[cfg(feature = "polynomial")]
            Self::Between { law: Law::Polynomial { pieces, of_rate: false }, .. } => pieces.n > 1,
            #[cfg(feature = "tire")]
            Self::OnBody { law: BodyLaw::Tire(_), .. } => true,
            _ => false,
        }
    }

    /// Hands out the kinks of its law, in no order.
    pub(in crate::outputs) fn kinks(
        &self,
        supplies: &Supplies<'_, T>,
        mut take: impl FnMut(Kink<T>),
    ) {
        match self {
            #[cfg(feature = "polynomial")]
            Self::Between { law: Law::Polynomial { pieces, of_rate: false }, .. } => {
                polynomial::kinks(pieces.of(supplies.pieces), |place| {
                    take(Kink { place, height: T::ZERO, slope: T::ZERO });
                });
            }
            #[cfg(feature = "tire")]
            Self::OnBody { law: BodyLaw::Tire(tire), .. } => {
                kink::of_road(tire.road, supplies, take);
            }
            _ => {}
        }
    }

    /// How far from its place a kink may be passed [m]: on a slope, a wheel stands off its foot by less than its radius.
    pub(in crate::outputs) fn reach(&self) -> T {
        match self {
            #[cfg(feature = "tire")]
            Self::OnBody { law: BodyLaw::Tire(tire), .. } => tire.radius,
            _ => T::ZERO,
        }
    }

    /// Does it measure an angle [rad], not a length [m]?
    pub(in crate::outputs) fn is_angular(&self) -> bool {
        matches!(self, Self::Between { gauge: Gauge::Angle { .. }, .. })
    }

    /// What of it is watched, at a state. Cost: one length or angle, or one wheel's nearest point of the road.
    pub(in crate::outputs) fn reading(
        &self,
        state: &State<T>,
        supplies: &Supplies<'_, T>,
    ) -> Reading<T> {
        let mut reading = Reading::default();
        let Reading { gaps, place } = &mut reading;
        match self {
            #[cfg(feature = "bumper")]
            Self::Between { gauge, law: Law::Bumper { touch, .. }, .. } => {
                let [value, rate] = gauge.measure(state);
                gaps[0] = Gap { value: value - *touch, rate };
            }
            #[cfg(feature = "limit")]
            Self::Between { gauge, law: Law::Limit(limit), .. } => {
                let [value, rate] = gauge.measure(state);
                gaps[0] = Gap { value: value - limit.lower, rate };
                gaps[1] = Gap { value: limit.upper - value, rate: -rate };
            }
            #[cfg(feature = "polynomial")]
            Self::Between { gauge, law: Law::Polynomial { of_rate: false, .. }, .. } => {
                let [value, rate] = gauge.measure(state);
                place[0] = Gap { value, rate };
            }
            #[cfg(feature = "tire")]
            Self::OnBody { point, frame, axis, law: BodyLaw::Tire(tire), .. } => {
                let axis = frame.rotation(&state.q) * axis;
                let touch = tire.contact(&motion((point, frame), &axis, state), supplies);
                let [depth, rate] = touch.deflection;
                gaps[0] = Gap { value: -depth, rate };
                *place = [0, 1].map(|i| Gap { value: touch.place[i], rate: touch.speed[i] });
            }
            _ => {}
        }
        reading
    }
}

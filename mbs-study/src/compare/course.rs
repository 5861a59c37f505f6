//! Instants of a comparison, and the steps between them.

use super::ladder::Instants;
use mbs::inside::{Fixed, Stretch};
use mbs_core::Real;

/// Schedule of a run: the instants, and the steps between them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Course {
    pub(crate) instants: Instants,
    /// Number of steps between two instants, if their length is fixed.
    pub(crate) between: Option<u64>,
}

impl Course {
    /// Intervals from instant to instant, each with its fixed steps if there are any.
    pub(crate) fn stretches<T: Real>(&self) -> impl Iterator<Item = Stretch<T>> {
        let Self { instants, between } = *self;
        (0..instants.count).map(move |k| {
            let [from, to] = [k, k + 1].map(|k| instants.time(k));
            let fixed = between.map(|n| {
                let h = instants.interval / n as f64;
                Fixed { n, from: (T::from_f64(from), from), dt: (T::from_f64(h), h) }
            });
            let is_last = k + 1 == instants.count;
            Stretch { fixed, is_last, ..Stretch::to(T::from_f64(to)) }
        })
    }
}

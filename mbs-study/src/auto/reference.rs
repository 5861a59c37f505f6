//! Runs that are finer than is wanted: what the errors of all others are taken against.

use super::entrant::{Entrant, Try};
use super::law::Point;
use super::race::Race;

/// The reference is known to this share of the wanted error, and its run is made for that one.
const KNOWN: f64 = 0.1;
const AIM: f64 = 0.02;
/// So many are made at most, each in this share of the time that is left.
const MOST: u32 = 3;
const SHARE: f64 = 0.25;
/// No setting is finer than one for an error that is so many times smaller than any that was seen of the candidate.
const LEAP: f64 = 100.0;
/// A candidate that stopped nearby is expected to take so many times as long.
const DOUBT: f64 = 3.0;

impl Race<'_> {
    /// Makes a finer run than is wanted where the errors are not known well and one promises to be quick. Was there one?
    pub(super) fn refine_reference(&mut self) -> bool {
        let is_known = self.best.is_some_and(|best| best.own <= KNOWN * self.wanted.error);
        if is_known || self.refined >= MOST {
            return false;
        }
        let Some((i, point)) = self.finest() else {
            self.refined = MOST;
            return false;
        };
        if point.seconds > SHARE * self.left() {
            self.refined = MOST;
            return false;
        }
        self.refined += 1;
        self.attempt(i, point.setting, Some(DOUBT * point.seconds));
        self.judge();
        // a reference that is out of reach, or no better for rounding, says nothing against a coarser setting
        let entrant = &mut self.entrants[i];
        entrant.out = None;
        let errors: Vec<f64> = entrant.points().iter().rev().map(|p| p.error).collect();
        let is_worse = matches!(errors[..], [fine, coarse, ..] if fine >= coarse);
        let is_coarser = |t: &Try| t.setting > point.setting * (1.0 + 1e-9);
        entrant.tries.retain(|t| is_coarser(t) || (t.is_done() && !is_worse));
        true
    }

    /// Who is expected to make the reference in the least time, and with what.
    fn finest(&self) -> Option<(usize, Point)> {
        let wanted = AIM * self.wanted.error;
        let of = |(i, entrant): (usize, &Entrant)| {
            let last = entrant.tries.last().filter(|t| t.is_done() && t.error.is_some())?;
            let least = last.error?.min(f64::MAX) / LEAP;
            let point = entrant.predict(wanted.max(least))?.point;
            let setting = entrant.fit(point.setting).max(entrant.finest);
            let is_finer = setting < last.setting && !entrant.has_tried(setting);
            let is_hopeful = entrant.out.is_none() && !entrant.is_at_its_floor() && is_finer;
            is_hopeful.then_some((i, Point { setting, ..point }))
        };
        let known = self.entrants.iter().enumerate().filter_map(of);
        known.min_by(|a, b| a.1.seconds.total_cmp(&b.1.seconds))
    }
}

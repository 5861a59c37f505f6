//! How long a trial may take before it is given up.

use super::entrant::{Entrant, is_relative};
use super::race::{LOSING, MOST, Race, SHARE, is_cheap};
use super::trial::End;

/// A first look at a candidate takes this share of the time of the best; where there is none, this share of the fastest trial (more
/// where it is of high order, or in relative coordinates), or of what is left, so that each has one; the first of all, which promises
/// most, has more of it. What is left is shared out among all: in equal shares, times these, and at most half of it.
const LOOK: f64 = 0.25;
const GLANCE: f64 = 0.5;
const GLIMPSE: [f64; 2] = [3.6, 2.25];
/// What a stop leaves of it to who has not completed a trial.
const STOPPED: f64 = 0.6;
/// Natural coordinates take about the same steps as relative ones with the same rule, and longer for each in all but small scenes: so
/// much of the time of these tells, and as long as it promises no more than so many times that they are still in the race.
const KIN: [f64; 2] = [0.15, 2.0];

impl Race<'_> {
    /// How long the next trial of a candidate may take [s]: the first is a look.
    pub(super) fn patience(
        &mut self,
        i: usize,
        setting: f64,
        cheapest: Option<f64>,
    ) -> Option<f64> {
        let most = self.patience_alone(i, setting, cheapest);
        let kin = self.kin(i, setting);
        most.or(kin).map(|most| most.min(kin.unwrap_or(most)))
    }

    /// The same where nothing is to be learned from relative coordinates.
    fn patience_alone(&mut self, i: usize, setting: f64, cheapest: Option<f64>) -> Option<f64> {
        match (self.entrants[i].tries.is_empty(), cheapest) {
            (true, Some(seconds)) => Some(LOOK * seconds),
            (true, None) => {
                let entrant = &self.entrants[i];
                let is_high = is_cheap(entrant);
                let is_likely = is_high || is_relative(&entrant.method);
                let share = if is_likely { LOSING } else { GLANCE };
                let is_any_tried = self.entrants.iter().any(|e| !e.tries.is_empty());
                #[allow(clippy::cast_precision_loss, reason = "a small count")]
                let times = GLIMPSE[usize::from(is_any_tried)] / self.entrants.len() as f64;
                let glimpse = times.min(0.5) * self.left();
                let Some(fastest) = self.fastest(|_| true) else { return Some(glimpse) };
                // coarse steps of second order are soon done, and tell nothing of what a small error takes by others
                let alike = self.fastest(is_cheap).filter(|_| is_high);
                let alike = alike.map_or(0.0, |seconds| (share * seconds).min(glimpse));
                Some((share * fastest).max(alike))
            }
            // what is coarser has stopped, or is not known to be good
            (false, Some(seconds)) if self.entrants[i].done().next().is_none() => Some(seconds),
            (false, Some(seconds)) => Some(LOSING * seconds),
            (false, None) => {
                // what is likely to get to the end may do so
                let (left, entrant) = (self.left(), &self.entrants[i]);
                let law = entrant.law();
                let finer = entrant.tries.last().map_or(1.0, |last| {
                    let factor = (last.setting / setting).powf(law.error);
                    law.longer(entrant.held(last), factor)
                });
                let needs = entrant.whole_seconds()? * finer;
                let enough = if needs <= MOST * left { LOSING * needs } else { 0.0 };
                if entrant.done().next().is_some() {
                    return Some((SHARE * left).max(enough.min(MOST * left)));
                }
                // who was nowhere may take no longer than another did, and each stop makes that less
                let stops = entrant.tries.iter().filter(|t| matches!(t.trial.end, End::Stopped(_)));
                let most = SHARE * left * STOPPED.powi(i32::try_from(stops.count()).unwrap_or(0));
                let fastest = self.fastest(|_| true).filter(|_| !is_cheap(entrant));
                Some(fastest.map_or(most, |fastest| most.min(LOSING * fastest)))
            }
        }
    }

    /// What is enough for a candidate in natural coordinates that has not completed a trial, by the time of relative ones [s].
    fn kin(&self, i: usize, setting: f64) -> Option<f64> {
        let entrant = &self.entrants[i];
        if is_relative(&entrant.method) || entrant.done().next().is_some() {
            return None;
        }
        let is_kin = |e: &&Entrant| {
            is_relative(&e.method)
                && e.method.integrator == entrant.method.integrator
                && e.method.is_fixed() == entrant.method.is_fixed()
        };
        let whole = |e: &Entrant| {
            let last = e.tries.last()?.setting;
            Some(e.whole_seconds()? * (last / setting).powf(e.law().cost))
        };
        let theirs = self.entrants.iter().filter(is_kin).filter_map(whole).reduce(f64::min)?;
        let is_close = whole(entrant).is_some_and(|own| own <= KIN[1] * theirs);
        (!is_close).then_some(KIN[0] * theirs)
    }
}

//! Degradation ladder: after steps that overrun the time limit, effects are dropped one after the other. After steps in time they act
//! again.

/// Number of dropped effects (the rung), with its rules. The rung rises by one after consecutive overruns of the time limit. It falls by
/// one after consecutive steps in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DegradationLadder {
    /// Number of consecutive overruns after which an effect is dropped.
    pub patience: u32,
    /// Number of consecutive steps in time after which an effect acts again.
    pub recovery: u32,
    rung: u32,
    overruns: u32,
    in_time: u32,
}

impl Default for DegradationLadder {
    /// Returns a ladder that drops an effect after two consecutive overruns. An effect acts again after a thousand consecutive steps in
    /// time.
    fn default() -> Self {
        Self::new(2, 1000)
    }
}

impl DegradationLadder {
    /// Makes a ladder on its lowest rung, where all effects act. A `patience` or `recovery` of zero counts as one.
    #[must_use]
    pub const fn new(patience: u32, recovery: u32) -> Self {
        Self { patience, recovery, rung: 0, overruns: 0, in_time: 0 }
    }

    /// Returns the rung: the number of effects that are dropped.
    #[must_use]
    pub const fn rung(&self) -> u32 {
        self.rung
    }

    /// Counts a step with or without an overrun. The ladder has `n_rungs` rungs.
    pub fn note(&mut self, has_overrun: bool, n_rungs: u32) {
        if has_overrun {
            self.in_time = 0;
            self.overruns = self.overruns.saturating_add(1);
            if self.overruns >= self.patience.max(1) {
                self.overruns = 0;
                self.rung = self.rung.saturating_add(1).min(n_rungs);
            }
        } else {
            self.overruns = 0;
            self.in_time = self.in_time.saturating_add(1);
            if self.in_time >= self.recovery.max(1) {
                self.in_time = 0;
                self.rung = self.rung.saturating_sub(1);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::DegradationLadder;

    #[test]
    fn a_single_overrun_drops_nothing_and_two_in_a_row_climb_a_rung() {
        let mut ladder = DegradationLadder::new(2, 3);
        for has_overrun in [true, false, true, false] {
            ladder.note(has_overrun, 2);
            assert_eq!(ladder.rung(), 0);
        }
        for _ in 0..9 {
            ladder.note(true, 2);
        }
        assert_eq!(ladder.rung(), 2, "no higher than there are rungs");
    }

    #[test]
    fn steps_in_time_come_down_again_rung_by_rung() {
        let mut ladder = DegradationLadder::new(1, 3);
        ladder.note(true, 2);
        ladder.note(true, 2);
        let rungs = [2, 2, 1, 1, 1, 0, 0];
        for rung in rungs {
            ladder.note(false, 2);
            assert_eq!(ladder.rung(), rung);
        }
    }
}

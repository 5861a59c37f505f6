//! Degraded levels below the full scene, and the check that a running scene can change to these levels.

use super::error::PacingError;
use crate::record::Degraded;
use crate::run::{PacedLevel, PacedSchedule};
use crate::settings::ResolvedMethod;
use crate::simulation::Simulation;
use mbs_core::Real;
use mbs_core::formulation::SwitchError;
use mbs_core::scene::Scene;

/// Word that stands for a level with longer steps.
const STEPS: &str = "steps";

/// Run for which a ladder of levels is computed.
pub(super) struct Sought<'a, T> {
    pub(super) scene: &'a Scene<T>,
    pub(super) settings: &'a ResolvedMethod,
    pub(super) track: &'a PacedSchedule<T>,
}

impl<T: Real> Sought<'_, T> {
    /// Creates a level in which the number of steps per period is halved `halvings` times, and the effects `off` are omitted.
    pub(super) fn rung(&self, halvings: u32, off: Vec<usize>) -> PacedLevel {
        let without = off.iter().map(|&e| self.scene.effects[e].name.clone()).collect();
        let steps = self.track.steps.unwrap_or(1);
        let rung = PacedLevel { halvings, off, measured: Degraded::default() };
        let step_times = f64::from(steps) / f64::from(rung.steps(steps));
        PacedLevel { measured: Degraded { step_times, without, ..Degraded::default() }, ..rung }
    }

    /// True if steps are longer with `halvings` halvings than with one halving less; also true for zero.
    pub(super) fn lengthens(&self, halvings: u32) -> bool {
        let Some(steps) = self.track.steps else { return false };
        let of = |halvings| PacedLevel { halvings, ..PacedLevel::default() }.steps(steps);
        halvings == 0 || of(halvings) < of(halvings - 1)
    }

    /// Checks that the running scene can change from the full scene to this level and back.
    pub(super) fn changes<const D: usize>(&self, rung: &PacedLevel) -> Result<(), SwitchError> {
        if rung.off.is_empty() {
            return Ok(());
        }
        // If the full scene does not start, the run itself reports the error.
        let Ok(full) = Simulation::<T, D>::new(self.scene, self.settings) else { return Ok(()) };
        let less = Simulation::<T, D>::new(&rung.scene(self.scene), self.settings);
        less.map_err(|_| SwitchError::Coordinates)?.takes_over(&full)
    }
}

/// Levels that a user lists, preceded by the full scene.
pub(super) fn listed<T: Real, const D: usize>(
    sought: &Sought<'_, T>,
    words: &[String],
) -> Result<Vec<PacedLevel>, PacingError> {
    let effects = &sought.scene.effects;
    let mut rungs = vec![sought.rung(0, Vec::new())];
    let (mut halvings, mut off) = (0, Vec::new());
    for word in words.iter().map(|word| word.trim()) {
        let is_it = |e: &mbs_core::scene::Effect<T>| e.enabled && e.name == word;
        match effects.iter().position(is_it) {
            Some(effect) if !off.contains(&effect) => off.push(effect),
            Some(_) => continue,
            None if word == STEPS => {
                halvings += 1;
                if !sought.lengthens(halvings) {
                    let is_controlled = sought.track.steps.is_none();
                    return Err(PacingError::Steps { is_controlled });
                }
            }
            None => {
                let known = effects.iter().filter(|e| e.enabled).map(|e| e.name.clone());
                let mut known: Vec<String> = known.collect();
                known.push(STEPS.to_owned());
                return Err(PacingError::NoEffect { name: word.to_owned(), known });
            }
        }
        let rung = sought.rung(halvings, off.clone());
        let fixed = |why| PacingError::Fixed { name: word.to_owned(), why };
        sought.changes::<D>(&rung).map_err(fixed)?;
        rungs.push(rung);
    }
    Ok(rungs)
}

//! Bodies that roll and would lift off: a contact that holds both ways pulls then, which a run notes.

use crate::checkpoint::tape::{Tape, Walked};
use crate::simulation::Simulation;
use mbs_core::Real;
use mbs_core::natural::NaturalModel;
use mbs_core::outputs::Reactions;
use mbs_core::scene::Scene;
use mbs_scene::format::{few, significant};

/// Pull that is noted, relative to the largest force of the contact so far [-]: more than steps leave of a force.
const NOTED_PULL: f64 = 1e-6;
/// Acceleration of all masses below whose force a contact is at rest [m/s^2]: rounding of a scene without gravity.
const AT_REST: f64 = 1e-9;

/// A contact that holds both ways.
#[derive(Debug, Clone)]
struct Held {
    rolling: usize,
    /// When it pulled first [s].
    first: Option<f64>,
    /// Largest pull, and largest push or pull [N].
    most: f64,
    largest: f64,
}

/// Watches the contacts of a run that roll.
#[derive(Debug, Clone)]
pub(crate) struct PullWatch<T: Real, const D: usize> {
    all: Vec<Held>,
    /// `None`: there are none, or more forces than reactions are made for.
    reactions: Option<Reactions<T, D>>,
    /// Force below which a contact is at rest [N].
    rest: f64,
}

impl<T: Real, const D: usize> PullWatch<T, D> {
    /// Prepares the contacts of a scene; without any, nothing is ever measured.
    pub(crate) fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Self {
        let held = scene.rollings.iter().enumerate();
        let held = held.filter(|(_, rolling)| rolling.kind.radius().is_some());
        let all: Vec<_> = held
            .map(|(rolling, _)| Held { rolling, first: None, most: 0.0, largest: 0.0 })
            .collect();
        let reactions = if all.is_empty() { None } else { Reactions::new(scene, model).ok() };
        let mass: f64 = scene.bodies.iter().map(|body| body.mass.to_f64()).sum();
        Self { all, reactions, rest: mass * AT_REST }
    }

    /// Takes a state: that of the start, and that at the end of each step.
    ///
    /// Cost: without contacts a comparison; with them all reactions. No allocation.
    pub(crate) fn watch(&mut self, simulation: &Simulation<T, D>) {
        let Self { all, reactions: Some(reactions), rest } = self else { return };
        let state = simulation.state();
        reactions.update(state);
        for held in all {
            let pull = -reactions.rolling_push(held.rolling).to_f64();
            held.largest = held.largest.max(pull.abs());
            if pull > (NOTED_PULL * held.largest).max(*rest) {
                held.first.get_or_insert(state.t.to_f64());
                held.most = held.most.max(pull);
            }
        }
    }

    /// Writes what is remembered, or reads it back; nothing where nothing rolls.
    pub(crate) fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        self.all.iter_mut().try_for_each(|held| {
            tape.option(&mut held.first, Tape::float)?;
            tape.float(&mut held.most)?;
            tape.float(&mut held.largest)
        })
    }

    /// What a run notes: each contact once, with the first time and its largest pull.
    pub(crate) fn notes(&self, scene: &Scene<T>) -> Vec<String> {
        let note = |held: &Held| {
            let (t, most) = (significant(held.first?), few(held.most));
            let name = &scene.rollings[held.rolling].name;
            Some(format!(
                "`{name}` pulls on its plane at t = {t} s, by up to {most} N: what may lift off is a `tire`"
            ))
        };
        self.all.iter().filter_map(note).collect()
    }
}

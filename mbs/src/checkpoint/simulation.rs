//! What a simulation steps on from.

use super::history::Parts;
use super::tape::{Tape, Told, holds};
use super::{Checkpoint, CheckpointError, Identity, Kind, whole};
use crate::settings::Settings;
use crate::simulation::Simulation;
use mbs_core::Real;
use mbs_core::control::{DriverHistory, Invariant};
use mbs_core::history::History;
use mbs_core::inputs::Prescribed;
use mbs_core::model::State;
use mbs_core::outputs::EventHistory;
use mbs_core::scene::Scene;
use std::io::{Read, Write};

/// All of it, as plain data.
#[derive(Debug, Clone)]
pub(crate) struct Kept<T> {
    pub(crate) state: State<T>,
    pub(crate) formulation: History<T>,
    pub(crate) control: Option<ControlKept<T>>,
    pub(crate) invariant: [f64; Invariant::N_HISTORY],
    /// What is set from outside: courses and guides.
    pub(crate) inputs: [Vec<(usize, [T; 3])>; 2],
}

/// What the control of the step length remembers.
#[derive(Debug, Clone)]
pub(crate) struct ControlKept<T> {
    pub(crate) driver: DriverHistory<T>,
    pub(crate) events: Option<EventHistory<T>>,
}

impl<T: Real> Kept<T> {
    /// Writes it, or reads it back in the same shape.
    pub(crate) fn walk(&mut self, tape: &mut impl Tape) -> Told {
        let Self { state, formulation, control, invariant, inputs } = self;
        tape.state(state)?;
        tape.history(&mut formulation.entries)?;
        let mut is_controlled = control.is_some();
        tape.flag(&mut is_controlled)?;
        holds(is_controlled == control.is_some())?;
        control.as_mut().map_or(Ok(()), |control| control.walk(tape))?;
        tape.floats(invariant)?;
        inputs.iter_mut().try_for_each(|inputs| {
            tape.places(inputs, |tape, (i, value)| {
                let is = *i;
                tape.index(i, usize::MAX)?;
                holds(*i == is)?;
                tape.reals(value)
            })
        })
    }
}

impl<T: Real> ControlKept<T> {
    fn walk(&mut self, tape: &mut impl Tape) -> Told {
        let DriverHistory { next, energy, error, stretch } = &mut self.driver;
        tape.real(next)?;
        tape.option(energy, |tape, (memory, small)| {
            tape.float(memory)?;
            tape.small(small)
        })?;
        tape.option(error, Parts::errors)?;
        tape.option(stretch, |tape, (from, trials)| {
            tape.real(from)?;
            tape.small(trials)
        })?;
        let Some(EventHistory { t, trials, begin }) = &mut self.events else { return Ok(()) };
        tape.real(t)?;
        tape.small(trials)?;
        tape.places(begin, |tape, numbers| tape.reals(numbers))
    }
}

/// The inputs as they are set in a state: of effects, and of guides.
pub(crate) fn inputs<T: Real>(
    prescribed: &Prescribed<T>,
    inputs: &[T],
) -> [Vec<(usize, [T; 3])>; 2] {
    let mut values = inputs.as_chunks().0.iter();
    let guides = prescribed.guide_inputs().zip(values.by_ref());
    let guides = guides.map(|((guide, _), motion)| (guide, *motion)).collect();
    let effects = prescribed.effect_inputs().zip(values);
    [effects.map(|((effect, _), value)| (effect, *value)).collect(), guides]
}

impl<T: Real, const D: usize> Simulation<T, D> {
    /// Writes a checkpoint of the simulation, which was made of this scene and these settings: all that the next steps depend
    /// on, so that they have the same bits after [`restore`](Self::restore), inputs that were set among it.
    ///
    /// Cost: the bytes are gathered in memory, about eight times as many as coordinates and multipliers have places, times eight.
    ///
    /// # Errors
    /// Those of the sink.
    ///
    /// # Examples
    /// ```
    /// use mbs::{Method, Settings, scene_file::SceneFile};
    /// use mbs::typed::Simulation;
    /// # let text = r#"
    /// # [scene]
    /// # dimension = 2
    /// # duration = 1.0
    /// # gravity = [0.0, -9.81]
    /// # [[body]]
    /// # name = "bob"
    /// # mass = 1.0
    /// # center = [1.0, 0.0]
    /// # inertia = 0.0
    /// # [[joint]]
    /// # name = "pivot"
    /// # kind = "revolute"
    /// # bodies = ["ground", "bob"]
    /// # at = [0.0, 0.0]
    /// # "#;
    /// let scene = SceneFile::parse(text, "pendulum.toml")?.scene::<f64>()?;
    /// let settings = Settings::new(&scene, &Method::default())?;
    /// let mut first = Simulation::<f64, 2>::new(&scene, &settings)?;
    /// first.step(1e-3)?;
    /// let mut bytes = Vec::new();
    /// first.save((&scene, &settings), &mut bytes)?;
    /// first.step(1e-3)?;
    ///
    /// let mut second = Simulation::<f64, 2>::new(&scene, &settings)?;
    /// second.restore((&scene, &settings), &bytes[..])?;
    /// second.step(1e-3)?;
    /// assert_eq!(first.state(), second.state());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn save(
        &self,
        (scene, settings): (&Scene<T>, &Settings),
        mut sink: impl Write,
    ) -> Result<(), CheckpointError> {
        let (identity, t) = (Identity::new(scene, settings), self.state().t.to_f64());
        let mut kept = self.kept();
        let bytes = whole(&identity, (Kind::Simulation, [t, 0.0]), |pen| kept.walk(pen))?;
        Ok(sink.write_all(&bytes)?)
    }

    /// Restores a checkpoint of the same scene and settings: one of [`save`](Self::save), or the state in that of a run.
    ///
    /// # Errors
    /// [`CheckpointError`]; the simulation is then as it was, but that a state-space one may choose its coordinates anew.
    pub fn restore(
        &mut self,
        (scene, settings): (&Scene<T>, &Settings),
        source: impl Read,
    ) -> Result<(), CheckpointError> {
        let checkpoint = Checkpoint::read(source)?;
        checkpoint.check(&Identity::new(scene, settings))?;
        self.restore_from(&mut checkpoint.body())
    }

    /// Restores the state at which a tape is.
    pub(crate) fn restore_from(&mut self, tape: &mut impl Tape) -> Told {
        let before = self.kept();
        let mut kept = before.clone();
        kept.walk(tape)?;
        if self.go_on(&kept) {
            return Ok(());
        }
        let _ = self.go_on(&before);
        holds(false)
    }
}

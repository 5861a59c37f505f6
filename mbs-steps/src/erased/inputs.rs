//! Inputs of a mechanism: named values that are set between steps.

use super::failure::SimulationError;
use mbs_core::inputs::Prescribed;
use mbs_core::scene::{
    Coupling, CouplingId, Dimension, EffectId, EffectKind, Freedom, GuideId, Motion, Scene, Signal,
    SignalId, SignalKind,
};
use mbs_core::step::InputError;
use std::sync::Arc;

/// Index of an input in the list `Simulation::inputs`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct InputId(usize);

impl InputId {
    /// Makes the identifier of the input at an index of the list.
    #[must_use]
    pub fn new(index: usize) -> Self {
        Self(index)
    }

    /// Returns the index of the input in the list.
    #[must_use]
    pub fn index(self) -> usize {
        self.0
    }
}

/// Receiver of input values: a simulation, or a run before one of its steps.
pub trait Sink {
    fn set_effect_input(&mut self, effect: usize, value: [f64; 3]) -> Result<(), InputError>;
    fn set_guide_input(&mut self, guide: usize, motion: [f64; 3]) -> Result<(), InputError>;
    fn set_signal_input(&mut self, signal: usize, value: f64) -> Result<(), InputError>;
}

/// Part that an input belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum InputOwner {
    /// The signal of an effect.
    Effect(EffectId),
    /// The prescribed motion of a guide.
    Guide(GuideId),
    /// The prescribed value of a coupling's weighted sum of coordinates.
    Coupling {
        /// Coupling whose sum is prescribed.
        coupling: CouplingId,
        /// Index of the sum among the prescribed motions, which are the guides of the scene and then the sums of couplings.
        sum: GuideId,
    },
    /// A signal of the scene.
    Signal(SignalId),
}

/// Input of a simulation: its name, unit, owner and initial value.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct InputInfo {
    /// Name of the input. For an effect it is `NAME`, or `NAME.x` (`.y`, `.z`) for a component of a vector. For a guide it is `JOINT`,
    /// `JOINT.rate` or `JOINT.acceleration`. For a coupling it is its name, alone or with the same suffixes. For a signal it is `NAME`.
    pub name: String,
    /// Unit of the input; empty for the input of a user-defined law.
    pub unit: String,
    /// Part that the input belongs to.
    pub owner: InputOwner,
    /// Index of the input among the values of its owner.
    pub component: usize,
    /// Value of the input at the start.
    pub start: f64,
}

/// The inputs of a simulation with their current values.
#[derive(Debug, Clone)]
pub struct Inputs {
    list: Arc<[InputInfo]>,
    values: Vec<f64>,
}

impl Inputs {
    pub fn new(scene: &Scene<f64>) -> Self {
        let mut list = Vec::new();
        for (e, effect) in scene.effects.iter().enumerate().filter(|(_, effect)| effect.enabled) {
            let Some((Signal::Input(start), n, unit)) = signal(&effect.kind, scene.dimension)
            else {
                continue;
            };
            for (component, &start) in start.iter().enumerate().take(n) {
                let name = match n {
                    1 => effect.name.clone(),
                    _ => format!("{}.{}", effect.name, ["x", "y", "z"][component]),
                };
                let owner = InputOwner::Effect(EffectId::new(e));
                list.push(InputInfo { name, unit: unit.to_owned(), owner, component, start });
            }
        }
        let mut motion =
            |name: &str, owner: InputOwner, units: [&'static str; 3], start: [f64; 3]| {
                for (component, suffix) in ["", ".rate", ".acceleration"].into_iter().enumerate() {
                    let (name, unit) = (format!("{name}{suffix}"), units[component].to_owned());
                    let start = start[component];
                    list.push(InputInfo { name, unit, owner, component, start });
                }
            };
        for (g, guide) in scene.guides.iter().enumerate() {
            let Motion::Input(start) = guide.law else { continue };
            let joint = &scene.joints[guide.joint.index()];
            let (kind, number) = (joint.kind, guide.number);
            let is_slide = matches!(kind.freedom(scene.dimension, number), Some(Freedom::Slide(_)));
            let units = if is_slide { ["m", "m/s", "m/s^2"] } else { ["rad", "rad/s", "rad/s^2"] };
            let coordinate = kind.coordinate_name(scene.dimension, number);
            let coordinate = coordinate.map_or_else(|| number.to_string(), str::to_owned);
            let name = match kind.single(scene.dimension) {
                Some(_) => joint.name.clone(),
                None => format!("{}.{coordinate}", joint.name),
            };
            motion(&name, InputOwner::Guide(GuideId::new(g)), units, start);
        }
        let has_sum = |(_, coupling): &(usize, &Coupling<f64>)| coupling.has_sum();
        let with_sum = scene.couplings.iter().enumerate().filter(has_sum);
        for (sum, (c, coupling)) in (scene.guides.len()..).zip(with_sum) {
            let Some(Motion::Input(start)) = coupling.motion else { continue };
            let (coupling, sum, name) = (CouplingId::new(c), GuideId::new(sum), &coupling.name);
            motion(name, InputOwner::Coupling { coupling, sum }, [""; 3], start);
        }
        for (s, signal) in scene.signals.iter().enumerate() {
            let SignalKind::Input { value: start, unit } = &signal.kind else { continue };
            let owner = InputOwner::Signal(SignalId::new(s));
            let (name, unit, start) = (signal.name.clone(), unit.clone(), *start);
            list.push(InputInfo { name, unit, owner, component: 0, start });
        }
        let values = list.iter().map(|input| input.start).collect();
        Self { list: list.into(), values }
    }

    pub fn list(&self) -> &[InputInfo] {
        &self.list
    }

    /// Returns for each input its index in the vector of inputs of a state.
    pub fn places(&self, prescribed: &Prescribed<f64>) -> Vec<usize> {
        let place = |info: &InputInfo| {
            let first = match info.owner {
                InputOwner::Effect(effect) => prescribed.input(effect.index()).map(|at| at.start),
                InputOwner::Guide(guide) | InputOwner::Coupling { sum: guide, .. } => {
                    prescribed.guide_input(guide.index()).map(|at| at.start)
                }
                InputOwner::Signal(signal) => prescribed.signal_input(signal.index()),
            };
            // The list was made from the same scene, so every owner has inputs.
            first.unwrap_or_default() + info.component
        };
        self.list.iter().map(place).collect()
    }

    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The first input of an effect.
    pub fn of_effect(&self, effect: EffectId) -> Result<InputId, SimulationError> {
        let place = self.list.iter().position(|input| input.owner == InputOwner::Effect(effect));
        place.map(InputId).ok_or_else(|| {
            let message = format!("effect {} has no input", effect.index() + 1);
            SimulationError::new(
                "input-refused",
                message,
                "give it a signal of kind input, and enable it",
            )
        })
    }

    pub fn set(
        &mut self,
        inner: &mut (impl Sink + ?Sized),
        input: InputId,
        value: f64,
    ) -> Result<(), SimulationError> {
        let Some(info) = self.list.get(input.0) else { return Err(self.missing(input.0 + 1)) };
        finite(info, value)?;
        let before = core::mem::replace(&mut self.values[input.0], value);
        let set = self.write(inner, info.owner);
        if set.is_err() {
            self.values[input.0] = before;
        }
        set
    }

    pub fn set_all(
        &mut self,
        inner: &mut (impl Sink + ?Sized),
        all: &[f64],
    ) -> Result<(), SimulationError> {
        self.check(all)?;
        self.list.iter().zip(all).try_for_each(|(info, value)| finite(info, *value))?;
        let before = core::mem::replace(&mut self.values, all.to_vec());
        let set = self.renew(inner);
        if set.is_err() {
            self.values = before;
            self.renew(inner)?;
        }
        set
    }

    pub fn set_guide(
        &mut self,
        inner: &mut (impl Sink + ?Sized),
        guide: GuideId,
        motion: [f64; 3],
    ) -> Result<(), SimulationError> {
        let own = self.list.iter().filter(|input| input.owner == InputOwner::Guide(guide));
        if own.clone().next().is_none() {
            let message = format!("guide {} has no input", guide.index() + 1);
            let hint = "give it a motion of kind input";
            return Err(SimulationError::new("input-refused", message, hint));
        }
        own.zip(motion).try_for_each(|(info, value)| finite(info, value))?;
        inner.set_guide_input(guide.index(), motion)?;
        for (value, info) in self.values.iter_mut().zip(&*self.list) {
            if info.owner == InputOwner::Guide(guide) {
                *value = motion[info.component];
            }
        }
        Ok(())
    }

    /// Checks that the number of values equals the number of inputs. Another simulation of the same mechanism has the same number.
    pub fn check(&self, values: &[f64]) -> Result<(), SimulationError> {
        if values.len() == self.values.len() { Ok(()) } else { Err(self.missing(values.len())) }
    }

    /// Sets the values of a restored state.
    pub fn restore(&mut self, values: &[f64]) {
        self.values.copy_from_slice(values);
    }

    /// Sets all inputs to their initial values.
    pub fn reset(&mut self) {
        self.values = self.list.iter().map(|input| input.start).collect();
    }

    /// Writes all current values into a restarted simulation.
    pub fn renew(&mut self, inner: &mut (impl Sink + ?Sized)) -> Result<(), SimulationError> {
        let list = self.list.clone();
        let firsts = list.iter().filter(|input| input.component == 0);
        firsts.into_iter().try_for_each(|input| self.write(inner, input.owner))
    }

    fn write(
        &self,
        inner: &mut (impl Sink + ?Sized),
        owner: InputOwner,
    ) -> Result<(), SimulationError> {
        let mut numbers = [0.0; 3];
        for (value, info) in self.values.iter().zip(&*self.list).filter(|(_, i)| i.owner == owner) {
            numbers[info.component] = *value;
        }
        match owner {
            InputOwner::Effect(effect) => inner.set_effect_input(effect.index(), numbers)?,
            InputOwner::Guide(guide) | InputOwner::Coupling { sum: guide, .. } => {
                inner.set_guide_input(guide.index(), numbers)?;
            }
            InputOwner::Signal(signal) => inner.set_signal_input(signal.index(), numbers[0])?,
        }
        Ok(())
    }

    fn missing(&self, found: usize) -> SimulationError {
        let message = format!("input {found} of a mechanism with {} inputs", self.list.len());
        SimulationError::new(
            "input-refused",
            message,
            "`inputs()` lists them with their names and units",
        )
    }
}

fn finite(input: &InputInfo, value: f64) -> Result<(), SimulationError> {
    if value.is_finite() {
        return Ok(());
    }
    let message = format!("input `{}` would be {value}", input.name);
    Err(SimulationError::new("input-refused", message, "give a finite number"))
}

/// Returns the signal of an effect, the number of its components, and their unit.
fn signal(
    kind: &EffectKind<f64>,
    dimension: Dimension,
) -> Option<(Signal<f64>, usize, &'static str)> {
    let (signal, form, unit) = kind.signal()?;
    Some((signal, form.n_components(dimension), unit))
}

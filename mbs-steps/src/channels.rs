//! Channels that a run evaluates: measures, and the reactions and effects that outputs request.

use crate::checkpoint::tape::{Tape, Walked, holds};
use crate::simulation::Simulation;
use crate::stop::StopError;
use mbs_core::model::State;
use mbs_core::natural::{NaturalModel, RememberedAngle};
use mbs_core::once::find;
use mbs_core::outputs::{Forces, Measures, Target};
use mbs_core::scene::{Output, Scene};
use mbs_core::{Real, instances};

/// Measures of a scene's outputs, and the tables from which forces are computed.
#[derive(Debug, Clone)]
pub struct Channels<T: Real, const D: usize> {
    measures: Measures<T, D>,
    forces: Option<Forces<T, D>>,
    /// Joint coordinates of the first state, with full turns counted.
    remembered: Vec<RememberedAngle<T>>,
    /// Indices of parts whose requested reaction, effort or force was not unique in some row. Joints are counted first, then couplings,
    /// then rolling contacts.
    not_unique: Vec<usize>,
    asked: Vec<usize>,
    /// Number of joints, and number of joints plus couplings.
    ends: [usize; 2],
    /// End index of the components of each output.
    outputs: Vec<usize>,
    write_at: Write<T, D>,
    track: Track<T, D>,
}

type New<T, const D: usize> =
    fn(&[Output<T>], &Scene<T>, &NaturalModel<T, D>) -> Result<Channels<T, D>, StopError>;
type Track<T, const D: usize> = fn(&mut Channels<T, D>, &Simulation<T, D>) -> Result<(), StopError>;
type Write<T, const D: usize> =
    fn(&mut Channels<T, D>, &State<T>, &mut [T]) -> Result<(), StopError>;
instances!(NEW: New<T, D> = Channels::<T, D>::new_here);

impl<T: Real, const D: usize> Channels<T, D> {
    /// Creates the channels of a scene.
    ///
    /// # Errors
    /// [`StopError`] for an output that cannot be measured.
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Result<Self, StopError> {
        Self::of_outputs(&scene.channels(), scene, model)
    }

    /// Creates channels of the given outputs instead of the scene's outputs.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn of_outputs(
        outputs: &[Output<T>],
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
    ) -> Result<Self, StopError> {
        find::<New<T, D>>(NEW).ok_or(StopError::NotBuilt)?(outputs, scene, model)
    }

    fn new_here(
        outputs: &[Output<T>],
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
    ) -> Result<Self, StopError> {
        let measures = Measures::of_outputs(outputs, scene, model);
        let measures = measures.map_err(|e| StopError::Start(e.into()))?;
        let forces = Forces::of_outputs(outputs, scene, model).map_err(StopError::Reaction)?;
        let asked = outputs.iter().filter(|o| o.quantity.row().needs_reactions);
        let n_joints = scene.joints.len();
        let n_both = n_joints + scene.couplings.len();
        let asked: Vec<usize> = asked
            .filter_map(|o| match o.quantity.target() {
                Target::Joint(joint) => Some(joint.index()),
                Target::Coupling(coupling) => Some(n_joints + coupling.index()),
                Target::Rolling(rolling) => Some(n_both + rolling.index()),
                _ => None,
            })
            .collect();
        let outputs = measures.lengths().scan(0, |end, length| {
            *end += length;
            Some(*end)
        });
        let outputs = outputs.collect();
        let not_unique = Vec::with_capacity(asked.len());
        let forces = Some(forces);
        let ends = [n_joints, n_both];
        let (write_at, track): (Write<T, D>, Track<T, D>) = (Self::write_here, Self::track_here);
        let remembered = model.remembered_coordinates(scene);
        Ok(Self { measures, forces, remembered, not_unique, asked, ends, outputs, write_at, track })
    }

    /// Exchanges the tables from which forces are computed, because a scene with other effects needs other tables.
    pub fn exchange(&mut self, forces: &mut Option<Forces<T, D>>) {
        core::mem::swap(&mut self.forces, forces);
    }

    /// Writes the stored values of the channels to a checkpoint, or reads them from one.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        tape.reals(self.measures.memory_mut())?;
        let asked = &self.asked;
        tape.list(&mut self.not_unique, 8, |tape, joint| {
            tape.index(joint, usize::MAX)?;
            holds(asked.contains(joint))
        })
    }

    /// Updates the tracked angles after a step, so that full turns are counted.
    ///
    /// # Errors
    /// [`StopError::Step`] with the joint whose number of turns is ambiguous.
    pub fn track(&mut self, simulation: &Simulation<T, D>) -> Result<(), StopError> {
        (self.track)(self, simulation)
    }

    fn track_here(&mut self, simulation: &Simulation<T, D>) -> Result<(), StopError> {
        let state = simulation.state();
        if simulation.has_own_coordinates() {
            self.measures.track_with(state, |joint, number| simulation.coordinate(joint, number));
            return Ok(());
        }
        if !self.measures.has_begun() {
            self.begin(state);
            return Ok(());
        }
        self.measures.track(state).map_err(|error| simulation.explain(error))
    }

    /// Sets the initial number of turns of each angle from the assembly, because a search for an equilibrium may turn a joint more than
    /// once.
    fn begin(&mut self, state: &State<T>) {
        let Self { measures, remembered, .. } = self;
        measures.track_with(state, |joint, number| {
            let angle = remembered.iter().find(|angle| angle.of == (joint, number))?;
            Some(angle.sign * *state.memory.get(angle.place)?)
        });
    }

    /// Writes the components of all channels at the state of a simulation.
    ///
    /// # Errors
    /// As for [`write_at`](Self::write_at).
    pub fn write(&mut self, now: &Simulation<T, D>, out: &mut [T]) -> Result<(), StopError> {
        self.measures.set_invariant_error(T::from_f64(now.invariant().error()));
        if !self.measures.has_begun() {
            self.track(now)?;
        }
        self.write_at(now.state(), out)
    }

    /// Writes the components of all channels at a state that belongs to no simulation.
    ///
    /// # Errors
    /// [`StopError::Output`] for an output that is not finite, such as an overflowing acceleration of a point.
    pub fn write_at(&mut self, state: &State<T>, out: &mut [T]) -> Result<(), StopError> {
        (self.write_at)(self, state, out)
    }

    fn write_here(&mut self, state: &State<T>, out: &mut [T]) -> Result<(), StopError> {
        self.forces.iter_mut().for_each(|forces| forces.update(state));
        if let Some(reactions) = self.forces.as_ref().and_then(Forces::reactions) {
            for &asked in &self.asked {
                let [n_joints, n_both] = self.ends;
                let is_unique = match asked {
                    joint if joint < n_joints => reactions.is_unique(joint),
                    coupling if coupling < n_both => {
                        reactions.is_effort_unique(coupling - n_joints)
                    }
                    rolling => reactions.is_rolling_unique(rolling - n_both),
                };
                if !is_unique && !self.not_unique.contains(&asked) {
                    self.not_unique.push(asked);
                }
            }
        }
        if !self.measures.has_begun() {
            self.begin(state);
        }
        // The angles of this state are tracked already, so their turns are known and no error can occur.
        let _ = self.measures.write(state, self.forces.as_ref(), out);
        let Some(bad) = out.iter().position(|x| !x.to_f64().is_finite()) else { return Ok(()) };
        Err(StopError::Output { output: self.outputs.partition_point(|end| *end <= bad) })
    }

    /// Number of components of each channel.
    pub fn lengths(&self) -> impl Iterator<Item = usize> + '_ {
        self.measures.lengths()
    }

    /// Names of the joints, couplings and rolling contacts whose reaction, effort or force was not unique.
    pub fn not_unique(&self, scene: &Scene<T>) -> Vec<String> {
        let [n_joints, n_both] = self.ends;
        let name = |&i: &usize| match i {
            joint if joint < n_joints => scene.joints[joint].name.clone(),
            coupling if coupling < n_both => scene.couplings[coupling - n_joints].name.clone(),
            rolling => scene.rollings[rolling - n_both].name.clone(),
        };
        self.not_unique.iter().map(name).collect()
    }
}

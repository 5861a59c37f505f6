//! Implementation of the common formulation trait by [`Tree`]. The state of a tree is also written in natural coordinates, because the
//! outputs read natural coordinates.

use crate::build::TreeModel;
use crate::host::history::History as OfWorkspace;
use crate::host::state::{TreeState, Workspace};
use crate::host::step::TreeMethod;
use crate::link::options::Options;
use crate::space::Space;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::actions::{Action, Actions};
use mbs_core::formulation::{Describe, Formulation, SwitchError, Trials};
use mbs_core::history::{Book, History, RestoreError, Restored};
use mbs_core::laws::code::Codes;
use mbs_core::model::{Model, Owner, State, Terms};
use mbs_core::natural::NaturalModel;
use mbs_core::ode::{AdaptiveHistory, RadauHistory};
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{BodyId, Scene};
use mbs_core::step::{OptionError, Step, StepError, StepReport};

/// An angle that the tree stores with its whole turns.
#[derive(Debug, Clone, Copy)]
enum Angle {
    /// Coordinate of a link.
    Of(u32),
    /// Coordinate of a link, with opposite sign.
    Against(u32),
    /// Angle of the second body relative to the first, in the plane.
    Between([BodyId; 2]),
}

/// Finds the angles of effects and couplings that the tree stores: the angles of joints that are not cut, and all angles in the plane. Each
/// angle has its index in the memory of the natural state.
fn angles<T: Real, const D: usize>(
    scene: &Scene<T>,
    natural: &NaturalModel<T, D>,
    coordinates: &[Vec<Option<u32>>],
) -> Vec<(usize, Angle)> {
    // The actions are valid, because the tree of this scene was made from them.
    let list = Actions::new(scene).map(|actions| actions.list).unwrap_or_default();
    let angle = |(effect, action): &(usize, Action<T>)| {
        let angle = match action {
            Action::Angle { joint, number, .. } => Angle::Of(coordinates[*joint][*number]?),
            Action::Turn { bodies, .. } => Angle::Between(*bodies),
            Action::Torque { body, .. } if D == 2 => {
                Angle::Between([BodyId::Ground, BodyId::Body(*body)])
            }
            _ => return None,
        };
        Some((natural.memory_of_effect(*effect)?, angle))
    };
    let coupled = natural.coupled_angles().filter_map(|((joint, number), sign, place)| {
        let link = coordinates[joint][number]?;
        Some((place, if sign > T::ZERO { Angle::Of(link) } else { Angle::Against(link) }))
    });
    list.iter().filter_map(angle).chain(coupled).collect()
}

/// A scene in relative coordinates: the tree and its state.
#[derive(Debug, Clone)]
pub struct Tree<T: Real, S: Space<T>> {
    model: TreeModel<T, S>,
    state: TreeState<T>,
    saved: TreeState<T>,
    workspace: Workspace<T, S>,
    options: Options<T>,
    method: TreeMethod,
    motions: Vec<RigidMotion<T>>,
    terms: Terms<T>,
    /// Link of each coordinate of each joint; `None` for a coordinate without a link.
    coordinates: Vec<Vec<Option<u32>>>,
    /// Angles that the tree stores, each with its index in the memory of the natural state.
    angles: Vec<(usize, Angle)>,
    rank: usize,
    energies: [f64; 2],
    saved_energies: [f64; 2],
}

impl<T: Real, S: Space<T>> Tree<T, S> {
    /// Makes a tree that starts at `start`. The natural `state` of the same scene is overwritten with the tree's state.
    ///
    /// # Errors
    /// [`OptionError`] for an option out of range.
    pub fn new<const D: usize>(
        scene: &Scene<T>,
        (model, start): (TreeModel<T, S>, TreeState<T>),
        (options, method): (Options<T>, TreeMethod),
        (natural, state): (&NaturalModel<T, D>, &mut State<T>),
    ) -> Result<Self, OptionError> {
        options.validate()?;
        let mut workspace = Workspace::new(&model);
        let rank = model.rank(&start, &mut workspace).unwrap_or_else(|_| model.n_rows());
        let motions = (0..scene.bodies.len()).map(|b| natural.motion(scene, b, state)).collect();
        let coordinates = model.coordinate_links(scene);
        let mut tree = Self {
            angles: angles(scene, natural, &coordinates),
            coordinates,
            saved: start.clone(),
            state: start,
            workspace,
            options,
            method,
            motions,
            terms: natural.terms(),
            rank,
            energies: [0.0; 2],
            saved_energies: [0.0; 2],
            model,
        };
        tree.write(natural, state);
        Ok(tree)
    }

    /// Sets the options of all later steps.
    ///
    /// # Errors
    /// [`OptionError`] for an option out of range; the options are then unchanged.
    pub fn set_options(&mut self, options: Options<T>) -> Result<(), OptionError> {
        options.validate()?;
        self.options = options;
        Ok(())
    }

    /// Writes the tree's state in natural coordinates.
    fn write<const D: usize>(&mut self, natural: &NaturalModel<T, D>, state: &mut State<T>) {
        self.model.write_motions(&self.state, &mut self.workspace, &mut self.motions);
        state.t = self.state.t;
        state.work = self.state.work;
        state.power = self.state.power;
        state.applied.copy_from_slice(&self.state.applied);
        state.signals.copy_from_slice(&self.state.signals);
        for &(place, angle) in &self.angles {
            state.memory[place] = match angle {
                Angle::Of(link) => self.model.coordinate(&self.state, link),
                Angle::Against(link) => -self.model.coordinate(&self.state, link),
                Angle::Between(bodies) => self.model.turn_between(&self.state, bodies),
            };
        }
        natural.take_motions(&self.motions, &mut self.terms, state);
        self.evaluate_energies();
    }

    fn evaluate_energies(&mut self) {
        let energies = self.model.energies(&self.state, &mut self.workspace);
        self.energies = energies.map(Real::to_f64);
    }
}

impl<T: Real, S: Space<T>, const D: usize> Formulation<T, D> for Tree<T, S> {
    fn step(
        &mut self,
        natural: &NaturalModel<T, D>,
        step: Step<T>,
        state: &mut State<T>,
    ) -> Result<StepReport<T>, StepError> {
        let Self { model, options, workspace, .. } = self;
        let report = model.step(self.method, step.dt, options, &mut self.state, workspace)?;
        self.write(natural, state);
        Ok(report)
    }

    fn take_inputs(
        &mut self,
        natural: &NaturalModel<T, D>,
        state: &mut State<T>,
    ) -> Result<(), StepError> {
        self.state.inputs.copy_from_slice(&state.inputs);
        if self.model.take_inputs(&self.options, &mut self.state, &mut self.workspace)? {
            self.write(natural, state);
        }
        Ok(())
    }

    fn pass_jump(
        &mut self,
        natural: &NaturalModel<T, D>,
        state: &mut State<T>,
        to: T,
    ) -> Result<(), StepError> {
        self.model.pass_jump(&self.options, &mut self.state, &mut self.workspace, to)?;
        self.write(natural, state);
        Ok(())
    }

    fn history(&self) -> History<T> {
        let (mut state, mut own) = (self.state.clone(), self.workspace.history());
        let mut energies = self.energies;
        Book::write(|book| walk((&mut state, &mut energies), &mut own, book)).unwrap_or_default()
    }

    fn set_history(&mut self, history: &History<T>) -> Result<(), RestoreError> {
        let (mut state, mut own) = (self.state.clone(), self.workspace.history());
        let mut energies = self.energies;
        Book::read(history, |book| walk((&mut state, &mut energies), &mut own, book))?;
        if !self.workspace.set_history(&own, &self.options) {
            return Err(RestoreError);
        }
        (self.state, self.energies) = (state, energies);
        Ok(())
    }

    fn terms(&self) -> Option<&Terms<T>> {
        None
    }

    fn energies(&self, _natural: &NaturalModel<T, D>, state: &State<T>) -> [f64; 3] {
        let [kinetic, potential] = self.energies;
        [kinetic, potential, state.work.to_f64()]
    }

    fn set_time(&mut self, t: T) {
        self.state.t = t;
    }

    fn set_work(&mut self, work: T) {
        self.state.work = work;
    }

    fn watch(&mut self) {
        self.evaluate_energies();
    }

    fn set_max_steps(&mut self, n: u32) {
        self.options.max_steps = n.max(1);
    }

    fn can_take_over(&self, other: &dyn Formulation<T, D>) -> Result<(), SwitchError> {
        let other = other.as_any().downcast_ref::<Self>().ok_or(SwitchError::Formulation)?;
        let is_same = self.model.has_same_coordinates(&other.model);
        if is_same { Ok(()) } else { Err(SwitchError::Coordinates) }
    }

    fn take_over(&mut self, other: &dyn Formulation<T, D>) {
        if let Some(other) = other.as_any().downcast_ref::<Self>() {
            self.state.copy_coordinates(&other.state);
        }
    }

    fn refresh(
        &mut self,
        natural: &NaturalModel<T, D>,
        state: &mut State<T>,
    ) -> Result<(), StepError> {
        self.state.inputs.copy_from_slice(&state.inputs);
        self.model.settle(&mut self.state, &mut self.workspace)?;
        self.write(natural, state);
        Ok(())
    }
}

impl<T: Real, S: Space<T>, const D: usize> Trials<T, D> for Tree<T, S> {
    fn save_trial(&mut self) {
        self.saved.copy_from(&self.state);
        self.saved_energies = self.energies;
    }

    fn restore_trial(&mut self) {
        self.state.copy_from(&self.saved);
        self.energies = self.saved_energies;
    }
}

impl<T: Real, S: Space<T>, const D: usize> Describe<T, D> for Tree<T, S> {
    /// Number of freedoms of the tree, number of equations of its cut joints, and number of independent equations.
    fn sizes(&self) -> Option<[usize; 3]> {
        Some([self.state.v.len(), self.model.n_rows(), self.rank])
    }

    /// Returns the value of a joint coordinate. `None` if the joint is cut, or if the coordinate belongs to a rotation in space.
    fn coordinate(&self, joint: usize, number: usize) -> Option<T> {
        let link = (*self.coordinates.get(joint)?.get(number)?)?;
        Some(self.model.coordinate(&self.state, link))
    }

    fn owner_of_unknown(&self, _natural: &NaturalModel<T, D>, unknown: usize) -> Owner {
        self.model.owner_of_unknown(unknown)
    }

    fn owner_of_row(&self, _natural: &NaturalModel<T, D>, row: usize) -> Owner {
        self.model.owner_of_row(row)
    }

    fn codes<'a>(&'a self, _natural: &'a NaturalModel<T, D>) -> &'a Codes {
        self.model.codes()
    }
}

/// Visits all numbers that a checkpoint stores, to write or to restore them.
fn walk<T: Real>(
    (state, energies): (&mut TreeState<T>, &mut [f64; 2]),
    own: &mut OfWorkspace<T>,
    book: &mut Book<'_, T>,
) -> Restored {
    book.kind(3)?;
    // The inputs are saved with the natural state.
    let TreeState { t, z, v, a, a_aux, lambda, inputs: _, applied, signals, work, power } = state;
    book.real("t", t)?;
    book.real("work", work)?;
    book.real("power", power)?;
    book.rows("z", z)?;
    book.rows("v", v)?;
    book.rows("a", a)?;
    book.rows("auxiliary", a_aux)?;
    book.rows("lambda", lambda)?;
    let (threes, ones) = applied.as_chunks_mut::<3>();
    book.vectors("inputs", threes)?;
    // Empty lists are not written, so that a checkpoint of a scene without signals has no entries for them.
    for (name, numbers) in [("input of a signal", ones), ("signals", signals.as_flattened_mut())] {
        if !numbers.is_empty() {
            book.rows(name, numbers)?;
        }
    }
    let OfWorkspace { rank, pivots, pair, eighth, extrapolation, radau } = own;
    let mut count = *rank as u64;
    book.count("rank", &mut count)?;
    *rank = usize::try_from(count).map_err(|_| RestoreError)?;
    book.rows("pivots", pivots)?;
    book.option("rk54", pair, walk_steps)?;
    book.option("rk853", eighth, walk_steps)?;
    book.option("extrapolation", extrapolation, walk_steps)?;
    book.option("radau5", radau, |book, (steps, slopes)| {
        walk_steps(book, steps)?;
        walk_slopes(book, slopes)
    })?;
    book.doubles("energies", energies)
}

/// Visits the memory of the error control of internal steps.
fn walk_steps<T: Real>(book: &mut Book<'_, T>, history: &mut AdaptiveHistory<T>) -> Restored {
    let AdaptiveHistory { step, control: (memory, was_rejected), counts } = history;
    book.real("step", step)?;
    book.option("error", memory, |book, x| book.float("error", x))?;
    book.flag("was rejected", was_rejected)?;
    book.count("accepted", &mut counts.accepted)?;
    book.count("rejected", &mut counts.rejected)?;
    book.count("evaluations", &mut counts.evaluations)
}

fn walk_slopes<T: Real>(book: &mut Book<'_, T>, history: &mut RadauHistory<T>) -> Restored {
    let RadauHistory { jacobian, has_jacobian, factored, stages, step, rest } = history;
    book.list("jacobian", jacobian)?;
    book.list("stages", stages)?;
    book.flag("has jacobian", has_jacobian)?;
    book.option("factored", factored, |book, x| book.real("step", x))?;
    book.option("step", step, |book, x| book.real("step", x))?;
    book.real("rest", rest)
}

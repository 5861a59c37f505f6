//! A run in relative coordinates: the tree, its state, and the same state told in natural coordinates for the outputs.

use crate::checkpoint::TreeKept;
use crate::choice::IntegratorKind;
use crate::settings::Settings;
use crate::stop::StopError;
use mbs_core::Real;
use mbs_core::actions::{Action, Actions};
use mbs_core::model::{Model, Owner, State, Terms};
use mbs_core::natural::NaturalModel;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{BodyId, Scene};
use mbs_core::step::{StepError, StepReport};
use mbs_recursive::space::Space;
use mbs_recursive::{
    Closure, Options, Planar, Spatial, StartError, TreeModel, TreeState, Workspace,
};

/// Error of a step by extrapolation where none is given: 2e-10 in double precision, 5e-26 in pairs.
pub(crate) const ROUNDINGS: f64 = 1e6;

/// D dimensions as a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plane<const D: usize>;

/// The algebra of relative coordinates in D dimensions.
pub trait InSpace<T: Real> {
    /// Plane or space.
    type Space: Space<T>;
}

impl<T: Real> InSpace<T> for Plane<2> {
    type Space = Planar;
}

impl<T: Real> InSpace<T> for Plane<3> {
    type Space = Spatial;
}

/// An angle that the tree has with its turns.
#[derive(Debug, Clone, Copy)]
enum Angle {
    /// A link's coordinate.
    Of(u32),
    /// Of the second body against the first, in the plane.
    Between([BodyId; 2]),
}

/// The angles that effects measure, by the place where the natural state remembers each: of a joint that is not cut, or in the plane.
fn angles<T: Real, const D: usize>(
    scene: &Scene<T>,
    natural: &NaturalModel<T, D>,
    coordinates: &[Vec<Option<u32>>],
) -> Vec<(usize, Angle)> {
    // A scene that has a tree has actions.
    let list = Actions::new(scene).map(|actions| actions.list).unwrap_or_default();
    let angle = |(effect, action): &(usize, Action<T>)| {
        let angle = match action {
            // Joints with an effect about their axis have one angle.
            Action::Angle { joint, .. } => {
                let (number, _) = scene.joints[*joint].kind.turn(scene.dimension)?;
                Angle::Of(coordinates[*joint][number]?)
            }
            Action::Turn { bodies, .. } => Angle::Between(*bodies),
            Action::Torque { body, .. } if D == 2 => {
                Angle::Between([BodyId::Ground, BodyId::Body(*body)])
            }
            _ => return None,
        };
        Some((natural.memory_of_effect(*effect)?, angle))
    };
    list.iter().filter_map(angle).collect()
}

/// A scene in relative coordinates.
#[derive(Debug)]
pub struct Tree<T: Real, const D: usize>
where
    Plane<D>: InSpace<T>,
{
    model: TreeModel<T, <Plane<D> as InSpace<T>>::Space>,
    state: TreeState<T>,
    saved: TreeState<T>,
    workspace: Workspace<T, <Plane<D> as InSpace<T>>::Space>,
    options: Options<T>,
    integrator: IntegratorKind,
    motions: Vec<RigidMotion<T>>,
    terms: Terms<T>,
    /// The links that have the coordinates of each joint.
    coordinates: Vec<Vec<Option<u32>>>,
    /// Where the natural state remembers angles that the tree has, and whose they are.
    angles: Vec<(usize, Angle)>,
    rank: usize,
    energies: [f64; 2],
    saved_energies: [f64; 2],
}

impl<T: Real, const D: usize> Tree<T, D>
where
    Plane<D>: InSpace<T>,
{
    /// Builds the tree of a scene and starts it where `state` is; `state` is then told from the tree.
    pub(crate) fn new(
        scene: &Scene<T>,
        settings: &Settings,
        natural: &NaturalModel<T, D>,
        state: &mut State<T>,
    ) -> Result<Self, StopError> {
        let model = TreeModel::new(scene).map_err(StopError::tree)?;
        let start = model.start(scene, natural, state).map_err(|e| not_started(e, &model))?;
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
            options: options(scene, settings),
            integrator: settings.integrator,
            motions,
            terms: natural.terms(),
            rank,
            energies: [0.0; 2],
            saved_energies: [0.0; 2],
            model,
        };
        tree.tell(natural, state);
        Ok(tree)
    }

    /// Advances by `dt` [s] and tells `state` of it.
    pub(crate) fn step(
        &mut self,
        natural: &NaturalModel<T, D>,
        dt: T,
        state: &mut State<T>,
    ) -> Result<StepReport<T>, StepError> {
        let (model, options) = (&self.model, &self.options);
        let report = match self.integrator {
            IntegratorKind::Rk4 => {
                mbs_recursive::rk4_step(model, dt, options, &mut self.state, &mut self.workspace)
            }
            IntegratorKind::Rk54 => {
                mbs_recursive::rk54_step(model, dt, options, &mut self.state, &mut self.workspace)
            }
            IntegratorKind::Rk853 => {
                mbs_recursive::rk853_step(model, dt, options, &mut self.state, &mut self.workspace)
            }
            IntegratorKind::Extrapolation => {
                let workspace = &mut self.workspace;
                mbs_recursive::extrapolated_step(model, dt, options, &mut self.state, workspace)
            }
            IntegratorKind::Radau5 => {
                mbs_recursive::radau5_step(model, dt, options, &mut self.state, &mut self.workspace)
            }
            _ => mbs_recursive::step(model, dt, options, &mut self.state, &mut self.workspace),
        }?;
        self.tell(natural, state);
        Ok(report)
    }

    /// Keeps the state, so that steps after it can be undone.
    pub(crate) fn keep(&mut self) {
        self.saved.copy_from(&self.state);
        self.saved_energies = self.energies;
    }

    /// Goes back to what was kept; the natural state is not told.
    pub(crate) fn undo(&mut self) {
        self.state.copy_from(&self.saved);
        self.energies = self.saved_energies;
    }

    /// State that the next step continues from.
    pub(crate) fn kept(&self) -> TreeKept<T> {
        let (state, energies) = (self.state.clone(), self.energies);
        TreeKept { state, history: self.workspace.history(), energies }
    }

    /// Goes on from what was kept; says whether it is of this tree.
    pub(crate) fn go_on(&mut self, kept: &TreeKept<T>) -> bool {
        let is_ours = self.workspace.set_history(&kept.history, &self.options);
        if is_ours {
            self.state.copy_from(&kept.state);
            self.energies = kept.energies;
        }
        is_ours
    }

    /// Tells the natural state of the tree's.
    fn tell(&mut self, natural: &NaturalModel<T, D>, state: &mut State<T>) {
        self.model.write_motions(&self.state, &mut self.workspace, &mut self.motions);
        state.t = self.state.t;
        state.work = self.state.work;
        state.power = self.state.power;
        state.applied.copy_from_slice(&self.state.applied);
        for &(place, angle) in &self.angles {
            state.memory[place] = match angle {
                Angle::Of(link) => self.model.coordinate(&self.state, link),
                Angle::Between(bodies) => self.model.turn_between(&self.state, bodies),
            };
        }
        tell(&self.motions, natural, &mut self.terms, state);
        self.watch();
    }

    /// An angle or slide of a joint with its turns, by its number; nothing where the joint is cut, or turns in space.
    pub(crate) fn coordinate(&self, joint: usize, number: usize) -> Option<T> {
        let link = (*self.coordinates.get(joint)?.get(number)?)?;
        Some(self.model.coordinate(&self.state, link))
    }

    /// Takes kinetic and potential energy.
    pub(crate) fn watch(&mut self) {
        let energies = self.model.energies(&self.state, &mut self.workspace);
        self.energies = energies.map(Real::to_f64);
    }

    /// May this tree take over the state of another?
    pub(crate) fn has_same_coordinates(&self, other: &Self) -> bool {
        self.model.has_same_coordinates(&other.model)
    }

    /// Takes the coordinates and velocities of another tree over.
    pub(crate) fn show(&mut self, other: &Self) {
        self.state.copy_coordinates(&other.state);
    }

    /// Makes accelerations and multipliers those of this tree's own effects, and tells `natural`'s state.
    pub(crate) fn settle(
        &mut self,
        natural: &NaturalModel<T, D>,
        state: &mut State<T>,
    ) -> Result<(), StepError> {
        self.state.inputs.copy_from_slice(&state.inputs);
        self.model.settle(&mut self.state, &mut self.workspace)?;
        self.tell(natural, state);
        Ok(())
    }

    /// Sets the work since the start [J].
    pub(crate) fn set_work(&mut self, work: T) {
        self.state.work = work;
    }

    /// Makes the states those of the inputs that are set in `state` now.
    pub(crate) fn take_inputs(
        &mut self,
        natural: &NaturalModel<T, D>,
        state: &mut State<T>,
    ) -> Result<(), StepError> {
        self.state.inputs.copy_from_slice(&state.inputs);
        if self.model.take_inputs(&self.options, &mut self.state, &mut self.workspace)? {
            self.tell(natural, state);
        }
        Ok(())
    }

    /// Lets an integrator that controls its own steps try no more of them within one length asked for.
    pub(crate) fn limit_steps(&mut self, most: u32) {
        self.options.max_steps = most;
    }

    pub(crate) fn set_time(&mut self, t: T) {
        self.state.t = t;
    }

    /// Kinetic and potential energy [J].
    pub(crate) fn energies(&self) -> [f64; 2] {
        self.energies
    }

    /// Freedoms of the tree, equations of its cut joints, their rank.
    pub(crate) fn sizes(&self) -> [usize; 3] {
        [self.state.v.len(), self.model.n_rows(), self.rank]
    }

    pub(crate) fn owner_of_unknown(&self, unknown: usize) -> Owner {
        self.model.owner_of_unknown(unknown)
    }

    pub(crate) fn owner_of_row(&self, row: usize) -> Owner {
        self.model.owner_of_row(row)
    }
}

/// Writes the motions of the bodies into a natural state that has its time; measured angles go on from the last ones.
pub(crate) fn tell<T: Real, const D: usize>(
    motions: &[RigidMotion<T>],
    natural: &NaturalModel<T, D>,
    terms: &mut Terms<T>,
    state: &mut State<T>,
) {
    natural.write_motions(motions, state);
    if !state.memory.is_empty() {
        natural.set_inputs(state.t, state, terms);
        natural.evaluate_forces(&state.q, &state.v, terms);
        natural.remember(terms, &mut state.memory);
    }
}

/// Why the tree has no start, with the names' places.
fn not_started<T: Real, S: Space<T>>(error: StartError, model: &TreeModel<T, S>) -> StopError {
    match error {
        StartError::Tree(error) => StopError::tree(error),
        StartError::Step(error) => {
            StopError::step(error, |u| model.owner_of_unknown(u), |row| model.owner_of_row(row))
        }
        _ => StopError::Start(mbs_core::start::AssemblyError::Model(
            mbs_core::natural::ModelError::Dimension,
        )),
    }
}

fn options<T: Real>(scene: &Scene<T>, settings: &Settings) -> Options<T> {
    let first_step = Some(settings.lengths(scene).step);
    let mut options = Options { first_step, ..Options::default() };
    if !settings.integrator.is_of_first_order() {
        options.integrator = settings.integrator.coefficients();
    }
    if let Some(alpha) = settings.penalty {
        let alpha = T::from_f64(alpha);
        options.closure = Closure::Report { alpha, omega: T::from_f64(10.0), mu: T::ONE };
    }
    if settings.integrator == IntegratorKind::Extrapolation {
        // Orders this high are chosen for digits.
        options.error = T::EPSILON * T::from_f64(ROUNDINGS);
    }
    if let Some(tolerance) = settings.tolerance {
        options.tolerance = T::from_f64(tolerance);
        options.error = options.tolerance;
    }
    options
}

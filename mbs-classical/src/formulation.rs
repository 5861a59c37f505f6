//! Implementation of the common trait of formulations by this crate: [`Classical`], in index-3.

use crate::index3;
use crate::options::Options;
use crate::workspace::Workspace;
use alloc::boxed::Box;
use core::fmt::Debug;
use mbs_core::formulation::{Describe, Formulation, Trials, energies};
use mbs_core::history::{Book, History, RestoreError, Restored};
use mbs_core::implicit::{pass_jump, take_inputs};
use mbs_core::model::{Model, Owner, State, Terms};
use mbs_core::natural::NaturalModel;
use mbs_core::step::{OptionError, Step, StepError, StepReport};
use mbs_core::team::Team;
use mbs_core::{Cliques, Real, SymmetricSolver, with_team};

/// The index-3 classical Lagrangian over a solver `S`; the threads of a team `W` share the work of its steps.
#[derive(Debug, Clone)]
pub struct Classical<T, S, W> {
    options: Options<T>,
    workspace: Box<Workspace<T, S>>,
    team: W,
}

impl<T: Real, S: SymmetricSolver<T>, W: Team> Classical<T, S, W> {
    /// Creates a formulation of `model`, with a solver analysed for its [`Saddle`](crate::Saddle).
    ///
    /// # Errors
    /// [`OptionError`] for an option out of range.
    pub fn new(
        model: &impl Model<T>,
        options: Options<T>,
        solver: S,
        team: W,
    ) -> Result<Self, OptionError> {
        options.validate()?;
        Ok(Self { options, workspace: Box::new(Workspace::new(model, solver)), team })
    }

    /// Sets other options for the next steps.
    ///
    /// # Errors
    /// [`OptionError`] for an option out of range; nothing is changed then.
    pub fn set_options(&mut self, options: Options<T>) -> Result<(), OptionError> {
        options.validate()?;
        self.options = options;
        Ok(())
    }
}

impl<T, S, W, const D: usize> Formulation<T, D> for Classical<T, S, W>
where
    T: Real,
    S: SymmetricSolver<T> + Clone + Debug + Send + Sync + 'static,
    W: Team + Clone + Debug + Send + Sync + 'static,
{
    fn step(
        &mut self,
        model: &NaturalModel<T, D>,
        step: Step<T>,
        state: &mut State<T>,
    ) -> Result<StepReport<T>, StepError> {
        let Self { options, workspace, team } = self;
        with_team!(model, team, |model| index3::step(model, step, options, state, workspace))
    }

    fn take_inputs(
        &mut self,
        model: &NaturalModel<T, D>,
        state: &mut State<T>,
    ) -> Result<(), StepError> {
        take_inputs(model, &self.options, state, &mut *self.workspace).map(drop)
    }

    fn pass_jump(
        &mut self,
        model: &NaturalModel<T, D>,
        state: &mut State<T>,
        to: T,
    ) -> Result<(), StepError> {
        pass_jump(model, &self.options, state, &mut *self.workspace, to)
    }

    fn history(&self) -> History<T> {
        let mut terms = self.workspace.terms().clone();
        Book::write(|book| walk(&mut terms, book)).unwrap_or_default()
    }

    fn set_history(&mut self, history: &History<T>) -> Result<(), RestoreError> {
        Book::read(history, |book| walk(self.workspace.terms_mut(), book))
    }

    fn terms(&self) -> Option<&Terms<T>> {
        Some(self.workspace.terms())
    }

    fn energies(&self, model: &NaturalModel<T, D>, state: &State<T>) -> [f64; 3] {
        let terms = Some(self.workspace.terms());
        with_team!(model, &self.team, |model| energies(model, state, terms))
    }
}

impl<T: Real, S, W, const D: usize> Trials<T, D> for Classical<T, S, W> {}

impl<T: Real, S, W: Team, const D: usize> Describe<T, D> for Classical<T, S, W> {
    fn threads(&self) -> usize {
        self.team.size()
    }

    /// Returns the owner of an unknown. The unknowns are the coordinates, then the multipliers.
    fn owner_of_unknown(&self, model: &NaturalModel<T, D>, unknown: usize) -> Owner {
        match unknown.checked_sub(model.n_unknowns()) {
            Some(row) => model.owner_of_row(row),
            None => model.owner_of_unknown(unknown),
        }
    }
}

/// Passes all data on which the next step depends to a visitor.
fn walk<T: Real>(terms: &mut Terms<T>, book: &mut Book<'_, T>) -> Restored {
    book.kind(1)?;
    book.laws(terms)
}

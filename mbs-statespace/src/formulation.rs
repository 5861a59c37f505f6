//! Implementation of the common trait of formulations by this crate: [`StateSpace`].

use crate::history::History as OfWorkspace;
use crate::options::Options;
use crate::step::step;
use crate::workspace::Workspace;
use alloc::boxed::Box;
use mbs_core::Real;
use mbs_core::formulation::{Describe, Formulation, Trials};
use mbs_core::history::{Book, History, RestoreError, Restored};
use mbs_core::implicit::{pass_jump, take_inputs};
use mbs_core::model::{Model, State, Terms};
use mbs_core::natural::NaturalModel;
use mbs_core::step::{OptionError, Step, StepError, StepReport};

/// The modified state-space formulation.
#[derive(Debug, Clone)]
pub struct StateSpace<T> {
    options: Options<T>,
    workspace: Box<Workspace<T>>,
}

impl<T: Real> StateSpace<T> {
    /// Creates a formulation of `model`. `start` is a consistent state, and the rank of its constraints must not change in later steps.
    ///
    /// # Errors
    /// [`OptionError`] for an option out of range.
    pub fn new(
        model: &impl Model<T>,
        options: Options<T>,
        start: &State<T>,
    ) -> Result<Self, OptionError> {
        options.validate()?;
        Ok(Self { options, workspace: Box::new(Workspace::new(model, start)) })
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

impl<T: Real, const D: usize> Formulation<T, D> for StateSpace<T> {
    fn step(
        &mut self,
        model: &NaturalModel<T, D>,
        size: Step<T>,
        state: &mut State<T>,
    ) -> Result<StepReport<T>, StepError> {
        step(model, size, &self.options, state, &mut self.workspace)
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
        let (mut own, mut terms) = (self.workspace.history(), self.workspace.terms().clone());
        Book::write(|book| walk(&mut own, &mut terms, book)).unwrap_or_default()
    }

    fn set_history(&mut self, history: &History<T>) -> Result<(), RestoreError> {
        let mut own = self.workspace.history();
        Book::read(history, |book| walk(&mut own, self.workspace.terms_mut(), book))?;
        if self.workspace.set_history(&own) { Ok(()) } else { Err(RestoreError) }
    }

    fn terms(&self) -> Option<&Terms<T>> {
        Some(self.workspace.terms())
    }
}

impl<T: Real, const D: usize> Trials<T, D> for StateSpace<T> {}

impl<T: Real, const D: usize> Describe<T, D> for StateSpace<T> {}

/// Passes all data on which the next step depends to a visitor.
fn walk<T: Real>(
    own: &mut OfWorkspace<T>,
    terms: &mut Terms<T>,
    book: &mut Book<'_, T>,
) -> Restored {
    book.kind(2)?;
    let OfWorkspace { order, usual, first_basis, is_stale, choices } = own;
    book.pairs("pivots", &mut order.pivots)?;
    book.rows("row scales", &mut order.row_scales)?;
    book.list("pivot sizes", &mut order.sizes)?;
    if order.sizes.len() != order.pivots.len() {
        return Err(RestoreError);
    }
    book.real("usual pivot", usual)?;
    book.real("first basis", first_basis)?;
    book.flag("chooses anew", is_stale)?;
    book.small("choices", choices)?;
    book.laws(terms)
}

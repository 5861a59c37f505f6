//! Implementation of the common trait of formulations by this crate: [`Augmented`].

use crate::history::History as OfWorkspace;
use crate::index_change::{ConstraintIndex, IndexChange, IndexHistory};
use crate::options::{Options, Penalty};
use crate::workspace::Workspace;
use crate::{index1, index3};
use alloc::boxed::Box;
use core::fmt::Debug;
use mbs_core::formulation::{Describe, Formulation, SwitchError, Trials, energies};
use mbs_core::history::{Book, History, RestoreError, Restored};
use mbs_core::implicit::{pass_jump, take_inputs};
use mbs_core::model::{Model, State, Terms};
use mbs_core::natural::NaturalModel;
use mbs_core::step::{OptionError, Step, StepError, StepReport};
use mbs_core::team::Team;
use mbs_core::{Real, SpdSolver, with_team};

/// Form of the equations that the steps solve, with its options.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Form<T> {
    /// Index-1 form, with its options.
    Index1(Options<T>),
    /// Index-3 form, with its options.
    Index3(Options<T>),
    /// Index-3 for long steps and index-1 for short ones.
    MultiIndex(IndexChange<T>),
}

impl<T: Real> Form<T> {
    /// The options of the next step.
    fn options(&self) -> &Options<T> {
        match self {
            Self::Index1(options) | Self::Index3(options) => options,
            Self::MultiIndex(change) => change.options(),
        }
    }

    fn validate(&self) -> Result<(), OptionError> {
        match self {
            Self::Index1(options) | Self::Index3(options) => options.validate(),
            Self::MultiIndex(change) => {
                change.index1.validate()?;
                change.index3.validate()
            }
        }
    }

    fn step<M: Model<T>, S: SpdSolver<T>>(
        &self,
        model: &M,
        step: Step<T>,
        state: &mut State<T>,
        workspace: &mut Workspace<T, S>,
    ) -> Result<StepReport<T>, StepError> {
        match self {
            Self::Index1(options) => index1::step(model, step, options, state, workspace),
            Self::Index3(options) => index3::step(model, step, options, state, workspace),
            Self::MultiIndex(change) => change.step(model, step, state, workspace),
        }
    }
}

/// An augmented Lagrangian formulation over a solver `S`; the threads of a team `W` share the work of its steps.
#[derive(Debug, Clone)]
pub struct Augmented<T, S, W> {
    form: Form<T>,
    workspace: Box<Workspace<T, S>>,
    team: W,
}

impl<T: Real, S: SpdSolver<T>, W: Team> Augmented<T, S, W> {
    /// Creates a formulation of `model`, with a solver analysed for its cliques.
    ///
    /// # Errors
    /// [`OptionError`] for an option out of range.
    pub fn new(
        model: &impl Model<T>,
        form: Form<T>,
        solver: S,
        team: W,
    ) -> Result<Self, OptionError> {
        form.validate()?;
        Ok(Self { form, workspace: Box::new(Workspace::new(model, solver)), team })
    }

    /// Sets another form, or other options, for the next steps.
    ///
    /// # Errors
    /// [`OptionError`] for an option out of range; nothing is changed then.
    pub fn set_form(&mut self, form: Form<T>) -> Result<(), OptionError> {
        form.validate()?;
        self.form = form;
        Ok(())
    }
}

impl<T, S, W, const D: usize> Formulation<T, D> for Augmented<T, S, W>
where
    T: Real,
    S: SpdSolver<T> + Clone + Debug + Send + Sync + 'static,
    W: Team + Clone + Debug + Send + Sync + 'static,
{
    fn step(
        &mut self,
        model: &NaturalModel<T, D>,
        step: Step<T>,
        state: &mut State<T>,
    ) -> Result<StepReport<T>, StepError> {
        let Self { form, workspace, team } = self;
        with_team!(model, team, |model| form.step(model, step, state, workspace))
    }

    fn take_inputs(
        &mut self,
        model: &NaturalModel<T, D>,
        state: &mut State<T>,
    ) -> Result<(), StepError> {
        take_inputs(model, self.form.options(), state, &mut *self.workspace).map(drop)
    }

    fn pass_jump(
        &mut self,
        model: &NaturalModel<T, D>,
        state: &mut State<T>,
        to: T,
    ) -> Result<(), StepError> {
        pass_jump(model, self.form.options(), state, &mut *self.workspace, to)
    }

    fn history(&self) -> History<T> {
        let (mut own, mut terms) = (self.workspace.history(), self.workspace.terms().clone());
        let mut form = self.form;
        Book::write(|book| walk(&mut own, &mut form, &mut terms, book)).unwrap_or_default()
    }

    fn set_history(&mut self, history: &History<T>) -> Result<(), RestoreError> {
        let Self { form, workspace, .. } = self;
        let mut own = workspace.history();
        Book::read(history, |book| walk(&mut own, form, workspace.terms_mut(), book))?;
        if workspace.set_history(&own) { Ok(()) } else { Err(RestoreError) }
    }

    fn terms(&self) -> Option<&Terms<T>> {
        Some(self.workspace.terms())
    }

    fn energies(&self, model: &NaturalModel<T, D>, state: &State<T>) -> [f64; 3] {
        let terms = Some(self.workspace.terms());
        with_team!(model, &self.team, |model| energies(model, state, terms))
    }

    fn can_take_over(&self, other: &dyn Formulation<T, D>) -> Result<(), SwitchError> {
        if other.as_any().is::<Self>() { Ok(()) } else { Err(SwitchError::Formulation) }
    }

    fn refresh(
        &mut self,
        model: &NaturalModel<T, D>,
        state: &mut State<T>,
    ) -> Result<(), StepError> {
        let options = Options::index1();
        index1::settle(model, model.length(), &options, state, &mut self.workspace)
    }
}

impl<T: Real, S: SpdSolver<T>, W, const D: usize> Trials<T, D> for Augmented<T, S, W> {
    fn save_trial(&mut self) {
        self.workspace.save();
    }

    fn restore_trial(&mut self) {
        self.workspace.restore();
    }

    fn prepare(
        &mut self,
        model: &NaturalModel<T, D>,
        step: Step<T>,
        reductions: u32,
        state: &mut State<T>,
    ) -> bool {
        match &mut self.form {
            Form::MultiIndex(change) => {
                change.prepare(model, step, reductions, state, &mut self.workspace)
            }
            Form::Index1(_) | Form::Index3(_) => false,
        }
    }

    fn strengthen(&mut self, error: &StepError) -> bool {
        let Options { penalty, adaptive_penalty, .. } = *self.form.options();
        let may_change = adaptive_penalty && matches!(penalty, Penalty::Scaled(_));
        let is_by_them =
            matches!(error, StepError::NotConverged { .. } | StepError::Violated { .. });
        may_change && is_by_them && self.workspace.strengthen()
    }

    fn tried(&mut self, dt: T) {
        if let Form::MultiIndex(change) = &mut self.form {
            change.tried(dt);
        }
    }

    fn accept(&mut self) {
        if let Form::MultiIndex(change) = &mut self.form {
            change.accept();
        }
    }
}

impl<T: Real, S, W: Team, const D: usize> Describe<T, D> for Augmented<T, S, W> {
    fn threads(&self) -> usize {
        self.team.size()
    }

    fn index(&self) -> Option<(u8, u32)> {
        Some(match &self.form {
            Form::Index1(_) => (1, 0),
            Form::Index3(_) => (3, 0),
            Form::MultiIndex(change) => {
                (if change.index() == ConstraintIndex::One { 1 } else { 3 }, change.changes())
            }
        })
    }
}

/// Passes all data on which the next step depends to a visitor.
fn walk<T: Real>(
    own: &mut OfWorkspace<T>,
    form: &mut Form<T>,
    terms: &mut Terms<T>,
    book: &mut Book<'_, T>,
) -> Restored {
    book.kind(0)?;
    let OfWorkspace { penalty_factor, penalty_strength, contraction, weakest_combination, settled } =
        own;
    book.real("penalty factor", penalty_factor)?;
    book.real("penalty strength", penalty_strength)?;
    book.real("contraction", contraction)?;
    book.rows("weakest combination", weakest_combination)?;
    book.small("factorizations", &mut settled.factorizations)?;
    book.small("solves", &mut settled.solves)?;
    if let Form::MultiIndex(change) = form {
        let IndexHistory { index, mut changes, mut tried, mut last } = change.history();
        let mut is_one = index == ConstraintIndex::One;
        book.flag("index is 1", &mut is_one)?;
        book.small("changes of index", &mut changes)?;
        book.real("last trial", &mut tried)?;
        book.real("last step", &mut last)?;
        let index = if is_one { ConstraintIndex::One } else { ConstraintIndex::Three };
        change.set_history(IndexHistory { index, changes, tried, last });
    }
    book.laws(terms)
}

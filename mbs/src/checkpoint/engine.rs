//! What each formulation keeps from step to step, beside the natural state.

use super::tape::{Tape, Told, holds};
use crate::engine::{Engine, Index};
use crate::tree::{InSpace, Plane};
use mbs_augmented as augmented;
use mbs_core::Real;
use mbs_core::model::{Measure, State, Terms};
use mbs_core::ode::{AdaptiveHistory, RadauHistory};
use mbs_recursive as recursive;
use mbs_recursive::TreeState;
use mbs_statespace as statespace;

/// It, by formulation.
#[derive(Debug, Clone)]
pub(crate) enum EngineKept<T> {
    Augmented(augmented::History<T>, Option<augmented::IndexHistory<T>>, Springs<T>),
    Classical(Springs<T>),
    StateSpace(statespace::History<T>, Springs<T>),
    Recursive(Box<TreeKept<T>>),
}

/// What energies are told of: the springs as last evaluated, and the courses.
#[derive(Debug, Clone)]
pub(crate) struct Springs<T> {
    measures: Vec<Measure<T>>,
    courses: Vec<[T; 3]>,
}

/// What relative coordinates keep.
#[derive(Debug, Clone)]
pub(crate) struct TreeKept<T> {
    pub(crate) state: TreeState<T>,
    pub(crate) history: recursive::History<T>,
    /// Kinetic and potential energy [J].
    pub(crate) energies: [f64; 2],
}

impl<T: Real> Springs<T> {
    fn of(terms: &Terms<T>) -> Self {
        Self { measures: terms.measures.clone(), courses: terms.courses.clone() }
    }

    fn put(&self, terms: &mut Terms<T>) {
        terms.measures.clone_from(&self.measures);
        terms.courses.clone_from(&self.courses);
    }

    fn walk(&mut self, tape: &mut impl Tape) -> Told {
        tape.places(&mut self.measures, |tape, m| {
            let Measure { value, rate, tension, stiffness, damping, transverse, drift } = m;
            [value, rate, tension, stiffness, damping, transverse, drift]
                .into_iter()
                .try_for_each(|x| tape.real(x))
        })?;
        tape.places(&mut self.courses, |tape, course| tape.reals(course))
    }
}

impl<T: Real, const D: usize> Engine<T, D>
where
    Plane<D>: InSpace<T>,
{
    /// State that the next step continues from.
    pub(crate) fn kept(&self) -> EngineKept<T> {
        match self {
            Self::Augmented { index, workspace, .. } => {
                let change = match index {
                    Index::Both(change) => Some(change.history()),
                    Index::One(_) | Index::Three(_) => None,
                };
                EngineKept::Augmented(workspace.history(), change, Springs::of(workspace.terms()))
            }
            Self::Classical { workspace, .. } => {
                EngineKept::Classical(Springs::of(workspace.terms()))
            }
            Self::StateSpace { workspace, .. } => {
                EngineKept::StateSpace(workspace.history(), Springs::of(workspace.terms()))
            }
            Self::Recursive(tree) => EngineKept::Recursive(Box::new(tree.kept())),
        }
    }

    /// Goes on from what was kept; says whether it is of this formulation and model.
    pub(crate) fn go_on(&mut self, kept: &EngineKept<T>) -> bool {
        match (self, kept) {
            (
                Self::Augmented { index, workspace, .. },
                EngineKept::Augmented(history, change, springs),
            ) => {
                if let (Index::Both(present), Some(change)) = (index, change) {
                    present.set_history(*change);
                }
                springs.put(workspace.terms_mut());
                workspace.set_history(history)
            }
            (Self::Classical { workspace, .. }, EngineKept::Classical(springs)) => {
                springs.put(workspace.terms_mut());
                true
            }
            (Self::StateSpace { workspace, .. }, EngineKept::StateSpace(history, springs)) => {
                springs.put(workspace.terms_mut());
                workspace.set_history(history)
            }
            (Self::Recursive(tree), EngineKept::Recursive(kept)) => tree.go_on(kept),
            _ => false,
        }
    }
}

impl<T: Real> EngineKept<T> {
    /// Writes it, or reads it back in the same shape.
    pub(crate) fn walk(&mut self, tape: &mut impl Tape) -> Told {
        let number = match self {
            Self::Augmented(..) => 0,
            Self::Classical(..) => 1,
            Self::StateSpace(..) => 2,
            Self::Recursive(..) => 3,
        };
        let mut is = number;
        tape.index(&mut is, 4)?;
        holds(is == number)?;
        match self {
            Self::Augmented(history, change, springs) => {
                walk_penalty(history, tape)?;
                change.as_mut().map_or(Ok(()), |change| walk_index(change, tape))?;
                springs.walk(tape)
            }
            Self::Classical(springs) => springs.walk(tape),
            Self::StateSpace(history, springs) => {
                walk_choice(history, tape)?;
                springs.walk(tape)
            }
            Self::Recursive(tree) => walk_tree(tree, tape),
        }
    }
}

fn walk_penalty<T: Real>(history: &mut augmented::History<T>, tape: &mut impl Tape) -> Told {
    let augmented::History { boost, rho, probe, settled } = history;
    tape.real(boost)?;
    tape.real(rho)?;
    tape.reals(probe)?;
    tape.small(&mut settled.factorizations)?;
    tape.small(&mut settled.solves)
}

fn walk_index<T: Real>(history: &mut augmented::IndexHistory<T>, tape: &mut impl Tape) -> Told {
    let augmented::IndexHistory { index, changes, tried, last } = history;
    let mut is_one = *index == augmented::ConstraintIndex::One;
    tape.flag(&mut is_one)?;
    *index =
        if is_one { augmented::ConstraintIndex::One } else { augmented::ConstraintIndex::Three };
    tape.small(changes)?;
    tape.real(tried)?;
    tape.real(last)
}

fn walk_choice<T: Real>(history: &mut statespace::History<T>, tape: &mut impl Tape) -> Told {
    let statespace::History { order, usual, first_basis, is_stale, choices } = history;
    tape.list(&mut order.pivots, 8, |tape, pivot| {
        pivot.iter_mut().try_for_each(|x| tape.small(x))
    })?;
    tape.reals(&mut order.row_scales)?;
    order.sizes.resize(order.pivots.len(), T::ZERO);
    tape.reals(&mut order.sizes)?;
    tape.real(usual)?;
    tape.real(first_basis)?;
    tape.flag(is_stale)?;
    tape.small(choices)
}

fn walk_tree<T: Real>(kept: &mut TreeKept<T>, tape: &mut impl Tape) -> Told {
    let TreeKept { state, history, energies } = kept;
    // What is set goes with the natural state.
    let TreeState { t, z, v, a, lambda, inputs: _, applied, work, power } = state;
    [t, work, power].into_iter().try_for_each(|x| tape.real(x))?;
    [z, v, a, lambda].into_iter().try_for_each(|x| tape.reals(x))?;
    tape.places(applied.as_chunks_mut::<3>().0, |tape, value| tape.reals(value))?;
    let recursive::History { rank, pivots, pair, eighth, extrapolation, radau } = history;
    tape.index(rank, pivots.len() + 1)?;
    tape.reals(pivots)?;
    tape.option(pair, Parts::adaptive)?;
    tape.option(eighth, Parts::adaptive)?;
    tape.option(extrapolation, Parts::adaptive)?;
    tape.option(radau, |tape, (steps, slopes)| {
        tape.adaptive(steps)?;
        walk_slopes(slopes, tape)
    })?;
    tape.floats(energies)
}

fn walk_slopes<T: Real>(history: &mut RadauHistory<T>, tape: &mut impl Tape) -> Told {
    let RadauHistory { jacobian, has_jacobian, factored, stages, step, rest } = history;
    [jacobian, stages].into_iter().try_for_each(|x| {
        // a number takes at least eight bytes
        tape.list(x, 8, |tape, x| tape.real(x))
    })?;
    tape.flag(has_jacobian)?;
    [factored, step].into_iter().try_for_each(|x| tape.option(x, |tape, x| tape.real(x)))?;
    tape.real(rest)
}

/// Parts that several have.
pub(crate) trait Parts: Tape {
    /// What controls a step inside a step.
    fn adaptive<T: Real>(&mut self, history: &mut AdaptiveHistory<T>) -> Told {
        let AdaptiveHistory { step, control, counts } = history;
        self.real(step)?;
        self.errors(control)?;
        [&mut counts.accepted, &mut counts.rejected, &mut counts.evaluations]
            .into_iter()
            .try_for_each(|x| self.count(x))
    }

    /// What a control by error estimates remembers.
    fn errors(&mut self, (memory, was_rejected): &mut (Option<f64>, bool)) -> Told {
        self.option(memory, Tape::float)?;
        self.flag(was_rejected)
    }

    /// A natural state.
    fn state<T: Real>(&mut self, state: &mut State<T>) -> Told {
        let State {
            t,
            dt,
            q,
            q_low,
            v,
            a,
            a_aux,
            lambda,
            lambda_previous,
            reaction,
            phi,
            memory,
            inputs: _,
            applied,
            signals: _,
            work,
            power,
        } = state;
        [t, dt, work, power].into_iter().try_for_each(|x| self.real(x))?;
        [q, q_low, v, a, a_aux, lambda, lambda_previous, reaction, phi, memory]
            .into_iter()
            .try_for_each(|x| self.reals(x))?;
        self.places(applied.as_chunks_mut::<3>().0, |tape, value| tape.reals(value))
    }
}

impl<P: Tape> Parts for P {}

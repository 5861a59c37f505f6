//! Answers of a formulation to what is asked of it beside its steps.

use crate::Real;
use crate::laws::code::Codes;
use crate::model::{Model, Owner};
use crate::natural::NaturalModel;

/// Description of a formulation: its sizes, and whose its unknowns and rows are. The defaults are those of natural coordinates.
pub trait Describe<T: Real, const D: usize> {
    /// Coordinates, constraints and their rank at the start, where other coordinates than natural ones are stepped.
    fn sizes(&self) -> Option<[usize; 3]> {
        None
    }

    /// Threads that share the work of a step, this one among them.
    fn threads(&self) -> usize {
        1
    }

    /// The index in which the next step would be made, and the changes of it so far; nothing where there is none.
    fn index(&self) -> Option<(u8, u32)> {
        None
    }

    /// An angle or slide of a joint with its turns, by joint and number, where the formulation's own coordinates have it.
    fn coordinate(&self, _joint: usize, _number: usize) -> Option<T> {
        None
    }

    /// Part of the scene that an unknown of the formulation belongs to.
    fn owner_of_unknown(&self, model: &NaturalModel<T, D>, unknown: usize) -> Owner {
        model.owner_of_unknown(unknown)
    }

    /// Part of the scene that a constraint row of the formulation belongs to.
    fn owner_of_row(&self, model: &NaturalModel<T, D>, row: usize) -> Owner {
        model.owner_of_row(row)
    }

    /// The user-defined laws by which it steps: whether one of them failed.
    fn codes<'a>(&'a self, model: &'a NaturalModel<T, D>) -> &'a Codes {
        model.codes()
    }
}

//! Description of a formulation: answers besides its steps.

use crate::Real;
use crate::laws::code::Codes;
use crate::model::{Model, Owner};
use crate::natural::NaturalModel;

/// Description of a formulation: sizes, and owners of its unknowns and rows. The defaults are those of natural coordinates.
pub trait Describe<T: Real, const D: usize> {
    /// Number of coordinates, number of constraints, and rank of the constraints at the start. `None` for formulations in natural
    /// coordinates.
    fn sizes(&self) -> Option<[usize; 3]> {
        None
    }

    /// Number of threads that work on a step, with the calling one.
    fn threads(&self) -> usize {
        1
    }

    /// Index (1 or 3) of the next step, and the number of changes of the index so far; `None` without an index.
    fn index(&self) -> Option<(u8, u32)> {
        None
    }

    /// Angle or slide of a joint with full turns, by joint and number; `None` if the formulation does not have it as a coordinate.
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

    /// User-defined laws that the formulation uses. They record which law failed.
    fn codes<'a>(&'a self, model: &'a NaturalModel<T, D>) -> &'a Codes {
        model.codes()
    }
}

//! Expressions: numbers with units, parameters and functions, in the text of a value.
//!
//! ```text
//! sum      = product { (+|-) product }          power = atom [ ^ whole number up to 64 ]
//! product  = signed { (*|/) signed }            atom  = number [unit] | ( sum ) | pi | name | point.x | function ( sum [, sum] )
//! signed   = - signed | power                   unit  = name [^ whole] { (*|/) name [^ whole] }, without blanks
//! ```
//!
//! `-2^2` is -4. All is computed in pairs of doubles, and rounded once to the digits of a run.

mod evaluate;
pub(crate) mod unit;

pub(crate) use evaluate::is_reserved;
pub use evaluate::{Evaluated, EvaluationFault, evaluate};

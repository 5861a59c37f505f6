//! Expressions: numbers with units, parameters and functions, in the text of a value.
//!
//! ```text
//! sum      = product { (+|-) product }          power = atom [ ^ whole number up to 64 ]
//! product  = signed { (*|/) signed }            atom  = number [unit] | ( sum ) | pi | name | point.x | function ( sum [, sum] )
//! signed   = - signed | power                   unit  = name [^ whole] { (*|/) name [^ whole] }, without blanks
//! ```
//!
//! The value of `-2^2` is -4. Expressions are evaluated in double-double arithmetic, and rounded once to the scalar of the run.

mod evaluate;
pub(crate) mod unit;

pub(crate) use evaluate::is_reserved;
pub use evaluate::{Evaluated, EvaluationFault, evaluate};

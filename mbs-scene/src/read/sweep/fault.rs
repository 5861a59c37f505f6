//! Faults of a sweep, in addition to those of any scene file.

use crate::format::significant;
use crate::read::nearest::nearest_name;
use core::fmt::{self, Display, Formatter};

/// All faults that a sweep can have.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum SweepFault {
    /// A path with a syntax error; the text says what is wrong.
    PathSyntax(&'static str),
    /// A table of the scene that does not have this key.
    NoKey {
        /// Path of the table; empty for the top level of the file.
        at: String,
        /// Key that the table lacks.
        key: String,
        /// Keys of the table in the file.
        known: Vec<String>,
    },
    /// A list of tables that has no entry of this name.
    NoEntry {
        /// The list, such as `body`.
        table: String,
        /// Name that no entry has.
        name: String,
        /// Names of the entries in the list.
        known: Vec<String>,
    },
    /// A name that several entries of a list have.
    Ambiguous {
        /// The list, such as `initial`.
        table: String,
        /// Positions of the entries, from 0.
        entries: Vec<usize>,
    },
    /// An index that is beyond the end of a list.
    NoIndex {
        /// Path of the list.
        at: String,
        /// Index in the path, from 0.
        index: usize,
        /// Number of entries of the list.
        count: usize,
    },
    /// A path that does not end at a number, or that continues after one.
    NotANumber {
        /// Path of the value that was found.
        at: String,
        /// Description of the value at this path.
        found: &'static str,
        /// Advice on what to do.
        advice: String,
    },
    /// The dimension of the scene, which a sweep cannot vary.
    Fixed,
    /// A number that two parameters set.
    SetTwice {
        /// Name of the parameter that already sets the number.
        by: String,
    },
    /// A parameter's name that is already the name of a column.
    NameTaken(String),
    /// A sweep without `[[vary]]`, or a parameter without values.
    NoValues,
    /// A seed that is not a whole number from 0.
    NotASeed(String),
    /// A list of values in a Latin hypercube, which needs ranges.
    NotSampled,
    /// A range whose ends are equal.
    NoRange,
    /// A logarithmic range that contains zero or negative numbers.
    NotLogarithmic,
    /// A step that is zero or points away from the end, or is longer than the range.
    Step {
        /// First value of the range.
        from: f64,
        /// End of the range.
        to: f64,
    },
    /// More members than a sweep may have; the value is their number.
    TooMany(f64),
    /// A parameter whose number of values differs from that of the first parameter, when values are combined one to one.
    ZipCount {
        /// Name of the first parameter.
        first: String,
        /// Number of values of the first parameter.
        needed: usize,
        /// Number of values of this parameter.
        found: usize,
    },
    /// A value for which the scene is not valid.
    Refused {
        /// Value for which the scene is not valid.
        value: String,
        /// Name of the parameter.
        name: String,
        /// Message of the scene's error.
        problem: String,
        /// Advice on what to do.
        advice: String,
    },
}

/// Largest number of members of a sweep [-]. A larger number is refused as a mistake. Chosen, not tuned.
pub(super) const MOST_MEMBERS: u32 = 1_000_000;

impl Display for SweepFault {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::PathSyntax(problem) => write!(f, "this is no path: {problem}"),
            Self::NoKey { at, key, .. } if at.is_empty() => {
                write!(f, "the scene has no table `{key}`")
            }
            Self::NoKey { at, key, .. } => write!(f, "`{at}` has no key `{key}` in the scene"),
            Self::NoEntry { table, name, .. } => {
                write!(f, "the scene has no [[{table}]] called `{name}`")
            }
            Self::Ambiguous { table, entries } => {
                write!(f, "{} entries [[{table}]] of the scene go by this name", entries.len())
            }
            Self::NoIndex { at, index, count } => {
                write!(f, "`{at}` has {count} entries in the scene, none is number [{index}]")
            }
            Self::NotANumber { at, found, .. } => {
                write!(f, "only numbers are varied, and `{at}` is {found} in the scene")
            }
            Self::Fixed => write!(f, "the dimension cannot be varied"),
            Self::SetTwice { by } => write!(f, "this place is already set by `{by}`"),
            Self::NameTaken(name) => write!(f, "the table has another column `{name}`"),
            Self::NoValues => write!(f, "there is nothing to vary"),
            Self::NotSampled => {
                write!(f, "a Latin hypercube samples ranges, and this is a list of values")
            }
            Self::NotASeed(text) => write!(f, "`{text}` is no seed"),
            Self::NoRange => write!(f, "the range ends where it begins"),
            Self::NotLogarithmic => write!(f, "a logarithmic range must stay above zero"),
            Self::Step { from, to } => write!(
                f,
                "no step of this length leads from {} towards {}",
                significant(*from),
                significant(*to)
            ),
            Self::TooMany(n) => write!(f, "{n} members are more than {MOST_MEMBERS}"),
            Self::ZipCount { first, needed, found } => write!(
                f,
                "zip pairs values one to one, but here are {found} and `{first}` has {needed}"
            ),
            Self::Refused { value, name, problem, .. } => {
                write!(f, "the scene refuses {value} as `{name}`: {problem}")
            }
        }
    }
}

impl SweepFault {
    /// Hint that says what to do about the fault.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::PathSyntax(_) => {
                "write table, name, key and index, such as body.crank.mass, joint.\"front left\".at[0]"
                    .to_owned()
            }
            Self::NoKey { at, key, known } if at.is_empty() => nearest_name(key, known, "tables"),
            Self::NoKey { key, known, .. } => {
                let advice = nearest_name(key, known, "keys");
                format!("{advice}; a key left out in the scene is varied once it is written there")
            }
            Self::NoEntry { name, known, .. } => nearest_name(name, known, "names"),
            Self::Ambiguous { table, entries } => {
                let paths: Vec<_> = entries.iter().map(|i| format!("{table}[{i}]")).collect();
                format!("write {}", paths.join(" or "))
            }
            Self::NoIndex { count: 0, .. } => "name another place".to_owned(),
            Self::NoIndex { count, .. } => format!("count from [0] to [{}]", count - 1),
            Self::NotANumber { advice, .. } | Self::Refused { advice, .. } => advice.clone(),
            Self::Fixed => "write a scene for each dimension".to_owned(),
            Self::SetTwice { .. } => "leave one out, or let one of them `shift` it".to_owned(),
            Self::NameTaken(_) => "give the parameter a `name` of its own".to_owned(),
            Self::NoValues => {
                "add [[vary]] with `path` and `values`, or with `from`, `to` and `count`".to_owned()
            }
            Self::NotSampled => "write the range in the file of the sweep".to_owned(),
            Self::NotASeed(_) => "write a whole number from 0".to_owned(),
            Self::NoRange => "write two different ends, or `values = [..]`".to_owned(),
            Self::NotLogarithmic => {
                "write two positive ends, or leave `scale = \"log\"` out".to_owned()
            }
            Self::Step { .. } => {
                "give it the sign that leads from `from` to `to`, and at most their distance"
                    .to_owned()
            }
            Self::TooMany(_) => "write fewer values, or sample a Latin hypercube".to_owned(),
            Self::ZipCount { .. } => {
                "write as many values for each, or `combine = \"grid\"`".to_owned()
            }
        }
    }

    /// Hint for a sweep in code, which does not mention keys of a file.
    #[must_use]
    pub fn hint_in_code(&self) -> String {
        let hint = match self {
            Self::SetTwice { .. } | Self::NameTaken(_) => "vary each path once",
            Self::NoValues => "give a path, with at least one value",
            Self::TooMany(_) => "give fewer values",
            Self::ZipCount { .. } => "give as many values for each, or use a grid",
            other => return other.hint(),
        };
        hint.to_owned()
    }
}

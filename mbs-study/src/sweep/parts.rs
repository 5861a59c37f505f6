//! Parts of a sweep, which run separately, for instance on other machines. Each part has its own journal; the parts are joined to one table.
//!
//! ```text
//! part K of N     members K, K + N, K + 2 N, ..., counted from 1: neighbours, which cost alike, are in different parts
//! ```

use core::fmt::{self, Display, Formatter};
use core::str::FromStr;

/// Part of a sweep, written `K/N`.
///
/// ```
/// use mbs_study::sweep::SweepPart;
/// let part: SweepPart = "2/3".parse()?;
/// assert_eq!(part.members(8).collect::<Vec<_>>(), [1, 4, 7]);
/// assert!("4/3".parse::<SweepPart>().is_err());
/// # Ok::<(), String>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct SweepPart {
    /// Number N of parts.
    pub(super) of: usize,
    /// Number K of the part, from 1.
    pub(super) number: usize,
}

impl SweepPart {
    /// Part that has all members.
    pub(super) const WHOLE: Self = Self { of: 1, number: 1 };

    /// Returns the members of the part, from 0; `n` is the number of all members.
    pub fn members(self, n: usize) -> impl ExactSizeIterator<Item = usize> {
        (self.number - 1..n).step_by(self.of)
    }

    /// Checks that all members belong to this part.
    pub(super) fn check<'a>(
        self,
        mut members: impl Iterator<Item = &'a usize>,
    ) -> Result<(), PartsError> {
        match members.find(|&member| member % self.of + 1 != self.number) {
            Some(member) => Err(PartsError::Foreign(self, member + 1)),
            None => Ok(()),
        }
    }

    /// Name of the part's journal.
    pub(super) fn file(self) -> String {
        format!("part-{}-of-{}.journal", self.number, self.of)
    }

    /// Parses the part from a journal's name.
    pub(super) fn of_file(name: &str) -> Option<Self> {
        let (number, of) =
            name.strip_prefix("part-")?.strip_suffix(".journal")?.split_once("-of-")?;
        let part: Self = format!("{number}/{of}").parse().ok()?;
        (part.file() == name).then_some(part)
    }
}

impl FromStr for SweepPart {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').map(|(number, of)| (number.parse(), of.parse()));
        match numbers {
            Some((Ok(number), Ok(of))) if (1..=of).contains(&number) => Ok(Self { of, number }),
            _ => Err("write K/N, part K of N, with K from 1 to N".to_owned()),
        }
    }
}

impl Display for SweepPart {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

/// Reason why parts cannot be joined.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum PartsError {
    /// Directory without a journal of a part.
    None,
    /// Two parts of sweeps that were divided into different numbers of parts.
    Counts(SweepPart, SweepPart),
    /// Journal of a part with a member, from 1, of another part.
    Foreign(SweepPart, usize),
    /// Parts that lack members: for each, the number of missing members and of all.
    Unfinished(Vec<(SweepPart, [usize; 2])>),
}

impl PartsError {
    /// Returns a hint at what to do about the error.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::None => "run them first: mbs sweep SCENE SWEEP --part K/N --out DIR",
            Self::Counts(..) => "remove the journals of the parts that do not belong to the sweep",
            Self::Foreign(..) => "remove that journal, and run the part again",
            Self::Unfinished(_) => "run these parts: what is finished is kept",
        }
    }
}

impl Display for PartsError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => write!(f, "there are no parts of a sweep"),
            Self::Counts(one, other) => {
                write!(f, "part {one} is of {} parts, and part {other} of {}", one.of, other.of)
            }
            Self::Foreign(part, member) => {
                write!(f, "`{}` has member {member}, which is of another part", part.file())
            }
            Self::Unfinished(parts) => {
                let lacks = parts.iter().map(|(part, [lacking, members])| {
                    format!("part {part} lacks {lacking} of {members} members")
                });
                f.write_str(&lacks.collect::<Vec<_>>().join(", "))
            }
        }
    }
}

impl core::error::Error for PartsError {}

//! `--threads`: sizes of teams, as `4`, `1-4` or `1-N`.

use std::str::FromStr;

/// Largest number of threads in a team [-]: a larger one is probably a typing error.
const MAX_TEAM: usize = 1024;

/// Sizes of thread teams in increasing order; size one is always among them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Threads(Vec<usize>);

impl Threads {
    /// All sizes up to `n`; for large `n` only powers of two and `n`.
    pub(crate) fn up_to(n: usize) -> Self {
        Self::span(1, n.max(1))
    }

    /// One, and the sizes from `low` to `high`. If these are more than eight, only powers of two and the last one.
    fn span(low: usize, high: usize) -> Self {
        let is_kept = |n: &usize| high - low < 8 || n.is_power_of_two() || *n == high;
        let sizes = (low.max(2)..=high).filter(is_kept);
        Self([1].into_iter().chain(sizes).collect())
    }

    /// Returns the sizes of the teams.
    pub(crate) fn sizes(&self) -> &[usize] {
        &self.0
    }

    /// Writes the sizes, separated by commas.
    pub(crate) fn listed(&self) -> String {
        self.0.iter().map(ToString::to_string).collect::<Vec<_>>().join(",")
    }
}

impl FromStr for Threads {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let hint = || {
            format!(
                "`{text}` is no number of threads; hint: write 4 for teams of one and four, 1-4 for one to four, or 1-N for \
                 one to as many as there are cores"
            )
        };
        let number = |word: &str| match word.trim() {
            "N" | "n" => Some(super::machine::cores()),
            word => word.parse().ok().filter(|n| (1..=MAX_TEAM).contains(n)),
        };
        match text.split_once('-') {
            None => number(text).map(|n| Self::span(n, n)).ok_or_else(hint),
            Some((low, high)) => {
                let ends = number(low).zip(number(high)).filter(|(low, high)| low <= high);
                ends.map(|(low, high)| Self::span(low, high)).ok_or_else(hint)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sizes(text: &str) -> Vec<usize> {
        text.parse::<Threads>().unwrap().0
    }

    #[test]
    fn threads_are_a_number_or_a_span() {
        assert_eq!(sizes("4"), [1, 4]);
        assert_eq!(sizes("1"), [1]);
        assert_eq!(sizes("1-4"), [1, 2, 3, 4]);
        assert_eq!(sizes("3-5"), [1, 3, 4, 5]);
        assert_eq!(sizes("1-24"), [1, 2, 4, 8, 16, 24]);
        let all = sizes("1-N");
        assert_eq!((all[0], all[all.len() - 1]), (1, super::super::machine::cores()));
        assert_eq!(Threads::up_to(2).listed(), "1,2");
    }

    #[test]
    fn nonsense_is_refused_with_a_hint() {
        for text in ["", "0", "0-4", "4-1", "-1", "x", "1-", "1-2-3", "1.5", "99999"] {
            let refusal = text.parse::<Threads>().unwrap_err();
            assert!(refusal.contains("hint: write 4"), "{text}: {refusal}");
        }
    }
}

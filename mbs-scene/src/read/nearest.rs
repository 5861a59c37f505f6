//! The nearest of several names, for suggestions in error messages.

use crate::read::hints;
use std::fmt::Write;

/// The name with the smallest edit distance, if it is small enough for a misspelling.
pub fn nearest<'a, S: AsRef<str>>(found: &str, known: &'a [S]) -> Option<&'a str> {
    /// Longest name that is compared [letters]. The work grows with the square of the length.
    const LONGEST: usize = 64;
    let found: Vec<char> = found.to_lowercase().chars().take(LONGEST + 1).collect();
    let allowed = 1 + found.len() / 4;
    if found.is_empty() || found.len() > LONGEST {
        return None;
    }
    known
        .iter()
        .filter_map(|name| {
            let letters: Vec<char> = name.as_ref().to_lowercase().chars().collect();
            if letters.len().abs_diff(found.len()) > allowed {
                return None;
            }
            let distance = distance(&found, &letters);
            (distance <= allowed && distance < found.len()).then_some((distance, name.as_ref()))
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

/// Number of insertions, deletions, replacements and swaps of neighbouring letters that change `a` to `b`.
fn distance(a: &[char], b: &[char]) -> usize {
    let mut two_back = vec![0; b.len() + 1];
    let mut previous: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut current = vec![i + 1; b.len() + 1];
        for j in 0..b.len() {
            let replace = previous[j] + usize::from(a[i] != b[j]);
            current[j + 1] = replace.min(previous[j + 1] + 1).min(current[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                current[j + 1] = current[j + 1].min(two_back[j - 1] + 1);
            }
        }
        two_back = previous;
        previous = current;
    }
    previous[b.len()]
}

/// Hint for a word that is not in a list: the nearest name, or else a list of the names.
#[must_use]
pub fn nearest_name<S: AsRef<str>>(found: &str, known: &[S], what: &str) -> String {
    if let Some(hint) = hints::of_word(found, known) {
        return hint;
    }
    match nearest(found, known) {
        Some(name) => format!("did you mean `{name}`?"),
        None => listing(known, what),
    }
}

/// A list of the names. When there are many, the list has only the first ones and the number of the others.
pub(super) fn listing<S: AsRef<str>>(known: &[S], what: &str) -> String {
    /// Largest number of names that are listed [-]: some lines of a terminal.
    const MAX_NAMES: usize = 16;
    if known.is_empty() {
        return format!("there are no {what} yet");
    }
    let names: Vec<&str> = known.iter().take(MAX_NAMES).map(AsRef::as_ref).collect();
    let mut out = format!("{what}: {}", names.join(", "));
    if known.len() > MAX_NAMES {
        // Writing into a String does not fail.
        let _ = write!(out, " and {} more", known.len() - MAX_NAMES);
    }
    out
}

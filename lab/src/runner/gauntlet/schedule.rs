//! Schedule of the cases by number: every round has all families; those that take long are only in some rounds.

use crate::gauntlet::families::{FAMILIES, Family, LONG_FAMILIES};

/// Families in the order in which a round has them.
pub fn all() -> impl Iterator<Item = &'static Family> {
    FAMILIES.iter().chain(&LONG_FAMILIES)
}

/// The first `count` cases: family and seed.
pub fn cases(count: usize) -> impl Iterator<Item = (&'static Family, u64)> {
    let round = |round: u64| {
        let due = move |family: &&Family| round.is_multiple_of(family.every);
        all().filter(due).map(move |family| (family, round / family.every))
    };
    (0..).flat_map(round).take(count)
}

/// The family of a name.
#[must_use]
pub fn family(name: &str) -> Option<&'static Family> {
    all().find(|family| family.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_family_has_its_turn_and_no_case_comes_twice() {
        let mut seen = std::collections::BTreeSet::new();
        for (family, seed) in cases(5000) {
            assert!(seen.insert((family.name, seed)), "{} {seed} comes twice", family.name);
        }
        for family in all() {
            assert!(seen.contains(&(family.name, 1)), "{} has few", family.name);
        }
    }

    #[test]
    fn a_case_is_the_same_whenever_it_is_made_and_differs_from_the_next() {
        for family in all() {
            let [a, b, c] = [3, 3, 4].map(|seed| family.case(seed).scene);
            assert!(a == b && a != c, "{}", family.name);
            assert!(family.case(3).size > 0.0, "{} has a size", family.name);
        }
    }
}

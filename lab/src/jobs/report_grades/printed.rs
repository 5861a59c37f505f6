//! The grades as published: in the report, and in publication 1. They differ for the recursive formulation.

/// A method of the grades, with its options and the letters of the report and of publication 1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Method {
    /// Name of the method in our tables.
    pub(crate) name: &'static str,
    /// `--formulation` of `mbs run`.
    pub(crate) formulation: &'static str,
    /// Further arguments of `mbs run`.
    pub(crate) arguments: &'static [&'static str],
    /// The crate of the formulation.
    pub(crate) package: &'static str,
    /// Letters of Table I, seven of the report and seven of publication 1; `None` for methods without a row.
    pub(crate) speed_and_accuracy: Option<[&'static str; 2]>,
    /// Letters of Table II: five in the report, five in publication 1.
    pub(crate) conditions: Option<[&'static str; 2]>,
}

/// Makes a method without a row in the report.
const fn ours(
    name: &'static str,
    formulation: &'static str,
    arguments: &'static [&'static str],
    package: &'static str,
) -> Method {
    Method { name, formulation, arguments, package, speed_and_accuracy: None, conditions: None }
}

/// Methods of the grades, one a row.
pub(crate) const METHODS: [Method; 7] = [
    Method {
        speed_and_accuracy: Some(["AABBAAF", "AABBAAF"]),
        conditions: Some(["AAAAA", "AAAAA"]),
        ..ours("index-1", "index-1", &[], "mbs-augmented")
    },
    Method {
        speed_and_accuracy: Some(["AAAAFAA", "AAAAFAA"]),
        conditions: Some(["AAAAA", "AAAAA"]),
        ..ours("index-3", "index-3", &[], "mbs-augmented")
    },
    Method {
        speed_and_accuracy: Some(["BACCAAA", "BACCAAA"]),
        conditions: Some(["CFCAC", "CFCAC"]),
        ..ours("state-space", "state-space", &[], "mbs-statespace")
    },
    Method {
        speed_and_accuracy: Some(["DDBAAAA", "CDCAAAA"]),
        conditions: Some(["DFDBD", "DFDDD"]),
        ..ours("recursive", "recursive", &[], "mbs-recursive")
    },
    ours("classical", "classical", &[], "mbs-classical"),
    ours("multi-index, fixed step", "multi-index", &["--step-control", "fixed"], "mbs-augmented"),
    ours("index-3, alpha = 1e7", "index-3", &["--penalty", "1e7"], "mbs-augmented"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_rows_have_a_letter_for_each_column() {
        for method in METHODS {
            let rows = [(method.speed_and_accuracy, 7), (method.conditions, 5)];
            for (row, n) in rows {
                let is_whole =
                    |row: &str| row.len() == n && row.chars().all(|c| "ABCDF".contains(c));
                assert!(row.is_none_or(|row| row.into_iter().all(is_whole)), "{}", method.name);
            }
        }
    }
}

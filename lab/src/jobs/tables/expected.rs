//! Entries of the tables that are known to stop before their end. Other stops are reported as surprises. Listed entries that are completed
//! are surprises too.

use super::rows::Row;
use crate::mbs::outcome::Outcome;

/// An entry that stops: table, method, step [s], and the code of its error.
type Entry = (&'static str, &'static str, f64, &'static str);

/// The entries that stop. With the published penalty, the report found stops too, or it needed pivoting. Others have singular positions, at
/// steps that are too large for index-1, or so small that a state is close to the singular position.
const STOPPED: &[Entry] = &[
    ("T1", "index-3, alpha = 1e7", 1e-4, "not-converged"),
    ("T1", "index-3, alpha = 1e7", 1e-5, "not-converged"),
    ("T1p", "index-3, alpha = 1e7", 1e-4, "not-converged"),
    ("T1p", "index-3, alpha = 1e7", 1e-5, "not-converged"),
    ("T1p", "index-3, alpha = 1e7", 1e-6, "not-converged"),
    ("T2", "index-1", 5e-2, "violated"),
    ("T2", "index-3, alpha = 1e7", 5e-2, "not-converged"),
    ("T2", "index-3, alpha = 1e7", 1e-2, "not-converged"),
    ("T2", "index-3, alpha = 1e7", 1e-3, "not-converged"),
    ("T2", "index-3, alpha = 1e7", 1e-4, "not-converged"),
    ("T2", "state-space", 1e-4, "rank-lost"),
    ("T2", "recursive", 1e-4, "violated"),
    ("T3", "index-3, alpha = 1e7", 1e-4, "not-converged"),
    ("T3", "index-3, alpha = 1e7", 1e-5, "not-converged"),
    ("T3", "index-3, alpha = 1e7", 1e-6, "not-converged"),
    ("T8", "index-3, alpha = 1e9", 1e-3, "not-converged"),
];

/// Sentences on rows that differ from the list.
pub(crate) fn surprises(rows: &[Row]) -> Vec<String> {
    rows.iter().filter_map(|row| surprise(row, STOPPED)).collect()
}

fn surprise(row: &Row, listed: &[Entry]) -> Option<String> {
    let is_it = |(table, method, step, _): &&Entry| {
        (*table, *method, step.to_bits()) == (row.table.name, row.method.name, row.step.to_bits())
    };
    let listed = listed.iter().find(is_it).map(|(.., code)| *code);
    let name = format!("{} {} at {:e} s", row.table.name, row.method.name, row.step);
    match (&row.outcome, listed) {
        (Outcome::Completed(_), None) => None,
        (Outcome::Stopped { code, .. }, Some(listed)) if code == listed => None,
        (Outcome::Completed(_), Some(code)) => {
            Some(format!("{name}: reached its end, and is listed to stop with {code}"))
        }
        (outcome, Some(code)) => {
            Some(format!("{name}: {}; listed to stop with {code}", outcome.reason()))
        }
        (outcome, None) => Some(format!("{name}: {}", outcome.reason())),
    }
}

#[cfg(test)]
mod tests {
    use super::super::report::TABLES;
    use super::super::rows::tests::samples;
    use super::*;

    #[test]
    fn listed_entries_exist() {
        for (table, method, step, _) in STOPPED {
            let table = TABLES.iter().find(|t| t.name == *table).expect("a table");
            let is_there = |(m, dt): (&super::super::report::Method, f64)| {
                m.name == *method && dt.to_bits() == step.to_bits()
            };
            assert!(table.entries().any(is_there), "{} {method} {step:e}", table.name);
        }
    }

    #[test]
    fn what_stops_unlisted_and_what_ends_though_listed_are_surprises() {
        let rows = samples();
        let found = |i: usize, listed: &[Entry]| surprise(&rows[i], listed);
        let stops = [("T1", rows[1].method.name, 1e-4, "not-converged")];
        assert_eq!((found(0, &[]), found(1, &stops)), (None, None));
        assert!(found(1, &[]).unwrap().contains("not-converged"));
        let other = [("T1", rows[1].method.name, 1e-4, "violated")];
        assert!(found(1, &other).unwrap().contains("listed to stop with violated"));
        let ends = [("T1", rows[0].method.name, 1e-2, "violated")];
        assert!(found(0, &ends).unwrap().contains("reached its end"));
        assert!(found(2, &[]).unwrap().contains("not built"));
    }
}

//! Rank of matrices by sparse and by dense elimination.

use mbs_core::inside::start::{pivoted_rank, sparse_rank};

/// Pseudorandom number in (-1/2, 1/2), equal on every machine.
fn random(state: &mut u32) -> f64 {
    *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    f64::from(*state) / f64::from(u32::MAX) - 0.5
}

/// Rows with a few entries near the diagonal. Every `repeat`-th row is a combination of two rows before it.
fn rows(m: usize, n: usize, repeat: usize, state: &mut u32) -> Vec<Vec<(u32, f64)>> {
    let mut rows: Vec<Vec<(u32, f64)>> = Vec::new();
    for r in 0..m {
        let mut dense = vec![0.0; n];
        if r % repeat == repeat - 1 {
            for before in [r - 1, r - 2] {
                let factor = random(state) * 4.0;
                rows[before].iter().for_each(|(c, x)| dense[*c as usize] += factor * x);
            }
        } else {
            for k in 0..4 {
                dense[(r + 5 * k) % n] = random(state);
            }
        }
        let entries = (0..).zip(dense).filter(|(_, x)| *x != 0.0);
        rows.push(entries.collect());
    }
    rows
}

#[test]
fn sparse_and_dense_elimination_count_the_same_rank() {
    let mut state = 7;
    for (m, n, repeat) in [(30, 40, 100), (60, 50, 3), (80, 60, 4), (40, 40, 5), (90, 30, 7)] {
        let rows = rows(m, n, repeat, &mut state);
        let mut dense = vec![0.0; n * m];
        for (r, row) in rows.iter().enumerate() {
            let length = row.iter().map(|(_, x)| x * x).sum::<f64>().sqrt();
            row.iter().for_each(|(c, x)| dense[r * n + *c as usize] = x / length);
        }
        let expected = pivoted_rank(dense, n, m);
        assert_eq!(sparse_rank(rows, n), expected, "{m} by {n}");
    }
}

#[test]
fn rows_without_entries_and_no_rows_have_no_rank() {
    assert_eq!(sparse_rank::<f64>(Vec::new(), 3), 0);
    assert_eq!(sparse_rank::<f64>(vec![Vec::new(), vec![(1, 2.0)], vec![(1, -1.0)]], 3), 1);
}

//! Solutions of smallest norm, compared with solutions by hand.

use mbs_core::inside::outputs::MinimumNorm;

/// Rounding error of a few operations on numbers of order one.
const ROUNDING: f64 = 1e-14;

fn solved(rows: &[[f64; 3]], right: &[f64]) -> (Vec<f64>, Vec<bool>, f64) {
    let mut system = MinimumNorm::new(rows.len(), 3);
    system.begin(rows.len(), 3);
    for (i, row) in rows.iter().enumerate() {
        for (j, &x) in row.iter().enumerate() {
            *system.entry(i, j) = x;
        }
        system.right()[i] = right[i];
    }
    let rest = system.solve();
    let determined = (0..3).map(|j| system.is_determined(j)).collect();
    (system.solution().to_vec(), determined, rest)
}

#[test]
fn a_doubled_support_is_shared_as_computed_by_hand() {
    // x0 + x1 = 2, x2 = 3, and the sum of both equations
    let rows = [[1.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
    let (x, determined, rest) = solved(&rows, &[2.0, 3.0, 5.0]);
    for (x, expected) in x.iter().zip([1.0, 1.0, 3.0]) {
        assert!((x - expected).abs() < ROUNDING, "{x} {expected}");
    }
    assert_eq!(determined, [false, false, true]);
    assert!(rest < ROUNDING);
}

#[test]
fn a_full_system_has_one_solution_and_contradictions_are_measured() {
    let rows = [[2.0, 1.0, 0.0], [0.0, 3.0, 1.0], [1.0, 0.0, 1.0], [0.0, 0.0, 0.0]];
    let (x, determined, rest) = solved(&rows, &[4.0, 9.0, 4.0, 0.5]);
    for (x, expected) in x.iter().zip([1.0, 2.0, 3.0]) {
        assert!((x - expected).abs() < ROUNDING, "{x} {expected}");
    }
    assert_eq!(determined, [true; 3]);
    assert!((rest - 0.5).abs() < ROUNDING);
}

#[test]
fn nothing_balances_nothing() {
    let (x, determined, rest) = solved(&[[0.0; 3]; 2], &[0.0; 2]);
    assert_eq!(x, [0.0; 3]);
    assert_eq!(determined, [false; 3]);
    assert!(rest < ROUNDING);
}

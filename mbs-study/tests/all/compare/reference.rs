//! References by extrapolation, by runs, and by a table.

use mbs::record::Channel;
use mbs_scene::Component;
use mbs_study::inside::compare::{Instants, Known, ReferenceTable, RunPair};

/// Rows at the instants after the start.
type Rows = Vec<Vec<f64>>;

fn channels() -> Vec<Channel> {
    let component = Component { label: String::new(), unit: "rad".into() };
    vec![Channel { name: "a".into(), quantity: "", components: vec![component] }]
}

/// Rows of sin t at `n` instants, with a given error.
fn rows(n: usize, error: impl Fn(f64) -> f64) -> Rows {
    (1..=n).map(|k| 0.1 * k as f64).map(|t| vec![t.sin() + error(t)]).collect()
}

const INSTANTS: Instants = Instants { count: 100, interval: 0.1 };

fn pair(error: impl Fn(f64) -> f64, coarse: impl Fn(f64) -> f64) -> RunPair {
    RunPair { method: "x".into(), rows: rows(100, error), coarse: rows(100, coarse) }
}

fn of(best: &RunPair, check: Option<&RunPair>) -> Known {
    Known::of_runs(best, check, (&channels(), 1.0), (&INSTANTS, 1e-6))
}

#[test]
fn extrapolation_removes_the_error_of_second_order() {
    let run = |h: f64| rows(100, move |t| h * h * t + h.powi(4));
    let pair = RunPair::richardson("x".into(), [&run(0.1), &run(0.05), &run(0.025)]);
    let exact = rows(100, |_| 0.0);
    let error =
        |rows: &Rows| rows.iter().zip(&exact).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f64::max);
    assert!(error(&pair.rows) < 3e-6 && error(&pair.coarse) < 4e-5);
    assert!(error(&pair.rows) < error(&pair.coarse) / 10.0);
}

#[test]
fn the_reference_is_cut_where_its_two_runs_part_and_says_so() {
    let chaos = |t: f64| 1e-12 * f64::exp(3.0 * t);
    let known = of(&pair(|_| 0.0, chaos), Some(&pair(|_| 1e-9, |_| 2e-9)));
    // the error 1e-12 e^(3 t), divided by the range of about two, is a third of 1e-6 at t = 4.5
    let until = known.report.known_until.unwrap();
    assert!((4.2..4.8).contains(&until), "{until}");
    assert!(known.report.is_verified && known.report.uncertainty <= 1e-6 / 3.0);
    assert_eq!(known.notes.len(), 1);
    assert_eq!(known.errors(&rows(100, |_| 0.0)).unwrap()[0].to_bits(), 0.0_f64.to_bits());
    assert_eq!(known.errors(&rows(10, |_| 0.0)), None);
}

#[test]
fn a_table_is_verified_or_refuted_by_formulations_that_agree() {
    let table = |error: f64| {
        let rows = rows(100, |_| error).into_iter().map(Some).collect();
        let table = ReferenceTable { rows, digits: vec![5e-7], has: vec![true] };
        Known::of_table(table, "ref.csv", (&channels(), 1.0))
    };
    let pairs = [pair(|_| 0.0, |_| 1e-9), pair(|_| 1e-9, |_| 2e-9)];
    let held = |error: f64, pairs: &[RunPair]| {
        let mut known = table(error);
        known.verify("ref.csv", pairs, &INSTANTS);
        known
    };
    let good = held(4e-7, &pairs);
    assert!(good.report.is_verified && !good.is_refuted && good.notes.is_empty());
    let invented = held(0.3, &pairs);
    assert!(!invented.report.is_verified && invented.is_refuted);
    let note = &invented.notes[0];
    assert!(note.contains("NOT verified: x and x agree to 5.0e-10"), "{note}");
    assert!(note.contains("differ from ref.csv by 0.3 rad of `a` at"), "{note}");
    // formulations that disagree can neither refute nor verify a table
    let apart = held(0.3, &[pair(|_| 0.0, |_| 1e-9), pair(|_| 0.1, |_| 0.1)]);
    assert!(!apart.report.is_verified && !apart.is_refuted && apart.notes.len() == 1);
    assert!(!held(0.0, &pairs[..1]).report.is_verified, "one alone verifies nothing");
}

#[test]
fn a_check_that_disagrees_or_is_too_uncertain_does_not_verify() {
    let good = pair(|_| 0.0, |_| 1e-10);
    let off = of(&good, Some(&pair(|_| 1e-3, |_| 1.0001e-3)));
    assert!(!off.report.is_verified && off.notes[0].contains("away"), "{:?}", off.notes);
    let blind = of(&good, Some(&pair(|_| 0.0, |_| 0.1)));
    assert!(!blind.report.is_verified && blind.notes[0].contains("has an uncertainty"));
    assert!(!of(&good, None).report.is_verified);
    assert!(of(&good, Some(&pair(|_| 1e-8, |_| 2e-8))).report.is_verified);
}

//! Times at which signals jump or have corners.

use mbs_core::inputs::{SignalGraph, SignalTimes};
use mbs_core::scene::{Interpolation, NamedSignal, SignalKind, TableEnds};

fn times(kinds: Vec<SignalKind<f64>>) -> SignalTimes<f64> {
    let named = |kind| NamedSignal { name: String::new(), kind };
    let signals: Vec<_> = kinds.into_iter().map(named).collect();
    SignalTimes::new(&SignalGraph::new(&signals), core::iter::empty())
}

fn until(all: &SignalTimes<f64>, end: f64) -> Vec<(f64, bool)> {
    let mut found = Vec::new();
    let mut t = 0.0;
    while let Some(next) = all.after(t).filter(|next| next.time <= end) {
        assert!(next.time > t);
        found.push((next.time, next.is_jump));
        t = next.time;
    }
    found
}

#[test]
fn steps_ramps_and_tables_have_their_times_and_smooth_signals_none() {
    let rows = || vec![[0.5, 1.0], [1.0, 2.0], [1.5, 3.0], [2.0, 3.0]];
    let table =
        |interpolation, periodic| SignalKind::Table { rows: rows(), interpolation, periodic };
    let step = |rise: f64| SignalKind::Step { from: 0.0, to: 2.0, at: 0.3, rise };
    let ramp = |rounding: f64| SignalKind::Ramp { rate: 2.0, start: 0.2, end: Some(0.7), rounding };
    let of = |kind| until(&times(vec![kind]), 10.0);
    assert_eq!(of(step(0.0)), [(0.3, true)]);
    assert_eq!(of(ramp(0.0)), [(0.2, false), (0.7, false)]);
    // sloped from 0.5 to 1.5, then level
    assert_eq!(of(table(Interpolation::Linear, false)), [(0.5, false), (1.5, false)]);
    assert_eq!(of(table(Interpolation::Hold, false)), [(1.0, true), (1.5, true)]);
    let spline = Interpolation::Spline(TableEnds::Natural);
    assert_eq!(of(table(spline, false)), [(0.5, false), (2.0, false)]);
    for smooth in [step(0.1), ramp(0.1), SignalKind::Constant(2.0), table(spline, true)] {
        assert_eq!(of(smooth), []);
    }
    let both = until(&times(vec![step(0.0), ramp(0.0)]), 10.0);
    assert_eq!(both, [(0.2, false), (0.3, true), (0.7, false)]);
}

#[test]
fn tables_that_repeat_have_times_in_every_period() {
    let rows = vec![[0.1, 0.0], [0.2, 1.0], [0.4, 0.0]];
    let kind = SignalKind::Table { rows, interpolation: Interpolation::Hold, periodic: true };
    let all = times(vec![kind]);
    let found = until(&all, 100.0);
    // two times in each period of 0.3 s, because its end is the beginning of the next period
    assert!((660..=670).contains(&found.len()), "{}", found.len());
    for pair in found.windows(2) {
        let gap = pair[1].0 - pair[0].0;
        assert!((gap - 0.1).abs() < 1e-12 || (gap - 0.2).abs() < 1e-12, "{pair:?}");
    }
}

//! Signals: derivatives, classes of smoothness, and order of computation.

use mbs_core::inputs::SignalGraph;
use mbs_core::scene::{
    Curve, Interpolation, NamedSignal, SignalBreak, SignalId, SignalKind, Smoothness, TableEnds,
    signal_breaks, signal_order,
};
use mbs_testkit::Random;

/// Allowed relative difference of derivatives from central differences of step 1e-5: truncation is 1e-10 times third derivatives.
const AGREEMENT: f64 = 1e-7;

fn named(kinds: Vec<SignalKind<f64>>) -> Vec<NamedSignal<f64>> {
    let named = |(i, kind)| NamedSignal { name: format!("s{i}"), kind };
    kinds.into_iter().enumerate().map(named).collect()
}

fn of(list: &[usize]) -> Vec<SignalId> {
    list.iter().map(|i| SignalId::new(*i)).collect()
}

const ROWS: [[f64; 2]; 5] = [[-0.5, 0.3], [0.0, 0.0], [0.5, -0.2], [1.7, 1.1], [2.5, 0.3]];

fn table(interpolation: Interpolation, periodic: bool) -> SignalKind<f64> {
    SignalKind::Table { rows: ROWS.to_vec(), interpolation, periodic }
}

/// Signals of each kind, with products and curves of them. None has a jump.
fn every_kind() -> Vec<SignalKind<f64>> {
    let spline = Interpolation::Spline;
    vec![
        SignalKind::Constant(0.7),
        table(spline(TableEnds::Natural), false),
        table(spline(TableEnds::Level), false),
        table(spline(TableEnds::Natural), true),
        table(Interpolation::Linear, false),
        table(Interpolation::Linear, true),
        SignalKind::Sine { amplitude: 0.7, frequency: 0.5, phase: 0.3, offset: -0.2 },
        SignalKind::Chirp {
            amplitude: 0.4,
            frequency: 0.3,
            to_frequency: 1.1,
            duration: 1.4,
            phase: 0.6,
            offset: 0.1,
        },
        SignalKind::Ramp { rate: -0.8, start: 0.4, end: Some(1.6), rounding: 0.5 },
        SignalKind::Ramp { rate: 0.9, start: 0.7, end: None, rounding: 0.0 },
        SignalKind::Step { from: 0.2, to: -0.9, at: 0.3, rise: 1.3 },
        SignalKind::Sum { of: of(&[6, 7, 10]), factors: vec![0.5, -1.5, 2.0] },
        SignalKind::Product { of: of(&[6, 10, 7]) },
        SignalKind::Curve {
            of: SignalId::new(12),
            curve: Curve::Polynomial(vec![0.3, -1.0, 0.5, 2.0]),
        },
        SignalKind::Curve { of: SignalId::new(6), curve: Curve::Periodic(ROWS.to_vec()) },
        SignalKind::Clamp { of: SignalId::new(11), lower: -0.5, upper: 0.4 },
        SignalKind::Input { value: 1.25, unit: "N".into() },
        SignalKind::Product { of: of(&[16, 13, 13]) },
        SignalKind::LimitRatio { of: SignalId::new(11), lower: -0.5, upper: 0.4 },
    ]
}

#[test]
fn rates_and_accelerations_of_every_kind_are_difference_quotients() {
    let signals = named(every_kind());
    let graph = SignalGraph::new(&signals);
    let (mut random, h) = (Random(3), 1e-5);
    let mut compared = vec![0; signals.len()];
    for t in random.vector(300, 300, 1.5).iter().map(|x| x + 1.25) {
        let [before, now, after] = [t - h, t, t + h].map(|t| graph.values(t));
        for i in 0..signals.len() {
            let quotient = |k: usize| (after[i][k] - before[i][k]) / (2.0 * h);
            // a corner, or a jump of the acceleration, between the three times
            let bend = after[i][1] - 2.0 * now[i][1] + before[i][1];
            let jerk = after[i][2] - 2.0 * now[i][2] + before[i][2];
            if bend.abs() > 1e-6 || jerk.abs() > 1e-6 {
                continue;
            }
            compared[i] += 1;
            for k in [0, 1] {
                let (found, expected) = (now[i][k + 1], quotient(k));
                let allowed = AGREEMENT * (1.0 + expected.abs());
                let name = &signals[i].kind;
                assert!((found - expected).abs() < allowed, "{name:?} at {t}: {found} {expected}");
            }
        }
    }
    assert!(compared.iter().all(|n| *n > 250), "{compared:?}");
}

#[test]
fn a_step_rises_from_its_first_value_to_its_last_at_rest_at_both_ends() {
    let step = SignalKind::Step { from: 0.0, to: 1.0, at: 0.5, rise: 0.25 };
    let graph = SignalGraph::new(&named(vec![step]));
    assert_eq!(graph.values(0.5), [[0.0; 3]]);
    assert_eq!(graph.values(0.75), [[1.0, 0.0, 0.0]]);
    for (t, value) in [(0.5 + 1e-9, 0.0), (0.75 - 1e-9, 1.0)] {
        let [found, rate, acceleration] = graph.values(t)[0];
        // Value, rate and acceleration go with s^3, s^2 and s, where s = 4e-9 is the fraction of the rise. Terms of order ten have
        // rounding errors of 1e-15.
        assert!((found - value).abs() < 1e-14 && rate.abs() < 1e-12 && acceleration.abs() < 1e-4);
    }
    let [middle, rate, acceleration] = graph.values(0.625)[0];
    // the rate in the middle is 15/8 of the mean rate
    assert!((middle - 0.5).abs() < 1e-14 && (rate - 7.5).abs() < 1e-12, "{middle} {rate}");
    assert!(acceleration.abs() < 1e-9, "{acceleration}");
}

#[test]
fn a_rounded_ramp_has_the_values_of_the_sharp_one_beside_its_corners() {
    let ramp = |rounding| SignalKind::Ramp { rate: 2.0, start: 1.0, end: Some(3.0), rounding };
    let graph = SignalGraph::new(&named(vec![ramp(0.0), ramp(0.4)]));
    for t in [0.0, 0.8, 1.2, 2.0, 2.8, 3.2, 9.0] {
        let values = graph.values(t);
        assert!((values[0][0] - values[1][0]).abs() < 1e-14, "{t}: {values:?}");
    }
    assert!((graph.values(9.0)[1][0] - 4.0).abs() < 1e-14);
}

#[test]
fn signals_are_computed_in_an_order_of_their_own_and_each_once() {
    // each signal is the square of the next one: computed without memory, this would take 2^200 evaluations
    let n = 200;
    let square = |i: usize| SignalKind::Product { of: of(&[i + 1, i + 1]) };
    let mut kinds: Vec<_> = (0..n).map(square).collect();
    kinds.push(SignalKind::Constant(1.0));
    let values = SignalGraph::new(&named(kinds)).values(0.0);
    let bits = |value: [f64; 3]| value.map(f64::to_bits);
    assert!(values.iter().all(|value| bits(*value) == bits([1.0, 0.0, 0.0])));
}

#[test]
fn a_circle_is_found_and_nothing_else() {
    let sum = |list: &[usize]| SignalKind::Sum { of: of(list), factors: vec![1.0; list.len()] };
    let one = SignalKind::Constant(1.0);
    let signals = named(vec![sum(&[1, 4]), sum(&[2]), sum(&[4, 3]), sum(&[1]), one.clone()]);
    assert_eq!(signal_order(&signals), Err(vec![1, 2, 3]));
    let itself = named(vec![SignalKind::Product { of: of(&[0]) }]);
    assert_eq!(signal_order(&itself), Err(vec![0]));
    let right = named(vec![sum(&[1, 2]), sum(&[2]), one]);
    assert_eq!(signal_order(&right), Ok(vec![2, 1, 0]));
}

#[test]
fn a_signal_has_the_worst_class_of_what_it_is_made_of() {
    let step = |at, rise| SignalKind::Step { from: 0.0, to: 1.0, at, rise };
    let signals = named(vec![
        step(0.5, 0.0),
        step(0.5, 0.1),
        step(0.0, 0.0),
        table(Interpolation::Linear, false),
        table(Interpolation::Hold, false),
        SignalKind::Ramp { rate: 1.0, start: 0.0, end: Some(2.0), rounding: 0.0 },
        SignalKind::Clamp { of: SignalId::new(1), lower: 0.2, upper: 0.8 },
        SignalKind::Sum { of: of(&[1, 6, 0]), factors: vec![1.0; 3] },
        SignalKind::Product { of: of(&[1, 2]) },
        SignalKind::Input { value: 0.0, unit: String::new() },
    ]);
    let order = signal_order(&signals).expect("no circle");
    let breaks = signal_breaks(&signals, &order);
    use Smoothness::{Corner, Jump, Smooth};
    let classes = [Jump, Smooth, Smooth, Corner, Jump, Corner, Corner, Jump, Smooth, Jump];
    let found: Vec<_> = breaks.iter().map(|broken| SignalBreak::class(broken.as_ref())).collect();
    assert_eq!(found, classes);
    let what = |i: usize| breaks[i].map(|broken| (broken.signal.index(), broken.to_string()));
    assert_eq!(what(7), Some((0, "jumps at 0.5 s".into())));
    assert_eq!(what(6), Some((6, "has a corner".into())));
    assert_eq!(what(5), Some((5, "has a corner at 2 s".into())));
    assert_eq!(what(3), Some((3, "has a corner at 0.5 s".into())));
}

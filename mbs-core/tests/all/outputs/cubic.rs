//! Roots and sign changes of cubics with known closed forms.

use mbs_core::inside::outputs::{AT_START, Change, Cubic, Gap};

/// Rounding error of a bisected fraction of a step, and of a cubic of order one [-]: that of a few products.
const ROUNDING: f64 = 1e-15;
/// Half width of the band about zero in which events have no sign [-].
const BAND: f64 = 1e-9;

/// Cubic with the roots a, b, c, as fractions of a step of length `h` from time zero.
fn with_roots([a, b, c]: [f64; 3], h: f64) -> Cubic {
    let gap = |r: f64| {
        let rate = (r - b) * (r - c) + (r - a) * (r - c) + (r - a) * (r - b);
        Gap { value: (r - a) * (r - b) * (r - c), rate: rate / h }
    };
    Cubic::new([gap(0.0), gap(1.0)], h)
}

/// Cubic with these values, and derivatives by the fraction of the step, at both ends.
fn through(values: [f64; 2], rates: [f64; 2]) -> Cubic {
    Cubic::new([0, 1].map(|i| Gap { value: values[i], rate: rates[i] }), 1.0)
}

/// Checks that the first sign change of a cubic is near `share`. It is later by half the band divided by the slope.
#[track_caller]
fn changes_at(cubic: &Cubic, share: f64, slope: f64) {
    let change = cubic.change(BAND).expect("a change");
    let past = change.share - share;
    assert!(!change.lands, "{change:?}");
    assert!((past - 0.5 * BAND / slope).abs() < 10.0 * ROUNDING + 1e-6 * past, "{change:?}");
}

#[test]
fn the_root_of_a_cubic_is_exact_and_lies_within_the_step() {
    // g = (t - 0.3)(t^2 + 1) over a step of two units of time.
    let g = |t: f64| (t - 0.3) * (t * t + 1.0);
    let rate = |t: f64| t * t + 1.0 + 2.0 * t * (t - 0.3);
    let gaps = [-0.5, 1.5].map(|t| Gap { value: g(t), rate: rate(t) });
    let share = Cubic::new(gaps, 2.0).root(0.0, [0.0, 1.0]);
    assert!((share - 0.4).abs() < ROUNDING, "{share}");
    // Rates that no smooth motion has.
    let share = through([1.0, -1.0], [1e6, 1e6]).root(0.0, [0.0, 1.0]);
    assert!((0.0..=1.0).contains(&share));
}

#[test]
fn the_first_of_three_changes_is_reported_and_a_hair_onto_the_new_side() {
    for h in [1.0, 1e-3] {
        changes_at(&with_roots([0.2, 0.5, 0.9], h), 0.2, 0.3 * 0.7);
        changes_at(&with_roots([-0.2, 0.5, 0.9], h), 0.5, 0.7 * 0.4);
        changes_at(&with_roots([-2.0, 0.7, 3.0], h), 0.7, 2.7 * 2.3);
    }
}

#[test]
fn a_dip_between_ends_on_the_same_side_is_a_change_unless_the_band_hides_it() {
    // parabola (r - 1/2)^2 - depth
    let dip = |depth: f64| through([0.25 - depth; 2], [-1.0, 1.0]);
    for depth in [0.01, 1e-6, 1e-8, 1.1 * BAND] {
        let change = dip(depth).change(BAND).expect("a change");
        // The slope is 6e-5, so that a rounding error of 1/4 becomes 1e-12 of the fraction.
        let past = change.share - 0.5 + (depth - 0.5 * BAND).sqrt();
        assert!(past.abs() < 2e-12 && !change.lands, "{change:?}");
    }
    assert_eq!(dip(0.9 * BAND).change(BAND), None);
    assert_eq!(dip(-0.1).change(BAND), None);
    // A rise from negative values also changes.
    let rise = through([-0.2, -0.2], [1.0, -1.0]).change(BAND).expect("a change");
    assert!((rise.share - 0.5 + 0.05_f64.sqrt()).abs() < 1e-8, "{rise:?}");
}

#[test]
fn a_step_from_within_the_band_leaves_it_to_either_side_without_a_change() {
    for value in [-0.9, -0.1, 0.0, 0.1, 0.9].map(|share| share * BAND) {
        for rate in [-1.0, 1.0] {
            assert_eq!(through([value, rate], [rate, rate]).change(BAND), None, "{value} {rate}");
        }
        // A value at rest does not change.
        assert_eq!(through([value, -value], [0.0; 2]).change(BAND), None);
    }
}

#[test]
fn a_bounce_within_one_step_from_the_band_changes_where_it_leaves() {
    // parabola r (r - 0.6), from both sides of zero
    for value in [-1e-10, 1e-10] {
        changes_at(&through([value, 0.4 + value], [-0.6, 1.4]), 0.6 - value / 0.6, 0.6);
    }
}

#[test]
fn an_end_within_the_band_lands_unless_a_change_goes_before() {
    let landed = Some(Change { share: 1.0, lands: true });
    for value in [-0.9, 0.0, 0.9].map(|share| share * BAND) {
        assert_eq!(through([1.0, value], [-1.0, -1.0]).change(BAND), landed);
        assert_eq!(through([-1.0, value], [0.0, 3.0]).change(BAND), landed);
    }
    changes_at(&with_roots([-1.0, 0.3, 1.0], 1.0), 0.3, 1.3 * 0.7);
}

#[test]
fn an_end_just_short_of_a_change_asks_for_a_longer_step_and_one_far_short_does_not() {
    changes_at(&with_roots([-2.0, 1.03, 3.0], 1.0), 1.03, 3.03 * 1.97);
    assert_eq!(with_roots([-2.0, 1.06, 3.0], 1.0).change(BAND), None);
}

#[test]
fn a_change_at_the_start_is_one_of_the_step_before_and_the_next_is_reported() {
    assert_eq!(with_roots([-2.0, 0.5 * AT_START, 3.0], 1.0).change(BAND), None);
    changes_at(&with_roots([-2.0, 2.0 * AT_START, 3.0], 1.0), 2.0 * AT_START, 2.002 * 2.998);
    let share = 0.5 * AT_START;
    changes_at(&with_roots([share, 0.7, 3.0], 1.0), 0.7, (0.7 - share) * 2.3);
}

#[test]
fn what_is_not_a_number_ends_the_search() {
    for bad in [f64::NAN, f64::INFINITY] {
        for k in 0..4 {
            let mut x = [1.0, -1.0, 2.0, -3.0];
            x[k] = bad;
            let _ = through([x[0], x[1]], [x[2], x[3]]).change(BAND);
        }
    }
}

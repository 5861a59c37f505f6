//! Times of steps of equal length.

use mbs::inside::tested::StepClock;

#[test]
fn a_thousand_steps_of_a_millisecond_end_at_a_second() {
    let (mut clock, mut t) = (StepClock::default(), 0.0_f64);
    for _ in 0..1000 {
        t = clock.advance(t, (1e-3, 1e-3));
    }
    assert_eq!(t.to_bits(), 1f64.to_bits());
    t = clock.advance(t, (0.5, 0.5));
    assert_eq!(t.to_bits(), 1.5f64.to_bits());
}

//! Division of a period into steps.

use mbs::inside::tested::parts;

#[test]
fn a_period_is_cut_into_equal_steps_that_are_not_longer_than_the_step() {
    for (period, step, n) in [
        (1e-3, 1e-3, 1),
        (1e-2, 1e-3, 10),
        (0.3, 0.1, 3),
        (1e-3, 4e-4, 3),
        (1e-3, 5e-3, 1),
        (0.7, 0.07, 10),
    ] {
        assert_eq!(parts(period, step), n, "{period} of {step}");
    }
}

//! Noise in the times of trials.

use mbs_study::inside::TrialTimes;

#[test]
fn the_noise_is_the_distance_of_the_two_best() {
    let times = TrialTimes(vec![3.0, 2.0, 9.0, 2.5]);
    assert_eq!((times.best(), times.noise()), (Some(2.0), Some(0.25)));
    assert_eq!((TrialTimes::default().best(), TrialTimes(vec![1.0]).noise()), (None, None));
}

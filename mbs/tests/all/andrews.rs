//! Andrews' squeezing mechanism against its reference: seven angles, a point, and conserved quantities.
#![allow(
    clippy::print_stdout,
    clippy::excessive_precision,
    reason = "what is measured is shown with --nocapture; references keep their digits"
)]

use crate::common::{FORMULATIONS, distance, run_in, scene, with_fixed_steps, worst};

/// Names of the angles, which are channels of the scene.
const ANGLES: [&str; 7] = ["beta", "theta", "gamma", "phi", "delta", "omega", "epsilon"];
/// Angles at the start (test set, 30 digits) [rad].
const START: [f64; 7] = [
    -0.061_713_890_014_276_496_358_9,
    0.0,
    0.455_279_819_163_070_380_255_9,
    0.222_668_390_165_885_884_674_5,
    0.487_364_979_543_842_550_225_6,
    -0.222_668_390_165_885_884_674_5,
    1.230_547_444_549_821_192_497_4,
];
/// Angles at 0.03 s [rad], by extrapolation with 30 digits; two settings agree (benchmarks, section 1.2).
const END: [f64; 7] = [
    15.810_771_195_153_707_097,
    -15.756_371_058_411_839_470,
    0.040_822_240_119_645_804_858,
    -0.534_730_116_342_079_593_77,
    0.524_409_965_879_954_069_37,
    0.534_730_116_342_079_593_77,
    1.048_080_741_041_937_873_1,
];
/// Point F = 0.007 m (cos beta, sin beta) at 0.03 s [m].
const END_F: [f64; 2] = [-0.006_963_039_427_046_851_51, -0.000_718_388_430_719_101_908];

/// Errors of the angles, then of the point F, at the end of a run.
fn errors(formulation: &str, step: f64) -> [f64; 8] {
    let scene = scene("andrews");
    let outcome = run_in(&scene, formulation, Some(step));
    assert!(outcome.error.is_none(), "{formulation} {step}: {:?}", outcome.error);
    assert_eq!(scene.outputs.len(), 8, "seven angles and a point");
    for (output, name) in scene.outputs.iter().zip(ANGLES) {
        assert_eq!(output.name, name);
    }
    let (_, row) = outcome.rows().last().expect("the start is recorded");
    let mut errors = [distance([row[7], row[8]], END_F); 8];
    for i in 0..7 {
        errors[i] = (START[i] + row[i] - END[i]).abs();
    }
    errors
}

/// Ratio of the errors at a step and at half of it in a method of order 2. Terms of order 4 explain the difference from 4.
const SECOND_ORDER: core::ops::Range<f64> = 3.9..4.1;
/// Error constants c of the trapezoidal rule at 0.03 s [rad/s^2, m/s^2]: error = c dt^2. They are measured at 1e-5 s, with a margin of a
/// twentieth. All formulations use the same rule, so their constants are equal.
const LEVELS: [f64; 8] = [2.53e6, 3.16e6, 2.45e4, 4.29e4, 1.27e3, 4.29e4, 720.0, 1.77e4];

#[test]
fn andrews_angles_converge_with_order_2_to_the_reference() {
    for formulation in FORMULATIONS {
        let [coarse, fine] = [1e-5, 5e-6].map(|step| errors(formulation, step));
        for (i, name) in ANGLES.iter().chain(&["F"]).enumerate() {
            let (ratio, level) = (coarse[i] / fine[i], coarse[i] / 1e-10);
            println!(
                "andrews {formulation} {name}: {:.4e} -> {:.4e}, ratio {ratio:.3}, error / dt^2 = {level:.3e}",
                coarse[i], fine[i]
            );
            assert!(SECOND_ORDER.contains(&ratio), "{formulation} {name}: ratio {ratio}");
            assert!(level <= LEVELS[i], "{formulation} {name}: error / dt^2 = {level}");
        }
    }
}

/// Constant c of the largest energy error of the trapezoidal rule [J/s^2]: error = c dt^2. The constant is 8.1e5 in the limit, 8.5e5 at 1e-4
/// s.
const ENERGY_LEVEL: f64 = 8.6e5;
/// Largest asymmetry of the angles [rad]. The iteration stops at 1e-10 of the scene's length, which is about the length of the two links.
const SYMMETRY: f64 = 1e-10;

#[test]
fn andrews_keeps_its_energy_with_order_2_and_its_symmetry() {
    let scene = scene("andrews");
    for formulation in FORMULATIONS {
        let energy = [1e-4, 1e-5, 1e-6].map(|step| {
            let outcome = run_in(&scene, formulation, Some(step));
            assert!(outcome.error.is_none(), "{formulation} {step}: {:?}", outcome.error);
            // omega = -phi by symmetry: channels are measured from the start, which has the same symmetry
            let mut asymmetry = 0.0;
            for (_, row) in outcome.rows() {
                asymmetry = worst(asymmetry, (row[3] + row[5]).abs());
            }
            let error = outcome.summary.energy.max_error;
            println!("andrews {formulation} {step:e}: {error:.3e} J, omega + phi {asymmetry:.1e}");
            assert!(asymmetry <= SYMMETRY, "{formulation} {step}: {asymmetry:e}");
            assert!(error <= ENERGY_LEVEL * step * step, "{formulation} {step}: {error:e} J");
            error
        });
        for pair in energy.windows(2) {
            let order = (pair[0] / pair[1]).log10();
            assert!((order - 2.0).abs() < 0.05, "{formulation}: order {order}");
        }
    }
}

/// Error of beta at a step of 1e-6 s [rad]: twice the error of the trapezoidal rule.
const BETA_AT_1E_6: f64 = 5e-6;

#[test]
fn every_formulation_ends_at_the_reference_and_loses_energy_with_order_2() {
    let scene = scene("andrews");
    for formulation in with_fixed_steps() {
        let energy = [1e-4, 1e-5, 1e-6].map(|step| {
            let outcome = run_in(&scene, formulation, Some(step));
            assert!(outcome.error.is_none(), "{formulation} {step}: {:?}", outcome.error);
            outcome.summary.energy.max_error
        });
        let beta = errors(formulation, 1e-6)[0];
        println!("andrews {formulation}: {energy:?} J, beta off by {beta:.3e} rad");
        assert!(beta <= BETA_AT_1E_6, "{formulation}: beta off by {beta:e} rad");
        for pair in energy.windows(2) {
            let order = (pair[0] / pair[1]).log10();
            assert!((order - 2.0).abs() < 0.05, "{formulation}: order {order}");
        }
    }
}

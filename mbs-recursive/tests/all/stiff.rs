//! Stiff forces and mechanisms at rest: cases in which the iteration of a trapezoidal step converges with difficulty.

use crate::support::Run;
use core::f64::consts::PI;
use mbs_core::integrator::Integrator;
use mbs_core::scene::Scene;
use mbs_recursive::{Planar, Spatial};
use mbs_testkit::file;

#[test]
fn a_mechanism_that_comes_to_rest_stays_there() {
    // At 1.2 s the remaining motion is below the rounding of the coordinates.
    let mut run = Run::<Spatial>::new::<3>(&file("iltis-suspension"));
    for i in 0..3000 {
        run.step(1e-3).unwrap_or_else(|e| panic!("step {i}: {e}"));
    }
    let fastest = run.state.v.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    // Coordinates of order one are rounded to 2e-16. Divided by the step of 1e-3 s this is an error of 2e-13 in velocities.
    assert!(fastest < 1e-12, "{fastest}");
}

/// Returns masses on slides in a row, each on the slide of the preceding mass, with springs between them. The first spring is fixed to the
/// ground. For j = 1 to n, the frequencies are 2 √(k/m) sin((2 j − 1) π / (2 (2 n + 1))) [rad/s]. The modes are
/// sin((2 j − 1) π i / (2 n + 1)).
fn masses(n: usize) -> Scene<f64> {
    let mut text = String::from("[scene]\nname = \"masses\"\ndimension = 2\nduration = 1.0\n");
    for i in 0..n {
        let (x, mass) = (i as f64 + 1.0, MASS);
        let before = if i == 0 { "ground".to_owned() } else { format!("m{}", i - 1) };
        text += &format!(
            "[[body]]\nname = \"m{i}\"\nmass = {mass:?}\ncenter = [{x:?}, 0.0]\ninertia = 1.0\n\
             [[joint]]\nname = \"j{i}\"\nkind = \"prismatic\"\nbodies = [\"{before}\", \"m{i}\"]\nat = [{x:?}, 0.0]\naxis = [1.0, 0.0]\n\
             [[effect]]\nname = \"s{i}\"\nkind = \"spring-damper\"\nbodies = [\"{before}\", \"m{i}\"]\n\
             points = [[{:?}, 0.0], [{x:?}, 0.0]]\nstiffness = {STIFFNESS:?}\ndamping = 0.0\nfree_length = 1.0\n",
            x - 1.0
        );
    }
    mbs_testkit::scene(&text)
}

const MASS: f64 = 0.1;
const STIFFNESS: f64 = 1e6;

#[test]
fn a_stiff_chain_follows_the_trapezoidal_rule_s_own_phase_and_keeps_its_amplitude() {
    // In the fastest mode of ten masses the step is 5 / ω. The error of the plain iteration would grow by (5/2)² in each iteration.
    const N: usize = 10;
    let odd = (2 * N - 1) as f64 * PI / (2 * N + 1) as f64;
    let omega = 2.0 * (STIFFNESS / MASS).sqrt() * (0.5 * odd).sin();
    let (dt, amplitude) = (5.0 / omega, 1e-3);
    let mode = |i: usize| (odd * i as f64).sin();
    let mut run = Run::<Planar>::new::<2>(&masses(N));
    for i in 0..N {
        run.state.z[i] = amplitude * (mode(i + 1) - mode(i));
    }
    run.accelerate();
    // With this rule the phase of an oscillator advances by 2 atan(ω dt / 2) in each step.
    let turn = 2.0 * (0.5 * omega * dt).atan();
    for n in 1..=200 {
        let report = run.step(dt).unwrap_or_else(|e| panic!("step {n}: {e}"));
        // The tangent is exact for springs across joints. The first iteration computes the end of the step, and the second confirms it.
        assert!(report.iterations <= 3, "step {n}: {} iterations", report.iterations);
        for i in 0..N {
            let told = amplitude * (mode(i + 1) - mode(i)) * (turn * f64::from(n)).cos();
            // Each step may have an error of the tolerance 1e-10 times its displacement a dt²/2, which is 12.5 times the amplitude.
            let apart = (run.state.z[i] - told).abs() / amplitude;
            assert!(apart < 1e-10 * 25.0 * f64::from(n), "step {n}, mass {i}: {apart}");
        }
    }
}

#[test]
fn generalised_alpha_and_hht_damp_high_frequencies_by_their_closed_forms() {
    // For ω h → ∞ the amplification matrix of a step has the double eigenvalue −ρ, and the eigenvalue −s with s = αf / (1 − αf) (Chung and
    // Hulbert, 1993; Hilber, 1977). Here ω h is 3162. The neglected terms are 1e-7, and the rounding of a length of 1 m is about 1e-7 of
    // the smallest displacements.
    const LEVEL: f64 = 3e-6;
    let cases = [(Integrator::generalised_alpha(0.8), 0.8), (Integrator::hht(0.05), 0.95 / 1.05)];
    for (integrator, rho) in cases {
        let s = integrator.alpha_f / (1.0 - integrator.alpha_f);
        let mut run = Run::<Planar>::new::<2>(&masses(1));
        run.options.integrator = integrator;
        run.state.z[0] = 1e-7;
        run.accelerate();
        let mut places = vec![run.state.z[0]];
        for n in 1..=20 {
            run.step(1.0).unwrap_or_else(|e| panic!("step {n}: {e}"));
            places.push(run.state.z[0]);
        }
        for four in places.windows(4) {
            let told = (2.0 * rho + s) * four[2]
                + rho * (rho + 2.0 * s) * four[1]
                + rho * rho * s * four[0];
            let size = four.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            assert!((four[3] + told).abs() < LEVEL * size, "{integrator:?}: {four:?}");
        }
    }
}

/// Two free bodies with a spring between them, and no joint between the spring's attachment points.
const FREE_PAIR: &str = r#"
[scene]
name = "pair"
dimension = 2
duration = 1.0
[[body]]
name = "a"
mass = 3.0
center = [0.0, 0.0]
inertia = 1.0
[[body]]
name = "b"
mass = 1.0
center = [1.0, 0.0]
inertia = 1.0
[[effect]]
name = "spring"
kind = "spring-damper"
bodies = ["a", "b"]
points = [[0.0, 0.0], [1.0, 0.0]]
stiffness = 3.0e6
damping = 0.0
free_length = 1.0
"#;

#[test]
fn a_stiff_spring_between_bodies_without_a_joint_follows_the_rule_too() {
    // ω = √(k (1/m₁ + 1/m₂)) = 2000 rad/s, and the step is 20 / ω. The tangent treats each link separately, so that an iteration multiplies
    // the error by 0.98. Mixing of the iterates removes this slow direction.
    let (omega, dt, amplitude) = (2000.0_f64, 1e-2, 1e-4);
    let mut run = Run::<Planar>::new::<2>(&mbs_testkit::scene(FREE_PAIR));
    // The common centre of mass remains at rest. The coordinates of a free body are angle, x, y; the heavier body is first.
    let start = [run.state.z[1], run.state.z[4]];
    let shares = [-0.25 * amplitude, 0.75 * amplitude];
    (run.state.z[1], run.state.z[4]) = (start[0] + shares[0], start[1] + shares[1]);
    run.accelerate();
    let turn = 2.0 * (0.5 * omega * dt).atan();
    for n in 1..=200 {
        let report = run.step(dt).unwrap_or_else(|e| panic!("step {n}: {e}"));
        assert!(report.iterations <= 12, "step {n}: {} iterations", report.iterations);
        let now = [run.state.z[1], run.state.z[4]];
        for i in 0..2 {
            let told = shares[i] * (turn * f64::from(n)).cos();
            // Each step may have an error of the tolerance 1e-10 times its displacement a dt²/2, which is 200 times the amplitude.
            let apart = (now[i] - start[i] - told).abs() / amplitude;
            assert!(apart < 1e-10 * 400.0 * f64::from(n), "step {n}, body {i}: {apart}");
        }
    }
}

/// Runs ten periods of the slowest mode; the fastest mode has 13 times its frequency. A tolerance that is smaller by the factor 1e-3 must
/// reduce the error by the factor 1e-3.
#[test]
fn collocation_follows_the_slow_mode_of_a_stiff_chain_to_its_tolerance() {
    const N: usize = 10;
    let odd = PI / (2 * N + 1) as f64;
    let omega = 2.0 * (STIFFNESS / MASS).sqrt() * (0.5 * odd).sin();
    let mode = |i: usize| (odd * i as f64).sin();
    let off = |error: f64| {
        let mut run = Run::<Planar>::new::<2>(&masses(N));
        for i in 0..N {
            run.state.z[i] = 0.1 * (mode(i + 1) - mode(i));
        }
        run.accelerate();
        run.options.error = error;
        run.options.first_step = Some(1e-5);
        run.radau5(10.25 * 2.0 * PI / omega).expect("a run");
        // After a further quarter of a period all masses are at their positions of equilibrium.
        run.state.z.iter().fold(0.0_f64, |most, z| most.max(z.abs()))
    };
    let errors = [off(1e-6), off(1e-9)];
    assert!(errors[0] < 1e-4 && errors[1] < 1e-7, "{errors:?}");
}

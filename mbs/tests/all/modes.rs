//! Modes of the Bombardier Iltis: against an independent model, and against the motion that they predict.

use crate::common;

use mbs::augmented::{Options, Workspace, index3};
use mbs::core::Cliques;
use mbs::core::model::State;
use mbs::core::natural::NaturalModel;
use mbs::core::scene::{InitialTarget, Road};
use mbs::core::start::assemble;
use mbs::core::step::Step;
use mbs::linear::{Instant, Linear, LinearOptions, Saddle, linearise};
use mbs::sparse::{Indefinite, Multifrontal};
use mbs::{Modes, Place, Search, equilibrium_start};

/// Eigenvalues of pitch, bounce, and the two axle hops, in phase and out of phase. The vehicle is at rest on its tires and moves in its plane
/// of symmetry.
///
/// They are computed independently, with other coordinates and no constraints. The potential energy of chassis and axles is a function of
/// height, pitch and the angles of two A-arms. Its second differences give the stiffness, and Newton's method closes the loops of each
/// suspension, in double precision.
const IN_PLANE: [[f64; 2]; 4] = [
    [-3.774_606, 9.577_940],
    [-4.823_723, 11.004_927],
    [-29.076_241, 82.475_858],
    [-28.895_312, 83.179_151],
];

#[test]
fn modes_at_rest_are_those_of_an_independent_model_of_the_plane_of_symmetry() {
    let modes = Modes::new(&common::scene("iltis-equilibrium"), Place::Equilibrium, Search::Down)
        .expect("it rests and is linearised")
        .modes;
    for [real, imaginary] in IN_PLANE {
        let distance = |m: &mbs::Mode| (m.real - real).hypot(m.imaginary - imaginary);
        let near = modes.iter().map(distance).fold(f64::INFINITY, f64::min);
        let size = real.hypot(imaginary);
        println!("{real} + {imaginary} i: {:.1e} of it apart", near / size);
        // the limit covers two errors: second differences of the energy are accurate to 1e-4, and the reference assumes the arms' centres at
        // mid-length
        assert!(near < 1e-3 * size, "{real} + {imaginary} i is {near} away in {modes:?}");
    }
}

/// Solution z at time t of z'' + C z' + K z = 0. The start has z = 0 and the unit vector of one degree of freedom as z'.
fn response(linear: &Linear<f64>, freedom: usize, t: f64) -> Vec<f64> {
    let f = linear.n_freedoms;
    let rate = |y: &[f64]| {
        let force = |i: usize| -> f64 {
            (0..f)
                .map(|j| linear.stiffness[j * f + i] * y[j] + linear.damping[j * f + i] * y[f + j])
                .sum()
        };
        (0..2 * f).map(|i| if i < f { y[f + i] } else { -force(i - f) }).collect::<Vec<f64>>()
    };
    let plus = |y: &[f64], h: f64, k: &[f64]| -> Vec<f64> {
        y.iter().zip(k).map(|(y, k)| y + h * k).collect()
    };
    let mut y = vec![0.0; 2 * f];
    y[f + freedom] = 1.0;
    // the fastest mode has an eigenvalue of 91 1/s, so the error of order four is below 1e-9
    let steps = 2000;
    let h = t / f64::from(steps);
    for _ in 0..steps {
        let k1 = rate(&y);
        let k2 = rate(&plus(&y, 0.5 * h, &k1));
        let k3 = rate(&plus(&y, 0.5 * h, &k2));
        let k4 = rate(&plus(&y, h, &k3));
        for i in 0..2 * f {
            y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        }
    }
    y.truncate(f);
    y
}

/// Differences of coordinates between a disturbed and an undisturbed run are those of z'' + C z' + K z = 0.
///
/// The vehicle rolls freely with locked steering. The velocity of each of its ten degrees of freedom is disturbed, one at a time.
#[test]
fn a_rolling_vehicle_moves_as_its_linearisation_says() {
    // its wheels do not spin: no body rotates, and the coefficients are constant
    let mut scene = common::scene("iltis-bump-5");
    scene.road = Road::default();
    for initial in &mut scene.initials {
        if let InitialTarget::Body { velocity: Some((_, velocity)), .. } = &mut initial.target {
            *velocity = [20.0, 0.0, 0.0];
        }
    }
    let model = NaturalModel::<f64, 3>::new(&scene).expect("the scene has a model");
    let analyse = mbs::sparse::Options::default();
    let mut solver = Multifrontal::analyse(&model, analyse);
    let mut start = assemble(&scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver)
        .expect("start");
    equilibrium_start(&scene, &model, Search::Down, &mut solver, &mut start)
        .expect("it rests on its tires");

    let mut w = Workspace::new(&model, solver);
    let mut run = |mut s: State<f64>, (step, steps): (f64, u32)| {
        let size = Step { dt: step, length: model.length() };
        for _ in 0..steps {
            index3::step(&model, size, &Options::index3(), &mut s, &mut w)
                .expect("the vehicle rolls");
            s.t += step;
        }
        s
    };
    // cambered tires push the wheels apart: after some seconds the vehicle rolls uniformly
    let state = run(start.state, (1e-3, 4000));
    let mut scratch =
        mbs::linear::Workspace::new(&model, Indefinite::analyse(&Saddle::new(&model), analyse));
    let how = (Instant::Motion, &LinearOptions::default());
    let linear = linearise(&model, how, &state, &mut scratch).expect("regular");
    assert_eq!(linear.n_freedoms, 10);

    let t = 0.15;
    let n = model.n_unknowns();
    for freedom in 0..linear.n_freedoms {
        // the velocity is disturbed in both directions, so that the curvature of the dampers' curves has an effect of second order only
        let kicked = |kick: f64| {
            let mut s = state.clone();
            for (v, b) in s.v.iter_mut().zip(&linear.basis[freedom * n..]) {
                *v += kick * b;
            }
            s
        };
        let kick = 0.02;
        let mut moved = |step: f64| -> Vec<f64> {
            let steps = (step, (t / step).round() as u32);
            let (ahead, back) = (run(kicked(kick), steps).q, run(kicked(-kick), steps).q);
            ahead.iter().zip(&back).map(|(a, b)| (a - b) / (2.0 * kick)).collect()
        };
        // the first step uses the acceleration before the disturbance, which gives an error of first order; extrapolation removes it
        let (coarse, fine) = (moved(5e-4), moved(2.5e-4));
        let z = response(&linear, freedom, t);
        let (mut apart, mut size) = (0.0_f64, 0.0_f64);
        for i in 0..n {
            let predicted: f64 =
                z.iter().enumerate().map(|(j, z)| linear.basis[j * n + i] * z).sum();
            apart = apart.max((2.0 * fine[i] - coarse[i] - predicted).abs());
            size = size.max(predicted.abs());
        }
        println!("freedom {freedom}: {:.1e} of {size:.1e} apart", apart / size);
        // the remaining error is of second order: (omega h)^2 / 6 = 3e-4 of the fastest mode in each of its periods
        assert!(apart < 2e-4 * size, "freedom {freedom}: {apart:e} of {size:e}");
    }
}

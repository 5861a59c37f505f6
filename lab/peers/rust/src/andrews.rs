//! Andrews' squeezing mechanism in seven angles and six loop equations, as in Hairer and Wanner II, section VII.7.
//!
//! ```text
//! M(q) q'' + Gᵀ λ = f(q, q'),   G q'' + γ(q, q') = 0         q = (β, Θ, γ, Φ, δ, Ω, ε)
//! ```

use nalgebra::{SMatrix, SVector};

/// State at the start, from the test set for initial value problems: angles [rad].
pub const START: [f64; 7] = [
    -0.061_713_890_014_276_45,
    0.0,
    0.455_279_819_163_070_4,
    0.222_668_390_165_885_9,
    0.487_364_979_543_842_55,
    -0.222_668_390_165_885_9,
    1.230_547_444_549_821_2,
];
/// The angles at 0.03 s, by extrapolation with 30 digits [rad].
const END: [f64; 7] = [
    15.810_771_195_153_707,
    -15.756_371_058_411_84,
    0.040_822_240_119_645_8,
    -0.534_730_116_342_079_6,
    0.524_409_965_879_954_1,
    0.534_730_116_342_079_6,
    1.048_080_741_041_937_9,
];

// Masses [kg], moments of inertia [kg m2], lengths [m], spring [N/m, m], torque [N m], with the names of the test set.
const M: [f64; 7] = [0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498];
const I: [f64; 7] = [2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5];
const B: [f64; 2] = [-0.03635, 0.03273];
const C: [f64; 2] = [0.014, 0.072];
const STIFFNESS: f64 = 4530.0;
const FREE: f64 = 0.07785;
const TORQUE: f64 = 0.033;
const D: f64 = 0.028;
const DA: f64 = 0.0115;
const E: f64 = 0.02;
const EA: f64 = 0.01421;
const RR: f64 = 0.007;
const RA: f64 = 0.00092;
const SS: f64 = 0.035;
const SA: f64 = 0.01874;
const SB: f64 = 0.01043;
const SC: f64 = 0.018;
const SD: f64 = 0.02;
const TA: f64 = 0.02308;
const TB: f64 = 0.00916;
const U: f64 = 0.04;
const UA: f64 = 0.01228;
const UB: f64 = 0.00449;
const ZF: f64 = 0.02;
const ZT: f64 = 0.04;
const FA: f64 = 0.01421;

/// Number of correct digits: -log10 of the largest relative error of the seven angles.
#[must_use]
pub fn digits(q: &[f64]) -> f64 {
    let errors = q.iter().zip(END).map(|(q, end)| ((q - end) / end).abs());
    -errors.fold(0.0, f64::max).log10()
}

/// M(q). This is the mass matrix.
fn mass(q: &[f64]) -> SMatrix<f64, 7, 7> {
    let (ct, sp, so, a, b) = (q[1].cos(), q[3].sin(), q[5].sin(), E - EA, ZF - FA);
    let mut m = SMatrix::zeros();
    m[(0, 0)] = M[0] * RA * RA + M[1] * (RR * RR - 2.0 * DA * RR * ct + DA * DA) + I[0] + I[1];
    m[(1, 0)] = M[1] * (DA * DA - DA * RR * ct) + I[1];
    m[(1, 1)] = M[1] * DA * DA + I[1];
    m[(2, 2)] = M[2] * (SA * SA + SB * SB) + I[2];
    m[(3, 3)] = M[3] * a * a + I[3];
    m[(4, 3)] = M[3] * (a * a + ZT * a * sp) + I[3];
    m[(4, 4)] =
        M[3] * (ZT * ZT + 2.0 * ZT * a * sp + a * a) + M[4] * (TA * TA + TB * TB) + I[3] + I[4];
    m[(5, 5)] = M[5] * b * b + I[5];
    m[(6, 5)] = M[5] * (b * b - U * b * so) + I[5];
    m[(6, 6)] =
        M[5] * (b * b - 2.0 * U * b * so + U * U) + M[6] * (UA * UA + UB * UB) + I[5] + I[6];
    for (i, j) in [(0, 1), (3, 4), (5, 6)] {
        m[(i, j)] = m[(j, i)];
    }
    m
}

/// f(q, q'). These are the forces, with those that depend on velocities.
fn force(q: &[f64], v: &[f64]) -> SVector<f64, 7> {
    let (a, b) = (E - EA, ZF - FA);
    let (s, c) = q[2].sin_cos();
    let [x, y] = [SD * c + SC * s + B[0] - C[0], SD * s - SC * c + B[1] - C[1]];
    let length = x.hypot(y);
    let pull = -STIFFNESS * (length - FREE) / length;
    SVector::from([
        TORQUE - M[1] * DA * RR * v[1] * (v[1] + 2.0 * v[0]) * q[1].sin(),
        M[1] * DA * RR * v[0] * v[0] * q[1].sin(),
        pull * (x * (SC * c - SD * s) + y * (SD * c + SC * s)),
        M[3] * ZT * a * v[4] * v[4] * q[3].cos(),
        -M[3] * ZT * a * v[3] * (v[3] + 2.0 * v[4]) * q[3].cos(),
        -M[5] * U * b * v[6] * v[6] * q[5].cos(),
        M[5] * U * b * v[5] * (v[5] + 2.0 * v[6]) * q[5].cos(),
    ])
}

/// G and γ. These are the Jacobian of the loop equations, and the part of their second derivative that follows from velocities.
fn loops(q: &[f64], v: &[f64]) -> (SMatrix<f64, 6, 7>, SVector<f64, 6>) {
    let turned = |length: f64, angle: f64| {
        let (s, c) = angle.sin_cos();
        (length * s, length * c)
    };
    let ((s1, c1), (s2, c2)) = (turned(RR, q[0]), turned(D, q[0] + q[1]));
    let ((s3, c3), (s5, c5), (s7, c7)) = (turned(SS, q[2]), turned(ZT, q[4]), turned(U, q[6]));
    let ((s4, c4), (s6, c6)) = (turned(E, q[3] + q[4]), turned(ZF, q[5] + q[6]));
    let mut g = SMatrix::zeros();
    for r in [0, 2, 4] {
        (g[(r, 0)], g[(r, 1)]) = (s2 - s1, s2);
        (g[(r + 1, 0)], g[(r + 1, 1)]) = (c1 - c2, -c2);
    }
    (g[(0, 2)], g[(1, 2)]) = (-c3, -s3);
    (g[(2, 3)], g[(2, 4)], g[(3, 3)], g[(3, 4)]) = (-c4, s5 - c4, -s4, -s4 - c5);
    (g[(4, 5)], g[(4, 6)], g[(5, 5)], g[(5, 6)]) = (s6, s6 - c7, -c6, -c6 - s7);
    let square = |x: f64| x * x;
    let (w1, w2, w3, w4) = (square(v[0]), square(v[0] + v[1]), square(v[2]), square(v[3] + v[4]));
    let (w5, w6, w7) = (square(v[4]), square(v[5] + v[6]), square(v[6]));
    let (x, y) = (c2 * w2 - c1 * w1, s2 * w2 - s1 * w1);
    let bias = SVector::from([
        x + s3 * w3,
        y - c3 * w3,
        x + s4 * w4 + c5 * w5,
        y - c4 * w4 + s5 * w5,
        x + c6 * w6 + s7 * w7,
        y + s6 * w6 - c7 * w7,
    ]);
    (g, bias)
}

/// Accelerations and multipliers (q'', λ) of a state (q, q'); NaN where the equations are singular.
#[must_use]
pub fn accelerations(x: &[f64]) -> SVector<f64, 13> {
    let (q, v) = (&x[..7], &x[7..14]);
    let (g, bias) = loops(q, v);
    let mut matrix = SMatrix::<f64, 13, 13>::zeros();
    matrix.fixed_view_mut::<7, 7>(0, 0).copy_from(&mass(q));
    matrix.fixed_view_mut::<6, 7>(7, 0).copy_from(&g);
    matrix.fixed_view_mut::<7, 6>(0, 7).copy_from(&g.transpose());
    let mut rhs = SVector::<f64, 13>::zeros();
    rhs.fixed_rows_mut::<7>(0).copy_from(&force(q, v));
    rhs.fixed_rows_mut::<6>(7).copy_from(&-bias);
    matrix.lu().solve(&rhs).unwrap_or_else(|| SVector::from_element(f64::NAN))
}

/// The rate of change of the state (q, q').
pub fn rate(x: &[f64], y: &mut [f64]) {
    y[..7].copy_from_slice(&x[7..14]);
    y[7..14].copy_from_slice(&accelerations(x).as_slice()[..7]);
}

//! Motion of a frame by a rotation matrix, with rates by difference quotients. No formula of the library is used.

pub(super) use crate::common::cross as cross_of;
use crate::common::{cross, dot};
use std::f64::consts::TAU;

pub(super) type Vector = [f64; 3];
pub(super) type Matrix = [Vector; 3];

/// Sine with amplitude, frequency [Hz] and phase [rad].
#[derive(Debug, Clone, Copy)]
pub(super) struct Sine(pub(super) [f64; 3]);

impl Sine {
    pub(super) fn at(self, t: f64) -> f64 {
        let [amplitude, frequency, phase] = self.0;
        amplitude * (TAU * frequency * t + phase).sin()
    }
}

/// Motion by a translation and a rotation vector.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motion {
    pub(super) translation: [Sine; 3],
    pub(super) rotation: [Sine; 3],
}

pub(super) fn add(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] + b[i])
}

pub(super) fn minus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] - b[i])
}

pub(super) fn scaled(a: Vector, s: f64) -> Vector {
    a.map(|x| x * s)
}

pub(super) fn times(m: &Matrix, x: Vector) -> Vector {
    m.map(|row| dot(row, x))
}

pub(super) fn transposed(m: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[j][i]))
}

pub(super) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let columns = transposed(b);
    a.map(|row| columns.map(|column| dot(row, column)))
}

/// Rotation matrix of a rotation vector, by a unit quaternion.
pub(super) fn rotation(f: Vector) -> Matrix {
    let angle = dot(f, f).sqrt();
    let by = if angle > 0.0 { (0.5 * angle).sin() / angle } else { 0.5 };
    let (w, v) = ((0.5 * angle).cos(), scaled(f, by));
    let of = |x: Vector| {
        let t = scaled(cross(v, x), 2.0);
        add(x, add(scaled(t, w), cross(v, t)))
    };
    transposed(&[of([1.0, 0.0, 0.0]), of([0.0, 1.0, 0.0]), of([0.0, 0.0, 1.0])])
}

/// Rate of a function, by a difference quotient of eighth order. At rates of 60 rad/s its relative error is 1e-12.
pub(super) fn rate<const N: usize>(f: impl Fn(f64) -> [f64; N], t: f64) -> [f64; N] {
    let h = 5e-4;
    let mut sum = [0.0; N];
    for (k, weight) in
        [(1.0, 4.0 / 5.0), (2.0, -1.0 / 5.0), (3.0, 4.0 / 105.0), (4.0, -1.0 / 280.0)]
    {
        let [before, after] = [f(t - k * h), f(t + k * h)];
        for i in 0..N {
            sum[i] += weight * (after[i] - before[i]) / h;
        }
    }
    sum
}

impl Motion {
    pub(super) fn rotation_at(&self, t: f64) -> Matrix {
        rotation(self.rotation.map(|sine| sine.at(t)))
    }

    /// Position of a point that is at `x` relative to the frame's origin.
    pub(super) fn place(&self, x: Vector, t: f64) -> Vector {
        add(self.translation.map(|sine| sine.at(t)), times(&self.rotation_at(t), x))
    }

    /// Angular velocity, from the matrix R' Rᵀ.
    pub(super) fn spin(&self, t: f64) -> Vector {
        spin_of(|t| self.rotation_at(t), t)
    }
}

/// Angular velocity of a rotation matrix that is a function of time.
pub(super) fn spin_of(r: impl Fn(f64) -> Matrix, t: f64) -> Vector {
    let flat = |m: Matrix| [0, 1, 2, 3, 4, 5, 6, 7, 8].map(|i| m[i / 3][i % 3]);
    let d = rate(|t| flat(r(t)), t);
    let w =
        product(&[[d[0], d[1], d[2]], [d[3], d[4], d[5]], [d[6], d[7], d[8]]], &transposed(&r(t)));
    [w[2][1], w[0][2], w[1][0]]
}

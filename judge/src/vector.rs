//! Vectors, matrices and rotations of three-dimensional space.

/// Vector of three-dimensional space.
pub type Vector = [f64; 3];
/// A matrix, by rows.
pub type Matrix = [[f64; 3]; 3];
/// A quaternion (w, x, y, z).
pub type Quaternion = [f64; 4];

/// Vector of zeros.
pub const ZERO: Vector = [0.0; 3];
/// Unit matrix E.
pub const UNIT: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Sum a + b.
#[must_use]
pub fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Difference a - b.
#[must_use]
pub fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Product s a of a number and a vector.
#[must_use]
pub fn scale(s: f64, a: Vector) -> Vector {
    a.map(|x| s * x)
}

/// Scalar product a · b.
#[must_use]
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Vector product a × b.
#[must_use]
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Length |a|.
#[must_use]
pub fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// Unit vector a / |a|.
#[must_use]
pub fn unit(a: Vector) -> Vector {
    scale(1.0 / norm(a), a)
}

/// Two unit vectors that make a right-hand triple with the unit vector `a`.
#[must_use]
pub fn across(a: Vector) -> [Vector; 2] {
    let least = (0..3).min_by(|&i, &j| a[i].abs().total_cmp(&a[j].abs())).unwrap_or(0);
    let mut e = ZERO;
    e[least] = 1.0;
    let x = unit(cross(e, a));
    [x, cross(a, x)]
}

/// Product A v of a matrix and a vector.
#[must_use]
pub fn times(a: &Matrix, v: Vector) -> Vector {
    [dot(a[0], v), dot(a[1], v), dot(a[2], v)]
}

/// Product Aᵀ v of a transposed matrix and a vector.
#[must_use]
pub fn transposed_times(a: &Matrix, v: Vector) -> Vector {
    [0, 1, 2].map(|j| a[0][j] * v[0] + a[1][j] * v[1] + a[2][j] * v[2])
}

/// Product A B of two matrices.
#[must_use]
pub fn product(a: &Matrix, b: &Matrix) -> Matrix {
    a.map(|row| [0, 1, 2].map(|j| row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]))
}

/// Transposed matrix Aᵀ.
#[must_use]
pub fn transpose(a: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [a[0][i], a[1][i], a[2][i]])
}

/// Product p q of two quaternions.
#[must_use]
pub fn compose(p: Quaternion, q: Quaternion) -> Quaternion {
    [
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    ]
}

/// The quaternion scaled to length one.
#[must_use]
pub fn normalised(q: Quaternion) -> Quaternion {
    let n = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.map(|x| x / n)
}

/// The rotation matrix of a quaternion of any length.
#[must_use]
pub fn rotation(q: Quaternion) -> Matrix {
    let [w, x, y, z] = normalised(q);
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// The quaternion of a rotation vector.
#[must_use]
pub fn exponential(v: Vector) -> Quaternion {
    let angle = norm(v);
    let s = if angle < 1e-8 { 0.5 } else { (0.5 * angle).sin() / angle };
    [(0.5 * angle).cos(), s * v[0], s * v[1], s * v[2]]
}

/// The rotation vector of a quaternion, with an angle of π at most.
#[must_use]
pub fn logarithm(q: Quaternion) -> Vector {
    let mut q = normalised(q);
    if q[0] < 0.0 {
        q = q.map(|x| -x);
    }
    let v = [q[1], q[2], q[3]];
    let s = norm(v);
    if s < 1e-9 { scale(2.0, v) } else { scale(2.0 * s.atan2(q[0]) / s, v) }
}

/// The rotation vector of a quaternion that has followed a rotation continuously, with an angle below 2π.
#[must_use]
pub fn followed([w, v @ ..]: Quaternion) -> Vector {
    let sine = norm(v);
    // for a zero rotation the vector is 2 v
    let share = if sine > 0.0 { 2.0 * sine.atan2(w) / sine } else { 2.0 };
    v.map(|x| share * x)
}

/// The conjugate quaternion, which is the inverse rotation.
#[must_use]
pub fn conjugate(q: Quaternion) -> Quaternion {
    [q[0], -q[1], -q[2], -q[3]]
}

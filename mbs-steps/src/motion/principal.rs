//! Principal moments and axes of inertia, by Jacobi rotations of a symmetric 3 x 3 matrix.

/// Number of sweeps over the three off-diagonal entries [-]. Convergence is quadratic, so six sweeps already reach machine precision.
const ROUNDS: usize = 8;

/// Principal moments and principal axes of the inertia [xx, yy, zz, xy, yz, zx]; the axes are a right-handed orthonormal frame.
pub fn principal([xx, yy, zz, xy, yz, zx]: [f64; 6]) -> ([f64; 3], [[f64; 3]; 3]) {
    let mut a = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for (p, q) in (0..ROUNDS).flat_map(|_| [(0, 1), (0, 2), (1, 2)]) {
        if a[p][q] == 0.0 {
            continue;
        }
        // Tangent of the smaller angle that makes a[p][q] zero.
        let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
        let c = 1.0 / (t * t + 1.0).sqrt();
        let s = t * c;
        for row in &mut a {
            (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
        }
        for i in 0..3 {
            (a[p][i], a[q][i]) = (c * a[p][i] - s * a[q][i], s * a[p][i] + c * a[q][i]);
            (axes[p][i], axes[q][i]) =
                (c * axes[p][i] - s * axes[q][i], s * axes[p][i] + c * axes[q][i]);
        }
    }
    ([a[0][0], a[1][1], a[2][2]], axes)
}

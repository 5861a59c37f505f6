//! Thin shells on the surfaces of simple shapes, given by half lengths: their area, and their moments of inertia per unit of mass.

use core::f64::consts::PI;

/// Area of a shell [m²], and its moments of inertia per unit of mass [m²].
type Shell = (f64, [f64; 3]);

/// A tube with closed ends. The array has the area of the ends, and their moments per unit of mass across and along the axis.
fn closed([r, h]: [f64; 2], [area, across, along]: [f64; 3]) -> Shell {
    let tube = 4.0 * PI * r * h;
    let all = tube + area;
    let [tube, ends] = [tube / all, area / all];
    let across = tube * (r * r / 2.0 + h * h / 3.0) + ends * across;
    (all, [across, across, tube * r * r + ends * along])
}

/// The shell of a capsule: `r` is the radius, `h` half the length without the round ends.
pub(crate) fn capsule(r: f64, h: f64) -> Shell {
    let ball = 2.0 / 3.0 * r * r;
    closed([r, h], [4.0 * PI * r * r, ball + h * h + r * h, ball])
}

pub(crate) fn cylinder(r: f64, h: f64) -> Shell {
    closed([r, h], [2.0 * PI * r * r, r * r / 4.0 + h * h, r * r / 2.0])
}

pub(crate) fn cuboid(half: [f64; 3]) -> Shell {
    let [a, b, c] = half;
    let faces = [b * c, a * c, a * b];
    let all: f64 = faces.iter().sum();
    // The mean square of the coordinate, relative to the square of the half length, is one on the faces across the axis. On the other faces
    // it is a third.
    let square = |axis: usize| {
        let share = faces[axis] / all;
        half[axis] * half[axis] * (share + (1.0 - share) / 3.0)
    };
    let [x, y, z] = [0, 1, 2].map(square);
    (8.0 * all, [y + z, x + z, x + y])
}

/// The shell of an ellipsoid, by complete elliptic integrals.
///
/// Let Q = n1²/a² + n2²/b² + n3²/c² for the points n of the unit sphere. The area is then abc ∫ √Q, and ∫ x² dA is a² abc ∫ n1² √Q. Both
/// follow from the means ⟨⟩ over the sphere that Carlson's integrals give: R_F = ⟨Q^(-1/2)⟩ and R_D = 3 ⟨n_i² Q^(-3/2)⟩. The divergence
/// theorem for the fields n_i Q^(±1/2) e_i gives k_i = ⟨n_i² Q^(-1/2)⟩ = (R_F - R_D / (3 a_i²)) / 2, then ⟨√Q⟩ = Σ k_i / a_i² and ⟨n_i² √Q⟩
/// = (⟨√Q⟩ + k_i / a_i²) / 4.
pub(crate) fn ellipsoid(half: [f64; 3]) -> Shell {
    let inverse = half.map(|a| 1.0 / (a * a));
    let parts = [0, 1, 2].map(|i| {
        let [z, x, y] = [0, 1, 2].map(|k| inverse[(i + k) % 3]);
        let (first, second) = elliptic([x, y, z]);
        z * (first - z * second / 3.0) / 2.0
    });
    let mean: f64 = parts.iter().sum();
    let square = |i: usize| half[i] * half[i] * (1.0 + parts[i] / mean) / 4.0;
    let [x, y, z] = [0, 1, 2].map(square);
    (4.0 * PI * half.iter().product::<f64>() * mean, [y + z, x + z, x + y])
}

/// Carlson's integrals R_F and R_D of three positive numbers, by duplication. R_D has the third number twice.
fn elliptic(numbers: [f64; 3]) -> (f64, f64) {
    /// Spread of the numbers at which the duplication ends [-]. The errors of both integrals are of the order of its square.
    const SPREAD: f64 = 1.0e-9;
    let [mut x, mut y, mut z] = numbers;
    let (mut sum, mut factor) = (0.0, 1.0);
    loop {
        let mean = (x + y + 3.0 * z) / 5.0;
        let spread = [x, y, z].iter().fold(0.0, |most: f64, x| most.max((x - mean).abs()));
        if !(spread > SPREAD * mean) {
            let first = 1.0 / ((x + y + z) / 3.0).sqrt();
            return (first, 3.0 * sum + factor / (mean * mean.sqrt()));
        }
        let [a, b, c] = [x, y, z].map(f64::sqrt);
        let lambda = a * b + b * c + c * a;
        sum += factor / (c * (z + lambda));
        factor /= 4.0;
        [x, y, z] = [x, y, z].map(|x| (x + lambda) / 4.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The shell of an ellipsoid by a numerical quadrature over the sphere: Gauss-Legendre points along the axis, equal steps around it.
    fn by_points(half: [f64; 3]) -> Shell {
        /// Number of points along and around [-]: enough for fourteen digits of the ellipsoids in these tests.
        const N: usize = 400;
        let (mut area, mut squares) = (0.0, [0.0; 3]);
        // The points of Fejer's first rule are cosines of equal steps.
        for i in 0..N {
            let theta = (i as f64 + 0.5) * PI / N as f64;
            let weights = (1..=N / 2)
                .map(|j| 2.0 * (2.0 * j as f64 * theta).cos() / (4.0 * (j * j) as f64 - 1.0));
            let weight = 2.0 / N as f64 * (1.0 - weights.sum::<f64>());
            for k in 0..N {
                let phi = (k as f64 + 0.5) * 2.0 * PI / N as f64;
                let n = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
                let q: f64 = n.iter().zip(half).map(|(n, a)| (n / a) * (n / a)).sum();
                let part = weight * 2.0 * PI / N as f64 * half.iter().product::<f64>() * q.sqrt();
                area += part;
                for (square, (n, a)) in squares.iter_mut().zip(n.iter().zip(half)) {
                    *square += part * (n * a) * (n * a);
                }
            }
        }
        let [x, y, z] = squares.map(|square| square / area);
        (area, [y + z, x + z, x + y])
    }

    #[test]
    fn a_shell_of_an_ellipsoid_is_that_of_a_sum_over_its_points() {
        for half in [[0.3, 0.2, 0.1], [1.0, 1.0, 0.2], [2.0, 0.5, 0.5], [0.7, 0.7, 0.7]] {
            let (found, expected) = (ellipsoid(half), by_points(half));
            let all =
                [(found.0, expected.0)].into_iter().chain(found.1.into_iter().zip(expected.1));
            for (found, expected) in all {
                assert!((found / expected - 1.0).abs() < 1.0e-11, "{half:?}: {found} {expected}");
            }
        }
    }

    #[test]
    fn a_flat_ellipsoid_is_two_discs_and_a_thin_one_a_rod() {
        let (area, [x, y, z]) = ellipsoid([3.0, 3.0, 1.0e-7]);
        assert!((area / (18.0 * PI) - 1.0).abs() < 1.0e-12);
        assert!([x - 2.25, y - 2.25, z - 4.5].iter().all(|x| x.abs() < 1.0e-12));
        // A needle has a half circle as girth: area π² a b, mean square of the length a²/4.
        let (area, [x, y, z]) = ellipsoid([2.0, 1.0e-7, 1.0e-7]);
        assert!((area / (2.0e-7 * PI * PI) - 1.0).abs() < 1.0e-12);
        assert!(x < 1.0e-13 && [y, z].iter().all(|x| (x - 1.0).abs() < 1.0e-12));
    }
}

//! Vectors and rotations of space, for drafts.

/// A point or a direction.
pub type Point = [f64; 3];

/// Sum a + s b of vectors.
#[must_use]
pub fn plus(a: Point, s: f64, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] + s * b[i])
}

/// Returns the inner product a . b.
#[must_use]
pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns the cross product a x b.
#[must_use]
pub fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Returns the distance |a - b|.
#[must_use]
pub fn distance(a: Point, b: Point) -> f64 {
    let d = plus(a, -1.0, b);
    dot(d, d).sqrt()
}

/// A rotation, row by row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn(pub [Point; 3]);

impl Turn {
    /// Makes the rotation about an axis (of any length) by an angle [rad], by Rodrigues' formula.
    #[must_use]
    pub fn about(axis: Point, angle: f64) -> Self {
        let length = dot(axis, axis).sqrt();
        let n = axis.map(|x| x / length);
        let (s, c) = angle.sin_cos();
        let e = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        // column i is the image of the unit vector e_i
        let columns = e.map(|e| {
            let along = (1.0 - c) * dot(n, e);
            plus(plus(e.map(|x| c * x), s, cross(n, e)), along, n)
        });
        Self([0, 1, 2].map(|i| [0, 1, 2].map(|j| columns[j][i])))
    }

    /// Returns the rotated vector R x.
    #[must_use]
    pub fn of(&self, x: Point) -> Point {
        self.0.map(|row| dot(row, x))
    }

    /// Returns R J R^T for an inertia J = [xx, yy, zz, xy, yz, zx].
    #[must_use]
    pub fn of_inertia(&self, [xx, yy, zz, xy, yz, zx]: [f64; 6]) -> [f64; 6] {
        let j = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
        let entry = |a: usize, b: usize| dot(self.0[a], j.map(|row| dot(row, self.0[b])));
        [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_third_of_a_turn_about_the_diagonal_carries_x_to_y_and_inertia_with_it() {
        let turn = Turn::about([2.0, 2.0, 2.0], 2.0 * std::f64::consts::FRAC_PI_3);
        assert!(distance(turn.of([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]) < 1e-15);
        let turned = turn.of_inertia([1.0, 2.0, 3.0, 0.1, 0.2, 0.3]);
        for (a, b) in turned.iter().zip([3.0, 1.0, 2.0, 0.3, 0.1, 0.2]) {
            assert!((a - b).abs() < 1e-14, "{turned:?}");
        }
    }
}

//! Curves over one number, and the height of roads over x.

use crate::scene::{Curve, Feature, Spline};
use core::f64::consts::PI;

impl Spline {
    /// The natural cubic spline through points of increasing abscissae.
    #[must_use]
    pub fn natural(points: &[[f64; 2]]) -> Self {
        let n = points.len();
        let mut second = vec![0.0; n];
        // the second derivatives solve a tridiagonal system: forward elimination, then back substitution
        let (mut slope, mut known) = (vec![0.0; n], vec![0.0; n]);
        for i in 1..n.saturating_sub(1) {
            let [[t0, x0], [t1, x1], [t2, x2]] = [points[i - 1], points[i], points[i + 1]];
            let right = 6.0 * ((x2 - x1) / (t2 - t1) - (x1 - x0) / (t1 - t0));
            let pivot = 2.0 * (t2 - t0) - (t1 - t0) * slope[i - 1];
            slope[i] = (t2 - t1) / pivot;
            known[i] = (right - (t1 - t0) * known[i - 1]) / pivot;
        }
        for i in (1..n.saturating_sub(1)).rev() {
            second[i] = known[i] - slope[i] * second[i + 1];
        }
        Self { knots: points.iter().zip(second).map(|(p, s)| [p[0], p[1], s]).collect() }
    }

    /// The cubic spline through points of increasing abscissae, with zero slopes at both ends. It is the sum of the natural spline of the
    /// points and two splines with zero values and a curvature of one at one end. The factors of these two make both end slopes zero.
    #[must_use]
    pub fn level(points: &[[f64; 2]]) -> Self {
        let n = points.len();
        if n < 2 {
            return Self::natural(points);
        }
        let natural = Self::natural(points);
        let bent = [0, n - 1].map(|end| Self::bent(points, end));
        let ends = |s: &Self| [0, n - 1].map(|k| s.slope_at(k));
        let ([a, c], [b, d], right) = (ends(&bent[0]), ends(&bent[1]), ends(&natural));
        let det = a * d - b * c;
        let weights = [(b * right[1] - d * right[0]) / det, (c * right[0] - a * right[1]) / det];
        let mut knots = natural.knots;
        for (k, knot) in knots.iter_mut().enumerate() {
            knot[2] += weights[0] * bent[0].knots[k][2] + weights[1] * bent[1].knots[k][2];
        }
        Self { knots }
    }

    /// The periodic cubic spline through points of increasing abscissae: value, slope and curvature are equal at the first and the last
    /// point.
    #[must_use]
    pub fn periodic(points: &[[f64; 2]]) -> Self {
        let n = points.len();
        if n < 3 {
            return Self::natural(points);
        }
        let width = |i: usize| points[i % (n - 1) + 1][0] - points[i % (n - 1)][0];
        let rise = |i: usize| {
            let i = i % (n - 1);
            (points[i + 1][1] - points[i][1]) / width(i)
        };
        let mut second = vec![0.0; n];
        // Gauss-Seidel iteration, as in `bent`
        for _ in 0..200 {
            for i in 0..n - 1 {
                let before = i + n - 2;
                let [h0, h1] = [width(before), width(i)];
                let known = 6.0 * (rise(i) - rise(before));
                let beside = h0 * second[before % (n - 1)] + h1 * second[(i + 1) % (n - 1)];
                second[i] = (known - beside) / (2.0 * (h0 + h1));
            }
        }
        second[n - 1] = second[0];
        Self { knots: points.iter().zip(second).map(|(p, s)| [p[0], p[1], s]).collect() }
    }

    /// The spline of zero values with a second derivative of one at one end and of zero at the other.
    fn bent(points: &[[f64; 2]], end: usize) -> Self {
        let n = points.len();
        let mut second = vec![0.0; n];
        second[end] = 1.0;
        // Gauss-Seidel iteration: the matrix is diagonally dominant, so that each sweep at least halves the error
        for _ in 0..200 {
            for i in 1..n.saturating_sub(1) {
                let [h0, h1] = [points[i][0] - points[i - 1][0], points[i + 1][0] - points[i][0]];
                second[i] = -(h0 * second[i - 1] + h1 * second[i + 1]) / (2.0 * (h0 + h1));
            }
        }
        Self { knots: points.iter().zip(second).map(|(p, s)| [p[0], 0.0, s]).collect() }
    }

    /// Slope at a knot, of the interval within the table.
    pub(crate) fn slope_at(&self, k: usize) -> f64 {
        let i = k.max(1);
        let ([t0, x0, s0], [t1, x1, s1]) = (self.knots[i - 1], self.knots[i]);
        let h = t1 - t0;
        let rise = (x1 - x0) / h;
        if k == 0 { rise - h * (2.0 * s0 + s1) / 6.0 } else { rise + h * (s0 + 2.0 * s1) / 6.0 }
    }

    /// Value and two derivatives; constant outside the table.
    #[must_use]
    pub fn at(&self, t: f64) -> [f64; 3] {
        let (Some(first), Some(last)) = (self.knots.first(), self.knots.last()) else {
            return [0.0; 3];
        };
        if t < first[0] {
            return [first[1], 0.0, 0.0];
        }
        if t >= last[0] {
            return [last[1], 0.0, 0.0];
        }
        let i = self.knots.partition_point(|k| k[0] <= t).max(1);
        let ([t0, x0, s0], [t1, x1, s1]) = (self.knots[i - 1], self.knots[i]);
        let h = t1 - t0;
        let (a, b) = ((t1 - t) / h, (t - t0) / h);
        let value = a * x0 + b * x1 + ((a * a * a - a) * s0 + (b * b * b - b) * s1) * h * h / 6.0;
        let rate = (x1 - x0) / h + ((1.0 - 3.0 * a * a) * s0 + (3.0 * b * b - 1.0) * s1) * h / 6.0;
        [value, rate, a * s0 + b * s1]
    }
}

/// Returns the abscissa shifted by whole periods into the first one.
fn within(first: f64, last: f64, x: f64) -> f64 {
    first + (x - first).rem_euclid(last - first)
}

impl Curve {
    /// Value and two derivatives at an abscissa.
    #[must_use]
    pub fn at(&self, x: f64) -> [f64; 3] {
        match self {
            Self::Spline(spline) => spline.at(x),
            Self::Periodic(spline) => match spline.knots.as_slice() {
                [first, .., last] => spline.at(within(first[0], last[0], x)),
                _ => spline.at(x),
            },
            Self::Linear(rows, repeats) | Self::Hold(rows, repeats) => {
                let Some((first, last)) = rows.first().zip(rows.last()) else { return [0.0; 3] };
                let x = if *repeats { within(first[0], last[0], x) } else { x };
                let i = rows.partition_point(|row| row[0] <= x);
                if i == 0 {
                    return [first[1], 0.0, 0.0];
                }
                let (Some([x1, f1]), [x0, f0]) = (rows.get(i), rows[i - 1]) else {
                    return [last[1], 0.0, 0.0];
                };
                if matches!(self, Self::Hold(..)) {
                    return [f0, 0.0, 0.0];
                }
                let slope = (f1 - f0) / (x1 - x0);
                [f0 + slope * (x - x0), slope, 0.0]
            }
            Self::Polynomial(coefficients) => {
                let mut sum = [0.0; 3];
                for c in coefficients.iter().rev() {
                    sum = [sum[0] * x + c, sum[1] * x + sum[0], sum[2] * x + 2.0 * sum[1]];
                }
                sum
            }
        }
    }
}

/// Height of a road at x, with its first and second derivative.
pub(crate) fn height(features: &[Feature], x: f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for feature in features {
        let one = match feature {
            Feature::Flat(height) => [*height, 0.0, 0.0],
            Feature::Ramp(numbers) => ramp(numbers, x),
            Feature::Bump([start, length, amplitude]) => {
                let w = 2.0 * PI / length;
                if (*start..=start + length).contains(&x) {
                    let (s, c) = (w * (x - start)).sin_cos();
                    [amplitude * (1.0 - c), amplitude * w * s, amplitude * w * w * c]
                } else {
                    [0.0; 3]
                }
            }
            Feature::Table(spline) => spline.at(x),
        };
        sum.iter_mut().zip(one).for_each(|(a, b)| *a += b);
    }
    sum
}

/// A ramp of constant slope, height / (length - r), with parabolas of length r at both ends.
fn ramp(&[start, length, height, r]: &[f64; 4], x: f64) -> [f64; 3] {
    let (u, slope) = (x - start, height / (length - r));
    let bend = slope / r;
    if u <= 0.0 {
        [0.0; 3]
    } else if u < r {
        [0.5 * bend * u * u, bend * u, bend]
    } else if u <= length - r {
        [slope * (u - 0.5 * r), slope, 0.0]
    } else if u < length {
        let left = length - u;
        [height - 0.5 * bend * left * left, bend * left, -bend]
    } else {
        [height, 0.0, 0.0]
    }
}

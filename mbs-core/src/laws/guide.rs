//! Laws of guides: value, first and second derivative of a prescribed coordinate at a given time.
//!
//! ```text
//! sine    g(t) = A sin(2π f t + φ)
//! ramp    g(t) = r t
//! spline  cubic through (tᵢ, gᵢ), natural or level at both ends; the end values are held outside
//! ```
//!
//! A is the amplitude, f the frequency, φ the phase, r the rate, and (tᵢ, gᵢ) a row of the table.
//!
//! [`spline_curvatures`] or [`level_curvatures`] prepares a spline once. The caller provides the slice for the curvatures.

use crate::Real;

/// Value [rad or m], rate [per s] and acceleration [per s^2] of a guided coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GuideMotion<T> {
    /// Value g(t) of the coordinate.
    pub value: T,
    /// Rate dg/dt of the coordinate.
    pub rate: T,
    /// Acceleration d^2 g/dt^2 of the coordinate.
    pub acceleration: T,
}

/// Evaluates the sine `amplitude * sin(2 pi frequency t + phase)` [rad or m, Hz, rad].
pub fn sine<T: Real>(amplitude: T, frequency: T, phase: T, t: T) -> GuideMotion<T> {
    let omega = T::TWO * T::PI * frequency;
    let (sin, cos) = (omega * t + phase).sin_cos();
    GuideMotion {
        value: amplitude * sin,
        rate: amplitude * omega * cos,
        acceleration: -amplitude * omega * omega * sin,
    }
}

/// Evaluates the ramp `rate * t`.
pub fn ramp<T: Real>(rate: T, t: T) -> GuideMotion<T> {
    GuideMotion { value: rate * t, rate, acceleration: T::ZERO }
}

/// Writes the second derivatives of the natural cubic spline through the rows (time, value).
///
/// ```text
/// hᵢ₋₁ cᵢ₋₁ + 2 (hᵢ₋₁ + hᵢ) cᵢ + hᵢ cᵢ₊₁ = 6 ((gᵢ₊₁ − gᵢ)/hᵢ − (gᵢ − gᵢ₋₁)/hᵢ₋₁),   c₀ = cₙ = 0
/// ```
///
/// The time between rows i and i + 1 is hᵢ, and the second derivative at row i is cᵢ. Times must increase. Cost: one tridiagonal
/// elimination; no allocation.
///
/// # Panics
/// If `curvature` or `scratch` is not as long as `table`.
pub fn spline_curvatures<T: Real>(table: &[[T; 2]], curvature: &mut [T], scratch: &mut [T]) {
    begin(table, curvature, scratch);
    eliminate(table, curvature, scratch);
    for i in (1..table.len().saturating_sub(1)).rev() {
        let next = curvature[i + 1];
        curvature[i] -= scratch[i] * next;
    }
}

/// Writes the second derivatives of the cubic spline through the rows (time, value) that is at rest at both ends.
///
/// Between the ends the equations are those of [`spline_curvatures`]. At the ends, where the rate is zero:
///
/// ```text
/// 2 h₀ c₀ + h₀ c₁ = 6 (g₁ − g₀)/h₀,   hₙ₋₁ cₙ₋₁ + 2 hₙ₋₁ cₙ = −6 (gₙ − gₙ₋₁)/hₙ₋₁
/// ```
///
/// # Panics
/// If `curvature` or `scratch` is not as long as `table`.
pub fn level_curvatures<T: Real>(table: &[[T; 2]], curvature: &mut [T], scratch: &mut [T]) {
    begin(table, curvature, scratch);
    let n = table.len();
    if n < 2 {
        return;
    }
    let three = T::from_f64(3.0);
    let slope = |i: usize| {
        let [[t0, g0], [t1, g1]] = [table[i - 1], table[i]];
        ((g1 - g0) / (t1 - t0), t1 - t0)
    };
    let (first, h) = slope(1);
    scratch[0] = T::HALF;
    curvature[0] = three * first / h;
    eliminate(table, curvature, scratch);
    let (last, h) = slope(n - 1);
    let pivot = T::TWO - scratch[n - 2];
    curvature[n - 1] = -(T::TWO * three * last / h + curvature[n - 2]) / pivot;
    for i in (0..n - 1).rev() {
        let next = curvature[i + 1];
        curvature[i] -= scratch[i] * next;
    }
}

fn begin<T: Real>(table: &[[T; 2]], curvature: &mut [T], scratch: &mut [T]) {
    assert_eq!(curvature.len(), table.len(), "one curvature per row");
    assert_eq!(scratch.len(), table.len(), "one scratch number per row");
    curvature.fill(T::ZERO);
    scratch.fill(T::ZERO);
}

/// Eliminates the equations of the rows between the ends. Afterwards `scratch` has the upper coefficients, and `curvature` the
/// right-hand sides.
fn eliminate<T: Real>(table: &[[T; 2]], curvature: &mut [T], scratch: &mut [T]) {
    let six = T::from_f64(6.0);
    for i in 1..table.len().saturating_sub(1) {
        let [[t0, g0], [t1, g1], [t2, g2]] = [table[i - 1], table[i], table[i + 1]];
        let (h0, h1) = (t1 - t0, t2 - t1);
        let pivot = T::TWO * (h0 + h1) - h0 * scratch[i - 1];
        scratch[i] = h1 / pivot;
        curvature[i] = (six * ((g2 - g1) / h1 - (g1 - g0) / h0) - h0 * curvature[i - 1]) / pivot;
    }
}

/// Largest absolute rate of a spline: at a row, or between two rows where the curvature vanishes.
#[must_use]
pub fn largest_rate<T: Real>(table: &[[T; 2]], curvature: &[T]) -> T {
    let rate = |t| spline(table, curvature, t).rate.abs();
    let rows = table.iter().fold(T::ZERO, |most, row| most.max(rate(row[0])));
    table.windows(2).zip(curvature.windows(2)).fold(rows, |most, (rows, bend)| {
        let [c0, c1] = [bend[0], bend[1]];
        if c0 * c1 < T::ZERO {
            return most.max(rate(rows[0][0] + (rows[1][0] - rows[0][0]) * c0 / (c0 - c1)));
        }
        most
    })
}

/// Returns value, rate and acceleration of a smooth step between two values. The step begins at t = 0 and takes the time `rise`. If
/// `rise` is zero, it is a jump.
pub fn step<T: Real>([from, to]: [T; 2], (t, rise): (T, T)) -> [T; 3] {
    if t >= rise {
        return [to, T::ZERO, T::ZERO];
    }
    if t <= T::ZERO {
        return [from, T::ZERO, T::ZERO];
    }
    let number = T::from_f64;
    let (s, height) = (t / rise, to - from);
    let left = T::ONE - s;
    [
        from + height * (s * s * s * (number(10.0) - s * (number(15.0) - number(6.0) * s))),
        height * number(30.0) * s * s * left * left / rise,
        height * number(60.0) * s * left * (left - s) / (rise * rise),
    ]
}

/// Interpolates a vector linearly in a table; `row` gives time and vector of a row. Before the first and after the last row the end
/// value is held. The vector of an empty table is zero.
///
/// Cost: one binary search; no allocation.
#[inline]
pub fn linear<T: Real, R>(rows: &[R], row: impl Fn(&R) -> (T, [T; 3]), t: T) -> [T; 3] {
    let next = rows.partition_point(|r| row(r).0 <= t);
    let before = next.checked_sub(1).and_then(|i| rows.get(i)).map(&row);
    match (before, rows.get(next).map(&row)) {
        (Some((t0, [x0, y0, z0])), Some((t1, [x1, y1, z1]))) => {
            let s = (t - t0) / (t1 - t0);
            [x0 + (x1 - x0) * s, y0 + (y1 - y0) * s, z0 + (z1 - z0) * s]
        }
        (Some((_, held)), None) | (None, Some((_, held))) => held,
        (None, None) => [T::ZERO; 3],
    }
}

/// Evaluates the cubic spline with the given curvatures at `t`. Before the first and after the last row the end value is held, with
/// rate zero. An empty table gives zero, and a missing curvature counts as zero.
///
/// Cost: one binary search; no allocation.
pub fn spline<T: Real>(table: &[[T; 2]], curvature: &[T], t: T) -> GuideMotion<T> {
    let held = |value| GuideMotion { value, rate: T::ZERO, acceleration: T::ZERO };
    let (Some(first), Some(last)) = (table.first(), table.last()) else { return held(T::ZERO) };
    if t < first[0] || table.len() == 1 {
        return held(first[1]);
    }
    if t > last[0] {
        return held(last[1]);
    }
    let i = table.partition_point(|row| row[0] <= t).saturating_sub(1).min(table.len() - 2);
    let next = i + 1;
    let (Some(&[t0, g0]), Some(&[t1, g1])) = (table.get(i), table.get(next)) else {
        return held(last[1]);
    };
    let bend = |i: usize| curvature.get(i).copied().unwrap_or(T::ZERO);
    let (c0, c1, h) = (bend(i), bend(next), t1 - t0);
    let (a, b) = ((t1 - t) / h, (t - t0) / h);
    let sixth = T::ONE / T::from_f64(6.0);
    let three = T::from_f64(3.0);
    GuideMotion {
        value: a * g0 + b * g1 + ((a * a * a - a) * c0 + (b * b * b - b) * c1) * h * h * sixth,
        rate: (g1 - g0) / h
            + ((three * b * b - T::ONE) * c1 - (three * a * a - T::ONE) * c0) * h * sixth,
        acceleration: a * c0 + b * c1,
    }
}

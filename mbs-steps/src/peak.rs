//! Peaks of a signal between the steps of a run: the extremum of the polynomial through five neighbouring values.
//!
//! ```text
//! p(t) = x₁ + x[1,2] (t − t₁) + x[1,2,3] (t − t₁)(t − t₂)          through the three in the middle
//! l(t) = p(t) + x[0,1,2,3] ω(t),   ω(t) = (t − t₁)(t − t₂)(t − t₃)   and the first
//! r(t) = p(t) + x[1,2,3,4] ω(t)                                       and the last
//! q(t) = l(t) + x[0,1,2,3,4] ω(t) (t − t₀)                            all five
//! ```
//!
//! x₀ to x₄ are the five values at the times t₀ to t₄, and x[i,j,..] are their divided differences. The extremum of q is used only under
//! two conditions. First, l and r differ there by less than half of the height of q above the middle value. Second, q stays within the
//! straight lines through the first two values and through the last two values. At a jump or a kink the conditions fail, and the peak is
//! the value at a step.

/// Largest difference of the cubics l and r at a peak, relative to the height of the peak above the middle value [-].
const AGREED: f64 = 0.5;
/// Number of Newton iterations, which start at the extremum of the parabola p [-]. They converge quadratically.
const ITERATIONS: usize = 8;
/// Largest correction at which Newton's method ends, relative to a step [-]. The error of the value is proportional to its square.
const FOUND: f64 = 1e-8;

/// Returns time and value of the extremum close to the third of five values. Returns `None` if there is no extremum, or if the conditions
/// of this module fail.
pub fn turning_point(t: [f64; 5], x: [f64; 5]) -> Option<(f64, f64)> {
    let is_least = x[2] <= x[1] && x[2] <= x[3];
    let is_largest = x[2] >= x[1] && x[2] >= x[3];
    if is_least == is_largest {
        return None;
    }
    // A maximum of x is computed as a minimum of -x.
    let sign = if is_least { 1.0 } else { -1.0 };
    let h = (t[3] - t[1]) / 2.0;
    let (u, y) = (t.map(|one| (one - t[2]) / h), x.map(|one| sign * (one - x[2])));
    let lengths = [0, 1, 2, 3].map(|i| u[i + 1] - u[i]);
    if !lengths.into_iter().all(|length| length > 0.0) {
        return None;
    }
    let (at, value) = least(u, y)?;
    Some((t[2] + h * at, x[2] + sign * value))
}

/// Minimum of the polynomial through five points. The third point is the smallest one and is the origin of `u` and `y`.
fn least(u: [f64; 5], y: [f64; 5]) -> Option<(f64, f64)> {
    let slope = |i: usize, j: usize, (a, b): (f64, f64)| (b - a) / (u[j] - u[i]);
    let first = [0, 1, 2, 3].map(|i| slope(i, i + 1, (y[i], y[i + 1])));
    let second = [0, 1, 2].map(|i| slope(i, i + 2, (first[i], first[i + 1])));
    let third = [0, 1].map(|i| slope(i, i + 3, (second[i], second[i + 1])));
    let fourth = slope(0, 4, (third[0], third[1]));
    // With u₂ = 0:   ω = u (u − u₁)(u − u₃)
    let omega = |s: f64| s * (s - u[1]) * (s - u[3]);
    let rate_of_omega = |s: f64| (2.0 * s - u[1] - u[3]) * s + (s - u[1]) * (s - u[3]);
    let curve_of_omega = |s: f64| 6.0 * s - 2.0 * (u[1] + u[3]);
    let value = |s: f64| {
        let parabola = y[1] + (s - u[1]) * (first[1] + second[1] * s);
        parabola + omega(s) * (third[0] + fourth * (s - u[0]))
    };
    let rate = |s: f64| {
        let parabola = first[1] + second[1] * (2.0 * s - u[1]);
        parabola + rate_of_omega(s) * (third[0] + fourth * (s - u[0])) + omega(s) * fourth
    };
    let curve = |s: f64| {
        let cubic = curve_of_omega(s) * (third[0] + fourth * (s - u[0]));
        2.0 * second[1] + cubic + 2.0 * rate_of_omega(s) * fourth
    };
    let mut at = (u[1] - first[1] / second[1]) / 2.0;
    let mut is_found = false;
    for _ in 0..ITERATIONS {
        let correction = rate(at) / curve(at);
        at -= correction;
        is_found = correction.abs() <= FOUND;
        if is_found || !(u[1]..=u[3]).contains(&at) {
            break;
        }
    }
    let (beyond, apart) = (-value(at), ((third[1] - third[0]) * omega(at)).abs());
    let before = y[1] + first[0] * (at - u[1]);
    let after = y[3] + first[3] * (at - u[3]);
    let is_between = is_found && (u[1]..=u[3]).contains(&at) && curve(at) > 0.0;
    let is_justified = apart <= AGREED * beyond && -beyond >= before.max(after);
    (is_between && is_justified && beyond > 0.0).then_some((at, -beyond))
}

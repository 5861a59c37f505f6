//! Mass properties: what a rigid body can have.

use super::is_planar;
use super::vector::Place;
use crate::Real;
use crate::scene::{Body, Inertia, SceneError, SceneFault};

pub(super) fn check<T: Real>(body: &Body<T>, place: Place) -> Result<(), SceneError> {
    place.not_negative("mass", body.mass)?;
    place.vector("center", body.center)?;
    match body.inertia {
        Inertia::Rod { from, to } => place.apart("rod", [from, to]),
        Inertia::Planar(moment) => {
            if !is_planar(place.dimension) {
                return place.fault("inertia", SceneFault::WrongDimension);
            }
            place.finite("inertia", moment)?;
            if moment < T::ZERO {
                return place.fault("inertia", SceneFault::NegativeInertia(moment.to_f64()));
            }
            with_mass(body.mass, moment, place)
        }
        Inertia::Spatial(six) => {
            if is_planar(place.dimension) {
                return place.fault("inertia", SceneFault::WrongDimension);
            }
            for x in six {
                place.finite("inertia", x)?;
            }
            check_tensor(six, place)?;
            with_mass(body.mass, six.into_iter().fold(T::ZERO, |sum, x| sum + x.abs()), place)
        }
    }
}

fn with_mass<T: Real>(mass: T, inertia: T, place: Place) -> Result<(), SceneError> {
    if mass.is_zero() && !inertia.is_zero() {
        return place.fault("inertia", SceneFault::InertiaWithoutMass);
    }
    Ok(())
}

/// Principal moments: none negative, the largest at most the sum of the others.
///
/// Both to half the digits of `T`, relative to the largest entry: files carry tensors of turned rods and
/// plates rounded to eight or ten digits, and those are meant.
fn check_tensor<T: Real>(six: [T; 6], place: Place) -> Result<(), SceneError> {
    let size = six.into_iter().fold(T::ZERO, |size, x| size.max(x.abs()));
    if size.is_zero() {
        return Ok(());
    }
    let [least, middle, largest] = principal_moments(six.map(|x| x / size));
    let slack = T::EPSILON.sqrt();
    if least < -slack {
        return place.fault("inertia", SceneFault::NegativeInertia((least * size).to_f64()));
    }
    let sum = least + middle;
    if largest > sum + slack {
        let sides = [(largest * size).to_f64(), (sum * size).to_f64()];
        return place.fault("inertia", SceneFault::TriangleInequality(sides));
    }
    Ok(())
}

/// Eigenvalues of [xx, yy, zz, xy, yz, zx], ascending, by Jacobi rotations; diagonal input stays exact.
fn principal_moments<T: Real>([xx, yy, zz, xy, yz, zx]: [T; 6]) -> [T; 3] {
    let mut a = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    // cyclic Jacobi converges quadratically: six sweeps are more than 3x3 needs in any precision
    for _ in 0..6 {
        for (p, q) in [(0, 1), (1, 2), (0, 2)] {
            rotate(&mut a, p, q);
        }
    }
    let mut moments = [a[0][0], a[1][1], a[2][2]];
    for (i, j) in [(0, 1), (1, 2), (0, 1)] {
        if moments[i] > moments[j] {
            moments.swap(i, j);
        }
    }
    moments
}

/// Annihilates a[p][q]: A ← Jᵀ A J with tan θ the smaller root of t² + 2 τ t = 1, τ = (a_qq − a_pp)/(2 a_pq).
fn rotate<T: Real>(a: &mut [[T; 3]; 3], p: usize, q: usize) {
    if a[p][q].is_zero() {
        return;
    }
    let tau = (a[q][q] - a[p][p]) / (T::TWO * a[p][q]);
    let sign = if tau < T::ZERO { -T::ONE } else { T::ONE };
    let root =
        if tau.abs() > T::ONE / T::EPSILON { tau.abs() } else { (T::ONE + tau * tau).sqrt() };
    let t = sign / (tau.abs() + root);
    let c = T::ONE / (T::ONE + t * t).sqrt();
    let s = t * c;
    for k in 0..3 {
        let (kp, kq) = (a[k][p], a[k][q]);
        (a[k][p], a[k][q]) = (c * kp - s * kq, s * kp + c * kq);
    }
    for k in 0..3 {
        let (pk, qk) = (a[p][k], a[q][k]);
        (a[p][k], a[q][k]) = (c * pk - s * qk, s * pk + c * qk);
    }
    (a[p][q], a[q][p]) = (T::ZERO, T::ZERO);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_moments_of_a_turned_tensor_by_hand() {
        // diag(1, 3) turned by 45 degrees in the plane: [[2, 1], [1, 2]]
        let found = principal_moments([2.0, 2.0, 2.5, 1.0, 0.0, 0.0]);
        for (found, expected) in found.iter().zip([1.0, 2.5, 3.0]) {
            assert!((found - expected).abs() < 1.0e-15, "{found} {expected}");
        }
    }

    #[test]
    fn principal_moments_keep_trace_and_determinant() {
        let [xx, yy, zz, xy, yz, zx] = [3.0, 2.0, 4.0, 0.3, -0.7, 1.1];
        let [a, b, c] = principal_moments([xx, yy, zz, xy, yz, zx]);
        let det: f64 =
            xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
        assert!((a + b + c - 9.0_f64).abs() < 1.0e-14);
        assert!((a * b * c - det).abs() < 1.0e-13);
    }
}

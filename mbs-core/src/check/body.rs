//! Checks of mass properties. Bodies that are welded together count as one body.

use crate::Real;
use crate::algebra::Matrix;
use crate::cluster::{Clusters, mass_properties};
use crate::mechanism::Scene;
use crate::scene::place::{Place, is_planar};
use crate::scene::{Body, Entry, Inertia, SceneError, SceneFault};
use alloc::vec::Vec;
use core::mem::discriminant;

/// Checks the numbers of one body by itself, without the bodies welded to it.
pub(super) fn check<T: Real>(body: &Body<T>, place: Place) -> Result<(), SceneError> {
    place.not_negative("mass", body.mass)?;
    if let Some(scale) = body.gravity_scale {
        place.finite("gravity_scale", scale)?;
    }
    place.vector(if body.is_point() { "point" } else { "center" }, body.center)?;
    let (is_fitting, numbers) = match &body.inertia {
        Inertia::Rod { from, to } => return place.apart("rod", [*from, *to]),
        Inertia::Point => return Ok(()),
        Inertia::Planar(moment) => (is_planar(place.dimension), core::slice::from_ref(moment)),
        Inertia::Spatial(six) => (!is_planar(place.dimension), &six[..]),
    };
    if !is_fitting {
        return place.fault("inertia", SceneFault::WrongDimension);
    }
    numbers.iter().try_for_each(|x| place.finite("inertia", *x))
}

/// Checks the summed inertias of bodies that are welded together. A single body may have an impossible inertia if the sum is possible.
/// Bodies welded to the ground do not move and are not checked.
pub(super) fn check_lumps<T: Real>(scene: &Scene<T>) -> Result<(), SceneError> {
    for cluster in Clusters::new(scene).clusters {
        let Err(fault) = properties(scene, cluster.mass, &cluster.inertia) else { continue };
        let is_same =
            |b: &usize| part(scene, *b).is_err_and(|f| discriminant(&f) == discriminant(&fault));
        let body = cluster.bodies.iter().copied().find(is_same).unwrap_or(cluster.bodies[0]);
        return scene.place(Entry::Body(body)).fault("inertia", fault);
    }
    Ok(())
}

/// Bodies with an impossible inertia, or with an inertia but no mass.
pub(super) fn odd_parts<T: Real>(scene: &Scene<T>) -> Vec<(usize, SceneFault)> {
    (0..scene.bodies.len()).filter_map(|b| part(scene, b).err().map(|fault| (b, fault))).collect()
}

/// Checks the inertia of one body by itself.
fn part<T: Real>(scene: &Scene<T>, body: usize) -> Result<(), SceneFault> {
    let (mass, _, inertia) = mass_properties(scene, body);
    properties(scene, mass, &inertia)
}

fn properties<T: Real>(
    scene: &Scene<T>,
    mass: T,
    inertia: &Matrix<T, 3>,
) -> Result<(), SceneFault> {
    let about_z = inertia[(2, 2)];
    let is_zero = if is_planar(scene.dimension) {
        if about_z < T::ZERO {
            return Err(SceneFault::NegativeInertia(about_z.to_f64()));
        }
        about_z.is_zero()
    } else {
        let entries = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];
        check_tensor(entries.map(|entry| inertia[entry]))?;
        inertia.iter().all(|x| x.is_zero())
    };
    if mass.is_zero() && !is_zero { Err(SceneFault::InertiaWithoutMass) } else { Ok(()) }
}

/// Checks the principal moments: none is negative, and the largest is at most the sum of the others.
///
/// The tolerance is half the digits of `T`, relative to the largest entry. Files contain tensors of rods and plates that were rounded to
/// eight or ten digits, and these must pass.
fn check_tensor<T: Real>(six: [T; 6]) -> Result<(), SceneFault> {
    let size = six.into_iter().fold(T::ZERO, |size, x| size.max(x.abs()));
    if size.is_zero() {
        return Ok(());
    }
    let [least, middle, largest] = principal_moments(six.map(|x| x / size));
    let slack = T::EPSILON.sqrt();
    if least < -slack {
        return Err(SceneFault::NegativeInertia((least * size).to_f64()));
    }
    let sum = least + middle;
    if largest > sum + slack {
        let sides = [(largest * size).to_f64(), (sum * size).to_f64()];
        return Err(SceneFault::TriangleInequality(sides));
    }
    Ok(())
}

/// Eigenvalues of a symmetric matrix in ascending order, by Jacobi rotations. The matrix is given by [xx, yy, zz, xy, yz, zx]. Diagonal
/// matrices stay exact.
pub fn principal_moments<T: Real>([xx, yy, zz, xy, yz, zx]: [T; 6]) -> [T; 3] {
    let mut a = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    // cyclic Jacobi rotations converge quadratically: six sweeps are enough for 3 x 3 matrices in any precision
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

/// Annihilates a[p][q] by A ← Jᵀ A J, with J the rotation by θ in the plane of p and q.
///
/// tan θ is the smaller root of t² + 2 τ t = 1, where τ = (a_qq − a_pp)/(2 a_pq).
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

//! Mass, centre of mass and inertia of a body, for every form of the data.

use crate::Real;
use crate::algebra::{Matrix, Vector};
use crate::scene::{Body, Inertia};

impl<T: Real> Body<T> {
    /// Mass on which gravity acts [kg].
    pub(crate) fn gravitational_mass(&self) -> T {
        self.gravity_scale.map_or(self.mass, |scale| self.mass * scale)
    }

    /// Mass [kg], centre of mass [m], and inertia about the centre of mass [kg m^2].
    pub(crate) fn mass_properties(&self) -> (T, Vector<T, 3>, Matrix<T, 3>) {
        let center = Vector::from(self.center);
        let mut inertia = Matrix::<T, 3>::zeros();
        match self.inertia {
            Inertia::Point => {}
            Inertia::Planar(i) => inertia[(2, 2)] = i,
            Inertia::Spatial([xx, yy, zz, xy, yz, zx]) => {
                inertia = Matrix::<T, 3>::new(xx, xy, zx, xy, yy, yz, zx, yz, zz);
            }
            Inertia::Rod { from, to } => {
                let (from, to) = (Vector::from(from), Vector::from(to));
                let d = to - from;
                inertia = steiner(self.mass / T::from_f64(12.0), &d);
                return (self.mass, (from + to) * T::HALF, inertia);
            }
        }
        (self.mass, center, inertia)
    }
}

/// Inertia of a point mass at the offset d: m (d.d 1 - d d^T) (parallel axis theorem).
pub(crate) fn steiner<T: Real>(mass: T, d: &Vector<T, 3>) -> Matrix<T, 3> {
    (Matrix::<T, 3>::identity() * d.dot(d) - d * d.transpose()) * mass
}

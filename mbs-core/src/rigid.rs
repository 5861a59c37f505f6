//! Motion of a rigid body relative to its reference configuration.

use crate::Real;
use crate::algebra::{Matrix, Vector, cross};

/// Position, velocity and acceleration of a body. Planar bodies move in x and y and turn about z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidMotion<T: Real> {
    /// Position of a material point of the body in the reference configuration [m].
    pub origin: Vector<T, 3>,
    /// Present position of this material point [m].
    pub position: Vector<T, 3>,
    /// Rotation from the reference configuration: its columns are the present directions of the body-fixed axes that coincide with the
    /// global axes in the reference configuration.
    pub rotation: Matrix<T, 3>,
    /// Angular velocity in global axes [rad/s].
    pub omega: Vector<T, 3>,
    /// Velocity of the material point [m/s].
    pub velocity: Vector<T, 3>,
    /// Angular acceleration in global axes [rad/s^2].
    pub angular_acceleration: Vector<T, 3>,
    /// Acceleration of the material point [m/s^2].
    pub acceleration: Vector<T, 3>,
}

impl<T: Real> RigidMotion<T> {
    /// Motion without velocity, in the reference configuration.
    #[must_use]
    pub fn at_rest(origin: Vector<T, 3>) -> Self {
        let zero = Vector::<T, 3>::zeros();
        Self {
            origin,
            position: origin,
            rotation: Matrix::<T, 3>::identity(),
            omega: zero,
            velocity: zero,
            angular_acceleration: zero,
            acceleration: zero,
        }
    }

    /// Position, velocity and acceleration of the material point with reference position `reference` [m, m/s, m/s^2].
    #[must_use]
    pub fn point(&self, reference: &Vector<T, 3>) -> [Vector<T, 3>; 3] {
        let [arm, rate, acceleration] = self.direction(&(reference - self.origin));
        [self.position + arm, self.velocity + rate, self.acceleration + acceleration]
    }

    /// Present value of the body-fixed vector that was `reference` in the reference configuration, and its two time derivatives.
    #[must_use]
    pub fn direction(&self, reference: &Vector<T, 3>) -> [Vector<T, 3>; 3] {
        let u = self.rotation * reference;
        let rate = cross(&self.omega, &u);
        [u, rate, cross(&self.angular_acceleration, &u) + cross(&self.omega, &rate)]
    }
}

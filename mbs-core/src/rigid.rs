//! The motion of a rigid body, against the reference configuration.

use crate::Real;
use crate::algebra::{Matrix, Vector, cross};

/// Position, velocity and acceleration of a body. Planar bodies use x, y and the turning about z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidMotion<T: Real> {
    /// A material point, in the reference configuration [m].
    pub origin: Vector<T, 3>,
    /// Present position of that point [m].
    pub position: Vector<T, 3>,
    /// Rotation from the reference configuration: its columns are the present directions of what were the global axes.
    pub rotation: Matrix<T, 3>,
    /// Angular velocity, global axes [rad/s].
    pub omega: Vector<T, 3>,
    /// Velocity of the material point [m/s].
    pub velocity: Vector<T, 3>,
    /// Angular acceleration, global axes [rad/s^2].
    pub angular_acceleration: Vector<T, 3>,
    /// Acceleration of the material point [m/s^2].
    pub acceleration: Vector<T, 3>,
}

impl<T: Real> RigidMotion<T> {
    /// At rest in the reference configuration.
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

    /// Position, velocity and acceleration of the material point that was at `reference` [m, m/s, m/s^2].
    #[must_use]
    pub fn point(&self, reference: &Vector<T, 3>) -> [Vector<T, 3>; 3] {
        let [arm, rate, acceleration] = self.direction(&(reference - self.origin));
        [self.position + arm, self.velocity + rate, self.acceleration + acceleration]
    }

    /// Present value of the body-fixed direction that was `reference`, and its two derivatives.
    #[must_use]
    pub fn direction(&self, reference: &Vector<T, 3>) -> [Vector<T, 3>; 3] {
        let u = self.rotation * reference;
        let rate = cross(&self.omega, &u);
        [u, rate, cross(&self.angular_acceleration, &u) + cross(&self.omega, &rate)]
    }
}

//! Values read from a simulation: plain arrays, in SI units and global axes.

use core::fmt::{self, Debug, Formatter};
use core::ops::Deref;
use mbs_core::Real;
use mbs_core::algebra::Matrix;
use mbs_core::control::Accepted;
pub use mbs_core::laws::code::Wrench;
use mbs_core::outputs::Instant;
use mbs_core::scene::EffectId;

/// Coordinates of a joint, at most six [rad, m].
#[derive(Clone, Copy, PartialEq, Default)]
pub struct Coordinates {
    values: [f64; 6],
    count: usize,
}

impl Coordinates {
    /// Creates coordinates from the given values; values after the sixth are dropped.
    pub fn new(from: impl IntoIterator<Item = f64>) -> Self {
        let mut coordinates = Self::default();
        for (to, value) in coordinates.values.iter_mut().zip(from) {
            *to = value;
            coordinates.count += 1;
        }
        coordinates
    }
}

impl Debug for Coordinates {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        (**self).fmt(f)
    }
}

/// Converts an array; more than six values are a compile error.
impl<const N: usize> From<[f64; N]> for Coordinates {
    fn from(values: [f64; N]) -> Self {
        const { assert!(N <= 6, "a joint has six coordinates at most") }
        Self::new(values)
    }
}

impl From<f64> for Coordinates {
    fn from(value: f64) -> Self {
        Self::new([value])
    }
}

impl Deref for Coordinates {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values[..self.count]
    }
}

/// Components of an output, at most six values.
pub type Components = Coordinates;

/// Pose of a body: its centre of mass and its rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Pose {
    /// Centre of mass [m].
    pub position: [f64; 3],
    /// Rotation matrix relative to the reference configuration, by rows. Its columns are the current directions of the body axes that
    /// coincided with the global axes x, y and z there.
    pub rotation: [[f64; 3]; 3],
}

/// Converts a matrix to arrays, row by row.
pub fn rows<T: Real>(matrix: &Matrix<T, 3>) -> [[f64; 3]; 3] {
    core::array::from_fn(|i| core::array::from_fn(|j| matrix[(i, j)].to_f64()))
}

impl Default for Pose {
    fn default() -> Self {
        let rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Self { position: [0.0; 3], rotation }
    }
}

impl Pose {
    /// The rotation as a unit quaternion [w, x, y, z] with w >= 0.
    #[must_use]
    pub fn quaternion(&self) -> [f64; 4] {
        let r = &self.rotation;
        // Method of Shepperd: the computation starts from the largest of the four components, so that no division by a small number occurs.
        let trace = r[0][0] + r[1][1] + r[2][2];
        let squares = [trace, r[0][0], r[1][1], r[2][2]];
        let largest = (0..4).max_by(|&a, &b| squares[a].total_cmp(&squares[b])).unwrap_or(0);
        let mut q = match largest {
            0 => [1.0 + trace, r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]],
            1 => {
                let x = 1.0 + 2.0 * r[0][0] - trace;
                [r[2][1] - r[1][2], x, r[0][1] + r[1][0], r[0][2] + r[2][0]]
            }
            2 => {
                let y = 1.0 + 2.0 * r[1][1] - trace;
                [r[0][2] - r[2][0], r[0][1] + r[1][0], y, r[1][2] + r[2][1]]
            }
            _ => {
                let z = 1.0 + 2.0 * r[2][2] - trace;
                [r[1][0] - r[0][1], r[0][2] + r[2][0], r[1][2] + r[2][1], z]
            }
        };
        let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        let sign = if q[0] < 0.0 { -norm } else { norm };
        q.iter_mut().for_each(|x| *x /= sign);
        q
    }
}

/// Motion of a body, by its velocities and accelerations.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct BodyMotion {
    /// Velocity of the centre of mass [m/s].
    pub velocity: [f64; 3],
    /// Acceleration of the centre of mass [m/s^2].
    pub acceleration: [f64; 3],
    /// Angular velocity of the body [rad/s].
    pub angular_velocity: [f64; 3],
    /// Angular acceleration of the body [rad/s^2].
    pub angular_acceleration: [f64; 3],
}

/// Motion of a material point: its position, velocity and acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PointMotion {
    /// Position of the point [m].
    pub position: [f64; 3],
    /// Velocity of the point [m/s].
    pub velocity: [f64; 3],
    /// Acceleration of the point [m/s^2].
    pub acceleration: [f64; 3],
}

/// A contact of a unilateral effect that begins or ends.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ContactEvent {
    /// Time of the event [s].
    pub time: f64,
    /// Effect that makes the contact: a bumper, a limit or a tire.
    pub effect: EffectId,
    /// End of a limit: 0 for the lower end, 1 for the upper end. Other effects have 0.
    pub end: usize,
    /// True if the contact begins, false if it ends.
    pub is_made: bool,
}

impl ContactEvent {
    pub fn of(instant: &Instant) -> Self {
        let &Instant { t: time, effect, end, makes: is_made } = instant;
        Self { time, effect: EffectId::new(effect), end, is_made }
    }
}

/// Energies of a mechanism [J].
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Energies {
    /// Kinetic energy of the mechanism.
    pub kinetic: f64,
    /// Potential energy of gravity and springs.
    pub potential: f64,
    /// Work of dampers, guides and inputs since the start.
    pub work: f64,
}

/// Sizes of the model that makes the steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Sizes {
    /// Number of coordinates of the mechanism.
    pub coordinates: usize,
    /// Number of constraint equations.
    pub constraints: usize,
    /// Rank of the constraint equations at the start.
    pub rank: usize,
}

impl Sizes {
    /// Returns the number of degrees of freedom.
    #[must_use]
    pub fn freedoms(&self) -> usize {
        self.coordinates - self.rank
    }
}

/// Counts over the steps of one call, and the largest constraint violation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct StepReport {
    /// Number of steps that were made.
    pub steps: u64,
    /// Number of iterations of Newton's method; in relative coordinates, number of evaluations of the accelerations.
    pub iterations: u64,
    /// Number of factorisations of matrices.
    pub factorizations: u64,
    /// Number of steps that the step control rejected.
    pub rejected: u64,
    /// Largest constraint violation in positions, velocities and accelerations after a step [m, m/s, m/s^2].
    pub violation: [f64; 3],
}

impl StepReport {
    /// Adds one accepted step.
    pub fn add<T: Real>(&mut self, accepted: &Accepted<T>) {
        let report = &accepted.attempt.report;
        self.steps += u64::from(report.steps);
        self.iterations += u64::from(report.iterations);
        self.factorizations += u64::from(report.factorizations);
        self.rejected += u64::from(report.rejected);
        self.join(report.violation.map(Real::to_f64));
    }

    /// Adds the steps of another call.
    pub fn join_report(&mut self, other: &Self) {
        self.steps += other.steps;
        self.iterations += other.iterations;
        self.factorizations += other.factorizations;
        self.rejected += other.rejected;
        self.join(other.violation);
    }

    fn join(&mut self, violation: [f64; 3]) {
        for (most, x) in self.violation.iter_mut().zip(violation) {
            *most = most.max(x);
        }
    }
}

//! Mass, centre of mass and tensor of inertia.

use crate::pose::{M3, Pose, V3};

/// Tolerance of the triangle inequality of a tensor, relative to its largest moment [-]. The rounding of printed numbers and of rotations
/// is smaller than this.
pub(crate) const SLACK: f64 = 1.0e-9;

/// The inertia of a body, in the axes of one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Mass {
    /// Mass of the body [kg].
    pub(crate) mass: f64,
    /// Centre of mass [m].
    pub(crate) center: V3,
    /// Tensor about the centre of mass [kg m²].
    pub(crate) tensor: M3,
}

impl Mass {
    pub(crate) fn none() -> Self {
        Self { mass: 0.0, center: V3::zeros(), tensor: M3::zeros() }
    }

    /// Returns the inertia in the axes of another frame. `pose` is the pose of the present frame in the other frame.
    pub(crate) fn seen_from(&self, pose: &Pose) -> Self {
        let turned = pose.turn * self.tensor * pose.turn.transpose();
        // The rounding errors of the products are not symmetric, so the mean is taken.
        let tensor = (turned + turned.transpose()) * 0.5;
        let tensor = if pose.turn == M3::identity() { self.tensor } else { tensor };
        Self { mass: self.mass, center: pose.point(&self.center), tensor }
    }

    /// The inertia of two bodies together, about their common centre of mass.
    pub(crate) fn with(&self, other: &Self) -> Self {
        let mass = self.mass + other.mass;
        if self.is_nothing() {
            return *other;
        }
        if other.is_nothing() {
            return *self;
        }
        if mass == 0.0 {
            return Self { tensor: self.tensor + other.tensor, ..*self };
        }
        let center = (self.center * self.mass + other.center * other.mass) / mass;
        let tensor = self.about(&center) + other.about(&center);
        Self { mass, center, tensor }
    }

    /// True if both mass and inertia are zero.
    pub(crate) fn is_nothing(&self) -> bool {
        self.mass == 0.0 && self.tensor == M3::zeros()
    }

    /// The tensor about another point, by the parallel axis theorem.
    pub(crate) fn about(&self, point: &V3) -> M3 {
        let r = self.center - point;
        self.tensor + (M3::identity() * r.dot(&r) - r * r.transpose()) * self.mass
    }

    /// The six numbers of the tensor in the order of scenes: xx, yy, zz, xy, yz, zx.
    pub(crate) fn six(&self) -> [f64; 6] {
        [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].map(|entry| self.tensor[entry])
    }
}

/// The tensor with the six numbers xx, yy, zz, xy, yz, zx.
pub(crate) fn tensor([xx, yy, zz, xy, yz, zx]: [f64; 6]) -> M3 {
    M3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pose::{about, unit, v3};

    #[test]
    fn two_halves_of_a_turned_rod_make_the_rod() {
        // A rod of 3 kg and 2 m along x has m l²/12 = 1 about y and z.
        let half = |x: f64| Mass {
            mass: 1.5,
            center: v3([x, 0.0, 0.0]),
            tensor: tensor([0.0, 0.125, 0.125, 0.0, 0.0, 0.0]),
        };
        let pose = Pose::new(about(&unit(2), core::f64::consts::FRAC_PI_2), v3([0.0, 0.0, 5.0]));
        let rod = half(-0.5).seen_from(&pose).with(&half(0.5).seen_from(&pose));
        assert!((rod.mass - 3.0).abs() < 1.0e-15);
        assert_eq!(rod.center, v3([0.0, 0.0, 5.0]));
        for (found, expected) in rod.six().iter().zip([1.0, 0.0, 1.0, 0.0, 0.0, 0.0]) {
            assert!((found - expected).abs() < 1.0e-15);
        }
    }
}

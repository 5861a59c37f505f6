//! Solids and shells of simple shapes: their sizes and moments of inertia.

use crate::inertia::Mass;
use crate::pose::{M3, V3, v3};
use crate::robot::FormKind;
use crate::shell;
use core::f64::consts::PI;

/// A solid along the z axis of its frame, with half lengths [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Solid {
    Sphere(f64),
    /// Radius, and half the length without the round ends.
    Capsule(f64, f64),
    Cylinder(f64, f64),
    Ellipsoid([f64; 3]),
    Box([f64; 3]),
    /// Radius of the base, and half the height. The base is below the tip, and the origin is halfway between them.
    Cone(f64, f64),
}

impl Solid {
    pub(crate) fn volume(&self) -> f64 {
        match *self {
            Self::Sphere(r) => 4.0 / 3.0 * PI * r.powi(3),
            Self::Capsule(r, h) => 2.0 * PI * r * r * h + 4.0 / 3.0 * PI * r.powi(3),
            Self::Cylinder(r, h) => 2.0 * PI * r * r * h,
            Self::Ellipsoid([a, b, c]) => 4.0 / 3.0 * PI * a * b * c,
            Self::Box([a, b, c]) => 8.0 * a * b * c,
            Self::Cone(r, h) => 2.0 / 3.0 * PI * r * r * h,
        }
    }

    /// Returns the solid with all sizes multiplied by a factor.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let all = |half: [f64; 3]| half.map(|x| x * factor);
        match *self {
            Self::Sphere(r) => Self::Sphere(r * factor),
            Self::Capsule(r, h) => Self::Capsule(r * factor, h * factor),
            Self::Cylinder(r, h) => Self::Cylinder(r * factor, h * factor),
            Self::Cone(r, h) => Self::Cone(r * factor, h * factor),
            Self::Ellipsoid(half) => Self::Ellipsoid(all(half)),
            Self::Box(half) => Self::Box(all(half)),
        }
    }

    /// Inertia of the solid from a density, or from the mass in the file. The density of a shell is per area.
    pub(crate) fn mass(&self, is_shell: bool, density: f64, written: Option<f64>) -> Mass {
        let (size, moments) = match self.shell().filter(|_| is_shell) {
            Some(shell) => shell,
            None => (self.volume(), self.moments()),
        };
        let mass = written.unwrap_or(density * size);
        let tensor = M3::from_diagonal(&v3(moments.map(|x| x * mass)));
        Mass { mass, center: self.center(), tensor }
    }

    /// Centre of mass of the solid, in its frame.
    const fn center(&self) -> V3 {
        match *self {
            Self::Cone(_, h) => v3([0.0, 0.0, -h / 2.0]),
            _ => v3([0.0; 3]),
        }
    }

    /// Principal moments of inertia per unit of mass [m²].
    fn moments(&self) -> [f64; 3] {
        let squares = |[a, b, c]: [f64; 3], share: f64| {
            [b * b + c * c, a * a + c * c, a * a + b * b].map(|x| x * share)
        };
        match *self {
            Self::Sphere(r) => [0.4 * r * r; 3],
            Self::Ellipsoid(half) => squares(half, 0.2),
            Self::Box(half) => squares(half, 1.0 / 3.0),
            Self::Cylinder(r, h) => {
                let across = r * r / 4.0 + h * h / 3.0;
                [across, across, r * r / 2.0]
            }
            Self::Cone(r, h) => {
                let across = 0.15 * (r * r + h * h);
                [across, across, 0.3 * r * r]
            }
            Self::Capsule(r, h) => {
                // Fractions of the mass in the cylinder and in both ends together.
                let (middle, ends) = (2.0 * PI * r * r * h, 4.0 / 3.0 * PI * r.powi(3));
                let all = middle + ends;
                let (middle, ends) = (middle / all, ends / all);
                let across = middle * (r * r / 4.0 + h * h / 3.0)
                    + ends * (0.4 * r * r + h * h + 0.75 * r * h);
                [across, across, middle * r * r / 2.0 + ends * 0.4 * r * r]
            }
        }
    }

    /// The area of the surface, and the moments of a shell per unit of mass. `None` for a shape whose shell no format has.
    fn shell(&self) -> Option<(f64, [f64; 3])> {
        Some(match *self {
            Self::Sphere(r) => (4.0 * PI * r * r, [2.0 / 3.0 * r * r; 3]),
            Self::Capsule(r, h) => shell::capsule(r, h),
            Self::Cylinder(r, h) => shell::cylinder(r, h),
            Self::Box(half) => shell::cuboid(half),
            Self::Ellipsoid(half) => shell::ellipsoid(half),
            Self::Cone(..) => return None,
        })
    }

    /// Shape for pictures of the solid; `None` when the scene has no such shape.
    pub(crate) const fn form(&self) -> Option<FormKind> {
        Some(match *self {
            Self::Sphere(radius) => FormKind::Sphere { radius },
            Self::Capsule(radius, half) => FormKind::Capsule { radius, length: 2.0 * half },
            Self::Cylinder(radius, half) => FormKind::Cylinder { radius, length: 2.0 * half },
            Self::Box([a, b, c]) => FormKind::Box([2.0 * a, 2.0 * b, 2.0 * c]),
            Self::Ellipsoid(_) | Self::Cone(..) => return None,
        })
    }
}

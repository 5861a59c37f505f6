//! Solid that the triangles of a mesh enclose: volume, centre and moments.

use crate::TriangleMesh;
use mbs_math::algebra::{Matrix, Vector, vector};
use std::collections::HashMap;

type V3 = Vector<f64, 3>;
type M3 = Matrix<f64, 3>;

/// Rule for the sum over tetrahedra, each between a point and a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VolumeRule {
    /// Sum of signed volumes, which is the enclosed volume for closed surfaces only.
    Signed,
    /// Sum of absolute volumes. The centre is computed with tetrahedra from the centre of the surface. All other results are computed with
    /// tetrahedra from that centre. Dents add volume. Holes are allowed.
    Unsigned,
    /// No tetrahedra: the triangles are a thin shell, whose area is its size.
    Shell,
}

/// A solid with a density of one, in the axes of its surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solid {
    /// Volume [m³], or the area of a shell [m²]; negative if the surface is oriented inwards.
    pub size: f64,
    /// Centre [m].
    pub center: V3,
    /// Inertia tensor about the centre: [m⁵] for a volume, [m⁴] for a shell.
    pub tensor: M3,
}

impl TriangleMesh {
    /// Returns an edge that only one triangle has. Returns `None` if the surface is closed.
    #[must_use]
    pub fn open_edge(&self) -> Option<[usize; 2]> {
        let mut edges: HashMap<[usize; 2], i64> = HashMap::new();
        for [a, b, c] in &self.triangles {
            for [a, b] in [[*a, *b], [*b, *c], [*c, *a]] {
                if a != b {
                    *edges.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
                }
            }
        }
        edges.into_iter().filter(|(_, sum)| *sum != 0).map(|(edge, _)| edge).min()
    }

    /// Returns the solid that the triangles enclose. An open surface is closed by triangles to the centre.
    #[must_use]
    pub fn solid(&self, rule: VolumeRule) -> Solid {
        let center = match rule {
            VolumeRule::Signed | VolumeRule::Unsigned => self.sums(&self.surface_center(), rule).1,
            VolumeRule::Shell => self.surface_center(),
        };
        // The sums are about this centre. They depend on the reference point if tetrahedra are not signed, and for open surfaces.
        let (size, second) = match rule {
            VolumeRule::Shell => self.areas(&center),
            _ => {
                let (volume, _, second) = self.sums(&center, rule);
                (volume, second)
            }
        };
        Solid { size, center, tensor: M3::identity() * second.trace() - second }
    }

    fn vertex(&self, i: usize) -> V3 {
        vector(self.vertices[i])
    }

    /// Returns the volume, the centre, and the second moments of volume about a point.
    fn sums(&self, origin: &V3, rule: VolumeRule) -> (f64, V3, M3) {
        let (mut volume, mut first, mut second) = (0.0, V3::zeros(), M3::zeros());
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|i| self.vertex(i) - origin);
            let part = a.dot(&b.cross(&c)) / 6.0;
            let part = if rule == VolumeRule::Unsigned { part.abs() } else { part };
            let sum = a + b + c;
            volume += part;
            first += sum * (part / 4.0);
            let squares = a * a.transpose() + b * b.transpose() + c * c.transpose();
            second += (sum * sum.transpose() + squares) * (part / 20.0);
        }
        let center = if volume == 0.0 { *origin } else { origin + first / volume };
        (volume, center, second)
    }

    /// Returns the area, and the second moments of area about a point.
    fn areas(&self, origin: &V3) -> (f64, M3) {
        let (mut area, mut second) = (0.0, M3::zeros());
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|i| self.vertex(i) - origin);
            let part = (b - a).cross(&(c - a)).norm() / 2.0;
            let sum = a + b + c;
            area += part;
            let squares = a * a.transpose() + b * b.transpose() + c * c.transpose();
            second += (sum * sum.transpose() + squares) * (part / 12.0);
        }
        (area, second)
    }

    /// Returns the centre of the surface: the mean of the triangles' centres, weighted by area.
    fn surface_center(&self) -> V3 {
        let (mut area, mut sum) = (0.0, V3::zeros());
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|i| self.vertex(i));
            let part = (b - a).cross(&(c - a)).norm() / 2.0;
            area += part;
            sum += (a + b + c) * (part / 3.0);
        }
        if area > 0.0 { sum / area } else { V3::zeros() }
    }
}

//! The mass of what triangles enclose.

use crate::inertia::Mass;
use crate::pose::{M3, V3, v3};
use mbs_scene::TriangleMesh;
use std::collections::HashMap;

/// How the tetrahedra between a point and the triangles count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Count {
    /// With the sign of their volume: the enclosed volume, of a closed surface alone.
    Signed,
    /// Each as a volume: the centre from the centre of the surface, the rest from that centre. Dents count too, and holes do no harm.
    Unsigned,
    /// None of them: the triangles are a thin shell, and the density is that of an area.
    Shell,
}

/// A surface as something that has mass.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surface<'a>(pub(crate) &'a TriangleMesh);

impl Surface<'_> {
    /// The edge that no other triangle has the other way round; `None` where the surface is closed.
    pub(crate) fn open_edge(&self) -> Option<[usize; 2]> {
        let mut edges: HashMap<[usize; 2], i64> = HashMap::new();
        for [a, b, c] in &self.0.triangles {
            for [a, b] in [[*a, *b], [*b, *c], [*c, *a]] {
                if a != b {
                    *edges.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
                }
            }
        }
        edges.into_iter().filter(|(_, sum)| *sum != 0).map(|(edge, _)| edge).min()
    }

    /// Where the surface is open, in words; `None` where it is closed.
    pub(crate) fn opening(&self) -> Option<String> {
        let place = |i: usize| self.0.vertices[i].iter().map(f64::to_string).collect::<Vec<_>>();
        let [a, b] = self.open_edge()?.map(|i| place(i).join(" "));
        Some(format!("its surface is open at the edge from {a} to {b}"))
    }

    /// Mass, centre and tensor at a density [kg/m³], or why there are none. An open surface counts with its opening closed from the centre.
    pub(crate) fn enclosed(&self, density: f64, count: Count) -> Result<Mass, String> {
        // the density may be zero
        let one = self.mass(1.0, count);
        if one.mass <= 0.0 {
            return Err("its surface encloses nothing, or is turned inside out".to_owned());
        }
        Ok(Mass { mass: one.mass * density, tensor: one.tensor * density, ..one })
    }

    /// Mass, centre and tensor at a density [kg/m³]; a surface that is turned inside out has a mass below zero.
    pub(crate) fn mass(&self, density: f64, count: Count) -> Mass {
        let center = match count {
            Count::Signed | Count::Unsigned => self.sums(&self.surface_center(), count).1,
            Count::Shell => self.surface_center(),
        };
        // about the centre that was found; the sums of volumes differ where tetrahedra are not signed, and of open surfaces
        let (size, second) = match count {
            Count::Shell => self.areas(&center),
            _ => {
                let (volume, _, second) = self.sums(&center, count);
                (volume, second)
            }
        };
        let tensor = (M3::identity() * second.trace() - second) * density;
        Mass { mass: size * density, center, tensor }
    }

    fn vertex(&self, i: usize) -> V3 {
        v3(self.0.vertices[i])
    }

    /// Volume, its centre, and its second moments about a point.
    fn sums(&self, origin: &V3, count: Count) -> (f64, V3, M3) {
        let (mut volume, mut first, mut second) = (0.0, V3::zeros(), M3::zeros());
        for triangle in &self.0.triangles {
            let [a, b, c] = triangle.map(|i| self.vertex(i) - origin);
            let part = a.dot(&b.cross(&c)) / 6.0;
            let part = if count == Count::Unsigned { part.abs() } else { part };
            let sum = a + b + c;
            volume += part;
            first += sum * (part / 4.0);
            let squares = a * a.transpose() + b * b.transpose() + c * c.transpose();
            second += (sum * sum.transpose() + squares) * (part / 20.0);
        }
        let center = if volume == 0.0 { *origin } else { origin + first / volume };
        (volume, center, second)
    }

    /// Area, and its second moments about a point.
    fn areas(&self, origin: &V3) -> (f64, M3) {
        let (mut area, mut second) = (0.0, M3::zeros());
        for triangle in &self.0.triangles {
            let [a, b, c] = triangle.map(|i| self.vertex(i) - origin);
            let part = (b - a).cross(&(c - a)).norm() / 2.0;
            let sum = a + b + c;
            area += part;
            let squares = a * a.transpose() + b * b.transpose() + c * c.transpose();
            second += (sum * sum.transpose() + squares) * (part / 12.0);
        }
        (area, second)
    }

    /// The centre of the triangles, by their areas.
    fn surface_center(&self) -> V3 {
        let (mut area, mut sum) = (0.0, V3::zeros());
        for triangle in &self.0.triangles {
            let [a, b, c] = triangle.map(|i| self.vertex(i));
            let part = (b - a).cross(&(c - a)).norm() / 2.0;
            area += part;
            sum += (a + b + c) * (part / 3.0);
        }
        if area > 0.0 { sum / area } else { V3::zeros() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box of 1, 2 and 3 m at a corner of the origin.
    const BOX: &str = "\
v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3/1 4/2/3 8//1 7\nf -5 -8 -4 -1\n";

    fn of(text: &str) -> TriangleMesh {
        TriangleMesh::of_bytes(text.as_bytes(), "obj").expect("a surface")
    }

    #[test]
    fn a_box_has_the_mass_and_the_moments_of_a_box() {
        let mesh = of(BOX);
        assert_eq!(
            (mesh.vertices.len(), mesh.triangles.len(), Surface(&mesh).open_edge()),
            (8, 12, None)
        );
        for count in [Count::Signed, Count::Unsigned] {
            let mass = Surface(&mesh).mass(2.0, count);
            // m (b² + c²)/12 with m = 12
            let expected = [12.0, 0.5, 1.0, 1.5, 13.0, 10.0, 5.0, 0.0, 0.0, 0.0];
            let found = [&[mass.mass][..], mass.center.as_slice(), &mass.six()].concat();
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1.0e-14, "{count:?}: {found} {expected}");
            }
        }
    }

    #[test]
    fn the_shell_of_a_box_is_six_plates() {
        let mass = Surface(&of(BOX)).mass(0.5, Count::Shell);
        // half lengths 0.5, 1 and 1.5 m
        let (area, moments) = crate::shell::cuboid([0.5, 1.0, 1.5]);
        let expected =
            [&[area / 2.0, 0.5, 1.0, 1.5][..], &moments.map(|x| x * area / 2.0)].concat();
        let found = [&[mass.mass][..], mass.center.as_slice(), &mass.six()].concat();
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1.0e-13, "{found} {expected}");
        }
    }

    #[test]
    fn an_open_surface_and_one_turned_inside_out_are_seen() {
        let open = of(&BOX.replace("f 5 6 7 8\n", ""));
        assert_eq!(Surface(&open).open_edge(), Some([4, 5]));
        let mut inside_out = of(BOX);
        inside_out.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
        assert!((Surface(&inside_out).mass(1.0, Count::Signed).mass + 6.0).abs() < 1.0e-14);
    }
}

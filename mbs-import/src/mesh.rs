//! Mass of the volume or surface of a triangle mesh.

use crate::inertia::Mass;
use mbs_scene::{Solid, TriangleMesh, VolumeRule};

/// A surface of triangles that has mass.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surface<'a>(pub(crate) &'a TriangleMesh);

impl Surface<'_> {
    /// Description of an edge at which the surface is open; `None` when the surface is closed.
    pub(crate) fn opening(&self) -> Option<String> {
        let place = |i: usize| self.0.vertices[i].iter().map(f64::to_string).collect::<Vec<_>>();
        let [a, b] = self.0.open_edge()?.map(|i| place(i).join(" "));
        Some(format!("its surface is open at the edge from {a} to {b}"))
    }

    /// Mass, centre and tensor from a density [kg/m³], or for a shell [kg/m²]. The error is the reason why there is no mass.
    pub(crate) fn enclosed(&self, density: f64, rule: VolumeRule) -> Result<Mass, String> {
        // The density may be zero, so mass and tensor are computed for a density of one first.
        let Solid { size, center, tensor } = self.0.solid(rule);
        if size <= 0.0 {
            return Err("its surface encloses nothing, or is turned inside out".to_owned());
        }
        Ok(Mass { mass: size * density, center, tensor: tensor * density })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box of 1 m, 2 m and 3 m with one corner at the origin.
    const BOX: &str = "\
v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3/1 4/2/3 8//1 7\nf -5 -8 -4 -1\n";

    fn of(text: &str) -> TriangleMesh {
        TriangleMesh::of_bytes(text.as_bytes(), "obj").expect("a surface")
    }

    #[test]
    fn a_box_has_the_mass_and_the_moments_of_a_box() {
        let mesh = of(BOX);
        assert_eq!((mesh.vertices.len(), mesh.triangles.len(), mesh.open_edge()), (8, 12, None));
        for rule in [VolumeRule::Signed, VolumeRule::Unsigned] {
            let mass = Surface(&mesh).enclosed(2.0, rule).expect("a volume");
            // Moments m (b² + c²)/12 with m = 12.
            let expected = [12.0, 0.5, 1.0, 1.5, 13.0, 10.0, 5.0, 0.0, 0.0, 0.0];
            let found = [&[mass.mass][..], mass.center.as_slice(), &mass.six()].concat();
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1.0e-14, "{rule:?}: {found} {expected}");
            }
        }
    }

    #[test]
    fn the_shell_of_a_box_is_six_plates() {
        let mass = Surface(&of(BOX)).enclosed(0.5, VolumeRule::Shell).expect("an area");
        // Half lengths 0.5 m, 1 m and 1.5 m.
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
        assert_eq!(open.open_edge(), Some([4, 5]));
        let mut inside_out = of(BOX);
        inside_out.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
        assert!((inside_out.solid(VolumeRule::Signed).size + 6.0).abs() < 1.0e-14);
    }
}

//! Shapes that are fitted to meshes.

use super::compiler::Compiler;
use crate::inertia::Mass;
use crate::pose::{M3, Pose, V3, v3};
use crate::solid::Solid;
use mbs_scene::TriangleMesh;

/// Relative difference of principal moments that count as equal, and have no distinct axes [-]. Vertices have the seven digits of single
/// precision.
const ALIKE: f64 = 1.0e-6;

/// A shape that is fitted to a mesh.
pub(super) struct Fitted {
    pub(super) solid: Solid,
    /// Frame of the shape, relative to that of the mesh.
    pub(super) frame: Pose,
    /// True if its axes are arbitrary, although the mass or the moments depend on them.
    pub(super) is_chosen: bool,
}

/// Fits a shape of this kind to a mesh whose mass is known for some density. The error is the reason why there is no such shape.
pub(super) fn fitted(
    kind: &str,
    mesh: &TriangleMesh,
    mass: &Mass,
    compiler: &Compiler,
) -> Result<Fitted, String> {
    let (moments, axes) = principal(&mass.tensor);
    let (center, half) = if compiler.fits_boxes {
        let (center, half) = around(mesh, &axes, &mass.center);
        (mass.center + axes * center, half)
    } else {
        // Half lengths of the box with the same mass and moments.
        let sum: f64 = moments.iter().sum();
        let half = moments.map(|moment| (1.5 * (sum - 2.0 * moment).max(0.0) / mass.mass).sqrt());
        (mass.center, half)
    };
    let solid = match (kind, compiler.fits_boxes) {
        ("box", _) => Solid::Box(half),
        ("ellipsoid", _) => Solid::Ellipsoid(half),
        ("sphere", true) => Solid::Sphere(half.into_iter().fold(0.0, f64::max)),
        ("sphere", false) => Solid::Sphere(half.iter().sum::<f64>() / 3.0),
        ("cylinder", true) => Solid::Cylinder(half[0].max(half[1]), half[2]),
        ("cylinder", false) => Solid::Cylinder(half[0].midpoint(half[1]), half[2]),
        ("capsule", true) => {
            let radius = half[0].max(half[1]);
            Solid::Capsule(radius, (half[2] - radius).max(0.0))
        }
        ("capsule", false) => {
            let radius = half[0].midpoint(half[1]);
            Solid::Capsule(radius, (half[2] - radius / 2.0).max(0.0))
        }
        _ => return Err(format!("a `{kind}` is not fitted to meshes")),
    };
    let is_alike = |i: usize| moments[i] - moments[i + 1] <= ALIKE * moments[0];
    let is_round = matches!(solid, Solid::Cylinder(..) | Solid::Capsule(..));
    let is_chosen =
        is_alike(0) && compiler.fits_boxes || is_alike(1) && (compiler.fits_boxes || is_round);
    Ok(Fitted { solid, frame: Pose::new(axes, center), is_chosen })
}

/// Principal moments in descending order, with their axes.
fn principal(tensor: &M3) -> ([f64; 3], M3) {
    let eigen = tensor.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let axes = order.map(|i| eigen.eigenvectors.column(i).into_owned());
    // The last axis makes the frame right-handed.
    let last = axes[0].cross(&axes[1]);
    (order.map(|i| eigen.eigenvalues[i]), M3::from_columns(&[axes[0], axes[1], last]))
}

/// The box around the vertices, along the columns of `axes`. Returns its centre relative to the point `at`, in components along these axes,
/// and its half lengths.
fn around(mesh: &TriangleMesh, axes: &M3, at: &V3) -> (V3, [f64; 3]) {
    let mut ends = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for vertex in &mesh.vertices {
        let x = axes.transpose() * (v3(*vertex) - at);
        for axis in 0..3 {
            ends[0][axis] = ends[0][axis].min(x[axis]);
            ends[1][axis] = ends[1][axis].max(x[axis]);
        }
    }
    let [low, high] = ends.map(v3);
    ((low + high) * 0.5, ((high - low) * 0.5).into())
}

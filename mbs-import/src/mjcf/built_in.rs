//! Built-in meshes of the format: convex hulls of a few points.

use super::defaults::View;
use crate::element::Attribute;
use crate::source::Read;
use core::f64::consts::TAU;

/// Largest number of corners of a cone [-]. Chosen, not tuned.
const MAX_CORNERS: f64 = 10_000.0;
/// Largest number of rows of a hemisphere [-]. The number of its points is twice the square of the rows. Chosen, not tuned.
const MAX_ROWS: f64 = 100.0;
/// Largest number of subdivisions of a sphere [-], as in the format.
const MAX_DIVISIONS: f64 = 4.0;

/// The vertices of the built-in mesh that an attribute names.
pub(super) fn built_in(word: &Attribute, view: &View<'_>) -> Read<Vec<[f64; 3]>> {
    let kind = word.value.trim();
    let params = view.attribute("params").map(Attribute::list).transpose()?.unwrap_or_default();
    let is_whole = |x: f64, least: f64, most: f64| x.fract() == 0.0 && (least..=most).contains(&x);
    let (vertices, form) = match (kind, &params[..]) {
        ("cone", &[n, r]) if is_whole(n, 3.0, MAX_CORNERS) && r >= 0.0 => (cone(n, r), ""),
        ("sphere", &[n]) if is_whole(n, 0.0, MAX_DIVISIONS) => (sphere(n as usize), ""),
        ("hemisphere", &[n]) if is_whole(n, 1.0, MAX_ROWS) => (hemisphere(n as i32), ""),
        ("cone", _) => (Vec::new(), "3 corners or more, and the radius of the top"),
        ("sphere", _) => (Vec::new(), "how often it is divided, 0 to 4 times"),
        ("hemisphere", _) => (Vec::new(), "the number of its rows, 1 to 100"),
        _ => {
            return Err(word.fault(
                format!(
                    "a mass follows from this mesh, and the built-in mesh `{kind}` is not computed"
                ),
                "save the model with mj_saveLastXML of MuJoCo, which writes the vertices, and give that file; or write an <inertial> in the body of its geom, or let --massless-meshes count it as massless",
            ));
        }
    };
    if !form.is_empty() {
        let message = format!("`params` of the built-in mesh `{kind}` do not fit");
        return Err(word.fault(message, format!("write in `params`: {form}")));
    }
    Ok(vertices)
}

/// Two rings of corners around the z axis: radius 1 at z = -1, and radius `top` at z = 1.
fn cone(corners: f64, top: f64) -> Vec<[f64; 3]> {
    let ring = |radius: f64, z: f64| {
        (0..corners as usize).map(move |i| {
            let (sine, cosine) = (TAU * i as f64 / corners).sin_cos();
            [radius * cosine, radius * sine, z]
        })
    };
    ring(1.0, -1.0).chain(ring(top, 1.0)).collect()
}

/// A vector scaled to unit length.
fn unit(x: [f64; 3]) -> [f64; 3] {
    let length = x.iter().map(|x| x * x).sum::<f64>().sqrt();
    x.map(|x| x / length)
}

/// An icosahedron whose triangles are repeatedly divided into four; all points are on the unit sphere.
fn sphere(divisions: usize) -> Vec<[f64; 3]> {
    let golden = 0.5 + 1.25_f64.sqrt();
    let mut points: Vec<[f64; 3]> = Vec::new();
    for [a, b] in [[-1.0, golden], [1.0, golden], [-1.0, -golden], [1.0, -golden]] {
        points.extend([[a, b, 0.0], [0.0, a, b], [b, 0.0, a]].map(unit));
    }
    let distance =
        |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
    for _ in 0..divisions {
        // Edge lengths differ by less than a fifth; other pairs of points are at least half an edge farther apart.
        let first = points[0];
        let least = points[1..].iter().map(|x| distance(x, &first)).fold(f64::INFINITY, f64::min);
        let mut middles = Vec::new();
        for (i, a) in points.iter().enumerate() {
            for b in points[..i].iter().filter(|b| distance(a, b) < 2.0 * least) {
                middles.push(unit([a[0] + b[0], a[1] + b[1], a[2] + b[2]]));
            }
        }
        points.append(&mut middles);
    }
    points
}

/// The points of a hemisphere and its centre. The points are in rows on the upper half of an octahedron, and are then projected onto the unit
/// sphere.
fn hemisphere(rows: i32) -> Vec<[f64; 3]> {
    let n = rows + 1;
    let mut points = vec![[0.0; 3]];
    for x in -n..=n {
        for y in -n..=n {
            let z = n - x.abs() - y.abs();
            if z >= 0 {
                points.push(unit([x, y, z].map(f64::from)));
            }
        }
    }
    points
}

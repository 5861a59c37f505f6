//! Convex hull of points, as a mesh of triangles.
//!
//! Each outside point is added in turn (quickhull). The triangles whose outer side faces the point are removed, and new triangles join the
//! rim of the gap to the point. The points are rounded to a fine grid, and the side of a triangle on which a point is follows exactly. So
//! faces with many points in one plane need no tolerance.

use crate::TriangleMesh;
use std::collections::HashMap;

/// Number of grid steps along the longest side of the points [-]. The product of three sides then has 126 bits, and fits into an `i128`
/// with its sign.
const GRID: f64 = (1_u64 << 40) as f64;

/// A triangle of the hull during its construction.
#[derive(Debug)]
struct Face {
    corners: [usize; 3],
    /// Points outside this face that are assigned to no other face.
    outside: Vec<usize>,
    is_there: bool,
}

#[derive(Debug)]
struct Hull {
    points: Vec<[i128; 3]>,
    faces: Vec<Face>,
    /// The face on the left of each edge. Seen from outside, the edges of a face run counterclockwise.
    edges: HashMap<[usize; 2], usize>,
}

/// Returns the convex hull of points, with triangles oriented outwards; `None` if all points are in one plane.
#[must_use]
pub fn hull(points: &[[f64; 3]]) -> Option<TriangleMesh> {
    let mut hull = Hull { points: snapped(points)?, faces: Vec::new(), edges: HashMap::new() };
    let first = hull.first()?;
    let mut open: Vec<usize> = (0..4).collect();
    let all = (0..points.len()).filter(|point| !first.contains(point)).collect();
    hull.assign(all, &open);
    while let Some(face) = open.pop() {
        if let Some(point) = hull.farthest(face) {
            let added = hull.add(point, face);
            open.extend(added);
        }
    }
    Some(hull.surface(points))
}

/// Rounds the points to the grid. Returns `None` if all points are the same, or one is not finite.
fn snapped(points: &[[f64; 3]]) -> Option<Vec<[i128; 3]>> {
    let end = |axis: usize, pick: fn(f64, f64) -> f64| {
        points.iter().map(|point| point[axis]).reduce(pick).unwrap_or(0.0)
    };
    let low = [0, 1, 2].map(|axis| end(axis, f64::min));
    let sides = [0, 1, 2].map(|axis| end(axis, f64::max) - low[axis]);
    let side = sides.into_iter().fold(0.0, f64::max);
    let is_sound = side > 0.0 && side.is_finite();
    let on_grid = |x: f64, low: f64| ((x - low) / side * GRID).round() as i128;
    is_sound
        .then(|| points.iter().map(|x| [0, 1, 2].map(|axis| on_grid(x[axis], low[axis]))).collect())
}

impl Hull {
    fn minus(&self, a: usize, b: usize) -> [i128; 3] {
        [0, 1, 2].map(|axis| self.points[a][axis] - self.points[b][axis])
    }

    /// Returns six times the volume between a triangle and a point. It is positive if the point is on the outer side of the triangle.
    fn volume(&self, [a, b, c]: [usize; 3], point: usize) -> i128 {
        let [u, v, w] = [b, c, point].map(|x| self.minus(x, a));
        let cross = |i: usize, j: usize| u[i] * v[j] - u[j] * v[i];
        cross(1, 2) * w[0] + cross(2, 0) * w[1] + cross(0, 1) * w[2]
    }

    /// Returns four points that enclose a volume, and adds their faces.
    fn first(&mut self) -> Option<[usize; 4]> {
        let all = 0..self.points.len();
        let a = all.clone().min_by_key(|i| self.points[*i])?;
        let square = |x: [i128; 3]| x.iter().map(|x| x * x).sum::<i128>();
        let b = all.clone().max_by_key(|i| square(self.minus(*i, a)))?;
        // the choice by size needs no exact arithmetic
        let line = self.minus(b, a).map(|x| x as f64);
        let area = |i: &usize| {
            let x = self.minus(*i, a).map(|x| x as f64);
            let cross = |i: usize, j: usize| (x[i] * line[j] - x[j] * line[i]).powi(2);
            cross(0, 1) + cross(1, 2) + cross(2, 0)
        };
        let c = all.clone().max_by(|i, k| area(i).total_cmp(&area(k)))?;
        let d = all.max_by_key(|i| self.volume([a, b, c], *i).abs())?;
        let volume = self.volume([a, b, c], d);
        if volume == 0 {
            return None;
        }
        let [b, c] = if volume > 0 { [c, b] } else { [b, c] };
        for corners in [[a, b, c], [a, d, b], [b, d, c], [c, d, a]] {
            self.push(corners);
        }
        Some([a, b, c, d])
    }

    fn push(&mut self, corners: [usize; 3]) -> usize {
        let number = self.faces.len();
        for i in 0..3 {
            self.edges.insert([corners[i], corners[(i + 1) % 3]], number);
        }
        self.faces.push(Face { corners, outside: Vec::new(), is_there: true });
        number
    }

    /// Assigns each point to the first of some faces that has the point on its outer side. A point without such a face is inside the hull.
    fn assign(&mut self, points: Vec<usize>, faces: &[usize]) {
        for point in points {
            let sees = |face: &&usize| self.volume(self.faces[**face].corners, point) > 0;
            if let Some(face) = faces.iter().find(sees).copied() {
                self.faces[face].outside.push(point);
            }
        }
    }

    /// Returns the farthest of the points that are assigned to a face.
    fn farthest(&self, face: usize) -> Option<usize> {
        let Face { corners, outside, is_there } = &self.faces[face];
        let far = outside.iter().filter(|_| *is_there).copied();
        far.max_by_key(|point| self.volume(*corners, *point))
    }

    /// Adds a point on the outer side of a face to the hull. Returns the new faces.
    fn add(&mut self, point: usize, face: usize) -> Vec<usize> {
        let mut seen = vec![face];
        self.faces[face].is_there = false;
        let (mut next, mut rim) = (0, Vec::new());
        while let Some(face) = seen.get(next).copied() {
            next += 1;
            let corners = self.faces[face].corners;
            for [from, to] in [0, 1, 2].map(|i| [corners[i], corners[(i + 1) % 3]]) {
                let beside = self.edges[&[to, from]];
                let is_seen = self.volume(self.faces[beside].corners, point) > 0;
                if !is_seen {
                    rim.push([from, to]);
                } else if std::mem::replace(&mut self.faces[beside].is_there, false) {
                    seen.push(beside);
                }
            }
        }
        let mut rest = Vec::new();
        for face in seen {
            rest.append(&mut self.faces[face].outside);
        }
        rest.retain(|other| *other != point);
        let added: Vec<_> =
            rim.into_iter().map(|[from, to]| self.push([from, to, point])).collect();
        self.assign(rest, &added);
        added
    }

    /// Returns the triangles with the points that they use.
    fn surface(&self, points: &[[f64; 3]]) -> TriangleMesh {
        let mut mesh = TriangleMesh::default();
        let mut numbers = HashMap::new();
        for face in self.faces.iter().filter(|face| face.is_there) {
            mesh.triangles.push(face.corners.map(|corner| {
                *numbers.entry(corner).or_insert_with(|| {
                    mesh.vertices.push(points[corner]);
                    mesh.vertices.len() - 1
                })
            }));
        }
        mesh
    }
}

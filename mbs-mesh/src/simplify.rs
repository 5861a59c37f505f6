//! Simpler copies of a surface, with fewer triangles or with fewer vertices.

use crate::TriangleMesh;
use std::collections::{HashMap, HashSet};

impl TriangleMesh {
    /// Returns the mesh without unused vertices. Vertices are in the order in which triangles use them, so that successive indices differ
    /// little.
    #[must_use]
    pub fn used(&self) -> Self {
        let (mut numbers, mut vertices) = (vec![None; self.vertices.len()], Vec::new());
        let mut of = |old: usize| {
            *numbers[old].get_or_insert_with(|| {
                vertices.push(self.vertices[old]);
                vertices.len() - 1
            })
        };
        let triangles = self.triangles.iter().map(|triangle| triangle.map(&mut of)).collect();
        Self { vertices, triangles }
    }

    /// Returns the area of all triangles.
    #[must_use]
    pub fn area(&self) -> f64 {
        let of = |[a, b, c]: &[usize; 3]| {
            let [a, b, c] = [*a, *b, *c].map(|i| self.vertices[i]);
            let [u, v] = [b, c].map(|end| [0, 1, 2].map(|i| end[i] - a[i]));
            let cross =
                [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            0.5 * cross.iter().map(|x| x * x).sum::<f64>().sqrt()
        };
        self.triangles.iter().map(of).sum()
    }

    /// Replaces all vertices in a cell of a grid by their mean. Triangles with fewer than three different vertices are left out, and so are
    /// duplicates.
    ///
    /// `cell` is the width of the cells, in the unit of the vertices.
    #[must_use]
    pub fn clustered(&self, cell: f64) -> Self {
        let (mut cells, mut sums) = (HashMap::new(), Vec::<([f64; 3], f64)>::new());
        #[allow(clippy::cast_possible_truncation, reason = "the cast saturates")]
        let mut of = |vertex: &[f64; 3]| {
            let key = vertex.map(|x| (x / cell).floor() as i64);
            let number = *cells.entry(key).or_insert(sums.len());
            if number == sums.len() {
                sums.push(([0.0; 3], 0.0));
            }
            let (sum, n) = &mut sums[number];
            sum.iter_mut().zip(vertex).for_each(|(sum, x)| *sum += x);
            *n += 1.0;
            number
        };
        let numbers: Vec<usize> = self.vertices.iter().map(&mut of).collect();
        let mut seen = HashSet::new();
        let triangles = self.triangles.iter().filter_map(|triangle| {
            let [a, b, c] = triangle.map(|i| numbers[i]);
            let mut key = [a, b, c];
            key.sort_unstable();
            (a != b && b != c && a != c && seen.insert(key)).then_some([a, b, c])
        });
        let triangles = triangles.collect();
        let vertices = sums.iter().map(|(sum, n)| sum.map(|x| x / n)).collect();
        Self { vertices, triangles }
    }
}

//! Sums of random blocks for the tests, and a dense L D L^T for comparison.
//!
//! ```text
//! T_e = sum_i g_i g_i^T + k I ,   g_i with k random entries in [-1, 1]: positive definite
//! ```

#![allow(dead_code, unused_imports, reason = "each test binary uses a part")]

mod forking;
mod saddle;

pub(crate) use forking::Forking;
use mbs_sparse::{BlockSource, Cliques, Real};
pub(crate) use saddle::Saddle;

/// A sum of blocks, stored by element.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sum {
    pub(crate) n: usize,
    pub(crate) cliques: Vec<Vec<u32>>,
    pub(crate) blocks: Vec<Vec<f64>>,
    pub(crate) residuals: Vec<Vec<f64>>,
}

/// Generator of pseudo-random numbers in [-1, 1] by a linear congruence, the same on every machine.
#[derive(Debug, Clone)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        (((self.next() + 1.0) / 2.0 * n as f64) as usize).min(n - 1)
    }
}

impl Sum {
    /// Creates random positive definite blocks on the given cliques.
    pub(crate) fn random(n: usize, cliques: Vec<Vec<u32>>, seed: u64) -> Self {
        let mut random = Random(seed);
        let blocks = cliques.iter().map(|c| random_block(c.len(), &mut random)).collect();
        let residuals = cliques.iter().map(|c| c.iter().map(|_| random.next()).collect()).collect();
        Self { n, cliques, blocks, residuals }
    }

    /// Creates a chain of `length` elements of `size` unknowns. Consecutive elements have `overlap` unknowns in common.
    pub(crate) fn chain(length: usize, size: usize, overlap: usize) -> Self {
        let pitch = size - overlap;
        let clique = |e: usize| (0..size).map(|i| (e * pitch + i) as u32).collect();
        Self::random(length * pitch + overlap, (0..length).map(clique).collect(), 1)
    }

    /// Creates a star: `branches` chains that meet at a common hub of 12 unknowns. Each chain has `length` elements of 12 unknowns that
    /// overlap by 6.
    pub(crate) fn star(branches: usize, length: usize) -> Self {
        let mut cliques = vec![(0..12).collect::<Vec<u32>>()];
        let mut n = 12_u32;
        for branch in 0..branches {
            let side = if branch % 2 == 0 { 0 } else { 6 };
            let mut near: Vec<u32> = (side..side + 6).collect();
            for _ in 0..length {
                let far: Vec<u32> = (n..n + 6).collect();
                cliques.push(near.iter().chain(&far).copied().collect());
                near = far;
                n += 6;
            }
        }
        Self::random(n as usize, cliques, 2)
    }

    /// Creates a grid of nodes of `size` unknowns, with an element for each pair of neighbours.
    pub(crate) fn grid(rows: usize, columns: usize, size: usize) -> Self {
        let node =
            |r: usize, c: usize| (0..size).map(move |i| ((r * columns + c) * size + i) as u32);
        let mut cliques = Vec::new();
        for r in 0..rows {
            for c in 0..columns {
                if c + 1 < columns {
                    cliques.push(node(r, c).chain(node(r, c + 1)).collect());
                }
                if r + 1 < rows {
                    cliques.push(node(r, c).chain(node(r + 1, c)).collect());
                }
            }
        }
        Self::random(rows * columns * size, cliques, 3)
    }

    /// Creates a binary tree of nodes of `size` unknowns, with an element for each node and its parent.
    pub(crate) fn tree(levels: u32, size: usize) -> Self {
        let n_nodes = (1_usize << levels) - 1;
        let node = |v: usize| (v * size..(v + 1) * size).map(|u| u as u32);
        let cliques = (1..n_nodes).map(|v| node((v - 1) / 2).chain(node(v)).collect()).collect();
        Self::random(n_nodes * size, cliques, 4)
    }

    /// Creates unconnected chains of elements of 12 unknowns.
    pub(crate) fn forest(chains: usize, length: usize) -> Self {
        let pitch = 6 * length + 6;
        let mut cliques = Vec::new();
        for c in 0..chains {
            for e in 0..length {
                cliques.push((0..12).map(|i| (c * pitch + 6 * e + i) as u32).collect());
            }
        }
        Self::random(chains * pitch, cliques, 5)
    }

    /// Returns the full matrix, row by row.
    pub(crate) fn dense(&self) -> Vec<f64> {
        let mut t = vec![0.0; self.n * self.n];
        for (clique, block) in self.cliques.iter().zip(&self.blocks) {
            let mut entries = block.iter();
            for (j, &b) in clique.iter().enumerate() {
                for (i, &a) in clique.iter().enumerate().skip(j) {
                    let value = entries.next().expect("a packed triangle");
                    t[a as usize * self.n + b as usize] += value;
                    if i != j {
                        t[b as usize * self.n + a as usize] += value;
                    }
                }
            }
        }
        t
    }

    /// Returns the product T x, element by element.
    pub(crate) fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut b = vec![0.0; self.n];
        for (clique, block) in self.cliques.iter().zip(&self.blocks) {
            let mut entries = block.iter();
            for (j, &v) in clique.iter().enumerate() {
                for (i, &u) in clique.iter().enumerate().skip(j) {
                    let value = entries.next().expect("a packed triangle");
                    b[u as usize] += value * x[v as usize];
                    if i != j {
                        b[v as usize] += value * x[u as usize];
                    }
                }
            }
        }
        b
    }
}

/// Returns a random positive definite block of `k` unknowns, packed.
fn random_block(k: usize, random: &mut Random) -> Vec<f64> {
    let g: Vec<f64> = (0..k * k).map(|_| random.next()).collect();
    let mut block = Vec::new();
    for j in 0..k {
        for i in j..k {
            let product: f64 = (0..k).map(|m| g[m * k + i] * g[m * k + j]).sum();
            block.push(product + if i == j { k as f64 } else { 0.0 });
        }
    }
    block
}

/// Solves by dense L D L^T in the given order, for comparison.
pub(crate) fn dense_solve(t: &[f64], b: &[f64]) -> Vec<f64> {
    let n = b.len();
    let (mut a, mut x) = (t.to_vec(), b.to_vec());
    for k in 0..n {
        for i in k + 1..n {
            let l = a[i * n + k] / a[k * n + k];
            for j in k..n {
                a[i * n + j] -= l * a[k * n + j];
            }
            x[i] -= l * x[k];
        }
    }
    for k in (0..n).rev() {
        for j in k + 1..n {
            x[k] -= a[k * n + j] * x[j];
        }
        x[k] /= a[k * n + k];
    }
    x
}

impl Cliques for Sum {
    fn n_unknowns(&self) -> usize {
        self.n
    }
    fn n_elements(&self) -> usize {
        self.cliques.len()
    }
    fn clique(&self, element: usize) -> &[u32] {
        &self.cliques[element]
    }
}

impl<T: Real> BlockSource<T> for Sum {
    fn write_block(&self, element: usize, block: &mut [T]) {
        for (to, &from) in block.iter_mut().zip(&self.blocks[element]) {
            *to = T::from_f64(from);
        }
    }
    fn write_residual(&self, element: usize, residual: &mut [T]) {
        for (to, &from) in residual.iter_mut().zip(&self.residuals[element]) {
            *to = T::from_f64(from);
        }
    }
}

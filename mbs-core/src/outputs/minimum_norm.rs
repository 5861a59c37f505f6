//! Solution of smallest norm of consistent equations A x = b with unknown rank, and the unknowns that the equations determine.
//!
//! ```text
//! A P = Q [R11 R12; 0 0]         Householder, largest column first; rank r
//! x_0 = P [R11^-1 (Q^T b)_r; 0]  one solution
//! N   = P [-Z; 1],  Z = R11^-1 R12        all null vectors
//! x   = x_0 - N y,  (1 + Z^T Z) y = N^T x_0
//! ```
//!
//! P is the order of the columns, Q R the factorisation, y a vector of free parameters. An unknown is determined exactly if its row of N is
//! zero.

use crate::Real;
use alloc::vec;
use alloc::vec::Vec;

/// Dense system of m equations in n unknowns, with memory for the largest system.
#[derive(Debug, Clone)]
pub struct MinimumNorm<T> {
    m: usize,
    n: usize,
    rank: usize,
    /// Matrix A, column by column. After the factorisation R is in its upper part.
    a: Vec<T>,
    b: Vec<T>,
    /// Vector of the present Householder reflection.
    reflector: Vec<T>,
    x: Vec<T>,
    order: Vec<usize>,
    /// Matrix Z, column by column, with r rows.
    z: Vec<T>,
    gram: Vec<T>,
    y: Vec<T>,
}

impl<T: Real> MinimumNorm<T> {
    /// Allocates memory for systems of up to `rows` equations in up to `columns` unknowns.
    pub fn new(rows: usize, columns: usize) -> Self {
        let zeros = |k| vec![T::ZERO; k];
        Self {
            m: 0,
            n: 0,
            rank: 0,
            a: zeros(rows * columns),
            b: zeros(rows),
            reflector: zeros(rows),
            x: zeros(columns),
            order: vec![0; columns],
            z: zeros(columns * columns),
            gram: zeros(columns * columns),
            y: zeros(columns),
        }
    }

    /// Begins a system with zero entries.
    pub fn begin(&mut self, m: usize, n: usize) {
        (self.m, self.n, self.rank) = (m, n, 0);
        self.a[..m * n].fill(T::ZERO);
        self.b[..m].fill(T::ZERO);
        for j in 0..n {
            self.order[j] = j;
        }
    }

    /// Entry of A in row `i` and column `j`.
    pub fn entry(&mut self, i: usize, j: usize) -> &mut T {
        &mut self.a[j * self.m + i]
    }

    /// Right-hand side of the equations.
    pub fn right(&mut self) -> &mut [T] {
        &mut self.b[..self.m]
    }

    /// Solution of the equations.
    pub fn solution(&self) -> &[T] {
        &self.x[..self.n]
    }

    /// Ratio to the largest pivot below which a pivot counts as zero. It is also the limit of a null vector's component.
    fn tolerance(&self) -> T {
        T::from_f64(self.m.max(self.n) as f64 * libm::pow(T::EPSILON.to_f64(), 2.0 / 3.0))
    }

    /// Factors the matrix and solves the equations. Returns the norm of the residual.
    ///
    /// Cost: about 2 m n r operations, and r (n - r)^2 more if the rank r is below n; no allocation.
    pub fn solve(&mut self) -> T {
        self.factor();
        self.substitute();
        if self.rank < self.n {
            self.shorten();
        }
        norm(&self.b[self.rank..self.m])
    }

    /// True if the unknown is the same in all solutions.
    pub fn is_determined(&self, unknown: usize) -> bool {
        let tolerance = self.tolerance();
        let place = self.order[..self.n].iter().position(|&j| j == unknown);
        place.is_some_and(|i| {
            i < self.rank
                && (0..self.n - self.rank).all(|k| self.z[k * self.rank + i].abs() <= tolerance)
        })
    }

    /// Factors A by Householder reflections, the longest remaining column first, and transforms b.
    fn factor(&mut self) {
        let (m, n, tolerance) = (self.m, self.n, self.tolerance());
        let mut largest = T::ZERO;
        for step in 0..m.min(n) {
            let (mut best, mut size) = (step, -T::ONE);
            for j in step..n {
                let c = self.order[j] * m;
                let length = norm(&self.a[c + step..c + m]);
                if length > size {
                    (best, size) = (j, length);
                }
            }
            largest = largest.max(size);
            if !(size > tolerance * largest) {
                break;
            }
            self.order.swap(step, best);
            self.reflect(step, size);
            self.rank = step + 1;
        }
    }

    /// Reflects column `step` (in the order) onto its first entry, and transforms later columns and b.
    fn reflect(&mut self, step: usize, size: T) {
        let (m, c) = (self.m, self.order[step] * self.m);
        let head = self.a[c + step];
        let pivot = if head > T::ZERO { -size } else { size };
        self.a[c + step] = head - pivot;
        let scale = T::ONE / (size * (size + head.abs()));
        let v = &mut self.reflector[step..m];
        v.copy_from_slice(&self.a[c + step..c + m]);
        let carry = |x: &mut [T]| {
            let dot = v.iter().zip(x.iter()).fold(T::ZERO, |s, (&v, &x)| s + v * x) * scale;
            x.iter_mut().zip(v.iter()).for_each(|(x, &v)| *x -= v * dot);
        };
        for &j in &self.order[step + 1..self.n] {
            carry(&mut self.a[j * m + step..(j + 1) * m]);
        }
        carry(&mut self.b[step..m]);
        self.a[c + step] = pivot;
    }

    /// Computes x_0 and Z by back substitution.
    fn substitute(&mut self) {
        let (r, m) = (self.rank, self.m);
        self.x[..self.n].fill(T::ZERO);
        self.y[..r].copy_from_slice(&self.b[..r]);
        back_substitute(&self.a, &self.order[..r], m, &mut self.y[..r]);
        for i in 0..r {
            self.x[self.order[i]] = self.y[i];
        }
        for k in 0..self.n - r {
            let c = self.order[r + k] * m;
            let z = &mut self.z[k * r..(k + 1) * r];
            z.copy_from_slice(&self.a[c..c + r]);
            back_substitute(&self.a, &self.order[..r], m, z);
        }
    }

    /// Computes x = x_0 - N y, by the Cholesky factorisation of 1 + Z^T Z.
    fn shorten(&mut self) {
        let (r, free) = (self.rank, self.n - self.rank);
        let z = |k: usize| k * r..(k + 1) * r;
        for k in 0..free {
            let column = &self.z[z(k)];
            let along =
                column.iter().zip(&self.order).fold(T::ZERO, |s, (&z, &j)| s + z * self.x[j]);
            self.y[k] = -along;
            for l in 0..=k {
                let dot = column.iter().zip(&self.z[z(l)]).fold(T::ZERO, |s, (&a, &b)| s + a * b);
                self.gram[k * free + l] = if k == l { dot + T::ONE } else { dot };
            }
        }
        cholesky_solve(&mut self.gram, &mut self.y[..free]);
        for k in 0..free {
            for (&z, &j) in self.z[z(k)].iter().zip(&self.order) {
                self.x[j] += z * self.y[k];
            }
            self.x[self.order[r + k]] = -self.y[k];
        }
    }
}

/// Solves R11 y = x by back substitution, in place.
fn back_substitute<T: Real>(a: &[T], order: &[usize], m: usize, x: &mut [T]) {
    for i in (0..x.len()).rev() {
        x[i] /= a[order[i] * m + i];
        for k in 0..i {
            let done = x[i];
            x[k] -= a[order[i] * m + k] * done;
        }
    }
}

/// Solves G y = b with the lower triangle of a positive definite G, stored row by row. It overwrites G and y.
fn cholesky_solve<T: Real>(g: &mut [T], y: &mut [T]) {
    let n = y.len();
    for i in 0..n {
        for j in 0..=i {
            let sum = (0..j).fold(g[i * n + j], |s, k| s - g[i * n + k] * g[j * n + k]);
            g[i * n + j] = if i == j { sum.sqrt() } else { sum / g[j * n + j] };
        }
        y[i] = (0..i).fold(y[i], |s, k| s - g[i * n + k] * y[k]) / g[i * n + i];
    }
    for i in (0..n).rev() {
        y[i] = (i + 1..n).fold(y[i], |s, k| s - g[k * n + i] * y[k]) / g[i * n + i];
    }
}

fn norm<T: Real>(x: &[T]) -> T {
    x.iter().fold(T::ZERO, |s, &x| s + x * x).sqrt()
}

//! Dense systems of any rank, by elimination with full pivoting. Entries must be scaled to the order of one.

/// Largest pivot that counts as zero [-]. Chosen, not tuned.
const NO_PIVOT: f64 = 1e-11;

/// A square matrix, by rows.
#[derive(Debug, Clone)]
pub(crate) struct Square {
    n: usize,
    entries: Vec<f64>,
}

/// Factors of a matrix by elimination.
#[derive(Debug, Clone)]
pub(crate) struct Factors {
    matrix: Square,
    rows: Vec<usize>,
    columns: Vec<usize>,
    rank: usize,
    /// The smallest accepted pivot.
    pub(crate) least_pivot: f64,
}

impl Square {
    /// Returns the matrix of zeros.
    pub(crate) fn zero(n: usize) -> Self {
        Self { n, entries: vec![0.0; n * n] }
    }

    /// Returns the entry (i, j) to write.
    pub(crate) fn at(&mut self, i: usize, j: usize) -> &mut f64 {
        &mut self.entries[i * self.n + j]
    }

    /// Entry (i, j) to read.
    pub(crate) fn get(&self, i: usize, j: usize) -> f64 {
        self.entries[i * self.n + j]
    }

    /// Factors the matrix by elimination. Each pivot is the largest entry of the remaining rows and columns.
    pub(crate) fn factor(mut self) -> Factors {
        let n = self.n;
        let (mut rows, mut columns): (Vec<_>, Vec<_>) = ((0..n).collect(), (0..n).collect());
        let (mut rank, mut least_pivot) = (n, f64::INFINITY);
        for k in 0..n {
            let (mut pivot, mut at) = (0.0_f64, (k, k));
            for i in k..n {
                for (j, entry) in self.entries[i * n + k..(i + 1) * n].iter().enumerate() {
                    if entry.abs() > pivot {
                        (pivot, at) = (entry.abs(), (i, k + j));
                    }
                }
            }
            if pivot < NO_PIVOT {
                rank = k;
                break;
            }
            least_pivot = least_pivot.min(pivot);
            self.swap(k, at);
            rows.swap(k, at.0);
            columns.swap(k, at.1);
            let (above, below) = self.entries.split_at_mut((k + 1) * n);
            let row = &above[k * n..];
            for other in below.chunks_exact_mut(n) {
                let factor = other[k] / row[k];
                other[k] = factor;
                if factor != 0.0 {
                    other[k + 1..]
                        .iter_mut()
                        .zip(&row[k + 1..])
                        .for_each(|(x, y)| *x -= factor * y);
                }
            }
        }
        Factors { matrix: self, rows, columns, rank, least_pivot }
    }

    fn swap(&mut self, k: usize, (i, j): (usize, usize)) {
        let n = self.n;
        if i != k {
            let (above, below) = self.entries.split_at_mut(i * n);
            above[k * n..(k + 1) * n].swap_with_slice(&mut below[..n]);
        }
        if j != k {
            self.entries.chunks_exact_mut(n).for_each(|row| row.swap(k, j));
        }
    }
}

impl Factors {
    /// A solution, with zeros for the unknowns that the rank leaves undetermined, and the largest residual relative to the right-hand side.
    pub(crate) fn solve(&self, b: &[f64]) -> (Vec<f64>, f64) {
        let (n, m) = (self.matrix.n, &self.matrix.entries);
        let mut y: Vec<f64> = self.rows.iter().map(|&i| b[i]).collect();
        let size = y.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        for i in 0..n {
            let known = i.min(self.rank);
            let sum: f64 = m[i * n..i * n + known].iter().zip(&y).map(|(a, x)| a * x).sum();
            y[i] -= sum;
        }
        let unmet = y[self.rank..].iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        y[self.rank..].fill(0.0);
        self.back(&mut y);
        (self.ordered(&y), if size > 0.0 { unmet / size } else { 0.0 })
    }

    /// Null vectors of the matrix, one for each missing rank.
    pub(crate) fn kernel(&self) -> Vec<Vec<f64>> {
        let (n, m) = (self.matrix.n, &self.matrix.entries);
        (self.rank..n)
            .map(|free| {
                let mut y = vec![0.0; n];
                (0..self.rank).for_each(|i| y[i] = -m[i * n + free]);
                self.back(&mut y);
                y[free] = 1.0;
                self.ordered(&y)
            })
            .collect()
    }

    fn back(&self, y: &mut [f64]) {
        let (n, m) = (self.matrix.n, &self.matrix.entries);
        for i in (0..self.rank).rev() {
            let sum: f64 = (i + 1..self.rank).map(|j| m[i * n + j] * y[j]).sum();
            y[i] = (y[i] - sum) / m[i * n + i];
        }
    }

    fn ordered(&self, y: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; y.len()];
        y.iter().zip(&self.columns).for_each(|(y, &j)| x[j] = *y);
        x
    }
}

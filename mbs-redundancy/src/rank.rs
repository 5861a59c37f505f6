//! Rank of a matrix by its singular values, with the gap between them.
//!
//! ```text
//! J = U Σ Vᵀ,   r = #{σ > max(m, n) ε^(2/3) σ₁},   gap = σ_r / σ_(r+1)
//! null(Jᵀ): the last m − r columns of U (forces that hold themselves);   null(J): the last n − r of V (motions)
//! ```

use mbs_linear::{Matrix, Svd};

/// Ratio of neighbouring singular values below which a rank is uncertain [-]. Chosen, not tuned.
pub const UNCERTAIN: f64 = 1e3;
/// Singular value, relative to the largest one, up to which a row is suspected to be dependent [-]. Numbers in a scene file usually have at
/// least six digits.
const ALMOST: f64 = 1e-6;

/// Rank of a matrix, with its null spaces.
#[derive(Debug, Clone)]
pub struct Rank {
    /// Number of rows, number of columns, and rank.
    pub sizes: [usize; 3],
    /// All singular values in descending order [-].
    pub sigma: Vec<f64>,
    /// Orthonormal basis of the left null space: one column per redundant row.
    pub null: Matrix,
    /// Orthonormal basis of the right null space: one column per freedom.
    pub free: Matrix,
    /// Left singular vectors; the last ones span the left null space.
    left: Matrix,
}

impl Rank {
    /// Computes the rank of a matrix. Returns `None` if its singular values do not converge, for example because an entry is not finite.
    ///
    /// Cost: about 20 m n min(m, n) operations.
    #[must_use]
    pub fn of(matrix: &Matrix) -> Option<Self> {
        let (m, n) = (matrix.n_rows(), matrix.n_columns());
        let Svd { u: left, sigma, v } = Svd::new(matrix)?;
        let largest = sigma.first().copied().unwrap_or(0.0);
        if !largest.is_finite() {
            return None;
        }
        let least = threshold(m, n) * largest;
        let rank = sigma.iter().filter(|&&s| s > least).count();
        let (null, free) = (left.columns_from(rank), v.columns_from(rank));
        Some(Self { sizes: [m, n, rank], sigma, null, free, left })
    }

    /// Returns the number of rows that depend on others.
    #[must_use]
    pub fn redundant(&self) -> usize {
        self.sizes[0] - self.sizes[2]
    }

    /// Returns the gap σ_r / σ_(r+1) [-]. If all rows are independent, it returns σ_r divided by the threshold.
    #[must_use]
    pub fn gap(&self) -> f64 {
        let [m, n, rank] = self.sizes;
        let floor = f64::EPSILON * self.sigma.first().copied().unwrap_or(1.0);
        match (rank.checked_sub(1).map(|i| self.sigma[i]), self.sigma.get(rank)) {
            (Some(kept), Some(&dropped)) => kept / dropped.max(floor),
            (Some(kept), None) => kept / (threshold(m, n) * self.sigma[0]),
            (None, _) => f64::INFINITY,
        }
    }

    /// Returns the smallest nonzero singular value relative to the largest one [-]. It measures how far the rows are from dependence.
    #[must_use]
    pub fn least(&self) -> f64 {
        match self.sizes[2].checked_sub(1) {
            Some(last) => self.sigma[last] / self.sigma[0],
            None => 1.0,
        }
    }

    /// Returns the left singular vector for the singular value with index `i`: a combination of rows, of unit length.
    ///
    /// # Panics
    /// If there is no such value.
    #[must_use]
    pub fn combination(&self, i: usize) -> Vec<f64> {
        self.left.column(i).to_vec()
    }

    /// Returns the left null space if all suspected singular values count as zero. Returns `None` if no singular value is suspected.
    #[must_use]
    pub fn almost_null(&self) -> Option<Matrix> {
        let rank = self.sizes[2];
        let sure = self.sigma.iter().filter(|&&s| s > ALMOST * self.sigma[0]).count();
        let stands_apart =
            sure > 0 && sure < rank && self.sigma[sure - 1] > UNCERTAIN * self.sigma[sure];
        stands_apart.then(|| self.left.columns_from(sure))
    }
}

fn threshold(m: usize, n: usize) -> f64 {
    let size = m.max(n) as f64;
    size * f64::EPSILON.powf(2.0 / 3.0)
}

//! Rank by singular values, with its gap.
//!
//! ```text
//! J = U Σ Vᵀ,   r = #{σ > max(m, n) ε^(2/3) σ₁},   gap = σ_r / σ_(r+1)
//! null(Jᵀ): the last m − r columns of U (forces that hold themselves);   null(J): the last n − r of V (motions)
//! ```

use mbs_linear::{Matrix, Svd};

/// Ratio of neighbouring singular values below which a rank is uncertain [-]. Chosen, not tuned.
pub const UNCERTAIN: f64 = 1e3;
/// Singular value that is suspicious, relative to the largest [-]: numbers of a file have six digits or more.
const ALMOST: f64 = 1e-6;

/// Rank of a matrix, and what it leaves open.
#[derive(Debug, Clone)]
pub struct Rank {
    /// Number of rows, number of columns, and rank.
    pub sizes: [usize; 3],
    /// All singular values, falling [-].
    pub sigma: Vec<f64>,
    /// Orthonormal basis of the left null space: one column per redundant row.
    pub null: Matrix,
    /// Orthonormal basis of the right null space: one column per freedom.
    pub free: Matrix,
    /// Left singular vectors, to which the null space belongs.
    left: Matrix,
}

impl Rank {
    /// Computes the rank of a matrix. Nothing where its singular values do not converge, as with numbers that are not finite.
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

    /// Rows that follow from others.
    #[must_use]
    pub fn redundant(&self) -> usize {
        self.sizes[0] - self.sizes[2]
    }

    /// σ_r / σ_(r+1) [-]; where every row counts, σ_r over the threshold.
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

    /// Smallest singular value that counts, over the largest [-]: how far the rows are from depending on each other.
    #[must_use]
    pub fn least(&self) -> f64 {
        match self.sizes[2].checked_sub(1) {
            Some(last) => self.sigma[last] / self.sigma[0],
            None => 1.0,
        }
    }

    /// The combination of rows that belongs to singular value number `i`, a unit vector.
    ///
    /// # Panics
    /// If there is no such value.
    #[must_use]
    pub fn combination(&self, i: usize) -> Vec<f64> {
        self.left.column(i).to_vec()
    }

    /// The left null space as it would be if the suspicious singular values were zero; nothing where none is.
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

//! Values that a tree answers with.

use crate::erased::values::PointMotion;
use mbs_core::algebra::Vector;
use std::ops::{Index, IndexMut};

/// A dense matrix, row by row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Matrix {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// Entries, row by row: entry (i, j) is `data[i * columns + j]`.
    pub data: Vec<f64>,
}

impl Matrix {
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, data: vec![0.0; rows * columns] }
    }

    pub fn resize_rows(&mut self, rows: usize) {
        self.rows = rows;
        self.data.resize(rows * self.columns, 0.0);
    }

    /// Returns row `i`, from 0.
    ///
    /// # Panics
    /// If there is no such row.
    #[must_use]
    pub fn row(&self, i: usize) -> &[f64] {
        &self.data[i * self.columns..][..self.columns]
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;
    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.row(i)[j]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.data[i * self.columns..][..self.columns][j]
    }
}

/// Derivatives of the efforts τ = M v̇ + c + g; each n × n, a row for each effort.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct EffortDerivatives {
    /// ∂τ/∂q, along the velocities: column j is the change while v_j moves q by its unit.
    pub q: Matrix,
    /// Derivative ∂τ/∂v by the velocities.
    pub v: Matrix,
    /// Derivative ∂τ/∂v̇ = M by the accelerations.
    pub acceleration: Matrix,
}

/// Derivatives of the accelerations v̇; each n × n, a row for each acceleration.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct AccelerationDerivatives {
    /// ∂v̇/∂q, along the velocities: column j is the change while v_j moves q by its unit.
    pub q: Matrix,
    /// Derivative ∂v̇/∂v by the velocities.
    pub v: Matrix,
    /// Derivative ∂v̇/∂τ = M⁻¹ by the efforts.
    pub effort: Matrix,
}

impl PointMotion {
    pub fn of(motion: [Vector<f64, 3>; 3]) -> Self {
        let [position, velocity, acceleration] = motion.map(Into::into);
        Self { position, velocity, acceleration }
    }
}

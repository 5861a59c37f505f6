//! Dense matrices and vectors of a model.

use mbs_core::model::{Load, Model, Tangent, Terms};

/// Returns the sum x + s y.
#[must_use]
pub fn plus(x: &[f64], s: f64, y: &[f64]) -> Vec<f64> {
    x.iter().zip(y).map(|(x, y)| x + s * y).collect()
}

/// Scalar product x . y.
#[must_use]
pub fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// Returns the reference configuration of a model.
#[must_use]
pub fn reference(model: &impl Model<f64>) -> Vec<f64> {
    let mut q = vec![0.0; model.n_extended()];
    model.write_reference(&mut q);
    q
}

/// Returns the product J x with the Jacobian.
#[must_use]
pub fn rates(model: &impl Model<f64>, terms: &Terms<f64>, x: &[f64]) -> Vec<f64> {
    let mut rates = vec![0.0; model.n_constraints()];
    model.multiply_jacobian(terms, x, &mut rates);
    rates
}

/// Returns the rows of J over the unknowns.
#[must_use]
pub fn jacobian(model: &impl Model<f64>, terms: &Terms<f64>) -> Vec<Vec<f64>> {
    let (n, m) = (model.n_unknowns(), model.n_constraints());
    let mut rows = vec![vec![0.0; n]; m];
    let mut unit = vec![0.0; model.n_extended()];
    for i in 0..n {
        unit[i] = 1.0;
        for (row, rate) in rows.iter_mut().zip(rates(model, terms, &unit)) {
            row[i] = rate;
        }
        unit[i] = 0.0;
    }
    rows
}

/// Returns the sum of the residuals of all elements.
#[must_use]
pub fn residual(model: &impl Model<f64>, terms: &Terms<f64>, load: &Load<'_, f64>) -> Vec<f64> {
    let mut f = vec![0.0; model.n_unknowns()];
    for e in 0..model.n_elements() {
        let clique = model.clique(e);
        let mut local = vec![f64::NAN; clique.len()];
        model.write_residual(terms, load, e, &mut local);
        for (&u, x) in clique.iter().zip(local) {
            f[u as usize] += x;
        }
    }
    f
}

/// Returns the sum of the blocks of all elements, dense and symmetric.
#[must_use]
pub fn matrix(
    model: &impl Model<f64>,
    terms: &Terms<f64>,
    tangent: &Tangent<'_, f64>,
) -> Vec<Vec<f64>> {
    let n = model.n_unknowns();
    let mut a = vec![vec![0.0; n]; n];
    for e in 0..model.n_elements() {
        let clique = model.clique(e);
        let k = clique.len();
        let mut block = vec![f64::NAN; k * (k + 1) / 2];
        model.write_block(terms, tangent, e, &mut block);
        let mut at = 0;
        for j in 0..k {
            for i in j..k {
                let (row, column) = (clique[i] as usize, clique[j] as usize);
                a[row][column] += block[at];
                if i != j {
                    a[column][row] += block[at];
                }
                at += 1;
            }
        }
    }
    a
}

/// Returns the part of x that is orthogonal to all rows, by two passes of the Gram-Schmidt method. Dependent rows are left out.
#[must_use]
pub fn in_null_space(rows: &[Vec<f64>], x: &[f64]) -> Vec<f64> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for row in rows {
        let mut y = row.clone();
        for _ in 0..2 {
            for b in &basis {
                y = plus(&y, -dot(b, &y), b);
            }
        }
        let length = dot(&y, &y).sqrt();
        if length > 1e-9 * dot(row, row).sqrt() {
            basis.push(y.iter().map(|y| y / length).collect());
        }
    }
    let n = rows.first().map_or(x.len(), Vec::len);
    let mut x = x.to_vec();
    for _ in 0..2 {
        for b in &basis {
            let s = dot(b, &x[..n]);
            for (x, b) in x.iter_mut().zip(b) {
                *x -= s * b;
            }
        }
    }
    x
}

/// Returns the largest difference of two entries.
#[must_use]
pub fn apart(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).fold(0.0, |most: f64, (x, y)| most.max((x - y).abs()))
}

/// Checks that two vectors differ by at most `tolerance` times one plus their size.
///
/// # Panics
///
/// If the vectors differ by more.
#[track_caller]
pub fn close(what: &str, x: &[f64], y: &[f64], tolerance: f64) {
    assert_eq!(x.len(), y.len(), "{what}");
    let size = y.iter().fold(1.0_f64, |s, y| s.max(y.abs()));
    for (i, (x, y)) in x.iter().zip(y).enumerate() {
        assert!((x - y).abs() <= tolerance * size, "{what}: entry {i}: {x} against {y}");
    }
}

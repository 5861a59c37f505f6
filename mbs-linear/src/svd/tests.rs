//! Singular values compared with cases by hand, and matrices of many kinds recomposed from orthogonal factors.

use super::{Svd, singular_values};
use crate::matrix::Matrix;
use alloc::format;
use alloc::vec::Vec;

/// Generator of pseudo-random numbers in (-1, 1), the same on every machine (xorshift64*).
struct Random(u64);

impl Random {
    fn draw(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        #[allow(clippy::cast_precision_loss, reason = "53 bits")]
        let x = (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64;
        x / (1_u64 << 52) as f64 - 1.0
    }

    fn matrix(&mut self, m: usize, n: usize) -> Matrix {
        let mut all = Matrix::zeros(m, n);
        for j in 0..n {
            all.column_mut(j).iter_mut().for_each(|x| *x = self.draw());
        }
        all
    }

    /// Returns a matrix of rank at most `r`; the product is exact, because its factors are integers.
    fn of_rank(&mut self, m: usize, n: usize, r: usize) -> Matrix {
        let rounded = |x: Matrix| {
            Matrix::from_fn(x.n_rows(), x.n_columns(), |i, j| (5.0 * x[(i, j)]).round())
        };
        rounded(self.matrix(m, r)).times(&rounded(self.matrix(r, n)))
    }

    /// Returns a matrix with entries of sizes 10^-12 to 10^12.
    fn graded(&mut self, m: usize, n: usize) -> Matrix {
        let all = self.matrix(m, n);
        let power: Vec<f64> = (0..m * n).map(|_| 12.0 * self.draw()).collect();
        Matrix::from_fn(m, n, |i, j| all[(i, j)] * 10.0_f64.powf(power[j * m + i]))
    }

    /// Returns a sparse matrix: a fifth of its entries is nonzero, as in the rows of joints.
    fn sparse(&mut self, m: usize, n: usize) -> Matrix {
        let (all, kept) = (self.matrix(m, n), self.matrix(m, n));
        Matrix::from_fn(m, n, |i, j| if kept[(i, j)].abs() < 0.2 { all[(i, j)] } else { 0.0 })
    }
}

/// Returns the rounding error allowed for a decomposition, relative to the largest entry or value [-].
fn rounding(a: &Matrix) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "a count")]
    let size = (a.n_rows() + a.n_columns()) as f64;
    4.0 * size * f64::EPSILON
}

fn largest_difference(a: &Matrix, b: &Matrix) -> f64 {
    a.minus(b).largest().expect("finite")
}

fn is_orthogonal(x: &Matrix, within: f64) -> bool {
    let unit = Matrix::identity(x.n_columns(), x.n_columns());
    largest_difference(&x.transpose().times(x), &unit) <= within
}

fn checked(name: &str, a: &Matrix) {
    let (m, n) = (a.n_rows(), a.n_columns());
    let name = format!("{name}, {m} x {n}");
    let all = Svd::new(a).unwrap_or_else(|| panic!("{name}: does not converge"));
    let thin = Svd::thin(a).expect("as with all vectors");
    let k = m.min(n);
    assert_eq!([all.u.n_columns(), all.v.n_columns(), all.sigma.len()], [m, n, k], "{name}");
    assert_eq!([thin.u.n_columns(), thin.v.n_columns(), thin.sigma.len()], [k, k, k], "{name}");
    assert!(all.sigma.is_sorted_by(|a, b| a >= b), "{name}: falling");
    assert!(all.sigma.iter().all(|&s| s >= 0.0), "{name}: not negative");
    assert_eq!(thin.sigma, all.sigma, "{name}");
    assert_eq!(singular_values(a).expect("as with vectors"), all.sigma, "{name}");

    // Uᵀ U = 1,   Vᵀ V = 1,   U Σ Vᵀ = A:   Σ then contains the singular values of A, as accurately as these three equations hold (Weyl)
    let within = rounding(a);
    for x in [&all.u, &all.v, &thin.u, &thin.v] {
        assert!(is_orthogonal(x, within), "{name}: orthogonal");
    }
    let scale = all.sigma.first().map_or(1.0, |&s| s.max(f64::MIN_POSITIVE));
    let of = |svd: &Svd| {
        let u = Matrix::from_fn(m, k, |i, j| svd.u[(i, j)] * (svd.sigma[j] / scale));
        let v = Matrix::from_fn(n, k, |i, j| svd.v[(i, j)]);
        u.times(&v.transpose())
    };
    let expected = Matrix::from_fn(m, n, |i, j| a[(i, j)] / scale);
    for svd in [&all, &thin] {
        let off = largest_difference(&of(svd), &expected);
        assert!(off <= within, "{name}: off by {off:.1e} of {within:.1e}");
    }
}

#[test]
fn singular_values_by_hand() {
    // a column (3, 4):   σ = 5
    let column = Matrix::from_fn(2, 1, |i, _| [3.0, 4.0][i]);
    assert!((singular_values(&column).unwrap()[0] - 5.0).abs() < 1e-15);
    // [1 1; 0 1]:   σ² = (3 ± √5) / 2,   σ is the golden ratio and its inverse
    let shear = Matrix::from_fn(2, 2, |i, j| if i > j { 0.0 } else { 1.0 });
    let sigma = singular_values(&shear).unwrap();
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    assert!((sigma[0] - golden).abs() < 1e-15 && (sigma[1] - 1.0 / golden).abs() < 1e-15);
    // all entries one:   σ₁² = m n
    let sigma = singular_values(&Matrix::from_fn(3, 5, |_, _| 1.0)).unwrap();
    assert!((sigma[0] - 15.0_f64.sqrt()).abs() < 4e-15 && sigma[1] < 1e-15 && sigma[2] < 1e-15);
}

#[test]
fn a_matrix_without_rows_or_columns_has_all_vectors() {
    for (m, n) in [(0, 0), (0, 3), (4, 0)] {
        let svd = Svd::new(&Matrix::zeros(m, n)).unwrap();
        assert!(svd.sigma.is_empty());
        assert_eq!((svd.u, svd.v), (Matrix::identity(m, m), Matrix::identity(n, n)));
    }
}

#[test]
fn numbers_that_are_not_finite_have_no_decomposition() {
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (m, n) in [(1, 1), (3, 3), (7, 2), (20, 31)] {
            let mut a = Random(3).matrix(m, n);
            a[(m - 1, n / 2)] = wrong;
            assert!(Svd::new(&a).is_none() && Svd::thin(&a).is_none());
            assert!(singular_values(&a).is_none());
        }
    }
}

#[test]
fn random_matrices_are_put_together_again() {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    for m in (1..=20).chain([29, 41, 60]) {
        for n in (1..=20).chain([33, 60]) {
            checked("full", &random.matrix(m, n));
            checked("sparse", &random.sparse(m, n));
            checked("graded", &random.graded(m, n));
            checked("ones", &Matrix::from_fn(m, n, |_, _| 1.0));
            for r in [1, 2, m.min(n) / 2 + 1] {
                checked("of less rank", &random.of_rank(m, n, r));
            }
        }
    }
    checked("large", &random.matrix(400, 300));
    checked("large of less rank", &random.of_rank(300, 400, 200));
    checked("large, sparse", &random.sparse(200, 210));
}

#[test]
fn matrices_of_special_kinds_are_put_together_again() {
    let mut random = Random(5);
    for n in 1..=40 {
        checked("zeros", &Matrix::zeros(n, n + 2));
        checked("identity", &Matrix::identity(n + 3, n));
        // one singular value n times:   an orthogonal matrix
        checked("orthogonal", &Svd::new(&random.matrix(n, n)).unwrap().u);
        // two singular values, each n / 2 times
        let q = Svd::new(&random.matrix(n, n)).unwrap();
        let two = Matrix::from_fn(n, n, |i, j| q.u[(i, j)] * if j % 2 == 0 { 3.0 } else { 1e-9 });
        checked("repeated", &two.times(&q.v.transpose()));
        let power = |i: usize| 10.0_f64.powi(-i32::try_from(i).unwrap());
        checked("falling", &Matrix::from_fn(n, n, |i, j| if i <= j { power(i) } else { 0.0 }));
        checked("rising", &Matrix::from_fn(n, n, |i, j| if i <= j { power(n - i) } else { 0.0 }));
        let jordan = |i: usize, j: usize| if i + 1 == j { 1.0 } else { 0.0 };
        checked("nilpotent", &Matrix::from_fn(n, n, jordan));
        let beside = |i: usize, j: usize| jordan(i, j) + if i == j { 1.0 } else { 0.0 };
        checked(
            "bidiagonal",
            &Matrix::from_fn(n, n, |i, j| if i == n / 2 { 0.0 } else { beside(i, j) }),
        );
        #[allow(clippy::cast_precision_loss, reason = "a small count")]
        let hilbert = |i: usize, j: usize| 1.0 / (i + j + 1) as f64;
        checked("Hilbert", &Matrix::from_fn(n, n, hilbert));
        // every row twice
        let once = random.sparse(n, n + 4);
        checked("twice", &Matrix::from_fn(2 * n, n + 4, |i, j| once[(i % n, j)]));
        for scale in [1e-300, 1e-160, 1e160, 1e300] {
            let mut scaled = random.matrix(n, n);
            scaled.scale(scale);
            checked("scaled", &scaled);
        }
    }
}

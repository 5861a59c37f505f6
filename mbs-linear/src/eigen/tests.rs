//! Eigenvalues compared with cases by hand, with closed forms, and with the characteristic polynomial of matrices of many kinds.

use super::eigenvalues;
use alloc::vec;
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

    fn square(&mut self, n: usize) -> Vec<f64> {
        (0..n * n).map(|_| self.draw()).collect()
    }
}

fn from_fn(n: usize, entry: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    (0..n * n).map(|k| entry(k % n, k / n)).collect()
}

/// Returns the state matrix [0 1; −K −C].
fn state_matrix(
    f: usize,
    k: impl Fn(usize, usize) -> f64,
    c: impl Fn(usize, usize) -> f64,
) -> Vec<f64> {
    from_fn(2 * f, |i, j| match (i < f, j < f) {
        (true, _) => f64::from(u8::from(j == i + f)),
        (false, true) => -k(i - f, j),
        (false, false) => -c(i - f, j - f),
    })
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Checks that each of `ours` can be paired with one of `theirs`, with a difference of at most `near`.
fn same(name: &str, ours: &[[f64; 2]], theirs: &[[f64; 2]], near: impl Fn([f64; 2]) -> f64) {
    assert_eq!(ours.len(), theirs.len(), "{name}");
    let mut left = theirs.to_vec();
    for &value in ours {
        let nearest = (0..left.len())
            .min_by(|&i, &j| apart(value, left[i]).total_cmp(&apart(value, left[j])));
        let other = left.swap_remove(nearest.expect("as many"));
        let limit = near(value);
        assert!(apart(value, other) <= limit, "{name}: {value:?} and {other:?}, {limit:.1e}");
    }
}

/// Checks the eigenvalues λ by the characteristic polynomial: Π (λ − z) = det(A − z) on the circle |z| = 2 ‖A‖.
///
/// On that circle, elimination without exchanges of rows is accurate to machine precision. An error δ of one λ changes the product by the
/// factor 1 + δ / (λ − z). So all eigenvalues are correct within about 50 n ε ‖A‖.
fn checked(name: &str, n: usize, a: &[f64]) {
    let ours = eigenvalues(n, a).unwrap_or_else(|| panic!("{name}, {n}: does not converge"));
    let conjugate = |i: usize| ours[i][1] == 0.0 || ours.contains(&[ours[i][0], -ours[i][1]]);
    assert!((0..n).all(conjugate), "{name}, {n}: in pairs");
    let norm = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    let radius = if norm == 0.0 { 1.0 } else { 2.0 * norm };
    for k in 0..8 {
        let (sine, cosine) = (0.3 + 0.7 * f64::from(k)).sin_cos();
        let z = [cosine, sine].map(|x| radius * x);
        let mut ratio = [1.0, 0.0];
        for (pivot, value) in pivots(n, a, z).into_iter().zip(&ours) {
            ratio = times(ratio, over(pivot, [value[0] - z[0], value[1] - z[1]]));
        }
        #[allow(clippy::cast_precision_loss, reason = "a small count")]
        let limit = 16.0 * n as f64 * f64::EPSILON;
        let off = apart(ratio, [1.0, 0.0]);
        assert!(off <= limit, "{name}, {n}: the product is off by {off:.1e} of {limit:.1e}");
    }
}

fn times(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn over(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let size = b[0].hypot(b[1]);
    times(a, [b[0], -b[1]]).map(|x| x / size / size)
}

/// Returns the pivots of A − z, without exchanges of rows.
fn pivots(n: usize, a: &[f64], z: [f64; 2]) -> Vec<[f64; 2]> {
    let mut rows: Vec<[f64; 2]> = (0..n * n).map(|k| [a[k % n * n + k / n], 0.0]).collect();
    for i in 0..n {
        let diagonal = &mut rows[i * n + i];
        *diagonal = [diagonal[0] - z[0], diagonal[1] - z[1]];
    }
    for i in 0..n {
        let (above, below) = rows.split_at_mut((i + 1) * n);
        let own = &above[i * n..];
        for row in below.chunks_exact_mut(n) {
            let factor = over(row[i], own[i]);
            for (x, &own) in row[i..].iter_mut().zip(&own[i..]) {
                let part = times(factor, own);
                *x = [x[0] - part[0], x[1] - part[1]];
            }
        }
    }
    (0..n).map(|i| rows[i * n + i]).collect()
}

/// Returns the n roots of x^n = c.
fn roots(n: usize, c: f64) -> Vec<[f64; 2]> {
    #[allow(clippy::cast_precision_loss, reason = "small counts")]
    let root = |k: usize| {
        let (sine, cosine) = (core::f64::consts::TAU * k as f64 / n as f64).sin_cos();
        [cosine, sine].map(|x| x * c.powf(1.0 / n as f64))
    };
    (0..n).map(root).collect()
}

/// Checks that the matrix has the expected eigenvalues, within `share` times the largest one.
fn has(name: &str, n: usize, a: &[f64], expected: &[[f64; 2]], share: f64) {
    let ours = eigenvalues(n, a).unwrap_or_else(|| panic!("{name}, {n}: does not converge"));
    let largest = expected.iter().fold(0.0, |most: f64, x| most.max(x[0].hypot(x[1])));
    same(name, &ours, expected, |_| share * largest);
}

#[test]
fn eigenvalues_by_hand() {
    assert!(eigenvalues::<f64>(0, &[]).unwrap().is_empty());
    assert_eq!(eigenvalues(1, &[-3.5]).unwrap(), [[-3.5, 0.0]]);
    // an undamped mass on a spring has   ± i ω
    assert_eq!(eigenvalues(2, &[0.0, -9.0, 1.0, 0.0]).unwrap(), [[0.0, 3.0], [0.0, -3.0]]);
    // a free mass has   0 twice
    assert_eq!(eigenvalues(2, &[0.0, 0.0, 1.0, 0.0]).unwrap(), [[0.0; 2]; 2]);
    // a strongly overdamped mass, [0 1; −1 −c], has   −1/c − 1/c³ and −c + 1/c
    for c in [1e6_f64, 1e9] {
        let ours = eigenvalues(2, &[0.0, -1.0, 1.0, -c]).unwrap();
        let slow = -1.0 / c - c.powi(-3);
        same("slow", &ours, &[[slow, 0.0], [1.0 / c - c, 0.0]], |v| {
            4.0 * f64::EPSILON * v[0].abs()
        });
    }
    // [2 1; 1 2] has   3 and 1
    assert_eq!(eigenvalues(2, &[2.0, 1.0, 1.0, 2.0]).unwrap(), [[3.0, 0.0], [1.0, 0.0]]);
}

#[test]
fn numbers_that_are_not_finite_have_no_eigenvalues() {
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for n in [1, 2, 3, 8, 31] {
            let mut a = Random(3).square(n);
            a[n * n / 2] = wrong;
            assert_eq!(eigenvalues(n, &a), None);
        }
    }
}

#[test]
fn eigenvalues_beyond_the_numbers_are_none() {
    assert_eq!(eigenvalues(2, &[1.7e308; 4]), None);
}

#[test]
fn single_precision_finds_soft_and_stiff_springs_apart() {
    // [0 1; −K 0], K = diag(1e14, 1e-12): squares of the soft spring's entries underflow in single precision
    let a =
        [0.0, 0.0, -1e14, 0.0, 0.0, 0.0, 0.0, -1e-12, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0_f32];
    let mut found: Vec<f32> = eigenvalues(4, &a).unwrap().iter().map(|x| x[1]).collect();
    found.sort_by(f32::total_cmp);
    for (found, expected) in found.iter().zip([-1e7, -1e-6, 1e-6, 1e7]) {
        assert!((found - expected).abs() <= 1e-6 * expected.abs(), "{found} {expected}");
    }
}

#[test]
fn stiff_and_soft_springs_on_the_same_coordinates_are_found() {
    // K = 1 + 24999999.75 s sᵀ,   s = (1, −1, −1, −1):   ω² = 1 three times, and 1e8
    let s = [1.0, -1.0, -1.0, -1.0];
    let k = |i: usize, j: usize| f64::from(u8::from(i == j)) + 24_999_999.75 * s[i] * s[j];
    sprung("of four", &[1.0, 1.0, 1.0, 1e8], k);
    // K = H diag(ω²) H,   H = 1 − 2 x xᵀ / xᵀx
    let mut random = Random(23);
    for f in 2..=14 {
        for spectrum in [&[1e8, 1e-4][..], &[1e8, 1.0], &[1e10, 1e2, 1e-2], &[1.0]] {
            for _ in 0..4 {
                let squares: Vec<f64> = (0..f).map(|i| spectrum[i % spectrum.len()]).collect();
                let x: Vec<f64> = (0..f).map(|_| random.draw()).collect();
                let length: f64 = x.iter().map(|x| x * x).sum();
                let h =
                    |i: usize, j: usize| f64::from(u8::from(i == j)) - 2.0 * x[i] * x[j] / length;
                let k = |i: usize, j: usize| {
                    (0..f).map(|l| h(i, l) * squares[l] * h(l, j)).sum::<f64>()
                };
                sprung("turned", &squares, k);
            }
        }
    }
}

/// Checks the eigenvalues ± i ω of undamped springs. The errors are limited by the rounding of K: δ(ω²) ≤ c ε ω²max, and δω is the smaller
/// of δ(ω²) / 2ω and √δ(ω²).
fn sprung(name: &str, squares: &[f64], k: impl Fn(usize, usize) -> f64) {
    let f = squares.len();
    let ours = eigenvalues(2 * f, &state_matrix(f, k, |_, _| 0.0));
    let ours = ours.unwrap_or_else(|| panic!("{name}, {f}: does not converge"));
    let expected: Vec<[f64; 2]> =
        squares.iter().flat_map(|k| [[0.0, k.sqrt()], [0.0, -k.sqrt()]]).collect();
    let largest = squares.iter().fold(0.0, |l: f64, &x| l.max(x));
    let off = 1e3 * f64::EPSILON * largest;
    same(name, &ours, &expected, |value| off.sqrt().min(off / value[0].hypot(value[1])));
}

#[test]
fn random_matrices_have_their_characteristic_polynomials() {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    for n in (1..=40).chain([60, 97]) {
        for _ in 0..3 {
            checked("full", n, &random.square(n));
            let symmetric = random.square(n);
            let symmetric = from_fn(n, |i, j| symmetric[i * n + j] + symmetric[j * n + i]);
            checked("symmetric", n, &symmetric);
            let skew = random.square(n);
            checked("skew", n, &from_fn(n, |i, j| skew[i * n + j] - skew[j * n + i]));
            // A ← D⁻¹ A D with entries of sizes 10^-12 to 10^12: balancing finds the eigenvalues of A
            let plain = random.square(n);
            let size: Vec<f64> = (0..n).map(|_| 10.0_f64.powf(6.0 * random.draw())).collect();
            let graded = from_fn(n, |i, j| plain[j * n + i] / size[i] * size[j]);
            let (ours, expected) =
                (eigenvalues(n, &graded).unwrap(), eigenvalues(n, &plain).unwrap());
            same("graded", &ours, &expected, |_| 1e-9);
            for scale in [1e-300, 1e-160, 1e160, 1e300] {
                let scaled: Vec<f64> = plain.iter().map(|x| x * scale).collect();
                let ours = eigenvalues(n, &scaled).unwrap();
                let ours: Vec<[f64; 2]> = ours.iter().map(|x| x.map(|x| x / scale)).collect();
                same("scaled", &ours, &expected, |_| 1e-9);
            }
        }
    }
}

#[test]
fn repeated_and_defective_eigenvalues_are_found() {
    let mut random = Random(5);
    for n in 1..=12 {
        let next = |i: usize, j: usize| f64::from(u8::from(i + 1 == j));
        let unit = |i: usize, j: usize| f64::from(u8::from(i == j));
        let all = |value: f64| vec![[value, 0.0]; n];
        has("zeros", n, &vec![0.0; n * n], &all(0.0), 0.0);
        has("identity", n, &from_fn(n, unit), &all(1.0), 1e-15);
        has("Jordan", n, &from_fn(n, |i, j| 2.0 * unit(i, j) + next(i, j)), &all(2.0), 1e-15);
        let lower = from_fn(n, |i, j| 2.0 * unit(i, j) + next(j, i));
        has("Jordan, lower", n, &lower, &all(2.0), 1e-15);
        // a rounding error ε moves an n-fold eigenvalue of a full matrix by about ε^(1/n), so the tolerance is that large
        let x = random.square(n);
        let norm: f64 = x.iter().map(|x| x * x).sum();
        let jordan = |i: usize, j: usize| unit(i, j) + next(i, j);
        // (1 − 2 x xᵀ) J (1 − 2 x xᵀ), with the first column of the random matrix as x
        let x: Vec<f64> = x[..n].to_vec();
        let length: f64 = x.iter().map(|x| x * x).sum();
        let q = |i: usize, j: usize| unit(i, j) - 2.0 * x[i] * x[j] / length;
        let turned = from_fn(n, |i, j| {
            (0..n).map(|k| (0..n).map(|l| q(i, k) * jordan(k, l) * q(l, j)).sum::<f64>()).sum()
        });
        #[allow(clippy::cast_precision_loss, reason = "a small count")]
        let root = (64.0 * f64::EPSILON).powf(1.0 / n as f64);
        assert!(norm > 0.0);
        has("Jordan, turned", n, &turned, &all(1.0), root);
        checked("Jordan, turned", n, &turned);
    }
}

#[test]
fn cycles_and_companions_have_their_roots() {
    let c = 1.774_809_211_101_797_7;
    let mut random = Random(9);
    for n in 2..=40 {
        // a cyclic permutation: without exceptional shifts the iteration would not change it
        let cycle = from_fn(n, |i, j| f64::from(u8::from((j + 1) % n == i)));
        has("cycle", n, &cycle, &roots(n, 1.0), 1e-13);
        let back = from_fn(n, |i, j| f64::from(u8::from((i + 1) % n == j)));
        has("cycle back", n, &back, &roots(n, 1.0), 1e-13);
        let last: Vec<f64> = (0..n).map(|_| random.draw()).collect();
        let companion =
            |i: usize, j: usize| if j + 1 == n { last[i] } else { f64::from(u8::from(i == j + 1)) };
        checked("companion", n, &from_fn(n, companion));
        // x^n = c
        let far = |i: usize, j: usize| {
            if i == 0 && j + 1 == n { c } else { f64::from(u8::from(i == j + 1)) }
        };
        has("root", n, &from_fn(n, far), &roots(n, c), 1e-13);
        // weakly coupled pairs: the shifts from any two adjacent rows are ± 1
        if n.is_multiple_of(2) {
            let pair = |i: usize, j: usize| f64::from(u8::from(i / 2 == j / 2 && i != j));
            for eta in [1e-3, 1e-6, 1e-9] {
                let hung = |i: usize, j: usize| {
                    if (i.is_multiple_of(2) && i >= 2 && j + 1 == i) || (i == 0 && j + 1 == n) {
                        eta
                    } else {
                        0.0
                    }
                };
                checked("hung", n, &from_fn(n, |i, j| pair(i, j) + hung(i, j)));
            }
        }
    }
}

#[test]
fn motions_have_the_frequencies_of_their_springs() {
    // a chain of masses between walls has   ω_k² = 2 k (1 − cos(k π / (f + 1))),   with a factor k up to 1e10 and no damping
    for f in [1, 2, 3, 8, 25] {
        for k in [1e-4, 1.0, 1e10] {
            let spring = |i: usize, j: usize| match i.abs_diff(j) {
                0 => 2.0 * k,
                1 => -k,
                _ => 0.0,
            };
            let ours = eigenvalues(2 * f, &state_matrix(f, spring, |_, _| 0.0)).unwrap();
            let mut expected = Vec::new();
            for i in 1..=f {
                #[allow(clippy::cast_precision_loss, reason = "a small count")]
                let angle = core::f64::consts::PI * i as f64 / (f + 1) as f64;
                let omega = (2.0 * k * (1.0 - angle.cos())).sqrt();
                expected.extend([[0.0, omega], [0.0, -omega]]);
            }
            same("chain", &ours, &expected, |_| 1e-13 * (4.0 * k).sqrt());
        }
    }
    // without coupling each eigenvalue has full relative accuracy:   stiffness of 1e10, 1 and 0, the last coordinate damped
    let (k, c) = ([1e10, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 3.0]);
    let diagonal = |of: [f64; 4]| move |i: usize, j: usize| if i == j { of[i] } else { 0.0 };
    let ours = eigenvalues(8, &state_matrix(4, diagonal(k), diagonal(c))).unwrap();
    let zero = [0.0; 2];
    let expected =
        [[0.0, 1e5], [0.0, -1e5], [0.0, 1.0], [0.0, -1.0], zero, zero, zero, [-3.0, 0.0]];
    same("alone", &ours, &expected, |value| 1e-14 * value[0].hypot(value[1]));
    // coupled by random matrices, and with random damping
    let mut random = Random(17);
    for f in 1..=15 {
        let (x, y) = (random.square(f), random.square(f));
        let gram = |x: &[f64], i: usize, j: usize| {
            (0..f).map(|l| x[l * f + i] * x[l * f + j]).sum::<f64>()
        };
        for (stiff, damped) in [(1.0, 0.0), (1.0, 1.0), (1e10, 0.0), (1e10, 1e2), (1e-6, 1e3)] {
            let a = state_matrix(f, |i, j| stiff * gram(&x, i, j), |i, j| damped * gram(&y, i, j));
            checked("motion", 2 * f, &a);
        }
    }
}

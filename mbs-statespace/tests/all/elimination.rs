//! The elimination compared with dense matrices: rank, solutions, null space, reused pivots, and the independent columns.

use mbs_statespace::elimination::{Elimination, Pattern};

/// Allowed rounding error of about ten operations on numbers of order one, with pivots of 0.3 or more.
const ROUNDING: f64 = 1e-12;

/// Generator of pseudo-random numbers in [-1, 1], the same on every machine (xorshift64*).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }
    fn below(&mut self, n: usize) -> usize {
        ((self.next() + 1.0) / 2.0 * n as f64) as usize % n
    }
}

/// A sparse m x n matrix, stored as rows of (column, value) pairs.
#[derive(Clone)]
struct Sparse {
    n: usize,
    rows: Vec<Vec<(usize, f64)>>,
}

impl Sparse {
    /// Creates `independent` random rows, then `repeated` sums of two of them with random factors.
    fn random(random: &mut Random, n: usize, independent: usize, repeated: usize) -> Self {
        let mut rows = Vec::new();
        for _ in 0..independent {
            let mut row: Vec<(usize, f64)> = Vec::new();
            for _ in 0..2 + random.below(4) {
                let c = random.below(n);
                if row.iter().all(|e| e.0 != c) {
                    row.push((c, random.next()));
                }
            }
            rows.push(row);
        }
        for _ in 0..repeated {
            let (a, b) = (random.below(independent), random.below(independent));
            let (x, y) = (random.next() + 2.0, random.next() - 2.0);
            let mut row: Vec<(usize, f64)> = rows[a].iter().map(|&(c, v)| (c, x * v)).collect();
            for &(c, v) in &rows[b].clone() {
                match row.iter_mut().find(|e| e.0 == c) {
                    Some(e) => e.1 += y * v,
                    None => row.push((c, y * v)),
                }
            }
            let at = random.below(rows.len() + 1);
            rows.insert(at, row);
        }
        Self { n, rows }
    }

    fn pattern(&self) -> Pattern {
        let mut pattern = Pattern { n_columns: self.n, starts: vec![0], columns: vec![] };
        for row in &self.rows {
            pattern.columns.extend(row.iter().map(|e| e.0 as u32));
            pattern.starts.push(pattern.columns.len() as u32);
        }
        pattern
    }

    fn values(&self) -> Vec<f64> {
        self.rows.iter().flatten().map(|e| e.1).collect()
    }

    fn times(&self, x: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|row| row.iter().map(|&(c, v)| v * x[c]).sum()).collect()
    }

    fn transposed_times(&self, y: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.n];
        for (row, y) in self.rows.iter().zip(y) {
            for &(c, v) in row {
                x[c] += v * y;
            }
        }
        x
    }

    /// Computes the rank by dense Gauss-Jordan elimination with complete pivoting, after the rows are scaled to unit length.
    fn rank(&self) -> usize {
        let mut a: Vec<Vec<f64>> = vec![vec![0.0; self.n]; self.rows.len()];
        for (to, row) in a.iter_mut().zip(&self.rows) {
            let length = row.iter().map(|e| e.1 * e.1).sum::<f64>().sqrt();
            for &(c, v) in row {
                to[c] = v / length;
            }
        }
        let mut rank = 0;
        while rank < a.len().min(self.n) {
            let all = (rank..a.len()).flat_map(|i| (0..self.n).map(move |j| (i, j)));
            let Some((i, j)) = all.max_by(|p, q| {
                a[p.0][p.1].abs().partial_cmp(&a[q.0][q.1].abs()).expect("numbers compare")
            }) else {
                break;
            };
            if a[i][j].abs() < 1e-10 {
                break;
            }
            a.swap(rank, i);
            let pivot = a[rank].clone();
            for row in &mut a[rank + 1..] {
                let f = row[j] / pivot[j];
                for (x, p) in row.iter_mut().zip(&pivot) {
                    *x -= f * p;
                }
            }
            rank += 1;
        }
        rank
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |a, b| a.max(b.abs()))
}

/// Checks J R = 0 over all rows, the identity of R on the independent columns, and the two solutions with J_d.
fn check(matrix: &Sparse, e: &Elimination<f64>, random: &mut Random) {
    let (n, m, r) = (matrix.n, matrix.rows.len(), e.rank());
    let f = n - r;
    assert_eq!(e.pivot_rows().len() + e.dropped_rows().len(), m);
    assert_eq!(e.dependent().len() + e.independent().len(), n);
    let mut basis = vec![0.0; r * f];
    e.write_basis(&mut basis);
    for i in 0..f {
        let mut x = vec![0.0; n];
        for (k, &u) in e.dependent().iter().enumerate() {
            x[u as usize] = basis[k * f + i];
        }
        x[e.independent()[i] as usize] = 1.0;
        let size = norm(&x);
        assert!(norm(&matrix.times(&x)) <= ROUNDING * size, "column {i}");
    }
    let (mut x, mut scratch) = (vec![0.0; n], vec![0.0; r]);
    let b: Vec<f64> = (0..m).map(|_| random.next()).collect();
    e.solve(&b, &mut x, &mut scratch);
    let image = matrix.times(&x);
    for &row in e.pivot_rows() {
        assert!((image[row as usize] - b[row as usize]).abs() <= ROUNDING * norm(&x).max(1.0));
    }
    assert!(e.independent().iter().all(|&u| x[u as usize] == 0.0), "only dependent ones move");
    let g: Vec<f64> = (0..n).map(|_| random.next()).collect();
    let mut y = vec![1.0; m];
    e.solve_transposed(&g, &mut y, &mut scratch);
    let image = matrix.transposed_times(&y);
    for &u in e.dependent() {
        assert!((image[u as usize] - g[u as usize]).abs() <= ROUNDING * norm(&y).max(1.0));
    }
    assert!(e.dropped_rows().iter().all(|&k| y[k as usize] == 0.0), "dropped rows carry nothing");
}

#[test]
fn random_sparse_matrices_have_the_rank_and_the_null_space_of_a_dense_elimination() {
    let mut random = Random(7);
    let mut deficient = 0;
    for trial in 0..400 {
        let n = 3 + random.below(40);
        let independent = 1 + random.below(n);
        let repeated = random.below(6);
        let matrix = Sparse::random(&mut random, n, independent, repeated);
        let mut e = Elimination::new(matrix.pattern(), vec![1.0; n]);
        let choice = e.select_pivots(&matrix.values());
        assert_eq!(choice.rank, matrix.rank(), "trial {trial}");
        deficient += usize::from(choice.rank < matrix.rows.len());
        check(&matrix, &e, &mut random);
    }
    assert!(deficient > 200, "most matrices should lack rank: {deficient}");
}

#[test]
fn frozen_pivots_serve_other_numbers_of_the_pattern_even_where_some_were_zero() {
    let (mut random, mut checked) = (Random(11), 0);
    for _ in 0..200 {
        let n = 6 + random.below(30);
        let matrix = Sparse::random(&mut random, n, n / 2, 0);
        if matrix.rank() < matrix.rows.len() {
            continue;
        }
        // The pivots are chosen for a matrix of the same pattern in which a third of the entries are zero. The first entry of each row is
        // not.
        let mut thin = matrix.clone();
        for entry in thin.rows.iter_mut().flat_map(|row| row.iter_mut().skip(1)) {
            if random.below(3) == 0 {
                entry.1 = 0.0;
            }
        }
        if thin.rank() < thin.rows.len() {
            continue;
        }
        let mut e = Elimination::new(matrix.pattern(), vec![1.0; n]);
        e.select_pivots(&thin.values());
        e.refactor(&matrix.values());
        if e.pivots().smallest > 1e-2 {
            check(&matrix, &e, &mut random);
            checked += 1;
        }
    }
    assert!(checked > 50, "most orders should serve: {checked}");
}

#[test]
fn light_columns_become_dependent() {
    // x + y = 0 with masses 100 and 1: the light y becomes dependent.
    let pattern = Pattern { n_columns: 2, starts: vec![0, 2], columns: vec![0, 1] };
    let mut e = Elimination::new(pattern, vec![0.1, 1.0]);
    e.select_pivots(&[1.0, 1.0]);
    assert_eq!((e.dependent(), e.independent()), (&[1][..], &[0][..]));
}

#[test]
fn pivots_show_how_near_a_matrix_is_to_losing_rank() {
    // In [1 1; 1 1+e] the second row adds e to the first one.
    let pattern = Pattern { n_columns: 2, starts: vec![0, 2, 4], columns: vec![0, 1, 0, 1] };
    let mut e = Elimination::new(pattern, vec![1.0; 2]);
    assert_eq!(e.select_pivots(&[1.0, 1.0, 1.0, -1.0]).rank, 2);
    for share in [1e-3, 1e-6] {
        e.refactor(&[1.0, 1.0, 1.0, 1.0 + share]);
        let pivots = e.pivots();
        assert!((0.1 * share..share).contains(&pivots.smallest), "{pivots:?}");
        assert!(pivots.decay < share, "{pivots:?}");
    }
    let lost = e.select_pivots(&[1.0, 1.0, 1.0, 1.0]);
    assert_eq!((lost.rank, lost.rest), (1, (lost.rest.0, 0.0)));
    assert_eq!(e.dropped_rows().len(), 1);
}

#[test]
fn a_row_of_zeros_and_an_empty_matrix_are_no_constraints() {
    let pattern = Pattern { n_columns: 2, starts: vec![0, 0, 1], columns: vec![1] };
    let mut e = Elimination::new(pattern, vec![1.0; 2]);
    assert_eq!(e.select_pivots(&[0.0]).rank, 0);
    assert_eq!(e.select_pivots(&[3.0]).rank, 1);
    assert_eq!((e.dependent(), e.dropped_rows()), (&[1][..], &[0][..]));
    let mut none = Elimination::<f64>::new(
        Pattern { n_columns: 3, starts: vec![0], columns: vec![] },
        vec![1.0; 3],
    );
    assert_eq!(none.select_pivots(&[]).rank, 0);
    assert_eq!(none.independent(), &[0, 1, 2]);
}

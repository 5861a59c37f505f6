//! Symmetric equilibration of a sum of blocks, and its products.
//!
//! ```text
//! r_i = max_j |s_i a_ij s_j|,   s_i <- s_i / sqrt(r_i)        (Ruiz, 2001): every row of S A S tends to a largest entry of 1
//! ```

use crate::Real;

/// Rounds of the scaling; each takes the square root of what is left of the spread.
const ROUNDS: u32 = 3;

/// Finds `scale` (n places) for the sum of packed `blocks`, each with its clique; `rows` (n places) is scratch.
///
/// Entries of different blocks are taken one by one, not summed. Cost: three passes over all blocks.
pub fn equilibrate<'a, T: Real>(
    blocks: impl Iterator<Item = (&'a [u32], &'a [T])> + Clone,
    scale: &mut [T],
    rows: &mut [T],
) {
    scale.fill(T::ONE);
    for _ in 0..ROUNDS {
        rows.fill(T::ZERO);
        for (clique, block) in blocks.clone() {
            let mut rest = block;
            for (j, &v) in clique.iter().enumerate() {
                let (column, next) = rest.split_at(clique.len() - j);
                rest = next;
                let (s, mut most) = (scale[v as usize], rows[v as usize]);
                for (&u, &x) in clique[j..].iter().zip(column) {
                    let x = (x * s * scale[u as usize]).abs();
                    most = most.max(x);
                    rows[u as usize] = rows[u as usize].max(x);
                }
                rows[v as usize] = most;
            }
        }
        for (s, &r) in scale.iter_mut().zip(&*rows) {
            if r > T::ZERO && r.is_finite() {
                *s /= r.sqrt();
            }
        }
    }
}

/// b <- b - A x for one packed block.
pub fn subtract_product<T: Real>(clique: &[u32], block: &[T], x: &[T], b: &mut [T]) {
    let mut rest = block;
    for (j, &v) in clique.iter().enumerate() {
        let (column, next) = rest.split_at(clique.len() - j);
        rest = next;
        b[v as usize] -= column[0] * x[v as usize];
        for (&u, &a) in clique[j + 1..].iter().zip(&column[1..]) {
            b[u as usize] -= a * x[v as usize];
            b[v as usize] -= a * x[u as usize];
        }
    }
}

//! Error-free transforms of two numbers: their rounded sum or product, and its rounding error.
//!
//! A fused multiply-add is not used: without hardware support it is a slow call, and a product can be split exactly without it. The results
//! have the same bits on every target whose `f64` is IEEE 754 binary64 in every operation. This excludes 32-bit x86 without SSE2, whose x87
//! registers are wider.

/// Factor 2²⁷ + 1: its product with a number separates the upper 26 bits from the others.
const SPLITTER: f64 = 134_217_729.0;

/// Rounded sum s and rounding error e, with s + e = a + b exactly (Knuth). 6 flops. Exact for all finite numbers whose sum is finite.
#[inline]
pub(super) const fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let of_a = s - b;
    let of_b = s - of_a;
    (s, (a - of_a) + (b - of_b))
}

/// Rounded sum s and rounding error e, with s + e = a + b exactly, if |a| ≥ |b| or a = 0 (Dekker). 3 flops.
#[inline]
pub(super) const fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// Splits a into two parts of at most 26 bits each whose sum is exactly a (Veltkamp). 4 flops. Requires |a| < 2⁹⁹⁶.
#[inline]
const fn split(a: f64) -> (f64, f64) {
    let c = SPLITTER * a;
    let upper = c - (c - a);
    (upper, a - upper)
}

/// Rounded product p and rounding error e, with p + e = a b exactly (Dekker). 17 flops. Exact when both factors are below 2⁹⁹⁶ and the
/// product is above 2⁻⁹⁶⁹. Below that, e is rounded to a multiple of 2⁻¹⁰⁷⁴.
#[inline]
pub(super) const fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let (a_up, a_low) = split(a);
    let (b_up, b_low) = split(b);
    (p, ((a_up * b_up - p) + a_up * b_low + a_low * b_up) + a_low * b_low)
}

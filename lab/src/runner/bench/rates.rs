//! Best rates of this machine for this program as it is compiled: products and sums per second, and bytes read per second.
//!
//! ```text
//! packed:   x <- x p + s for 28 numbers in registers, none waiting for another
//! scalar:   the same three times over for one number after another, each found by its place, which the compiler cannot pack
//! bytes:    the sum of an array that fits the second cache, and of one that fits none
//! ```

use serde_json::{Value, json};
use std::fs::read_to_string;
use std::hint::black_box;
use std::time::Instant;

/// Number of values in registers: two in each of fourteen registers.
const NUMBERS: usize = 28;
/// Number of products with sums per value that is read and written.
const DEPTH: usize = 3;
/// Number of rounds in a measurement [-]. Chosen, not tuned.
const ROUNDS: u32 = 50_000;
/// Number of measurements, of which the shortest time counts [-]. Chosen, not tuned.
const TURNS: usize = 300;

/// Sizes of the second and the last cache where the system does not report them [bytes].
const CACHES: [usize; 2] = [1 << 20, 32 << 20];
/// Largest number of bytes that is read beyond the last cache [bytes]. Chosen, not tuned.
const MAX_BYTES: usize = 256 << 20;

/// The rates as a line.
pub(crate) fn measure() -> Value {
    let [second, last] = caches();
    let [near, far] = [second / 2, (4 * last).min(MAX_BYTES)];
    json!({
        "kind": "rates", "scalar": scalar(), "packed": packed(),
        "near": bytes(near), "far": bytes(far), "near_size": near, "far_size": far,
        "second_cache": second, "last_cache": last,
    })
}

/// The least time of some work [s].
fn least(mut work: impl FnMut()) -> f64 {
    let mut turn = || {
        let clock = Instant::now();
        work();
        clock.elapsed().as_secs_f64()
    };
    (0..TURNS).map(|_| turn()).fold(f64::INFINITY, f64::min)
}

/// Products and sums per second, two in one instruction.
fn packed() -> f64 {
    let seconds = least(|| _ = black_box(in_registers(ROUNDS, black_box([0.5, 1.0]))));
    #[allow(clippy::cast_precision_loss, reason = "a small count")]
    let n = (2 * NUMBERS) as f64;
    f64::from(ROUNDS) * n / seconds
}

#[inline(never)]
fn in_registers(rounds: u32, [p, s]: [f64; 2]) -> [f64; NUMBERS] {
    let mut x = [s; NUMBERS];
    for _ in 0..rounds {
        x.iter_mut().for_each(|x| *x *= p);
        x.iter_mut().for_each(|x| *x += s);
    }
    x
}

/// Products and sums per second, one in one instruction.
fn scalar() -> f64 {
    let mut x = [1.0; 64];
    let places: Vec<u8> = (0..ROUNDS).map(|i| (i % 64) as u8).collect();
    let seconds = least(|| by_place(&mut x, black_box(&places), black_box([0.5, 1.0])));
    black_box(&x);
    #[allow(clippy::cast_precision_loss, reason = "a small count")]
    let n = (2 * DEPTH) as f64;
    f64::from(ROUNDS) * n / seconds
}

#[inline(never)]
fn by_place(x: &mut [f64; 64], places: &[u8], [p, s]: [f64; 2]) {
    for &at in places {
        let x = &mut x[usize::from(at % 64)];
        let mut y = *x;
        for _ in 0..DEPTH {
            y = y * p + s;
        }
        *x = y;
    }
}

/// Bytes per second when an array of `size` bytes is read.
fn bytes(size: usize) -> f64 {
    let array = vec![1.0; size / size_of::<f64>()];
    let times = (MAX_BYTES / 16 / size).max(1);
    let seconds = least(|| (0..times).for_each(|_| _ = black_box(sum(black_box(&array)))));
    #[allow(clippy::cast_precision_loss, reason = "far below 2^53")]
    let read = (times * size) as f64;
    read / seconds
}

#[inline(never)]
fn sum(array: &[f64]) -> f64 {
    let mut sums = [0.0; 16];
    for chunk in array.chunks_exact(16) {
        for i in 0..16 {
            sums[i] += chunk[i];
        }
    }
    sums.iter().sum()
}

/// Sizes of the second cache and of the last one, in bytes.
fn caches() -> [usize; 2] {
    let folder = "/sys/devices/system/cpu/cpu0/cache";
    let read = |i: usize, what: &str| read_to_string(format!("{folder}/index{i}/{what}")).ok();
    let mut found = CACHES;
    for i in 0..8 {
        let level = read(i, "level").and_then(|text| text.trim().parse::<u32>().ok());
        let size = read(i, "size").and_then(|text| size(text.trim()));
        match (level, size) {
            (Some(2), Some(size)) => found = [size, size],
            (Some(3..), Some(size)) => found[1] = size,
            _ => {}
        }
    }
    found
}

/// Size in bytes of a text such as 1024K or 32M.
fn size(text: &str) -> Option<usize> {
    let (number, unit) = text.split_at(text.len().checked_sub(1)?);
    let unit = match unit {
        "K" => 1 << 10,
        "M" => 1 << 20,
        _ => return text.parse().ok(),
    };
    Some(number.parse::<usize>().ok()? * unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_of_caches_have_units() {
        assert_eq!([size("32768K"), size("2M"), size("x")], [Some(32 << 20), Some(2 << 20), None]);
    }
}

//! Placement of stack and heap in memory, changed for each timing. The placement changes a time by some per cent. With one fixed placement,
//! repeated timings would all have the same bias.

use std::hint::black_box;

/// Smallest size of a stack level, in bytes. It is no power of two, so that levels begin at all positions within a page.
const LEVEL: usize = 208;
/// Number of stack levels, which is prime: steps of seven levels reach each of them. Chosen, not tuned.
pub const LEVELS: u32 = 19;
/// Number of heap blocks that are allocated before the call, so that later blocks have other addresses. Chosen, not tuned.
const BLOCKS: u32 = 48;

/// Calls a function with stack and heap moved. The displacement depends on `turn` only.
pub fn moved<R>(turn: u32, call: impl FnOnce() -> R) -> R {
    let size = |k: u32| (32_usize << ((k + turn) % 8)) + 16 * ((k * (turn + 3)) % 11) as usize;
    let held: Vec<Vec<u8>> = (0..BLOCKS)
        .filter(|k| !(k + turn).is_multiple_of(3))
        .map(|k| Vec::with_capacity(size(k)))
        .collect();
    let result = deeper((turn * 7) % LEVELS, call);
    drop(black_box(held));
    result
}

#[inline(never)]
fn deeper<R>(levels: u32, call: impl FnOnce() -> R) -> R {
    let level = black_box([0_u8; LEVEL]);
    let result = if levels == 0 { call() } else { deeper(levels - 1, call) };
    black_box(&level);
    result
}

//! Place of stack and heap in memory, another one for each timing. Where they happen to lie decides some per cent of a time; a process that
//! keeps them where they are measures its luck, however often it repeats.

use std::hint::black_box;

/// Least bytes of a level of the stack: no power of two, so that levels begin at all places within a page.
const LEVEL: usize = 208;
/// Most levels of the stack: prime, so that seven at a time come to each. Chosen, not tuned.
pub const LEVELS: u32 = 19;
/// Blocks of the heap that are held, so that what comes later is elsewhere. Chosen, not tuned.
const BLOCKS: u32 = 48;

/// Calls a function with stack and heap moved, by an amount that depends on the turn alone.
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

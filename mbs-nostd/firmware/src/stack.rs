//! Measurement of the used stack by a fill pattern. Only this file accesses memory by address.
//!
//! The stack grows down from the end of RAM (`_stack_start` of the linker script) towards the end of the static data (`__euninit`). The
//! memory between the static data and the stack pointer is unused. It is filled with a pattern, which later stack frames overwrite. Words
//! are read and written volatile, and only between these two addresses.

use core::ptr::{addr_of, addr_of_mut};

unsafe extern "C" {
    static mut __euninit: u32;
    static _stack_start: u32;
}

/// Pattern of unused words.
const PAINT: u32 = 0x5ca1_ab1e;
/// Number of bytes below the stack pointer that are not filled, because the frames of this file's functions use them.
const MARGIN: usize = 512;

/// Fills the unused memory with the pattern.
#[inline(never)]
pub fn paint() {
    let here = cortex_m::register::msp::read() as usize;
    // SAFETY: the memory from the end of the static data to a margin below the stack pointer is unused.
    unsafe {
        let mut word = addr_of_mut!(__euninit);
        while (word as usize) + MARGIN < here {
            word.write_volatile(PAINT);
            word = word.add(1);
        }
    }
}

/// Returns the number of bytes used since `paint`.
#[inline(never)]
pub fn used() -> usize {
    // SAFETY: words between the end of the static data and the start of the stack are only read.
    unsafe {
        let end = addr_of!(_stack_start) as usize;
        let mut word = addr_of!(__euninit);
        while (word as usize) < end && word.read_volatile() == PAINT {
            word = word.add(1);
        }
        end - word as usize
    }
}

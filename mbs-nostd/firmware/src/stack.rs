//! How much stack was used, by paint: the one file here that touches memory by address.
//!
//! The stack grows down from the end of RAM to the end of the static data (`_stack_start` and `__euninit` of the linker script).
//! What lies between the latter and the stack pointer is not in use; it is painted, and whoever used it later has
//! scratched the paint off. Words are read and written volatile, within these two addresses alone.

use core::ptr::{addr_of, addr_of_mut};

unsafe extern "C" {
    static mut __euninit: u32;
    static _stack_start: u32;
}

/// What unused words hold.
const PAINT: u32 = 0x5ca1_ab1e;
/// Bytes below the stack pointer that are left alone: the frames of this file.
const MARGIN: usize = 512;

/// Paints what is unused.
#[inline(never)]
pub fn paint() {
    let here = cortex_m::register::msp::read() as usize;
    // SAFETY: from the end of the static data to a margin below the stack pointer lies nothing that anybody uses.
    unsafe {
        let mut word = addr_of_mut!(__euninit);
        while (word as usize) + MARGIN < here {
            word.write_volatile(PAINT);
            word = word.add(1);
        }
    }
}

/// Bytes used since.
#[inline(never)]
pub fn used() -> usize {
    // SAFETY: words between the end of the static data and the start of the stack are read, and nothing more.
    unsafe {
        let end = addr_of!(_stack_start) as usize;
        let mut word = addr_of!(__euninit);
        while (word as usize) < end && word.read_volatile() == PAINT {
            word = word.add(1);
        }
        end - word as usize
    }
}

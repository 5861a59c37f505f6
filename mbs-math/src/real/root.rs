//! Square root in single precision. On an ARM with hardware floating point it is the processor's instruction, since libm computes it there
//! in software. On other targets it is libm's function, which uses an instruction where it can. Both round correctly, so the bits are
//! equal.
//!
//! **Proof.** Targets whose ABI passes numbers in registers of the floating-point unit (`eabihf`) have that unit. Every such unit has
//! `vsqrt.f32`. The three instructions write `s0` and one other register, both declared to the compiler. They access no memory, no stack
//! and no flag that the compiler relies on. The moves are needed for units of single precision alone: the compiler does not accept their
//! registers as operands.

#![allow(unsafe_code, reason = "the proof is above")]

/// Square root of `x`; NaN for a negative number.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[inline]
pub(super) fn root(x: f32) -> f32 {
    let root: f32;
    // SAFETY: see the proof at the top of this file.
    unsafe {
        core::arch::asm!(
            "vmov s0, {x}",
            "vsqrt.f32 s0, s0",
            "vmov {root}, s0",
            x = in(reg) x,
            root = lateout(reg) root,
            out("s0") _,
            options(pure, nomem, nostack, preserves_flags)
        );
    }
    root
}

/// Square root of `x`; NaN for a negative number.
#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
#[inline]
pub(super) fn root(x: f32) -> f32 {
    libm::sqrtf(x)
}

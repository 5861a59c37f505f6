//! The square root in single precision, by the instruction of an ARM with hardware floating point, for which libm has one in
//! software alone. Elsewhere it is libm's, which takes the instruction where there is one. Both round correctly: the bits are the same.
//!
//! **Proof.** Targets whose ABI passes numbers in registers of the floating-point unit (`eabihf`) have that unit, and every such
//! unit has `vsqrt.f32`. The three instructions write `s0` and one other register, both named to the compiler; they touch no
//! memory, no stack and no flag that the compiler keeps. (A unit of single precision alone has registers that the compiler does not
//! take as operands, hence the moves.)

#![allow(unsafe_code, reason = "the proof is above")]

/// Square root of `x`; of a negative number not a number.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[inline]
pub(super) fn root(x: f32) -> f32 {
    let root: f32;
    // SAFETY: above.
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

/// Square root of `x`; of a negative number not a number.
#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
#[inline]
pub(super) fn root(x: f32) -> f32 {
    libm::sqrtf(x)
}

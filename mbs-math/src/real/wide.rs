//! Whole numbers of 2304 bits, for exact work with decimal text. The largest number needed is a pair of `f64` times a power of ten, below
//! 2²¹⁰¹.

/// Number of limbs, of 32 bits each: 2304 bits, above the 2101 bits that are needed.
const LIMBS: usize = 72;

/// A whole number, stored from the lowest limb to the highest.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Wide([u32; LIMBS]);

impl Wide {
    pub(super) const ZERO: Self = Self([0; LIMBS]);

    pub(super) fn from_u64(x: u64) -> Self {
        let mut of = Self::ZERO;
        of.add(x, 0);
        of
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.iter().all(|&limb| limb == 0)
    }

    /// Adds x 2^shift to the number; bits above the highest limb are lost.
    #[allow(clippy::cast_possible_truncation, reason = "a number is cut into its limbs")]
    pub(super) fn add(&mut self, x: u64, shift: usize) {
        let mut carry = u128::from(x) << (shift % 32);
        for limb in self.0.iter_mut().skip(shift / 32) {
            carry += u128::from(*limb);
            *limb = carry as u32;
            carry >>= 32;
        }
    }

    /// Subtracts x 2^shift from the number, which must be at least as large.
    #[allow(clippy::cast_possible_truncation, reason = "a number is cut into its limbs")]
    pub(super) fn subtract(&mut self, x: u64, shift: usize) {
        let mut owed = u128::from(x) << (shift % 32);
        for limb in self.0.iter_mut().skip(shift / 32) {
            let (left, borrowed) = limb.overflowing_sub(owed as u32);
            *limb = left;
            owed = (owed >> 32) + u128::from(borrowed);
        }
    }

    /// Multiplies the number by a small whole number.
    #[allow(clippy::cast_possible_truncation, reason = "a number is cut into its limbs")]
    pub(super) fn multiply(&mut self, by: u32) {
        let mut carry = 0_u64;
        for limb in &mut self.0 {
            carry += u64::from(*limb) * u64::from(by);
            *limb = carry as u32;
            carry >>= 32;
        }
    }

    /// Multiplies the number by 10ⁿ.
    pub(super) fn multiply_by_ten_to(&mut self, n: u32) {
        (0..n).for_each(|_| self.multiply(10));
    }

    /// Multiplies the number by 2ⁿ.
    pub(super) fn shift_up(&mut self, n: usize) {
        let (limbs, bits) = (n / 32, n % 32);
        for i in (0..LIMBS).rev() {
            let at = |k: usize| i.checked_sub(limbs + k).map_or(0, |j| u64::from(self.0[j]));
            let joined = (at(0) << 32 | at(1)) << bits;
            #[allow(clippy::cast_possible_truncation, reason = "the upper limb of two")]
            {
                self.0[i] = (joined >> 32) as u32;
            }
        }
    }

    /// Subtracts `other` if it is not larger than the number; returns `true` if it did.
    fn take(&mut self, other: &Self) -> bool {
        if *self < *other {
            return false;
        }
        let mut borrowed = false;
        for (limb, &by) in self.0.iter_mut().zip(&other.0) {
            let (once, first) = limb.overflowing_sub(by);
            let (twice, second) = once.overflowing_sub(u32::from(borrowed));
            *limb = twice;
            borrowed = first || second;
        }
        true
    }

    /// Divides by `other` and returns the quotient, which must be below 2ⁿ. The number becomes the remainder. `other` times 2ⁿ must fit.
    pub(super) fn divide(&mut self, other: &Self, n: usize) -> u128 {
        let mut quotient = 0;
        for bit in (0..n).rev() {
            let mut part = *other;
            part.shift_up(bit);
            quotient = quotient << 1 | u128::from(self.take(&part));
        }
        quotient
    }

    /// Number of bits up to the highest bit that is set.
    pub(super) fn bits(&self) -> usize {
        let top = self.0.iter().rposition(|&limb| limb != 0);
        top.map_or(0, |i| 32 * (i + 1) - self.0[i].leading_zeros() as usize)
    }
}

impl PartialOrd for Wide {
    fn partial_cmp(&self, other: &Self) -> Option<core::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Wide {
    fn cmp(&self, other: &Self) -> core::cmp::Ordering {
        self.0.iter().rev().cmp(other.0.iter().rev())
    }
}

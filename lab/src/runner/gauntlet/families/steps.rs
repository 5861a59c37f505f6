//! Cases with very small, very large or very many steps, with single precision, and with any penalty factor.

use super::bases::{any, chain, four_bar};
use super::common::{case, decades, time};
use crate::gauntlet::case::{Case, Options, Truth};
use mbs::scene_file::Dice;

/// A million steps of a chain or a four-bar.
pub(super) fn long(dice: &mut Dice) -> Case {
    let draft = if dice.once_in(2) { chain(dice, 2) } else { four_bar(dice) };
    case(&draft, "a million steps", (1e-3, 1e3), Truth::Invariants)
}

/// Any mechanism with steps of 1e-7 s.
pub(super) fn tiny(dice: &mut Dice) -> Case {
    let draft = any(dice);
    case(&draft, "tiny steps", time(dice, &[1e-7], 1e-4), Truth::Extrapolated)
}

/// Any mechanism with steps of up to a fifth of a second: roughly ten steps per oscillation.
pub(super) fn large(dice: &mut Dice) -> Case {
    let draft = any(dice);
    let time = time(dice, &[2e-1, 1e-1, 5e-2, 2e-2], 2.0);
    case(&draft, "large steps", time, Truth::Others)
}

/// Any mechanism with a random fixed penalty factor, in the formulations that have one.
pub(super) fn penalties(dice: &mut Dice) -> Case {
    let draft = any(dice);
    let penalty = decades(dice, 3.0, 13.0);
    let time = time(dice, &[1e-2, 1e-3, 1e-4], 0.2);
    let case = case(&draft, "penalty", time, Truth::Others);
    Case { options: Options { penalty: Some(penalty), ..Options::default() }, ..case }
}

/// A case in single precision. Its reference is in double precision.
pub(super) fn single(dice: &mut Dice) -> Case {
    let draft = any(dice);
    let time = time(dice, &[1e-2, 3e-3, 1e-3], 0.5);
    let case = case(&draft, "single precision", time, Truth::Others);
    Case { options: Options { is_single: true, ..Options::default() }, ..case }
}

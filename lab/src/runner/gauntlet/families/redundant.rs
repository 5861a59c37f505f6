//! Cases with redundant constraints.

use super::bases::{any, four_bar};
use super::common::{others, time, twin};
use super::singular::pendulum;
use crate::gauntlet::case::Case;
use crate::gauntlet::draft::{Draft, GROUND};
use crate::gauntlet::vector::{Point, Turn, dot, plus};
use mbs::scene_file::Dice;

/// Steps of the runs, from long to short, two per decade [s].
const STEPS: [f64; 4] = [1e-2, 3e-3, 1e-3, 3e-4];

/// A four-bar with revolute joints in space: three equations of each loop are redundant. The equivalent mechanism is planar.
pub(super) fn planar_in_space(dice: &mut Dice) -> Case {
    let plain = four_bar(dice);
    twin(&plain.raised(), &plain, "spatial four-bar", time(dice, &STEPS, 1.0))
}

/// A coupler on three to six parallel cranks, of which two are sufficient. It moves as a pendulum, which is the equivalent mechanism.
pub(super) fn more_cranks(dice: &mut Dice) -> Case {
    let n = 2 + dice.below(4);
    let (length, crank, coupler) =
        (dice.between(0.5, 1.5), dice.between(0.5, 2.0), dice.between(0.5, 2.0));
    let mut draft = Draft::planar();
    let foot = |k: usize| [0.7 * f64::from(u32::try_from(k).unwrap_or(0)), 0.0, 0.0];
    let head = |k: usize| plus(foot(k), length, [0.0, 1.0, 0.0]);
    let plate = draft.rod(head(0), head(n), coupler);
    for k in 0..=n {
        let body = draft.rod(foot(k), head(k), crank);
        draft.pin([GROUND, body], foot(k));
        draft.pin([body, plate], head(k));
    }
    // the rate is too small to reach the horizontal within the run
    let rate = dice.between(0.2, 0.8);
    draft.rate(0, rate);
    draft.watch(plate, head(0));
    draft.watch(plate, head(n));
    // the pendulum is defined with n couplers; the plate has the mass of all of them
    let shares = [crank, coupler / f64::from(u32::try_from(n).unwrap_or(1))];
    let plain = pendulum((n, length), shares, [head(0), head(n)], rate);
    let (draft, plain) = if dice.once_in(2) { (draft.raised(), plain) } else { (draft, plain) };
    twin(&draft, &plain, "parallelogram", time(dice, &STEPS, 0.5))
}

/// A random mechanism in which one or two joints are given twice. In the equivalent mechanism they are given once.
pub(super) fn doubled(dice: &mut Dice) -> Case {
    let plain = any(dice);
    let mut draft = plain.clone();
    for _ in 0..=dice.below(2) {
        let joint = dice.one_of(&plain.joints).clone();
        draft.joints.push(joint);
    }
    twin(&draft, &plain, "doubled joint", time(dice, &STEPS, 0.5))
}

/// A Bennett linkage: four revolute joints in space whose axes are not parallel and have no common point. By the count of equations it is
/// rigid, but it moves.
pub(super) fn bennett(dice: &mut Dice) -> Case {
    let (alpha, beta) = (dice.between(0.3, 0.8), dice.between(1.0, 1.5));
    let theta = dice.between(0.6, 2.4);
    let (places, axes) = bennett_places(alpha, beta, theta);
    let mut draft = Draft::spatial();
    let bars = [0, 1, 2].map(|i| draft.rod(places[i], places[i + 1], 1.0));
    let ends = [GROUND, bars[0], bars[1], bars[2], GROUND];
    for i in 0..4 {
        draft.joint("revolute", [ends[i], ends[i + 1]], places[i], &[axes[i]]);
    }
    draft.rate(0, dice.between(-3.0, 3.0));
    draft.watch(bars[0], places[1]);
    draft.watch(bars[2], places[2]);
    others(&draft, "Bennett", time(dice, &STEPS, 0.6))
}

/// Points and axes of a Bennett linkage with twists alpha, beta and lengths sin alpha, sin beta.
fn bennett_places(alpha: f64, beta: f64, theta: f64) -> ([Point; 4], [Point; 4]) {
    let other = ((0.5 * (beta + alpha)).sin() / (0.5 * (beta - alpha)).sin() / (0.5 * theta).tan())
        .atan()
        * 2.0;
    let (angles, twists) = ([theta, other, -theta, -other], [alpha, beta, alpha, beta]);
    let (mut at, mut x, mut y, mut z) =
        ([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let mix = |a: Point, s: f64, b: Point, t: f64| plus(a.map(|a| s * a), t, b);
    let (mut places, mut axes) = ([[0.0; 3]; 4], [[0.0; 3]; 4]);
    for i in 0..4 {
        (places[i], axes[i]) = (at, z);
        let (s, c) = angles[i].sin_cos();
        (x, y) = (mix(x, c, y, s), mix(y, c, x, -s));
        at = plus(at, twists[i].sin(), x);
        let (s, c) = twists[i].sin_cos();
        (y, z) = (mix(y, c, z, s), mix(z, c, y, -s));
    }
    debug_assert!(dot(at, at) < 1e-24, "the linkage closes: {at:?}");
    (places, axes)
}

/// Bricard's trihedral linkage: six revolute joints along the edges of a box. Each axis is perpendicular to both of its edges. The linkage
/// moves because of these lengths and angles.
pub(super) fn bricard(dice: &mut Dice) -> Case {
    let size: Point =
        if dice.once_in(2) { [1.0; 3] } else { std::array::from_fn(|_| dice.between(0.6, 1.4)) };
    let corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1], [0, 0, 1]];
    let places = corners.map(|c: [i32; 3]| std::array::from_fn(|i| f64::from(c[i]) * size[i]));
    // the axis at a corner is perpendicular to the two edges of the linkage that meet there
    let axes = [[0, 1, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0]];
    let axes = axes.map(|a: [i32; 3]| a.map(f64::from));
    let mut draft = Draft::spatial();
    let bars = [0, 1, 2, 3, 4].map(|i| draft.rod(places[i], places[i + 1], 1.0));
    let ends = [GROUND, bars[0], bars[1], bars[2], bars[3], bars[4], GROUND];
    for i in 0..6 {
        draft.joint("revolute", [ends[i], ends[i + 1]], places[i], &[axes[i]]);
    }
    draft.rate(0, dice.between(-1.0, 1.0));
    draft.watch(bars[0], places[1]);
    draft.watch(bars[2], places[3]);
    let turn = Turn::about([1.0, 0.4, -0.3], dice.between(0.0, 3.0));
    let gravity = draft.gravity;
    draft = draft.turned(&turn);
    draft.gravity = gravity;
    others(&draft, "Bricard", time(dice, &STEPS, 0.6))
}

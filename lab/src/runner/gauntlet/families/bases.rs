//! Mechanisms without a difficulty, from which difficult cases are made.

use crate::gauntlet::draft::{Draft, GROUND};
use crate::gauntlet::vector::{Point, cross, dot, plus};
use mbs::scene_file::Dice;

/// A random unit vector in space.
pub(super) fn direction(dice: &mut Dice) -> Point {
    loop {
        let x: Point = std::array::from_fn(|_| dice.between(-1.0, 1.0));
        let square = dot(x, x);
        if square > 0.05 && square < 1.0 {
            return x.map(|x| x / square.sqrt());
        }
    }
}

/// A planar chain of rods that hangs from the ground. The first rods are inclined. The output is the position of the tip.
pub(super) fn chain(dice: &mut Dice, n: usize) -> Draft {
    let mut draft = Draft::planar();
    let (mut at, mut before) = ([0.0; 3], GROUND);
    for k in 0..n {
        let (length, angle) = (dice.between(0.3, 1.0), dice.between(-0.9, 0.9));
        let end = plus(at, length, [angle.sin(), -angle.cos(), 0.0]);
        let body = draft.rod(at, end, dice.between(0.3, 2.0));
        let joint = draft.pin([before, body], at);
        draft.rate(joint, dice.between(-1.0, 1.0));
        draft.watch(body, end);
        debug_assert_eq!(joint, k);
        (at, before) = (end, body);
    }
    draft
}

/// A chain in space with random joint axes.
pub(super) fn spatial_chain(dice: &mut Dice, n: usize) -> Draft {
    let mut draft = Draft::spatial();
    let (mut at, mut before) = ([0.0; 3], GROUND);
    for _ in 0..n {
        let along = direction(dice);
        let end = plus(at, dice.between(0.3, 0.8), along);
        let mass = dice.between(0.3, 2.0);
        // the body has three different moments of inertia
        let moment = mass * dice.between(0.01, 0.03);
        let body = draft.solid(
            plus(at, 0.5, plus(end, -1.0, at)),
            mass,
            [moment, 1.3 * moment, 1.7 * moment],
        );
        let axis = across(along, dice);
        let joint = draft.joint("revolute", [before, body], at, &[axis]);
        draft.rate(joint, dice.between(-2.0, 2.0));
        draft.watch(body, end);
        (at, before) = (end, body);
    }
    draft
}

/// A random direction nearly perpendicular to another.
fn across(along: Point, dice: &mut Dice) -> Point {
    loop {
        let axis = cross(along, direction(dice));
        let length = dot(axis, axis).sqrt();
        if length > 0.2 {
            return axis.map(|x| x / length);
        }
    }
}

/// The point at distances `a` from `p` and `b` from `q` in the plane: to the left of the line from p to q with `side` 1, otherwise to the
/// right.
pub(super) fn knee(p: Point, q: Point, [a, b]: [f64; 2], side: f64) -> Option<Point> {
    let d = plus(q, -1.0, p);
    let l = dot(d, d).sqrt();
    let x = (a * a - b * b + l * l) / (2.0 * l);
    let square = a * a - x * x;
    (square >= 0.0).then(|| {
        let u = d.map(|x| x / l);
        plus(plus(p, x, u), side * square.sqrt(), [-u[1], u[0], 0.0])
    })
}

/// Adds a four-bar between two points of bodies: crank, coupler and rocker of given lengths, and the angle of the crank. `None` if it
/// cannot be closed.
pub(super) fn loop_on(
    draft: &mut Draft,
    base: usize,
    [p, q]: [Point; 2],
    [a, b, c]: [f64; 3],
    (angle, side): (f64, f64),
    masses: [f64; 3],
) -> Option<[usize; 4]> {
    let crank_end = plus(p, a, [angle.cos(), angle.sin(), 0.0]);
    let corner = knee(crank_end, q, [b, c], side)?;
    let [m, n, o] = masses;
    let (crank, coupler, rocker) =
        (draft.rod(p, crank_end, m), draft.rod(crank_end, corner, n), draft.rod(corner, q, o));
    let joints = [
        draft.pin([base, crank], p),
        draft.pin([crank, coupler], crank_end),
        draft.pin([coupler, rocker], corner),
        draft.pin([rocker, base], q),
    ];
    draft.watch(coupler, corner);
    Some(joints)
}

/// A four-bar far from its singular positions: a Grashof linkage whose crank can make full turns.
pub(super) fn four_bar(dice: &mut Dice) -> Draft {
    loop {
        let mut draft = Draft::planar();
        let (ground, crank) = (dice.between(0.8, 1.2), dice.between(0.2, 0.4));
        let sides = [crank, dice.between(0.9, 1.3), dice.between(0.7, 1.1)];
        let masses = std::array::from_fn(|_| dice.between(0.3, 2.0));
        let angle = dice.between(0.0, 6.0);
        let places = [[0.0; 3], [ground, 0.0, 0.0]];
        let mut all = [ground, sides[0], sides[1], sides[2]];
        all.sort_by(f64::total_cmp);
        let is_far = all[0] + all[3] < all[1] + all[2] - 0.1;
        if let (true, Some(joints)) =
            (is_far, loop_on(&mut draft, GROUND, places, sides, (angle, 1.0), masses))
        {
            draft.rate(joints[0], dice.between(-6.0, 6.0));
            return draft;
        }
    }
}

/// A random mechanism of the three kinds above.
pub(super) fn any(dice: &mut Dice) -> Draft {
    let n = 1 + dice.below(3);
    match dice.below(3) {
        0 => chain(dice, n),
        1 => spatial_chain(dice, n),
        _ => four_bar(dice),
    }
}

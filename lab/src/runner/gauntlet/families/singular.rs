//! Cases at or near positions in which constraints lose rank.

use super::bases::loop_on;
use super::common::{decades, others, time, twin};
use crate::gauntlet::case::Case;
use crate::gauntlet::draft::{Draft, GROUND};
use crate::gauntlet::vector::{Point, plus};
use mbs::scene_file::Dice;

/// Steps of the runs, from long to short, two per decade [s].
const STEPS: [f64; 4] = [1e-2, 3e-3, 1e-3, 3e-4];

/// Parallelograms beside each other, whose cranks pass the horizontal together. They move as a pendulum, which is the equivalent mechanism.
pub(super) fn parallelograms(dice: &mut Dice) -> Case {
    let n = 1 + dice.below(3);
    let (length, distance) = (dice.between(0.5, 1.5), dice.between(0.5, 1.5));
    let masses = [dice.between(0.5, 2.0), dice.between(0.5, 2.0)];
    let rate = -dice.between(0.5, 2.0);
    let mut draft = Draft::planar();
    let foot = |k: usize| [distance * f64::from(u32::try_from(k).unwrap_or(0)), 0.0, 0.0];
    let head = |k: usize| plus(foot(k), length, [0.0, 1.0, 0.0]);
    let cranks: Vec<usize> = (0..=n).map(|k| draft.rod(foot(k), head(k), masses[0])).collect();
    for (k, &crank) in cranks.iter().enumerate() {
        draft.pin([GROUND, crank], foot(k));
    }
    for k in 0..n {
        let coupler = draft.rod(head(k), head(k + 1), masses[1]);
        draft.pin([cranks[k], coupler], head(k));
        draft.pin([coupler, cranks[k + 1]], head(k + 1));
    }
    draft.rate(0, rate);
    draft.watch(cranks[0], head(0));
    draft.watch(cranks[n], head(n));
    let plain = pendulum((n, length), masses, [head(0), head(n)], rate);
    twin(&draft, &plain, "parallelograms", time(dice, &STEPS, 1.5))
}

/// The pendulum that is equivalent to n + 1 parallel cranks with n couplers. Arguments are n, the length of a crank, and both masses.
pub(super) fn pendulum(
    (n, length): (usize, f64),
    [crank, coupler]: [f64; 2],
    heads: [Point; 2],
    rate: f64,
) -> Draft {
    let n = f64::from(u32::try_from(n).unwrap_or(0));
    let mass = (n + 1.0) * crank + n * coupler;
    let center = ((n + 1.0) * crank * 0.5 + n * coupler) * length / mass;
    let about_pivot = ((n + 1.0) * crank / 3.0 + n * coupler) * length * length;
    let moment = about_pivot - mass * center * center;
    let mut plain = Draft::planar();
    // each crank's end has a pendulum of its own: the same motion in two places
    for head in heads {
        let foot = plus(head, -length, [0.0, 1.0, 0.0]);
        let body = plain.solid(plus(foot, center, [0.0, 1.0, 0.0]), mass, [moment; 3]);
        let pivot = plain.pin([GROUND, body], foot);
        plain.rate(pivot, rate);
        plain.watch(body, head);
    }
    plain
}

/// A four-bar at its change point: the shortest and the longest side together are as long as the two others. Once per revolution all sides
/// are in one line, where two branches of the motion meet.
pub(super) fn change_point(dice: &mut Dice) -> Case {
    loop {
        let mut draft = Draft::planar();
        let (a, b) = (dice.between(0.3, 0.6), dice.between(0.7, 1.2));
        let c = dice.between(0.7, 1.2);
        // the condition of the change point: a + ground = b + c
        let ground = b + c - a;
        let masses = std::array::from_fn(|_| dice.between(0.5, 2.0));
        let angle = dice.between(1.0, 2.5);
        let places = [[0.0; 3], [ground, 0.0, 0.0]];
        let closed = loop_on(&mut draft, GROUND, places, [a, b, c], (angle, 1.0), masses);
        if let Some(joints) = closed {
            draft.rate(joints[0], dice.between(-8.0, -3.0));
            return others(&draft, "change point", time(dice, &STEPS, 1.0));
        }
    }
}

/// Crank, rod and slider. In half of the cases the rod is as long as the crank, so that the slider passes the crank's pivot.
pub(super) fn slider_crank(dice: &mut Dice) -> Case {
    let crank_length = dice.between(0.2, 0.6);
    let rod_length = if dice.once_in(2) { crank_length } else { dice.between(0.7, 1.2) };
    let angle = dice.between(0.3, 1.2);
    let pin = [crank_length * angle.cos(), crank_length * angle.sin(), 0.0];
    let slide = [pin[0] + (rod_length * rod_length - pin[1] * pin[1]).sqrt(), 0.0, 0.0];
    let mut draft = Draft::planar();
    let crank = draft.rod([0.0; 3], pin, dice.between(0.3, 2.0));
    let rod = draft.rod(pin, slide, dice.between(0.3, 2.0));
    let slider = draft.solid(slide, dice.between(0.3, 2.0), [1e-3; 3]);
    let pivot = draft.pin([GROUND, crank], [0.0; 3]);
    draft.pin([crank, rod], pin);
    draft.pin([rod, slider], slide);
    draft.joint("prismatic", [GROUND, slider], slide, &[[1.0, 0.0, 0.0]]);
    draft.rate(pivot, dice.between(3.0, 12.0));
    draft.watch(crank, pin);
    draft.watch(slider, slide);
    others(&draft, "slider-crank", time(dice, &STEPS, 1.0))
}

/// A chain between two fixed points, slightly longer than their distance.
pub(super) fn straight_chain(dice: &mut Dice) -> Case {
    let n = 3 + dice.below(3);
    let slack = decades(dice, -2.5, -0.3);
    let mut draft = Draft::planar();
    let (mut at, mut before) = ([0.0; 3], GROUND);
    let half = f64::from(u32::try_from(n - 1).unwrap_or(1)) / 2.0;
    for k in 0..n {
        // the angles are antisymmetric, so that both ends have the same height
        let share = (f64::from(u32::try_from(k).unwrap_or(0)) - half) / half;
        let end = plus(at, 0.4, [(slack * share).cos(), (slack * share).sin(), 0.0]);
        let body = draft.rod(at, end, 1.0);
        draft.pin([before, body], at);
        if k + 1 < n {
            draft.watch(body, end);
        }
        (at, before) = (end, body);
    }
    draft.pin([before, GROUND], at);
    draft.rate(0, dice.between(-1.0, 1.0));
    others(&draft, "chain", time(dice, &STEPS, 0.5))
}

/// A rotor in two gimbals. After a quarter turn of the middle axis, the outer and the inner axis are in line.
pub(super) fn gimbals(dice: &mut Dice) -> Case {
    let mut draft = Draft::spatial();
    draft.gravity = [0.0; 3];
    let light = decades(dice, -4.0, -1.0);
    let outer = draft.solid([0.0; 3], light, [0.1 * light; 3]);
    let inner = draft.solid([0.0; 3], light, [0.1 * light; 3]);
    let rotor = draft.solid([0.0; 3], 1.0, [0.05, 0.07, 0.1]);
    let axes = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    let bodies = [[GROUND, outer], [outer, inner], [inner, rotor]];
    for (axis, bodies) in axes.into_iter().zip(bodies) {
        draft.joint("revolute", bodies, [0.0; 3], &[axis]);
    }
    let speed = dice.between(1.0, 3.0);
    // the smaller the rate about the first axis, the closer the motion comes to the lock
    draft.rate(0, speed * decades(dice, -2.0, 0.0));
    draft.rate(1, speed);
    draft.rate(2, dice.between(-1.0, 1.0));
    draft.watch(rotor, [0.0, 0.3, 0.4]);
    draft.watch(rotor, [0.5, 0.0, 0.0]);
    others(&draft, "gimbals", time(dice, &STEPS, 1.5))
}

/// Two shafts with a universal joint between them, at an angle of up to 89 degrees.
pub(super) fn cardan(dice: &mut Dice) -> Case {
    let angle: f64 =
        if dice.once_in(2) { dice.between(0.2, 1.2) } else { dice.between(1.2, 1.553) };
    let (first, second) = ([1.0, 0.0, 0.0], [angle.cos(), angle.sin(), 0.0]);
    let mut draft = Draft::spatial();
    draft.gravity = [0.0; 3];
    let moments = |dice: &mut Dice| {
        let j = dice.between(0.05, 0.2);
        [j, 1.2 * j, 1.4 * j]
    };
    let [j, k] = [moments(dice), moments(dice)];
    let shaft = draft.solid([-0.5, 0.0, 0.0], 1.0, j);
    let driven = draft.solid(second.map(|x| 0.5 * x), 1.0, k);
    let pivot = draft.joint("revolute", [GROUND, shaft], [-0.5, 0.0, 0.0], &[first]);
    // both arms of the cross are perpendicular to their shafts and to each other
    let across = [-second[1], second[0], 0.0];
    draft.joint("universal", [shaft, driven], [0.0; 3], &[[0.0, 0.0, 1.0], across]);
    draft.joint("cylindrical", [GROUND, driven], second, &[second]);
    draft.rate(pivot, dice.between(1.0, 5.0));
    draft.watch(shaft, [-0.5, 0.3, 0.0]);
    draft.watch(driven, plus(second, 0.3, [0.0, 0.0, 1.0]));
    others(&draft, "cardan shaft", time(dice, &STEPS, 1.0))
}

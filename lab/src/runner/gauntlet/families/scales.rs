//! Cases with very different scales: masses, units, frequencies, numbers of loops; and cases in rotated axes.

use super::bases::{any, chain, direction, four_bar, loop_on, spatial_chain};
use super::common::{case, decades, others, time, twin};
use crate::gauntlet::case::{Case, Image, Options, Truth};
use crate::gauntlet::draft::{Draft, GROUND, Joint};
use crate::gauntlet::text::text;
use crate::gauntlet::vector::{Turn, plus};
use mbs::scene_file::Dice;

/// Steps of the runs, from long to short, two per decade [s].
const STEPS: [f64; 4] = [1e-2, 3e-3, 1e-3, 3e-4];

/// Andrews' squeezing mechanism: seven bodies with some ten thousand revolutions per minute. Its driving torque is random.
pub(super) fn andrews(dice: &mut Dice) -> Case {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/andrews.toml");
    let scene = std::fs::read_to_string(scene).expect("the scene is in the repository");
    let drive = format!("value = {:?}", dice.between(0.01, 0.06));
    let scene = scene.replace("value = 0.033", &drive);
    let (step, duration) = time(dice, &[1e-4, 3e-5, 1e-5, 3e-6], 0.01);
    let scene = scene.replace("duration = 0.03", &format!("duration = {duration:?}"));
    Case { scene, step, size: 1.0, options: Options::default(), truth: Truth::Others }
}

/// A chain or a four-bar with ratios of masses up to a million.
pub(super) fn masses(dice: &mut Dice) -> Case {
    let n = 2 + dice.below(4);
    let mut draft = match dice.below(3) {
        0 => chain(dice, n),
        1 => spatial_chain(dice, n),
        _ => four_bar(dice),
    };
    let mut ratio = 1.0;
    for body in &mut draft.bodies {
        ratio = if ratio < 1.0 { 1.0 } else { decades(dice, -6.0, -1.0) };
        body.mass *= ratio;
        if let crate::gauntlet::draft::Shape::Solid(_, inertia) = &mut body.shape {
            inertia.iter_mut().for_each(|x| *x *= ratio);
        }
    }
    others(&draft, "light and heavy", time(dice, &STEPS, 0.5))
}

/// Two cranks and a link with no or nearly no mass. In the equivalent mechanism the link is a constant distance.
pub(super) fn massless(dice: &mut Dice) -> Case {
    let mut plain = Draft::planar();
    let ends = [[0.1, 0.5, 0.0], [0.9, 0.6, 0.0]];
    let feet = [[0.0; 3], [0.8, 0.0, 0.0]];
    for (foot, end) in feet.into_iter().zip(ends) {
        let body = plain.rod(foot, end, dice.between(0.5, 2.0));
        plain.pin([GROUND, body], foot);
        plain.watch(body, end);
    }
    plain.rate(0, dice.between(-2.0, 2.0));
    let mut draft = plain.clone();
    plain.joints.push(Joint {
        kind: "distance",
        bodies: [1, 2],
        at: ends.to_vec(),
        axes: Vec::new(),
    });
    let mass = if dice.once_in(2) { 0.0 } else { decades(dice, -15.0, -10.0) };
    let link = draft.rod(ends[0], ends[1], mass);
    draft.pin([1, link], ends[0]);
    draft.pin([link, 2], ends[1]);
    twin(&draft, &plain, "massless link", time(dice, &STEPS, 0.6))
}

/// A mechanism in millimetres and tonnes, or in other units. The equivalent mechanism is in metres and kilograms.
pub(super) fn units(dice: &mut Dice) -> Case {
    let plain = any(dice);
    let (length, mass) = match dice.below(3) {
        0 => (1e3, 1e-3),
        1 => (1e-3, 1e3),
        _ => (decades(dice, -5.0, 5.0), decades(dice, -6.0, 6.0)),
    };
    let draft = plain.in_units(length, mass);
    let (step, duration) = time(dice, &STEPS, 0.5);
    let image = Image { scale: length, ..Image::same(plain.dimension) };
    let truth = Truth::Twin(text(&plain, "metres", duration), image);
    case(&draft, "other units", (step, duration), truth)
}

/// A mechanism rotated together with gravity, about a random axis (in the plane: about its normal).
pub(super) fn rotated(dice: &mut Dice) -> Case {
    let mut plain = any(dice);
    if plain.dimension == 2 && dice.once_in(2) {
        plain = plain.raised();
    }
    let axis = if plain.dimension == 2 { [0.0, 0.0, 1.0] } else { direction(dice) };
    let turn = Turn::about(axis, dice.between(-3.0, 3.0));
    let (step, duration) = time(dice, &STEPS, 0.5);
    let image = Image { turn, ..Image::same(plain.dimension) };
    let truth = Truth::Twin(text(&plain, "unturned", duration), image);
    case(&plain.turned(&turn), "turned", (step, duration), truth)
}

/// A frame on a slide with twelve legs. Each leg is a four-bar, so that there are twelve loops and thirteen freedoms.
pub(super) fn walker(dice: &mut Dice) -> Case {
    let mut draft = Draft::planar();
    let frame = draft.rod([-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], 20.0);
    draft.joint("prismatic", [GROUND, frame], [0.0; 3], &[[1.0, 0.0, 0.0]]);
    let mut leg = 0;
    while leg < 12 {
        let x = -2.75 + 0.5 * f64::from(leg);
        let places =
            [[x, 0.0, 0.0], plus([x, 0.0, 0.0], dice.between(0.35, 0.45), [1.0, 0.0, 0.0])];
        let sides = [0.1, dice.between(0.38, 0.45), dice.between(0.28, 0.36)];
        let masses = std::array::from_fn(|_| dice.between(0.2, 1.0));
        let angle = dice.between(0.0, 6.2);
        let before = draft.clone();
        match loop_on(&mut draft, frame, places, sides, (angle, -1.0), masses) {
            Some(joints) => {
                draft.rate(joints[0], dice.between(-6.0, 6.0));
                leg += 1;
            }
            None => draft = before,
        }
    }
    draft.watch(frame, [0.0; 3]);
    others(&draft, "walker", time(dice, &[1e-2, 3e-3, 1e-3], 0.3))
}

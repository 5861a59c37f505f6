//! Cases with contacts, stops, latches, friction and stiff springs.

use super::bases::{chain, four_bar};
use super::common::{case, decades, others, time, twin};
use crate::gauntlet::case::{Case, Truth};
use crate::gauntlet::draft::{Draft, GROUND};
use crate::gauntlet::vector::plus;
use mbs::scene_file::Dice;
use mbs::{BodyId, Effect, JointId, Number, PolynomialPiece, Vector3};

/// Steps of the runs, from long to short, two per decade [s].
const STEPS: [f64; 4] = [3e-3, 1e-3, 3e-4, 1e-4];
/// Acceleration of gravity [m/s²].
const GRAVITY: f64 = 9.81;

/// A mass on a vertical slide that falls on a spring which only pushes. Its motion alternates between parabolas and pieces of sines.
pub(super) fn bouncing(dice: &mut Dice) -> Case {
    let (mass, height) = (dice.between(0.5, 2.0), dice.between(0.05, 0.5));
    let stiffness = decades(dice, 3.0, 7.0);
    let mut draft = Draft::planar();
    let body = slider(&mut draft, [0.0, 1.0 + height, 0.0], mass);
    // the spring's length in the reference configuration is 1 + height, and it begins to push at length 1
    let points = [[0.0; 3], [0.0, 1.0 + height, 0.0]];
    let ends = draft.ends([GROUND, body], points);
    draft.effects.push(Effect::bumper(ends, stiffness, 0.0, height));
    draft.watch(body, points[1]);
    let truth =
        Truth::Closed(Box::new(move |t| vec![0.0, 1.0 + bounce(height, stiffness / mass, t)]));
    case(&draft, "bouncing mass", time(dice, &STEPS, 1.0), truth)
}

/// Height of the mass over the spring's end at time t.
fn bounce(height: f64, square: f64, t: f64) -> f64 {
    let fall = (2.0 * height / GRAVITY).sqrt();
    let speed = GRAVITY * fall;
    let omega = square.sqrt();
    // contact: x = A cos(wt + p) - g/w^2, from x = 0 until x = 0 again
    let rest = GRAVITY / square;
    let amplitude = (rest * rest + speed * speed / square).sqrt();
    let phase = (speed / omega).atan2(rest);
    let contact = 2.0 * (std::f64::consts::PI - phase) / omega;
    let period = 2.0 * fall + contact;
    // time since the highest position
    let t = t % period;
    if t < fall {
        height - 0.5 * GRAVITY * t * t
    } else if t < fall + contact {
        amplitude * (omega * (t - fall) + phase).cos() - rest
    } else {
        let left = period - t;
        height - 0.5 * GRAVITY * left * left
    }
}

/// Adds a body on a vertical slide. Returns its number.
fn slider(draft: &mut Draft, at: [f64; 3], mass: f64) -> usize {
    let body = draft.solid(at, mass, [0.01 * mass; 3]);
    draft.joint("prismatic", [GROUND, body], at, &[[0.0, 1.0, 0.0]]);
    body
}

/// A spring with a stiffness, a damping and a free length.
fn spring(ends: [(BodyId, Vector3); 2], [stiffness, damping, free]: [f64; 3]) -> Effect {
    Effect::spring_damper(ends, stiffness, damping, free)
}

/// A polynomial piece of a tension as a function of length.
fn piece(lower: f64, upper: f64, coefficients: &[f64]) -> PolynomialPiece<Number> {
    let coefficients = coefficients.iter().map(|x| Number::from(*x)).collect();
    PolynomialPiece { lower: lower.into(), upper: upper.into(), coefficients }
}

/// A quarter of a car that jumps: its wheel leaves the ground and returns.
pub(super) fn wheel(dice: &mut Dice) -> Case {
    let mut draft = Draft::planar();
    let wheel = slider(&mut draft, [0.0, 0.3, 0.0], dice.between(20.0, 40.0));
    let car = slider(&mut draft, [0.0, 0.8, 0.0], dice.between(200.0, 400.0));
    let points = [[0.0, 0.3, 0.0], [0.0, 0.8, 0.0]];
    let suspension = [decades(dice, 4.0, 4.7), decades(dice, 2.0, 3.3), 0.6];
    draft.effects.push(spring(draft.ends([wheel, car], points), suspension));
    let tire = [decades(dice, 5.0, 5.7), dice.between(0.0, 300.0), 0.0];
    let ends = draft.ends([GROUND, wheel], [[0.0; 3], points[0]]);
    draft.effects.push(Effect::bumper(ends, tire[0], tire[1], tire[2]));
    draft.rate(0, dice.between(1.0, 3.0));
    draft.rate(1, dice.between(0.5, 2.0));
    draft.watch(wheel, points[0]);
    draft.watch(car, points[1]);
    others(&draft, "wheel", time(dice, &STEPS, 1.0))
}

/// A mass that falls into a catch. The catch holds the mass while the load is small, and releases it under a large load.
pub(super) fn latch(dice: &mut Dice) -> Case {
    let mut draft = Draft::planar();
    let mass = dice.between(0.5, 2.0);
    let body = slider(&mut draft, [0.0, 2.0, 0.0], mass);
    let driver = decades(dice, 1.5, 2.5);
    let ends = draft.ends([GROUND, body], [[0.0, 4.0, 0.0], [0.0, 2.0, 0.0]]);
    draft.effects.push(spring(ends, [driver, dice.between(0.0, 2.0), 2.5]));
    // tension by length: zero, then a pull to the middle of the catch, then zero; continuous
    let (at, half, stiffness) = (1.5, 0.05, decades(dice, 2.0, 4.5));
    let line = |slope: f64, zero: f64| [-slope * zero, slope];
    let pieces = vec![
        piece(0.0, at - 2.0 * half, &[0.0]),
        piece(at - 2.0 * half, at - half, &line(-stiffness, at - 2.0 * half)),
        piece(at - half, at + half, &line(stiffness, at)),
        piece(at + half, at + 2.0 * half, &line(-stiffness, at + 2.0 * half)),
        piece(at + 2.0 * half, 9.0, &[0.0]),
    ];
    let ends = draft.ends([GROUND, body], [[0.0; 3], [0.0, 2.0, 0.0]]);
    draft.effects.push(Effect::polynomial_spring(ends, pieces));
    draft.rate(0, dice.between(-2.0, 1.0));
    draft.watch(body, [0.0, 2.0, 0.0]);
    others(&draft, "latch", time(dice, &STEPS, 1.5))
}

/// Two pendulums connected by a stiff link that breaks at a given load.
pub(super) fn breaking(dice: &mut Dice) -> Case {
    let mut draft = chain(dice, 1);
    let end = draft.outputs[0].1;
    let second = draft.rod(
        plus(end, 1.0, [0.5, 0.0, 0.0]),
        plus(end, 1.0, [0.5, -0.8, 0.0]),
        dice.between(0.3, 2.0),
    );
    let from = plus(end, 1.0, [0.5, 0.0, 0.0]);
    draft.joint("free", [GROUND, second], from, &[]);
    let (stiffness, load) = (decades(dice, 3.0, 5.0), dice.between(5.0, 60.0));
    let [elongation, length] = [load / stiffness, 0.5];
    let (breaks, gone) = (length + elongation, length + 1.5 * elongation);
    let slope = load / (0.5 * elongation);
    let pieces = vec![
        piece(0.01, breaks, &[-stiffness * length, stiffness]),
        piece(breaks, gone, &[slope * gone, -slope]),
        piece(gone, 90.0, &[0.0]),
    ];
    let ends = draft.ends([1, second], [end, from]);
    draft.effects.push(Effect::polynomial_spring(ends, pieces));
    draft.watch(second, plus(from, 1.0, [0.0, -0.8, 0.0]));
    others(&draft, "link", time(dice, &STEPS, 0.5))
}

/// A chain whose joints have stiff stops.
pub(super) fn limits(dice: &mut Dice) -> Case {
    let n = 1 + dice.below(3);
    let mut draft = chain(dice, n);
    for joint in 0..n {
        let stiffness = decades(dice, 2.0, 6.0);
        let ends = [-dice.between(0.05, 0.6), dice.between(0.05, 0.6)];
        let damping = if dice.once_in(2) { 0.0 } else { dice.between(0.1, 3.0) };
        draft.effects.push(Effect::limit(JointId::new(joint), ends, stiffness, damping));
    }
    others(&draft, "ends", time(dice, &STEPS, 0.8))
}

/// A chain with dry friction in its joints, which stick and slip.
pub(super) fn friction(dice: &mut Dice) -> Case {
    let n = 1 + dice.below(2);
    let mut draft = chain(dice, n);
    for joint in 0..n {
        let torque = decades(dice, -1.5, 1.0);
        draft.effects.push(Effect::friction(JointId::new(joint), torque, 1e-3));
    }
    others(&draft, "friction", time(dice, &STEPS, 0.8))
}

/// Two pendulums beside each other that collide.
pub(super) fn contact(dice: &mut Dice) -> Case {
    let mut draft = Draft::planar();
    let apart = dice.between(0.2, 0.4);
    let ends = [[0.0, -1.0, 0.0], [apart, -1.0, 0.0]];
    for end in ends {
        let foot = [end[0], 0.0, 0.0];
        let body = draft.rod(foot, end, dice.between(0.5, 2.0));
        draft.pin([GROUND, body], foot);
        draft.watch(body, end);
    }
    draft.rate(0, dice.between(0.5, 2.5));
    draft.rate(1, dice.between(-1.0, 0.5));
    let stiffness = decades(dice, 3.0, 7.0);
    let clearance = 0.5 * apart;
    let ends = draft.ends([1, 2], ends);
    draft.effects.push(Effect::bumper(ends, stiffness, 0.0, clearance));
    others(&draft, "pendulums that meet", time(dice, &STEPS, 0.6))
}

/// A chain or a four-bar with a rod cut in two. A stiff torsion spring connects the parts. For a large stiffness the motion is that of the
/// whole rod.
pub(super) fn stiff_hinge(dice: &mut Dice) -> Case {
    let mut draft = if dice.once_in(2) { chain(dice, 2) } else { four_bar(dice) };
    let last = draft.bodies.len();
    let (body, end) = draft.outputs[draft.outputs.len() - 1];
    let tip = plus(end, 0.5, [0.6, -0.8, 0.0]);
    let beam = draft.rod(end, tip, 0.5);
    let body = if body == 0 { last } else { body };
    let mut plain = draft.clone();
    let hinge = draft.pin([body, beam], end);
    let stiffness = decades(dice, 3.0, 10.0);
    draft.effects.push(Effect::torsion_spring(JointId::new(hinge), stiffness, 0.0, 0.0));
    // without this condition the beam would start with a motion against its other part
    draft.rate(hinge, 0.0);
    draft.watch(beam, tip);
    let span = time(dice, &STEPS, 0.4);
    // the hinge with the stiffness k bends by roughly 10 N m / k; a soft one does not move as the whole rod
    if stiffness < 3e8 {
        return others(&draft, "stiff hinge", span);
    }
    plain.joint("weld", [body, beam], end, &[]);
    plain.watch(beam, tip);
    twin(&draft, &plain, "stiff hinge", span)
}

/// Masses on a line, connected by stiff and soft springs.
pub(super) fn stiff_chain(dice: &mut Dice) -> Case {
    let n = 2 + dice.below(4);
    let mut draft = Draft::planar();
    let (mut before, mut at) = (GROUND, [0.0; 3]);
    for k in 0..n {
        let place = plus(at, 1.0, [0.0, -0.5, 0.0]);
        let body = slider(&mut draft, place, dice.between(0.5, 2.0));
        let stiffness = if k == 0 { decades(dice, 1.0, 3.0) } else { decades(dice, 3.0, 10.0) };
        draft.effects.push(spring(draft.ends([before, body], [at, place]), [stiffness, 0.0, 0.5]));
        draft.watch(body, place);
        (before, at) = (body, place);
    }
    others(&draft, "masses and springs", time(dice, &STEPS, 0.5))
}

#[cfg(test)]
mod tests {
    use super::bounce;

    #[test]
    fn the_closed_form_of_a_bounce_obeys_its_law_and_comes_back() {
        let (height, square) = (0.2, 4000.0);
        assert!((bounce(height, square, 0.0) - height).abs() < 1e-12);
        let d = 1e-5;
        for k in 1..4000 {
            let t = f64::from(k) * 3.1e-4;
            let x = |t: f64| bounce(height, square, t);
            let acceleration = (x(t + d) - 2.0 * x(t) + x(t - d)) / (d * d);
            let law = -9.81 + square * (-x(t)).max(0.0);
            assert!((acceleration - law).abs() < 0.05, "at {t}: {acceleration}, not {law}");
        }
    }
}

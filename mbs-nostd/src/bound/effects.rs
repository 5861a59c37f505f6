//! Operations of effects and inputs: of the branch that costs most.

use super::Operations;
#[cfg(feature = "tire")]
use super::count;
use crate::inputs::{Motion, Prescriptions, SignalLaw};
use mbs_core::Real;
use mbs_core::laws::body::BodyLaw;
#[cfg(feature = "tire")]
use mbs_core::laws::road::Feature;
#[cfg(feature = "tire")]
use mbs_core::laws::road_contact::{self, CELLS};
use mbs_core::laws::scalar::Law;
use mbs_recursive::loads::{Gauge, Load};
use mbs_recursive::mechanism::Mechanism;
use mbs_recursive::space::Space;

const fn ops(products: u64, sums: u64) -> Operations {
    Operations::new(products, sums)
}

/// Guides and courses at an instant.
pub(super) fn inputs<T>(laws: &Prescriptions<'_, T>) -> Operations {
    let mut sum = Operations::NONE;
    for guide in laws.guides {
        sum += match guide {
            Motion::Input(_) => Operations::NONE,
            Motion::Sine { .. } => ops(9, 1).and(0, 0, 1),
            Motion::Ramp { .. } => ops(1, 0),
            Motion::Table(_) => ops(22, 14).and(4, 0, 0),
        };
    }
    for course in laws.courses {
        sum += match course {
            SignalLaw::Input(_) | SignalLaw::Constant(_) => Operations::NONE,
            SignalLaw::Travel(_) => ops(1, 0),
            SignalLaw::Table(_) => ops(3, 8).and(1, 0, 0),
        };
    }
    sum
}

/// The parts of which loads are made, in space or in the plane.
struct Parts {
    /// A vector turned.
    turned: Operations,
    /// A wrench at an arm.
    wrench: Operations,
    /// The inner product of two motions, or two points.
    motions: Operations,
    points: Operations,
    /// Numbers of a point, and of a motion.
    point: u64,
    motion: u64,
    /// A force ahead on a link: tension, resistance, inertia.
    resist: Operations,
}

impl Parts {
    const fn of<T: Real, S: Space<T>>() -> Self {
        if S::DIMENSION == 3 {
            Self {
                turned: ops(9, 6),
                wrench: ops(6, 3),
                motions: ops(6, 5),
                points: ops(3, 2),
                point: 3,
                motion: 6,
                resist: ops(42, 34),
            }
        } else {
            Self {
                turned: ops(4, 2),
                wrench: ops(2, 1),
                motions: ops(3, 2),
                points: ops(2, 1),
                point: 2,
                motion: 3,
                resist: ops(18, 13),
            }
        }
    }
}

/// An effect in an evaluation, ahead.
pub(super) fn load<T: Real, S: Space<T>>(m: &Mechanism<'_, T, S>, load: &Load<T, S>) -> Operations {
    let parts = Parts::of::<T, S>();
    // κ, and what it adds to a joint.
    let across = ops(3, 3);
    match load {
        Load::Between { links, gauge, law } => {
            let measured = measured(m.links.len(), gauge, &parts) + scalar(law);
            let hangs = |link: u32, other: u32| {
                m.links.get(link as usize).is_some_and(|own| {
                    link > 0 && own.parent == other && own.kind.n_freedoms::<T, S>() <= 1
                })
            };
            if hangs(links[0], links[1]) || hangs(links[1], links[0]) {
                let push = ops(parts.motion, parts.motion) * 2;
                measured + push + parts.motions + across + ops(2, 0)
            } else {
                let n = links.iter().filter(|&&link| link > 0).count();
                measured + parts.resist * super::count(n)
            }
        }
        Load::Angle { law, .. } => scalar(law) + across + ops(0, 1),
        Load::Constant { .. } => parts.turned + parts.wrench + ops(0, parts.motion),
        Load::Force { turns, .. } => {
            let turned = if *turns { parts.turned } else { Operations::NONE };
            turned + parts.turned + parts.wrench + ops(0, parts.motion)
        }
        Load::Torque { .. } => ops(0, parts.motion),
        Load::OnBody(load) => {
            // Point and arm, its place and velocity, the law's direction; each action on its own.
            let place = parts.turned * 4 + parts.wrench * 2 + ops(0, 4 * parts.point);
            let (law, actions) = on_body(m, &load.law);
            let action = parts.wrench + ops(0, parts.motion) + parts.resist;
            place + law + action * actions
        }
    }
}

/// What a law measures, its wrenches and its rate.
fn measured<T: Real, S: Space<T>>(
    n_links: usize,
    gauge: &Gauge<T, S>,
    parts: &Parts,
) -> Operations {
    let between = parts.turned * 2 + ops(0, 3 * parts.point);
    let rate = parts.motions * 2 + ops(0, 1);
    match gauge {
        Gauge::Length { .. } => {
            let unit = ops(parts.point, 0).and(1, 1, 0);
            between + parts.points + unit + parts.wrench * 2 + rate
        }
        Gauge::Along { .. } => {
            between
                + parts.turned
                + parts.wrench * 2
                + ops(0, parts.point)
                + parts.points
                + ops(0, 1)
                + rate
        }
        // The half angles of both links, by all that are on the way at most; the rotation vector, its gradient, and the moment.
        Gauge::Rotation { .. } => {
            let joint = ops(20, 12).and(0, 0, 1);
            let vector = ops(24, 14).and(1, 1, 1);
            let gradient = ops(28, 16).and(1, 1, 1);
            joint * (2 * n_links as u64) + vector + gradient + parts.turned + rate
        }
        // The angles of both links, by all that are on the way at most.
        Gauge::Turn => ops(2 * n_links as u64, 2 * n_links as u64 + 1) + parts.wrench + rate,
    }
}

#[allow(unreachable_patterns, reason = "some effects may be left out")]
fn scalar<T>(law: &Law<T>) -> Operations {
    match law {
        Law::SpringDamper { .. } => ops(2, 2),
        Law::Torque { .. } => Operations::NONE,
        #[cfg(feature = "polynomial")]
        Law::Polynomial { .. } => ops(17, 19),
        #[cfg(feature = "bumper")]
        Law::Bumper { .. } => CONTACT + ops(0, 1),
        #[cfg(feature = "limit")]
        Law::Limit(_) => CONTACT + ops(0, 2),
        #[cfg(feature = "friction")]
        Law::Friction(_) => ops(15, 7).and(5, 1, 0),
        // A law of a user's own is not in a table.
        _ => Operations::NONE,
    }
}

/// A contact with a damper that fades in.
#[cfg(any(feature = "bumper", feature = "limit", feature = "tire"))]
const CONTACT: Operations = ops(14, 6);

/// A law on a body, and how many actions it has.
#[allow(unreachable_patterns, unused_variables, reason = "some effects may be left out")]
fn on_body<T: Real, S: Space<T>>(m: &Mechanism<'_, T, S>, law: &BodyLaw<T>) -> (Operations, u64) {
    match law {
        #[cfg(feature = "drag")]
        BodyLaw::Drag { .. } => (ops(12, 2).and(1, 1, 0), 1),
        #[cfg(feature = "speed-hold")]
        BodyLaw::SpeedHold(_) => (ops(9, 5).and(3, 1, 0), 1),
        #[cfg(feature = "tire")]
        BodyLaw::Tire(tire) => {
            let stance = ops(43, 25).and(2, 1, 0);
            let radial = CONTACT + ops(4, 2);
            let rolling = ops(71, 37).and(6, 3, 2);
            let side = ops(33, 11).and(5, 0, 0);
            let actions = count(tire.n_actions());
            (stance + radial + rolling + side + road(tire.road.of(m.tables.features)), actions)
        }
        _ => (Operations::NONE, 0),
    }
}

/// The nearest point of a road: one height where it is level, elsewhere as many as the search may ask for.
#[cfg(feature = "tire")]
fn road<T: Real>(features: &[Feature<T>]) -> Operations {
    let (mut height, mut hollow) = (Operations::NONE, Operations::NONE);
    for feature in features {
        let (value, bend) = match feature {
            Feature::Flat(_) => (Operations::NONE, Operations::NONE),
            // In the rounded corner at the end.
            Feature::Rise { .. } => (ops(4, 5).and(4, 0, 0), ops(1, 3).and(1, 0, 0)),
            Feature::Bump { .. } => (ops(8, 2).and(1, 0, 1), ops(3, 2).and(1, 0, 0)),
            // The slopes at both ends of a table tell whether it rises from them.
            Feature::Spline(_) => (ops(21, 14).and(4, 0, 0), ops(42, 30).and(9, 0, 0)),
        };
        height += value + ops(0, 3);
        hollow += bend;
    }
    if features.iter().all(|feature| matches!(feature, Feature::Flat(_))) {
        return height + ops(0, 3);
    }
    // D and D' at a place, the step to the next, and whether it is taken.
    let spot = height + ops(9, 12).and(1, 0, 0);
    let (settled, cell) = (ops(5, 8).and(1, 0, 0), ops(0, 2));
    let cells = u64::from(CELLS);
    spot * count(road_contact::most_heights::<T>())
        + settled * (1 + cells)
        + cell * cells
        + hollow
        + ops(12, 13).and(5, 4, 0)
}

//! Operation counts of effects and inputs. Each count is that of the most expensive branch.

use super::Operations;
use super::count;
use super::couplings;
use super::curves::SPLINE;
use crate::inputs::{Motion, Prescriptions, SignalLaw};
use mbs_core::Real;
use mbs_recursive::loads::{Load, Measure};
use mbs_recursive::passes::slices::TreeSlices;
use mbs_recursive::space::Space;

const fn ops(products: u64, sums: u64) -> Operations {
    Operations::new(products, sums)
}

/// Operations for a smooth step with its derivatives.
const STEP: Operations = ops(16, 7).and(3, 0, 0);

/// Operations for all guides and signals at an instant.
pub(super) fn inputs<T>(laws: &Prescriptions<'_, T>) -> Operations {
    let mut sum = Operations::NONE;
    for guide in laws.guides {
        sum += match guide {
            Motion::Input(_) => Operations::NONE,
            Motion::Sine { .. } => ops(9, 1).and(0, 0, 1),
            Motion::Ramp { .. } => ops(1, 0),
            Motion::Table(_) => SPLINE,
            Motion::Step(_) => STEP,
        };
    }
    for course in laws.courses {
        sum += match course {
            SignalLaw::Input(_) | SignalLaw::Constant(_) => Operations::NONE,
            SignalLaw::Travel(_) => ops(1, 0),
            SignalLaw::Table(_) => ops(3, 8).and(1, 0, 0),
            SignalLaw::Spline(_) => SPLINE,
            SignalLaw::Step(_) => STEP,
        };
    }
    sum
}

/// Operation counts of the steps from which loads are computed, in space or in the plane.
struct Parts {
    /// Operations to rotate a vector.
    turned: Operations,
    /// Operations for the wrench of a force that acts at a vector from the origin.
    wrench: Operations,
    /// Operations for the inner product of two motions.
    motions: Operations,
    points: Operations,
    /// Number of components of a point.
    point: u64,
    motion: u64,
    /// Operations to add a force that depends on accelerations to a link: tension, resistance, inertia.
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

/// Operations for an effect in an evaluation, with its dependence on accelerations.
pub(super) fn load<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    load: &Load<T, S>,
) -> Operations {
    let parts = Parts::of::<T, S>();
    // weight κ and the inertia that it adds to a joint
    let across = ops(3, 3);
    match load {
        Load::Between { links, gauge, law } => {
            let measured = measured(m.links.len(), gauge, &parts) + law.operations();
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
                measured + parts.resist * count(n)
            }
        }
        Load::Sum(sum) => couplings::sum(&m.loops.couplings, sum, parts.resist),
        Load::Angle { law, .. } => law.operations() + across + ops(0, 1),
        Load::Constant { .. } => parts.turned + parts.wrench + ops(0, parts.motion),
        Load::Force { turns, .. } => {
            let turned = if *turns { parts.turned } else { Operations::NONE };
            turned + parts.turned + parts.wrench + ops(0, parts.motion)
        }
        Load::Torque { .. } => ops(0, parts.motion),
        Load::BodyLoad(load) => {
            // First the point, its arm, its place and velocity, and the direction of the law; then each action of the law.
            let place = parts.turned * 4 + parts.wrench * 2 + ops(0, 4 * parts.point);
            let law = load.law.operations(&m.tables);
            let action = parts.wrench + ops(0, parts.motion) + parts.resist;
            place + law + action * count(load.law.n_actions())
        }
    }
}

/// Operations for the number on which a law depends, with its rate and its unit wrenches.
fn measured<T: Real, S: Space<T>>(
    n_links: usize,
    gauge: &Measure<T, S>,
    parts: &Parts,
) -> Operations {
    let between = parts.turned * 2 + ops(0, 3 * parts.point);
    let rate = parts.motions * 2 + ops(0, 1);
    match gauge {
        Measure::Length { .. } => {
            let unit = ops(parts.point, 0).and(1, 1, 0);
            between + parts.points + unit + parts.wrench * 2 + rate
        }
        Measure::Along { .. } => {
            between
                + parts.turned
                + parts.wrench * 2
                + ops(0, parts.point)
                + parts.points
                + ops(0, 1)
                + rate
        }
        // Half angles of both links, with at most all links on the path to the ground; then the rotation vector, its gradient, and the
        // moment.
        Measure::Rotation { .. } => {
            let joint = ops(20, 12).and(0, 0, 1);
            let vector = ops(24, 14).and(1, 1, 1);
            let gradient = ops(28, 16).and(1, 1, 1);
            joint * (2 * n_links as u64) + vector + gradient + parts.turned + rate
        }
        // Angles of both links, with at most all links on the path to the ground.
        Measure::Turn => ops(2 * n_links as u64, 2 * n_links as u64 + 1) + parts.wrench + rate,
    }
}

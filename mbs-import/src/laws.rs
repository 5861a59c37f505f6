//! Laws that several formats have: stops at the limits of joints, dry friction, and dampers of ball joints.

use crate::context::Context;
use crate::options::Stops;
use crate::pose::{V3, v3};
use crate::robot::{Coordinate, Law, Robot, Target, What};
use crate::source::Origin;

/// Adds the stops of a joint's limits, and reports them. `at` and `path` are the place of the limits in the file. `own` has stiffness and
/// damping if the file gives them.
pub(crate) fn stops(
    (at, path): (Origin, &str),
    (name, of): (&str, Coordinate),
    own: Option<[f64; 2]>,
    robot: &mut Robot,
    context: &mut Context<'_>,
) {
    let given = match (own, context.options.limits) {
        (Some(own), _) => Some(Some(own)),
        (None, None) => None,
        (None, Some(Stops::ByMass)) => Some(None),
        (None, Some(Stops::Given { stiffness, damping })) => Some(Some([stiffness, damping])),
    };
    let says = match given {
        _ if own.is_some() => "stops with the stiffness and dissipation that are written",
        None => "ends without stiffness: kept as the joint's range, which does not act (--limits)",
        Some(_) => "ends without stiffness in the file: stops as --limits says",
    };
    context.findings.approximated(at, format!("{path}/limit"), says);
    if let Some(stiffness) = given {
        let what = What::RangeLimit { on: Target::Coordinate(of), stiffness };
        robot.laws.push(Law { name: format!("{name} stops"), what });
    }
}

/// Returns the reason why a joint with limits in the file gets no limits.
pub(crate) fn no_range(lower: f64, upper: f64) -> String {
    format!(
        "`lower` {lower} is not below `upper` {upper}: no range is taken; write type=\"fixed\" where the joint does not move"
    )
}

/// Adds the dry friction of the element `dynamics`, unless it is zero.
pub(crate) fn friction(
    (at, path): (Origin, &str),
    (name, of): (&str, Coordinate),
    coulomb: f64,
    robot: &mut Robot,
    context: &mut Context<'_>,
) {
    if coulomb > 0.0 {
        let says = "dry friction falls to zero below a rate of 1e-3";
        context.findings.approximated(at, format!("{path}/dynamics"), says);
        let what = What::Friction { on: Target::Coordinate(of), coulomb };
        robot.laws.push(Law { name: format!("{name} friction"), what });
    }
}

/// Corners of a tetrahedron: Σ r = 0 and Σ (r² E − r rᵀ) = 8 E. Forces −c v at them therefore give the moment −8 c ω.
const CORNERS: [[f64; 3]; 4] =
    [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];

/// Dampers that act as a moment −d ω between two links at a place, made of four dampers. For a free joint they also act as a force −d v.
pub(crate) fn dampers(
    (links, place): ([usize; 2], V3),
    damping: f64,
    is_free: bool,
) -> impl Iterator<Item = What> {
    // The moment of a ball joint is −8 c a² ω, with the arm a; a free joint also has the force −4 c v.
    let (arm, c) = if is_free {
        (core::f64::consts::FRAC_1_SQRT_2, damping / 4.0)
    } else {
        (1.0, damping / 8.0)
    };
    CORNERS.into_iter().map(move |corner| What::Bushing {
        links,
        place: place + v3(corner) * arm,
        stiffness: [0.0; 6],
        damping: [c, c, c, 0.0, 0.0, 0.0],
    })
}

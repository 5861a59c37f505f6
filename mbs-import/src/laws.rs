//! Laws that formats have in common: stops at the ends of a range, dry friction, and dampers of balls.

use crate::context::Context;
use crate::options::Stops;
use crate::pose::{V3, v3};
use crate::robot::{Coordinate, Law, Robot, Target, What};
use crate::source::Origin;

/// Reports what becomes of the ends of a joint's range, and adds their law. The file writes the range at a place; `own` is
/// stiffness and damping that it writes.
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

/// Returns the reason why a joint whose ends are written gets no range.
pub(crate) fn no_range(lower: f64, upper: f64) -> String {
    format!(
        "`lower` {lower} is not below `upper` {upper}: no range is taken; write type=\"fixed\" where the joint does not move"
    )
}

/// Dry friction that is written in `dynamics`; nothing where it is zero.
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

/// Corners of a tetrahedron: Σ r = 0 and Σ (r² E − r rᵀ) = 8 E. So forces −c v at them are a moment −8 c ω.
const CORNERS: [[f64; 3]; 4] =
    [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];

/// The moment −d ω between two links at a place, for a free joint with the force −d v beside it: four dampers.
pub(crate) fn dampers(
    (links, place): ([usize; 2], V3),
    damping: f64,
    is_free: bool,
) -> impl Iterator<Item = What> {
    // of a ball the moment is −8 c a² ω, of a free joint the force is −4 c v beside it
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

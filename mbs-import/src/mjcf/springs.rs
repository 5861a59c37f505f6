//! Springs and dampers that act on coordinates, sums or lines.

use super::model::Model;
use super::strength::Strength;
use crate::robot::{Target, Term, What};

/// Adds a spring that has no force between two values, and a damper.
pub(super) fn add(
    name: &str,
    on: &Target,
    [stiffness, damping]: [Strength; 2],
    [lower, upper]: [f64; 2],
    model: &mut Model<'_, '_, '_>,
) {
    let [k, c] = [stiffness.0[0], damping.0[0]].map(|x| x.max(0.0));
    let is_slack = lower < upper && stiffness != Strength::NONE;
    // A linear spring or damper has its own kind of law.
    let [mut above, mut beside] = [stiffness, damping];
    let is_plain = stiffness.linear().is_some_and(|k| k >= 0.0);
    let k = if is_slack { 0.0 } else { k };
    if !is_slack {
        above.0[0] -= k;
    }
    beside.0[0] -= c;
    if k > 0.0 || c > 0.0 {
        let free = if k > 0.0 { lower } else { 0.0 };
        let what = What::Spring { on: on.clone(), stiffness: k, damping: c, free };
        let word = if is_slack { "damper" } else { "spring" };
        model.law(&format!("{name} {word}"), what);
    }
    if is_slack && is_plain {
        slack_between((name, on), [lower, upper], stiffness.0[0], model);
    } else if above != Strength::NONE {
        let pieces = above.spring([lower, upper]);
        let what = What::Polynomial { terms: terms(on, 1.0), pieces, of_rate: false };
        model.law(&format!("{name} polynomial spring"), what);
    }
    if beside != Strength::NONE {
        let pieces = beside.damper();
        let what = What::Polynomial { terms: terms(on, 1.0), pieces, of_rate: true };
        model.law(&format!("{name} polynomial damper"), what);
    }
}

/// Adds a spring that has no force between two lengths. One spring pulls above the upper length. Another acts on the negative sum, below the
/// lower length.
fn slack_between(
    (name, on): (&str, &Target),
    [lower, upper]: [f64; 2],
    stiffness: f64,
    model: &mut Model<'_, '_, '_>,
) {
    let [above, below] = [1.0, -1.0].map(|sign| Target::Sum(terms(on, sign)));
    model.law(&format!("{name} above"), What::Pull { on: above, stiffness, free: upper });
    model.law(&format!("{name} below"), What::Pull { on: below, stiffness, free: -lower });
}

/// A target as the terms of a sum, multiplied by a factor.
fn terms(on: &Target, factor: f64) -> Vec<Term> {
    match on {
        Target::Sum(terms) => {
            let terms = terms.iter().cloned();
            terms.map(|term| Term { factor: factor * term.factor, ..term }).collect()
        }
        Target::Coordinate(of) => vec![Term::new(of.clone(), factor)],
    }
}

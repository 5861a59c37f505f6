//! Tendons: springs and dampers on sums of coordinates.

use super::model::{Model, Tendon};
use crate::element::Element;
use crate::robot::{Target, Term, What};
use crate::source::Read;

/// Reads the elements `tendon`.
pub(super) fn read<'a>(root: &'a Element, model: &mut Model<'a, '_, '_>) -> Read<()> {
    for element in root.each("tendon").flat_map(|tendons| &tendons.children) {
        match element.name.as_str() {
            "fixed" => {
                for ending in model.endings(element) {
                    fixed(element.read(), &ending, model)?;
                }
            }
            "spatial" => spatial(element, model)?,
            _ => {}
        }
    }
    Ok(())
}

/// Keeps a tendon by its name.
fn keep(
    element: &Element,
    ending: &str,
    tendon: Tendon,
    model: &mut Model<'_, '_, '_>,
) -> Read<String> {
    let number = model.tendons.len() + 1;
    let name = element
        .value("name")
        .map_or_else(|| format!("tendon {number}"), |name| model.copied(name, ending));
    model.tendon_names.add(&name, element.at, &model.context.sources)?;
    model.tendons.push(tendon);
    Ok(name)
}

fn fixed<'a>(element: &'a Element, ending: &str, model: &mut Model<'a, '_, '_>) -> Read<()> {
    let view = model.classes.view_as(element, "tendon", super::defaults::MAIN)?;
    let mut terms: Vec<Term> = Vec::new();
    // lengths in the reference configuration, and without tension in the springs of the joints
    let (mut drawn, mut slack) = (0.0, 0.0);
    for child in element.each("joint") {
        let motion = model.single(child.need("joint")?, ending)?;
        let factor = child.need("coef")?.number()?;
        let (term, length) = motion.term(factor);
        drawn += length;
        slack += factor * motion.spring;
        if factor != 0.0 {
            terms.push(term);
        }
    }
    let name = keep(element, ending, Tendon::Sum(terms.clone(), drawn), model)?;
    let number = |name| view.number_or(name, 0.0);
    let acts = model.compiler.acts;
    let of = |acts: bool, x: f64| if acts { x } else { 0.0 };
    let [stiffness, damping] =
        [of(acts.spring, number("stiffness")?), of(acts.damper, number("damping")?)];
    let [friction, armature] = [of(acts.friction, number("frictionloss")?), number("armature")?];
    let lengths = view.attribute("springlength").map(|length| length.list()).transpose()?;
    let limits = view.attribute("range");
    view.attribute("limited");
    let is_limited = limits.is_some()
        && acts.limit
        && view.is_limited("limited", "range", model.compiler.auto_limits)?;
    let label = format!("tendon/fixed[{name}]");
    if terms.is_empty() {
        return Ok(());
    }
    let on = Target::Sum(terms.clone());
    if stiffness > 0.0 || damping > 0.0 {
        let free = match lengths.as_deref() {
            None => slack,
            Some([x]) if *x >= 0.0 => *x,
            Some([x, y, ..]) if x == y && *x >= 0.0 => *x,
            Some([x, ..]) if *x < 0.0 => slack,
            Some(lengths) => {
                let says = format!(
                    "the dead range {lengths:?} of its spring does not act: free at its middle"
                );
                model.context.findings.ignored(element.at, label.as_str(), says);
                lengths.iter().sum::<f64>() / lengths.len().max(1) as f64
            }
        };
        let what = What::Spring { on: on.clone(), stiffness, damping, free: free - drawn };
        model.law(&format!("{name} spring"), what);
    }
    if friction > 0.0 {
        let says = "frictionloss is a soft constraint there; here it is friction that falls to zero below a rate of 1e-3";
        model.context.findings.approximated(element.at, label.as_str(), says);
        model.law(&format!("{name} friction"), What::Friction { on, coulomb: friction });
    }
    if armature > 0.0 {
        if let [only] = &terms[..] {
            let on = Target::Coordinate(only.of.clone());
            let inertia = armature * only.factor * only.factor;
            model.law(&format!("{name} armature"), What::Rotor { on, inertia });
        } else {
            let says = "armature of a tendon over several joints does not act here";
            model.context.findings.ignored(element.at, label.as_str(), says);
        }
    }
    if is_limited {
        model.context.findings.ignored(element.at, label, "the ends of a tendon do not act here");
    }
    Ok(())
}

/// A tendon in space: what acts is told, what only marks a line is not.
fn spatial<'a>(element: &'a Element, model: &mut Model<'a, '_, '_>) -> Read<()> {
    let view = model.classes.view_as(element, "tendon", super::defaults::MAIN)?;
    let acting = ["stiffness", "damping", "frictionloss", "armature"].into_iter();
    let mut acts = model.compiler.acts.limit
        && view.is_limited("limited", "range", model.compiler.auto_limits)?;
    for name in acting {
        let values = view.attribute(name).map(|word| word.list()).transpose()?.unwrap_or_default();
        acts |= values.iter().any(|x| *x != 0.0);
    }
    element.read_whole();
    let name = keep(element, "", Tendon::Other, model)?;
    let label = format!("tendon/spatial[{name}]");
    let says = if acts {
        "a tendon in space does not act here"
    } else {
        "a tendon in space, which has no law of its own"
    };
    model.context.findings.ignored(element.at, label, says);
    Ok(())
}

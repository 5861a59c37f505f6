//! Tendons: springs and dampers on sums of coordinates, or on the length of a line.

use super::defaults::{MAIN, View};
use super::model::{Model, Tendon};
use super::stops::{Factor, Lazy, stop};
use crate::element::Element;
use crate::options::Stops;
use crate::robot::{Coordinate, Target, Term, What};
use crate::source::{Fault, Read};
use mbs_core::algebra::norm;

/// What a tendon pulls: terms, their length as drawn, and that without tension in the springs of the joints.
struct Pulled {
    terms: Vec<Term>,
    drawn: f64,
    slack: f64,
}

/// Reads the elements `tendon`.
pub(super) fn read<'a>(
    root: &'a Element,
    factor: &Lazy,
    model: &mut Model<'a, '_, '_>,
) -> Read<()> {
    for element in root.each("tendon").flat_map(|tendons| &tendons.children) {
        if !matches!(element.name.as_str(), "fixed" | "spatial") {
            continue;
        }
        let view = model.classes.view_as(element.read(), "tendon", MAIN)?;
        for ending in model.endings(element) {
            let pulled = match element.name.as_str() {
                "fixed" => Some(fixed(element, &ending, model)?),
                _ => spatial(&view, &ending, model)?,
            };
            laws(&view, &ending, pulled, factor, model)?;
        }
    }
    Ok(())
}

/// A sum of coordinates.
fn fixed(element: &Element, ending: &str, model: &Model<'_, '_, '_>) -> Read<Pulled> {
    let mut pulled = Pulled { terms: Vec::new(), drawn: 0.0, slack: 0.0 };
    for child in element.each("joint") {
        let motion = model.single(child.need("joint")?, ending)?;
        let factor = child.need("coef")?.number()?;
        let (term, length) = motion.term(factor);
        pulled.drawn += length;
        pulled.slack += factor * motion.spring;
        if factor != 0.0 {
            pulled.terms.push(term);
        }
    }
    Ok(pulled)
}

/// A line over sites; `None` where it winds around a geom or has pulleys, and pulls nothing by itself.
fn spatial(view: &View<'_>, ending: &str, model: &Model<'_, '_, '_>) -> Read<Option<Pulled>> {
    let element = view.element;
    if let Some(winding) = element.children.iter().find(|child| child.name != "site") {
        if acts(view)? {
            return Err(winding_fault(winding));
        }
        element.read_whole();
        return Ok(None);
    }
    let mut line = Vec::new();
    let mut drawn = 0.0;
    for child in element.each("site") {
        let site = model.site(child.need("site")?, ending)?;
        let point = (site.link, site.pose.at);
        if let Some((_, last)) = line.last() {
            drawn += norm(&(point.1 - last));
        }
        line.push(point);
    }
    if line.len() < 2 {
        return Err(element.fault("a tendon of fewer than two sites", "name two sites or more"));
    }
    let none = Coordinate { joint: 0, number: None };
    let terms = vec![Term { line, ..Term::new(none, 1.0) }];
    Ok(Some(Pulled { terms, drawn, slack: drawn }))
}

fn winding_fault(winding: &Element) -> Fault {
    winding.fault(
        format!(
            "a tendon that pulls and has a `{}`: lines here run straight over points",
            winding.name
        ),
        "lead it over sites, or leave its stiffness, damping, frictionloss and armature out",
    )
}

/// Has it a law of its own?
fn acts(view: &View<'_>) -> Read<bool> {
    for name in ["stiffness", "damping", "frictionloss", "armature"] {
        let values = view.attribute(name).map(|word| word.list()).transpose()?.unwrap_or_default();
        if values.iter().any(|x| *x != 0.0) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Keeps a tendon by its name, and adds what it does by itself.
fn laws(
    view: &View<'_>,
    ending: &str,
    pulled: Option<Pulled>,
    factor: &Lazy,
    model: &mut Model<'_, '_, '_>,
) -> Read<()> {
    let element = view.element;
    let number = model.tendons.len() + 1;
    let name = match element.value("name") {
        Some(name) => model.copied(name, ending),
        None => format!("tendon {number}"),
    };
    model.tendon_names.add(&name, element.at, &model.context.sources)?;
    let label = format!("tendon/{}[{name}]", element.name);
    let Some(pulled) = pulled.filter(|pulled| !pulled.terms.is_empty()) else {
        model.tendons.push(Tendon::Other);
        let says = "a tendon that has no law of its own, and no length here";
        model.context.findings.ignored(element.at, label, says);
        return Ok(());
    };
    model.tendons.push(Tendon::Sum(pulled.terms.clone(), pulled.drawn));
    let on = Target::Sum(pulled.terms.clone());
    spring(view, &name, &pulled, on.clone(), model)?;
    let friction = view.number_or("frictionloss", 0.0)?;
    if friction > 0.0 && model.compiler.acts.friction {
        let says = "frictionloss is a soft constraint there; here it is friction that falls to zero below a rate of 1e-3";
        model.context.findings.approximated(element.at, label.as_str(), says);
        model.law(&format!("{name} friction"), What::Friction { on, coulomb: friction });
    }
    let armature = view.number_or("armature", 0.0)?;
    match &pulled.terms[..] {
        _ if armature == 0.0 => {}
        [only] if only.line.is_empty() => {
            let on = Target::Coordinate(only.of.clone());
            let inertia = armature * only.factor * only.factor;
            model.law(&format!("{name} armature"), What::Rotor { on, inertia });
        }
        _ => {
            let says = "armature of a tendon over several joints does not act here";
            model.context.findings.ignored(element.at, label.as_str(), says);
        }
    }
    ends(view, (&name, label), &pulled, factor, model)
}

/// The ends of the length of a tendon: stops of the inertia that it moves, as those of a joint.
fn ends(
    view: &View<'_>,
    (name, label): (&str, String),
    pulled: &Pulled,
    factor: &Lazy,
    model: &mut Model<'_, '_, '_>,
) -> Read<()> {
    let is_limited = view.is_limited("limited", "range", model.compiler.auto_limits)?;
    let (range, solref) =
        (view.numbers::<2>("range")?, view.numbers_or("solreflimit", [0.02, 1.0])?);
    view.attribute("solimplimit");
    let Some(range) = range.filter(|_| is_limited && model.compiler.acts.limit) else {
        return Ok(());
    };
    let factor = factor.get_or_init(|| Factor::new(model)).as_ref();
    let moved = factor.and_then(|factor| factor.moved_by(&pulled.terms));
    let [stiffness, damping] = match (model.context.options.limits, moved) {
        (Some(Stops::Given { stiffness, damping }), _) => [stiffness, damping],
        (_, Some(moved)) => stop(solref, moved),
        (_, None) => {
            let says = "the ends of a tendon that moves no mass do not act here";
            model.context.findings.ignored(view.element.at, label, says);
            return Ok(());
        }
    };
    let says = "its ends are soft constraints there; here a stop with stiffness and damping by solreflimit and the moved inertia";
    model.context.findings.approximated(view.element.at, label, says);
    let [lower, upper] = range.map(|end| end - pulled.drawn);
    let on = Target::Sum(pulled.terms.clone());
    let what = What::Limit { on, lower, upper, stiffness, damping };
    model.law(&format!("{name} stops"), what);
    Ok(())
}

/// The spring and the damper of a tendon.
fn spring(
    view: &View<'_>,
    name: &str,
    pulled: &Pulled,
    on: Target,
    model: &mut Model<'_, '_, '_>,
) -> Read<()> {
    let acts = model.compiler.acts;
    let [stiffness, damping] = [view.number_or("stiffness", 0.0)?, view.number_or("damping", 0.0)?];
    let stiffness = if acts.spring { stiffness } else { 0.0 };
    let damping = if acts.damper { damping } else { 0.0 };
    let lengths = view.attribute("springlength").map(|length| length.list()).transpose()?;
    if stiffness <= 0.0 && damping <= 0.0 {
        return Ok(());
    }
    let (element, label) = (view.element, format!("tendon/{}[{name}]", view.element.name));
    let free = match lengths.as_deref() {
        Some([x]) if *x != -1.0 => *x,
        Some([x, y, ..]) if x == y && *x != -1.0 => *x,
        Some([lower, upper, ..]) if lower < upper && stiffness > 0.0 => {
            let ends = [lower - pulled.drawn, upper - pulled.drawn];
            slack_between(name, ends, stiffness, &pulled.terms, model);
            if damping > 0.0 {
                let what = What::Spring { on, stiffness: 0.0, damping, free: 0.0 };
                model.law(&format!("{name} damper"), what);
            }
            return Ok(());
        }
        _ => {
            let is_line = pulled.terms.iter().any(|term| !term.line.is_empty());
            let is_bent = model.motions.iter().any(|motion| motion.spring != motion.zero);
            if stiffness > 0.0 && is_line && is_bent {
                let says = "its spring is free as the model is drawn; there where the springs of the joints are";
                model.context.findings.approximated(element.at, label, says);
            }
            pulled.slack
        }
    };
    let what = What::Spring { on, stiffness, damping, free: free - pulled.drawn };
    model.law(&format!("{name} spring"), what);
    Ok(())
}

/// A spring that is slack between two lengths: one that pulls above them, and one that pulls at the sum with the other sign below.
fn slack_between(
    name: &str,
    [lower, upper]: [f64; 2],
    stiffness: f64,
    terms: &[Term],
    model: &mut Model<'_, '_, '_>,
) {
    let others = terms.iter().map(|term| Term { factor: -term.factor, ..term.clone() });
    let others = Target::Sum(others.collect());
    let on = Target::Sum(terms.to_vec());
    model.law(&format!("{name} above"), What::Pull { on, stiffness, free: upper });
    model.law(&format!("{name} below"), What::Pull { on: others, stiffness, free: -lower });
}

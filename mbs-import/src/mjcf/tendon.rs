//! Tendons: springs and dampers on sums of coordinates, or on the length of a line.

use super::compiler::SAVED;
use super::defaults::{MAIN, View};
use super::flywheel;
use super::model::{Model, Tendon};
use super::size::Size;
use super::springs;
use super::stops::{Factor, Lazy, stop};
use super::strength::Strength;
use crate::element::{Attribute, Element};
use crate::options::Stops;
use crate::pose::V3;
use crate::robot::{Coordinate, Target, Term, What};
use crate::source::{Fault, Read};
use mbs_core::algebra::norm;

/// The sum on which a tendon acts: its terms, its length in the reference configuration, and its length when its springs have no force.
struct Pulled {
    terms: Vec<Term>,
    /// True if a part of the tendon is in a frame with a scale.
    is_grown: bool,
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

/// Reads a `fixed` tendon: a sum of joint coordinates.
fn fixed(element: &Element, ending: &str, model: &Model<'_, '_, '_>) -> Read<Pulled> {
    let mut pulled = Pulled { terms: Vec::new(), is_grown: false, drawn: 0.0, slack: 0.0 };
    for child in element.each("joint") {
        let motion = model.single(child.need("joint")?, ending)?;
        let factor = child.need("coef")?.number()?;
        pulled.is_grown |= motion.size != Size::ONE;
        let (term, length) = motion.term(factor);
        pulled.drawn += length;
        pulled.slack += factor * motion.spring;
        if factor != 0.0 {
            pulled.terms.push(term);
        }
    }
    Ok(pulled)
}

/// Reads a `spatial` tendon: lines over sites, with a new line after each pulley. `None` when the tendon wraps around a geom.
fn spatial(view: &View<'_>, ending: &str, model: &Model<'_, '_, '_>) -> Read<Option<Pulled>> {
    let element = view.element;
    if let Some(winding) = element.children.iter().find(|child| child.name == "geom") {
        if acts(view)? {
            return Err(winding_fault(winding));
        }
        element.read_whole();
        return Ok(None);
    }
    let none = Coordinate { joint: 0, number: None };
    let mut terms = vec![Term::new(none.clone(), 1.0)];
    let mut is_grown = false;
    for child in &element.children {
        match child.name.as_str() {
            "site" => {
                let site = model.site(child.read().need("site")?, ending)?;
                let last = terms.len() - 1;
                is_grown |= site.is_grown();
                terms[last].line.push((site.link, site.pose.at));
            }
            "pulley" => {
                let word = child.read().need("divisor")?;
                let divisor = word.number()?;
                if divisor <= 0.0 {
                    return Err(word.fault(
                        "a divisor that is not above zero",
                        "write 2 for a block with two strands",
                    ));
                }
                terms.push(Term::new(none.clone(), 1.0 / divisor));
            }
            _ => {}
        }
    }
    terms.retain(|term| !term.line.is_empty());
    if terms.is_empty() || terms.iter().any(|term| term.line.len() < 2) {
        return Err(element.fault("a strand of fewer than two sites", "name two sites or more"));
    }
    let drawn = terms.iter().map(|term| term.factor * length(&term.line)).sum();
    let slack = terms.iter().map(|term| {
        let points = term.line.iter().map(|(link, at)| (*link, model.as_drawn(*link, at)));
        term.factor * length(&points.collect::<Vec<_>>())
    });
    let slack = slack.sum();
    Ok(Some(Pulled { terms, is_grown, drawn, slack }))
}

/// Length of a line in the configuration of its points [m].
pub(super) fn length(line: &[(usize, V3)]) -> f64 {
    line.windows(2).map(|ends| norm(&(ends[1].1 - ends[0].1))).sum()
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

/// True if the tendon has a spring, damper, friction or armature.
fn acts(view: &View<'_>) -> Read<bool> {
    for name in ["stiffness", "damping", "frictionloss", "armature"] {
        let values = view.attribute(name).map(|word| word.list()).transpose()?.unwrap_or_default();
        if values.iter().any(|x| *x != 0.0) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Stores a tendon under its name, and adds its own laws.
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
    let auto = model.compiler.of(element.at).auto_limits;
    let is_clamped = view.is_limited("actuatorfrclimited", "actuatorfrcrange", auto)?;
    let effort = view.numbers("actuatorfrcrange")?.filter(|_| is_clamped);
    let Some(pulled) = pulled.filter(|pulled| !pulled.terms.is_empty()) else {
        model.tendons.push(Tendon { name, ..Tendon::default() });
        let says = "a tendon that has no law of its own, and no length here: it does nothing";
        model.context.findings.noted(element.at, label, says);
        return Ok(());
    };
    let is_limited = view.is_limited("limited", "range", auto)?;
    let range = view.numbers::<2>("range")?.filter(|_| is_limited);
    let is_grown = pulled.is_grown;
    if is_grown && (acts(view)? || range.is_some()) {
        let message = "a tendon over joints or sites in a frame with a scale";
        return Err(element.fault(message, SAVED));
    }
    let (terms, drawn) = (pulled.terms.clone(), pulled.drawn);
    model.tendons.push(Tendon { name: name.clone(), terms, drawn, range, effort, is_grown });
    let on = Target::Sum(pulled.terms.clone());
    spring(view, &name, &pulled, &on, model)?;
    let friction = view.number_or("frictionloss", 0.0)?;
    if friction > 0.0 && model.compiler.acts.friction {
        let says = "frictionloss is a soft constraint there; here it is friction that falls to zero below a rate of 1e-3";
        model.context.findings.approximated(element.at, label.as_str(), says);
        model.law(&format!("{name} friction"), What::Friction { on, coulomb: friction });
    }
    let armature = view.number_or("armature", 0.0)?;
    if armature != 0.0 {
        flywheel::add(&format!("{name} armature"), &pulled.terms, armature, model);
    }
    ends(view, (&name, label), (&pulled, range), factor, model)
}

/// Adds the stops of a tendon's length. Like those of a joint, they depend on the inertia that the tendon moves.
fn ends(
    view: &View<'_>,
    (name, label): (&str, String),
    (pulled, range): (&Pulled, Option<[f64; 2]>),
    factor: &Lazy,
    model: &mut Model<'_, '_, '_>,
) -> Read<()> {
    let solref = view.merged("solreflimit", [0.02, 1.0])?;
    view.attribute("solimplimit");
    let Some(range) = range.filter(|_| model.compiler.acts.limit) else {
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

/// Adds the spring and the damper of a tendon.
fn spring(
    view: &View<'_>,
    name: &str,
    pulled: &Pulled,
    on: &Target,
    model: &mut Model<'_, '_, '_>,
) -> Read<()> {
    let acts = model.compiler.acts;
    let stiffness = Strength::read(view, "stiffness")?.where_it(acts.spring);
    let damping = Strength::read(view, "damping")?.where_it(acts.damper);
    let word = view.attribute("springlength");
    let ends = match word.map(Attribute::list).transpose()?.as_deref() {
        Some([length]) if *length != -1.0 => [*length; 2],
        Some([lower, upper]) if [*lower, *upper] != [-1.0; 2] => [*lower, *upper],
        _ => {
            let is_line = pulled.terms.iter().any(|term| !term.line.is_empty());
            let is_bent = model.motions.iter().any(|motion| motion.spring != motion.drawn);
            if stiffness != Strength::NONE && is_line && is_bent {
                let says = "its spring is free as the model is drawn; there where the springs of the joints are";
                let label = format!("tendon/{}[{name}]", view.element.name);
                model.context.findings.approximated(view.element.at, label, says);
            }
            [pulled.slack; 2]
        }
    };
    if let Some(word) = word.filter(|_| !(ends[0] <= ends[1])) {
        return Err(
            word.fault("the second length is below the first", "write the shorter length first")
        );
    }
    let ends = ends.map(|end| end - pulled.drawn);
    springs::add(name, on, [stiffness, damping], ends, model);
    Ok(())
}

//! Equalities: closed loops and couplings. They are soft in MuJoCo and exact constraints here.

use super::compiler::SAVED;
use super::model::{Model, Moves, Tendon};
use super::offset::{self, Offset};
use super::size::Size;
use crate::element::{Attribute, Element};
use crate::pose::{M3, Pose, quaternion, v3};
use crate::robot::{Coupling, GROUND, Joint, Kind, Term};
use crate::source::Read;

/// Reads the elements `equality`.
pub(super) fn read<'a>(root: &'a Element, model: &mut Model<'a, '_, '_>) -> Read<()> {
    for element in root.each("equality").flat_map(|equality| &equality.children) {
        let is_known = matches!(element.name.as_str(), "connect" | "weld" | "joint" | "tendon");
        if !is_known {
            continue;
        }
        let view = model.classes.view_as(element.read(), "equality", super::defaults::MAIN)?;
        let is_active = view.value("active") != Some("false") && model.compiler.acts.equality;
        for name in ["name", "solref", "solimp", "torquescale"] {
            view.attribute(name);
        }
        if !is_active {
            element.read_whole();
            let says = "not active: left out";
            model.context.findings.ignored(element.at, element.label(), says);
            continue;
        }
        let mut is_kept = true;
        for ending in model.endings(element) {
            match element.name.as_str() {
                "joint" => coupling(element, &ending, model)?,
                "tendon" => is_kept = tendons(element, &ending, model)?,
                _ => closing(element, &ending, model)?,
            }
        }
        if is_kept {
            let says = "a soft constraint there, hard here";
            model.context.findings.approximated(element.at, element.label(), says);
        } else {
            let says = "an equality of tendons that is no sum of coordinates does not act here";
            model.context.findings.ignored(element.at, element.label(), says);
        }
    }
    Ok(())
}

/// Refuses an attribute whose lengths are scaled by a frame.
fn grown_fault(word: &Attribute, size: Size) -> Read<()> {
    if size == Size::ONE {
        return Ok(());
    }
    Err(word.fault("an equality of what stands in a frame with a scale", SAVED))
}

fn name(element: &Element, ending: &str, wanted: &str) -> String {
    element.value("name").map_or_else(|| wanted.to_owned(), |name| format!("{name}{ending}"))
}

/// Reads `connect` or `weld` as a joint that closes a loop.
fn closing(element: &Element, ending: &str, model: &mut Model<'_, '_, '_>) -> Read<()> {
    let is_weld = element.name == "weld";
    let (ends, offset) = if let Some(first) = element.attribute("site1") {
        let first = model.site(first, ending)?.clone();
        let second = model.site(element.need("site2")?, ending)?.clone();
        let turned = first.pose.turn * second.pose.turn.transpose();
        let turned = if is_weld { turned } else { M3::identity() };
        let (place, moved) = (second.pose.at, first.pose.at - second.pose.at);
        ([first.link, second.link], Offset { place, moved, turned })
    } else {
        let first = model.body(element.need("body1")?, ending)?;
        let second =
            element.attribute("body2").map_or(Ok(GROUND), |name| model.body(name, ending))?;
        ([first, second], between(element, is_weld, [first, second], model)?)
    };
    let carriers = model.robot.carriers(|joint| joint.kind == Kind::Fixed);
    if carriers[ends[0]] == carriers[ends[1]] {
        let says = "both ends are on one body: there is nothing to hold";
        model.context.findings.ignored(element.at, element.label(), says);
        return Ok(());
    }
    let kind = if is_weld { Kind::Weld } else { Kind::Spherical };
    let number = model.robot.joints.len();
    let wanted = name(element, ending, &format!("{} {number}", element.name));
    let wanted = model.free_name(super::model::Sort::Joint, &wanted);
    let first = offset::carried(&wanted, element, ends[0], &offset, model);
    let ends = [first, ends[1]];
    let joint = Joint::new(&wanted, element.at, kind, ends, offset.place);
    model.robot.joints.push(Joint { closes: true, ..joint });
    Ok(())
}

/// Returns the offset from the drawn pose of the second body to the pose at which the first body holds it.
fn between(
    element: &Element,
    is_weld: bool,
    [first, second]: [usize; 2],
    model: &Model<'_, '_, '_>,
) -> Read<Offset> {
    let links = &model.robot.links;
    let size = |link: usize| model.sizes.get(&link).copied().unwrap_or(Size::ONE);
    let point = |link: usize, at: [f64; 3]| links[link].pose.point(&(v3(at) * size(link).length));
    // By default, the weld holds the second body at its pose relative to the first one in the drawn configuration.
    let drawn = |link: usize| model.drawn.get(&link).copied().unwrap_or(links[link].pose);
    let held = links[first].pose.then(&drawn(first).inverse().then(&drawn(second)));
    let back = match model.posed {
        Some(_) => links[second].pose.then(&held.inverse()),
        None => Pose::identity(),
    };
    if !is_weld {
        let place = point(first, element.need("anchor")?.numbers()?);
        let moved = place - back.point(&place);
        return Ok(Offset { place: back.point(&place), moved, turned: M3::identity() });
    }
    // The anchor of a weld is a point of the second body.
    let place = point(second, element.numbers_or("anchor", [0.0; 3])?);
    let forth = back.inverse();
    let drawn = Offset { place, moved: forth.point(&place) - place, turned: forth.turn };
    let Some(relative) = element.attribute("relpose") else { return Ok(drawn) };
    grown_fault(relative, size(first))?;
    let [x, y, z, a, b, c, d] = relative.numbers()?;
    // A quaternion of zeros stands for the relative pose of the drawn configuration.
    let Some(turn) = quaternion([a, b, c, d]) else { return Ok(drawn) };
    let wanted = links[first].pose.then(&Pose::new(turn, v3([x, y, z])));
    let is = &links[second].pose;
    // The first body holds the anchor of the second body at the position and orientation in `wanted`.
    let turned = wanted.turn * is.turn.transpose();
    Ok(Offset { place: drawn.place, moved: wanted.at - drawn.place, turned })
}

/// Reads an equality of one or two tendons that are sums of coordinates; returns `false` when a tendon is not such a sum.
fn tendons(element: &Element, ending: &str, model: &mut Model<'_, '_, '_>) -> Read<bool> {
    let [constant, slope, rest @ ..] = polynomial(element)?;
    let first = model.tendon(element.need("tendon1")?, ending)?.1.clone();
    let second = element.attribute("tendon2").map(|name| Ok(model.tendon(name, ending)?.1.clone()));
    if first.is_grown {
        let message = "an equality of what stands in a frame with a scale";
        return Err(element.fault(message, SAVED));
    }
    if model.posed.is_some() {
        let message = "an equality of tendons, where a keyframe closes what is drawn open";
        return Err(element.fault(message, "draw the bodies so that loops are closed"));
    }
    let mut terms = first.terms;
    if terms.is_empty() {
        return Ok(false);
    }
    match second.transpose()? {
        None => {}
        Some(Tendon { terms: others, .. }) if rest == [0.0; 3] && !others.is_empty() => {
            let others = others.into_iter();
            terms.extend(others.map(|term| Term { factor: -slope * term.factor, ..term }));
        }
        Some(_) => return Ok(false),
    }
    let wanted = name(element, ending, "tendon equality");
    let wanted = model.free_name(super::model::Sort::Law, &wanted);
    model.robot.couplings.push(Coupling { name: wanted, terms, value: constant });
    Ok(true)
}

/// Reads the five coefficients of the polynomial of an equality.
fn polynomial(element: &Element) -> Read<[f64; 5]> {
    let mut all = [0.0, 1.0, 0.0, 0.0, 0.0];
    if let Some(written) = element.attribute("polycoef") {
        for (a, b) in all.iter_mut().zip(written.list()?) {
            *a = b;
        }
    }
    Ok(all)
}

/// Coefficients of p(x + offset) in powers of x, without the constant term, which remains that of p.
fn shifted(coefficients: [f64; 5], offset: f64) -> [f64; 5] {
    let mut all = coefficients;
    for first in 0..4 {
        for k in (first..4).rev() {
            all[k] += all[k + 1] * offset;
        }
    }
    all[0] = coefficients[0];
    all
}

/// Adds the coupling y − y₀ = a₀ + a₁ (x − x₀) + ..., or y − y₀ = a₀ without a second joint.
fn coupling(element: &Element, ending: &str, model: &mut Model<'_, '_, '_>) -> Read<()> {
    let word = element.need("joint1")?;
    let first = model.single(word, ending)?.clone();
    if first.moves == Moves::Slide {
        grown_fault(word, first.size)?;
    }
    let all = polynomial(element)?;
    let constant = all[0];
    let mut terms = vec![Term::new(first.coordinate(), first.sign)];
    // Deviations are measured from the drawn configuration.
    let mut value = constant - (first.zero - first.drawn);
    if let Some(second) = element.attribute("joint2") {
        let word = second;
        let second = model.single(word, ending)?;
        if second.moves == Moves::Slide {
            grown_fault(word, second.size)?;
        }
        let of = second.coordinate();
        // The sign of the scene's coordinate may be opposite to the file's.
        let signed = |power: i32, a: f64| a * second.sign.powi(power);
        let offset = second.zero - second.drawn;
        value += all.iter().zip(0..).skip(1).map(|(a, power)| a * offset.powi(power)).sum::<f64>();
        let all = shifted(all, offset);
        let [_, slope, rest @ ..] = all;
        if rest == [0.0; 3] {
            terms.push(Term::new(of, -signed(1, slope)));
        } else {
            let powers = all.iter().zip(0..).skip(1).map(|(a, power)| signed(power, *a));
            let coefficients = core::iter::once(0.0).chain(powers).collect();
            terms.push(Term { coefficients, ..Term::new(of, -1.0) });
        }
    }
    let wanted = name(element, ending, &format!("{} equality", first.name));
    let wanted = model.free_name(super::model::Sort::Law, &wanted);
    model.robot.couplings.push(Coupling { name: wanted, terms, value });
    Ok(())
}

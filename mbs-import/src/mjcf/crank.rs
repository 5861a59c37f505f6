//! Sliders driven by a rod: a massless link on a slide, at a fixed distance from a point of the crank.

use super::model::{Model, Site, Sort};
use super::transmission::{GROWN, Transmission};
use crate::element::Element;
use crate::robot::{Coordinate, Joint, Kind, Link, Term};
use crate::source::Read;

/// The slide of an actuator with `cranksite` and `slidersite`, or the reason why there is none. The length of this transmission is measured
/// from the slider's site to the end of the rod.
pub(super) fn slide(
    element: &Element,
    gear: f64,
    (cranklength, ending): (Option<f64>, &str),
    model: &mut Model<'_, '_, '_>,
) -> Read<Result<Transmission, String>> {
    let crank = model.site(element.need("cranksite")?, ending)?.clone();
    let word = element.need("slidersite")?;
    let slider = model.site(word, ending)?.clone();
    if crank.is_grown() || slider.is_grown() {
        return Ok(Err(GROWN.into()));
    }
    let rod = match cranklength {
        Some(length) if length > 0.0 => length,
        _ => {
            return Err(
                element.fault("`cranklength` is not above zero", "write the length of the rod [m]")
            );
        }
    };
    let axis = slider.pose.turn.column(2).into_owned();
    let offset = crank.pose.at - slider.pose.at;
    // Length l = a·r − √((a·r)² + L² − r²), with the axis a, the rod's length L and the vector r from slider to crank.
    let along = axis.dot(&offset);
    let square = along * along + rod * rod - offset.dot(&offset);
    if square <= 0.0 {
        return Ok(Err("as drawn the rod does not reach from the crank to the slider".into()));
    }
    let drawn = along - square.sqrt();
    let wanted = format!("{} slider", element.value("name").unwrap_or(&word.value));
    let coordinate = add(&wanted, element, [&crank, &slider], drawn, model);
    let terms = vec![Term::new(coordinate, 1.0)];
    Ok(Ok(Transmission { terms, drawn, gear, has_length: true, ..Transmission::none(&word.value) }))
}

/// Adds the massless link, its slide and the rod.
fn add(
    wanted: &str,
    element: &Element,
    [crank, slider]: [&Site; 2],
    drawn: f64,
    model: &mut Model<'_, '_, '_>,
) -> Coordinate {
    let axis = slider.pose.turn.column(2).into_owned();
    let end = slider.pose.at + axis * drawn;
    let (link, at) = (model.robot.links.len(), element.at);
    let name = model.free_name(Sort::Link, wanted);
    model.robot.links.push(Link { pose: slider.pose, ..Link::new(&name, at) });
    let joint = model.robot.joints.len();
    let name = model.free_name(Sort::Joint, wanted);
    let mut slide = Joint::new(&name, at, Kind::Prismatic, [slider.link, link], end);
    slide.axes = vec![axis];
    let name = model.free_name(Sort::Joint, &format!("{wanted} rod"));
    let rod = Joint::new(&name, at, Kind::Distance(end), [crank.link, link], crank.pose.at);
    model.robot.joints.extend([slide, rod]);
    Coordinate { joint, number: None }
}

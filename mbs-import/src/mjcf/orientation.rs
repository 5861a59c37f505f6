//! Positions and orientations of elements.

use super::compiler::Compiler;
use super::defaults::View;
use crate::element::Attribute;
use crate::pose::{M3, Pose, V3, about, direction, from_z_to, quaternion, unit, v3};
use crate::source::Read;
use mbs_core::algebra::cross;

/// The attributes that give an orientation; an element has one of them.
const WORDS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// The frame of an element, relative to that of its parent.
pub(super) fn pose(view: &View<'_>, compiler: &Compiler) -> Read<Pose> {
    Ok(Pose::new(turn(view, compiler)?, v3(view.numbers_or("pos", [0.0; 3])?)))
}

/// The orientation of an element. An attribute of the element overrides all orientation attributes of its class.
pub(super) fn turn(view: &View<'_>, compiler: &Compiler) -> Read<M3> {
    let compiler = compiler.of(view.element.at);
    let own: Vec<_> = WORDS.iter().filter_map(|word| view.own(word)).collect();
    let inherited = WORDS.iter().rev().find_map(|word| view.inherited(word));
    match (&own[..], inherited) {
        ([], None) => Ok(M3::identity()),
        ([], Some(word)) => of(word, compiler),
        ([word], _) => of(word, compiler),
        ([_, second, ..], _) => Err(second.fault(
            "a second orientation of the same element",
            "write one of quat, axisangle, xyaxes, zaxis and euler",
        )),
    }
}

fn of(word: &Attribute, compiler: &Compiler) -> Read<M3> {
    let along = |x: [f64; 3]| {
        direction(&v3(x)).ok_or_else(|| word.fault("an axis of length zero", "write a direction"))
    };
    match word.name.as_str() {
        "quat" => quaternion(word.numbers()?).ok_or_else(|| {
            word.fault("a quaternion of length zero", "write w x y z of unit length")
        }),
        "axisangle" => {
            let [x, y, z, angle] = word.numbers()?;
            Ok(about(&along([x, y, z])?, compiler.angle(angle)))
        }
        "xyaxes" => {
            let [a, b, c, d, e, f] = word.numbers()?;
            let x = along([a, b, c])?;
            let y = v3([d, e, f]);
            let y = direction(&(y - x * x.dot(&y))).ok_or_else(|| {
                word.fault("two axes along each other", "write two axes across each other")
            })?;
            Ok(M3::from_columns(&[x, y, cross(&x, &y)]))
        }
        "zaxis" => Ok(from_z_to(&along(word.numbers()?)?)),
        _ => Ok(euler(word.numbers()?, compiler)),
    }
}

/// Rotation by three Euler angles: small letters are moving axes, capitals are fixed axes.
pub(super) fn euler(angles: [f64; 3], compiler: &Compiler) -> M3 {
    angles.iter().zip(compiler.sequence).fold(M3::identity(), |turned, (angle, letter)| {
        let axis = unit(usize::from(letter.to_ascii_lowercase() - b'x'));
        let next = about(&axis, compiler.angle(*angle));
        if letter.is_ascii_lowercase() { turned * next } else { next * turned }
    })
}

/// The frame of a shape between two points, and half its length. The z axis is along the line, the origin in its middle.
pub(super) fn from_to(word: &Attribute) -> Read<(Pose, f64)> {
    let [a, b, c, d, e, f] = word.numbers()?;
    let (from, to): (V3, V3) = (v3([a, b, c]), v3([d, e, f]));
    let line = from - to;
    let along = direction(&line)
        .ok_or_else(|| word.fault("both ends are one place", "write two places"))?;
    let half = line.dot(&line).sqrt() / 2.0;
    Ok((Pose::new(from_z_to(&along), (from + to) * 0.5), half))
}

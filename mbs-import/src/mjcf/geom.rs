//! Geoms: mass, and what is drawn.

use super::asset::{self, MeshGeom};
use super::defaults::View;
use super::model::Model;
use super::orientation::{from_to, pose};
use crate::inertia::Mass;
use crate::pose::{M3, Pose, V3, v3};
use crate::robot::{Form, FormKind};
use crate::source::Read;
use core::f64::consts::PI;

/// Groups that the format's own viewer shows; the others are for contact.
const SEEN_GROUPS: f64 = 2.0;

/// A solid along the z axis of its frame, with half lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Solid {
    Sphere(f64),
    /// Radius, half the length without the round ends.
    Capsule(f64, f64),
    Cylinder(f64, f64),
    Ellipsoid([f64; 3]),
    Box([f64; 3]),
}

/// What of a geom is needed.
#[derive(Debug, Clone)]
pub(super) enum Geom {
    /// A solid with its mass, which is zero where it counts for none.
    Solid(Mass),
    /// A mesh whose mass counts.
    Mesh(MeshGeom),
    /// Neither.
    Nothing,
}

impl Solid {
    pub(super) fn volume(&self) -> f64 {
        match *self {
            Self::Sphere(r) => 4.0 / 3.0 * PI * r.powi(3),
            Self::Capsule(r, h) => 2.0 * PI * r * r * h + 4.0 / 3.0 * PI * r.powi(3),
            Self::Cylinder(r, h) => 2.0 * PI * r * r * h,
            Self::Ellipsoid([a, b, c]) => 4.0 / 3.0 * PI * a * b * c,
            Self::Box([a, b, c]) => 8.0 * a * b * c,
        }
    }

    /// Principal moments for each kilogram.
    pub(super) fn moments(&self) -> [f64; 3] {
        let squares = |[a, b, c]: [f64; 3], share: f64| {
            [b * b + c * c, a * a + c * c, a * a + b * b].map(|x| x * share)
        };
        match *self {
            Self::Sphere(r) => [0.4 * r * r; 3],
            Self::Ellipsoid(half) => squares(half, 0.2),
            Self::Box(half) => squares(half, 1.0 / 3.0),
            Self::Cylinder(r, h) => {
                let across = r * r / 4.0 + h * h / 3.0;
                [across, across, r * r / 2.0]
            }
            Self::Capsule(r, h) => {
                // the shares of the cylinder and of both ends together
                let (middle, ends) = (2.0 * PI * r * r * h, 4.0 / 3.0 * PI * r.powi(3));
                let all = middle + ends;
                let (middle, ends) = (middle / all, ends / all);
                let across = middle * (r * r / 4.0 + h * h / 3.0)
                    + ends * (0.4 * r * r + h * h + 0.75 * r * h);
                [across, across, middle * r * r / 2.0 + ends * 0.4 * r * r]
            }
        }
    }

    /// The area of its surface, and the moments of a shell for each kilogram; `None` of an ellipsoid, which has no closed form.
    fn shell(&self) -> Option<(f64, [f64; 3])> {
        // a tube with what closes it: area, moment across and along of the latter
        let closed = |[r, h]: [f64; 2], [area, across, along]: [f64; 3]| {
            let tube = 4.0 * PI * r * h;
            let all = tube + area;
            let [tube, ends] = [tube / all, area / all];
            let across = tube * (r * r / 2.0 + h * h / 3.0) + ends * across;
            (all, [across, across, tube * r * r + ends * along])
        };
        Some(match *self {
            Self::Sphere(r) => (4.0 * PI * r * r, [2.0 / 3.0 * r * r; 3]),
            Self::Capsule(r, h) => {
                let ball = 2.0 / 3.0 * r * r;
                closed([r, h], [4.0 * PI * r * r, ball + h * h + r * h, ball])
            }
            Self::Cylinder(r, h) => {
                closed([r, h], [2.0 * PI * r * r, r * r / 4.0 + h * h, r * r / 2.0])
            }
            Self::Box(half) => {
                let [a, b, c] = half;
                let faces = [b * c, a * c, a * b];
                let all: f64 = faces.iter().sum();
                // the mean square along an axis: one on the faces across it, a third on the others
                let square = |axis: usize| {
                    let share = faces[axis] / all;
                    half[axis] * half[axis] * (share + (1.0 - share) / 3.0)
                };
                let [x, y, z] = [0, 1, 2].map(square);
                (8.0 * all, [y + z, x + z, x + y])
            }
            Self::Ellipsoid(_) => return None,
        })
    }

    const fn form(&self) -> Option<FormKind> {
        Some(match *self {
            Self::Sphere(radius) => FormKind::Sphere { radius },
            Self::Capsule(radius, half) => FormKind::Capsule { radius, length: 2.0 * half },
            Self::Cylinder(radius, half) => FormKind::Cylinder { radius, length: 2.0 * half },
            Self::Box([a, b, c]) => FormKind::Box([2.0 * a, 2.0 * b, 2.0 * c]),
            Self::Ellipsoid(_) => return None,
        })
    }
}

/// Reads a geom in a frame that stands as `scope` says: its mass in global axes, and its form.
pub(super) fn read(
    view: &View<'_>,
    link: usize,
    scope: &Pose,
    model: &mut Model<'_, '_, '_>,
) -> Read<Geom> {
    let kind = view.value("type").unwrap_or("sphere");
    for name in ["name", "class", "rgba"] {
        view.own(name);
    }
    let group = view.number_or("group", 0.0)?;
    if view.number_or("contype", 1.0)? != 0.0 || view.number_or("conaffinity", 1.0)? != 0.0 {
        model.touching += 1;
    }
    let [first, last] = model.compiler.groups;
    let written = view.number("mass")?;
    let density = view.number_or("density", 1000.0)?;
    if written.unwrap_or(0.0) < 0.0 || density < 0.0 {
        return Err(view.element.fault("mass or density is below zero", "write zero or more"));
    }
    let counts = (first..=last).contains(&group) && written.unwrap_or(density) > 0.0;
    if view.attribute("mesh").is_some() || matches!(kind, "mesh" | "sdf") {
        view.attribute("size");
        let pose = scope.then(&pose(view, &model.compiler)?);
        let mesh = view.attribute("mesh").cloned();
        let (at, is_fitted) = (view.element.at, !matches!(kind, "mesh" | "sdf"));
        let geom = MeshGeom { at, mesh, is_fitted, mass: written, density, pose };
        if kind == "mesh" && group <= SEEN_GROUPS {
            draw(&geom, view, link, model)?;
        }
        return Ok(if counts { Geom::Mesh(geom) } else { Geom::Nothing });
    }
    let (frame, half) = match view.attribute("fromto") {
        Some(ends) => from_to(ends).map(|(frame, half)| (frame, Some(half)))?,
        None => (pose(view, &model.compiler)?, None),
    };
    let frame = scope.then(&frame);
    if matches!(kind, "plane" | "hfield") {
        view.attribute("size");
        return Ok(Geom::Nothing);
    }
    let solid = solid(view, kind, half)?;
    if let Some(form) = solid.form().filter(|_| group <= SEEN_GROUPS) {
        let colour = view.numbers("rgba")?;
        model.robot.shapes.push(Form { link, pose: frame, kind: form, colour });
    }
    if !counts {
        return Ok(Geom::Nothing);
    }
    let is_shell = view.value("shellinertia") == Some("true");
    let (size, moments) = match solid.shell().filter(|_| is_shell) {
        Some(shell) => shell,
        None => (solid.volume(), solid.moments()),
    };
    if is_shell && solid.shell().is_none() {
        let says = "the shell of an ellipsoid: it counts as a solid of the same mass or density";
        model.context.findings.ignored(view.element.at, view.element.label(), says);
    }
    let mass = written.unwrap_or(density * size);
    let tensor = M3::from_diagonal(&v3(moments.map(|x| x * mass)));
    Ok(Geom::Solid(Mass { mass, center: V3::zeros(), tensor }.seen_from(&frame)))
}

/// Adds what is drawn of a mesh.
fn draw(geom: &MeshGeom, view: &View<'_>, link: usize, model: &mut Model<'_, '_, '_>) -> Read<()> {
    match asset::form(geom, model)? {
        Ok((pose, kind)) => {
            let colour = view.numbers("rgba")?;
            model.robot.shapes.push(Form { link, pose, kind, colour });
        }
        Err(says) => model.context.findings.not_drawn(geom.at, view.element.label(), says),
    }
    Ok(())
}

/// The form and its sizes; of one between two places the half length is known.
fn solid(view: &View<'_>, kind: &str, half: Option<f64>) -> Read<Solid> {
    let sizes = view.attribute("size").map(|size| size.list()).transpose()?.unwrap_or_default();
    let needed = match (kind, half) {
        ("sphere", _) => 1,
        ("capsule" | "cylinder", None) => 2,
        ("ellipsoid" | "box", None) => 3,
        ("capsule" | "cylinder" | "ellipsoid" | "box", Some(_)) => 1,
        _ => {
            return Err(view.element.fault(
                format!("unknown type of geom `{kind}`"),
                "types are plane, hfield, sphere, capsule, ellipsoid, cylinder, box, mesh and sdf",
            ));
        }
    };
    if sizes.len() < needed || sizes.iter().take(needed).any(|size| *size <= 0.0) {
        return Err(view.element.fault(
            format!("`size` of a {kind} has {needed} numbers above zero"),
            "write radius, or radius and half the length, or three half lengths",
        ));
    }
    let size = |i: usize| sizes[i];
    Ok(match (kind, half) {
        ("sphere", _) => Solid::Sphere(size(0)),
        ("capsule", half) => Solid::Capsule(size(0), half.unwrap_or_else(|| size(1))),
        ("cylinder", half) => Solid::Cylinder(size(0), half.unwrap_or_else(|| size(1))),
        (_, half) => {
            let half = half.map_or_else(|| [size(0), size(1), size(2)], |h| [size(0), size(0), h]);
            if kind == "box" { Solid::Box(half) } else { Solid::Ellipsoid(half) }
        }
    })
}

//! A draft as scene text.

use crate::draft::{Body, Draft, Effect, Joint, Shape};
use crate::vector::Point;
use std::fmt::Write;

/// The scene: outputs are the positions of the points that are watched.
#[must_use]
pub fn text(draft: &Draft, name: &str, duration: f64) -> String {
    let n = draft.dimension;
    let mut t = format!(
        "[scene]\nname = \"{name}\"\ndimension = {n}\ngravity = {}\nduration = {duration:?}\n\n",
        vector(draft.gravity, n)
    );
    for (k, b) in draft.bodies.iter().enumerate() {
        body(&mut t, k + 1, b, n);
    }
    for (k, j) in draft.joints.iter().enumerate() {
        joint(&mut t, k, j, n);
    }
    for (joint, value, rate) in &draft.starts {
        line(&mut t, format_args!("[[initial]]\njoint = \"j{joint}\""));
        for (key, number) in [("value", value), ("rate", rate)] {
            if let Some(number) = number {
                line(&mut t, format_args!("{key} = {number:?}"));
            }
        }
        t.push('\n');
    }
    for (joint, [amplitude, frequency, phase]) in &draft.guides {
        line(
            &mut t,
            format_args!(
                "[[guide]]\njoint = \"j{joint}\"\nsine = {{ amplitude = {amplitude:?}, frequency = {frequency:?}, phase = {phase:?} }}\n"
            ),
        );
    }
    for (k, e) in draft.effects.iter().enumerate() {
        effect(&mut t, k, e, n);
    }
    for (k, (body, at)) in draft.outputs.iter().enumerate() {
        line(
            &mut t,
            format_args!(
                "[[output]]\nname = \"p{k}\"\nbody = \"{}\"\nat = {}\nquantity = \"position\"\n",
                body_name(*body),
                vector(*at, n)
            ),
        );
    }
    t
}

/// Writing to a string cannot fail.
fn line(t: &mut String, what: std::fmt::Arguments<'_>) {
    let _ = writeln!(t, "{what}");
}

fn vector(x: Point, n: usize) -> String {
    let parts: Vec<String> = x[..n].iter().map(|x| format!("{x:?}")).collect();
    format!("[{}]", parts.join(", "))
}

fn body_name(k: usize) -> String {
    if k == 0 { "ground".to_owned() } else { format!("b{k}") }
}

fn names([a, b]: [usize; 2]) -> String {
    format!("[\"{}\", \"{}\"]", body_name(a), body_name(b))
}

fn body(t: &mut String, k: usize, body: &Body, n: usize) {
    line(t, format_args!("[[body]]\nname = \"b{k}\"\nmass = {:?}", body.mass));
    match &body.shape {
        Shape::Rod([from, to]) => line(
            t,
            format_args!("rod = {{ from = {}, to = {} }}\n", vector(*from, n), vector(*to, n)),
        ),
        Shape::Solid(center, j) => {
            let inertia = match n {
                2 => format!("{:?}", j[2]),
                _ => format!("[{}]", j.map(|x| format!("{x:?}")).join(", ")),
            };
            line(t, format_args!("center = {}\ninertia = {inertia}\n", vector(*center, n)));
        }
    }
}

fn joint(t: &mut String, k: usize, joint: &Joint, n: usize) {
    let kind = joint.kind;
    line(
        t,
        format_args!(
            "[[joint]]\nname = \"j{k}\"\nkind = \"{kind}\"\nbodies = {}",
            names(joint.bodies)
        ),
    );
    match joint.at.as_slice() {
        [a, b] => line(t, format_args!("points = [{}, {}]", vector(*a, n), vector(*b, n))),
        places => places.iter().for_each(|at| line(t, format_args!("at = {}", vector(*at, n)))),
    }
    match joint.axes.as_slice() {
        [a, b] if kind == "universal" => {
            line(t, format_args!("axes = [{}, {}]", vector(*a, n), vector(*b, n)));
        }
        [a, ..] => line(t, format_args!("axis = {}", vector(*a, n))),
        [] => {}
    }
    t.push('\n');
}

fn effect(t: &mut String, k: usize, effect: &Effect, n: usize) {
    line(t, format_args!("[[effect]]\nname = \"e{k}\""));
    let between = |t: &mut String, kind: &str, bodies: [usize; 2], [a, b]: [Point; 2]| {
        let (bodies, a, b) = (names(bodies), vector(a, n), vector(b, n));
        line(t, format_args!("kind = \"{kind}\"\nbodies = {bodies}\npoints = [{a}, {b}]"));
    };
    match effect {
        Effect::Spring(bodies, points, [stiffness, damping, free]) => {
            between(t, "spring-damper", *bodies, *points);
            line(
                t,
                format_args!(
                    "stiffness = {stiffness:?}\ndamping = {damping:?}\nfree_length = {free:?}\n"
                ),
            );
        }
        Effect::Bumper(bodies, points, [stiffness, damping, clearance]) => {
            between(t, "bumper", *bodies, *points);
            line(
                t,
                format_args!(
                    "stiffness = {stiffness:?}\ndamping = {damping:?}\nclearance = {clearance:?}\n"
                ),
            );
        }
        Effect::Pieces(bodies, points, pieces) => {
            between(t, "polynomial-spring", *bodies, *points);
            line(t, format_args!("coefficients = {pieces:?}\n"));
        }
        Effect::Torsion(joint, [stiffness, damping, free]) => line(
            t,
            format_args!(
                "kind = \"torsion-spring\"\njoint = \"j{joint}\"\nstiffness = {stiffness:?}\ndamping = {damping:?}\nfree_value = {free:?}\n"
            ),
        ),
        Effect::Limit(joint, [lower, upper, stiffness, damping]) => line(
            t,
            format_args!(
                "kind = \"limit\"\njoint = \"j{joint}\"\nlower = {lower:?}\nupper = {upper:?}\nstiffness = {stiffness:?}\ndamping = {damping:?}\n"
            ),
        ),
        Effect::Friction(joint, coulomb) => line(
            t,
            format_args!("kind = \"friction\"\njoint = \"j{joint}\"\ncoulomb = {coulomb:?}\n"),
        ),
        Effect::Torque(joint, value) => {
            line(t, format_args!("kind = \"torque\"\njoint = \"j{joint}\"\nvalue = {value:?}\n"))
        }
    }
}

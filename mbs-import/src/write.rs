//! Writes the text of the scene for a model.

mod law;

use crate::gravity::is_same;
use crate::lump::Lumps;
use crate::pose::{M3, V3};
use crate::robot::{Form, FormKind, GROUND, Joint, Kind, Robot, Target, Term, is_even};
use mbs_scene::quoted;
use std::fmt::Write;

/// Writes the text of a scene. The reader of scenes checks later whether the scene is valid.
pub(crate) fn scene(robot: &Robot, lumps: &Lumps) -> String {
    let mut writer = Writer { robot, lumps, out: String::new() };
    writer.head();
    writer.bodies();
    writer.frames();
    writer.joints();
    writer.couplings();
    writer.laws();
    writer.start();
    writer.shapes();
    writer.out
}

struct Writer<'a> {
    robot: &'a Robot,
    lumps: &'a Lumps,
    out: String,
}

/// Shortest text of a number that reads back as the same number.
fn number(x: f64) -> String {
    format!("{:?}", if x == 0.0 { 0.0 } else { x })
}

fn list(numbers: impl IntoIterator<Item = f64>) -> String {
    let numbers: Vec<_> = numbers.into_iter().map(number).collect();
    format!("[{}]", numbers.join(", "))
}

fn vector(x: &V3) -> String {
    list(x.iter().copied())
}

impl Writer<'_> {
    fn line(&mut self, text: impl AsRef<str>) {
        self.out.push_str(text.as_ref());
        self.out.push('\n');
    }

    fn key(&mut self, key: &str, value: impl AsRef<str>) {
        let _ = writeln!(self.out, "{key} = {}", value.as_ref());
    }

    fn table(&mut self, header: &str) {
        let _ = writeln!(self.out, "\n[[{header}]]");
    }

    fn head(&mut self) {
        for note in &self.robot.notes {
            // Control characters in names of the file must not end the comment.
            let note = note.replace(|c: char| c.is_control(), " ");
            let _ = writeln!(self.out, "# {note}");
        }
        self.line("\n[scene]");
        self.key("name", quoted(&self.robot.name));
        self.key("dimension", "3");
        self.key("gravity", list(self.robot.gravity));
        self.key("duration", "1.0");
    }

    /// The name of the body that contains a link.
    fn body(&self, link: usize) -> String {
        let carrier = self.lumps.lumps[self.lumps.of[link]].carrier;
        if carrier == GROUND { quoted("ground") } else { quoted(&self.robot.links[carrier].name) }
    }

    fn bodies(&mut self) {
        for lump in &self.lumps.lumps[1..] {
            let link = &self.robot.links[lump.carrier];
            let center = if lump.mass.mass == 0.0 { link.pose.at } else { lump.mass.center };
            self.table("body");
            self.key("name", quoted(&link.name));
            self.key("mass", number(lump.mass.mass));
            self.key("center", vector(&center));
            self.key("inertia", list(lump.mass.six()));
            if !is_same(lump.gravity_scale, 1.0) {
                self.key("gravity_scale", number(lump.gravity_scale));
            }
        }
    }

    fn frames(&mut self) {
        for frame in &self.robot.frames {
            let body = self.body(frame.link);
            self.table("frame");
            self.key("name", quoted(&frame.name));
            self.key("body", body);
            self.key("at", vector(&frame.pose.at));
            if frame.pose.turn != M3::identity() {
                self.key("axes", axes(&frame.pose.turn));
            }
        }
    }

    fn joints(&mut self) {
        for joint in &self.robot.joints {
            let Some(kind) = word(joint.kind) else { continue };
            let bodies = format!("[{}, {}]", self.body(joint.parent), self.body(joint.child));
            self.table("joint");
            self.key("name", quoted(&joint.name));
            self.key("kind", quoted(kind));
            self.key("bodies", bodies);
            self.geometry(joint);
            if let Some(range) = joint.range {
                self.key("range", list(range));
            }
            if let Some(effort) = joint.effort {
                self.key("effort_limit", number(effort));
            }
            if let Some(rate) = joint.rate {
                self.key("velocity_limit", number(rate));
            }
        }
    }

    fn geometry(&mut self, joint: &Joint) {
        if let Kind::Distance(end) = joint.kind {
            self.key("points", format!("[{}, {}]", vector(&joint.place), vector(&end)));
            return;
        }
        self.key("at", vector(&joint.place));
        match (joint.kind, &joint.axes[..]) {
            (Kind::Universal, [first, second, ..]) => {
                self.key("axes", format!("[{}, {}]", vector(first), vector(second)));
            }
            (_, [axis, rest @ ..]) => {
                self.key("axis", vector(axis));
                if let [direction, ..] = rest {
                    self.key("direction", vector(direction));
                }
            }
            (_, []) => {}
        }
    }

    fn joint_name(&self, joint: usize) -> String {
        quoted(&self.robot.joints[joint].name)
    }

    fn terms(&self, terms: &[Term]) -> String {
        let terms = terms.iter().map(|term| {
            let mut text = if term.line.is_empty() {
                format!("{{ joint = {}", self.joint_name(term.of.joint))
            } else {
                format!("{{ points = {}", self.line_points(&term.line))
            };
            if let Some(number) = term.of.number {
                let _ = write!(text, ", coordinate = {number}");
            }
            // A factor of one is the default.
            if (term.factor - 1.0).abs() > 0.0 {
                let _ = write!(text, ", factor = {}", number(term.factor));
            }
            if !term.coefficients.is_empty() {
                let _ =
                    write!(text, ", coefficients = {}", list(term.coefficients.iter().copied()));
            }
            text + " }"
        });
        format!("[{}]", terms.collect::<Vec<_>>().join(", "))
    }

    fn line_points(&self, line: &[(usize, V3)]) -> String {
        let points = line.iter().map(|(link, place)| {
            format!("{{ body = {}, at = {} }}", self.body(*link), vector(place))
        });
        format!("[{}]", points.collect::<Vec<_>>().join(", "))
    }

    fn couplings(&mut self) {
        for coupling in &self.robot.couplings {
            let terms = self.terms(&coupling.terms);
            self.table("coupling");
            self.key("name", quoted(&coupling.name));
            self.key("kind", quoted("linear"));
            self.key("terms", terms);
            if coupling.value != 0.0 {
                self.key("value", number(coupling.value));
            }
        }
    }

    fn target(&mut self, target: &Target) {
        match target {
            Target::Coordinate(of) => {
                let joint = self.joint_name(of.joint);
                self.key("joint", joint);
                if let Some(number) = of.number {
                    self.key("coordinate", number.to_string());
                } else if self.robot.joints[of.joint].kind == Kind::Prismatic {
                    // For a torque or a torsion spring on a prismatic joint, the coordinate must be named.
                    self.key("coordinate", quoted("slide"));
                }
            }
            Target::Sum(terms) => {
                let terms = self.terms(terms);
                self.key("terms", terms);
            }
        }
    }

    fn effect(&mut self, name: &str, kind: &str, on: &Target) {
        self.table("effect");
        self.key("name", quoted(name));
        self.key("kind", quoted(kind));
        self.target(on);
    }

    fn signal(&mut self, name: &str, kind: &str) {
        self.table("signal");
        self.key("name", quoted(name));
        self.key("kind", quoted(kind));
    }

    fn laws(&mut self) {
        let robot = self.robot;
        for law in &robot.laws {
            self.law(&law.name, &law.what);
        }
    }

    fn start(&mut self) {
        for start in &self.robot.start {
            let joint = self.joint_name(start.joint);
            self.table("initial");
            self.key("joint", joint);
            for (key, numbers) in [("value", &start.value), ("rate", &start.rate)] {
                match &numbers[..] {
                    [] => {}
                    [x] => self.key(key, number(*x)),
                    all => self.key(key, list(all.iter().copied())),
                }
            }
        }
    }

    fn shapes(&mut self) {
        for form in &self.robot.shapes {
            let body = self.body(form.link);
            self.table("shape");
            self.key("body", body);
            self.key(form.kind.word(), form.text());
            if let Some([red, green, blue, opacity]) = form.colour {
                let byte = |x: f64| format!("{:02x}", (x.clamp(0.0, 1.0) * 255.0).round() as u8);
                self.key("colour", quoted(&format!("#{}{}{}", byte(red), byte(green), byte(blue))));
                if opacity < 1.0 {
                    self.key("opacity", number(opacity.clamp(0.0, 1.0)));
                }
            }
        }
    }
}

/// The word of a joint's kind in a scene; `None` for a welded link.
const fn word(kind: Kind) -> Option<&'static str> {
    Some(match kind {
        Kind::Fixed => return None,
        Kind::Weld => "weld",
        Kind::Revolute => "revolute",
        Kind::Prismatic => "prismatic",
        Kind::Cylindrical => "cylindrical",
        Kind::Universal => "universal",
        Kind::Spherical => "spherical",
        Kind::Planar => "planar",
        Kind::Free => "free",
        Kind::Distance(_) => "distance",
    })
}

/// The first two axes of a frame, as a list of two vectors.
fn axes(turn: &M3) -> String {
    let [x, y] = [0, 1].map(|i| vector(&turn.column(i).into_owned()));
    format!("[{x}, {y}]")
}

impl FormKind {
    const fn word(&self) -> &'static str {
        match self {
            Self::Box(_) => "box",
            Self::Sphere { .. } => "sphere",
            Self::Capsule { .. } => "capsule",
            Self::Cylinder { .. } => "cylinder",
            Self::Mesh { .. } => "mesh",
        }
    }
}

impl Form {
    /// The key for the axes of the shape, empty when they are the global axes.
    fn turned(&self) -> String {
        let is_turned = self.pose.turn != M3::identity();
        if is_turned { format!(", axes = {}", axes(&self.pose.turn)) } else { String::new() }
    }

    fn text(&self) -> String {
        let ends = |length: f64| {
            let half = self.pose.turn.column(2) * (length / 2.0);
            [self.pose.at - half, self.pose.at + half].map(|x| vector(&x))
        };
        match &self.kind {
            FormKind::Box(size) => {
                let turned = self.turned();
                format!("{{ center = {}, size = {}{turned} }}", vector(&self.pose.at), list(*size))
            }
            FormKind::Sphere { radius } => {
                format!("{{ center = {}, radius = {} }}", vector(&self.pose.at), number(*radius))
            }
            FormKind::Mesh { file, scale } => {
                let scale = if is_even(*scale) { number(scale[0]) } else { list(*scale) };
                let (file, at, turned) = (quoted(file), vector(&self.pose.at), self.turned());
                format!("{{ file = {file}, at = {at}{turned}, scale = {scale} }}")
            }
            FormKind::Capsule { radius, length } | FormKind::Cylinder { radius, length } => {
                let [from, to] = ends(*length);
                format!("{{ from = {from}, to = {to}, radius = {} }}", number(*radius))
            }
        }
    }
}

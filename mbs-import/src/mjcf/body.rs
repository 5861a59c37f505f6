//! The tree of bodies, with `frame` and `replicate`.

use super::asset::{self, MeshGeom};
use super::compiler::SAVED;
use super::defaults::{MAIN, View};
use super::geom::{self, Geom};
use super::joint::{self, Written};
use super::model::{Model, Site, Sort};
use super::orientation::{euler, pose};
use super::size::Size;
use super::weights;
use crate::element::Element;
use crate::inertia::{Mass, tensor};
use crate::pose::{Pose, V3, v3};
use crate::robot::{Frame, GROUND, Link, scene_name};
use crate::source::{Fault, Read};

/// Largest number of copies that one `replicate` makes [-].
const MAX_COPIES: f64 = 10_000.0;
/// Largest number of bodies, joints, geoms and sites of a model [-]. Nested copies could multiply without this limit.
const MAX_PARTS: usize = 200_000;

/// Scope of the elements in a body, a frame or a copy.
#[derive(Debug, Clone)]
struct Scope {
    link: usize,
    /// Frame of the scope, in global axes.
    frame: Pose,
    /// Frame of the scope as the model is drawn, when the reference configuration is that of a keyframe.
    drawn: Pose,
    class: usize,
    /// Ending of all names in a copy; empty outside of copies.
    ending: String,
    /// True if the body is fixed to the ground.
    is_still: bool,
    /// Size factors of everything in the scope.
    size: Size,
}

/// Parts of a body, without the parts of the bodies in it.
#[derive(Debug, Default)]
struct Own {
    joints: Vec<Written>,
    inertial: Option<Mass>,
    geoms: Vec<Mass>,
    /// Meshes with mass, each with the place about which it is scaled.
    meshes: Vec<(MeshGeom, Size, V3)>,
    gravity_share: f64,
}

/// Reads the elements `worldbody`.
pub(super) fn read<'a>(root: &'a Element, model: &mut Model<'a, '_, '_>) -> Read<()> {
    let mut walk = Walk { model, parts: 0, numbers: 0, places: 0 };
    for world in root.each("worldbody") {
        let frame = Pose::identity();
        let scope = Scope {
            link: GROUND,
            frame,
            drawn: frame,
            class: MAIN,
            ending: String::new(),
            is_still: true,
            size: Size::ONE,
        };
        let scope = Scope { class: walk.class(world, &scope)?, ..scope };
        let mut own = Own::default();
        walk.own(world, &scope, &mut own)?;
        if let Some(joint) = own.joints.first() {
            return Err(Fault::new(joint.at(), "a joint of the world", "put it into a body"));
        }
        walk.bodies(world, &scope)?;
    }
    Ok(())
}

struct Walk<'m, 'a, 'b, 'c> {
    model: &'m mut Model<'a, 'b, 'c>,
    parts: usize,
    /// Number of position values of the joints read so far.
    places: usize,
    /// Number of bodies read so far, for the names of bodies without a name.
    numbers: usize,
}

impl<'a> Walk<'_, 'a, '_, '_> {
    fn part(&mut self, element: &Element) -> Read<()> {
        self.parts += 1;
        if self.parts > MAX_PARTS {
            let message = format!("more than {MAX_PARTS} bodies, joints, geoms and sites");
            return Err(element.fault(message, "replicate fewer of them"));
        }
        Ok(())
    }

    /// Index of the default class for the elements within `element`.
    fn class(&self, element: &Element, scope: &Scope) -> Read<usize> {
        let class = element.attribute("childclass");
        class.map_or(Ok(scope.class), |name| self.model.classes.find(name))
    }

    fn name(&mut self, element: &Element, scope: &Scope) -> Option<String> {
        let name = element.value("name").filter(|name| !name.is_empty())?;
        Some(self.model.copied(name, &scope.ending))
    }

    /// Reads the joints, inertia, geoms and sites of a body.
    fn own(&mut self, element: &'a Element, scope: &Scope, own: &mut Own) -> Read<()> {
        let classes = self.model.classes;
        for child in &element.children {
            match child.name.as_str() {
                "frame" | "replicate" => {
                    for scope in self.scopes(child.read(), scope)? {
                        self.part(child)?;
                        self.own(child, &scope, own)?;
                    }
                }
                "inertial" => own.inertial = Some(self.inertial(child.read(), scope)?),
                "joint" | "freejoint" => {
                    self.part(child)?;
                    let body = &self.model.robot.links[scope.link].name;
                    let unnamed = match own.joints.len() {
                        0 => format!("{body} joint"),
                        n => format!("{body} joint {}", n + 1),
                    };
                    let name = match self.name(child, scope) {
                        Some(name) => name,
                        None => self.model.free_name(Sort::Joint, &unnamed),
                    };
                    let view = match child.name.as_str() {
                        "joint" => classes.view(child.read(), scope.class)?,
                        _ => View::plain(child.read()),
                    };
                    let place = (&scope.frame, scope.size);
                    own.joints.push(joint::read(&view, name, place, self.model)?);
                }
                "geom" => {
                    self.part(child)?;
                    let view = classes.view(child.read(), scope.class)?;
                    let (drawn, about) = (self.model.robot.shapes.len(), scope.frame.at);
                    match geom::read(&view, scope.link, &scope.frame, self.model)? {
                        Geom::Solid(mass) => own.geoms.push(scope.size.of_mass(&mass, &about)),
                        Geom::Mesh(mesh) => own.meshes.push((mesh, scope.size, about)),
                        Geom::Nothing => {}
                    }
                    for form in &mut self.model.robot.shapes[drawn..] {
                        scope.size.grow(form, &about);
                    }
                }
                "site" => self.site(child.read(), scope)?,
                "attach" => {
                    let message = "`attach` without a <model> in <asset>";
                    return Err(child.fault(message, "name the file of the other model there"));
                }
                "composite" | "flexcomp" => {
                    let message =
                        format!("`{}` makes bodies, which this reader does not make", child.name);
                    return Err(child.fault(message, SAVED));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Reads the bodies within a body.
    fn bodies(&mut self, element: &'a Element, scope: &Scope) -> Read<()> {
        for child in &element.children {
            match child.name.as_str() {
                "frame" | "replicate" => {
                    for scope in self.scopes(child, scope)? {
                        self.bodies(child, &scope)?;
                    }
                }
                "body" => self.body(child.read(), scope)?,
                _ => {}
            }
        }
        Ok(())
    }

    fn body(&mut self, element: &'a Element, scope: &Scope) -> Read<()> {
        self.part(element)?;
        self.numbers += 1;
        let name = match self.name(element, scope) {
            Some(name) => name,
            None => self.model.free_name(Sort::Link, &format!("body{}", self.numbers)),
        };
        let link = self.model.robot.links.len();
        // The list `body_links` has the link of each body. Massless links between joints make the indices of bodies and links differ.
        self.model.bodies.add(&name, element.at, &self.model.context.sources)?;
        self.model.body_links.push(link);
        // The scene uses the name `ground` for the ground.
        let name = if name == "ground" { "ground-link".to_owned() } else { name };
        let name = if element.value("name").is_some() {
            self.model.free_name(Sort::Link, &name)
        } else {
            name
        };
        let own_pose = scope.size.pose(pose(&View::plain(element), &self.model.compiler)?);
        let (frame, drawn) = (scope.frame.then(&own_pose), scope.drawn.then(&own_pose));
        let in_parent = self.model.robot.links[scope.link].pose.inverse().then(&frame);
        if scope.size != Size::ONE {
            self.model.sizes.insert(link, scope.size);
        }
        self.model.robot.links.push(Link { pose: frame, ..Link::new(&name, element.at) });
        let mut inner = Scope {
            link,
            frame,
            drawn,
            class: self.class(element, scope)?,
            ending: scope.ending.clone(),
            is_still: false,
            size: scope.size,
        };
        let mut own = Own { gravity_share: element.number_or("gravcomp", 0.0)?, ..Own::default() };
        let from = [self.model.robot.shapes.len(), self.model.sites.len()];
        self.own(element, &inner, &mut own)?;
        self.posed(&mut inner, &mut own, from)?;
        let mocap = element.attribute("mocap").filter(|mocap| mocap.value.trim() == "true");
        if mocap.is_some() {
            let says = "a body that is set from outside: it stands where it is drawn";
            self.model.context.findings.approximated(element.at, element.label(), says);
        }
        inner.is_still = own.joints.is_empty() && scope.is_still;
        let mut mass = self.mass(element, &own, inner.is_still)?;
        if mass.is_nothing() && own.inertial.is_none() {
            // A body without inertia may get mass by `boundmass`, which is then at `pos` of its own frame.
            mass.center = inner.frame.point(&in_parent.at);
        }
        self.model.masses.push((link, mass, own.gravity_share));
        joint::join(std::mem::take(&mut own.joints), scope.link, link, self.model)?;
        self.bodies(element, &inner)
    }

    /// Moves a body with all its own parts to its pose in the keyframe, if the reference configuration is that of a keyframe.
    fn posed(&mut self, inner: &mut Scope, own: &mut Own, [shape, site]: [usize; 2]) -> Read<()> {
        let Some(places) = self.model.posed.take() else { return Ok(()) };
        let rest = places.get(self.places..).unwrap_or_default();
        let (moved, taken) = joint::posed(&mut own.joints, &inner.frame, rest)?;
        self.places += taken;
        self.model.posed = Some(places);
        self.model.drawn.insert(inner.link, inner.drawn);
        inner.frame = moved.then(&inner.frame);
        self.model.robot.links[inner.link].pose = inner.frame;
        for mass in own.geoms.iter_mut().chain(&mut own.inertial) {
            *mass = mass.seen_from(&moved);
        }
        for (mesh, _, about) in &mut own.meshes {
            mesh.pose = moved.then(&mesh.pose);
            *about = moved.point(about);
        }
        for form in &mut self.model.robot.shapes[shape..] {
            form.pose = moved.then(&form.pose);
        }
        for site in &mut self.model.sites[site..] {
            site.pose = moved.then(&site.pose);
        }
        Ok(())
    }

    /// The mass of a body: the mass that is written, or the sum of its geoms.
    fn mass(&mut self, element: &Element, own: &Own, is_still: bool) -> Read<Mass> {
        use super::compiler::FromGeoms::{Always, Auto, Never};
        let sum = own.geoms.iter().fold(Mass::none(), |sum, geom| sum.with(geom));
        let counts_geoms = match (self.model.compiler.from_geoms, &own.inertial) {
            (Never, _) | (Auto, Some(_)) => false,
            (Always, Some(_)) => !own.geoms.is_empty() || !own.meshes.is_empty(),
            (Always | Auto, None) => true,
        };
        if !counts_geoms {
            return Ok(own.inertial.unwrap_or_else(Mass::none));
        }
        let mut sum = sum;
        for (mesh, size, about) in own.meshes.iter().filter(|_| !is_still) {
            if self.model.context.options.massless_meshes {
                let says = "a mesh counts as massless (--massless-meshes)";
                let label = format!("{}/geom", element.label());
                self.model.context.findings.ignored(mesh.at, label, says);
            } else {
                sum = sum.with(&size.of_mass(&asset::mass(mesh, self.model)?, about));
            }
        }
        Ok(sum)
    }

    fn inertial(&mut self, element: &'a Element, scope: &Scope) -> Read<Mass> {
        let frame = scope.frame.then(&pose(&View::plain(element), &self.model.compiler)?);
        let mass = element.need("mass")?;
        let value = mass.number()?;
        if value < 0.0 {
            return Err(mass.fault("the mass is below zero", "write a mass of zero or more, in kg"));
        }
        let [xx, yy, zz] = element.numbers_or("diaginertia", [0.0; 3])?;
        let six = match element.attribute("fullinertia") {
            // The file has the order xx yy zz xy xz yz.
            Some(full) => {
                let [xx, yy, zz, xy, xz, yz] = full.numbers()?;
                let six = [xx, yy, zz, xy, yz, xz];
                weights::check_written(full, &tensor(six))?;
                six
            }
            None => [xx, yy, zz, 0.0, 0.0, 0.0],
        };
        let own = Mass { mass: value, center: V3::zeros(), tensor: tensor(six) };
        Ok(scope.size.of_mass(&own.seen_from(&frame), &scope.frame.at))
    }

    fn site(&mut self, element: &'a Element, scope: &Scope) -> Read<()> {
        self.part(element)?;
        let view = self.model.classes.view(element, scope.class)?;
        let frame = match view.attribute("fromto") {
            Some(ends) => super::orientation::from_to(ends)?.0,
            None => pose(&view, &self.model.compiler)?,
        };
        let Some(name) = self.name(element, scope) else { return Ok(()) };
        let frame = scope.frame.then(&scope.size.pose(frame));
        self.model.site_names.add(&name, element.at, &self.model.context.sources)?;
        let (link, size) = (scope.link, scope.size);
        self.model.sites.push(Site { name, link, pose: frame, size });
        Ok(())
    }

    /// Scopes of the elements in a `frame`, or of each copy of a `replicate`.
    fn scopes(&mut self, element: &'a Element, scope: &Scope) -> Read<Vec<Scope>> {
        let view = View::plain(element);
        let class = self.class(element, scope)?;
        if element.name == "frame" {
            element.attribute("name");
            let own = scope.size.pose(pose(&view, &self.model.compiler)?);
            let (frame, drawn) = (scope.frame.then(&own), scope.drawn.then(&own));
            let size = scope.size.of_frame(element)?;
            return Ok(vec![Scope { frame, drawn, class, size, ..scope.clone() }]);
        }
        let count = element.need("count")?;
        let number = count.number()?;
        if !(1.0..=MAX_COPIES).contains(&number) || number.fract() != 0.0 {
            let hint = format!("write a whole number from 1 to {MAX_COPIES}");
            return Err(count.fault("no number of copies", hint));
        }
        let offset = v3(element.numbers_or("offset", [0.0; 3])?) * scope.size.length;
        let angles = element.numbers_or::<3>("euler", [0.0; 3])?;
        let separator = element.value("sep").unwrap_or("");
        let mut scopes = Vec::new();
        let mut at = V3::zeros();
        let width = format!("{}", number - 1.0).len();
        for copy in 0..number as usize {
            let turned =
                euler(angles.map(|angle| angle * copy as f64), self.model.compiler.of(element.at));
            let own = Pose::new(turned, at);
            let (frame, drawn) = (scope.frame.then(&own), scope.drawn.then(&own));
            at += turned * offset;
            // The endings of inner copies come before those of outer copies.
            let ending = format!("{separator}{copy:0width$}{}", scope.ending);
            scopes.push(Scope { frame, drawn, class, ending, ..scope.clone() });
        }
        Ok(scopes)
    }
}

/// Adds the sites as frames of the scene.
pub(super) fn frames(model: &mut Model<'_, '_, '_>) {
    for site in std::mem::take(&mut model.sites) {
        // A body may have the same name as a site.
        let name = model.free_name(Sort::Link, &scene_name(&site.name, "frame"));
        model.robot.frames.push(Frame { name, link: site.link, pose: site.pose });
    }
}

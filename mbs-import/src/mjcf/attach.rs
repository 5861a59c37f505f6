//! Attached models: their bodies replace the `attach` element, and their names get a prefix.
//!
//! Each attached model keeps its default classes and its unit of angles. A tendon, an actuator or an equality is attached too, if all
//! elements that it names are attached.

use super::compiler::{ATTACHED, Compiler, SAVED, SOURCES};
use super::defaults::is_actuator;
use super::include::include;
use crate::beside::{Included, find};
use crate::context::Context;
use crate::element::{Attribute, Element};
use crate::source::Read;
use std::collections::{BTreeSet, HashSet};
use std::path::Path;

/// Attributes that contain names, to which the prefix is added.
const NAMES: [&str; 20] = [
    "name",
    "class",
    "childclass",
    "joint",
    "joint1",
    "joint2",
    "jointinparent",
    "body",
    "body1",
    "body2",
    "site",
    "site1",
    "site2",
    "refsite",
    "cranksite",
    "slidersite",
    "tendon",
    "tendon1",
    "tendon2",
    "mesh",
];
/// Number of attributes at the beginning of `NAMES` that name the element itself. The others refer to other elements.
const OWN_NAMES: usize = 3;

/// Replaces the `attach` elements by the bodies of other models.
pub(crate) fn attach(root: &mut Element, context: &mut Context<'_>) -> Read<()> {
    let mut reader = Reader { context, included: Included::default(), added: Vec::new() };
    reader.model(root)
}

struct Reader<'a, 'c> {
    context: &'a mut Context<'c>,
    included: Included,
    /// Elements to be added to the root, besides the bodies.
    added: Vec<Element>,
}

impl Reader<'_, '_> {
    /// Replaces all attachments in a model.
    fn model(&mut self, root: &mut Element) -> Read<()> {
        let models: Vec<Element> =
            root.each("asset").flat_map(|asset| asset.each("model")).cloned().collect();
        if models.is_empty() {
            return Ok(());
        }
        models.iter().for_each(Element::read_whole);
        for asset in root.children.iter().filter(|child| child.name == "asset") {
            asset
                .children
                .iter()
                .filter(|child| child.name == "model")
                .for_each(Element::read_whole);
        }
        let outer = std::mem::take(&mut self.added);
        let mut children = std::mem::take(&mut root.children);
        for world in children.iter_mut().filter(|child| child.name == "worldbody") {
            self.inside(world, (&models, root))?;
        }
        children.extend(std::mem::replace(&mut self.added, outer));
        root.children = children;
        Ok(())
    }

    fn inside(&mut self, element: &mut Element, of: (&[Element], &Element)) -> Read<()> {
        for child in &mut element.children {
            if child.name == "attach" {
                *child = self.attached(child, of)?;
            } else if matches!(child.name.as_str(), "body" | "frame" | "replicate") {
                self.inside(child, of)?;
            }
        }
        Ok(())
    }

    /// The element that replaces an `attach`.
    fn attached(&mut self, attach: &Element, (models, _): (&[Element], &Element)) -> Read<Element> {
        let name = attach.need("model")?;
        let is_it = |model: &&Element| model.value("name") == Some(name.value.trim());
        let model = models.iter().find(is_it).ok_or_else(|| {
            name.fault(format!("unknown model `{}`", name.value), "name a <model> of <asset>")
        })?;
        if let Some(frame) = attach.attribute("frame") {
            return Err(frame.fault("a frame of another model is not attached here", SAVED));
        }
        let prefix = attach.need("prefix")?.value.clone();
        let file = model.need("file")?;
        let path = find(file, Path::new(file.value.trim()), self.included.folder(), self.context)?;
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        let mut root = self.included.open(file, path, attach.at, self.context)?;
        include(&mut root, self.context)?;
        self.model(&mut root)?;
        self.included.close();
        let bodies = taken(&root, attach)?;
        let mut names = HashSet::new();
        bodies.iter().for_each(|body| collect(body, &mut names));
        self.sections(&root, (&prefix, &folder), &mut names)?;
        let settings = ["compiler", "default", ATTACHED];
        let kept = root.children.iter().filter(|child| settings.contains(&child.name.as_str()));
        let mut own = Element::new(ATTACHED.to_owned(), root.at, Vec::new());
        own.children = kept.cloned().collect();
        own.children.iter_mut().for_each(|child| prefixed(child, &prefix));
        own.attributes.push(written("class", format!("{prefix}main"), attach));
        let mut sources = BTreeSet::new();
        collect_sources(&root, &mut sources);
        let sources: Vec<_> = sources.iter().map(u16::to_string).collect();
        own.attributes.push(written(SOURCES, sources.join(" "), attach));
        self.added.push(own);
        let mut frame = Element::new("frame".to_owned(), attach.at, Vec::new());
        frame.attributes.push(written("childclass", format!("{prefix}main"), attach));
        frame.children = bodies;
        frame.children.iter_mut().for_each(|body| prefixed(body, &prefix));
        Ok(frame)
    }

    /// Adds meshes, and those tendons, equalities and actuators whose named elements are all attached.
    fn sections(
        &mut self,
        root: &Element,
        (prefix, folder): (&str, &Path),
        names: &mut HashSet<(&'static str, String)>,
    ) -> Read<()> {
        let compiler = Compiler::read(root)?;
        for section in ["asset", "tendon", "equality", "actuator"] {
            for element in root.children.iter().filter(|child| child.name == section) {
                let mut own = Element::new(section.to_owned(), element.at, Vec::new());
                for child in &element.children {
                    let is_kept = match section {
                        "asset" => child.name == "mesh",
                        "actuator" => is_actuator(&child.name) && is_whole(child, names),
                        _ => is_whole(child, names),
                    };
                    if !is_kept {
                        continue;
                    }
                    let mut child = child.clone();
                    if section == "asset" {
                        mesh(&mut child, &compiler, folder);
                    } else if let Some(name) = child.value("name").filter(|_| section == "tendon") {
                        names.insert(("tendon", name.to_owned()));
                    }
                    if child.attributes.iter().all(|word| word.name != "class") {
                        let at = child.clone();
                        child.attributes.push(written("class", "main".to_owned(), &at));
                    }
                    prefixed(&mut child, prefix);
                    own.children.push(child);
                }
                if !own.children.is_empty() {
                    self.added.push(own);
                }
            }
        }
        for keyframe in root.children.iter().filter(|child| child.name == "keyframe") {
            let says = "keyframes of an attached model are not read";
            self.context.findings.ignored(keyframe.at, "keyframe", says);
        }
        Ok(())
    }
}

/// The body that the `attach` names, or all bodies of the world.
fn taken(root: &Element, attach: &Element) -> Read<Vec<Element>> {
    let worlds = root.children.iter().filter(|child| child.name == "worldbody");
    let Some(name) = attach.attribute("body") else {
        return Ok(worlds.flat_map(|world| world.children.iter().cloned()).collect());
    };
    let mut rest: Vec<&Element> = worlds.collect();
    while let Some(element) = rest.pop() {
        if element.name == "body" && element.value("name") == Some(name.value.trim()) {
            return Ok(vec![element.clone()]);
        }
        rest.extend(&element.children);
    }
    let message = format!("the model has no body `{}`", name.value);
    Err(name.fault(message, "name a body of it, or none to attach all that is in its world"))
}

/// Collects the names in an element, with their kinds.
fn collect(element: &Element, names: &mut HashSet<(&'static str, String)>) {
    let kind = match element.name.as_str() {
        "joint" | "freejoint" => Some("joint"),
        "body" => Some("body"),
        "site" => Some("site"),
        _ => None,
    };
    if let (Some(kind), Some(name)) = (kind, element.value("name")) {
        names.insert((kind, name.to_owned()));
    }
    element.children.iter().for_each(|child| collect(child, names));
}

/// Collects the indices of the texts of which an element consists.
fn collect_sources(element: &Element, sources: &mut BTreeSet<u16>) {
    sources.insert(element.at.source);
    element.children.iter().for_each(|child| collect_sources(child, sources));
}

/// True if all elements that this element names are attached.
fn is_whole(element: &Element, names: &HashSet<(&'static str, String)>) -> bool {
    let is_there = |word: &Attribute| {
        let kind = match word.name.as_str() {
            "joint" | "joint1" | "joint2" | "jointinparent" => "joint",
            "body" | "body1" | "body2" => "body",
            "site" | "site1" | "site2" | "refsite" | "cranksite" | "slidersite" => "site",
            "tendon" | "tendon1" | "tendon2" => "tendon",
            _ => return true,
        };
        let is_world = kind == "body" && word.value == "world";
        is_world || names.contains(&(kind, word.value.trim().to_owned()))
    };
    let children = element.children.iter().flat_map(|child| &child.attributes);
    element.attributes.iter().chain(children).all(is_there)
}

/// Gives a mesh a name if it has none, and makes the path of its file absolute.
fn mesh(element: &mut Element, compiler: &Compiler, folder: &Path) {
    let at = element.clone();
    for word in element.attributes.iter_mut().filter(|word| word.name == "file") {
        let name = Path::new(word.value.trim());
        let name = match name.file_name().filter(|_| compiler.strip_path) {
            Some(last) => Path::new(last),
            None => name,
        };
        let place = folder.join(&compiler.mesh_folder).join(name);
        word.value = place.display().to_string();
    }
    let stem = at.value("file").and_then(|file| Path::new(file).file_stem()?.to_str());
    if let (None, Some(stem)) = (at.value("name"), stem) {
        element.attributes.push(written("name", stem.to_owned(), &at));
    }
}

/// An attribute that the import adds to an element.
fn written(name: &str, value: String, at: &Element) -> Attribute {
    Attribute::new(name.to_owned(), value, at.at)
}

/// Adds a prefix to all names in an element, and to all references.
fn prefixed(element: &mut Element, prefix: &str) {
    for word in &mut element.attributes {
        let is_name = NAMES.iter().position(|name| *name == word.name);
        let is_world = word.value.trim() == "world" && is_name.is_some_and(|at| at >= OWN_NAMES);
        if is_name.is_some() && !is_world && !word.value.trim().is_empty() {
            word.value = format!("{prefix}{}", word.value.trim());
        }
    }
    element.children.iter_mut().for_each(|child| prefixed(child, prefix));
}

//! Included models: each replaces its `include` element, which may set its name, pose and other properties.

use super::frames::MODEL;
use super::part;
use super::scope::{VERSION, missing, version};
use crate::beside::{Included, first, home, places};
use crate::context::Context;
use crate::element::{Attribute, Element};
use crate::source::Read;
use std::path::PathBuf;

/// Elements of an `include` that replace those of its model.
const OWN: [&str; 5] = ["uri", "name", "pose", "placement_frame", "static"];

/// Replaces the `include` elements by the models of other files.
pub(crate) fn include(root: &mut Element, context: &mut Context<'_>) -> Read<()> {
    Includer { context, included: Included::default() }.inside(root)
}

struct Includer<'a, 'c> {
    context: &'a mut Context<'c>,
    included: Included,
}

impl Includer<'_, '_> {
    fn inside(&mut self, element: &mut Element) -> Read<()> {
        for mut child in std::mem::take(&mut element.children) {
            match child.name.as_str() {
                "include" => {
                    let Some(model) = self.model(&child)? else { continue };
                    let is_merged = child.attribute("merge").map(Attribute::flag);
                    if is_merged.transpose()? == Some(true) {
                        let parts = merged(&child, model, element.name == "model")?;
                        element.children.extend(parts);
                    } else {
                        element.children.push(model);
                    }
                }
                "world" | "model" => {
                    self.inside(&mut child)?;
                    element.children.push(child);
                }
                _ => element.children.push(child),
            }
        }
        Ok(())
    }

    /// The model of an included file, changed by the `include`. `None` when the file has only lights.
    fn model(&mut self, include: &Element) -> Read<Option<Element>> {
        let uri = include.child("uri").ok_or_else(|| missing(include, "uri"))?.content();
        let path = self.path(&uri)?;
        let mut root = self.included.open(&uri, path, include.at, self.context)?;
        if root.name == "robot" {
            self.included.close();
            let mut model = part::model(root);
            self.own(include, &mut model)?;
            return Ok(Some(model));
        }
        if root.name != "sdf" {
            let message = format!("the root element of `{}` is `{}`", uri.value, root.name);
            return Err(uri.fault(message, "include a model in an SDF or URDF file"));
        }
        self.inside(&mut root)?;
        self.included.close();
        let number = root.need("version")?.clone();
        version(&number)?;
        let (mut models, others): (Vec<_>, Vec<_>) =
            root.children.into_iter().partition(|child| child.name == "model");
        if models.is_empty() && !others.is_empty() && others.iter().all(|x| x.name == "light") {
            self.context.findings.appearance(include.at, include.label());
            return Ok(None);
        }
        let (Some(mut model), true) = (models.pop(), models.is_empty()) else {
            let message = format!("`{}` has not exactly one model", uri.value);
            return Err(uri.fault(message, "include a file with one <model>"));
        };
        for other in others {
            let says = "only the model of an included file is read";
            self.context.findings.ignored(other.at, other.label(), says);
        }
        self.own(include, &mut model)?;
        let number = Attribute::new(VERSION.to_owned(), number.value, number.at);
        model.attributes.push(number);
        Ok(Some(model))
    }

    /// Replaces the name, the pose and other elements of a model by those of its `include`.
    fn own(&mut self, include: &Element, model: &mut Element) -> Read<()> {
        let mut set = |name: &str, value: Attribute| {
            model.attributes.retain(|attribute| attribute.name != name);
            model.attributes.push(Attribute::new(name.to_owned(), value.value, value.at));
        };
        for name in ["name", "placement_frame"] {
            if let Some(child) = include.child(name) {
                set(name, child.content());
            }
        }
        if include.child("placement_frame").is_some() && include.child("pose").is_none() {
            return Err(include.fault("`placement_frame` without a <pose>", "write its <pose>"));
        }
        for name in ["pose", "static"] {
            if let Some(child) = include.child(name) {
                model.children.retain(|other| other.name != name);
                model.children.push(child.clone());
            }
        }
        for child in include.children.iter().filter(|child| !OWN.contains(&child.name.as_str())) {
            let says = "this of an included model is not read";
            self.context.findings.ignored(child.at, format!("include/{}", child.label()), says);
        }
        Ok(())
    }

    /// The path of a file, from a URI that is relative to the folder of the including file.
    fn path(&self, uri: &Attribute) -> Read<PathBuf> {
        let hint = "give the model as a file, or put the other model here";
        let home = home(uri, hint, self.context)?;
        let folder = self.included.folder().unwrap_or(home);
        let all = places(&uri.value, folder, self.context.options).map_err(|scheme| {
            let hint = "fetch the model, and write model://NAME or the place of its file";
            uri.fault(format!("models are not fetched by `{scheme}://`"), hint)
        })?;
        first(uri, all.into_iter().map(described), self.context)?.ok_or_else(|| {
            let hint =
                "give its place from the folder of its file, as model://NAME, or set SDF_PATH; a light can be left out";
            uri.fault(format!("there is no model `{}`", uri.value), hint)
        })
    }
}

/// The model file in a folder: the file with the highest version in `model.config`, or else `model.sdf`. A path that is no folder is
/// returned unchanged.
fn described(place: PathBuf) -> PathBuf {
    if !place.is_dir() {
        return place;
    }
    let config = std::fs::read_to_string(place.join("model.config")).unwrap_or_default();
    let files = crate::xml::read(&config, 0).map(|root| {
        let files = root.children.into_iter().filter(|child| child.name == "sdf");
        files
            .map(|file| {
                let number = file.attribute("version").and_then(|number| version(number).ok());
                (number, file.text.trim().to_owned())
            })
            .max()
    });
    let file = files.ok().flatten().map(|(_, file)| file);
    place.join(file.unwrap_or_else(|| "model.sdf".to_owned()))
}

/// The elements of a model that are merged into the surrounding model. Poses that referred to its frame refer to a named frame instead.
fn merged(include: &Element, model: Element, is_in_model: bool) -> Read<Vec<Element>> {
    let refused =
        |why: &str| include.fault(why, "leave out merge=\"true\": names then begin with its name");
    if part::is_part(&model) {
        return Err(refused("a URDF that is merged"));
    }
    if !is_in_model {
        return Err(refused("a model that is merged into the world"));
    }
    if model.attribute("placement_frame").is_some() || model.child("static").is_some() {
        return Err(refused("a merged model with `placement_frame` or `static`"));
    }
    if version(model.need(VERSION)?)? < [1, 7] {
        return Err(refused("a merged model of a version before 1.7"));
    }
    let frame = format!("_merged__{}__model_frame__", model.need("name")?.value);
    let attribute =
        |name: &str, value: &str| Attribute::new(name.to_owned(), value.to_owned(), include.at);
    let canonical = model.value("canonical_link").map(str::to_owned).or_else(|| {
        let first = model.children.iter().find(|child| child.name == "link")?;
        first.value("name").map(str::to_owned)
    });
    let canonical = canonical.ok_or_else(|| refused("a merged model without a link"))?;
    let mut own = Element::new(
        "frame".into(),
        include.at,
        vec![attribute("name", &frame), attribute("attached_to", &canonical)],
    );
    let mut parts = Vec::new();
    for mut part in model.children {
        match part.name.as_str() {
            "pose" => {
                own.children.push(part);
                continue;
            }
            "link" | "model" => stand_in(&mut part, &frame),
            "frame" if part.value("attached_to").is_none() => {
                part.attributes.push(attribute("attached_to", &frame));
            }
            _ => {}
        }
        renamed(&mut part, &frame);
        parts.push(part);
    }
    stand_in(&mut own, MODEL);
    parts.push(own);
    Ok(parts)
}

/// Makes the pose of an element relative to `frame`, if the pose names no frame.
fn stand_in(element: &mut Element, frame: &str) {
    if !element.children.iter().any(|child| child.name == "pose") {
        element.children.push(Element::new("pose".into(), element.at, Vec::new()));
    }
    for pose in element.children.iter_mut().filter(|child| child.name == "pose") {
        if pose.value("relative_to").is_none_or(str::is_empty) {
            pose.attributes.retain(|attribute| attribute.name != "relative_to");
            let at = pose.at;
            pose.attributes.push(Attribute::new("relative_to".into(), frame.to_owned(), at));
        }
    }
}

/// Replaces the name of the model's frame in an element by `frame`, but not within inner models.
fn renamed(element: &mut Element, frame: &str) {
    for attribute in &mut element.attributes {
        let is_frame =
            matches!(attribute.name.as_str(), "relative_to" | "attached_to" | "expressed_in");
        if is_frame && attribute.value == MODEL {
            frame.clone_into(&mut attribute.value);
        }
    }
    if element.text.trim() == MODEL {
        frame.clone_into(&mut element.text);
    }
    let is_other = element.name == "model";
    for child in element.children.iter_mut().filter(|child| !is_other || child.name == "pose") {
        renamed(child, frame);
    }
}

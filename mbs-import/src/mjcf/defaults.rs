//! Default classes: values of attributes that an element does not have itself.

use super::compiler::ATTACHED;
use super::table::TABLE;
use crate::element::{Attribute, Element};
use crate::source::{Fault, Origin, Read};
use crate::table::{Treatment, treatment};
use mbs_scene::nearest_name;
use std::collections::HashMap;

/// Index of the default class for elements that name none.
pub(super) const MAIN: usize = 0;

/// Values that a class gives to elements, with the values of its parent classes.
#[derive(Debug, Clone, Default)]
struct Class<'a> {
    /// Attributes, by element name and attribute name. Each list has the values from the classes that write the attribute, from the outermost
    /// class to this one.
    values: HashMap<(&'a str, &'a str), Vec<&'a Attribute>>,
    /// Default elements of actuators, with the depths of their classes. Their order matters, since a default of one kind of actuator changes
    /// values that a later default of another kind starts from.
    actuators: Vec<(usize, &'a Element)>,
    /// Number of classes that contain this class.
    depth: usize,
}

/// All default classes of a model.
#[derive(Debug, Clone)]
pub(super) struct Classes<'a> {
    classes: Vec<Class<'a>>,
    names: HashMap<&'a str, (usize, Origin)>,
}

impl<'a> Classes<'a> {
    /// Reads the classes of all `default` elements below the root.
    pub(super) fn read(root: &'a Element) -> Read<Self> {
        let at = root.at;
        let mut classes =
            Self { classes: vec![Class::default()], names: HashMap::from([("main", (MAIN, at))]) };
        for element in root.each("default") {
            if let Some(name) = element.attribute("class").filter(|name| name.value != "main") {
                return Err(name.fault(
                    "the outermost default has the name `main`, and no other",
                    "leave its `class` out, or put it into a <default>",
                ));
            }
            classes.add(element, MAIN)?;
        }
        classes.attached(root)?;
        Ok(classes)
    }

    /// Adds the classes of attached models, which do not inherit from the classes of this model.
    fn attached(&mut self, root: &'a Element) -> Read<()> {
        for model in root.each(ATTACHED) {
            let name = model.need("class")?;
            self.classes.push(Class::default());
            let number = self.classes.len() - 1;
            self.names.insert(&name.value, (number, name.at));
            for element in model.each("default") {
                element.attribute("class");
                self.add(element, number)?;
            }
            self.attached(model)?;
        }
        Ok(())
    }

    /// Adds the default elements of a class, and then its inner classes. An inner class begins as a copy of the outer one.
    fn add(&mut self, element: &'a Element, number: usize) -> Read<()> {
        for child in element.children.iter().filter(|child| child.name != "default") {
            if treatment(TABLE, "default", &child.name, "") != Some(Treatment::Mapped) {
                continue;
            }
            child.read();
            if is_actuator(&child.name) {
                let class = &mut self.classes[number];
                class.actuators.push((class.depth, child));
            }
            for attribute in &child.attributes {
                let is_used = treatment(TABLE, "default", &child.name, &attribute.name);
                if matches!(is_used, Some(Treatment::Mapped | Treatment::Approximated)) {
                    // The attribute counts as read, whether an element uses this default or not.
                    child.attribute(&attribute.name);
                    let values = &mut self.classes[number].values;
                    values.entry((&child.name, &attribute.name)).or_default().push(attribute);
                }
            }
        }
        for inner in element.each("default") {
            let name = inner.need("class")?;
            let outer = self.classes[number].clone();
            self.classes.push(Class { depth: outer.depth + 1, ..outer });
            let own = self.classes.len() - 1;
            if self.names.insert(&name.value, (own, name.at)).is_some() {
                return Err(name.fault(
                    format!("a second class `{}`", name.value),
                    "give one of them another name",
                ));
            }
            self.add(inner, own)?;
        }
        Ok(())
    }

    /// The class whose name is the value of an attribute.
    pub(super) fn find(&self, name: &Attribute) -> Read<usize> {
        self.names.get(name.value.trim()).map(|(number, _)| *number).ok_or_else(|| {
            let names: Vec<_> = self.names.keys().map(|name| (*name).to_owned()).collect();
            let hint = nearest_name(&name.value, &names, "classes");
            Fault::new(name.at, format!("unknown class `{}`", name.value), hint)
        })
    }

    /// An element with the defaults of its class; `scope` is the class of an element that names none.
    pub(super) fn view(&'a self, element: &'a Element, scope: usize) -> Read<View<'a>> {
        self.view_as(element, &element.name, scope)
    }

    /// An element with the defaults of another element name. For example, a `fixed` element has the defaults of `tendon`.
    pub(super) fn view_as(
        &'a self,
        element: &'a Element,
        kind: &'a str,
        scope: usize,
    ) -> Read<View<'a>> {
        let class = element.attribute("class").map_or(Ok(scope), |name| self.find(name))?;
        Ok(View { element, kind, class: Some(&self.classes[class]) })
    }

    /// The actuator defaults of the class of an element, in their order and with the depths of their classes; and the depth of that class.
    pub(super) fn actuators(&self, element: &Element) -> Read<(&[(usize, &'a Element)], usize)> {
        let class = element.attribute("class").map_or(Ok(MAIN), |name| self.find(name))?;
        let Class { actuators, depth, .. } = &self.classes[class];
        Ok((actuators, *depth))
    }
}

/// True if an element of this name is an actuator.
pub(super) fn is_actuator(name: &str) -> bool {
    [
        "general",
        "motor",
        "position",
        "velocity",
        "intvelocity",
        "orientation",
        "pid",
        "damper",
        "cylinder",
        "muscle",
        "adhesion",
        "dcmotor",
        "plugin",
    ]
    .contains(&name)
}

/// An element with the defaults of its class.
#[derive(Debug, Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) element: &'a Element,
    kind: &'a str,
    class: Option<&'a Class<'a>>,
}

impl<'a> View<'a> {
    /// An element that has no defaults.
    pub(super) fn plain(element: &'a Element) -> Self {
        Self { element, kind: &element.name, class: None }
    }

    /// Attribute that the element itself has.
    pub(super) fn own(&self, name: &str) -> Option<&'a Attribute> {
        self.element.attribute(name)
    }

    /// Attribute that the class of the element has.
    pub(super) fn inherited(&self, name: &str) -> Option<&'a Attribute> {
        self.class.and_then(|class| class.values.get(&(self.kind, name))?.last().copied())
    }

    /// Up to `N` numbers. Numbers that a shorter list does not have come from the outer classes, or else from `default`.
    pub(super) fn merged<const N: usize>(&self, name: &str, default: [f64; N]) -> Read<[f64; N]> {
        let classes = self.class.and_then(|class| class.values.get(&(self.kind, name)));
        let mut all = default;
        for written in classes.into_iter().flatten().copied().chain(self.own(name)) {
            written.merge(&mut all)?;
        }
        Ok(all)
    }

    pub(super) fn attribute(&self, name: &str) -> Option<&'a Attribute> {
        self.own(name).or_else(|| self.inherited(name))
    }

    pub(super) fn value(&self, name: &str) -> Option<&'a str> {
        self.attribute(name).map(|attribute| attribute.value.trim())
    }

    pub(super) fn number(&self, name: &str) -> Read<Option<f64>> {
        self.attribute(name).map(Attribute::number).transpose()
    }

    pub(super) fn number_or(&self, name: &str, default: f64) -> Read<f64> {
        self.attribute(name).map_or(Ok(default), Attribute::number)
    }

    pub(super) fn numbers<const N: usize>(&self, name: &str) -> Read<Option<[f64; N]>> {
        self.attribute(name).map(Attribute::numbers).transpose()
    }

    pub(super) fn numbers_or<const N: usize>(
        &self,
        name: &str,
        default: [f64; N],
    ) -> Read<[f64; N]> {
        self.attribute(name).map_or(Ok(default), Attribute::numbers)
    }

    /// True if the limits in the attribute `range` apply. The attribute `limited` decides this. When it is `auto` or missing, limits that are
    /// written apply if `auto` is true, and are an error otherwise.
    pub(super) fn is_limited(&self, limited: &str, range: &str, auto: bool) -> Read<bool> {
        let word = self
            .attribute(limited)
            .map(|word| super::compiler::word(word, &["false", "true", "auto"]));
        match word.transpose()? {
            Some(0) => Ok(false),
            Some(1) => Ok(true),
            _ => match self.attribute(range) {
                None => Ok(false),
                Some(_) if auto => Ok(true),
                Some(range) => Err(range.fault(
                    format!("`{}` without `{limited}`, where `autolimits` is false", range.name),
                    format!("write {limited}=\"true\" or \"false\""),
                )),
            },
        }
    }
}

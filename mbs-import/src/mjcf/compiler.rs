//! Settings of the whole model, from the elements `compiler` and `option`.

use crate::element::{Attribute, Element};
use crate::source::{Origin, Read};
use std::collections::HashMap;

/// Hint for features of the file that only MuJoCo itself can evaluate.
pub(super) const SAVED: &str = "write the model as its own program compiles it, and give that file: in Python mujoco.mj_saveLastXML(\"model.xml\", mujoco.MjModel.from_xml_path(\"...\"))";

/// Attribute of an attached model: the numbers of the texts of which it consists.
pub(super) const SOURCES: &str = "sources";

/// Name of the element that holds the settings of an attached model. No XML file can have this name.
pub(super) const ATTACHED: &str = "attached model";

/// Rule that decides whether the inertia of a body comes from its geoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FromGeoms {
    Never,
    Always,
    /// The geoms count only when the body has no `inertial`.
    Auto,
}

/// Settings for reading a file, and for the laws in it.
#[derive(Debug, Clone)]
pub(super) struct Compiler {
    pub(super) is_degree: bool,
    /// Axes of three Euler angles: small letters are moving axes, capitals are fixed axes.
    pub(super) sequence: [u8; 3],
    pub(super) auto_limits: bool,
    pub(super) from_geoms: FromGeoms,
    /// First and last group of the geoms that have mass.
    pub(super) groups: [f64; 2],
    pub(super) bound_mass: f64,
    pub(super) bound_inertia: f64,
    pub(super) balance: bool,
    pub(super) total_mass: Option<f64>,
    /// Folder of meshes, relative to the folder of the file.
    pub(super) mesh_folder: String,
    /// True if the folder in a mesh's own path is ignored.
    pub(super) strip_path: bool,
    /// True if geoms are fitted to the boxes around meshes, not to the inertias of the meshes.
    pub(super) fits_boxes: bool,
    /// True if the mass of a mesh is that of its enclosed volume.
    pub(super) is_mesh_exact: bool,
    /// True if the frames of free joints are at the centre of mass, unless the attribute `align` of a joint decides otherwise.
    pub(super) align_free: bool,
    pub(super) gravity: [f64; 3],
    pub(super) acts: Acts,
    /// Settings of attached models, by the numbers of their texts.
    attached: HashMap<u16, Self>,
}

/// Kinds of forces that `option/flag` leaves switched on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Acts {
    pub(super) spring: bool,
    pub(super) damper: bool,
    pub(super) friction: bool,
    pub(super) limit: bool,
    pub(super) equality: bool,
    pub(super) actuation: bool,
    pub(super) clamp: bool,
    pub(super) contact: bool,
}

impl Compiler {
    /// Reads the settings of all `compiler` and `option` elements; later ones override earlier ones.
    pub(super) fn read(root: &Element) -> Read<Self> {
        let mut settings = Self {
            is_degree: true,
            sequence: *b"xyz",
            auto_limits: true,
            from_geoms: FromGeoms::Auto,
            groups: [0.0, 5.0],
            bound_mass: 0.0,
            bound_inertia: 0.0,
            balance: false,
            total_mass: None,
            mesh_folder: String::new(),
            strip_path: false,
            fits_boxes: false,
            is_mesh_exact: false,
            align_free: false,
            gravity: [0.0, 0.0, -9.81],
            acts: Acts {
                spring: true,
                damper: true,
                friction: true,
                limit: true,
                equality: true,
                actuation: true,
                clamp: true,
                contact: true,
            },
            attached: HashMap::new(),
        };
        for element in root.each("compiler") {
            settings.compiler(element)?;
        }
        for element in root.each(ATTACHED) {
            settings.attach(element)?;
        }
        for element in root.each("option") {
            settings.option(element)?;
        }
        Ok(settings)
    }

    /// The settings that apply at a place. If an attached model contains the place, they are its settings, or else those of the file.
    pub(super) fn of(&self, at: Origin) -> &Self {
        self.attached.get(&at.source).unwrap_or(self)
    }

    /// Adds the settings of an attached model. Settings that apply to the whole model must not differ.
    fn attach(&mut self, model: &Element) -> Read<()> {
        let own = Self::read(model)?;
        let of_all = |one: &Self| {
            let bounds = [one.bound_mass, one.bound_inertia, one.groups[0], one.groups[1]];
            (bounds, one.from_geoms, one.balance, one.total_mass, one.is_mesh_exact)
        };
        if of_all(&own) != of_all(self) {
            let message = "an attached model whose <compiler> has other settings for masses";
            return Err(model.fault(message, SAVED));
        }
        let sources = model.value(SOURCES).unwrap_or_default();
        for source in sources.split(' ').filter_map(|number| number.parse().ok()) {
            self.attached.insert(source, Self { attached: HashMap::new(), ..own.clone() });
        }
        // Models attached within the attached model have their own settings.
        self.attached.extend(own.attached);
        Ok(())
    }

    /// Converts an angle of the file to radians.
    pub(super) fn angle(&self, x: f64) -> f64 {
        if self.is_degree { x / 180.0 * core::f64::consts::PI } else { x }
    }

    fn compiler(&mut self, element: &Element) -> Read<()> {
        if let Some(angle) = element.attribute("angle") {
            self.is_degree = word(angle, &["radian", "degree"])? == 1;
        }
        let coordinate = element.attribute("coordinate");
        if let Some(other) = coordinate.filter(|word| word.value.trim() != "local") {
            return Err(other.fault(
                "places in global coordinates were taken out of the format",
                "save the model with a program that still reads them, or write coordinate=\"local\"",
            ));
        }
        if let Some(sequence) = element.attribute("eulerseq") {
            let letters = sequence.value.trim().as_bytes();
            let known = |letter: &u8| b"xyzXYZ".contains(letter);
            let letters = letters.try_into().ok().filter(|word: &[u8; 3]| word.iter().all(known));
            self.sequence = letters.ok_or_else(|| {
                sequence.fault("no three axes", "write three of x, y, z, X, Y, Z: `xyz`")
            })?;
        }
        if let Some(from) = element.attribute("inertiafromgeom") {
            let is = word(from, &["false", "true", "auto"])?;
            self.from_geoms = [FromGeoms::Never, FromGeoms::Always, FromGeoms::Auto][is];
        }
        flag(element, "strippath", &mut self.strip_path)?;
        flag(element, "fitaabb", &mut self.fits_boxes)?;
        flag(element, "exactmeshinertia", &mut self.is_mesh_exact)?;
        flag(element, "alignfree", &mut self.align_free)?;
        let folders = ["meshdir", "assetdir"].map(|name| element.value(name));
        if let Some(folder) = folders.into_iter().flatten().next() {
            self.mesh_folder = folder.to_owned();
        }
        flag(element, "autolimits", &mut self.auto_limits)?;
        flag(element, "balanceinertia", &mut self.balance)?;
        self.groups = element.numbers_or("inertiagrouprange", self.groups)?;
        self.bound_mass = element.number_or("boundmass", self.bound_mass)?;
        self.bound_inertia = element.number_or("boundinertia", self.bound_inertia)?;
        if let Some(total) = element.attribute("settotalmass") {
            // A negative number means that no total mass is set.
            self.total_mass = Some(total.number()?).filter(|total| *total > 0.0);
        }
        Ok(())
    }

    fn option(&mut self, element: &Element) -> Read<()> {
        self.gravity = element.numbers_or("gravity", self.gravity)?;
        for flags in element.each("flag") {
            let acts = &mut self.acts;
            for (name, is_on) in [
                ("spring", &mut acts.spring),
                ("damper", &mut acts.damper),
                ("frictionloss", &mut acts.friction),
                ("limit", &mut acts.limit),
                ("equality", &mut acts.equality),
                ("actuation", &mut acts.actuation),
                ("clampctrl", &mut acts.clamp),
                ("contact", &mut acts.contact),
            ] {
                switch(flags, name, is_on)?;
            }
            let mut passive = true;
            switch(flags, "passive", &mut passive)?;
            let mut constraint = true;
            switch(flags, "constraint", &mut constraint)?;
            let mut gravity = true;
            switch(flags, "gravity", &mut gravity)?;
            if !passive {
                (acts.spring, acts.damper) = (false, false);
            }
            if !constraint {
                (acts.equality, acts.limit, acts.friction) = (false, false, false);
            }
            if !gravity {
                self.gravity = [0.0; 3];
            }
        }
        Ok(())
    }
}

/// Index in `known` of the word that is the value of an attribute.
pub(super) fn word(attribute: &Attribute, known: &[&str]) -> Read<usize> {
    known.iter().position(|word| *word == attribute.value.trim()).ok_or_else(|| {
        attribute.fault(
            format!("`{}` is `{}`", attribute.name, attribute.value),
            format!("it is one of {}", known.join(", ")),
        )
    })
}

fn flag(element: &Element, name: &str, value: &mut bool) -> Read<()> {
    if let Some(attribute) = element.attribute(name) {
        *value = word(attribute, &["false", "true"])? == 1;
    }
    Ok(())
}

fn switch(element: &Element, name: &str, value: &mut bool) -> Read<()> {
    if let Some(attribute) = element.attribute(name) {
        *value = word(attribute, &["disable", "enable"])? == 1;
    }
    Ok(())
}

//! Import of a model: from the bytes of its file to the text of a scene.

use crate::context::Context;
use crate::coordinates::FileCoordinate;
use crate::element::{Attribute, Element};
use crate::findings::{Findings, ModelFinding};
use crate::format::ModelFormat;
use crate::lump::{self, Lumps};
use crate::options::ImportOptions;
use crate::robot::{Frame, GROUND, Kind, Link, Robot, Signal, What};
use crate::source::{Fault, MOST_BYTES, Origin, Read, Sources};
use crate::unread::unread;
use crate::usd::is_usd;
use crate::{gravity, mjcf, motors, sdf, urdf, usd, write, xml};
use mbs_scene::{ReadError, SceneFile};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// A model as a scene, with the findings of the import.
#[derive(Debug, Clone)]
pub struct Imported {
    /// The format of the file.
    pub format: ModelFormat,
    /// The text of the scene, TOML.
    pub text: String,
    /// Findings: elements that the scene does not have exactly as the file does, in the order of the file.
    pub findings: Vec<ModelFinding>,
    /// Sizes of the model: the numbers of its parts.
    pub sizes: ModelSizes,
    /// The coordinates in the order of the file: for MJCF, the order of `qpos` and `qvel`.
    pub coordinates: Vec<FileCoordinate>,
    /// Folder to which the paths in the text are relative.
    folder: Option<PathBuf>,
}

impl Imported {
    /// Parses the text as a scene file. Its name in messages is `scene of` and `file`, since its lines are not those of the model.
    ///
    /// # Errors
    /// The errors of [`SceneFile::parse`].
    pub fn scene_file(&self, file: &str) -> Result<SceneFile, ReadError> {
        let name = format!("scene of {file}");
        match &self.folder {
            Some(folder) => SceneFile::parse_in(&self.text, &name, folder),
            None => SceneFile::parse(&self.text, &name),
        }
    }
}

/// Sizes of a model: the numbers of its parts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ModelSizes {
    /// Number of links in the file.
    pub links: usize,
    /// Number of bodies of the scene. Links that are welded together are one body.
    pub bodies: usize,
    /// Number of joints of the scene.
    pub joints: usize,
    /// Number of couplings of the scene.
    pub couplings: usize,
    /// Number of inputs of the scene.
    pub inputs: usize,
}

/// True if a file is a model rather than a scene. A model begins with `<` (in UTF-8 or UTF-16) after blanks, or is a file of USD.
#[must_use]
pub fn is_model(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match bytes {
        // A file in UTF-16 counts as a model, because the reader of models has an error message for it.
        [0xff, 0xfe, b'<', 0, ..] | [0xfe, 0xff, 0, b'<', ..] => true,
        // A file of USD counts as a model for the same reason.
        _ if is_usd(bytes) => true,
        _ => bytes.iter().find(|byte| !byte.is_ascii_whitespace()) == Some(&b'<'),
    }
}

/// Reads a model and converts it to a scene; `file` is the name in messages.
///
/// # Errors
/// [`ReadError`] with file, line, column and a hint, when the text is not XML, not a model, or a model that cannot be a scene.
///
/// ```
/// use mbs_import::{ImportOptions, import};
/// let urdf = r#"<robot name="stick">
///   <link name="base"/>
///   <link name="rod">
///     <inertial><origin xyz="0 0 -0.5"/><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.01"/></inertial>
///   </link>
///   <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint>
/// </robot>"#;
/// let model = import(urdf.as_bytes(), "stick.urdf", &ImportOptions::default())?;
/// assert!(model.text.contains("kind = \"revolute\""));
/// assert!(model.findings.is_empty());
/// # Ok::<(), mbs_scene::ReadError>(())
/// ```
pub fn import(bytes: &[u8], file: &str, options: &ImportOptions) -> Result<Imported, ReadError> {
    let mut sources = Sources::default();
    if is_usd(bytes) {
        let source = sources.add(file, "", None);
        return Err(sources.error(usd::refusal(source)));
    }
    let text = match core::str::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => {
            let lossy = String::from_utf8_lossy(bytes);
            let source = sources.add(file, &lossy, None);
            let start = u32::try_from(error.valid_up_to()).unwrap_or(u32::MAX);
            let at = Origin { source, start, end: start + 1 };
            return Err(sources.error(Fault::new(at, "not UTF-8 text", "save the file as UTF-8")));
        }
    };
    let source = sources.add(file, text, None);
    let mut context = Context { sources, findings: Findings::default(), options };
    match whole(text, source, file, &mut context) {
        Ok((format, text, sizes, coordinates)) => {
            let Context { sources, findings, .. } = context;
            let folder = options.scene_home().map(Path::to_owned);
            Ok(Imported {
                format,
                text,
                findings: findings.list(&sources),
                sizes,
                coordinates,
                folder,
            })
        }
        Err(fault) => Err(context.sources.error(fault)),
    }
}

fn whole(
    text: &str,
    source: u16,
    file: &str,
    context: &mut Context<'_>,
) -> Read<(ModelFormat, String, ModelSizes, Vec<FileCoordinate>)> {
    if text.len() > MOST_BYTES {
        let message = format!("the file is larger than {} MiB", MOST_BYTES >> 20);
        return Err(Fault::new(
            Origin::start_of(source),
            message,
            "give a model, or a part of it, in a smaller file",
        ));
    }
    let mut root = xml::read(text, source)?;
    let format = format(&root)?;
    fits(format, context.options).map_err(|(message, hint)| root.fault(message, hint))?;
    let (mut robot, table) = match format {
        ModelFormat::Urdf => (urdf::read(root.read(), context)?, urdf::TABLE),
        ModelFormat::Mjcf => {
            mjcf::include(&mut root, context)?;
            mjcf::attach(&mut root, context)?;
            (mjcf::read(root.read(), context)?, mjcf::TABLE)
        }
        ModelFormat::Sdf => {
            sdf::include(&mut root, context)?;
            (sdf::read(root.read(), context)?, sdf::TABLE)
        }
    };
    unread(&root, table, &mut context.findings);
    gravity::part(&mut robot);
    if context.options.motors {
        motors::add(&mut robot, &mut context.findings)?;
    }
    let lumps = lump::lumps(&robot, context.options, &mut context.findings)?;
    frames_of_links(&mut robot);
    let sizes = sizes(&robot, &lumps);
    let notes = std::mem::take(&mut robot.notes);
    robot.notes = vec![format!("{} model, from {file}.", format.name())];
    robot.notes.extend(notes);
    robot.notes.push("Duration: 1 s, a choice.".into());
    let coordinates = std::mem::take(&mut robot.coordinates);
    Ok((format, write::scene(&robot, &lumps), sizes, coordinates))
}

/// Checks that the format supports the given options. The error has a message and a hint.
fn fits(format: ModelFormat, options: &ImportOptions) -> Result<(), (String, String)> {
    let given = [
        ("base", options.base.is_some()),
        ("key", options.key.is_some()),
        ("keep_fixed", !options.keep_fixed.is_empty()),
    ];
    let (name, known) = (format.name(), format.options());
    match given.iter().find(|(option, is_given)| *is_given && !known.contains(option)) {
        None => Ok(()),
        Some((option, _)) => {
            let message = format!("`{option}` is no option of a file in {name}");
            Err((message, format!("leave it out; options of {name}: {}", known.join(", "))))
        }
    }
}

/// The format of a model, from its bytes.
///
/// # Errors
/// The errors of [`import`] for a text that is not XML or not a model.
pub fn model_format(bytes: &[u8], file: &str) -> Result<ModelFormat, ReadError> {
    let mut sources = Sources::default();
    let text = String::from_utf8_lossy(bytes);
    let source = sources.add(file, &text, None);
    let found = xml::read(&text, source).and_then(|root| format(&root));
    found.map_err(|fault| sources.error(fault))
}

/// The format of a model, from its root element.
fn format(root: &Element) -> Read<ModelFormat> {
    if root.children.iter().any(|child| child.name.starts_with("xacro:")) {
        let message = "a file of macros: it has elements `xacro:...`";
        return Err(root.fault(message, "run xacro first, and give the file that it writes"));
    }
    match root.name.as_str() {
        "robot" => match first_macro(root) {
            None => Ok(ModelFormat::Urdf),
            Some(attribute) => Err(attribute.fault(
                format!("`{}` is a macro", attribute.value),
                "run xacro first, and give the file that it writes",
            )),
        },
        "mujoco" => Ok(ModelFormat::Mjcf),
        "sdf" => Ok(ModelFormat::Sdf),
        "mujocoinclude" => Err(root.fault(
            "a fragment of a model, which other files include",
            "give the file that includes it",
        )),
        other => Err(root.fault(
            format!("the root element is `{other}`"),
            "a model begins with `robot` (URDF), `mujoco` (MJCF) or `sdf` (SDF)",
        )),
    }
}

/// The first attribute whose value has a macro `${...}`.
fn first_macro(root: &Element) -> Option<&Attribute> {
    let mut rest = vec![root];
    while let Some(element) = rest.pop() {
        let found = element.attributes.iter().find(|attribute| attribute.value.contains("${"));
        if found.is_some() {
            return found;
        }
        rest.extend(element.children.iter().rev());
    }
    None
}

/// Adds a frame of the scene for every link, with the link's axes.
fn frames_of_links(robot: &mut Robot) {
    let mut names: HashSet<String> = robot.frames.iter().map(|frame| frame.name.clone()).collect();
    for (link, Link { name, pose, .. }) in robot.links.iter().enumerate() {
        if link != GROUND && names.insert(name.clone()) {
            robot.frames.push(Frame { name: name.clone(), link, pose: *pose });
        }
    }
}

fn sizes(robot: &Robot, lumps: &Lumps) -> ModelSizes {
    let is_input =
        |what: &What| matches!(what, What::Input { .. } | What::Signal(Signal::Set { .. }));
    ModelSizes {
        links: robot.links.len() - 1,
        bodies: lumps.lumps.len() - 1,
        joints: robot.joints.iter().filter(|joint| joint.kind != Kind::Fixed).count(),
        couplings: robot.couplings.len(),
        inputs: robot.laws.iter().filter(|law| is_input(&law.what)).count(),
    }
}

//! The scene that a file describes, read table by table; and the places of its entries.

use crate::keys::{self, FILE};
use crate::read::document::SceneFile;
use crate::read::fields::{Context, Fields, Frames, Read};
use crate::read::names::Names;
use crate::read::tree::{Item, Member, Node};
use crate::read::values::Values;
use crate::read::{
    Place, ReadError, ReadFault, body, coupling, effect, frame, joint, motion, output, road,
    rolling, shape, signal, solver,
};
use mbs_core::Real;
use mbs_core::scene::{
    Body, BodyId, Dimension, Entry, Guide, Joint, Number, Scene, SceneError, SceneFault,
    SolverTable, Start, signal_order,
};
use std::collections::BTreeMap;

/// All joints of a file, then those of its guided bodies; and the guides.
type JointsAndGuides = (Vec<Joint<Number>>, Vec<Guide<Number>>);

impl SceneFile {
    /// The scene in the scalar `T`, checked. Every number is the number of `T` nearest to its decimal text.
    ///
    /// # Errors
    /// The first entry in the file that is unknown, missing or not valid, with its place.
    pub fn scene<T: Real>(&self) -> Result<Scene<T>, ReadError> {
        self.numbers()?.resolve().map_err(|error| self.meaning(error))
    }

    /// The scene with its numbers as decimal text, not checked. [`Scene::resolve`] checks it in a scalar.
    ///
    /// # Errors
    /// The first entry in the file that is unknown, missing or of the wrong type, with its place.
    pub fn numbers(&self) -> Result<Scene<Number>, ReadError> {
        self.read_with(&Values::new(&self.texts, &self.root)?)
    }

    /// The parameters of the file itself that no expression uses. The list is empty when the file is not valid.
    #[must_use]
    pub fn unused_parameters(&self) -> Vec<String> {
        let Ok(values) = Values::new(&self.texts, &self.root) else { return Vec::new() };
        match self.read_with(&values) {
            Ok(_) => values.unused(),
            Err(_) => Vec::new(),
        }
    }

    fn read_with<'a>(&'a self, values: &'a Values<'a>) -> Read<Scene<Number>> {
        let [bodies, joints, signals, frames] =
            ["body", "joint", "signal", "frame"].map(|table| self.names(table));
        let joints = Names::new([joints.list(), &self.guided_bodies()?].concat());
        let context = Context {
            values,
            texts: &self.texts,
            // The dimension is not known yet; nothing that depends on it is read before.
            dimension: Dimension::Planar,
            bodies: &bodies,
            joints: &joints,
            signals: &signals,
            frames: Frames { names: &frames, items: self.listed("frame") },
            unit: None,
            is_slide: None,
        };
        self.check_tables(&context)?;
        self.check_points(&context)?;
        self.refuse_shared_names([&bodies, &joints, &signals, &frames])?;
        let Some(item) = self.top("scene") else {
            return context.fault(&(0..0), ReadFault::Missing { key: "[scene]" });
        };
        let dimension = read_dimension(&context.table(item, "a table: [scene]", "scene")?)?;
        let context = Context { dimension, ..context };
        let header = context.table(item, "a table: [scene]", "scene")?;
        let body_data = self.entries(&context, "body", |_, fields| body::read(fields))?;
        let centers: Vec<[Number; 3]> = body_data.iter().map(|body| body.center.clone()).collect();
        let (joints, guides) = self.joints_and_guides(&context, &body_data)?;
        let couplings =
            self.entries(&context, "coupling", |i, fields| coupling::read(i, fields, &joints))?;
        let rollings = self.entries(&context, "rolling", |i, fields| rolling::read(i, fields))?;
        let effects =
            self.entries(&context, "effect", |i, fields| effect::read(i, fields, &joints))?;
        let of_couplings = Names::new(couplings.iter().map(|x| x.name.clone()).collect());
        let of_rollings = Names::new(rollings.iter().map(|x| x.name.clone()).collect());
        let of_effects = Names::new(effects.iter().map(|x| x.name.clone()).collect());
        let road = |item| road::read(&context.table(item, "a table: [road]", "road")?);
        let scene = Scene {
            name: self.scene_name(&header)?,
            dimension,
            gravity: header.optional_vector("gravity")?,
            duration: header.number("duration")?,
            bodies: body_data,
            initials: self
                .entries(&context, "initial", |_, fields| motion::read_initial(fields, &joints))?,
            guides,
            couplings,
            rollings,
            signals: self.entries(&context, "signal", |_, fields| signal::read(fields, &joints))?,
            joints,
            road: self.top("road").map(road).transpose()?.unwrap_or_default(),
            start: read_start(&header)?,
            frames: self.entries(&context, "frame", |_, fields| frame::read(fields))?,
            shapes: self.entries(&context, "shape", |i, fields| shape::read(i, fields))?,
            effects,
            outputs: self.entries(&context, "output", |_, fields| {
                output::read(fields, &centers, [&of_couplings, &of_rollings, &of_effects])
            })?,
            solver: self.solver(&context)?,
        };
        with_asked(&header, scene)
    }

    fn solver(&self, context: &Context<'_>) -> Read<SolverTable<Number>> {
        self.top("solver").map_or(Ok(SolverTable::default()), |item| solver::read(context, item))
    }

    /// All joints of a file, then those of its guided bodies; and the guides.
    fn joints_and_guides(
        &self,
        context: &Context<'_>,
        bodies: &[Body<Number>],
    ) -> Read<JointsAndGuides> {
        let mut joints = self.entries(context, "joint", |_, fields| joint::read(fields, bodies))?;
        let of_bodies = |_, fields: &_| joint::read_of_guided_body(fields, bodies);
        joints.extend(self.entries(context, "guide", of_bodies)?.into_iter().flatten());
        let guides = |_, fields: &_| motion::read_guides(fields, &joints);
        let guides = self.entries(context, "guide", guides)?.concat();
        Ok((joints, guides))
    }

    /// The file, and the place of a key's value. For a key that is not written it is the entry's header, or else the start of the file.
    #[must_use]
    pub fn place(&self, entry: Entry, field: &str) -> (&str, Place) {
        self.texts.place(self.item(entry, field).map_or(&(0..0), |item| &item.span))
    }

    /// A key's value, or the whole entry when the key is not written.
    fn item<'a>(&'a self, entry: Entry, field: &str) -> Option<&'a Item> {
        let entries = |table: &str, i: usize| self.listed(table).get(i);
        let road = |track: &str, i| road::item_of(self.top("road")?, track, i);
        let item = match entry {
            Entry::Scene => self.top("scene"),
            Entry::Solver => self.top("solver"),
            Entry::Road => self.top("road"),
            Entry::RoadLeft(i) => road("left", i),
            Entry::RoadRight(i) => road("right", i),
            Entry::Body(i) => entries("body", i),
            Entry::Joint(i) => return self.item_of_joint(i, field),
            Entry::Initial(i) => entries("initial", i),
            Entry::Guide(i) => return self.item_of_guide(i, field),
            Entry::Coupling(i) => entries("coupling", i),
            Entry::Rolling(i) => entries("rolling", i),
            Entry::Signal(i) => entries("signal", i),
            Entry::Frame(i) => entries("frame", i),
            Entry::Shape(i) => entries("shape", i),
            Entry::Effect(i) => entries("effect", i),
            Entry::Output(i) => entries("output", i),
        };
        let of_key = |members: &'a [Member], key: &str| members.iter().find(|m| m.key == key);
        // A key that the effect does not have may be in one of its terms.
        let is_of_term = matches!(entry, Entry::Effect(_))
            && keys::of("term").iter().any(|table| table.key(field).is_some());
        let value = |members: &'a [Member]| {
            let terms = || of_key(members, "terms").filter(|_| is_of_term);
            of_key(members, field).or_else(terms)
        };
        match &item?.node {
            Node::Table(members) => value(members).map(|m| &m.item).or(item),
            _ => item,
        }
    }

    /// Names of the entries of a list. A name that is not a text is empty here, and refused when the entry is read.
    fn names(&self, key: &str) -> Names {
        let items = self.listed(key);
        let name = |item: &Item| item.text_at("name").unwrap_or_default().to_owned();
        Names::new(items.iter().map(name).collect())
    }

    /// Refuses bodies, joints, signals or frames that share a name with another of their kind. The check comes before references are read:
    /// otherwise a repeated name would be reported as unknown.
    fn refuse_shared_names(&self, [bodies, joints, signals, frames]: [&Names; 4]) -> Read<()> {
        if let Some(i) = bodies.place("ground") {
            let (entry, fault) = (Entry::Body(i), SceneFault::ReservedName);
            return Err(self.meaning(SceneError { entry, field: "name", fault }));
        }
        self.refuse_duplicates(bodies.list(), Entry::Body)?;
        self.refuse_duplicates(joints.list(), Entry::Joint)?;
        self.refuse_duplicates(signals.list(), Entry::Signal)?;
        self.refuse_duplicates(frames.list(), Entry::Frame)
    }

    fn refuse_duplicates(&self, names: &[String], entry: fn(usize) -> Entry) -> Read<()> {
        let mut seen = BTreeMap::new();
        for (i, name) in names.iter().enumerate().filter(|(_, name)| !name.is_empty()) {
            if let Some(first) = seen.insert(name, i) {
                let fault = SceneFault::DuplicateName(first);
                return Err(self.meaning(SceneError { entry: entry(i), field: "name", fault }));
            }
        }
        Ok(())
    }

    /// The error for a fault of the scene, with its place in the file.
    ///
    /// The function also serves scenes that were changed after reading (by a command line) and then checked.
    #[must_use]
    pub fn meaning(&self, error: SceneError) -> ReadError {
        let item = self.item(error.entry, error.field);
        let row = match (item, row(error.fault)) {
            (Some(Item { node: Node::List(rows), .. }), Some(i)) => rows.get(i),
            _ => None,
        };
        let fault = self.fault(error);
        self.error(row.or(item).map_or(&(0..0), |item| &item.span), fault)
    }

    /// The fault, with the names of the signals or of the body that it refers to.
    fn fault(&self, error: SceneError) -> ReadFault {
        let named = match error.fault {
            SceneFault::GivenTwice(first) if matches!(error.entry, Entry::Guide(_)) => {
                let entry = self.entry_of_guide(first).map_or(first, |(entry, _)| entry);
                let fault = SceneFault::GivenTwice(entry);
                return ReadFault::Scene(SceneError { fault, ..error });
            }
            SceneFault::SignalNotSmooth { broken, remedy } => {
                let name = self.name("signal", broken.signal.index());
                name.map(|name| ReadFault::SignalNotSmooth { name, broken, remedy })
            }
            SceneFault::SignalCircle => {
                let signals = self.numbers().map(|scene| scene.signals).unwrap_or_default();
                let circle = signal_order(&signals).err().unwrap_or_default().into_iter();
                let names = circle.filter_map(|i| self.name("signal", i)).collect();
                Some(ReadFault::SignalCircle { names })
            }
            SceneFault::PointTurns(body) | SceneFault::OffPoint { body, .. } => {
                let name = self.name("body", body);
                name.map(|name| ReadFault::OfPoint { name, fault: error.fault })
            }
            SceneFault::NoCarrier { bodies, about } => {
                let body = |body: BodyId| match body.index() {
                    None => Some("ground".to_owned()),
                    Some(body) => self.name("body", body),
                };
                let joint = self.name("joint", about);
                let bodies = [body(bodies[0]), body(bodies[1])];
                match (bodies, joint) {
                    ([Some(one), Some(other)], Some(joint)) => {
                        Some(ReadFault::NoCarrier { bodies: [one, other], joint })
                    }
                    _ => None,
                }
            }
            _ => None,
        };
        named.unwrap_or(ReadFault::Scene(error))
    }

    /// The name of entry `i` of a table.
    fn name(&self, table: &str, i: usize) -> Option<String> {
        self.names(table).list().get(i).cloned()
    }

    pub(crate) fn entries<'a, R>(
        &'a self,
        context: &Context<'a>,
        key: &'static str,
        read: impl Fn(usize, &Fields<'a>) -> Read<R>,
    ) -> Read<Vec<R>> {
        let Some(item) = self.top(key) else { return Ok(Vec::new()) };
        context
            .list(item, "a list of tables, each under a header in double brackets like [[body]]")?
            .iter()
            .enumerate()
            .map(|(i, item)| read(i, &context.table(item, "a table", key)?))
            .collect()
    }

    /// Checks that points have unique names, and that each has a place. The places are read with the values.
    fn check_points(&self, context: &Context<'_>) -> Read<()> {
        let names = self.entries(context, "point", |_, fields| {
            fields.need("at")?;
            let span = &fields.need("name")?.span;
            Ok((fields.name()?, span))
        })?;
        let mut seen = BTreeMap::new();
        for (i, (name, span)) in names.iter().enumerate() {
            if let Some(first) = seen.insert(name, i) {
                let name = name.clone();
                return context.fault(span, ReadFault::SamePoint { name, first });
            }
        }
        Ok(())
    }

    fn check_tables(&self, context: &Context<'_>) -> Read<()> {
        let (members, tables) = (&self.root[..], keys::of(FILE));
        Fields { context: *context, header: &(0..0), members, tables }.checked().map(|_| ())
    }

    /// The name in the file, or the file's name without folder and extension.
    fn scene_name(&self, header: &Fields<'_>) -> Read<String> {
        if header.get("name").is_some() {
            return header.name();
        }
        let file = self.file().rsplit(['/', '\\']).next().unwrap_or_default();
        let ending = [".toml", ".json"].iter().find_map(|ending| file.strip_suffix(ending));
        Ok(ending.unwrap_or(file).to_owned())
    }
}

fn read_dimension(header: &Fields<'_>) -> Read<Dimension> {
    let item = header.need("dimension")?;
    match &item.node {
        Node::Number(text) if text == "2" => Ok(Dimension::Planar),
        Node::Number(text) if text == "3" => Ok(Dimension::Spatial),
        Node::Number(text) => header.unknown_word("dimension", (text, &item.span), &["2", "3"]),
        _ => header.number("dimension").map(|_| Dimension::Planar),
    }
}

/// The scene with the outputs of all joints and effects, if its header requests them.
fn with_asked(header: &Fields<'_>, mut scene: Scene<Number>) -> Read<Scene<Number>> {
    if header.get("outputs").is_none() {
        return Ok(scene);
    }
    match header.word("outputs")? {
        ("all", _) => {
            scene.show_all();
            Ok(scene)
        }
        word => header.unknown_word("outputs", word, &["all"]),
    }
}

fn read_start(header: &Fields<'_>) -> Read<Start> {
    if header.get("start").is_none() {
        return Ok(Start::Initial);
    }
    match header.word("start")? {
        ("initial", _) => Ok(Start::Initial),
        ("equilibrium", _) => Ok(Start::Equilibrium),
        ("equilibrium-near", _) => Ok(Start::EquilibriumNear),
        word => header.unknown_word("start", word, &["initial", "equilibrium", "equilibrium-near"]),
    }
}

/// The row of a table, or the piece of a polynomial, to which a fault refers.
fn row(fault: SceneFault) -> Option<usize> {
    match fault {
        SceneFault::TableOrder(row)
        | SceneFault::TableSlope { row, .. }
        | SceneFault::PointOrder(row)
        | SceneFault::PieceRange(row)
        | SceneFault::PieceGap(row)
        | SceneFault::PieceCoefficients { piece: row, .. } => Some(row),
        _ => None,
    }
}

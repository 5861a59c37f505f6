//! Finding of the doctor, with its severity and topic.

use mbs_core::scene::{Entry, Scene};

mbs_core::named! {
    /// Severity of a finding.
    pub enum Severity {
        /// Information: nothing is wrong.
        Note = "note",
        /// Possible mistake, or an effect of rounding; the scene runs.
        Doubt = "doubt",
        /// Fault: the scene has no start, or its run stops.
        Fault = "fault",
    }
}

mbs_core::named! {
    /// Subject of a finding, in the order of the report.
    pub enum Topic {
        /// Rank and freedoms.
        Rank = "rank",
        /// Dependent sets of constraints.
        Dependence = "dependence",
        /// Branches and singular positions.
        Motion = "motion",
        /// Masses and inertias.
        Masses = "masses",
        /// Units.
        Units = "units",
        /// Places.
        Places = "places",
        /// The start.
        Start = "start",
        /// The text of the file.
        File = "file",
    }
}

/// Finding with all joints and bodies that it concerns.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Severity of the finding.
    pub severity: Severity,
    /// Code of the finding: a short word for programs, which does not change.
    pub code: &'static str,
    /// Topic of the finding.
    pub topic: Topic,
    /// Message about the finding, in one or two sentences.
    pub message: String,
    /// Remedy for the finding; may be empty for a note.
    pub remedy: String,
    /// Joints, by their indices.
    pub joints: Vec<usize>,
    /// Bodies, by their indices.
    pub bodies: Vec<usize>,
    /// Place in the scene: the entry and its key.
    pub place: Option<(Entry, &'static str)>,
}

impl Finding {
    /// Makes a finding without joints, bodies and place.
    pub(super) fn new(
        severity: Severity,
        (topic, code): (Topic, &'static str),
        message: String,
        remedy: impl Into<String>,
    ) -> Self {
        Self {
            severity,
            code,
            topic,
            message,
            remedy: remedy.into(),
            joints: Vec::new(),
            bodies: Vec::new(),
            place: None,
        }
    }

    /// Sets the joints that the finding concerns. The first joint becomes the place of the finding, unless a place is set.
    pub(super) fn joints(mut self, joints: Vec<usize>) -> Self {
        self.place = self.place.or(joints.first().map(|&j| (Entry::Joint(j), "name")));
        self.joints = joints;
        self
    }

    /// Sets the bodies that the finding concerns. The first body becomes the place of the finding, unless a place is set.
    pub(super) fn bodies(mut self, bodies: Vec<usize>) -> Self {
        self.place = self.place.or(bodies.first().map(|&b| (Entry::Body(b), "name")));
        self.bodies = bodies;
        self
    }

    /// Sets the place of the finding.
    pub(super) fn at(mut self, entry: Entry, key: &'static str) -> Self {
        self.place = Some((entry, key));
        self
    }
}

/// Names of all given joints, in quotes.
pub(super) fn joint_names(scene: &Scene<f64>, joints: &[usize]) -> String {
    quoted(joints.iter().map(|&j| scene.joints[j].name.as_str()))
}

/// Names of all given bodies, in quotes.
pub(super) fn body_names(scene: &Scene<f64>, bodies: &[usize]) -> String {
    quoted(bodies.iter().map(|&b| scene.bodies[b].name.as_str()))
}

fn quoted<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

//! One thing that was found.

use mbs_core::scene::{Entry, Scene};

mbs_core::named! {
    /// Severity of a finding.
    pub enum Severity {
        /// Worth knowing: nothing is wrong with it.
        Note = "note",
        /// Perhaps not what was meant, or a matter of rounding; the scene runs.
        Doubt = "doubt",
        /// The scene has no start, or its run stops.
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

/// One thing that was found, with all joints and bodies it is about.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Severity of the finding.
    pub severity: Severity,
    /// A short fixed word for programs.
    pub code: &'static str,
    /// Topic of the finding.
    pub topic: Topic,
    /// Message: what was found, in one or two sentences.
    pub message: String,
    /// Remedy that would mend it; may be empty for a note.
    pub remedy: String,
    /// Joints, by their indices.
    pub joints: Vec<usize>,
    /// Bodies, by their indices.
    pub bodies: Vec<usize>,
    /// Place in the scene: the entry and its key.
    pub place: Option<(Entry, &'static str)>,
}

impl Finding {
    /// A finding without joints, bodies and place.
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

    /// Sets the joints that the finding is about; its place is the first of them.
    pub(super) fn joints(mut self, joints: Vec<usize>) -> Self {
        self.place = self.place.or(joints.first().map(|&j| (Entry::Joint(j), "name")));
        self.joints = joints;
        self
    }

    /// Sets the bodies that the finding is about; its place is the first of them.
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

/// Names of joints in quotes: all of them.
pub(super) fn joint_names(scene: &Scene<f64>, joints: &[usize]) -> String {
    quoted(joints.iter().map(|&j| scene.joints[j].name.as_str()))
}

/// Names of bodies in quotes: all of them.
pub(super) fn body_names(scene: &Scene<f64>, bodies: &[usize]) -> String {
    quoted(bodies.iter().map(|&b| scene.bodies[b].name.as_str()))
}

fn quoted<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

//! Report on an imported model: how the scene represents its elements, and whether the scene has a start.

use crate::doctor::{Effort, Finding, Severity, examine};
use mbs::models::{FindingKind, Imported, ModelFinding, ModelSizes};
use mbs::{Method, Precision, ResolvedMethod, SimulationError};
use serde_json::{Value, json};

/// Fault of the start that the doctor found, with its line in the scene.
#[derive(Debug, Clone)]
pub struct StartFault {
    /// Finding of the doctor.
    pub finding: Finding,
    /// Line of the finding in the scene, if it has one.
    pub line: Option<usize>,
}

/// Largest number of joints of a model with loops that the doctor examines [-]. The time of the examination grows with the cube of this number.
/// With 200 joints it is about a second.
const MOST_JOINTS: usize = 200;

/// Finds faults that keep the scene of a model from starting. A model without closed loops has no such fault if all of its branches have
/// inertia. `None` means that a large model was not examined. `name` is the file name in messages.
///
/// # Errors
/// [`SimulationError`] for a scene that is refused.
pub fn start_faults(
    name: &str,
    model: &Imported,
) -> Result<Option<Vec<StartFault>>, SimulationError> {
    let document = model.scene_file(name)?;
    let scene = document.scene::<f64>()?;
    let tree = mbs::Tree::new(&scene);
    let has_start =
        |mut tree: mbs::Tree| tree.inertia_fault().is_none() && tree.loop_jacobian().rows == 0;
    if tree.is_ok_and(has_start) {
        return Ok(Some(Vec::new()));
    }
    if model.sizes.joints > MOST_JOINTS {
        return Ok(None);
    }
    let overrides =
        Method { precision: Some(Precision::F64.name().to_owned()), ..Method::default() };
    let settings = ResolvedMethod::new(&scene, &overrides)?;
    let effort = Effort { positions: 0, ..Effort::default() };
    let found = examine(&scene, &settings, &effort).findings.into_iter();
    let found = found.filter(|finding| finding.severity == Severity::Fault).map(|finding| {
        let line = finding.place.map(|(entry, key)| document.place(entry, key).1.line);
        StartFault { finding, line }
    });
    Ok(Some(found.collect()))
}

/// Returns the number of findings of a kind.
#[must_use]
pub fn count(model: &Imported, kind: FindingKind) -> usize {
    model.findings.iter().filter(|finding| finding.kind == kind).count()
}

/// Makes the object of `mbs import --json`: elements that were read, elements that the scene represents otherwise, and faults of the start.
/// The faults are null if the start was not examined.
#[must_use]
pub fn to_json(name: &str, model: &Imported, faults: Option<&[StartFault]>) -> Value {
    let list = |kind| {
        let found = model.findings.iter().filter(|finding| finding.kind == kind);
        let found = found.map(|ModelFinding { file, line, column, element, says, .. }| {
            json!({ "file": file, "line": line, "column": column, "element": element, "says": says })
        });
        found.collect::<Vec<_>>()
    };
    let object = |StartFault { finding, line }: &StartFault| {
        let Finding { code, message, remedy, .. } = finding;
        json!({ "code": code, "message": message, "remedy": remedy, "line": line })
    };
    let faults = faults.map(|faults| faults.iter().map(object).collect::<Vec<_>>());
    let ModelSizes { links, bodies, joints, couplings, inputs } = model.sizes;
    json!({
        "file": name,
        "format": model.format.name(),
        "mapped": { "links": links, "bodies": bodies, "joints": joints, "couplings": couplings, "inputs": inputs },
        "approximated": list(FindingKind::Approximated),
        "ignored": list(FindingKind::Ignored),
        "noted": list(FindingKind::Noted),
        "appearance": count(model, FindingKind::Appearance),
        "faults": faults,
    })
}

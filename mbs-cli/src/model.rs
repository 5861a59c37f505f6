//! What a model of another program is, in a line.

use mbs::models::{FindingKind, Imported, ModelSizes};
use mbs::scene_file::format::counted;

/// A line of a model that stands where a scene is wanted.
pub(crate) fn note(name: &str, model: &Imported) -> String {
    let [approximated, ignored] =
        [FindingKind::Approximated, FindingKind::Ignored].map(|kind| count(model, kind));
    format!(
        "{}; {approximated} approximated, {ignored} ignored: mbs import {name} lists them",
        first_line(name, model)
    )
}

/// How many findings are of a kind.
pub(crate) fn count(model: &Imported, kind: FindingKind) -> usize {
    model.findings.iter().filter(|finding| finding.kind == kind).count()
}

/// What the scene has.
pub(crate) fn first_line(name: &str, model: &Imported) -> String {
    let ModelSizes { links, bodies, joints, couplings, inputs } = model.sizes;
    let bodies = if bodies == 1 { "1 body".to_owned() } else { format!("{bodies} bodies") };
    format!(
        "{name}: {}, {bodies} of {}, {}, {}, {}",
        model.format.name(),
        counted(links, "link"),
        counted(joints, "joint"),
        counted(couplings, "coupling"),
        counted(inputs, "input"),
    )
}

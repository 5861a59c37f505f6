//! Growth of an image by the feature of each effect, and by the feature of all machine elements: flash, static data, stack.

use super::board::{M7, build, emulate, export};
use super::form::Form;
use super::image::Image;
use super::panics::no_panics;
use super::run_report::RunReport;
use super::toolchain::Toolchain;
use crate::effects::{self, Listed};
use std::path::Path;

/// Modules of the law of tires, which no other effect uses.
const OF_TIRES: [&str; 5] =
    ["4laws4tire", "4laws12road_contact", "4laws7calspan", "4laws4road", "4laws7feature"];

/// Modules of rotations in space, which only bushings use.
const OF_BUSHINGS: [&str; 2] = ["5loads8rotation", "10overturned"];

/// Feature of all machine elements, and their modules.
const OF_ELEMENTS: (&str, [&str; 5]) =
    ("elements", ["12coupled_rows", "13coupled_lines", "8feedback", "5loads3sum", "7rolling"]);

/// Features that add code, each with the mangled names of its modules. An image without the feature must not contain these modules.
fn features() -> Vec<(&'static str, Vec<String>)> {
    let exported = effects::all().filter(|listed| listed.is_exported());
    let named = exported.filter_map(|Listed { module, feature, .. }| {
        let mut modules = vec![format!("7effects{}{module}", module.len())];
        match module {
            "tire" => modules.extend(OF_TIRES.map(str::to_owned)),
            "bushing" => modules.extend(OF_BUSHINGS.map(str::to_owned)),
            "polynomial" => modules.push("4laws10polynomial".to_owned()),
            _ => {}
        }
        Some((feature?, modules))
    });
    let (elements, modules) = OF_ELEMENTS;
    named.chain([(elements, modules.map(str::to_owned).to_vec())]).collect()
}

/// Builds a scene without effects: without features, with all features, and in the long form with each feature alone. Returns a line for
/// each image.
///
/// # Errors
///
/// A feature that adds nothing, or whose code is in an image without the feature.
pub(super) fn check(
    (toolchain, lld): (Toolchain, Option<&Path>),
    models: &Path,
    form: Form,
) -> Result<Vec<String>, String> {
    let model = export("six-joint-arm", "f32", models)?;
    let all: Vec<&str> = features().into_iter().map(|(feature, _)| feature).collect();
    let mut sets = vec![String::new()];
    if form == Form::Whole {
        sets.extend(all.iter().map(|&feature| feature.to_owned()));
    }
    sets.push(all.join(","));
    let (mut lines, mut sizes) = (Vec::new(), Vec::new());
    for set in &sets {
        let (elf, image) = build((toolchain, lld), &M7, set, &model)?;
        without_others(&image.names(&elf)?, set)?;
        no_panics(&elf, (M7.cpu, "mbs_step"), &format!("six-joint-arm [{set}]"))?;
        let report = RunReport::read(&emulate(&M7, &elf)?)?;
        let Image { flash, ram } = image;
        lines.push(format!(
            "six-joint-arm [{set}]: flash {flash}, static data {ram}, stack {}",
            report.stack
        ));
        eprintln!("   {}", lines[lines.len() - 1]);
        sizes.push(flash);
    }
    let (none, whole) = (sizes[0], sizes[sizes.len() - 1]);
    for (set, &flash) in sets.iter().zip(&sizes).skip(1) {
        if flash <= none {
            return Err(format!("the feature `{set}` adds nothing to an image of {none} bytes"));
        }
        if flash > whole {
            return Err(format!("an image with `{set}` alone is larger than with all features"));
        }
    }
    Ok(lines)
}

/// Checks that an image has no code of features that are off. It also checks that the search finds the code of features that are on.
fn without_others(names: &str, set: &str) -> Result<(), String> {
    for (feature, modules) in features() {
        let is_on = set.split(',').any(|on| on == feature);
        let found = modules.iter().find(|module| names.contains(module.as_str()));
        if let (false, Some(module)) = (is_on, found) {
            return Err(format!("an image without the feature `{feature}` has code of `{module}`"));
        }
    }
    let (elements, of_elements) = (OF_ELEMENTS.0, &OF_ELEMENTS.1[..]);
    for (on, modules) in
        [("tire", &OF_TIRES[..]), ("bushing", &OF_BUSHINGS[..]), (elements, of_elements)]
    {
        if set.contains(on) && !modules.iter().any(|module| names.contains(module)) {
            return Err(format!(
                "no function of `{on}` is found where it is: the search finds nothing"
            ));
        }
    }
    Ok(())
}

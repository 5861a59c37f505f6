//! Writes docs/SCENES.md: the key tables as Markdown.

use super::groups::{entries, groups};
use crate::keys::{Base, Key, KeyTable, Standing};
use mbs_core::scene::Dimension;
use std::fmt::Write;

/// The manual as Markdown.
#[must_use]
pub fn markdown() -> String {
    let mut text = include_str!("head.md").to_owned();
    for group in groups() {
        of_group(&mut text, group);
    }
    let bases = [
        ("planar", Base::PlanarBodies, Base::Planar),
        ("spatial", Base::SpatialBodies, Base::Spatial),
    ];
    text += "\n## The scenes of the examples\n\nExamples of joints are added to the bodies alone, all others to the bodies with joints.\n";
    for (name, _, whole) in bases {
        let _ = write!(text, "\nThe {name} one:\n\n```toml\n{}\n```\n", whole.text().trim_end());
    }
    text
}

fn of_group(text: &mut String, group: &'static [KeyTable]) {
    let first = &group[0];
    let title = first.title();
    let _ = match first.standing {
        Standing::Inside => write!(text, "\n## Table `{title}`\n"),
        _ => write!(text, "\n## `{title}`\n"),
    };
    for entry in entries(group) {
        if let Some(kind) = entry[0].kind {
            let _ = write!(text, "\n### {} `{kind}`\n", first.header);
        }
        for table in entry {
            of_table(text, table);
        }
    }
}

fn of_table(text: &mut String, table: &KeyTable) {
    let meaning = table.meaning.replace('|', "\\|");
    let _ = write!(
        text,
        "\n{meaning}\n\n| key | value | unit | default | meaning |\n|---|---|---|---|---|\n"
    );
    for key in &table.keys {
        let _ = writeln!(text, "{}", row(key));
    }
    if let Some(example) = &table.example {
        let _ = write!(text, "\n```toml\n{}\n```\n", example.text.trim_end());
    }
}

fn row(key: &Key) -> String {
    let scenes = match key.dimension {
        None => "",
        Some(Dimension::Planar) => "; in the plane",
        Some(Dimension::Spatial) => "; in space",
    };
    let default = if key.is_needed { "needed" } else { key.default.as_str() };
    let (form, meaning) = (key.value.form(), &key.meaning);
    format!("| `{}` | {form}{scenes} | {} | {default} | {meaning} |", key.name, key.unit)
}

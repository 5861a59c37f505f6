//! Table of quantities: its rows are consistent, and docs/OUTPUTS.md is written from the table.

use crate::document::written;
use mbs_core::outputs::{ComponentForm, QUANTITIES, QuantityRow, TargetKind};
use std::fmt::Write;

const DOCUMENT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/OUTPUTS.md");
/// Marks around the written part of the document.
const MARKS: [&str; 2] = ["<!-- quantities:begin -->\n", "<!-- quantities:end -->\n"];

/// Headings of the targets, in the order of the document.
const HEADINGS: [(TargetKind, &str); 11] = [
    (TargetKind::Point, "Of a point of a body"),
    (TargetKind::RelativePoint, "Of a point, seen from another body"),
    (TargetKind::Body, "Of a body"),
    (TargetKind::RelativeBody, "Of a body, seen from another one"),
    (TargetKind::WheelCarrier, "Of the carrier of a wheel, seen from the vehicle body"),
    (TargetKind::Joint, "Of a joint"),
    (TargetKind::Coupling, "Of a coupling"),
    (TargetKind::Rolling, "Of what rolls"),
    (TargetKind::Effect, "Of an effect"),
    (TargetKind::Signal, "Of a signal"),
    (TargetKind::Scene, "Of the whole scene"),
];

#[test]
fn every_quantity_has_a_formula_and_a_sign() {
    for row in QUANTITIES {
        let definition = &row.definition;
        for text in [definition.formula, definition.axes, definition.sign] {
            assert!(!text.is_empty() && !text.ends_with('.'), "{}: `{text}`", row.name);
        }
        let contents = definition.contents;
        assert!(contents.is_empty() || contents.ends_with('.'), "{}: `{contents}`", row.name);
    }
}

/// Writes the tables of docs/OUTPUTS.md if MBS_WRITE_DOCS is set.
#[test]
fn the_document_has_every_quantity_of_the_table() {
    let text = std::fs::read_to_string(DOCUMENT).expect("the document");
    let [start, end] = MARKS.map(|mark| text.find(mark).expect("a mark"));
    let start = start + MARKS[0].len();
    let expected = format!("{}{}{}", &text[..start], tables(), &text[end..]);
    written(DOCUMENT, (&text, &expected));
}

/// Tables of quantities, one for each kind of target.
fn tables() -> String {
    let mut text = String::new();
    for (target, heading) in HEADINGS {
        let keys: Vec<_> = target.keys().iter().map(|key| format!("`{key}`")).collect();
        let keys = if keys.is_empty() { "none".to_owned() } else { keys.join(", ") };
        let head = "| quantity | components | unit | formula | axes | sign | what is in it |";
        writeln!(text, "\n## {heading}\n\nKeys: {keys}.\n\n{head}\n|---|---|---|---|---|---|---|")
            .expect("a text");
        for row in QUANTITIES.iter().filter(|row| row.target == target) {
            writeln!(text, "{}", line(row)).expect("a text");
        }
    }
    assert_eq!(text.matches("\n| `").count(), QUANTITIES.len(), "a target has no heading");
    text.push('\n');
    text
}

/// Table line of a quantity.
fn line(row: &QuantityRow) -> String {
    let name = [Some(row.name), row.alias].into_iter().flatten().map(|name| format!("`{name}`"));
    let name = name.collect::<Vec<_>>().join(", ");
    let [components, unit] = components(row.components, row.target);
    let definition = &row.definition;
    let cells = [
        name,
        components,
        unit,
        definition.formula.to_owned(),
        definition.axes.to_owned(),
        definition.sign.to_owned(),
        definition.contents.to_owned(),
    ];
    format!("| {} |", cells.map(|cell| cell.replace('|', "\\|")).join(" | "))
}

/// Labels of the components of a quantity, and their unit.
fn components(form: ComponentForm, target: TargetKind) -> [String; 2] {
    let [labels, unit] = match form {
        ComponentForm::Measured(per) if target == TargetKind::Signal => {
            return ["one".into(), format!("that of the signal{per}")];
        }
        ComponentForm::Force if target == TargetKind::Coupling => ["one", "N m or N"],
        ComponentForm::Vector(unit) => ["x, y, z; in the plane x, y", unit],
        ComponentForm::Axial(unit) => ["x, y, z; in the plane one", unit],
        ComponentForm::Coordinates(per) => {
            return ["one for each coordinate: 1, 2, ...".into(), format!("rad{per} or m{per}")];
        }
        ComponentForm::Efforts => ["one for each coordinate: 1, 2, ...", "N m or N"],
        ComponentForm::Number(unit) | ComponentForm::Tire(unit) => ["one", unit],
        ComponentForm::Measured(per) => {
            return ["one".into(), format!("rad{per} or m{per}")];
        }
        ComponentForm::Length => ["one", "m"],
        ComponentForm::Contact => ["one", "-"],
        ComponentForm::TirePoint => ["x, y, z; in the plane x, y", "m"],
        ComponentForm::Deflection => ["one", "m or rad"],
        ComponentForm::Matrix => ["xx, xy, ... row by row", "-"],
        ComponentForm::Force => ["one; or Fx, Fy, Fz, Mx, My, Mz", "N or N m"],
        ComponentForm::Orientation => ["w, x, y, z; in the plane one", "-; in the plane rad"],
        ComponentForm::Wrench => ["Fx, Fy, Fz, Mx, My, Mz; in the plane Fx, Fy, Mz", "N, N m"],
    };
    [labels.to_owned(), unit.to_owned()]
}

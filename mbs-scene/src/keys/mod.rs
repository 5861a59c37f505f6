//! The keys of scene and sweep files: what may stand where, in which unit, and what it means.
//!
//! Readers check the keys of a file against these tables; the schema, `mbs kinds` and docs/SCENES.md are written from them.

mod body;
mod coupling;
mod effect;
mod example;
mod frame;
mod guide;
mod joint;
mod output;
mod point;
mod road;
mod rolling;
mod scene;
mod shape;
mod signal;
mod sweep;
mod table;
mod value;

pub use example::{Base, Example};
pub(crate) use output::{DEGREES, FORMS, GLOBAL, ORIENTATION, OWN_BODY};
pub(crate) use point::{DIRECTION, PLACE};
pub(crate) use road::FEATURE;
pub(crate) use scene::FILE;
pub(crate) use shape::{COLOURS, SHAPES};
pub(crate) use sweep::FILE as SWEEP_FILE;
pub use table::{Key, KeyTable, Standing};
pub(crate) use value::TABLE_FILE;
pub use value::{KeyValue, Referent};

use mbs_core::outputs::TargetKind;
use std::sync::LazyLock;

/// All tables, made once; see [`tables`].
static TABLES: LazyLock<Vec<KeyTable>> = LazyLock::new(|| {
    let mut tables = [
        scene::tables(),
        point::tables(),
        body::tables(),
        joint::tables(),
        guide::tables(),
        coupling::tables(),
        rolling::tables(),
        signal::tables(),
        frame::tables(),
        shape::tables(),
        effect::tables(),
        road::tables(),
        scene::solver(),
        output::tables(),
        sweep::tables(),
    ]
    .concat();
    add_examples(&mut tables);
    tables
});

/// All tables of scene files and of sweep files; those of one header, and of one kind, stand together.
#[must_use]
pub fn tables() -> &'static [KeyTable] {
    &TABLES
}

/// The tables of a header, of all kinds.
pub fn of(header: &str) -> &'static [KeyTable] {
    together(&TABLES, |table| table.header == header)
}

/// The tables of a kind, among the tables of a header.
pub fn of_kind(tables: &'static [KeyTable], kind: &str) -> &'static [KeyTable] {
    together(tables, |table| table.kind == Some(kind))
}

/// The table of outputs of such a target.
pub(crate) fn of_target(target: TargetKind) -> &'static [KeyTable] {
    let i = output::TARGETS.iter().position(|other| *other == target).unwrap_or(0);
    of("output").get(i..=i).unwrap_or_default()
}

/// The tables of which something holds; they stand together.
pub(crate) fn together(
    tables: &'static [KeyTable],
    is_meant: impl Fn(&KeyTable) -> bool,
) -> &'static [KeyTable] {
    let first = tables.iter().position(&is_meant).unwrap_or(tables.len());
    let n = tables[first..].iter().take_while(|table| is_meant(table)).count();
    &tables[first..first + n]
}

/// The examples of all tables.
const EXAMPLES: &str = include_str!("examples.toml");

/// Adds its example to each table.
fn add_examples(tables: &mut [KeyTable]) {
    for block in EXAMPLES.split("\n#: ").skip(1) {
        let Some((title, text)) = block.split_once('\n') else { continue };
        let Some((name, base)) = title.rsplit_once(", ") else { continue };
        let Some(base) = Base::of_name(base) else { continue };
        let is_meant = |table: &&mut KeyTable| {
            let kind = table.kind.map(|kind| format!(" {kind}")).unwrap_or_default();
            table.example.is_none() && name == format!("{}{kind}", table.header)
        };
        if let Some(table) = tables.iter_mut().find(is_meant) {
            table.example = Some(Example { base, text: text.trim() });
        }
    }
}

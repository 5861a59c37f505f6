//! Key tables: each is consistent with the others, and with the keys that the readers accept.

use mbs_scene::inside::keys::{of, of_kind};
use mbs_scene::keys::{Base, Example, KeyTable, KeyValue, Standing, tables};
use mbs_scene::{SceneFile, SceneSweep};
use std::collections::BTreeSet;
use std::path::Path;

/// The text of an example within its scene.
fn whole(example: &Example) -> String {
    format!("{}\n{}", example.base.text(), example.text)
}

/// Folder of the files that the examples include.
fn folder() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src/keys/bases"))
}

#[test]
fn every_table_of_files_has_an_example_that_reads_in_all_precisions() {
    for table in tables().iter().filter(|table| table.standing != Standing::Inside) {
        let of_kind = tables().iter().filter(|other| {
            other.header == table.header && other.kind == table.kind && other.kind.is_some()
        });
        let mut examples = of_kind.chain([table]).filter_map(|table| table.example.as_ref());
        let name = (table.header, table.kind);
        let example = examples.next().unwrap_or_else(|| panic!("no example of {name:?}"));
        if example.base == Base::Sweep {
            let scene = SceneFile::parse(Base::Planar.text(), "scene.toml").expect("TOML");
            let sweep = SceneFile::parse(example.text, "sweep.toml").expect("TOML");
            SceneSweep::new(&sweep.into(), &scene, &[]).unwrap_or_else(|e| panic!("{e:?}"));
            continue;
        }
        let file = SceneFile::parse_in(&whole(example), "example.toml", folder());
        let file = file.unwrap_or_else(|e| panic!("{name:?}: {}", e.render()));
        if let Err(error) = file.scene::<f64>() {
            panic!("{name:?}: {}", error.render());
        }
        // The example must have an entry of the table that it belongs to.
        let header = table.title();
        assert!(example.text.contains(&header), "{name:?}");
        assert!(table.kind.is_none_or(|kind| example.text.contains(kind)), "{name:?}");
    }
}

#[test]
fn keys_have_a_meaning_and_a_default_or_must_be_written() {
    for table in tables().iter() {
        let name = (table.header, table.kind);
        assert!(table.meaning.ends_with('.'), "{name:?}: {}", table.meaning);
        for key in &table.keys {
            assert!(key.meaning.ends_with('.'), "{name:?}: {}: {}", key.name, key.meaning);
            assert_eq!(key.is_needed, key.default.is_empty(), "{name:?}: {}", key.name);
            let same = table.keys.iter().filter(|other| other.name == key.name);
            let dimensions: Vec<_> = same.map(|key| key.dimension).collect();
            let is_one = dimensions.len() == 1;
            assert!(is_one || dimensions.iter().all(Option::is_some), "{name:?}: {}", key.name);
        }
    }
}

#[test]
fn tables_that_keys_name_are_there() {
    for key in tables().iter().flat_map(|table| &table.keys) {
        if let KeyValue::Table(header)
        | KeyValue::Tables(header)
        | KeyValue::TableOrTables(header)
        | KeyValue::PlacesOrTables(header) = key.value
        {
            assert!(!of(header).is_empty(), "{}: {header}", key.name);
        }
    }
}

#[test]
fn tables_of_a_header_and_of_a_kind_stand_together() {
    for table in tables().iter() {
        let n = tables().iter().filter(|other| other.header == table.header).count();
        assert_eq!(of(table.header).len(), n, "{}", table.header);
        let Some(kind) = table.kind else { continue };
        let n = of(table.header).iter().filter(|other| other.kind == Some(kind)).count();
        assert_eq!(of_kind(of(table.header), kind).len(), n, "{kind}");
    }
}

/// Each reader refuses an entry without a key that its table marks as needed. A key can therefore not be added to the table or to the
/// reader alone.
#[test]
fn each_needed_key_is_missed_by_its_reader() {
    // An output without one of its keys is a valid output of another kind.
    let is_tried =
        |table: &&KeyTable| table.standing == Standing::Listed && table.header != "output";
    for table in tables().iter().filter(is_tried) {
        let Some(example) = table.example.as_ref().filter(|e| e.base != Base::Sweep) else {
            continue;
        };
        let needed = table.keys.iter().filter(|key| key.is_needed);
        let missed: BTreeSet<_> = needed
            .filter_map(|key| {
                without(&whole(example), table.header, key.name).map(|text| (key.name, text))
            })
            .collect();
        for (key, text) in missed {
            let file = SceneFile::parse_in(&text, "example.toml", folder());
            assert!(
                file.and_then(|file| file.scene::<f64>()).is_err(),
                "{} {:?} reads without {key}",
                table.header,
                table.kind
            );
        }
    }
}

/// A text without the first line of `key` below the last `[[header]]`; `None` when there is no such line.
fn without(text: &str, header: &str, key: &str) -> Option<String> {
    let at = text.rfind(&format!("[[{header}]]"))?;
    let line = text[at..].find(&format!("\n{key} = "))? + at + 1;
    let end = text[line..].find('\n')? + line + 1;
    Some(format!("{}{}", &text[..line], &text[end..]))
}

#[test]
fn every_example_of_the_file_is_that_of_a_table() {
    let n = tables().iter().filter(|table| table.example.is_some()).count();
    assert_eq!(n, include_str!("../../src/keys/examples.toml").matches("\n#: ").count());
}

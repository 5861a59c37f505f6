//! The manual: every key is in it, and the page of a kind has its whole description.

use mbs_scene::inside::{entries, groups};
use mbs_scene::manual::{list, markdown, page, schema};

#[test]
fn schema_pages_and_markdown_have_every_key() {
    let schema: serde_json::Value = serde_json::from_str(&schema()).expect("JSON");
    let markdown = markdown();
    for table in groups().concat() {
        let definition = &schema["definitions"][table.header];
        let forms = definition["anyOf"].as_array().cloned();
        let forms = forms.unwrap_or_else(|| vec![definition.clone()]);
        let name = table.kind.unwrap_or(table.header);
        let page = page(&format!("{} {name}", table.header)).or_else(|_| page(name));
        let page = page.unwrap_or_else(|hint| panic!("{name}: {hint}"));
        for key in &table.keys {
            let has = |form: &serde_json::Value| form["properties"].get(key.name).is_some();
            assert!(forms.iter().any(has), "{name}: {}", key.name);
            assert!(page.contains(&format!("\n  {} ", key.name)), "{name}: {}\n{page}", key.name);
            assert!(markdown.contains(&format!("| `{}` |", key.name)), "{name}: {}", key.name);
        }
    }
}

#[test]
fn a_mistyped_kind_is_met_with_the_nearest_one() {
    assert_eq!(page("revolut").unwrap_err(), "did you mean `revolute`?");
    assert!(page("revolute").expect("a page").contains("`turn` [rad]"));
    assert!(list().contains("spring-damper"));
}

#[test]
fn lines_of_pages_fit_a_terminal() {
    for entry in groups().into_iter().flat_map(entries) {
        let name = entry[0].kind.unwrap_or(entry[0].header);
        let page = page(name).expect("a page");
        let text: Vec<_> = page.lines().filter(|line| !line.starts_with("    ")).collect();
        assert!(text.iter().all(|line| line.chars().count() <= 100), "{page}");
    }
}

/// Writes docs/SCENES.md when the environment variable MBS_WRITE_DOCS is set.
#[test]
fn the_document_is_written_from_the_tables() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/SCENES.md");
    if std::env::var_os("MBS_WRITE_DOCS").is_some() {
        std::fs::write(path, markdown()).expect("the document");
    }
    let document = std::fs::read_to_string(path).expect("the document");
    assert!(
        document == markdown(),
        "run this test with MBS_WRITE_DOCS=1, and look at the difference"
    );
}

/// The twist has no value where the swing is half a turn. Therefore no signal measures a twist, and no page offers it.
#[test]
fn a_signal_is_not_offered_the_twist_of_a_ball() {
    let document = markdown();
    let of = |heading: &str| {
        let (_, rest) = document.split_once(heading).expect("a heading");
        rest.split("\n##").next().expect("its text").to_owned()
    };
    assert!(!of("### signal `measure`").contains("twist"));
    assert!(
        of("### signal `measure`").contains("swing") && of("## Table `term`").contains("twist")
    );
}

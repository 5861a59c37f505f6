//! Table of settings, compared with the fields that it describes, and with the sentences in it.

use mbs_core::scene::{NotASetting, SETTINGS, Setting, SettingForm, SettingValue, SolverTable};

/// Largest number of words of a sentence: rule 1 of the language in docs/NOTATION.md.
const MAX_WORDS: usize = 25;

/// Files whose fields have the meaning of a setting as doc comment, with the first line after these fields.
const FILES: [(&str, &str); 2] = [
    ("src/scene/solver.rs", "/// Further keys"),
    ("../mbs-steps/src/settings.rs", "/// Interrupt that ends"),
];

/// Value that the setting accepts.
fn some_value(row: &Setting) -> SettingValue<f64> {
    match row.form {
        SettingForm::Word(words) => SettingValue::Word(words[0].to_owned()),
        SettingForm::Positive => SettingValue::Number(1.0),
        SettingForm::Descending => SettingValue::Pair([2.0, 1.0]),
        SettingForm::Flag => SettingValue::Flag(true),
        SettingForm::Count => SettingValue::Count(1),
    }
}

#[test]
fn each_setting_of_the_solver_is_a_field_of_its_form_and_each_field_a_setting() {
    let mut table = SolverTable::default();
    for (key, row) in Setting::of_table("solver") {
        assert_eq!(table.value(key), None, "{key}");
        assert_eq!(table.set(key, some_value(row)), Ok(()), "{key}");
        assert_eq!(table.value(key), Some(some_value(row)), "{key}");
    }
    assert!(!format!("{table:?}").contains("None"), "{table:?}");
    assert_eq!(table.set("step", SettingValue::Flag(true)), Err(NotASetting));
    assert_eq!(table.set("steps", SettingValue::Number(1.0)), Err(NotASetting));
    assert_eq!(table.step, Some(1.0));
}

#[test]
fn settings_have_names_of_their_own_and_short_sentences() {
    for (i, row) in SETTINGS.iter().enumerate() {
        let name = row.name;
        assert!(SETTINGS[..i].iter().all(|other| other.name != name), "{name}");
        assert_eq!(Setting::named(name), Some(row), "{name}");
        assert_eq!(row.option(), name.replace('_', "-"), "{name}");
        let text = some_value(row).text(f64::to_string);
        assert_eq!(row.parse(&text), Some(some_value(row)), "{name}: {text}");
        assert_eq!(row.default.is_empty(), name == "duration", "{name}");
        let (sentence, further) = (row.sentence(), row.further().collect::<Vec<_>>().join(" "));
        for sentence in [sentence, further].join(" ").split(". ") {
            assert!(sentence.split_whitespace().count() <= MAX_WORDS, "{name}: {sentence}");
        }
        assert!(row.further().chain([row.sentence()]).all(|text| text.ends_with('.')), "{name}");
    }
}

#[test]
fn fields_have_the_sentences_of_the_table() {
    for (file, end) in FILES {
        let path = format!("{}/{file}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).expect("a source file");
        let text = text.split(end).next().unwrap_or_default();
        for row in &SETTINGS {
            // a table names the field by the key, a method by the name
            for key in [row.path.trim_start_matches("solver."), row.name] {
                let Some((before, _)) = text.split_once(&format!("\n    pub {key}: ")) else {
                    continue;
                };
                let doc = before.rsplit('\n').next().unwrap_or_default().trim();
                assert_eq!(doc, format!("/// {}", row.sentence()), "{file}: {key}");
            }
        }
    }
}

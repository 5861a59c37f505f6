//! Settings of a run against the table of settings: words, defaults, and fields of a method.

use mbs::core::scene::{
    Dimension, NotASetting, SETTINGS, Scene, Setting, SettingForm, SettingValue,
};
use mbs::{FORMULATIONS, INTEGRATORS, Method, PRECISIONS, ResolvedMethod, STEP_RULES};

/// Allowed words of a setting.
fn words(name: &str) -> &'static [&'static str] {
    match Setting::named(name).map(|row| row.form) {
        Some(SettingForm::Word(words)) => words,
        other => panic!("{name}: {other:?}"),
    }
}

#[test]
fn words_of_the_table_are_those_that_are_built() {
    assert_eq!(words("formulation"), FORMULATIONS);
    assert_eq!(words("integrator"), INTEGRATORS);
    assert_eq!(words("precision"), PRECISIONS);
    // the last word is an alias of the third
    assert_eq!(words("step_control"), [&STEP_RULES[..], &["energy-published"]].concat());
}

#[test]
fn each_setting_is_a_field_of_a_method() {
    let mut method = Method::default();
    for row in &SETTINGS {
        let value = match row.form {
            SettingForm::Word(words) => SettingValue::Word(words[0].to_owned()),
            SettingForm::Positive => SettingValue::Number(1.0),
            SettingForm::Descending => SettingValue::Pair([2.0, 1.0]),
            SettingForm::Flag => SettingValue::Flag(true),
            SettingForm::Count => SettingValue::Count(2),
        };
        assert_eq!(method.set(row.name, value.clone()), Ok(()), "{}", row.name);
        assert_eq!(method.value(row.name), Some(value), "{}", row.name);
    }
    assert!(!format!("{method:?}").contains("None"), "{method:?}");
    assert_eq!(method.set("steps", SettingValue::Number(1.0)), Err(NotASetting));
}

#[test]
fn defaults_are_those_of_the_table() {
    let scene = Scene::<f64>::empty("empty", Dimension::Planar, 1.0);
    let settings = ResolvedMethod::new(&scene, &Method::default()).expect("the defaults");
    assert_eq!(settings.asked, "auto");
    let decided = settings.decided();
    let numbers = ["integrator", "step", "error_tolerance", "energy_alarm", "precision", "threads"];
    for name in numbers {
        let row = Setting::named(name).expect("a row");
        assert_eq!(decided.value(name), row.parse(row.default), "{name}");
    }
    let limits = Setting::named("energy_tolerance").expect("a row");
    let written = limits.default.trim_matches(['[', ']']);
    assert_eq!(decided.value(limits.name), limits.parse(written));
    assert_eq!(ResolvedMethod::new(&scene, &decided).expect("the same").decided(), decided);
}

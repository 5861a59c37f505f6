//! Options of the method. Each setting of mbs-core's table that a command accepts has an option.

use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches};
use core::fmt::Debug;
use core::marker::PhantomData;
use mbs::Method;
use mbs::core::scene::{SETTINGS, Setting, SettingForm, SettingValue};

/// Setting that recorded command lines leave out: results are the same for any number of threads.
const UNRECORDED: &str = "threads";

/// Set of settings that a command accepts.
pub(crate) trait SettingSet: Debug + Clone + Send + Sync + 'static {
    /// Returns true if the set contains the setting.
    fn has(row: &Setting) -> bool;

    /// True if the help contains the complete text of a setting; otherwise it has the first paragraph.
    const IS_WHOLE: bool = false;
    /// Words that the command does not accept as values of settings.
    const WITHOUT: &[&str] = &[];
    /// Names of settings whose default in this command differs from the table, each with a text of this default.
    const OWN_DEFAULTS: &[(&str, &str)] = &[];
}

/// Set of all settings.
#[derive(Debug, Clone)]
pub(crate) struct All;

impl SettingSet for All {
    fn has(_: &Setting) -> bool {
        true
    }

    const IS_WHOLE: bool = true;
}

/// Declares sets of settings by the names in them.
macro_rules! sets {
    ($($(#[$about:meta])* $Set:ident = [$($name:literal),*] without [$($word:literal),*] $(, $own:literal = $default:literal)?;)*) => {
        $(
            $(#[$about])*
            #[derive(Debug, Clone)]
            pub(crate) struct $Set;

            impl SettingSet for $Set {
                fn has(row: &Setting) -> bool {
                    [$($name),*].contains(&row.name)
                }

                const WITHOUT: &[&str] = &[$($word),*];
                const OWN_DEFAULTS: &[(&str, &str)] = &[$(($own, $default))?];
            }
        )*
    };
}

sets! {
    /// Set of the settings of `mbs explain`.
    OfExplain = ["formulation", "integrator", "step", "duration", "precision"] without ["dd"];
    /// Set of the settings of `mbs sweep`.
    OfSweep = ["formulation", "integrator", "step", "error_tolerance", "duration", "precision"] without ["dd"],
        "error_tolerance" = "fixed steps";
    /// Set of the settings of `mbs doctor`.
    OfDoctor = ["formulation", "step", "duration"] without [];
}

/// Method from the options of a set of settings.
#[derive(Debug, Clone)]
pub(crate) struct MethodArguments<S> {
    pub(crate) given: Method,
    set: PhantomData<S>,
}

impl<S: SettingSet> Args for MethodArguments<S> {
    fn augment_args(command: Command) -> Command {
        command.args(rows::<S>().map(|row| option::<S>(row)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<S: SettingSet> FromArgMatches for MethodArguments<S> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut given = Method::default();
        for row in rows::<S>() {
            if let Some(value) = matches.get_one::<SettingValue<f64>>(row.name) {
                // the text was parsed already by the form of the setting, so this cannot fail
                let _ = given.set(row.name, value.clone());
            }
        }
        Ok(Self { given, set: PhantomData })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The options of a method as text, for recorded command lines.
pub(crate) fn written(method: &Method) -> Vec<(&'static str, Option<String>)> {
    let recorded = SETTINGS.iter().filter(|row| row.name != UNRECORDED);
    let text = |row: &Setting| method.value(row.name).map(|value| value.text(f64::to_string));
    recorded.map(|row| (row.option(), text(row))).collect()
}

/// The settings of a set.
fn rows<S: SettingSet>() -> impl Iterator<Item = &'static Setting> {
    SETTINGS.iter().filter(|row| S::has(row))
}

/// The option of a setting.
fn option<S: SettingSet>(row: &'static Setting) -> Arg {
    let read = |text: &str| row.parse(text).ok_or_else(|| wanted(row.form, text));
    let is_number = matches!(row.form, SettingForm::Positive | SettingForm::Descending);
    let first = format!("{} {}", meaning(row, S::WITHOUT), default(row, S::OWN_DEFAULTS));
    let further: Vec<String> = row.further().map(|text| of_options(&text)).collect();
    let others = row.options.get(1..).unwrap_or_default();
    let option = Arg::new(row.name)
        .long(row.option())
        .visible_aliases(others.iter().copied())
        .value_name(row.letter)
        .value_parser(read)
        .allow_hyphen_values(is_number)
        .help(first.trim_end_matches('.').to_owned());
    if !S::IS_WHOLE || further.is_empty() {
        return option;
    }
    option.long_help([vec![first], further].concat().join("\n\n"))
}

/// Text of a setting with the words that it accepts.
fn meaning(row: &Setting, without: &[&str]) -> String {
    let words: &[&str] = match row.form {
        SettingForm::Word(words) => words,
        SettingForm::Flag => &["on", "off"],
        SettingForm::Positive | SettingForm::Descending | SettingForm::Count => &[],
    };
    let words: Vec<_> = words.iter().copied().filter(|word| !without.contains(word)).collect();
    let sentence = row.sentence();
    match (&words[..], sentence.strip_suffix('.')) {
        ([others @ .., last], Some(sentence)) => {
            format!("{sentence}: {} or {last}.", others.join(", "))
        }
        _ => sentence,
    }
}

/// Text of the default of a setting. `own` lists names and texts of the defaults that this command replaces.
fn default(row: &Setting, own: &[(&str, &str)]) -> String {
    let own = own.iter().find(|(name, _)| *name == row.name);
    let of_table = || match row.form {
        SettingForm::Flag if row.default == "true" => "on".to_owned(),
        SettingForm::Descending => row.default.replace(['[', ']', ' '], ""),
        _ => of_options(row.default),
    };
    let default = own.map_or_else(of_table, |(_, words)| (*words).to_owned());
    match (row.path.is_empty(), default.is_empty()) {
        (true, _) => format!("Default: {default}."),
        (false, true) => "Default: the scene's.".to_owned(),
        (false, false) => format!("Default: the scene's, else {default}."),
    }
}

/// A text in which names of settings are replaced by their options.
fn of_options(text: &str) -> String {
    SETTINGS.iter().fold(text.to_owned(), |text, row| {
        text.replace(&format!("`{}`", row.name), &format!("--{}", row.option()))
    })
}

/// Hint on the form of a value, for a text that does not have it.
fn wanted(form: SettingForm, text: &str) -> &'static str {
    let is_whole = text.bytes().all(|byte| byte.is_ascii_digit());
    match form {
        SettingForm::Count if is_whole && !text.is_empty() => "the number is too large",
        SettingForm::Word(_) => "write a word",
        SettingForm::Positive => "write a number, such as 0.001",
        SettingForm::Descending => "write two numbers with a comma, such as 1e-5,1e-7",
        SettingForm::Flag => "write on or off",
        SettingForm::Count => "write a whole number from 1",
    }
}

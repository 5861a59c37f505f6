//! Settings of the methods: descriptions and values.

use alloc::format;
use alloc::string::String;

/// One setting of a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Setting {
    /// Name of the setting in code and in Python.
    pub name: &'static str,
    /// Table and key in scene files, separated by a dot. Empty: scene files have no such key, and only a run has the setting.
    pub path: &'static str,
    /// Option names on the command line; help shows the first one. Empty: the option has the name `name`.
    pub options: &'static [&'static str],
    /// Form of the value, which also says which values are refused.
    pub form: SettingForm,
    /// Letter in place of the value in the help of the command line.
    pub letter: &'static str,
    /// SI unit of the value; empty: none.
    pub unit: &'static str,
    /// Default value, if neither the command line nor the scene gives one. Empty: a scene always has a value.
    pub default: &'static str,
    /// Methods that use the setting. Empty: all methods use it.
    pub takers: &'static str,
    /// Meaning of the setting, in one sentence.
    pub meaning: &'static str,
    /// Further sentences on the setting.
    pub more: &'static [&'static str],
}

/// Form of the value of a setting. Values of other forms are refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SettingForm {
    /// One of these words.
    Word(&'static [&'static str]),
    /// A number above zero.
    Positive,
    /// Two numbers above zero, the larger one first.
    Descending,
    /// True or false; on the command line `on` or `off`.
    Flag,
    /// A whole number that is at least 1.
    Count,
}

/// Value of a setting.
#[derive(Debug, Clone, PartialEq)]
pub enum SettingValue<T> {
    /// Value in the form [`SettingForm::Word`].
    Word(String),
    /// Value in the form [`SettingForm::Positive`].
    Number(T),
    /// Value in the form [`SettingForm::Descending`].
    Pair([T; 2]),
    /// Value in the form [`SettingForm::Flag`].
    Flag(bool),
    /// Value in the form [`SettingForm::Count`].
    Count(usize),
}

/// Field of a setting in a struct with all settings. A field that is `None` leaves the setting open.
#[derive(Debug)]
pub enum SettingSlot<'a, T> {
    /// Field for a value in the form [`SettingForm::Word`].
    Word(&'a mut Option<String>),
    /// Field for a value in the form [`SettingForm::Positive`].
    Number(&'a mut Option<T>),
    /// Field for a value in the form [`SettingForm::Descending`].
    Pair(&'a mut Option<[T; 2]>),
    /// Field for a value in the form [`SettingForm::Flag`].
    Flag(&'a mut Option<bool>),
    /// Field for a value in the form [`SettingForm::Count`].
    Count(&'a mut Option<usize>),
}

/// Error of a setting that does not exist, or of a value of another form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotASetting;

impl core::fmt::Display for NotASetting {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("no setting has this name and takes this value; SETTINGS lists names and forms")
    }
}

impl core::error::Error for NotASetting {}

impl Setting {
    /// Name of the option on the command line.
    #[must_use]
    pub fn option(&self) -> &'static str {
        self.options.first().copied().unwrap_or(self.name)
    }

    /// Reads a value in the form of the command line: a word, a number, two numbers `U,L`, `on` or `off`. `None` for a text of
    /// another form.
    #[must_use]
    pub fn parse(&self, text: &str) -> Option<SettingValue<f64>> {
        let number = |text: &str| text.trim().parse::<f64>().ok();
        Some(match self.form {
            SettingForm::Word(_) => SettingValue::Word(String::from(text)),
            SettingForm::Positive => SettingValue::Number(number(text)?),
            SettingForm::Descending => {
                let (upper, lower) = text.split_once(',')?;
                SettingValue::Pair([number(upper)?, number(lower)?])
            }
            SettingForm::Flag => match text {
                "on" => SettingValue::Flag(true),
                "off" => SettingValue::Flag(false),
                _ => return None,
            },
            SettingForm::Count => SettingValue::Count(text.trim().parse().ok()?),
        })
    }

    /// Returns the meaning with the unit of the value.
    #[must_use]
    pub fn sentence(&self) -> String {
        let Self { meaning, unit, .. } = self;
        match meaning.strip_suffix('.') {
            Some(words) if !unit.is_empty() => format!("{words} [{unit}]."),
            _ => String::from(*meaning),
        }
    }

    /// Returns the sentences that follow the meaning: the methods that use the setting, then the further sentences.
    pub fn further(&self) -> impl Iterator<Item = String> {
        let takers = Some(self.takers).filter(|takers| !takers.is_empty());
        let taken = takers.map(|takers| format!("Taken by {takers}."));
        taken.into_iter().chain(self.more.iter().map(|more| String::from(*more)))
    }
}

impl<T> SettingValue<T> {
    /// Returns the value with each number converted by `f`.
    pub fn map<U>(self, f: &mut impl FnMut(T) -> U) -> SettingValue<U> {
        match self {
            Self::Word(word) => SettingValue::Word(word),
            Self::Number(x) => SettingValue::Number(f(x)),
            Self::Pair(x) => SettingValue::Pair(x.map(f)),
            Self::Flag(flag) => SettingValue::Flag(flag),
            Self::Count(n) => SettingValue::Count(n),
        }
    }

    /// Text of the value, which [`Setting::parse`] reads back. `number` formats a number.
    pub fn text(&self, number: impl Fn(&T) -> String) -> String {
        match self {
            Self::Word(word) => word.clone(),
            Self::Number(x) => number(x),
            Self::Pair([upper, lower]) => format!("{},{}", number(upper), number(lower)),
            Self::Flag(flag) => String::from(if *flag { "on" } else { "off" }),
            Self::Count(n) => format!("{n}"),
        }
    }
}

impl<T> SettingSlot<'_, T> {
    /// Takes the value out of the field, which is `None` afterwards.
    pub fn take(self) -> Option<SettingValue<T>> {
        match self {
            Self::Word(field) => field.take().map(SettingValue::Word),
            Self::Number(field) => field.take().map(SettingValue::Number),
            Self::Pair(field) => field.take().map(SettingValue::Pair),
            Self::Flag(field) => field.take().map(SettingValue::Flag),
            Self::Count(field) => field.take().map(SettingValue::Count),
        }
    }

    /// Sets the field to a value.
    ///
    /// # Errors
    /// [`NotASetting`] for a value of another form. The field is then unchanged.
    pub fn set(self, value: SettingValue<T>) -> Result<(), NotASetting> {
        match (self, value) {
            (Self::Word(field), SettingValue::Word(word)) => *field = Some(word),
            (Self::Number(field), SettingValue::Number(x)) => *field = Some(x),
            (Self::Pair(field), SettingValue::Pair(x)) => *field = Some(x),
            (Self::Flag(field), SettingValue::Flag(flag)) => *field = Some(flag),
            (Self::Count(field), SettingValue::Count(n)) => *field = Some(n),
            _ => return Err(NotASetting),
        }
        Ok(())
    }
}

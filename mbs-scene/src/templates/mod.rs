//! Small scenes with comments, as templates of new scenes.

/// A scene file to begin a new scene from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Template {
    /// Name of the template: the name of its file without the extension.
    pub name: &'static str,
    /// Text of the scene file.
    pub text: &'static str,
}

macro_rules! templates {
    ($($name:literal),* $(,)?) => {
        /// All templates, the simplest first.
        pub const TEMPLATES: &[Template] =
            &[$(Template { name: $name, text: include_str!(concat!($name, ".toml")) }),*];
    };
}

templates![
    "pendulum",
    "four-bar",
    "slider-crank",
    "crank-rocker",
    "quarter-car",
    "double-wishbone",
    "arm"
];

impl Template {
    /// Description of the template: the first sentence of the first comment.
    #[must_use]
    pub fn meaning(&self) -> &'static str {
        let line = self.text.lines().next().unwrap_or_default().trim_start_matches(['#', ' ']);
        line.find('.').map_or(line, |end| &line[..end])
    }
}

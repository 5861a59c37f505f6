//! Small scenes to begin from, with comments.

/// A scene to begin from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Template {
    /// Its name: that of the file without its ending.
    pub name: &'static str,
    /// Its text.
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
    /// What it is: the first sentence of its first comment.
    #[must_use]
    pub fn meaning(&self) -> &'static str {
        let line = self.text.lines().next().unwrap_or_default().trim_start_matches(['#', ' ']);
        line.find('.').map_or(line, |end| &line[..end])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SceneFile;

    #[test]
    fn every_template_reads_says_what_it_is_and_has_outputs() {
        for template in TEMPLATES {
            let file = SceneFile::parse(template.text, template.name).expect("TOML");
            let scene = file.scene::<f64>().unwrap_or_else(|e| panic!("{}", e.render()));
            assert!(!scene.outputs.is_empty(), "{}", template.name);
            assert!(template.meaning().len() > 10, "{}", template.name);
            // three screens, of which a list of hard points takes one
            assert!(template.text.lines().count() <= 160, "{}", template.name);
        }
    }
}

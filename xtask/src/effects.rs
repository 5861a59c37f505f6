//! The effects of mbs-core, read from the list in its source: names, Cargo features, modules of laws.

/// Source text of the list.
const LIST: &str = include_str!("../../mbs-core/src/effects/list.rs");

/// A line of the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Listed {
    /// Module of the effect in `mbs_core::effects`.
    pub module: &'static str,
    /// The Cargo feature that enables the effect; `None`: every build has the effect.
    pub feature: Option<&'static str>,
    /// True if the effect's file contains a law.
    pub has_law: bool,
}

impl Listed {
    /// Cases of the effect in `counts`. A user-defined law has two, since it may act on a length or on a body.
    pub fn cases(self) -> Vec<String> {
        match self.module {
            "user" => vec!["own-length".to_owned(), "own-body".to_owned()],
            module => vec![module.replace('_', "-")],
        }
    }

    /// True if tables for controllers can contain the effect. It must have a law, or be a bushing, and must not need a function in code.
    pub fn is_exported(self) -> bool {
        let is_code = self.module == "user" || self.module.starts_with("law_on");
        (self.has_law || self.module == "bushing") && !is_code
    }
}

/// Every effect of the list.
pub fn all() -> impl Iterator<Item = Listed> {
    LIST.lines().filter_map(|line| {
        let (_, rest) = line.trim().strip_suffix(';')?.split_once(" in ")?;
        let (module, rest) = rest.split_once(" (")?;
        let (gate, laws) = rest.split_once(')')?;
        // the list `all(...)` is cut at its own closing bracket
        let feature = gate.strip_prefix("feature = \"").and_then(|name| name.strip_suffix('"'));
        let has_law = laws.contains(" tension ") || laws.contains(" body ");
        Some(Listed { module, feature, has_law })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_is_read() {
        let all: Vec<_> = all().collect();
        let find = |module: &str| all.iter().find(|listed| listed.module == module).copied();
        assert_eq!(
            find("speed_hold"),
            Some(Listed { module: "speed_hold", feature: Some("speed-hold"), has_law: true })
        );
        assert_eq!(find("force"), Some(Listed { module: "force", feature: None, has_law: false }));
        assert!(all.len() >= 15);
        // each file of a kind has a line in the list
        let folder = crate::process::root().join("mbs-core/src/effects");
        for entry in std::fs::read_dir(folder).expect("the folder") {
            let name = entry.expect("a file").file_name().into_string().expect("a name");
            // the folder `action` contains no kinds
            let Some(module) = name.strip_suffix(".rs") else { continue };
            let others = "mod answers apart data example field kind law list reference table";
            let is_kind = !others.split(' ').any(|other| other == module);
            assert_eq!(find(module).is_some(), is_kind, "{module} in the list of effects");
        }
        // each feature of the list is a feature of mbs-core, and part of its feature `effects`
        let manifest = include_str!("../../mbs-core/Cargo.toml");
        for feature in all.iter().filter_map(|listed| listed.feature) {
            assert!(manifest.contains(&format!("\n{feature} = []")), "{feature}");
            assert!(manifest.contains(&format!("    \"{feature}\",")), "{feature}");
        }
    }
}

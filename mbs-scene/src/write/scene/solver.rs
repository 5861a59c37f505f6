//! Writes the table `[solver]`, by the table of settings of mbs-core.

use super::Keys;
use crate::read::tree::Node;
use mbs_core::scene::{Number, Setting, SettingValue, SolverTable};

impl Keys {
    /// The keys of the solver's settings that are set.
    pub(super) fn of_solver(solver: &SolverTable<Number>) -> Self {
        let mut keys = Self::default();
        for (key, _) in Setting::of_table("solver") {
            let node = solver.value(key).map(|value| match value {
                SettingValue::Word(word) => Node::from(word.as_str()),
                SettingValue::Number(x) => Node::from(&x),
                SettingValue::Pair(x) => Node::from(&x),
                SettingValue::Count(n) => Node::Number(n.to_string()),
                SettingValue::Flag(flag) => Node::Bool(flag),
            });
            keys.push_some(key, node);
        }
        keys
    }
}

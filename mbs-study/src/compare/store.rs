//! Results that outlive a kill: each is in the journal before the next is begun.

use crate::journal::{Head, Journal, JournalError};
use mbs::Interrupt;
use serde::{Serialize, de::DeserializeOwned};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// What a comparison does with the runs that an earlier start left in the directory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Earlier {
    /// Refuses to begin.
    #[default]
    Refuse,
    /// Resumes from them.
    Resume,
    /// Throws them away.
    Restart,
}

/// Results by key, in memory and in a journal where there is a directory.
#[derive(Debug, Default)]
pub(super) struct Store {
    journal: Option<Journal>,
    done: BTreeMap<String, Value>,
    /// Results of an earlier start.
    pub(super) resumed: usize,
    /// What ends the comparison from outside.
    pub(super) interrupt: Interrupt,
}

impl Store {
    /// Opens the journal of a directory; without one, results are kept in memory only. Says with `None` that there are results
    /// of an earlier start which must not be lost.
    pub(super) fn open(
        out: Option<&Path>,
        head: &Head,
        earlier: Earlier,
    ) -> Result<Option<Self>, JournalError> {
        let Some(out) = out else { return Ok(Some(Self::default())) };
        std::fs::create_dir_all(out)?;
        let (journal, lines) = Journal::open(out, head, earlier == Earlier::Restart)?;
        let read = |cells: Vec<String>| -> Option<(String, Value)> {
            let [key, value] = <[String; 2]>::try_from(cells).ok()?;
            Some((key, serde_json::from_str(&value).ok()?))
        };
        let done: BTreeMap<String, Value> = lines.into_iter().filter_map(read).collect();
        if earlier == Earlier::Refuse && !done.is_empty() {
            return Ok(None);
        }
        let resumed = done.len();
        Ok(Some(Self { journal: Some(journal), done, resumed, interrupt: Interrupt::default() }))
    }

    /// The result of an earlier start, or that of `job`, kept; as the journal has it.
    pub(super) fn get<R: Serialize + DeserializeOwned + Default>(
        &mut self,
        key: &str,
        job: impl FnOnce() -> R,
    ) -> Result<R, JournalError> {
        let known = |value: &Value| R::deserialize(value).unwrap_or_default();
        if let Some(value) = self.done.get(key) {
            return Ok(known(value));
        }
        let value = serde_json::to_value(job()).unwrap_or_default();
        // what was cut short is no result
        if self.interrupt.is_set() {
            return Err(JournalError::Interrupted);
        }
        if let Some(journal) = &mut self.journal {
            journal.append(&[key, &value.to_string()])?;
        }
        Ok(known(self.done.entry(key.to_owned()).or_insert(value)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::journal::Kind;
    use core::sync::atomic::{AtomicBool, Ordering};
    use std::sync::Arc;

    const KIND: Kind =
        Kind { file: "x.journal", title: "x", of: ["an x", "another x"], hashes: &["the text"] };

    #[test]
    fn a_result_is_kept_to_the_last_bit_and_made_once() {
        let out = std::env::temp_dir().join(format!("mbs-store-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&out);
        let head = Head::new(KIND, &["a"]);
        let numbers: [f64; 4] = [0.1 + 0.2, 1.0 / 3.0, 5e-324, -2.5e300];
        let open = |earlier| Store::open(Some(&out), &head, earlier).unwrap();
        let mut store = open(Earlier::Refuse).unwrap();
        store.get("run 1", || numbers.to_vec()).unwrap();
        drop(store);
        assert!(open(Earlier::Refuse).is_none(), "finished runs are not lost by mistake");
        let mut store = open(Earlier::Resume).unwrap();
        assert_eq!(store.resumed, 1);
        let value: Vec<f64> = store.get("run 1", || panic!("it is there")).unwrap();
        assert_eq!(value, numbers);
        // what is cut short is no result
        let flag = Arc::new(AtomicBool::new(false));
        store.interrupt = Interrupt::new(flag.clone());
        let cut = store.get("run 2", || {
            flag.store(true, Ordering::Relaxed);
            0
        });
        assert!(matches!(cut, Err(JournalError::Interrupted)));
        drop(store);
        store = open(Earlier::Resume).unwrap();
        assert_eq!(store.resumed, 1);
        drop(store);
        let other = Head::new(KIND, &["b"]);
        let refused = Store::open(Some(&out), &other, Earlier::Resume).unwrap_err();
        assert!(matches!(refused, JournalError::Other(_)), "{refused}");
        assert_eq!(open(Earlier::Restart).unwrap().resumed, 0);
        std::fs::remove_dir_all(&out).unwrap();
    }
}

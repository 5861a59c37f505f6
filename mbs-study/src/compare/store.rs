//! Results that are not lost if the process is killed: each is in the journal before the next job begins.

use crate::journal::{Head, Journal, JournalError};
use mbs::Interrupt;
use serde::{Serialize, de::DeserializeOwned};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Treatment of runs that an earlier, unfinished comparison left in the directory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Earlier {
    /// Refuses to begin a comparison.
    #[default]
    Refuse,
    /// Resumes from the earlier runs.
    Resume,
    /// Deletes the earlier runs.
    Restart,
}

/// Results by key, in memory and, if there is a directory, in a journal.
#[derive(Debug, Default)]
pub struct ResultStore {
    journal: Option<Journal>,
    done: BTreeMap<String, Value>,
    /// Number of results of an earlier start.
    pub resumed: usize,
    /// Interrupt by which the caller ends the comparison.
    pub interrupt: Interrupt,
}

impl ResultStore {
    /// Opens the journal of a directory. Without a directory, results are in memory only. `None` means that the journal has results of an
    /// earlier start, which must not be lost.
    ///
    /// # Errors
    /// [`JournalError`] where the journal cannot be used.
    pub fn open(
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

    /// Returns the result of an earlier start, or runs `job` and stores its result in the journal.
    ///
    /// # Errors
    /// [`JournalError`] if the result cannot be stored, or the comparison is interrupted.
    pub fn get<R: Serialize + DeserializeOwned + Default>(
        &mut self,
        key: &str,
        job: impl FnOnce() -> R,
    ) -> Result<R, JournalError> {
        let known = |value: &Value| R::deserialize(value).unwrap_or_default();
        if let Some(value) = self.done.get(key) {
            return Ok(known(value));
        }
        let value = serde_json::to_value(job()).unwrap_or_default();
        // an interrupted job has no result
        if self.interrupt.is_set() {
            return Err(JournalError::Interrupted);
        }
        if let Some(journal) = &mut self.journal {
            journal.append(&[key, &value.to_string()])?;
        }
        Ok(known(self.done.entry(key.to_owned()).or_insert(value)))
    }
}

//! Conversion of the errors of studies into the error type of the main interface.

use crate::compare::{CompareError, JournalError};
use crate::sweep::StudyError;
use mbs::{INTERRUPTED, SimulationError};

impl From<StudyError> for SimulationError {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Read(error) => error.into(),
            StudyError::Path { ref fault, .. } => {
                Self::new("scene-refused", &error, fault.hint_in_code()).with_cause(error)
            }
            StudyError::Settings(error) => error.into(),
            other => {
                let hint = "leave the option out, or do not vary the number";
                Self::new("sweep-refused", &other, hint).with_cause(other)
            }
        }
    }
}

impl From<CompareError> for SimulationError {
    fn from(error: CompareError) -> Self {
        let code = match error {
            CompareError::Read(error) => return error.into(),
            CompareError::Journal(JournalError::Interrupted) => INTERRUPTED,
            CompareError::NoReference(_) => "no-reference",
            _ => "settings-refused",
        };
        Self::new(code, &error, error.hint()).with_cause(error)
    }
}

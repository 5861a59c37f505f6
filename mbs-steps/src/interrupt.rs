//! Request from outside to end a run: a flag that the run reads between its steps.

use core::fmt::{self, Debug, Formatter};
use core::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;

/// Flag that ends a run after its current step. The default interrupt has no flag and never ends the run.
///
/// An interrupted run has its rows and summary up to that step, as any run that stops early. All interrupts compare as equal, because an
/// interrupt does not affect the settings of a run.
#[derive(Clone, Default)]
pub struct Interrupt(Option<Arc<AtomicBool>>);

impl Interrupt {
    /// Makes an interrupt from a flag that another part of the program sets, such as a signal handler.
    #[must_use]
    pub fn new(flag: Arc<AtomicBool>) -> Self {
        Self(Some(flag))
    }

    /// True if the run must end after the current step.
    #[must_use]
    pub fn is_set(&self) -> bool {
        self.0.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed))
    }
}

impl Debug for Interrupt {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("Interrupt")
    }
}

impl PartialEq for Interrupt {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

//! Handling of Ctrl-C and of requests to terminate: the first signal ends a command after its step, the second ends it at once.

use mbs::Interrupt;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Turns the signal of a file at the limit of its size into an error of writing, so that it does not end the process.
pub(crate) fn outlive_limits() {
    #[cfg(unix)]
    let _ = flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

/// Begins to catch signals. Returns a flag that the first signal sets. On a system without signals the flag is never set.
pub(crate) fn heeded() -> Interrupt {
    let is_set = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        // this handler is registered first: it ends the process only if an earlier signal has set the flag
        let _ = flag::register_conditional_default(signal, is_set.clone());
        let _ = flag::register(signal, is_set.clone());
    }
    Interrupt::new(is_set)
}

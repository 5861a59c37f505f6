//! Ctrl-C and a request to terminate: the first lets a command end after its step, the second ends it at once.

use mbs::Interrupt;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// From here on a file at the limit of its size is an error of its writing, by which no process ends.
pub(crate) fn outlive_limits() {
    #[cfg(unix)]
    let _ = flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

/// From here on signals are heeded by those who look at this. A system that gives no signals sets it never.
pub(crate) fn heeded() -> Interrupt {
    let is_set = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        // looked at before it is set: the second signal finds it
        let _ = flag::register_conditional_default(signal, is_set.clone());
        let _ = flag::register(signal, is_set.clone());
    }
    Interrupt::new(is_set)
}

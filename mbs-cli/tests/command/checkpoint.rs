//! Runs that are kept, and go on.

mod killed;
mod refused;

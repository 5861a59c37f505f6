//! Index-1.

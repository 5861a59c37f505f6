//! Starts that were wrong, or refused.

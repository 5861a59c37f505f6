//! Checks of a scene as a whole.

//! Laws outside the range in which they hold, and turns beyond one.

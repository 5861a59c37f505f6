//! Tests of runs with checkpoints, and of resumed runs.

mod killed;
mod refused;

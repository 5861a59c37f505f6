//! Equilibria, modes, and energy alarms of the scenes from users.

mod alarms;
mod modes;
mod rest;
mod units;

//! Equilibria and modes, and what an alarm takes for a fault.

mod alarms;
mod modes;
mod rest;
mod units;

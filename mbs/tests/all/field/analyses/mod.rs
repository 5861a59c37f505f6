//! Equilibria and modes, and what an alarm takes for a fault.

mod modes;
mod rest;
mod units;

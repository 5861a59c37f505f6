//! Equilibria and modes, and what an alarm takes for a fault.

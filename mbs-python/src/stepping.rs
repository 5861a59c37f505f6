//! Means to step a simulation: rows of inputs, and recordings of its motion.

use crate::array::{Numbers, wrong_shape};
use crate::recording::Tape;
use mbs::SimulationError;
use pyo3::prelude::*;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// Tapes on which a motion is recorded while it is stepped.
pub(crate) struct Tapes(pub(crate) Vec<Arc<Mutex<Tape>>>);

impl Tapes {
    /// Takes an instant where one is due.
    pub(crate) fn offer(&self, simulation: &mbs::Simulation) -> Result<(), SimulationError> {
        let offer = |tape: &Arc<Mutex<Tape>>| {
            tape.lock().unwrap_or_else(PoisonError::into_inner).offer(simulation)
        };
        self.0.iter().try_for_each(offer)
    }

    /// A step, which is recorded.
    pub(crate) fn step(
        &self,
        simulation: &mut mbs::Simulation,
        dt: f64,
    ) -> Result<(), SimulationError> {
        simulation.step(dt)?;
        self.offer(simulation)
    }

    /// Steps to a time; where it is recorded, by steps of the method's length as long as they fit.
    pub(crate) fn advance_to(
        &self,
        simulation: &mut mbs::Simulation,
        time: f64,
    ) -> Result<(), SimulationError> {
        let h = simulation.step_length();
        // what is left of less than one and a half steps is the other's
        while !self.0.is_empty() && simulation.time() + 1.5 * h <= time {
            self.step(simulation, h)?;
        }
        simulation.advance_to(time)?;
        self.offer(simulation)
    }
}

/// Rows of inputs of a call: all of them, or all but the forces.
pub(crate) struct InputRows {
    numbers: Vec<f64>,
    n: usize,
}

impl InputRows {
    /// Rows of all inputs; the forces that a row lacks are those of now.
    pub(crate) fn whole(self, own: usize, forces: Range<usize>, present: &[f64]) -> Vec<f64> {
        if self.n != own || forces.is_empty() {
            return self.numbers;
        }
        let whole = |row: &[f64]| {
            let (before, after) = row.split_at(forces.start);
            [before, &present[forces.clone()], after].concat()
        };
        self.numbers.chunks_exact(own.max(1)).flat_map(whole).collect()
    }
}

/// Inputs of a call: one row that is held, or a row for each of n steps; a row has one of two numbers of inputs.
pub(crate) fn inputs(
    u: &Bound<'_, PyAny>,
    sizes: [usize; 2],
    n: Option<usize>,
) -> PyResult<InputRows> {
    let numbers = Numbers::new(u, "u", false)?;
    let found = match *numbers.shape() {
        [found] => Some(found),
        [rows, found] if n == Some(rows) => Some(found),
        _ => None,
    };
    match found.filter(|found| sizes.contains(found)) {
        Some(n) => Ok(InputRows { numbers: numbers.into_data(), n }),
        None => {
            let nu = sizes[1];
            let rows = n.map_or_else(String::new, |n| format!(" or ({n}, {nu})"));
            Err(wrong_shape(u.py(), "u", numbers.shape(), &format!("({nu},){rows}")))
        }
    }
}

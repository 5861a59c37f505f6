//! A case: a scene with a difficulty, the step it is run with, and what its outputs are judged by.

use crate::gauntlet::vector::{Point, Turn};

/// A hard case, with its step and its truth.
#[derive(Debug)]
pub struct Case {
    /// Text of the scene.
    pub scene: String,
    /// Step, the largest where lengths are controlled [s].
    pub step: f64,
    /// Length by which errors are measured [m]; 1 where outputs are angles.
    pub size: f64,
    /// Options of the run, beside formulation and step.
    pub options: Options,
    /// Truth that the outputs are judged by.
    pub truth: Truth,
}

/// Options of the run of a case.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Options {
    /// Is the run in single precision?
    pub is_single: bool,
    /// Fixed penalty of the augmented formulations.
    pub penalty: Option<f64>,
}

/// Truth that the outputs of a case are compared with.
pub enum Truth {
    /// A closed form: all outputs at a time [s], in the order of the scene.
    Closed(Box<dyn Fn(f64) -> Vec<f64>>),
    /// The motion of a twin without the difficulty: its scene, and the image that carries its outputs to those of the case.
    Twin(String, Image),
    /// The case itself, in another formulation at a tenth of the step.
    Others,
    /// The case itself in relative coordinates by extrapolation to rounding.
    Extrapolated,
    /// Nothing but the energy invariant and the constraints: the motion is longer than it can be known.
    Invariants,
}

impl std::fmt::Debug for Truth {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Closed(_) => "Closed",
            Self::Twin(..) => "Twin",
            Self::Others => "Others",
            Self::Extrapolated => "Extrapolated",
            Self::Invariants => "Invariants",
        })
    }
}

/// Image of a point of the twin in the case: a turn, then a change of units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Image {
    /// Turn from the twin to the case.
    pub turn: Turn,
    /// Units of length of the case in one of the twin.
    pub scale: f64,
    /// Numbers of a point in the twin and in the case: 2 or 3.
    pub dimensions: [usize; 2],
}

impl Image {
    /// Makes the image that changes nothing.
    #[must_use]
    pub fn same(dimension: usize) -> Self {
        let turn = Turn([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        Self { turn, scale: 1.0, dimensions: [dimension; 2] }
    }

    /// All points of a row.
    #[must_use]
    pub fn of(&self, row: &[f64]) -> Vec<f64> {
        let [from, to] = self.dimensions;
        let carried = |point: &[f64]| {
            let full: Point = std::array::from_fn(|i| point.get(i).copied().unwrap_or(0.0));
            self.turn.of(full).map(|x| x * self.scale)
        };
        row.chunks(from).flat_map(|point| carried(point).into_iter().take(to)).collect()
    }
}

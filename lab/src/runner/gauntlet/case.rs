//! A case: a difficult scene, its step, and the truth with which its outputs are compared.

use crate::gauntlet::vector::{Point, Turn};

/// A difficult case, with its step and its truth.
#[derive(Debug)]
pub struct Case {
    /// Text of the scene.
    pub scene: String,
    /// Step of the run; the largest one where steps are controlled [s].
    pub step: f64,
    /// Length by which errors are measured [m]; 1 where outputs are angles.
    pub size: f64,
    /// Options of the run besides formulation and step.
    pub options: Options,
    /// Truth with which the outputs are compared.
    pub truth: Truth,
}

/// Options of the run of a case.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Options {
    /// True if the run is in single precision.
    pub is_single: bool,
    /// Fixed penalty factor of the augmented formulations.
    pub penalty: Option<f64>,
}

/// Truth that the outputs of a case are compared with.
pub enum Truth {
    /// A closed form: all outputs at a time [s], in the order of the scene.
    Closed(Box<dyn Fn(f64) -> Vec<f64>>),
    /// The motion of an equivalent mechanism without the difficulty: its scene, and the map of its outputs to those of the case.
    Twin(String, Image),
    /// Runs of the case in other formulations with a tenth of the step.
    Others,
    /// A run of the case in relative coordinates by extrapolation, to machine precision.
    Extrapolated,
    /// The energy balance and the constraints alone: the motion is too long for its positions to be predictable.
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

/// Map of a point of the equivalent mechanism to the case: a rotation, then a change of units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Image {
    /// Rotation from the equivalent mechanism to the case.
    pub turn: Turn,
    /// Number of the case's units of length in a unit of the equivalent mechanism.
    pub scale: f64,
    /// Numbers of coordinates of a point in the equivalent mechanism and in the case: 2 or 3.
    pub dimensions: [usize; 2],
}

impl Image {
    /// Makes the identity map.
    #[must_use]
    pub fn same(dimension: usize) -> Self {
        let turn = Turn([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        Self { turn, scale: 1.0, dimensions: [dimension; 2] }
    }

    /// Maps all points of a row.
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

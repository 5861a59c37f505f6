//! Axes in which an output has the components of its vectors.
//!
//! ```text
//! x_f = R_f^T R_o x_o     o: body of the default axes, f: body of the required axes, R: rotation matrix of a body
//! ```

use super::frame::Frame;
use super::quantity::magnitudes;
use crate::Real;
use crate::algebra::Vector;
use crate::mechanism::{Output, Scene};
use crate::model::State;
use crate::natural::NaturalModel;
use alloc::vec::Vec;
use core::ops::Range;

/// Rotation of the vectors of an output into the axes of a body.
#[derive(Debug, Clone)]
pub(super) struct OutputAxes<T: Real, const D: usize> {
    /// Axes of the quantity before the rotation.
    own: Frame<T, D>,
    required: Frame<T, D>,
    /// Range of each vector among the components. Other components do not change.
    vectors: Vec<Range<usize>>,
}

impl<T: Real, const D: usize> OutputAxes<T, D> {
    /// Rotation for an output; `None` if the output keeps the axes of its quantity.
    pub(super) fn new(
        output: &Output<T>,
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
    ) -> Option<Self> {
        let (own, required) = (output.quantity.axes(), output.frame?);
        let vectors = magnitudes(&output.quantity.components(scene)).into_iter();
        (own != required).then(|| Self {
            own: Frame::new(model, own),
            required: Frame::new(model, required),
            vectors: vectors.map(|vector| vector.places).collect(),
        })
    }

    /// Rotates the components at one instant. Cost: two rotation matrices, and their product with each vector.
    pub(super) fn turn(&self, state: &State<T>, components: &mut [T]) {
        let [own, required] = [&self.own, &self.required].map(|frame| frame.rotation(&state.q));
        let turn = required.transpose() * own;
        for places in &self.vectors {
            let vector = &mut components[places.clone()];
            let in_space = |i: usize| vector.get(i).copied().unwrap_or(T::ZERO);
            let turned = turn * Vector::<T, 3>::from_fn(|i, _| in_space(i));
            vector.copy_from_slice(&turned.as_slice()[..vector.len()]);
        }
    }
}

//! Construction of a [`NaturalModel`] from a scene, in the order of the passes.

use super::build::Builder;
use super::error::ModelError;
use super::layout::layout;
use super::model::NaturalModel;
use crate::Real;
use crate::effects::action::Actions;
use crate::mechanism::Scene;
use crate::mechanism::align::aligned;

#[cfg(feature = "instances")]
type New<T, const D: usize> = fn(&Scene<T>) -> Result<NaturalModel<T, D>, ModelError>;
#[cfg(feature = "instances")]
mbs_math::instances!(NEW: New<T, D> = NaturalModel::<T, D>::build);

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Builds the natural-coordinate model of a scene with the fewest coordinates.
    ///
    /// # Errors
    /// [`ModelError`] if the scene's dimension is not D, or a body's data leave a point undefined.
    pub fn new(scene: &Scene<T>) -> Result<Self, ModelError> {
        #[cfg(feature = "instances")]
        if T::HAS_INSTANCES {
            return mbs_math::once::found::<New<T, D>>(NEW)(scene);
        }
        Self::build(scene)
    }

    fn build(scene: &Scene<T>) -> Result<Self, ModelError> {
        if scene.dimension.count() != D {
            return Err(ModelError::Dimension);
        }
        let scene = &*aligned(scene);
        let actions = Actions::new(scene)?;
        let mut builder = Builder::new(scene, &actions)?;
        builder.add_bodies();
        for joint in 0..scene.joints.len() {
            builder.add_joint(joint);
        }
        builder.add_guides();
        builder.add_couplings();
        builder.add_rollings();
        builder.add_rotors();
        builder.add_effects(&actions.list)?;
        let feedback = actions.prescribed.feedback();
        builder.add_measured(&feedback);
        Ok(layout(builder, actions, feedback))
    }
}

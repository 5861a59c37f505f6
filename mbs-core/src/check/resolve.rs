//! Conversion of a scene of decimal numbers to the scalar of a run.

use crate::Real;
use crate::joint::Dimension;
use crate::mechanism::Scene;
use crate::scene::{Number, SceneError, SceneFault};

#[cfg(feature = "instances")]
type Resolve<T> = fn(&Scene<Number>) -> Result<Scene<T>, SceneError>;
#[cfg(feature = "instances")]
mbs_math::instances!(RESOLVE: Resolve<T> = Scene::resolve_here::<T>, {});

impl Scene<Number> {
    /// Scene in the precision `T`, checked. Every number is the one of `T` nearest to its decimal text.
    ///
    /// Cost: a copy of the scene; in precisions other than `f64` also the reading of each number.
    ///
    /// # Errors
    /// The errors of [`Scene::check`]. [`SceneFault::NoMovedMass`] for a stiffness that does not follow from the scene.
    /// [`SceneFault::InCode`] for an effect with a user-defined law in code, whose precision is fixed. In space [`SceneFault::WrongCount`]
    /// for a vector of two numbers.
    pub fn resolve<T: Real>(&self) -> Result<Scene<T>, SceneError> {
        #[cfg(feature = "instances")]
        if T::HAS_INSTANCES {
            return mbs_math::once::found::<Resolve<T>>(RESOLVE)(self);
        }
        self.resolve_here()
    }

    fn resolve_here<T: Real>(&self) -> Result<Scene<T>, SceneError> {
        let is_spatial = self.dimension == Dimension::Spatial;
        let (mut has_two, not_a_number) = (false, T::from_f64(f64::NAN));
        let mut scene = self.map(&mut |x: &Number| {
            let is_missing = is_spatial && x.is_absent();
            has_two |= is_missing;
            // the check then reports the place of the NaN
            if is_missing { not_a_number } else { x.value() }
        })?;
        scene.name_points();
        let drawn = super::drawn::fill(&mut scene);
        // the duration may be an assumed number, which is no missing component of a vector
        scene.duration = self.duration.value();
        match scene.check() {
            Ok(()) => {
                drawn?;
                super::open::fill(self, &mut scene)?;
                Ok(scene)
            }
            Err(SceneError { fault: SceneFault::NotFinite, entry, field }) if has_two => {
                let fault = SceneFault::WrongCount { needed: 3, found: 2 };
                Err(SceneError { entry, field, fault })
            }
            Err(error) => Err(error),
        }
    }
}

//! From a scene of decimal numbers to one in the scalar of a run.

use crate::Real;
use crate::joint::Dimension;
use crate::mechanism::Scene;
use crate::scene::{Number, SceneError, SceneFault};

#[cfg(feature = "instances")]
type Resolve<T> = fn(&Scene<Number>) -> Result<Scene<T>, SceneError>;
#[cfg(feature = "instances")]
mbs_math::instances!(RESOLVE: Resolve<T> = Scene::resolve_here::<T>, {});

impl Scene<Number> {
    /// The scene in the precision `T`, checked: every number is the one of `T` nearest to its decimal text.
    ///
    /// Cost: a copy of the scene; beyond `f64` and below it that of reading each number.
    ///
    /// # Errors
    /// What [`Scene::check`] refuses; [`SceneFault::NoMovedMass`] for a stiffness that does not follow from the scene; [`SceneFault::InCode`] for an effect that is a law in code, which has a precision of its own. In
    /// space [`SceneFault::WrongCount`] for a vector that was given by two numbers.
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
            // the check then finds its place
            if is_missing { not_a_number } else { x.value() }
        })?;
        scene.name_points();
        let drawn = super::drawn::fill(&mut scene);
        // may be assumed
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

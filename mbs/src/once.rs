//! Functions that are compiled in this crate, once for each scalar and dimension, whoever calls them.
//!
//! An optimised build compiles a generic function anew in every crate that calls it. What assembles, builds and measures a scene is most of a
//! program; crates that call it through these tables have none of it.

use crate::stop::StopError;
use core::any::Any;

/// One function for each scalar and dimension.
pub(crate) type Table = [&'static (dyn Any + Sync)];

/// The function of this type.
///
/// # Errors
/// [`StopError::NotBuilt`] for a scalar that this build has no steps in.
pub(crate) fn find<F: Copy + 'static>(table: &'static Table) -> Result<F, StopError> {
    let same = |function: &&(dyn Any + Sync)| (*function as &dyn Any).downcast_ref::<F>().copied();
    table.iter().find_map(same).ok_or(StopError::NotBuilt)
}

/// Makes a table of a generic function, whose type is an alias with the same parameters.
macro_rules! once {
    ($table:ident: $kind:ident = $function:ident) => {
        static $table: &$crate::once::Table = &[
            &($function::<f64, 2> as $kind<f64, 2>),
            &($function::<f64, 3> as $kind<f64, 3>),
            #[cfg(feature = "f32")]
            &($function::<f32, 2> as $kind<f32, 2>),
            #[cfg(feature = "f32")]
            &($function::<f32, 3> as $kind<f32, 3>),
            #[cfg(feature = "dd")]
            &($function::<mbs_core::real::DoubleDouble, 2>
                as $kind<mbs_core::real::DoubleDouble, 2>),
            #[cfg(feature = "dd")]
            &($function::<mbs_core::real::DoubleDouble, 3>
                as $kind<mbs_core::real::DoubleDouble, 3>),
        ];
    };
}
pub(crate) use once;

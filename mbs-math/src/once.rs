//! Functions that are compiled once, in the crate that owns them, for each scalar and dimension that programs use.
//!
//! An optimised build compiles a generic function anew in every crate that calls it. An owner lists its large functions in a table with
//! [`instances!`](crate::instances), behind its feature `instances`; callers reach them by type, and have none of their code. It is for what
//! is done once for a scene or a run: nothing in a step goes through a table.

use core::any::Any;

/// One function for each scalar and dimension.
pub type InstanceTable = [&'static (dyn Any + Sync)];

/// The function of this type; `None` where its scalar or dimension is not built.
///
/// Cost: a comparison for each entry of the table.
#[must_use]
pub fn find<F: Copy + 'static>(table: &InstanceTable) -> Option<F> {
    table.iter().find_map(|function| (*function as &dyn Any).downcast_ref::<F>().copied())
}

/// The function of this type, of a scalar whose [`HAS_INSTANCES`](crate::Real::HAS_INSTANCES) holds.
///
/// # Panics
/// For a dimension beside the plane and space.
#[must_use]
pub fn found<F: Copy + 'static>(table: &InstanceTable) -> F {
    find(table).expect("a scalar that has instances is in every table, in the plane and in space")
}

/// Makes a table of a generic function, for `f64`, and for `f32` and `dd` where the crate has these features.
///
/// `T` names the scalar; the last argument lists what else varies. Without it, `D` is the plane and space. A table that begins with `f64` has
/// no other scalar.
///
/// ```
/// use mbs_math::{Real, instances, once};
///
/// type Length<T, const D: usize> = fn([T; D]) -> T;
/// fn largest<T: Real, const D: usize>(v: [T; D]) -> T {
///     v.into_iter().fold(T::ZERO, T::max)
/// }
/// instances!(LARGEST: Length<T, D> = largest::<T, D>);
/// let largest = once::found::<Length<f64, 2>>(LARGEST);
/// assert_eq!(largest([1.0, 2.0]), 2.0);
/// assert_eq!(once::find::<Length<f64, 7>>(LARGEST), None);
/// ```
#[macro_export]
macro_rules! instances {
    ($table:ident: $kind:ty = $function:expr) => {
        $crate::instances!($table: $kind = $function, { const D: usize = 2; } { const D: usize = 3; });
    };
    (f64 $table:ident: $kind:ty = $function:expr) => {
        static $table: &$crate::once::InstanceTable = &[
            &{
                /// Dimensions of the plane [-].
                const D: usize = 2;
                $function as $kind
            },
            &{
                /// Dimensions of space [-].
                const D: usize = 3;
                $function as $kind
            },
        ];
    };
    ($table:ident: $kind:ty = $function:expr, $({ $($item:item)* })+) => {
        static $table: &$crate::once::InstanceTable = &[$(
            &{
                type T = f64;
                $($item)*
                $function as $kind
            },
            #[cfg(feature = "f32")]
            &{
                type T = f32;
                $($item)*
                $function as $kind
            },
            #[cfg(feature = "dd")]
            &{
                type T = $crate::real::DoubleDouble;
                $($item)*
                $function as $kind
            },
        )+];
    };
}

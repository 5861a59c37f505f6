//! Tables of functions that are compiled once, in the crate that owns them, for each scalar and dimension that programs use.
//!
//! An optimised build compiles a generic function again in every crate that calls it. To avoid this, a crate lists its large functions in a
//! table with [`instances!`](crate::instances), behind its feature `instances`. Other crates find a function by its type, and do not
//! compile its code. Tables are for functions that run once for a scene or a run; nothing within a step uses a table.

use core::any::Any;

/// Table of one function, compiled for several scalars and dimensions.
pub type InstanceTable = [&'static (dyn Any + Sync)];

/// The function of type `F`; `None` when the table has no entry for its scalar or dimension.
///
/// Cost: one comparison of types for each entry of the table.
#[must_use]
pub fn find<F: Copy + 'static>(table: &InstanceTable) -> Option<F> {
    table.iter().find_map(|function| (*function as &dyn Any).downcast_ref::<F>().copied())
}

/// The function of type `F`. Its scalar must be one for which [`HAS_INSTANCES`](crate::Real::HAS_INSTANCES) is true.
///
/// # Panics
/// If the table has no entry of this type, as for a dimension other than 2 and 3.
#[must_use]
pub fn found<F: Copy + 'static>(table: &InstanceTable) -> F {
    find(table).expect("a scalar that has instances is in every table, in the plane and in space")
}

/// Makes a table of a generic function for `f64`, and for `f32` and `dd` when the crate has these features.
///
/// `T` is the name of the scalar in the type and the function. The last argument lists the other generic arguments; without it, the table has
/// an entry for `D` = 2 and one for `D` = 3. Only `f64` is the scalar of a table whose arguments begin with `f64`.
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

//! Enums whose values have names.

/// Defines an enum with `ALL` of its values, their `NAMES` in the same order, and the method `name`.
#[doc(hidden)]
#[macro_export]
macro_rules! named {
    ($(#[$of:meta])* pub enum $kind:ident { $($(#[$about:meta])* $value:ident = $name:literal,)* }) => {
        $(#[$of])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub enum $kind { $($(#[$about])* $value,)* }

        impl $kind {
            /// All values, in the order of the enum.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$value),*];
            /// Names of all values, in the same order.
            pub const NAMES: [&str; Self::ALL.len()] = [$($name),*];

            /// Name of the value.
            #[must_use]
            pub fn name(self) -> &'static str {
                Self::NAMES[self as usize]
            }
        }
    };
}

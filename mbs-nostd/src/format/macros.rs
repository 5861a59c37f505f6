//! Macros that generate reading, writing and source from a list of fields.

/// Implements the format of a struct from its fields.
macro_rules! record_struct {
    ([$($bounds:tt)*] $type:ty = $name:ident { $($field:tt),* $(,)? }) => {
        impl<$($bounds)*> $crate::format::Record for $type {
            fn read(
                from: &mut $crate::format::Reader<'_>,
            ) -> Result<Self, $crate::check::LoadError> {
                Ok($name { $($field: $crate::format::Record::read(from)?),* })
            }
            #[cfg(feature = "export")]
            fn write(&self, to: &mut $crate::format::Bytes) -> bool {
                $($crate::format::Record::write(&self.$field, to))&&*
            }
            #[cfg(feature = "export")]
            fn source(&self, to: &mut alloc::string::String) {
                $crate::format::open(stringify!($name), to);
                $(
                    $crate::format::name(stringify!($field), to);
                    $crate::format::Record::source(&self.$field, to);
                )*
                $crate::format::close(to);
            }
        }
    };
}

/// Implements the format of an enum from its variants. Each variant has a number and fields. A field is given by a name or by its position.
macro_rules! record_enum {
    ([$($bounds:tt)*] $type:ty = $name:ident {
        $($(#[$meta:meta])* $tag:literal $variant:ident { $($field:tt $own:ident),* }),* $(,)?
    }) => {
        impl<$($bounds)*> $crate::format::Record for $type {
            fn read(
                from: &mut $crate::format::Reader<'_>,
            ) -> Result<Self, $crate::check::LoadError> {
                match u32::read(from)? {
                    $(
                        $(#[$meta])*
                        $tag => Ok($name::$variant {
                            $($field: $crate::format::Record::read(from)?),*
                        }),
                    )*
                    _ => Err(from.fault(4)),
                }
            }
            #[cfg(feature = "export")]
            #[allow(unreachable_patterns, unused_variables, reason = "some effects may be left out")]
            fn write(&self, to: &mut $crate::format::Bytes) -> bool {
                match self {
                    $(
                        $(#[$meta])*
                        $name::$variant { $($field: $own),* } => {
                            let tag: u32 = $tag;
                            tag.write(to) $(&& $crate::format::Record::write($own, to))*
                        }
                    )*
                    _ => false,
                }
            }
            #[cfg(feature = "export")]
            #[allow(unreachable_patterns, unused_variables, reason = "some effects may be left out")]
            fn source(&self, to: &mut alloc::string::String) {
                match self {
                    $(
                        $(#[$meta])*
                        $name::$variant { $($field: $own),* } => {
                            $crate::format::open(
                                concat!(stringify!($name), "::", stringify!($variant)),
                                to,
                            );
                            $(
                                $crate::format::name(stringify!($field), to);
                                $crate::format::Record::source($own, to);
                            )*
                            $crate::format::close(to);
                        }
                    )*
                    _ => to.push_str("NotExported"),
                }
            }
        }
    };
}

pub(super) use {record_enum, record_struct};

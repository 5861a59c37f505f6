//! Format of force laws and their tables. The order of the numbers of each law is defined in mbs-core.

#[cfg(feature = "export")]
use super::{Bytes, Source};
use super::{Reader, Record};
use crate::check::LoadError;
#[cfg(feature = "export")]
use alloc::string::String;
use mbs_core::Real;
use mbs_core::laws::body::BodyLaw;
use mbs_core::laws::entry::EntryReader;
use mbs_core::laws::scalar::Law;

impl<T: Real + Record> EntryReader<T> for Reader<'_> {
    type Error = LoadError;

    fn real(&mut self) -> Result<T, LoadError> {
        T::read(self)
    }
    fn word(&mut self) -> Result<u32, LoadError> {
        u32::read(self)
    }
    fn fault(&self) -> LoadError {
        self.fault(4)
    }
}

macro_rules! law {
    ($Law:ident) => {
        impl<T: Real + Record> Record for $Law<T> {
            fn read(from: &mut Reader<'_>) -> Result<Self, LoadError> {
                Self::read(from)
            }
            #[cfg(feature = "export")]
            fn write(&self, to: &mut Bytes) -> bool {
                self.write::<Bytes>(to)
            }
            #[cfg(feature = "export")]
            fn source(&self, to: &mut String) {
                self.write(&mut Source(to));
            }
        }
    };
}
law!(Law);
law!(BodyLaw);

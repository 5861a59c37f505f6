//! Values of channels, listed by name.

use serde::ser::{Serialize, SerializeMap, Serializer};

/// Values of channels with their names, in order. In JSON, a single value is a number, and several values are a list.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Outputs<V = f64>(pub Vec<(String, Vec<V>)>);

impl<V: Serialize> Serialize for Outputs<V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (name, values) in &self.0 {
            match values.as_slice() {
                [one] => map.serialize_entry(name, one)?,
                several => map.serialize_entry(name, several)?,
            }
        }
        map.end()
    }
}

//! JSON keys with two names. The value is written twice: under the first name, which is the contract, and under the second name.

use serde::ser::{Serialize, SerializeMap, Serializer};

/// Defines a function for each pair of names. The functions serve `#[serde(flatten, serialize_with = ..)]`.
macro_rules! two_names {
    ($($function:ident: $old:literal, $new:literal;)*) => {$(
        pub fn $function<S: Serializer>(value: &impl Serialize, to: S) -> Result<S::Ok, S::Error> {
            let mut map = to.serialize_map(Some(2))?;
            map.serialize_entry($old, value)?;
            map.serialize_entry($new, value)?;
            map.end()
        }
    )*};
}

two_names! {
    over_chosen: "over_chosen", "cost_ratio";
    basis: "basis", "prediction_basis";
    out: "out", "rejected";
    prices: "prices", "effect_costs";
    changes: "changes", "output_changes";
    rods: "rods", "thin_rods";
    what: "what", "description";
}

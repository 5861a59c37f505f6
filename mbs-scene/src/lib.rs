#![doc = include_str!("../README.md")]

mod dice;
pub mod format;
mod generate;
pub mod keys;
pub mod manual;
mod read;
pub mod templates;
mod write;

pub use dice::Dice;
pub use generate::{Family, GenerateError, MOST_BODIES, generate};
pub use mbs_core::outputs::Component;
pub use mbs_mesh::{MESH_ENDINGS, MeshFault, Solid, TriangleMesh, VolumeRule, hull, mesh_ending};
pub use read::{
    Place, ReadError, ReadFault, SceneFile, SceneSweep, SweepFault, SweepRefusal, SweepSource,
    nearest_name,
};
pub use write::{WriteError, quoted, to_toml};

/// Items for the tests of this crate; they are not part of its interface.
#[doc(hidden)]
pub mod inside {
    pub use crate::generate::text::number;
    pub use crate::manual::groups::{entries, groups};
    pub use crate::read::nearest::nearest;
    pub use crate::read::sweep::path::{PathPart, parse};
    pub use crate::read::sweep::values::ValueRange;

    pub mod expression {
        pub use crate::read::expression::unit::of_key;
        pub use crate::read::expression::{Evaluated, EvaluationFault, evaluate};
    }

    pub mod hints {
        pub use crate::read::hints::{HINTS, Hint, of_word};
    }

    pub mod keys {
        pub use crate::keys::{of, of_kind};
    }

    pub mod units {
        pub use crate::read::units::{hint, of_json, of_line};
    }
}

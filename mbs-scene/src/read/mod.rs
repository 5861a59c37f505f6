//! Reading of scene files: text → syntax tree with places → scene data in any precision.

mod body;
mod coupling;
mod document;
mod edit;
mod effect;
mod error;
mod expression;
mod fields;
mod frame;
mod guided;
mod hints;
mod include;
mod joint;
mod json;
mod measured;
mod motion;
mod named;
mod names;
mod nearest;
mod number;
mod output;
mod place;
mod point;
mod prefix;
mod road;
mod rolling;
mod scene;
mod set;
mod shape;
mod signal;
mod sweep;
mod syntax;
#[cfg(test)]
mod tests;
mod texts;
pub(crate) mod tree;
mod units;
mod values;

pub use document::SceneFile;
pub use error::{ReadError, ReadFault};
pub use nearest::nearest_name;
pub use place::Place;
pub use sweep::{SweepFault, SweepFile};

//! Writes `[road]`: one list of features for all wheels, or one list for each side.

use super::{Keys, Node, Writer, list};
use mbs_core::scene::{Number, Road, RoadFeature};

impl Writer<'_> {
    /// The table of the road; `None` when the scene has no road.
    pub(super) fn road(self) -> Option<Keys> {
        let Road { left, right, speed } = &self.scene.road;
        let (mut keys, features) = (Keys::default(), |track: &[RoadFeature<Number>]| {
            list(track.iter().map(|f| feature(f).into()))
        });
        if !speed.is_zero() {
            keys.push("speed", speed);
        }
        if left != right {
            keys.push("left", features(left));
            keys.push("right", features(right));
        } else if !left.is_empty() {
            keys.push("features", features(left));
        }
        (!keys.0.is_empty()).then_some(keys)
    }
}

fn feature(feature: &RoadFeature<Number>) -> Keys {
    let mut keys = Keys::default();
    match feature {
        RoadFeature::Flat { height } => {
            keys.push("kind", "flat");
            keys.push("height", height);
        }
        RoadFeature::Rise { start, length, height, rounding } => {
            keys.push("kind", "ramp");
            keys.push("start", start);
            keys.push("length", length);
            keys.push("height", height);
            keys.push_some("rounding", (!rounding.is_computed()).then_some(rounding));
        }
        RoadFeature::Stairs { start, tread, riser, height, count } => {
            keys.push("kind", "stairs");
            keys.push("start", start);
            keys.push("tread", tread);
            keys.push("riser", riser);
            keys.push("height", height);
            keys.push("count", Node::Number(count.to_string()));
        }
        RoadFeature::Bump { start, length, amplitude } => {
            keys.push("kind", "bump");
            keys.push("start", start);
            keys.push("length", length);
            keys.push("amplitude", amplitude);
        }
        RoadFeature::Table(points) => {
            keys.push("kind", "table");
            keys.push("points", list(points.iter().map(Node::from)));
        }
        RoadFeature::Shaped { points, shape } => {
            keys.push("kind", "table");
            keys.push("points", list(points.iter().map(Node::from)));
            keys.push("interpolation", shape.name());
        }
    }
    keys
}

//! Drawn road along the path of the tires: heights at points along x.

use crate::record::{BodyPlace, DrawnRoad, RecordedMotion, RoadStrip};
use mbs_core::Real;
use mbs_core::actions::track_heights;
use mbs_core::scene::{Dimension, RoadFeature, Scene};

/// Distance of neighbouring points of a drawn road [m]. An edge that is rounded over 0.3 m has three points.
const SPACING: f64 = 0.1;
/// Length of road before and after the path of the tires [m].
const MARGIN: f64 = 3.0;
/// Largest number of points along a road [-]. At the default distance of the points it suffices for four hundred metres.
const MAX_PLACES: f64 = 4000.0;
/// Half width of the strip of one track, if the two tracks have different heights, relative to the distance of the tracks [-].
const TRACK: f64 = 0.35;
/// Half width of a planar road, relative to the scene's length [-].
const PLANAR: f64 = 0.3;

/// Returns the road of a scene with tires; `None` without tires. The road covers the path of all tires, with a margin at both ends.
pub(super) fn under<T: Real>(scene: &Scene<T>, motion: &RecordedMotion) -> Option<DrawnRoad> {
    let enabled = scene.effects.iter().filter(|effect| effect.enabled);
    let wheels = enabled.filter_map(|effect| effect.kind.road_wheel());
    let ways: Vec<BodyPlace> =
        wheels.map(|wheel| super::drawing::place(scene, wheel.body, wheel.center)).collect();
    let pictures = 0..motion.times.len();
    let places = pictures.flat_map(|k| ways.iter().filter_map(move |way| motion.place(k, way)));
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for place in places.filter(|place| place.iter().all(|x| x.is_finite())) {
        for i in 0..2 {
            low[i] = low[i].min(place[i]);
            high[i] = high[i].max(place[i]);
        }
    }
    if !(low[0] <= high[0]) {
        return None;
    }
    let speed = scene.road.speed.to_f64();
    let travelled = speed * motion.times.last().copied().unwrap_or(0.0);
    let start = low[0] + travelled.min(0.0) - MARGIN;
    let length = high[0] + travelled.max(0.0) + MARGIN - start;
    let spacing = SPACING.max(length / MAX_PLACES);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most the number of places"
    )]
    let n = (length / spacing).clamp(1.0, MAX_PLACES) as u32;
    let at: Vec<T> = (0..=n).map(|i| T::from_f64(start + f64::from(i) * spacing)).collect();
    let strip = |sides: [f64; 2], track: &[RoadFeature<T>]| RoadStrip {
        sides,
        heights: track_heights(track, &at).into_iter().map(Real::to_f64).collect(),
    };
    let road = &scene.road;
    let strips = if scene.dimension == Dimension::Planar {
        vec![strip([-PLANAR * motion.length, PLANAR * motion.length], &road.left)]
    } else if road.left == road.right {
        let margin = (high[1] - low[1]).max(1.0) / 2.0;
        vec![strip([low[1] - margin, high[1] + margin], &road.left)]
    } else {
        let half = TRACK * (high[1] - low[1]);
        let of = |y: f64, track: &[RoadFeature<T>]| strip([y - half, y + half], track);
        vec![of(high[1], &road.left), of(low[1], &road.right)]
    };
    Some(DrawnRoad { start, spacing, strips, speed })
}

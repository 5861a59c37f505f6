//! Checks of the road: its features, and whether every wheel can roll through its hollows.

use crate::Real;
use crate::measure::knots;
use crate::mechanism::Scene;
use crate::scene::place::{Place, is_planar};
use crate::scene::{
    CurveShape, Entry, Interpolation, Road, RoadFeature, SceneError, SceneFault, TableEnds,
};

pub(super) fn check<T: Real>(scene: &Scene<T>) -> Result<(), SceneError> {
    let Road { left, right, speed } = &scene.road;
    let place = scene.place(Entry::Road);
    place.finite("speed", *speed)?;
    let wheel = largest_wheel(scene);
    let left = left.iter().enumerate().map(|(i, feature)| (Entry::RoadLeft(i), feature));
    let right = right.iter().enumerate().map(|(i, feature)| (Entry::RoadRight(i), feature));
    for (entry, feature) in left.chain(right) {
        let place = scene.place(entry);
        numbers(feature, place)?;
        hollow(feature, wheel, place)?;
    }
    if is_planar(scene.dimension) && scene.road.left != scene.road.right {
        return place.fault("right", SceneFault::NeedsSpatial);
    }
    Ok(())
}

fn numbers<T: Real>(feature: &RoadFeature<T>, place: Place) -> Result<(), SceneError> {
    match feature {
        RoadFeature::Flat { height } => place.finite("height", *height),
        RoadFeature::Rise { start, length, height, rounding } => {
            place.finite("start", *start)?;
            place.positive("length", *length)?;
            place.finite("height", *height)?;
            place.positive("rounding", *rounding)?;
            let most = *length * T::HALF;
            if *rounding > most {
                let (rounding, most) = (rounding.to_f64(), most.to_f64());
                return place.fault("rounding", SceneFault::LongRounding { rounding, most });
            }
            Ok(())
        }
        RoadFeature::Stairs { start, tread, riser, height, count } => {
            place.finite("start", *start)?;
            place.not_negative("tread", *tread)?;
            place.positive("riser", *riser)?;
            place.finite("height", *height)?;
            if *count == 0 {
                return place.fault("count", SceneFault::WrongCount { needed: 1, found: 0 });
            }
            Ok(())
        }
        RoadFeature::Bump { start, length, amplitude } => {
            place.finite("start", *start)?;
            place.positive("length", *length)?;
            place.finite("amplitude", *amplitude)
        }
        RoadFeature::Table(points) | RoadFeature::Shaped { points, .. } => {
            if points.is_empty() {
                return place.fault("points", SceneFault::WrongCount { needed: 1, found: 0 });
            }
            for x in points.as_flattened() {
                place.finite("points", *x)?;
            }
            match points.windows(2).position(|pair| !(pair[0][0] < pair[1][0])) {
                Some(i) => place.fault("points", SceneFault::PointOrder(i + 1)),
                None => Ok(()),
            }
        }
    }
}

/// Radius of the largest wheel. All wheels can roll through a hollow if the largest one can.
fn largest_wheel<T: Real>(scene: &Scene<T>) -> T {
    let wheels = scene.effects.iter().filter_map(|effect| effect.kind.road_wheel());
    wheels.map(|wheel| wheel.radius).fold(T::ZERO, T::max)
}

/// Checks that a hollow is wider than the wheel, so that they touch in one point only. The condition is h'' R < 1, with the height h and
/// the wheel's radius R.
fn hollow<T: Real>(feature: &RoadFeature<T>, wheel: T, place: Place) -> Result<(), SceneError> {
    let (field, curvature) = match feature {
        RoadFeature::Flat { .. } => return Ok(()),
        RoadFeature::Rise { length, height, rounding, .. } => {
            // one of the two corners is hollow, whether the rise goes up or down
            ("height", height.abs() / ((*length - *rounding) * *rounding))
        }
        RoadFeature::Stairs { riser, height, .. } => {
            let rounding = *riser * T::HALF;
            ("height", height.abs() / ((*riser - rounding) * rounding))
        }
        RoadFeature::Bump { length, amplitude, .. } => {
            // a bump is hollow at both ends, a hole in its middle
            let k = T::TWO * T::PI / *length;
            ("length", amplitude.abs() * k * k)
        }
        RoadFeature::Table(points) => {
            ("points", largest_curvature(points, Interpolation::Spline(TableEnds::Natural)))
        }
        // without a wheel, corners are allowed
        RoadFeature::Shaped { shape: CurveShape::Linear, .. } if wheel.is_zero() => return Ok(()),
        RoadFeature::Shaped { shape: CurveShape::Linear, .. } => {
            return place.fault("interpolation", SceneFault::LinearTable);
        }
        RoadFeature::Shaped { points, shape } => {
            ("points", largest_curvature(points, (*shape).into()))
        }
    };
    if curvature * wheel < T::ONE {
        return Ok(());
    }
    let hollow = (T::ONE / curvature).to_f64();
    place.fault(field, SceneFault::TightHollow { hollow, wheel: wheel.to_f64() })
}

/// Largest curvature of a piecewise cubic function. Its second derivative is linear between knots, so the knots are sufficient.
fn largest_curvature<T: Real>(points: &[[T; 2]], way: Interpolation) -> T {
    knots(points, way, false).1.into_iter().fold(T::ZERO, T::max)
}

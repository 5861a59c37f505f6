//! Road of a scene as tables of laws. The tables are filled when the first wheel needs them.

use super::Tables;
use super::compile::{Compiler, part};
use crate::Real;
use crate::inputs::SignalInput;
use crate::laws::Part;
use crate::laws::road::{Feature, height};
use crate::measure::knots;
use crate::scene::{Interpolation, RoadFeature, TableEnds};
use alloc::vec::Vec;

impl<T: Real> Compiler<'_, T> {
    /// Tracks of the left and the right wheels, and the signal of a moving road.
    pub(crate) fn roads(&mut self) -> ([Part; 2], Option<u32>) {
        if let Some(roads) = self.roads {
            return roads;
        }
        let road = self.among.road;
        let tables = &mut self.actions.tables;
        let left = tables.track(&road.left);
        let right = if road.left == road.right { left } else { tables.track(&road.right) };
        let travel = (!road.speed.is_zero()).then(|| self.input(SignalInput::travel(road.speed)));
        *self.roads.insert(([left, right], travel))
    }
}

impl<T: Real> Tables<T> {
    /// Adds the features of a track to the tables, and returns their range.
    fn track(&mut self, features: &[RoadFeature<T>]) -> Part {
        let first = self.features.len();
        for feature in features {
            let feature = match feature {
                RoadFeature::Flat { height } => Feature::Flat(*height),
                RoadFeature::Rise { start, length, height, rounding } => Feature::Rise {
                    start: *start,
                    length: *length,
                    height: *height,
                    rounding: *rounding,
                },
                RoadFeature::Stairs { start, tread, riser, height, count } => {
                    let rise = |i: u32| Feature::Rise {
                        start: *start + T::from_f64(f64::from(i)) * (*tread + *riser),
                        length: *riser,
                        height: *height,
                        rounding: *riser * T::HALF,
                    };
                    self.features.extend((0..*count).map(rise));
                    continue;
                }
                RoadFeature::Bump { start, length, amplitude } => {
                    Feature::Bump { start: *start, length: *length, amplitude: *amplitude }
                }
                RoadFeature::Table(points) => {
                    self.spline(points, Interpolation::Spline(TableEnds::Natural))
                }
                RoadFeature::Shaped { points, shape } => self.spline(points, (*shape).into()),
            };
            self.features.push(feature);
        }
        part(first, self.features.len())
    }

    fn spline(&mut self, points: &[[T; 2]], way: Interpolation) -> Feature<T> {
        let first = self.knots.len();
        let (knots, curvatures) = knots(points, way, false);
        self.knots.extend(knots);
        self.curvatures.extend(curvatures);
        Feature::Spline(part(first, self.knots.len()))
    }
}

/// Heights of a track [m] at places along x [m]. Zero if the Cargo feature of tires is off.
///
/// Cost: one pass over the features of the track for each place.
#[must_use]
pub fn track_heights<T: Real>(track: &[RoadFeature<T>], at: &[T]) -> Vec<T> {
    let mut tables = Tables::empty();
    let part = tables.track(track);
    let inputs = tables.law_inputs(&[]);
    at.iter().map(|&x| height(part, &inputs, x).value).collect()
}

//! The road of a scene as tables, made when the first wheel asks.

use super::compile::{Compiler, part};
use crate::Real;
use crate::inputs::SignalInput;
use crate::laws::road::Feature;
use crate::laws::{Part, guide};
use crate::scene::RoadFeature;
use alloc::vec;

impl<T: Real> Compiler<'_, T> {
    /// The tracks of the left and the right wheels, and the course of a road that moves.
    pub(crate) fn roads(&mut self) -> ([Part; 2], Option<u32>) {
        if let Some(roads) = self.roads {
            return roads;
        }
        let road = self.among.road;
        let left = self.features(&road.left);
        let right = if road.left == road.right { left } else { self.features(&road.right) };
        let travel = (!road.speed.is_zero()).then(|| self.input(SignalInput::travel(road.speed)));
        *self.roads.insert(([left, right], travel))
    }

    fn features(&mut self, features: &[RoadFeature<T>]) -> Part {
        let first = self.actions.tables.features.len();
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
                    self.actions.tables.features.extend((0..*count).map(rise));
                    continue;
                }
                RoadFeature::Bump { start, length, amplitude } => {
                    Feature::Bump { start: *start, length: *length, amplitude: *amplitude }
                }
                RoadFeature::Table(points) => self.spline(points),
            };
            self.actions.tables.features.push(feature);
        }
        part(first, self.actions.tables.features.len())
    }

    fn spline(&mut self, points: &[[T; 2]]) -> Feature<T> {
        let tables = &mut self.actions.tables;
        let first = tables.knots.len();
        tables.knots.extend_from_slice(points);
        tables.curvatures.resize(tables.knots.len(), T::ZERO);
        let scratch = &mut vec![T::ZERO; points.len()];
        guide::spline_curvatures(points, &mut tables.curvatures[first..], scratch);
        Feature::Spline(part(first, tables.knots.len()))
    }
}

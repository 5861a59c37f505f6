//! Dashed lines. The dashed lines of the crate plotters use the system's `hypotf`. A new linker binds a version of it that older systems
//! lack.

use plotters::element::{Drawable, PointCollection};
use plotters::prelude::{DrawingBackend, ShapeStyle};
use plotters_backend::{BackendCoord, DrawingErrorKind};

/// A dashed line through points.
pub(super) struct Dashed<C> {
    points: Vec<C>,
    lengths: [u32; 2],
    style: ShapeStyle,
}

impl<C> Dashed<C> {
    /// A dashed line through these points, with the lengths of a stroke and of a gap [px], neither zero.
    pub(super) fn new(points: Vec<C>, lengths: [u32; 2], style: ShapeStyle) -> Self {
        Self { points, lengths, style }
    }
}

impl<'a, C> PointCollection<'a, C> for &'a Dashed<C> {
    type Point = &'a C;
    type IntoIter = &'a [C];

    fn point_iter(self) -> &'a [C] {
        &self.points
    }
}

impl<C, B: DrawingBackend> Drawable<B> for Dashed<C> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        points: I,
        backend: &mut B,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<B::ErrorType>> {
        for stroke in strokes(points, self.lengths) {
            backend.draw_path(stroke, &self.style)?;
        }
        Ok(())
    }
}

/// The strokes of a dashed line through points. The first stroke begins at the first point. A stroke may continue around corners.
fn strokes(
    mut points: impl Iterator<Item = BackendCoord>,
    lengths: [u32; 2],
) -> Vec<Vec<BackendCoord>> {
    let Some(mut from) = points.next() else { return Vec::new() };
    let (mut strokes, mut stroke) = (Vec::new(), vec![from]);
    // an empty stroke marks a gap
    let mut left = f64::from(lengths[0]);
    for to in points {
        let way = [f64::from(to.0 - from.0), f64::from(to.1 - from.1)];
        let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
        let mut along = 0.0;
        while length - along > left {
            along += left;
            let here = pixel(from, way.map(|x| x * along / length));
            let is_gap = stroke.is_empty();
            stroke.push(here);
            if !is_gap {
                strokes.push(std::mem::take(&mut stroke));
            }
            left = f64::from(lengths[usize::from(!is_gap)]);
        }
        left -= length - along;
        if !stroke.is_empty() {
            stroke.push(to);
        }
        from = to;
    }
    if stroke.len() > 1 {
        strokes.push(stroke);
    }
    strokes
}

/// The pixel at a displacement from another pixel.
#[allow(clippy::cast_possible_truncation, reason = "pixels of a picture")]
fn pixel(from: BackendCoord, way: [f64; 2]) -> BackendCoord {
    (from.0 + way[0].round() as i32, from.1 + way[1].round() as i32)
}

#[cfg(test)]
mod tests {
    use super::strokes;

    #[test]
    fn strokes_and_gaps_have_their_lengths_and_go_round_corners() {
        let points = [(100, 100), (100, 103), (100, 103), (105, 103), (105, 120)];
        let found = strokes(points.into_iter(), [5, 2]);
        let expected = [
            vec![(100, 100), (100, 103), (100, 103), (102, 103)],
            vec![(104, 103), (105, 103), (105, 107)],
            vec![(105, 109), (105, 114)],
            vec![(105, 116), (105, 120)],
        ];
        assert_eq!(found, expected);
        assert!(strokes([].into_iter(), [5, 2]).is_empty());
    }

    #[test]
    fn a_line_that_ends_in_a_gap_ends_with_its_last_stroke() {
        let found = strokes([(0, 0), (6, 8)].into_iter(), [5, 20]);
        assert_eq!(found, [[(0, 0), (3, 4)]]);
    }
}

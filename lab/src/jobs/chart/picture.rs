//! A drawing with its legend as one SVG file, for documents. Its colours are readable on a light and on a dark background.

use super::{Chart, SIZE};
use crate::format::escape;
use std::fmt::Write;

/// Colour of text and axes: a grey with the same contrast on both backgrounds.
const INK: &str = "#7D8590";
/// Height of a line of the legend, and width of an entry, in pixels; four entries fit beside each other.
const ENTRY: [usize; 2] = [22, 230];

/// Draws the chart with its legend as an SVG file.
///
/// # Errors
///
/// There is nothing to draw, or the drawing library fails.
pub(crate) fn picture(chart: &Chart) -> Result<String, String> {
    let drawing = chart.svg()?;
    let [line, width] = ENTRY;
    let mut legend = String::new();
    let named: Vec<_> = chart.named().collect();
    for (i, series) in named.iter().enumerate() {
        let (x, y) = (i % 4 * width + 40, i / 4 * line + 4);
        let sample = series.sample();
        // writing to a string cannot fail
        let _ = writeln!(
            legend,
            "<g transform=\"translate({x},{y})\">{sample}<text x=\"46\" y=\"12\" font-family=\"sans-serif\" font-size=\"14\" \
             fill=\"{INK}\">{}</text></g>",
            escape(&series.name)
        );
    }
    let top = named.len().div_ceil(4) * line + 8;
    let drawing = drawing.replacen("<svg ", &format!("<svg y=\"{top}\" "), 1);
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" color=\"{INK}\">\n{legend}{drawing}</svg>\n",
        SIZE.0,
        SIZE.1 as usize + top
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::{Look, Series};

    #[test]
    fn a_picture_names_its_lines_and_needs_no_page() {
        let points = vec![[1.0, 1.0], [2.0, 3.0]];
        let series = |name: &str| Series::new(name, 1, Look::Both, points.clone());
        let series = ["a < b", "c", "d", "e", "f"].map(series);
        let chart = Chart::log_log("error [J]", "error [J]", series.into());
        let svg = picture(&chart).unwrap();
        assert!(svg.starts_with("<svg xmlns=") && svg.contains("a &lt; b"));
        assert!(svg.contains("viewBox=\"0 0 960 392\"") && svg.contains("<svg y=\"52\" "));
    }
}

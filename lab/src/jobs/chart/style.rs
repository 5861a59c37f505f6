//! Colour, dashes and mark of each series. Any two series differ without colours too. Colours are readable on light and dark backgrounds.

use plotters::style::RGBColor;

/// Placeholder colour of text and axes, which is replaced by the text colour of the page.
pub(crate) const CURRENT: RGBColor = RGBColor(125, 133, 144);

/// Style of a series: colour, dashes and mark.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Style {
    /// Colour of the line and its marks.
    pub(crate) color: RGBColor,
    /// Lengths of dashes and gaps; empty for a solid line.
    dashes: &'static str,
    /// Corners of the mark, in thirds of its radius.
    corners: &'static [(i32, i32)],
}

/// The styles, by their numbers.
const STYLES: [Style; 9] = [
    Style {
        color: RGBColor(31, 119, 220),
        dashes: "",
        corners: &[(3, 1), (1, 3), (-1, 3), (-3, 1), (-3, -1), (-1, -3), (1, -3), (3, -1)],
    },
    Style { color: RGBColor(204, 106, 20), dashes: "9 4", corners: &[(0, -4), (4, 3), (-4, 3)] },
    Style {
        color: RGBColor(34, 145, 80),
        dashes: "4 3",
        corners: &[(-3, -3), (3, -3), (3, 3), (-3, 3)],
    },
    Style {
        color: RGBColor(176, 84, 196),
        dashes: "12 3 2 3",
        corners: &[(0, -5), (4, 0), (0, 5), (-4, 0)],
    },
    Style { color: RGBColor(120, 130, 140), dashes: "5 5", corners: &[(0, 4), (4, -3), (-4, -3)] },
    Style {
        color: RGBColor(214, 64, 72),
        dashes: "15 3 2 3 2 3",
        corners: &[
            (-4, -1),
            (-1, -1),
            (-1, -4),
            (1, -4),
            (1, -1),
            (4, -1),
            (4, 1),
            (1, 1),
            (1, 4),
            (-1, 4),
            (-1, 1),
            (-4, 1),
        ],
    },
    Style {
        color: RGBColor(0, 138, 150),
        dashes: "2 4",
        corners: &[(0, -5), (2, 0), (0, 5), (-2, 0)],
    },
    Style { color: RGBColor(158, 110, 50), dashes: "20 4", corners: &[(-4, 0), (3, -4), (3, 4)] },
    Style {
        color: RGBColor(222, 80, 160),
        dashes: "2 3 9 3",
        corners: &[(4, 0), (-3, -4), (-3, 4)],
    },
];

impl Style {
    /// The style of a number. Styles repeat for larger numbers.
    pub(crate) const fn of(number: usize) -> Self {
        STYLES[number % STYLES.len()]
    }

    /// The corners of the mark, relative to the point.
    pub(crate) fn mark(self, radius: i32) -> Vec<(i32, i32)> {
        let round = |x: i32| (x * radius + x.signum()) / 3;
        self.corners.iter().map(|&(x, y)| (round(x), round(y))).collect()
    }

    /// Returns the colour as the page writes it.
    fn code(self) -> String {
        code(self.color)
    }

    /// A short sample of the style for a legend, as SVG.
    pub(crate) fn sample(self, has_line: bool, has_mark: bool) -> String {
        let color = self.code();
        let line = format!(
            "<line x1=\"0\" y1=\"7\" x2=\"38\" y2=\"7\" stroke=\"{color}\" stroke-width=\"2\" stroke-dasharray=\"{}\"/>",
            self.dashes
        );
        let corner = |(x, y): (i32, i32)| format!("{},{}", x + 19, y + 7);
        let corners: Vec<_> = self.mark(4).into_iter().map(corner).collect();
        let mark = format!("<polygon fill=\"{color}\" points=\"{}\"/>", corners.join(" "));
        format!(
            "<svg class=\"sample\" width=\"38\" height=\"14\" viewBox=\"0 0 38 14\" aria-hidden=\"true\">{}{}</svg>",
            if has_line { &line } else { "" },
            if has_mark { &mark } else { "" }
        )
    }
}

fn code(RGBColor(r, g, b): RGBColor) -> String {
    format!("#{r:02X}{g:02X}{b:02X}")
}

/// Adds features that the drawing library lacks: dashes, and the text colour of the page.
pub(crate) fn finish(svg: &str, styles: impl Iterator<Item = Style>) -> String {
    let mut text = svg.replace(&format!("\"{}\"", code(CURRENT)), "\"currentColor\"");
    for style in styles.filter(|style| !style.dashes.is_empty()) {
        let line = format!("<polyline fill=\"none\" opacity=\"1\" stroke=\"{}\"", style.code());
        let dashed = format!("{line} stroke-dasharray=\"{}\"", style.dashes);
        // a style of two series is replaced only once
        if !text.contains(&dashed) {
            text = text.replace(&line, &dashed);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of a colour.
    fn luminance(RGBColor(r, g, b): RGBColor) -> f64 {
        let linear = |c: u8| {
            let c = f64::from(c) / 255.0;
            if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b)
    }

    #[test]
    fn colours_stand_out_on_light_and_on_dark_paper() {
        // Least contrast of graphics for readers with weak sight [-].
        const LEAST: f64 = 3.0;
        let dark = luminance(RGBColor(0x1d, 0x21, 0x26));
        for style in STYLES {
            let own = luminance(style.color);
            let (on_light, on_dark) = (1.05 / (own + 0.05), (own + 0.05) / (dark + 0.05));
            assert!(on_light >= LEAST && on_dark >= LEAST, "{style:?}: {on_light} {on_dark}");
        }
    }

    #[test]
    fn styles_differ_without_their_colour() {
        for (i, a) in STYLES.iter().enumerate() {
            for b in &STYLES[i + 1..] {
                assert!(a.dashes != b.dashes && a.corners != b.corners);
            }
        }
    }

    #[test]
    fn a_sample_shows_line_and_mark() {
        let both = Style::of(1).sample(true, true);
        assert!(both.contains("stroke-dasharray=\"9 4\"") && both.contains("<polygon"));
        assert!(!Style::of(10).sample(true, false).contains("<polygon"));
    }
}

//! Self-contained HTML pages: their frame and style, drawings with their legends.

use crate::chart::{Chart, Series};
use crate::format::escape;

/// The frame of all pages, and its style.
const FRAME: &str = include_str!("../../../../mbs-report/src/page/web/frame.html");
const STYLE: &str = include_str!("../../../../mbs-report/src/page/web/style.css");
/// Style that pages of measurements add to that of all pages.
const OWN_STYLE: &str = include_str!("page.css");

/// Makes a page of a title, a remark and its sections.
pub(crate) fn page(title: &str, remark: &str, content: &str) -> String {
    let frame = FRAME.replace("{{style}}", &[STYLE, OWN_STYLE].concat()).replace("{{scripts}}", "");
    let frame = frame.replace("{{title}}", &escape(title)).replace("{{heading}}", &escape(title));
    let remark = format!("<p class=\"soft\">{}</p>\n", escape(remark));
    frame.replace("{{sections}}", &(remark + content))
}

/// A drawing with its legend and its caption.
///
/// # Errors
///
/// There is nothing to draw, or the drawing library fails.
pub(crate) fn figure(chart: &Chart, caption: &str) -> Result<String, String> {
    Ok(format!(
        "<figure>\n{}<div class=\"wide\">{}</div>\n<figcaption class=\"soft\">{}</figcaption>\n</figure>\n",
        legend(chart),
        chart.svg()?,
        words(caption)
    ))
}

/// The names of the series, each after a sample of its style.
fn legend(chart: &Chart) -> String {
    let entry = |s: &Series| format!("<li>{} {}</li>", s.sample(), words(&s.name));
    format!("<ul class=\"legend\">{}</ul>\n", chart.named().map(entry).collect::<String>())
}

/// Units that are kept on one line with their number.
const UNITS: [&str; 6] = ["s", "J", "m", "rad", "%", "m/s²"];

/// A sentence as HTML. It is not broken within a number or a name such as index-3, nor between a number and its unit.
pub(crate) fn words(sentence: &str) -> String {
    let (mut html, mut last) = (String::new(), "");
    for word in sentence.split(' ') {
        let is_unit = UNITS.contains(&word.trim_end_matches([',', '.', ';', ':', ')']));
        let is_beside = is_unit && last.ends_with(|c: char| c.is_ascii_digit());
        html.push_str(if is_beside { "&nbsp;" } else { " " });
        let text = escape(word);
        let mut pairs = word.as_bytes().windows(2);
        html.push_str(&match pairs.any(|pair| pair[0] == b'-' && pair[1].is_ascii_digit()) {
            true => format!("<span class=\"number\">{text}</span>"),
            false => text,
        });
        last = word;
    }
    // removes the space before the first word
    html.split_off(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::{Axis, Kind, Look};

    #[test]
    fn numbers_stay_whole_and_beside_their_units() {
        let html = "<span class=\"number\">2.5e-11</span>&nbsp;m, &lt; 3 in <span class=\"number\">index-3</span>";
        assert_eq!(words("2.5e-11 m, < 3 in index-3"), html);
    }

    #[test]
    fn a_page_fills_the_frame_of_all_pages() {
        let page = page("Title & more", "remark", "<p>content</p>");
        assert!(!page.contains("{{") && page.contains("<p>content</p>"));
        assert_eq!(page.matches("Title &amp; more").count(), 2, "in the head and on the page");
    }

    #[test]
    fn a_figure_names_what_it_draws() {
        let series =
            |name: &str, points: &[[f64; 2]]| Series::new(name, 0, Look::Line, points.to_vec());
        let drawn = vec![series("a < b", &[[0.0, 1.0], [1.0, 2.0]]), series("absent", &[])];
        let chart = Chart::new(Axis::time(), Axis::new("z [m]", Kind::Linear), drawn);
        let figure = figure(&chart, "What it shows.").unwrap();
        assert!(figure.contains("a &lt; b") && !figure.contains("absent"));
        assert!(figure.contains("What it shows.") && figure.matches("z [m]").count() == 1);
    }
}

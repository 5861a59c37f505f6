//! HTML pages that need nothing else: their frame and style, cells that carry their labels, drawings with their legends.

use crate::chart::{Chart, Room, Series};

/// The frame of a page, with its style.
const PAGE: &str = include_str!("page.html");

/// Letters of a cell that is never broken.
const LONG: usize = 16;

/// A page.
pub(crate) fn page(title: &str, remark: &str, content: &str) -> String {
    let page = PAGE.replace("{{title}}", &escape(title)).replace("{{remark}}", &escape(remark));
    page.replace("{{content}}", content)
}

/// One cell; its label is shown where the columns do not fit.
pub(crate) fn cell(label: &str, value: &str, class: &str) -> String {
    let class = match value {
        "" => format!("{class} none"),
        // words may be broken where the columns do not fit, numbers not
        _ if value.len() > LONG && value.contains(' ') => format!("{class} said"),
        _ => class.to_owned(),
    };
    let (label, value) = (escape(label), words(value));
    format!("<td data-label=\"{label}\" class=\"{}\">{value}</td>", class.trim())
}

/// A drawing, for a page and for a phone, with its legend and its caption.
///
/// # Errors
///
/// That there is nothing to draw, or what the drawing library says.
pub(crate) fn figure(chart: &Chart, caption: &str) -> Result<String, String> {
    let (wide, narrow) = (chart.svg(Room::Wide)?, chart.svg(Room::Narrow)?);
    Ok(format!(
        "<figure>\n{}<div class=\"wide\">{wide}</div>\n<div class=\"narrow\">{narrow}</div>\n<figcaption class=\"soft\">{}</figcaption>\n</figure>\n",
        legend(chart),
        words(caption)
    ))
}

/// The names of the series, each behind a piece of it.
fn legend(chart: &Chart) -> String {
    let entry = |s: &Series| format!("<li>{} {}</li>", s.sample(), words(&s.name));
    format!("<ul class=\"legend\">{}</ul>\n", chart.named().map(entry).collect::<String>())
}

/// Units that stay beside their number.
const UNITS: [&str; 6] = ["s", "J", "m", "rad", "%", "m/s²"];

/// A sentence that is not broken within a number or a name such as index-3, nor between a number and its unit.
pub(crate) fn words(sentence: &str) -> String {
    let mut html = String::new();
    let mut last = "";
    for (i, word) in sentence.split(' ').enumerate() {
        let is_unit = UNITS.contains(&word.trim_end_matches([',', '.', ';', ':', ')']));
        let is_beside = is_unit && last.ends_with(|c: char| c.is_ascii_digit());
        html.push_str(match (i, is_beside) {
            (0, _) => "",
            (_, true) => "&nbsp;",
            (_, false) => " ",
        });
        let text = escape(word);
        let parts = word.as_bytes().windows(2);
        if parts.into_iter().any(|pair| pair[0] == b'-' && pair[1].is_ascii_digit()) {
            html.push_str(&format!("<span class=\"number\">{text}</span>"));
        } else {
            html.push_str(&text);
        }
        last = word;
    }
    html
}

/// Text as HTML.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
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
    fn a_page_fills_its_frame() {
        let page = page("Title & more", "remark", "<p>content</p>");
        assert!(!page.contains("{{") && page.contains("<p>content</p>"));
        assert_eq!(page.matches("Title &amp; more").count(), 2, "in the head and on the page");
    }

    #[test]
    fn a_figure_names_what_it_draws() {
        let series = |name: &str, points: &[[f64; 2]]| Series {
            name: name.into(),
            style: 0,
            look: Look::Line,
            points: points.to_vec(),
        };
        let drawn = vec![series("a < b", &[[0.0, 1.0], [1.0, 2.0]]), series("absent", &[])];
        let chart = Chart::new(Axis::time(), Axis::new("z [m]", Kind::Linear), drawn);
        let figure = figure(&chart, "What it shows.").unwrap();
        assert!(figure.contains("a &lt; b") && !figure.contains("absent"));
        assert!(figure.contains("What it shows.") && figure.matches("z [m]").count() == 2);
    }
}

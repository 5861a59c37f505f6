//! A page as a list of sections, and the HTML file that they form.

use super::glossary;
use super::open_rows::OpenRows;
use crate::table::Section;
use crate::text::{escape, fill};
use core::fmt::Write;

/// HTML frame of all pages.
const FRAME: &str = include_str!("web/frame.html");
/// Style sheet of all pages.
const STYLE: &str = include_str!("web/style.css");
/// Licence of three.js, which pages with a view contain.
const LICENCE: &str = include_str!("web/three/LICENSE");
/// Part of three.js that pages use, deflated and in base64.
const THREE: &str = include_str!("web/three/three.txt");
/// Scripts of all pages with a pack.
const SCRIPTS: [&str; 5] = [
    include_str!("web/pack.js"),
    include_str!("web/clock.js"),
    include_str!("web/motion.js"),
    include_str!("web/plot.js"),
    include_str!("web/main.js"),
];
/// Scripts of pages with a view.
const VIEW_SCRIPTS: [&str; 4] = [
    include_str!("web/meshes.js"),
    include_str!("web/shapes.js"),
    include_str!("web/view.js"),
    include_str!("web/lines.js"),
];
/// Script of pages with diagrams.
const DIAGRAM_SCRIPT: &str = include_str!("web/diagram.js");

/// Number of notes that are shown at the top of a page [-]. Further notes are folded, so that a phone shows the motion without scrolling.
/// Chosen, not tuned.
const OPEN_NOTES: usize = 3;

/// HTML of the line keys, and of the buttons that show groups of lines.
const KEYS: &str =
    "<div class=\"keys\" id=\"keys\"></div><div class=\"controls\" id=\"groups\"></div>";

/// A page: its title, and its sections from top to bottom.
#[derive(Debug, Default)]
pub(crate) struct Page {
    pub(crate) title: String,
    pub(crate) sections: Vec<PageSection>,
    /// Packed data that the view and the plots draw, as text.
    pub(crate) pack: Option<String>,
}

/// Section of a page. Texts and tables are HTML without scripts; a script draws the view and the plots from the page's pack.
#[derive(Debug)]
pub(crate) enum PageSection {
    /// Error because of which the page has less content than was required.
    Error(String),
    /// Notes for the reader.
    Notes(Vec<String>),
    /// Key numbers of the page: label and value.
    Cards(Vec<[String; 2]>),
    /// Motion in three dimensions, with a sentence below it.
    View(String),
    /// Plots over time.
    Plots(Vec<PlotFrame>),
    /// Keys of the lines of all diagrams, for a page on which no diagram has them.
    Keys,
    /// Diagrams drawn from the page's pack.
    Diagrams(Vec<DiagramFrame>),
    /// Table with a title.
    Table(Section),
    /// Table whose rows can be opened.
    Rows(OpenRows),
    /// Tables side by side, where the page is wide enough.
    Tables(Vec<Section>),
    /// Folded sections under a title.
    Fold(String, Vec<Self>),
    /// Text shown line by line.
    Text(String),
}

/// Frame of a plot: everything except its lines.
#[derive(Debug, Clone, Default)]
pub(crate) struct PlotFrame {
    /// Index of the plot among the panels of the pack.
    pub(crate) panel: usize,
    pub(crate) title: String,
    pub(crate) unit: String,
    pub(crate) caption: String,
}

/// Frame of a diagram: everything except its points.
#[derive(Debug, Clone, Default)]
pub(crate) struct DiagramFrame {
    /// Kind of the diagram, `diagram` or `map`, and its index among the diagrams of the kind in the pack.
    pub(crate) place: (&'static str, usize),
    pub(crate) title: String,
    pub(crate) caption: String,
    /// True if the diagram is as wide as the page and has the keys of all lines.
    pub(crate) has_keys: bool,
}

impl Page {
    /// Returns the page as one HTML file without references to other files.
    pub(crate) fn html(&self) -> String {
        let title = escape(&self.title);
        let mut body = String::new();
        self.sections.iter().for_each(|section| section.write(&mut body));
        let mut terms = String::new();
        glossary::write_used(&body, &mut terms);
        body += &terms;
        let mut scripts = String::new();
        if let Some(pack) = &self.pack {
            let has_view = self.sections.iter().any(|s| matches!(s, PageSection::View(_)));
            if has_view {
                let licence = vec![PageSection::Text(LICENCE.to_owned())];
                let title = "Licence of three.js, which draws the motion".to_owned();
                PageSection::Fold(title, licence).write(&mut body);
            }
            let three = if has_view { THREE.trim_end() } else { "" };
            // writing to a String cannot fail
            let _ = writeln!(scripts, "<script type=\"text/plain\" id=\"pack\">{pack}</script>");
            let _ = writeln!(scripts, "<script type=\"text/plain\" id=\"three\">{three}</script>");
            let view = if has_view { VIEW_SCRIPTS.concat() } else { String::new() };
            let has_diagrams = self.sections.iter().any(PageSection::has_diagrams);
            let diagram = if has_diagrams { DIAGRAM_SCRIPT } else { "" };
            let all = [&view, diagram, &SCRIPTS.concat()].concat();
            let _ = writeln!(scripts, "<script>\n\"use strict\";\n{all}</script>");
        }
        fill(
            FRAME,
            &[
                ("{{title}}", &title),
                ("{{style}}", STYLE),
                ("{{heading}}", &title),
                ("{{sections}}", &body),
                ("{{scripts}}", &scripts),
            ],
        )
    }
}

impl PageSection {
    /// Creates a section from a table. The section is folded under the table's title if the table is marked so.
    pub(crate) fn of(section: Section) -> Self {
        if !section.is_folded {
            return Self::Table(section);
        }
        let title = section.title.clone();
        Self::Fold(title, vec![Self::Table(Section { title: String::new(), ..section })])
    }

    fn has_diagrams(&self) -> bool {
        match self {
            Self::Diagrams(_) | Self::Keys => true,
            Self::Fold(_, sections) => sections.iter().any(Self::has_diagrams),
            _ => false,
        }
    }

    fn write(&self, out: &mut String) {
        // writing to a String cannot fail
        let _ = match self {
            Self::Error(text) => {
                writeln!(out, "<p class=\"stopped\" role=\"alert\">{}</p>", escape(text))
            }
            Self::Notes(notes) => writeln!(out, "{}", list_of_notes(notes)),
            Self::Cards(cards) => {
                let card = |[label, value]: &[String; 2]| {
                    format!("<div><dt>{}</dt><dd>{}</dd></div>", escape(label), escape(value))
                };
                let cards = cards.iter().map(card);
                writeln!(out, "<dl class=\"figures\">{}</dl>", cards.collect::<String>())
            }
            Self::View(caption) => {
                out.push_str(&fill(
                    include_str!("web/view.html"),
                    &[("{{caption}}", &escape(caption))],
                ));
                Ok(())
            }
            Self::Plots(frames) => {
                out.push_str("<div class=\"graphs\">\n");
                frames.iter().for_each(|frame| frame.write(out));
                writeln!(out, "</div>")
            }
            Self::Keys => writeln!(out, "<section class=\"card\">{KEYS}</section>"),
            Self::Diagrams(frames) => {
                out.push_str("<div class=\"graphs\">\n");
                frames.iter().for_each(|frame| frame.write(out));
                writeln!(out, "</div>")
            }
            Self::Table(section) => {
                section.write_card(out);
                Ok(())
            }
            Self::Rows(rows) => {
                rows.write(out);
                Ok(())
            }
            Self::Tables(sections) => {
                out.push_str("<div class=\"graphs\">\n");
                sections.iter().for_each(|section| section.write_card(out));
                writeln!(out, "</div>")
            }
            Self::Fold(title, sections) => {
                let _ =
                    writeln!(out, "<details class=\"card\"><summary>{}</summary>", escape(title));
                sections.iter().for_each(|section| section.write(out));
                writeln!(out, "</details>")
            }
            Self::Text(text) => writeln!(out, "<pre>{}</pre>", escape(text)),
        };
    }
}

/// Returns the list of notes. The first notes are shown and the others are folded.
fn list_of_notes(notes: &[String]) -> String {
    let items: Vec<_> = notes.iter().map(|note| format!("<li>{}</li>", escape(note))).collect();
    // a fold with one note needs as much space as the note
    let n = if items.len() > OPEN_NOTES + 1 { OPEN_NOTES } else { items.len() };
    let (shown, more) = items.split_at(n);
    let more = match more.len() {
        0 => String::new(),
        n => {
            let more = more.concat();
            format!("<details><summary>{n} more notes</summary><ul>{more}</ul></details>")
        }
    };
    format!("<div class=\"notes\"><ul>{}</ul>{more}</div>", shown.concat())
}

impl PlotFrame {
    fn write(&self, out: &mut String) {
        let Self { panel, title, unit, caption } = self;
        let (title, caption) = (escape(title), escape(caption));
        let unit = match unit.as_str() {
            "" | "-" => String::new(),
            unit => format!(" <span class=\"unit\">[{}]</span>", escape(unit)),
        };
        let _ = writeln!(
            out,
            "<figure class=\"card graph\" data-panel=\"{panel}\"><h2>{title}{unit}</h2>\
             <canvas tabindex=\"0\" role=\"img\" aria-label=\"{caption}\"></canvas><div class=\"legend\"></div>\
             <figcaption class=\"caption\">{caption}</figcaption></figure>"
        );
    }
}

impl DiagramFrame {
    fn write(&self, out: &mut String) {
        let Self { place: (kind, number), title, caption, has_keys } = self;
        let (title, caption) = (escape(title), escape(caption));
        let (class, keys) = match has_keys {
            true => (" whole", KEYS),
            false => ("", ""),
        };
        let _ = writeln!(
            out,
            "<figure class=\"card graph{class}\" data-{kind}=\"{number}\"><h2>{title}</h2>\
             <svg class=\"plot\" role=\"img\" aria-label=\"{title}. {caption}\"></svg><p class=\"said\"></p>{keys}<ul class=\"marks\" hidden></ul>\
             <figcaption class=\"caption\">{caption}</figcaption><div class=\"tools\"><button type=\"button\" class=\"save\" title=\"as a drawing\">SVG</button></div>\
             </figure>"
        );
    }
}

//! Index of all pages: the contents of each, the command that makes it, and its surprises.

use crate::bench;
use crate::format::escape;
use crate::page::words;
use std::path::Path;
use std::process::Command;
use std::time::Instant;
use xtask::process;

/// A page: its file, its contents, and the command that makes only this page.
#[derive(Debug, Clone, Copy)]
pub(super) struct Page {
    /// File of the page in the folder.
    pub(super) file: &'static str,
    title: &'static str,
    shows: &'static str,
    /// The command that makes only this page.
    pub(super) command: &'static str,
    /// The scene of the page; empty if it has none.
    pub(super) scene: &'static str,
}

/// Page of the report's tables.
pub(super) const TABLES: Page = Page {
    file: "tables.html",
    title: "The report's tables, run anew",
    shows: "Errors and times of every method and step that the founding report prints, beside its numbers; grades G1 and G2 by \
            rules from runs; step size and energy of the suspension (F6, F7); processors (T6, T7); 32 digits at small steps (D1).",
    command: "cargo xtask tables",
    scene: "",
};
/// Page of the experiments on variable steps.
pub(super) const STEPS: Page = Page {
    file: "steps.html",
    title: "Variable steps beside fixed ones",
    shows: "What choosing the steps gains, by the energy, by an estimate of the error, with and without a change of index, and \
            where steps end at events.",
    command: "cargo xtask steps",
    scene: "",
};
/// Page of times and threads.
pub(super) const BENCH: Page = Page {
    file: "bench.html",
    title: "What a step costs, and what threads gain",
    shows: "Times and phases of a step in each formulation, faer beside our factorisation, speed-up over threads, orders of \
            elimination.",
    command: "cargo xtask bench",
    scene: "",
};

/// A comparison of all methods on a scene.
macro_rules! compared {
    ($scene:literal, $shows:literal) => {
        Page {
            file: concat!("compare/", $scene, "/compare.html"),
            title: concat!("What accuracy costs: ", $scene),
            shows: $shows,
            command: concat!("mbs compare scenes/", $scene, ".toml --out out"),
            scene: $scene,
        }
    };
}

/// The scenes on which all methods are compared.
pub(super) const COMPARED: [Page; 4] = [
    compared!(
        "double-pendulum",
        "Two links, smooth motion: CPU time against true error of every method."
    ),
    compared!(
        "andrews",
        "A stiff small mechanism with loops: CPU time against true error of every method."
    ),
    compared!(
        "iltis-suspension",
        "A suspension over a bump: CPU time against true error of every method."
    ),
    compared!(
        "iltis-stairs",
        "A whole vehicle over stairs: CPU time against true error of every method."
    ),
];

/// A page that was made.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    page: Page,
    remark: String,
    seconds: f64,
    surprises: Vec<String>,
    /// Figure of the page; empty without one.
    picture: String,
}

impl Entry {
    /// An entry of a page whose work began at `clock`.
    pub(super) fn new(page: &Page, remark: String, clock: Instant, surprises: Vec<String>) -> Self {
        let (seconds, picture) = (clock.elapsed().as_secs_f64(), String::new());
        Self { page: *page, remark, seconds, surprises, picture }
    }

    /// Adds a picture of the page.
    pub(super) fn with_picture(self, picture: String) -> Self {
        Self { picture, ..self }
    }

    fn card(&self) -> String {
        let Page { file, title, shows, command, .. } = self.page;
        let minutes = self.seconds / 60.0;
        let mut html = format!(
            "<section class=\"card\">\n<h2><a href=\"{file}\">{}</a></h2>\n<p>{}</p>\n<p class=\"soft\"><code>{command}</code>, \
             {minutes:.1} minutes. {}</p>\n",
            escape(title),
            words(shows),
            words(&self.remark)
        );
        if !self.surprises.is_empty() {
            let item = |s: &String| format!("<li class=\"fails\">{}</li>", words(s));
            let items: String = self.surprises.iter().map(item).collect();
            html.push_str(&format!("<ul class=\"claims\">{items}</ul>\n"));
        }
        html + &self.picture + "</section>\n"
    }
}

/// Index of the pages, which is the first page.
#[derive(Debug)]
pub(super) struct Index {
    quick: bool,
    /// Provenance of the pages: commit, processor and compiler.
    provenance: String,
    /// The pages so far.
    pub(super) entries: Vec<Entry>,
}

impl Index {
    /// Makes an index without pages.
    pub(super) fn new(quick: bool) -> Self {
        Self { quick, provenance: provenance(), entries: Vec::new() }
    }

    /// Writes a page, and adds it to the index with its first figure.
    pub(super) fn add_page(
        &mut self,
        folder: &Path,
        html: &str,
        entry: Entry,
    ) -> Result<(), String> {
        process::write(&folder.join(entry.page.file), html.as_bytes())?;
        self.add(folder, entry.with_picture(first_picture(html).to_owned()))
    }

    /// Adds a page that is written already, and writes the index.
    pub(super) fn add(&mut self, folder: &Path, entry: Entry) -> Result<(), String> {
        self.entries.push(entry);
        process::write(&folder.join("index.html"), self.html().as_bytes())
    }

    /// The files of all pages.
    pub(super) fn files(&self) -> impl Iterator<Item = &'static str> {
        std::iter::once("index.html").chain(self.entries.iter().map(|entry| entry.page.file))
    }

    /// The surprises of all pages.
    pub(super) fn surprises(&self) -> Vec<String> {
        self.entries.iter().flat_map(|entry| entry.surprises.iter().cloned()).collect()
    }

    /// Writes the index as a page.
    pub(super) fn html(&self) -> String {
        let length = if self.quick { " --quick" } else { "" };
        let remark = format!(
            "Made by `cargo xtask report{length}`, {}. Every number on these pages was measured by the command named beside it.",
            self.provenance
        );
        let cards: String = self.entries.iter().map(Entry::card).collect();
        crate::page::page("Multibody systems, measured", &remark, &cards)
    }
}

/// Commit, processor and compiler; an unknown one is left out.
fn provenance() -> String {
    let said = |program: &str, arguments: &[&str]| {
        let mut command = Command::new(program);
        command.args(arguments).current_dir(process::root());
        process::output(&mut command).map(|text| text.trim().to_owned()).filter(|t| !t.is_empty())
    };
    let commit = process::commit().map(|commit| format!("commit {commit}"));
    let processor = Some(format!("{} cores ({})", bench::cores(), bench::processor()));
    let compiler = said("rustc", &["--version"]);
    let known: Vec<_> = [commit, processor, compiler].into_iter().flatten().collect();
    known.join(", ")
}

/// The first figure of a page; empty without one.
fn first_picture(html: &str) -> &str {
    const ENDS: [&str; 2] = ["<figure>", "</figure>"];
    let [start, end] = ENDS.map(|mark| html.find(mark));
    let picture = start.zip(end).and_then(|(start, end)| html.get(start..end + ENDS[1].len()));
    picture.unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_page_has_its_link_and_its_command_and_surprises_stand_out() {
        let mut index = Index::new(true);
        let clock = Instant::now();
        index.entries.push(Entry::new(&TABLES, "3 entries".into(), clock, vec!["T1 <x>".into()]));
        let page = "<p>a</p><figure>speed-up</figure><figure>b</figure>";
        let bench = Entry::new(&BENCH, "none".into(), clock, Vec::new());
        index.entries.push(bench.with_picture(first_picture(page).to_owned()));
        let html = index.html();
        for page in [TABLES, BENCH] {
            assert!(html.contains(&format!("href=\"{}\"", page.file)));
            assert!(html.contains(&format!("<code>{}</code>", page.command)));
        }
        assert!(html.contains("<figure>speed-up</figure>"));
        assert!(html.contains("class=\"fails\">T1 &lt;x&gt;") && html.contains("report --quick"));
        assert!(!html.contains("{{") && !html.contains("src="), "nothing is fetched");
        assert_eq!(first_picture("<p>none</p>"), "");
        assert_eq!(index.surprises(), ["T1 <x>"]);
    }
}

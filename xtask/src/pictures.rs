//! The job `cargo xtask pictures`: makes the pictures of README.md and of docs/ by `mbs` alone, from the view of a run's page and by `mbs
//! plot`.

use crate::{command, pages, process};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

/// Script that shows the view alone, at the size of the picture, and writes the picture into the page as text.
const TAKE: &str = include_str!("pictures/take.js");

/// Width and height of a scene's picture [pixels]: two fit beside each other on a phone, and all together have less than a megabyte.
const SMALL: [u32; 2] = [400, 240];
/// Width and height of a picture in README.md or a guide [pixels]: the width of the text on a code host.
const LARGE: [u32; 2] = [720, 300];

/// Views of some scenes, as in the address of the page. Other scenes are shown at a third of the run from the default direction.
const LOOKS: [(&str, &str); 5] = [
    ("iltis-stairs", "t=6.4"),
    ("iltis-stairs-stiff", "t=6.4"),
    ("iltis-suspension", "t=3.1"),
    ("iltis-suspension-halved", "t=3.1"),
    ("iltis-suspension-stiff", "t=3.1"),
];

/// Views besides those of the gallery: file, scene, view.
const VIEWS: [(&str, &str, &str); 3] = [
    ("iltis-stairs.png", "scenes/iltis-stairs.toml", "t=6.4"),
    ("tutorial-view.png", "mbs-scene/src/templates/crank-rocker.toml", ""),
    ("vehicle-corner.png", "mbs-scene/src/templates/double-wishbone.toml", "t=0.66"),
];

/// A run of a template: its name in the plot, the template, and a text with its replacement.
type Variant = (&'static str, &'static str, [&'static str; 2]);

/// Plots: file, runs, channel.
const PLOTS: [(&str, &[Variant], &str); 2] = [
    ("tutorial-force.svg", &[("crank-rocker", "crank-rocker", ["", ""])], "force at O"),
    (
        "vehicle-load.svg",
        &[
            ("firm", "quarter-car", ["", ""]),
            ("soft", "quarter-car", ["zeta = \"1/3\"", "zeta = \"1/6\""]),
        ],
        "load of the tire",
    ),
];

/// Makes all pictures, or those with one of the words in their names.
pub fn pictures(words: &[String]) -> ExitCode {
    let result = command::built().and_then(|mbs| {
        let browser = pages::browser().ok_or("there is no chromium: it draws the view")?;
        all(&Maker { mbs, browser, work: process::target_dir().join("pictures") }, words)
    });
    match result {
        Ok(bytes) => {
            eprintln!("{bytes} bytes of pictures");
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

struct Maker {
    mbs: PathBuf,
    browser: &'static str,
    work: PathBuf,
}

fn all(maker: &Maker, words: &[String]) -> Result<u64, String> {
    let folder = process::root().join("docs/pictures");
    let is_asked =
        |name: &str| words.is_empty() || words.iter().any(|word| name.contains(word.as_str()));
    let mut bytes = 0;
    let mut keep = |name: &str, picture: &[u8]| {
        bytes += picture.len() as u64;
        fs::create_dir_all(&folder)
            .and_then(|()| fs::write(folder.join(name), picture))
            .map_err(|e| format!("{name}: {e}"))
    };
    for name in scenes()?.iter().filter(|name| is_asked(name)) {
        let scene = process::root().join(format!("scenes/{name}.toml"));
        let look = LOOKS.iter().find(|(of, _)| of == name).map(|(_, look)| *look);
        keep(&format!("scene-{name}.png"), &maker.view(name, &scene, look, SMALL)?)?;
    }
    for (file, scene, look) in VIEWS.iter().filter(|(file, ..)| is_asked(file)) {
        keep(file, &maker.view(file, &process::root().join(scene), Some(look), LARGE)?)?;
    }
    for (file, runs, channel) in PLOTS.iter().filter(|(file, ..)| is_asked(file)) {
        keep(file, &maker.plot(file, runs, channel)?)?;
    }
    Ok(bytes)
}

/// The names of the scenes.
fn scenes() -> Result<Vec<String>, String> {
    let entries = fs::read_dir(process::root().join("scenes")).map_err(|e| e.to_string())?;
    let paths = entries.flatten().map(|entry| entry.path());
    let mut names: Vec<String> = paths
        .filter(|path| path.extension().is_some_and(|end| end == "toml"))
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    Ok(names)
}

impl Maker {
    /// Runs a scene file with a folder for its results. Returns the folder.
    fn run(&self, name: &str, scene: &Path) -> Result<PathBuf, String> {
        let out = self.work.join(name);
        let mut command = Command::new(&self.mbs);
        command.arg("run").arg(scene).args(["--no-estimate", "--out"]).arg(&out);
        // an error is ignored: some scenes stop on purpose
        let _ = process::run(command.current_dir(process::root()).stdout(Stdio::null()));
        Ok(out)
    }

    /// The view of a run as PNG.
    fn view(
        &self,
        name: &str,
        scene: &Path,
        look: Option<&str>,
        [width, height]: [u32; 2],
    ) -> Result<Vec<u8>, String> {
        let page = self.run(name, scene)?.join("run.html");
        let html = fs::read_to_string(&page).map_err(|e| format!("{}: {e}", page.display()))?;
        let take = TAKE
            .replace("{{look}}", look.unwrap_or_default())
            .replace("{{width}}", &width.to_string())
            .replace("{{height}}", &height.to_string());
        let framed = page.with_extension("picture.html");
        let html = html.replacen("</body>", &format!("<script>{take}</script></body>"), 1);
        fs::write(&framed, html).map_err(|e| e.to_string())?;
        let report = pages::report_in(&pages::dom(self.browser, &framed, pages::LIGHT)?);
        let text = report.strip_prefix("data:image/png;base64,");
        let bytes = text.and_then(decoded).ok_or_else(|| format!("{name}: {report}"))?;
        Ok(bytes)
    }

    /// A channel of several runs in one plot, as SVG.
    fn plot(&self, file: &str, runs: &[Variant], channel: &str) -> Result<Vec<u8>, String> {
        let io = |e: std::io::Error| format!("{file}: {e}");
        let picture = self.work.join(file);
        let mut command = Command::new(&self.mbs);
        command.arg("plot").args(["--channel", channel, "--out"]).arg(&picture);
        for (name, template, [old, new]) in runs {
            let template = process::root().join(format!("mbs-scene/src/templates/{template}.toml"));
            let text = fs::read_to_string(template).map_err(io)?;
            let scene = self.work.join(format!("{name}.toml"));
            fs::create_dir_all(&self.work)
                .and_then(|()| fs::write(&scene, text.replacen(old, new, 1)))
                .map_err(io)?;
            command.arg(self.run(name, &scene)?);
        }
        process::run(command.stdout(Stdio::null()))?;
        fs::read(&picture).map_err(io)
    }
}

/// The bytes of a text in base64.
fn decoded(text: &str) -> Option<Vec<u8>> {
    let digit = |c: u8| {
        Some(match c {
            b'A'..=b'Z' => c - b'A',
            b'a'..=b'z' => c - b'a' + 26,
            b'0'..=b'9' => c - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return None,
        })
    };
    let mut bytes = Vec::new();
    for four in text.trim_end_matches('=').as_bytes().chunks(4) {
        let mut sum = 0u32;
        for (place, c) in four.iter().enumerate() {
            sum |= u32::from(digit(*c)?) << (18 - 6 * place);
        }
        bytes.extend_from_slice(&sum.to_be_bytes()[1..four.len()]);
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::decoded;

    #[test]
    fn base64_gives_the_bytes_of_rfc_4648() {
        let cases =
            [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9v", "foo"), ("Zm9vYmFy", "foobar")];
        for (text, bytes) in cases {
            assert_eq!(decoded(text), Some(bytes.into()), "{text}");
        }
        assert_eq!(decoded("Zm9?"), None);
    }
}

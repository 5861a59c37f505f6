//! Check of HTML pages in a browser without a window, at the widths of a desktop and of a phone. Faults are labels that overlap or are cut
//! off, elements that do not react to pointer and buttons, and pictures that cannot be exported.

use crate::debian;
use crate::process::{self, output};
use crate::summary::{LeftOut, Outcome};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Names of the browser's program on different systems.
const BROWSERS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];
/// Widths of the page in pixels: a desktop, a phone.
const WIDTHS: [u32; 2] = [1280, 390];
/// Colour schemes that a reader may prefer, with the numbers by which the browser's option sets them.
const THEMES: [(&str, &str); 2] = [("dark", "0"), ("light", "1")];
/// Number by which the browser's option sets light colours.
pub(crate) const LIGHT: &str = THEMES[1].1;
/// Script that records errors of a page; it runs before any other script of the page.
const CATCH: &str = "<script>window.probeFaults = []; addEventListener(\"error\", (e) => window.probeFaults.push(e.message)); addEventListener(\"unhandledrejection\", (e) => window.probeFaults.push(String(e.reason)));</script>";

/// Script that removes WebGL from a page.
const WITHOUT_WEBGL: &str = "<script>window.probeWithoutWebGL = true; const whole = HTMLCanvasElement.prototype.getContext; HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return /webgl/.test(kind) ? null : whole.call(this, kind, ...rest); };</script>";

/// Settings of one inspection of a page: its width in pixels, and the colour scheme as a word and as the browser's number.
type Look = (u32, (&'static str, &'static str));

/// Settings of the short form: each width and each colour scheme once.
const SHORT: [Look; 2] = [(WIDTHS[0], THEMES[0]), (WIDTHS[1], THEMES[1])];

/// Makes the pages of runs, a comparison, a difference, a diagnosis and a sweep. Inspects them with each width and each colour scheme once.
///
/// # Errors
///
/// The faults of a page, by its width.
pub(crate) fn check() -> Result<Outcome, String> {
    check_with(&SHORT)
}

/// Inspects the same pages at every width in all colour schemes.
///
/// # Errors
///
/// The faults of a page, by its width.
pub(crate) fn whole() -> Result<Outcome, String> {
    check_with(&all_looks())
}

fn all_looks() -> Vec<Look> {
    WIDTHS.iter().flat_map(|width| THEMES.map(|theme| (*width, theme))).collect()
}

fn check_with(looks: &[Look]) -> Result<Outcome, String> {
    let Some(browser) = browser() else {
        return Ok(Outcome::LeftOut(LeftOut {
            why: "there is no chromium".to_owned(),
            remedy: "On Debian, as root: `apt-get install chromium`.".to_owned(),
        }));
    };
    let folder = process::target_dir().join("pages");
    let pages = made(&folder)?;
    for page in pages {
        look_with(browser, &folder.join(page), (looks, ""))?;
    }
    look_with(browser, &folder.join("run.html"), (looks, WITHOUT_WEBGL))?;
    let looks: Vec<_> =
        looks.iter().map(|(width, (theme, _))| format!("{width} {theme}")).collect();
    Ok(Outcome::Passed(format!("{} at {} px", pages.join(", "), looks.join(", "))))
}

/// Makes the pages in a folder.
fn made(folder: &Path) -> Result<[&'static str; 6], String> {
    let scene = |name: &str| process::root().join("scenes").join(name).display().to_string();
    let place = |name: &str| folder.join(name).display().to_string();
    let (pendulum, out) = (scene("simple-pendulum.toml"), place(""));
    let suspension = with_mesh(&scene("iltis-suspension.toml"), folder)?;
    mbs(&["run", &suspension, "--duration", "1", "--no-estimate", "--out", &out])?;
    let compare = [
        "compare",
        &pendulum,
        "--restart",
        "--repeats",
        "2",
        "--budget",
        "0.5",
        "--time-limit",
        "2",
    ];
    mbs(&[&compare[..], &["--duration", "0.5", "--out", &out]].concat())?;
    let [double, coarse] = [scene("double-pendulum.toml"), place("coarse")];
    mbs(&["run", &double, "--duration", "1", "--step", "0.02", "--out", &coarse])?;
    mbs(&["diff", &double, &coarse, "--out", &place("diff.html")])?;
    let curve = ["--xy", "tip.x", "tip.y", "--out", &place("plot.html")];
    mbs(&[&["plot", coarse.as_str()][..], &curve].concat())?;
    let loops = scene("spatial-four-bar.toml");
    mbs(&["doctor", &loops, "--still", "--out", &out])?;
    let lengths = scene("sweeps/double-pendulum-lengths.toml");
    let sweep = ["--duration", "1", "--restart", "--page", "--traces", "4", "--out", &out];
    mbs(&[&["sweep", double.as_str(), lengths.as_str()][..], &sweep].concat())?;
    Ok(["run.html", "compare.html", "diff.html", "plot.html", "doctor.html", "sweep.html"])
}

/// A scene with a mesh on its first body, in a folder.
fn with_mesh(scene: &str, folder: &Path) -> Result<String, String> {
    let fault = |e: std::io::Error| format!("{}: {e}", folder.display());
    fs::create_dir_all(folder).map_err(fault)?;
    let text = fs::read_to_string(scene).map_err(|e| format!("{scene}: {e}"))?;
    let body = text.split("[[body]]").nth(1).and_then(|body| body.split('"').nth(1));
    let body = body.ok_or_else(|| format!("{scene} has no body"))?;
    let mesh = "v 0 0 0\nv 0.3 0 0\nv 0 0.3 0\nv 0 0 0.3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    fs::write(folder.join("mesh.obj"), mesh).map_err(fault)?;
    let shape = format!("\n[[shape]]\nbody = \"{body}\"\nmesh = {{ file = \"mesh.obj\" }}\n");
    let place = folder.join("with-mesh.toml");
    fs::write(&place, text + &shape).map_err(fault)?;
    Ok(place.display().to_string())
}

/// The name of the browser, which is installed if it is missing and if that is possible.
pub fn browser() -> Option<&'static str> {
    let found =
        || BROWSERS.into_iter().find(|name| output(Command::new(name).arg("--version")).is_some());
    found().or_else(|| {
        // an error is ignored: the browser is searched again in any case
        let _ = debian::install(&["chromium"]);
        found()
    })
}

/// Inspects a page at every width, in light and dark colours.
///
/// # Errors
///
/// The faults of the page.
pub fn look(browser: &str, page: &Path) -> Result<(), String> {
    look_with(browser, page, (&all_looks(), ""))
}

/// Inspects a page with a script that runs before all others.
fn look_with(browser: &str, page: &Path, (looks, before): (&[Look], &str)) -> Result<(), String> {
    let place = |e: std::io::Error| format!("{}: {e}", page.display());
    let html = fs::read_to_string(page).map_err(place)?;
    let probed = page.with_extension("probed.html");
    let mut faults = Vec::new();
    for (width, theme) in looks {
        let before = format!("{before}<script>window.probeTheme = \"{}\";</script>", theme.0);
        fs::write(&probed, with_probe(&html, &before)).map_err(place)?;
        let frame = page.with_extension("frame.html");
        let name = probed.file_name().unwrap_or_default().to_string_lossy();
        let text = include_str!("frame.html").replace("{{page}}", &name);
        fs::write(&frame, text.replace("{{width}}", &width.to_string())).map_err(place)?;
        let report = heard(browser, &frame, theme.1)?;
        if report != "sound" {
            faults.push(format!("{} at {width} px, {}: {report}", page.display(), theme.0));
        }
        fs::remove_file(&frame).map_err(place)?;
    }
    fs::remove_file(&probed).map_err(place)?;
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
}

/// Returns the report of a page. On a busy machine the browser may end before the page is drawn. Then the page is opened again.
fn heard(browser: &str, frame: &Path, theme: &str) -> Result<String, String> {
    /// Largest number of times that a page without a report is opened.
    const TRIALS: usize = 3;
    let mut report = String::new();
    for _ in 0..TRIALS {
        report = report_in(&dom(browser, frame, theme)?);
        // the frame contains this text until the page writes its report
        if report != "silent" {
            break;
        }
    }
    Ok(report)
}

fn with_probe(html: &str, before: &str) -> String {
    let probe = format!("<script>{}</script></body>", include_str!("probe.js"));
    html.replacen("<head>", &format!("<head>{CATCH}{before}"), 1).replacen("</body>", &probe, 1)
}

/// Report of the probe, from the page's text after its scripts.
pub(crate) fn report_in(dom: &str) -> String {
    let text =
        dom.split_once("<pre id=\"report\">").and_then(|(_, rest)| rest.split_once("</pre>"));
    let text = text.map_or("the browser showed nothing", |(text, _)| text);
    text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&")
}

/// The text of the page after its scripts.
pub(crate) fn dom(browser: &str, page: &Path, theme: &str) -> Result<String, String> {
    let profile = std::env::temp_dir().join(format!("xtask-pages-{}", std::process::id()));
    let mut command = Command::new(browser);
    command.args([
        "--headless",
        "--no-sandbox",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        "--disable-dev-shm-usage",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
        "--allow-file-access-from-files",
        "--window-size=1400,1000",
        "--virtual-time-budget=8000",
        "--dump-dom",
    ]);
    command.arg(format!("--blink-settings=preferredColorScheme={theme}"));
    command.arg(format!("--user-data-dir={}", profile.display()));
    command.arg(format!("file://{}", absolute(page).display()));
    let out = command.stdin(Stdio::null()).output().map_err(|e| format!("{browser}: {e}"))?;
    // an error is ignored: no other program needs the profile
    let _ = fs::remove_dir_all(profile);
    Ok(String::from_utf8_lossy(&out.stdout).into_owned())
}

fn absolute(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_path_buf())
}

/// Runs the `mbs` that the tests build, without showing its output.
fn mbs(arguments: &[&str]) -> Result<(), String> {
    let mut command = Command::new(process::tested("mbs", "command")?);
    command.args(arguments).current_dir(process::root()).stdout(Stdio::null());
    process::run(&mut command)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_short_form_has_each_width_and_each_colours() {
        assert!(WIDTHS.iter().all(|width| SHORT.iter().any(|look| look.0 == *width)));
        assert!(THEMES.iter().all(|theme| SHORT.iter().any(|look| look.1 == *theme)));
        assert_eq!(all_looks().len(), WIDTHS.len() * THEMES.len());
    }

    #[test]
    fn a_page_gets_the_probe_and_its_report_is_read() {
        let page = with_probe("<html><head><title>x</title></head><body>y</body></html>", "");
        assert!(
            page.starts_with("<html><head><script>window.probeFaults")
                && page.ends_with("</script></body></html>")
        );
        assert_eq!(report_in("<pre id=\"report\">faults\na &lt; b</pre>"), "faults\na < b");
        assert_eq!(report_in("<p>"), "the browser showed nothing");
    }
}

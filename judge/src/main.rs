//! `judge --seeds A..B [--formulation F]`: random scenes by seed through the crates, held against the judge; `--cases [STRIDE]`: the
//! enumerated ones. `--scene` prints the scene of a seed or a case, `--look` what is off in it.

mod trial;

use judge::random;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::process::ExitCode;
use trial::{Method, Verdict};

const METHODS: [Method; 6] = [
    ["index-3", "trapezoidal"],
    ["index-1", "trapezoidal"],
    ["classical", "trapezoidal"],
    ["state-space", "trapezoidal"],
    ["recursive", "trapezoidal"],
    ["multi-index", "trapezoidal"],
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |key: &str| {
        arguments.iter().position(|a| a == key).and_then(|i| arguments.get(i + 1)).cloned()
    };
    let (only, integrator) = (value("--formulation"), value("--integrator"));
    let out = &mut std::io::stdout();
    if let Some(name) = value("--scene") {
        let _ = match drawn(&name) {
            Some(drawn) => {
                writeln!(out, "# step {:?}, {} steps\n{}", drawn.step, drawn.steps, drawn.text)
            }
            None => writeln!(out, "no case of this name"),
        };
        return ExitCode::SUCCESS;
    }
    if let Some(name) = value("--look") {
        let is_asked = |[f, i]: &Method| {
            only.as_deref().unwrap_or("index-3") == *f
                && integrator.as_deref().unwrap_or("trapezoidal") == *i
        };
        let method = trial::oracle::methods().into_iter().find(is_asked).unwrap_or(METHODS[0]);
        let text = drawn(&name).map_or("no case of this name".to_owned(), |d| look(&d, method));
        let _ = write!(out, "{text}");
        return ExitCode::SUCCESS;
    }
    // a panic of a run is a verdict
    std::panic::set_hook(Box::new(|_| {}));
    if arguments.iter().any(|a| a == "--cases") {
        let mut tally = trial::oracle::Tally::default();
        let stride: usize = value("--cases").and_then(|s| s.parse().ok()).unwrap_or(1);
        let cases: Vec<_> = random::cases().into_iter().step_by(stride).collect();
        for case in &cases {
            trial::oracle::case(case, &mut tally);
        }
        for line in &tally.wrong {
            let _ = writeln!(out, "{line}");
        }
        let n = tally.agree + tally.wrong.len() + tally.left_out.values().sum::<usize>();
        let _ = writeln!(
            out,
            "{} cases, {n} combinations: {} agree, {} are wrong",
            cases.len(),
            tally.agree,
            tally.wrong.len()
        );
        for (reason, n) in &tally.left_out {
            let _ = writeln!(out, "{n} left out: {reason}");
        }
        return ExitCode::from(u8::from(!tally.wrong.is_empty()));
    }
    let seeds = value("--seeds").unwrap_or_else(|| "1..100".to_owned());
    let Some((first, last)) =
        seeds.split_once("..").and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)))
    else {
        eprintln!(
            "usage: judge --seeds A..B [--formulation F] [--integrator I] [--scene SEED|CASE] [--look SEED|CASE] [--cases [STRIDE]]"
        );
        return ExitCode::FAILURE;
    };
    let mut tally = Tally::default();
    for seed in first..=last {
        let lines = one(seed, only.as_deref(), &mut tally);
        let _ = write!(out, "{lines}");
    }
    let _ = write!(out, "{}", tally.text());
    ExitCode::from(u8::from(tally.differences > 0))
}

/// The scene of a seed or of a case.
fn drawn(name: &str) -> Option<random::Drawn> {
    if let Ok(seed) = name.parse() {
        return Some(random::scene(seed));
    }
    let text = random::cases().into_iter().find(|case| case.name == name)?.text;
    Some(random::Drawn { text, step: trial::oracle::STEP, steps: trial::oracle::STEPS })
}

/// Channels of a scene that are off, at the start and at the end: as the crates have them, as the judge has them.
fn look(drawn: &random::Drawn, method: Method) -> String {
    let mut out = random::kinds(&drawn.text).join(", ");
    let (judged, scene) =
        match (trial::judge(&drawn.text, drawn.step, drawn.steps), trial::document(&drawn.text)) {
            (Ok(judged), Ok(scene)) => (judged, scene),
            (Err(why), _) | (_, Err(why)) => return why,
        };
    let rows = match trial::rows(&scene, method, drawn.step, drawn.steps, 1) {
        Ok(rows) => rows,
        Err(verdict) => return format!("{out}\n{verdict:?}\n"),
    };
    for (i, (row, right)) in rows.iter().zip(&judged.rows).enumerate() {
        if i != 0 && i + 1 != rows.len() {
            continue;
        }
        let _ = writeln!(out, "\nrow {i}");
        for part in trial::parts(&judged) {
            let output = &judged.mechanism.scene.outputs[part.output];
            let (found, right) = (&row[part.components.clone()], &right[part.components.clone()]);
            let size = right.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
            let off = found.iter().zip(right).fold(0.0_f64, |a, (x, y)| a.max((x - y).abs()));
            if off > 1e-7 * size {
                let _ =
                    writeln!(out, "{:16} {off:.1e} off: {found:?}, judge {right:?}", output.name);
            }
        }
    }
    out
}

#[derive(Default)]
struct Tally {
    scenes: usize,
    unjudged: usize,
    differences: usize,
    verdicts: BTreeMap<(String, String), usize>,
    kinds: BTreeMap<String, usize>,
}

fn one(seed: u64, only: Option<&str>, tally: &mut Tally) -> String {
    let mut out = String::new();
    let drawn = random::scene(seed);
    tally.scenes += 1;
    for kind in random::kinds(&drawn.text) {
        *tally.kinds.entry(kind).or_default() += 1;
    }
    let judged = match trial::judge(&drawn.text, drawn.step, drawn.steps) {
        Ok(judged) => judged,
        Err(why) => {
            tally.unjudged += 1;
            let _ = writeln!(out, "{seed:5} {why}");
            return out;
        }
    };
    let scene = match trial::document(&drawn.text) {
        Ok(scene) => scene,
        Err(why) => {
            tally.unjudged += 1;
            let _ = writeln!(out, "{seed:5} unread: {why}");
            return out;
        }
    };
    for method in METHODS {
        if only.is_some_and(|o| o != method[0]) {
            continue;
        }
        let verdict = trial::trial(&judged, &scene, method, drawn.step, drawn.steps);
        let key = match &verdict {
            Verdict::Agrees => "agrees".to_owned(),
            Verdict::Differs { channel, off, allowed, size, start } => {
                tally.differences += 1;
                let _ = writeln!(
                    out,
                    "{seed:5} {:12} DIFFERS  {} {channel}: off {off:.2e}, allowed {allowed:.2e}, size {size:.2e}; least pivot {:.1e}",
                    method[0],
                    if *start { "at the start" } else { "" },
                    judged.least_pivot
                );
                if *start { "differs (start)" } else { "differs (run)" }.to_owned()
            }
            Verdict::Stops { code, time, message } => {
                let place = if *time > 0.0 { "run" } else { "start" };
                let _ = writeln!(
                    out,
                    "{seed:5} {:12} stops    {code} at {time:.3e} s of {:.3e}: {message}; least pivot {:.1e}",
                    method[0],
                    f64::from(drawn.steps) * drawn.step,
                    judged.least_pivot
                );
                format!("{code} ({place})")
            }
            Verdict::Panics => {
                let _ = writeln!(out, "{seed:5} {:12} PANICS", method[0]);
                tally.differences += 1;
                "panics".to_owned()
            }
        };
        *tally.verdicts.entry((method[0].to_owned(), key)).or_default() += 1;
    }
    out
}

impl Tally {
    fn text(&self) -> String {
        let mut out = String::new();
        let _ = writeln!(out, "\n{} scenes, {} without a judgement", self.scenes, self.unjudged);
        for ((method, verdict), n) in &self.verdicts {
            let _ = writeln!(out, "{method:12} {verdict:28} {n}");
        }
        for (kind, n) in &self.kinds {
            #[allow(clippy::cast_precision_loss, reason = "a share to show")]
            let share = 100.0 * *n as f64 / self.scenes as f64;
            let _ = writeln!(out, "{kind:28} in {share:.1} % of the scenes");
        }
        out
    }
}

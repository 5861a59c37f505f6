//! Statistics of outputs over every step: against the rows, against closed forms, and of runs that stop.

use crate::common::{run, run_by, scene};
use core::ops::ControlFlow;
use mbs::core::control::Accepted;
use mbs::record::{ChannelSeries, Provenance, Statistics};
use mbs::scene_file::SceneFile;
use mbs::typed::{Simulation, StepObserver};
use mbs::{Method, Outcome, ResolvedMethod, StopError};

/// Difference from what rows give, relative to the number's size [-]: magnitudes are summed in the same order.
const SAME: f64 = 1e-12;
/// The same of root mean squares [-]: a sum over up to 10^4 steps.
const SAME_RMS: f64 = 1e-9;

/// A mass of 2 kg that slides on a spring of 50 N/m, 0.1 m from rest: x = 0.1 cos 5 t.
const OSCILLATOR: &str = r#"
[scene]
dimension = 2
duration = 3.0
[[body]]
name = "slider"
mass = 2.0
center = [0.0, 0.0]
inertia = 1.0
[[joint]]
name = "slide"
kind = "prismatic"
bodies = ["ground", "slider"]
at = [0.0, 0.0]
axis = [1.0, 0.0]
[[initial]]
joint = "slide"
value = 0.1
[[effect]]
name = "spring"
kind = "torsion-spring"
joint = "slide"
coordinate = "slide"
stiffness = 50.0
free_value = 0.0
[[output]]
name = "x"
joint = "slide"
[[output]]
name = "v"
body = "slider"
quantity = "velocity"
"#;

/// Amplitude [m] and angular frequency [rad/s] of [`OSCILLATOR`].
const WAVE: [f64; 2] = [0.1, 5.0];

fn series(outcome: &Outcome) -> Vec<ChannelSeries> {
    outcome.record(Provenance::default()).channels
}

/// Statistics of a number over rows.
fn of_rows(times: &[f64], x: &[f64]) -> Statistics {
    let place = |is_better: &dyn Fn(f64, f64) -> bool| {
        (1..x.len()).fold(0, |best, i| if is_better(x[i], x[best]) { i } else { best })
    };
    let (least, most) = (place(&|a, b| a < b), place(&|a, b| a > b));
    let square = |i: usize| (times[i] - times[i - 1]) * (x[i].powi(2) + x[i - 1].powi(2)) / 2.0;
    let time = times[times.len() - 1] - times[0];
    Statistics {
        min: x[least],
        at_min: times[least],
        max: x[most],
        at_max: times[most],
        rms: ((1..x.len()).map(square).sum::<f64>() / time).sqrt(),
        end: x[x.len() - 1],
    }
}

fn assert_same(found: &Statistics, expected: &Statistics, what: &str) {
    let size = expected.min.abs().max(expected.max.abs());
    let pairs = [
        (found.min, expected.min),
        (found.at_min, expected.at_min),
        (found.max, expected.max),
        (found.at_max, expected.at_max),
        (found.end, expected.end),
    ];
    for (found, expected) in pairs {
        let error = (found - expected).abs();
        assert!(error <= SAME * size.max(1.0), "{what}: {found} for {expected}");
    }
    assert!((found.rms - expected.rms).abs() <= SAME_RMS * size, "{what}: {found:?} {expected:?}");
}

/// Compares the statistics of all channels of a run whose rows are its steps; gives how many magnitudes there were.
fn magnitudes_like_rows(outcome: &Outcome, what: &str) -> usize {
    let (mut n_numbers, mut n_magnitudes) = (0, 0);
    for series in series(outcome) {
        let n = series.channel.components.len();
        for (i, stats) in series.stats.iter().enumerate() {
            let what = format!("{what}: {}.{}", series.channel.name, stats.label);
            let values = match stats.is_magnitude {
                false => series.values[i].clone(),
                true => {
                    let prefix = if stats.label == "abs" { "" } else { &stats.label };
                    let is_part = |label: &str| {
                        label.strip_prefix(prefix).is_some_and(|x| ["x", "y", "z"].contains(&x))
                    };
                    let parts = series.channel.components.iter().zip(&series.values);
                    let parts: Vec<_> =
                        parts.filter(|(c, _)| is_part(&c.label)).map(|(_, x)| x).collect();
                    let square = |k: usize| parts.iter().map(|x| x[k] * x[k]).sum::<f64>();
                    (0..series.times.len()).map(|k| square(k).sqrt()).collect()
                }
            };
            assert_same(&stats.of, &of_rows(&series.times, &values), &what);
        }
        n_numbers += n;
        n_magnitudes += series.stats.len() - n;
    }
    assert!(n_numbers > 0, "{what}");
    n_magnitudes
}

#[test]
fn statistics_are_those_of_the_rows_where_each_step_is_one() {
    let mut n_magnitudes = 0;
    for name in ["slider-crank", "iltis-suspension"] {
        let method = Method { duration: Some(0.5), ..Method::default() };
        let outcome = run(&scene(name), &method);
        assert!(outcome.summary.completed, "{name}: {:?}", outcome.error);
        n_magnitudes += magnitudes_like_rows(&outcome, name);
    }
    let document = SceneFile::parse(OSCILLATOR, "oscillator.toml").expect("a scene");
    let scene = document.scene::<f64>().expect("a scene");
    let control = Some("energy".to_owned());
    let controlled = Method { step_control: control, step_max: Some(0.05), ..Method::default() };
    let outcome = run(&scene, &controlled);
    assert!(outcome.summary.control.is_some() && outcome.summary.completed);
    n_magnitudes += magnitudes_like_rows(&outcome, "controlled");
    assert!(n_magnitudes > 1, "there are vectors");
}

#[test]
fn statistics_of_an_oscillator_are_those_of_its_closed_form_though_rows_are_thinned() {
    let document = SceneFile::parse(OSCILLATOR, "oscillator.toml").expect("a scene");
    let scene = document.scene::<f64>().expect("a scene");
    let [a, w] = WAVE;
    // every fourth step is a row: peaks fall between rows
    let duration = 3.0;
    let step = duration / 30_021.0;
    let method = Method { step: Some(step), duration: Some(duration), ..Method::default() };
    let outcome = run(&scene, &method);
    assert!(outcome.summary.steps > 2 * outcome.rows().len() as u64, "rows are thinned");
    let channels = series(&outcome);
    let [x, v] = &channels[..] else { panic!("two outputs") };
    let [x, speed] = [x.stats[0].of, v.stats[2].of];
    assert_eq!((v.stats[2].label.as_str(), v.stats[2].is_magnitude), ("abs", true));
    // error of the trapezoidal rule and of the nearest step to a peak: (w h)^2, and the phase w^3 h^2 t/12
    let small = (w * step).powi(2) * w * duration;
    let mean = (0.5 + (2.0 * w * duration).sin() / (4.0 * w * duration)).sqrt();
    let checks = [
        (x.max, a),
        (x.min, -a),
        (x.rms, a * mean),
        (x.end, a * (w * duration).cos()),
        (speed.max, a * w),
    ];
    for (found, expected) in checks {
        assert!((found - expected).abs() <= small * a * w, "{found} for {expected}");
    }
    // periods are equal up to rounding: any of them may have the largest value
    let period = 2.0 * core::f64::consts::PI / w;
    for (t, of_period) in [(x.at_max, 0.0), (x.at_min, 0.5), (v.stats[0].of.at_min, 0.25)] {
        let periods = t / period - of_period;
        assert!((periods - periods.round()).abs() * period < step, "{t} for {of_period}");
    }
}

/// Ends a run at a time.
struct Until(f64);

impl<const D: usize> StepObserver<f64, D> for Until {
    fn step(
        &mut self,
        now: &Simulation<f64, D>,
        _: &Accepted<f64>,
        _: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        let is_over = now.state().t >= self.0;
        let stop = || StopError::Observer { code: "enough", message: "".into(), hint: "".into() };
        if is_over { Err(stop()) } else { Ok(ControlFlow::Continue(())) }
    }
}

#[test]
fn a_run_that_stops_has_the_statistics_of_its_steps() {
    let document = SceneFile::parse(OSCILLATOR, "oscillator.toml").expect("a scene");
    let scene = document.scene::<f64>().expect("a scene");
    let method =
        |duration| Method { step: Some(0.001), duration: Some(duration), ..Method::default() };
    let settings = ResolvedMethod::new(&scene, &method(3.0)).expect("settings");
    let stopped = mbs::typed::run::<f64, 2>(&scene, &settings, &mut Until(0.3995));
    assert!(!stopped.summary.completed && stopped.summary.end_time < 0.5);
    let settings = ResolvedMethod::new(&scene, &method(0.4)).expect("settings");
    let whole = run_by(&scene, &settings);
    for (stopped, whole) in series(&stopped).iter().zip(&series(&whole)) {
        for (stopped, whole) in stopped.stats.iter().zip(&whole.stats) {
            assert_same(&stopped.of, &whole.of, &whole.label);
        }
    }
    assert_eq!(stopped.summary.channels.len(), 2);
    assert_eq!(stopped.summary.channels[1].components, ["x", "y", "abs"]);
    assert_eq!(stopped.summary.channels[1].unit.as_deref(), Some("m/s"));
}

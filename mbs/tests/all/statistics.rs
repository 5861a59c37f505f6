//! Statistics of outputs over every step: against the rows, against closed forms, and of runs that stop.

use crate::common::{run, run_by, scene};
use core::ops::ControlFlow;
use mbs::core::control::Accepted;
use mbs::inside::turning_point;
use mbs::record::{ChannelSeries, Provenance, Statistics};
use mbs::scene_file::SceneFile;
use mbs::typed::{Simulation, StepObserver};
use mbs::{Method, Outcome, ResolvedMethod, StopError};

/// Relative difference from statistics of the rows [-]: magnitudes are summed in the same order.
const SAME: f64 = 1e-12;
/// Relative difference of root mean squares [-], which are sums over up to 10^4 steps.
const SAME_RMS: f64 = 1e-9;

/// Scene of a mass of 2 kg that slides on a spring of 50 N/m, 0.1 m from equilibrium: x = 0.1 cos 5 t.
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

/// Largest excess of a peak between rows, relative to the difference of its row from the neighbours [-]. For a parabola it is an eighth.
const BETWEEN: f64 = 0.25;

/// Compares statistics with those of rows. A peak is that of a row, or lies between rows and exceeds the row slightly.
fn assert_like_rows(found: &Statistics, (times, x): (&[f64], &[f64]), what: &str) {
    let rows = of_rows(times, x);
    let size = rows.min.abs().max(rows.max.abs());
    for (sign, peak, at, of_rows) in
        [(1.0, found.max, found.at_max, rows.max), (-1.0, found.min, found.at_min, rows.min)]
    {
        let beyond = sign * (peak - of_rows);
        assert!(beyond >= -SAME * size, "{what}: {peak} for {of_rows}");
        let most = (1..x.len() - 1)
            .filter(|&i| times[i - 1] <= at && at <= times[i + 1])
            .map(|i| {
                let apart = (x[i] - x[i - 1]).abs().max((x[i] - x[i + 1]).abs());
                sign * (x[i] - of_rows) + BETWEEN * apart
            })
            .fold(0.0, f64::max);
        assert!(beyond <= most + SAME * size.max(1.0), "{what}: {peak} at {at} for {of_rows}");
    }
    let (min, at_min, max, at_max) = (rows.min, rows.at_min, rows.max, rows.at_max);
    assert_same(&Statistics { min, at_min, max, at_max, ..*found }, &rows, what);
}

/// Compares the statistics of all channels of a run whose rows are its steps. Returns the number of magnitudes.
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
            assert_like_rows(&stats.of, (&series.times, &values), &what);
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
    // every fourth step is a row, so peaks are between rows
    let duration = 3.0;
    let step = duration / 30_021.0;
    let method = Method { step: Some(step), duration: Some(duration), ..Method::default() };
    let outcome = run(&scene, &method);
    assert!(outcome.summary.steps > 2 * outcome.rows().len() as u64, "rows are thinned");
    let channels = series(&outcome);
    let [x, v] = &channels[..] else { panic!("two outputs") };
    let [x, speed] = [x.stats[0].of, v.stats[2].of];
    assert_eq!((v.stats[2].label.as_str(), v.stats[2].is_magnitude), ("abs", true));
    // the limit covers errors at frequency w with steps h: (w h)^2 by the step nearest to a peak, and the phase error w^3 h^2 t/12 of the
    // trapezoidal rule
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
    // periods are equal except for rounding, so any of them may have the largest value
    let period = 2.0 * core::f64::consts::PI / w;
    for (t, of_period) in [(x.at_max, 0.0), (x.at_min, 0.5), (v.stats[0].of.at_min, 0.25)] {
        let periods = t / period - of_period;
        assert!((periods - periods.round()).abs() * period < step, "{t} for {of_period}");
    }
}

#[test]
fn peaks_between_long_steps_are_those_of_the_closed_form() {
    let document = SceneFile::parse(OSCILLATOR, "oscillator.toml").expect("a scene");
    let scene = document.scene::<f64>().expect("a scene");
    let [a, w] = WAVE;
    // 25 steps in a period: the rule conserves the amplitude, and steps miss the peaks by up to 0.8 % of it
    let step = 0.05;
    let outcome = run(&scene, &Method { step: Some(step), ..Method::default() });
    let channels = series(&outcome);
    let x = channels[0].stats[0].of;
    let rows = channels[0].values[0].iter();
    let of_rows = rows.fold(0.0, |least: f64, x| least.min(*x));
    assert!(of_rows + a > 1e-4 * a, "{of_rows} is a peak");
    for (found, right) in [(x.min, -a), (x.max, a)] {
        assert!((found - right).abs() < 4e-5 * a, "{found} for {right}");
    }
    // the rule rotates the phase by θ in a step, with tan(θ/2) = w h/2, which gives the period
    let period = core::f64::consts::PI * step / (w * step / 2.0).atan();
    let halves = x.at_min / period - 0.5;
    assert!((halves - halves.round()).abs() < 1e-3, "{} of {period}", x.at_min);
}

/// Times of five instants, equally spaced or not [s].
const SPACINGS: [[f64; 5]; 3] =
    [[-2.0, -1.0, 0.0, 1.0, 2.0], [-2.5, -1.2, 0.0, 0.7, 1.9], [-1.0, -0.6, 0.0, 1.3, 2.0]];

#[test]
fn a_peak_of_a_polynomial_is_exact_and_its_opposite_is_too() {
    let quartic = |t: f64| 3.0 + (t - 0.2).powi(2) * (1.0 + 0.1 * t + 0.02 * t * t);
    for times in SPACINGS {
        let (at, value) = turning_point(times, times.map(quartic)).expect("a turning point");
        assert!((at - 0.2).abs() < 1e-12 && (value - 3.0).abs() < 1e-12, "{at}, {value}");
        let (at, value) = turning_point(times, times.map(|t| -quartic(t))).expect("a peak");
        assert!((at - 0.2).abs() < 1e-12 && (value + 3.0).abs() < 1e-12, "{at}, {value}");
    }
}

#[test]
fn a_number_that_jumps_or_has_a_kink_has_no_peak_beyond_its_steps() {
    for times in SPACINGS {
        for k in -9..=9 {
            let at = f64::from(k) / 10.0;
            let bent = |t: f64| if t < at { 0.0 } else { 3.0 * (t - at) };
            let jump = |t: f64| if t < at { 0.0 } else { 1.0 };
            let tooth = |t: f64| if t < at { t } else { t - 1.0 };
            for sign in [1.0, -1.0] {
                for of in [&bent as &dyn Fn(f64) -> f64, &jump, &tooth] {
                    let values = times.map(|t| sign * of(t));
                    let found = turning_point(times, values);
                    assert!(found.is_none(), "{at} {values:?}: {found:?}");
                }
                let kink = times.map(|t| sign * (t - at).abs());
                let found = turning_point(times, kink);
                assert!(found.is_none_or(|(_, x)| sign * x >= 0.0), "{at} {kink:?}: {found:?}");
            }
        }
    }
}

/// Observer that ends a run at a time.
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

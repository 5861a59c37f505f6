//! Writes the page of a made-up run: a double pendulum, planar or with a third dimension, to a file.
//!
//! `cargo run -p mbs-scene --example page -- run.html [3]`

use mbs_scene::{
    Animation, Channel, ChannelSeries, Component, EnergySeries, IterationSeries, Polyline,
    Provenance, RunRecord, Trace, ViolationSeries, page,
};

/// Accelerations of two point masses of 1 kg on massless rods of 1 m, angles from the vertical.
fn accelerations([a, b, u, v]: [f64; 4]) -> [f64; 4] {
    let (g, (s, c)) = (9.81, (a - b).sin_cos());
    let d = 2.0 - c * c;
    let au = (-c * s * u * u - s * v * v - 2.0 * g * a.sin() + g * c * b.sin()) / d;
    let av = (2.0 * s * u * u + c * s * v * v + 2.0 * g * c * a.sin() - 2.0 * g * b.sin()) / d;
    [u, v, au, av]
}

fn step(x: [f64; 4], h: f64) -> [f64; 4] {
    let add = |k: [f64; 4], h: f64| core::array::from_fn(|i| x[i] + h * k[i]);
    let k1 = accelerations(x);
    let k2 = accelerations(add(k1, h / 2.0));
    let k3 = accelerations(add(k2, h / 2.0));
    let k4 = accelerations(add(k3, h));
    core::array::from_fn(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
}

fn main() -> std::io::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let file = arguments.first().map_or("run.html", String::as_str);
    let spatial = arguments.get(1).is_some_and(|dimension| dimension == "3");
    std::fs::write(file, page(&run(spatial)))
}

fn run(spatial: bool) -> RunRecord {
    let (h, mut x) = (2.0e-3, [2.0_f64, 1.5, 0.0, 0.0]);
    let mut tip = [vec![], vec![], vec![]];
    let (mut times, mut frames, mut angles) = (vec![], vec![], [vec![], vec![]]);
    let (mut energy, mut violation) = (EnergySeries::default(), ViolationSeries::default());
    let mut iterations = IterationSeries::default();
    for i in 0..5000_u32 {
        let t = f64::from(i) * h;
        let [a, b, u, v] = x;
        let (p, q) = ([a.sin(), -a.cos()], [a.sin() + b.sin(), -a.cos() - b.cos()]);
        let tilt = if spatial { 0.3 * (0.7 * t).sin() } else { 0.0 };
        let turned = |[x, y]: [f64; 2]| [x * tilt.cos(), x * tilt.sin(), y];
        let points = [[0.0, 0.0], p, q];
        frames.push(if spatial {
            points.into_iter().flat_map(turned).collect()
        } else {
            points.concat()
        });
        for (values, x) in tip.iter_mut().zip(turned(q)) {
            values.push(x);
        }
        angles[0].push(a);
        angles[1].push(b);
        energy.kinetic.push(u * u + 0.5 * v * v + u * v * (a - b).cos());
        energy.potential.push(9.81 * (p[1] + q[1] + 2.0));
        violation.position.push(1.0e-12 * (1.0 + (3.0 * t).sin()).powi(2));
        violation.velocity.push(1.0e-10 * (1.2 + (5.0 * t).cos()));
        violation.acceleration.push(1.0e-8 * (1.0 + v.abs()));
        iterations.counts.push(2 + u32::from(v.abs() > 7.0) + u32::from(i == 3333) * 3);
        times.push(t);
        x = step(x, h);
    }
    let sum = |i: usize| energy.kinetic[i] + energy.potential[i];
    energy.invariant_error = (0..times.len()).map(|i| sum(i) - sum(0)).collect();
    energy.times.clone_from(&times);
    violation.times.clone_from(&times);
    iterations.times.clone_from(&times);
    RunRecord {
        scene: "double pendulum".into(),
        provenance: provenance(),
        channels: channels(&times, tip, angles, spatial),
        animation: Some(animation(times, frames, spatial)),
        energy: Some(energy),
        violation: Some(violation),
        iterations: Some(iterations),
        steps: None,
        summary: [
            ("time reached", "9.998 s of 10 s"),
            ("degrees of freedom", "2"),
            ("steps", "5000"),
        ]
        .map(|(label, value)| (label.to_owned(), value.to_owned()))
        .to_vec(),
        notes: vec![
            "joint `elbow` repeats what joint `pivot` already holds: 1 redundant row".into(),
        ],
        error: spatial
            .then(|| "at t = 9.998 s: Newton did not converge. Hint: try half the step.".into()),
        choice: Vec::new(),
    }
}

fn provenance() -> Provenance {
    Provenance {
        command: "mbs run scenes/double_pendulum.toml --step 2e-3 --out out".into(),
        precision: "f64".into(),
        formulation: "index-3".into(),
        integrator: "trapezoidal".into(),
        step: "0.002 s".into(),
        version: "0.1.0".into(),
        cpu: "made up".into(),
    }
}

fn channels(
    times: &[f64],
    tip: [Vec<f64>; 3],
    angles: [Vec<f64>; 2],
    spatial: bool,
) -> Vec<ChannelSeries> {
    let component = |label: &str, unit: &str| Component { label: label.into(), unit: unit.into() };
    let series = |name: &str, components, values| ChannelSeries {
        channel: Channel { name: name.into(), components },
        times: times.to_vec(),
        values,
    };
    let labels: &[&str] = if spatial { &["x", "y", "z"] } else { &["x", "y"] };
    let [x, y, z] = tip;
    let values = if spatial { vec![x, y, z] } else { vec![x, z] };
    let [a, b] = angles;
    vec![
        series("tip", labels.iter().map(|label| component(label, "m")).collect(), values),
        series("pivot", vec![component("", "rad")], vec![a]),
        series("elbow", vec![component("", "rad")], vec![b]),
    ]
}

fn animation(times: Vec<f64>, frames: Vec<Vec<f64>>, spatial: bool) -> Animation {
    let rod = |name: &str, i| Polyline { name: name.into(), chains: vec![vec![i, i + 1]] };
    Animation {
        dimension: if spatial { 3 } else { 2 },
        up: [0.0, 0.0, 1.0],
        times,
        frames,
        bodies: vec![rod("upper", 0), rod("lower", 1)],
        ground: vec![[0.0; 3]],
        rails: vec![],
        traces: vec![Trace { name: "tip".into(), point: 2 }],
    }
}

//! Runs of a scene by the judge and by the product, which is the crates: rows of channels, and verdicts.

use crate::scene::{Coupled, Output, Quantity};
use crate::{Mechanism, State};
use mbs::core::scene::Scene;
use mbs::scene_file::SceneFile;
use mbs::{FormulationKind, Method, Run};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Largest allowed error of an integrator, relative to the difference of its runs with h and h/2 [-]. Chosen, not tuned.
pub const ERROR_FACTOR: f64 = 10.0;
/// Largest difference that counts as machine precision, relative to a channel's size [-]. Chosen, not tuned.
pub const ROUNDING: f64 = 1e-7;
/// Tolerance of the judge's steps [-]. Chosen, not tuned.
const TOLERANCE: f64 = 1e-11;

/// True if the formulation controls its steps by the energy.
pub(super) fn is_steered(formulation: &str) -> bool {
    FormulationKind::of_name(formulation).is_some_and(|f| f.row().energy_rule)
}

/// A method: a formulation with an integrator.
pub type Way = [&'static str; 2];

/// Verdict on a run.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// Run that agrees with the judge.
    Agrees,
    /// Run that ends well and differs from the judge.
    Differs {
        /// The output with the largest difference, relative to the allowed one.
        channel: String,
        /// Largest difference of the output from that of the judge.
        off: f64,
        /// Largest difference that is allowed.
        allowed: f64,
        /// Largest value of the output.
        size: f64,
        /// True if the output differs at the start already.
        start: bool,
    },
    /// Run that stops.
    Stops {
        /// The code of the stop, or `refused`.
        code: String,
        /// Time of the stop; 0 at the start [s].
        time: f64,
        /// Message of the command.
        message: String,
    },
    /// Run that panics.
    Panics,
}

/// Rows of all channels at multiples of a step.
pub type Rows = Vec<Vec<f64>>;

/// Results of the judge for a scene.
#[derive(Debug)]
pub struct Judged {
    /// Mechanism of the scene.
    pub mechanism: Mechanism,
    /// Outputs of the mechanism at the ends of the steps.
    pub rows: Rows,
    /// A time scale of the motion [s].
    pub time: f64,
    /// Number of components of each output, and whether its value is unique.
    pub channels: Vec<(usize, bool)>,
    /// The smallest pivot during the motion.
    pub least_pivot: f64,
    /// True if rows of joints depend on each other, so that reactions are not unique.
    pub is_redundant: bool,
}

/// Runs the judge on a scene.
///
/// # Errors
/// A message with the reason why the judge does not run.
pub fn judge(text: &str, step: f64, steps: u32) -> Result<Judged, String> {
    let mechanism = Mechanism::new(crate::read(text).map_err(|e| e.0)?);
    let mut state = mechanism.start().map_err(|e| format!("judge: {e:?}"))?;
    let begun = mechanism.evaluate(&state);
    if begun.unmet > 1e-9 {
        return Err("judge: a force meets no inertia".to_owned());
    }
    let outputs = mechanism.scene.outputs.clone();
    let show = |state: &State| -> Vec<Vec<f64>> {
        outputs.iter().map(|o| mechanism.channel(state, o)).collect()
    };
    let first = show(&state);
    // rotation of a thin rod about its own line is undetermined
    let turns_idle = |j: usize| {
        let joint = &mechanism.scene.joints[j];
        joint.bodies.iter().flatten().any(|&b| begun.idle[b])
    };
    let is_unique = |q: Quantity| match q {
        Quantity::Reaction(j) | Quantity::Effort(j) | Quantity::Power(j) => begun.unique[j],
        Quantity::Coupling(k, Coupled::Effort | Coupled::Power) => begun.unique_couplings[k],
        Quantity::Contact(k) => begun.unique_contacts[k],
        // without a law or a value these are zero up to the rounding of their terms, so that they are not compared
        Quantity::Coupling(k, Coupled::Rate) => mechanism.scene.couplings[k].law.is_some(),
        Quantity::Coupling(k, Coupled::Value) => {
            let coupling = &mechanism.scene.couplings[k];
            coupling.law.is_some() || coupling.value.abs() > 0.0
        }
        Quantity::Value(j) | Quantity::Rate(j) | Quantity::JointAcceleration(j) => !turns_idle(j),
        Quantity::AngularVelocity(b) | Quantity::AngularAcceleration(b) => !begun.idle[b],
        // the crates choose the nearest angle or quaternion, which differs after whole turns
        Quantity::RotationMatrix(b) => !begun.idle[b],
        Quantity::Orientation(b) | Quantity::RotationVector(b) => {
            let frame = &state.frames[b];
            !begun.idle[b] && frame.angle.abs() < core::f64::consts::PI && frame.q[0] > 0.0
        }
        _ => true,
    };
    let channels =
        first.iter().zip(&outputs).map(|(c, o)| (c.len(), is_unique(o.quantity))).collect();
    let mut rows = vec![first.concat()];
    let mut h = 0.3 * step;
    let mut least_pivot = mechanism.evaluate(&state).least_pivot;
    for i in 1..=steps {
        mechanism
            .advance(&mut state, f64::from(i) * step, &mut h, TOLERANCE)
            .map_err(|e| format!("judge: {e:?}"))?;
        let moved = mechanism.evaluate(&state);
        if moved.unmet > 1e-9 {
            return Err("judge: a force meets no inertia".to_owned());
        }
        least_pivot = least_pivot.min(moved.least_pivot);
        rows.push(show(&state).concat());
    }
    let channels = followed(channels, &outputs, &rows);
    let is_redundant = begun.is_redundant;
    Ok(Judged { mechanism, rows, time: 20.0 * step, channels, least_pivot, is_redundant })
}

/// Marks rotation vectors that jump by a whole turn as not unique: their values depend on how a program follows them.
fn followed(
    mut channels: Vec<(usize, bool)>,
    outputs: &[Output],
    rows: &[Vec<f64>],
) -> Vec<(usize, bool)> {
    let mut at = 0;
    for (channel, output) in channels.iter_mut().zip(outputs) {
        let jumps = |pair: &[Vec<f64>]| {
            (at..at + channel.0).any(|i| (pair[0][i] - pair[1][i]).abs() > core::f64::consts::PI)
        };
        if matches!(output.quantity, Quantity::RotationVector(_)) {
            channel.1 &= !rows.windows(2).any(jumps);
        }
        at += channel.0;
    }
    channels
}

/// Makes the mechanism of the crates from a text.
///
/// # Errors
/// The message of the crates' refusal.
pub fn product(text: &str) -> Result<mbs::Mechanism, String> {
    let document = SceneFile::parse(text, "drawn.toml").map_err(|e| e.render())?;
    let mechanism = mbs::Mechanism::of_file(document).map_err(|e| e.render())?;
    mechanism.resolve().map_err(|e| e.to_string())?;
    Ok(mechanism)
}

/// Makes the scene of the crates from a text.
///
/// # Errors
/// The message of the crates' refusal.
pub fn document(text: &str) -> Result<Scene<f64>, String> {
    let document = SceneFile::parse(text, "drawn.toml").map_err(|e| e.render())?;
    document.scene().map_err(|e| e.render())
}

/// Runs the crates with the step divided by `share`. Returns the rows at multiples of the step.
///
/// # Errors
/// The verdict on a run that does not end well.
pub fn rows(
    product: &mbs::Mechanism,
    [formulation, integrator]: Way,
    (step, steps): (f64, u32),
    share: u32,
) -> Result<Rows, Verdict> {
    let overrides = Method {
        formulation: Some(formulation.to_owned()),
        integrator: Some(integrator.to_owned()),
        step: Some(step / f64::from(share)),
        // an eighth of the tolerance halves the steps that the energy controls
        energy_tolerance: (is_steered(formulation) && share > 1).then(|| {
            let n = f64::from(share);
            [1e-5, 1e-7].map(|x| x / (n * n * n))
        }),
        // these integrators control their error by a tolerance, whatever the step is
        error_tolerance: ["gbs", "radau5"].contains(&integrator).then_some(1e-11),
        ..Method::default()
    };
    let stops = |code: &str, time: f64, message: String| Verdict::Stops {
        code: code.to_owned(),
        time,
        message,
    };
    let options = Run::new().method(overrides);
    let Ok(result) = catch_unwind(AssertUnwindSafe(|| mbs::run(product, &options))) else {
        return Err(Verdict::Panics);
    };
    let result = result.map_err(|e| stops("refused", 0.0, e.message().to_owned()))?;
    if let Some(error) = &result.summary().error {
        return Err(stops(&error.code, error.time, error.message.clone()));
    }
    // controlled steps coincide with the multiples of the step only at the start and the end
    let wanted = (0..=steps).filter(|i| !is_steered(formulation) || *i == 0 || *i == steps);
    let wanted = wanted.map(|i| f64::from(i) * step);
    let mut rows = Vec::new();
    let mut all = result.outcome().rows().iter();
    for t in wanted {
        match all.find(|row| (row.0 - t).abs() < 1e-6 * step) {
            Some(row) => rows.push(row.1.clone()),
            None => return Err(stops("no-row", t, "no row".to_owned())),
        }
    }
    Ok(rows)
}

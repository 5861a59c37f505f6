//! Drives: the input of each actuator, the signals computed from it, and the resulting effort.

use super::actuator::{Actuator, Dynamics};
use super::crank;
use super::defaults::is_actuator;
use super::effort::{self, Pull, Shared};
use super::flywheel;
use super::model::{Control, Model};
use super::springs;
use super::stops::{Factor, Lazy};
use super::strength::Strength;
use super::transmission::{Transmission, push, transmission};
use crate::element::Element;
use crate::robot::{Signal, What};
use crate::source::Read;

/// Reads the elements `actuator`.
pub(super) fn read<'a>(
    root: &'a Element,
    factor: &Lazy,
    model: &mut Model<'a, '_, '_>,
) -> Read<()> {
    let mut shared = Shared::default();
    for element in root.each("actuator").flat_map(|actuators| &actuators.children) {
        if !is_actuator(&element.name) {
            continue;
        }
        let actuator = Actuator::of(element, model.classes.actuators(element.read())?)?;
        for ending in model.endings(element) {
            add(element, &actuator, (&ending, factor), &mut shared, model)?;
        }
    }
    shared.finish(model);
    Ok(())
}

/// Adds an actuator to the model. An actuator that the scene cannot have is reported.
fn add(
    element: &Element,
    actuator: &Actuator,
    (ending, factor): (&str, &Lazy),
    shared: &mut Shared,
    model: &mut Model<'_, '_, '_>,
) -> Read<()> {
    let label = format!("actuator/{}", element.label());
    let found = if !model.compiler.acts.actuation {
        Err("actuation is disabled in the file".into())
    } else if let Some(why) = actuator.refusal(model.compiler.of(element.at).auto_limits) {
        Err(format!("{why}: the actuator does not act here"))
    } else {
        let found = if element.attribute("cranksite").is_some() {
            let of = (actuator.crank_length, ending);
            crank::slide(element, actuator.gear[0], of, model)?
        } else {
            transmission(element, &actuator.gear, ending, model)?
        };
        let found: Result<_, String> = found.and_then(|pulled| {
            let (size, is_slide) = pulled.size;
            let grown = actuator.grown(size, is_slide);
            let grown = grown.ok_or("a cylinder on a joint in a frame with a scale")?;
            if grown.has_ratio() && model.posed.is_some() {
                let says = "its damping follows from the inertia at the keyframe; there from that as drawn";
                model.context.findings.approximated(element.at, label.as_str(), says);
            }
            let damped = grown.damped(|| {
                let factor = factor.get_or_init(|| Factor::new(model)).as_ref()?;
                Some(factor.moved_by(&pulled.terms)? / pulled.gear.powi(2))
            })?;
            actuator.refusal_of(&pulled).map_or(Ok((damped, pulled)), Err)
        });
        found.map_err(|why| format!("{why}: the actuator does not act here"))
    };
    let (actuator, pulled) = match found {
        Ok(found) => found,
        Err(says) => {
            element.read_whole();
            model.context.findings.ignored(element.at, label, says);
            let activations = actuator.activations();
            model.inputs.push(Control { law: None, activation: None, factor: 1.0, activations });
            return Ok(());
        }
    };
    for says in &actuator.lost {
        let says = format!("{says}: does not act here");
        model.context.findings.ignored(element.at, label.as_str(), says);
    }
    for joint in effort::passed_by(&pulled, model) {
        let says = format!(
            "`actuatorfrcrange` of joint {joint} does not limit what this actuator does to it by a line or a place"
        );
        model.context.findings.ignored(element.at, label.as_str(), says);
    }
    let name = match element.value("name") {
        Some(name) => format!("{name}{ending}"),
        None => format!("{} {}", pulled.label, element.name),
    };
    own(&name, &actuator, &pulled, model);
    let auto = model.compiler.of(element.at).auto_limits;
    laws((&name, auto), &actuator, &pulled, shared, model);
    Ok(())
}

/// Adds the input of an actuator, the signals computed from it, and the effort.
fn laws(
    (name, auto): (&str, bool),
    actuator: &Actuator,
    pulled: &Transmission,
    shared: &mut Shared,
    model: &mut Model<'_, '_, '_>,
) {
    let gear = pulled.gear;
    let control = actuator.control_range(pulled.range, auto).filter(|_| model.compiler.acts.clamp);
    let (gains, biases) = (actuator.gains(), actuator.biases());
    let is_limited = pulled.rope.is_some() || effort::is_limited(&pulled.terms, model);
    let is_plain = pulled.pushes.is_empty()
        && control.is_none()
        && actuator.force_range(auto).is_none()
        && !is_limited
        && biases == [0.0; 3]
        && gains[1..] == [0.0; 2];
    let input = Control {
        law: Some(model.robot.laws.len()),
        activation: None,
        factor: actuator.control_factor(pulled.size),
        activations: actuator.activations(),
    };
    if is_plain && gains[0] * gear == 1.0 && actuator.dynamics() == Dynamics::None {
        model.inputs.push(input);
        let on = effort::target(&pulled.terms);
        model.law(name, What::Input { on, value: 0.0 });
        return;
    }
    let (signal, gear) = force((name, auto), (actuator, control), pulled, input, model);
    if pulled.pushes.is_empty() {
        let pull = Pull { name: name.to_owned(), signal, gear, terms: pulled.terms.clone() };
        shared.add(pull, pulled.rope, model);
    } else {
        push(&format!("{name} drive"), &signal, &pulled.pushes, model);
    }
}

/// The signal of the actuator's force, and the gear by which it acts.
fn force(
    (name, auto): (&str, bool),
    (actuator, control): (&Actuator, Option<[f64; 2]>),
    pulled: &Transmission,
    mut input: Control,
    model: &mut Model<'_, '_, '_>,
) -> (String, f64) {
    let mut signal = model.signal(name, Signal::Set { value: 0.0, unit: "" });
    if let Some([lower, upper]) = control {
        signal =
            model.signal(&format!("{name} control"), Signal::Clamp { of: signal, lower, upper });
    }
    if actuator.dynamics() != Dynamics::None {
        input.activation = Some(model.robot.laws.len());
        let of = followed(signal, actuator, pulled.range, auto);
        signal = model.signal(&format!("{name} activation"), of);
    }
    model.inputs.push(input);
    let mut sum = match actuator.gains() {
        [constant, 0.0, 0.0] => vec![(signal, constant)],
        gains => vec![(gained(name, signal, gains, pulled, model), 1.0)],
    };
    sum.extend(measured(name, actuator.biases(), pulled, model));
    // Without a limit on the force, the gear is included in the same sum.
    let force = actuator.force_range(auto);
    let is_apart = force.is_some() || pulled.rope.is_some();
    let [share, gear] = if is_apart { [1.0, pulled.gear] } else { [pulled.gear, 1.0] };
    let of: Vec<_> = sum.into_iter().map(|(signal, factor)| (signal, factor * share)).collect();
    signal = model.signal(&format!("{name} force"), Signal::Sum { of });
    if let Some([lower, upper]) = force {
        signal =
            model.signal(&format!("{name} limited"), Signal::Clamp { of: signal, lower, upper });
    }
    (signal, gear)
}

/// Signal of the activation that follows from a control.
fn followed(of: String, actuator: &Actuator, of_length: Option<[f64; 2]>, auto: bool) -> Signal {
    match actuator.dynamics() {
        Dynamics::Integral => {
            let range = actuator.activation_range(of_length, auto);
            let value = range.map_or(0.0, |[lower, upper]| 0.0_f64.clamp(lower, upper));
            Signal::Integral { of, range, value }
        }
        _ => Signal::Lag { of, time: actuator.time(), value: 0.0 },
    }
}

/// Adds the product of (g₀ + g₁ l + g₂ l̇) and a signal.
fn gained(
    name: &str,
    signal: String,
    gains: [f64; 3],
    pulled: &Transmission,
    model: &mut Model<'_, '_, '_>,
) -> String {
    let name = format!("{name} gain");
    let of = measured(&name, gains, pulled, model);
    let gain = model.signal(&name, Signal::Sum { of });
    model.signal(&format!("{name} of control"), Signal::Product { of: vec![gain, signal] })
}

/// Adds the inertia and the damping of the actuator itself. They act on the actuator's length, which is the gear times the length of its
/// transmission.
fn own(name: &str, actuator: &Actuator, pulled: &Transmission, model: &mut Model<'_, '_, '_>) {
    let square = pulled.gear * pulled.gear;
    // All coefficients get the factor gear². The powers in the damping law are powers of the transmission's rate, not of the actuator's.
    let damping = Strength(actuator.damping.0.map(|x| x * square));
    if damping != Strength::NONE && model.compiler.acts.damper {
        let on = effort::target(&pulled.terms);
        springs::add(&format!("{name} damping"), &on, [Strength::NONE, damping], [0.0; 2], model);
    }
    if actuator.armature != 0.0 && pulled.pushes.is_empty() {
        let name = format!("{name} armature");
        flywheel::add(&name, &pulled.terms, actuator.armature * square, model);
    }
}

/// The sum a + b l + c l̇ as signals with factors, where l is the gear times the length of the transmission.
fn measured(
    name: &str,
    [constant, of_length, of_rate]: [f64; 3],
    pulled: &Transmission,
    model: &mut Model<'_, '_, '_>,
) -> Vec<(String, f64)> {
    let gear = pulled.gear;
    let mut sum = Vec::new();
    // The measured value of a line is its whole length. The measured value of a coordinate is its deviation from the reference configuration.
    let lines = pulled.terms.iter().map(|term| term.factor * super::tendon::length(&term.line));
    let drawn = pulled.drawn - lines.sum::<f64>();
    let constant = constant + of_length * gear * drawn;
    if constant != 0.0 {
        let signal =
            model.signal(&format!("{name} constant"), Signal::Constant { value: constant });
        sum.push((signal, 1.0));
    }
    for (factor, is_rate, word) in [(of_length, false, "value"), (of_rate, true, "rate")] {
        if factor == 0.0 {
            continue;
        }
        for (number, term) in pulled.terms.iter().enumerate() {
            let ending =
                if pulled.terms.len() > 1 { format!(" {}", number + 1) } else { String::new() };
            let what = if term.line.is_empty() {
                Signal::Measure { of: term.of.clone(), is_rate }
            } else {
                Signal::MeasureLine { line: term.line.clone(), is_rate }
            };
            let signal = model.signal(&format!("{name} {word}{ending}"), what);
            sum.push((signal, factor * gear * term.factor));
        }
    }
    sum
}

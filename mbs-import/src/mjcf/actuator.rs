//! Actuators: an input in units of their control, and the force that follows from it.

use super::defaults::is_actuator;
use super::model::Model;
use super::stops::{Factor, Lazy};
use super::transmission::{Transmission, push, transmission};
use crate::element::Element;
use crate::robot::{Signal, Target, What};
use crate::source::Read;

/// An actuator: force = gain u + b₀ + b₁ l + b₂ l̇ of its length l.
#[derive(Debug, Clone)]
struct Actuator {
    /// The word that wrote its gain and bias.
    by: String,
    gain: Vec<f64>,
    bias: Vec<f64>,
    gain_kind: String,
    bias_kind: String,
    dynamics: String,
    time: f64,
    gear: [f64; 6],
    control: Option<[f64; 2]>,
    control_limited: Option<bool>,
    force: Option<[f64; 2]>,
    force_limited: Option<bool>,
    armature: f64,
    damping: f64,
    inherit: f64,
    /// What acts and has no counterpart.
    lost: Vec<String>,
}

impl Actuator {
    fn new() -> Self {
        Self {
            by: "general".into(),
            gain: vec![1.0],
            bias: vec![0.0; 3],
            gain_kind: "fixed".into(),
            bias_kind: "none".into(),
            dynamics: "none".into(),
            time: 1.0,
            gear: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            control: None,
            control_limited: None,
            force: None,
            force_limited: None,
            armature: 0.0,
            damping: 0.0,
            inherit: 0.0,
            lost: Vec::new(),
        }
    }

    /// Takes over what an element of one of the words writes.
    fn apply(&mut self, element: &Element) -> Read<()> {
        let word = element.name.as_str();
        if self.by != word && self.by != "general" && word != "general" {
            // the words of two kinds do not add up
            (self.gain, self.bias) = (vec![1.0], vec![0.0; 3]);
            (self.gain_kind, self.bias_kind) = ("fixed".into(), "none".into());
            (self.dynamics, self.time) = ("none".into(), 1.0);
        }
        word.clone_into(&mut self.by);
        self.common(element)?;
        let first_gain = self.gain.first().copied().unwrap_or(1.0);
        match word {
            "general" => self.general(element)?,
            "motor" => {
                (self.gain, self.bias) = (vec![1.0], vec![0.0; 3]);
                (self.gain_kind, self.bias_kind) = ("fixed".into(), "none".into());
                self.dynamics = "none".into();
            }
            "position" => {
                let stiffness = element.number_or("kp", first_gain)?;
                let damping = self.bias.get(2).copied().unwrap_or(0.0);
                let damping = element.number_or("kv", -damping)?;
                // above zero it is a ratio
                let damping = element.number_or("dampratio", -damping)?;
                self.gain = vec![stiffness];
                self.bias = vec![0.0, -stiffness, damping];
                (self.gain_kind, self.bias_kind) = ("fixed".into(), "affine".into());
                self.inherit = element.number_or("inheritrange", self.inherit)?;
                let time = element.number_or("timeconst", 0.0)?;
                if time > 0.0 {
                    (self.dynamics, self.time) = ("filterexact".into(), time);
                }
            }
            "velocity" => {
                let damping = element.number_or("kv", first_gain)?;
                self.gain = vec![damping];
                self.bias = vec![0.0, 0.0, -damping];
                (self.gain_kind, self.bias_kind) = ("fixed".into(), "affine".into());
            }
            "damper" => {
                // force = −kv u l̇: a product of control and rate
                self.gain_kind = "affine".into();
                self.gain = vec![0.0, 0.0, -element.number_or("kv", 1.0)?];
            }
            // their own laws
            _ => {
                self.gain_kind = word.to_owned();
            }
        }
        Ok(())
    }

    /// Gain, bias and dynamics as they are.
    fn general(&mut self, element: &Element) -> Read<()> {
        let text = |name: &str, value: &mut String| {
            if let Some(word) = element.value(name) {
                word.clone_into(value);
            }
        };
        text("gaintype", &mut self.gain_kind);
        text("biastype", &mut self.bias_kind);
        text("dyntype", &mut self.dynamics);
        if let Some(list) = element.attribute("gainprm") {
            self.gain = list.list()?;
        }
        if let Some(list) = element.attribute("biasprm") {
            self.bias = list.list()?;
        }
        if let Some(list) = element.attribute("dynprm") {
            self.time = list.list()?.first().copied().unwrap_or(1.0);
        }

        Ok(())
    }

    /// What all words have.
    fn common(&mut self, element: &Element) -> Read<()> {
        for name in ["name", "class", "group", "user"] {
            element.attribute(name);
        }
        if let Some(gear) = element.attribute("gear") {
            // a shorter list leaves the others as they are
            for (own, written) in self.gear.iter_mut().zip(gear.list()?) {
                *own = written;
            }
        }
        let limited = |name: &str, value: &mut Option<bool>| -> Read<()> {
            if let Some(word) = element.attribute(name) {
                let word = super::compiler::word(word, &["false", "true", "auto"])?;
                *value = [Some(false), Some(true), None][word];
            }
            Ok(())
        };
        limited("ctrllimited", &mut self.control_limited)?;
        limited("forcelimited", &mut self.force_limited)?;
        if let Some(range) = element.attribute("ctrlrange") {
            self.control = Some(range.numbers()?);
        }
        if let Some(range) = element.attribute("forcerange") {
            self.force = Some(range.numbers()?);
        }
        self.armature = element.number_or("armature", self.armature)?;
        if let Some(damping) = element.attribute("damping") {
            let damping = damping.list()?;
            self.damping = damping.first().copied().unwrap_or(0.0);
            if damping.iter().skip(1).any(|x| *x != 0.0) {
                self.lost.push("damping that grows with the rate".into());
            }
        }
        if element.number_or("delay", 0.0)? > 0.0 {
            self.lost.push("delay".into());
        }
        if element.value("actlimited") == Some("true") || element.attribute("actrange").is_some() {
            self.lost.push("limits of the activation".into());
        }
        Ok(())
    }

    /// Does its force follow the control with a delay of first order?
    fn lags(&self) -> bool {
        self.dynamics != "none" && self.time > 0.0
    }

    /// Why the scene cannot have its force.
    fn refusal(&self) -> Option<String> {
        let is_constant = self.gain.iter().skip(1).take(2).all(|x| *x == 0.0);
        if self.gain_kind != "fixed" && !(self.gain_kind == "affine" && is_constant) {
            let other = if self.by == "general" { &self.gain_kind } else { &self.by };
            return Some(format!("`{other}`: its force is no sum of control, length and rate"));
        }
        if !matches!(self.bias_kind.as_str(), "none" | "affine") {
            return Some(format!("the bias `{}` is not read", self.bias_kind));
        }
        if !matches!(self.dynamics.as_str(), "none" | "filter" | "filterexact") {
            return Some(format!(
                "the dynamics `{}` of its activation are not read",
                self.dynamics
            ));
        }
        None
    }

    /// With the damping of its ratio: c = 2 d √(k m), and m what it moves in the reference configuration.
    fn damped(&self, moved: impl FnOnce() -> Option<f64>) -> Result<Self, String> {
        let (stiffness, ratio) = match (&self.gain[..], &self.bias[..]) {
            ([k, ..], [_, bias, ratio, ..]) if *k == -*bias && *ratio > 0.0 => (*k, *ratio),
            _ => return Ok(self.clone()),
        };
        if self.bias_kind != "affine" {
            return Ok(self.clone());
        }
        let Some(moved) = moved().filter(|moved| moved.is_finite()) else {
            return Err("its damping follows from the mass that it moves, and that is open".into());
        };
        let mut damped = self.clone();
        damped.bias[2] = -2.0 * ratio * (stiffness * moved).sqrt();
        Ok(damped)
    }

    /// Why the scene cannot have it there: what is no coordinate has no measure.
    fn refusal_of(&self, pulled: &Transmission) -> Option<String> {
        let bias =
            |i: usize| self.bias_kind == "affine" && self.bias.get(i).is_some_and(|x| *x != 0.0);
        if pulled.pushes.is_empty() {
            return None;
        }
        if bias(2) || (bias(1) && pulled.has_length) || self.damping > 0.0 || self.armature > 0.0 {
            return Some("its force follows a length or a rate that is no coordinate".into());
        }
        None
    }
}

/// Reads the elements `actuator`.
pub(super) fn read<'a>(
    root: &'a Element,
    factor: &Lazy,
    model: &mut Model<'a, '_, '_>,
) -> Read<()> {
    for element in root.each("actuator").flat_map(|actuators| &actuators.children) {
        if !is_actuator(&element.name) {
            continue;
        }
        let mut actuator = Actuator::new();
        let classes = model.classes;
        for default in classes.actuators(element.read())? {
            actuator.apply(default)?;
        }
        actuator.apply(element)?;
        for ending in model.endings(element) {
            add(element, &actuator, &ending, factor, model)?;
        }
    }
    Ok(())
}

/// An actuator that pulls something; one that the scene cannot have is reported, never silent.
fn add(
    element: &Element,
    actuator: &Actuator,
    ending: &str,
    factor: &Lazy,
    model: &mut Model<'_, '_, '_>,
) -> Read<()> {
    let label = format!("actuator/{}", element.label());
    let found = if !model.compiler.acts.actuation {
        Err("actuation is disabled in the file".into())
    } else if let Some(why) = actuator.refusal() {
        Err(format!("{why}: the actuator does not act here"))
    } else {
        let found = transmission(element, &actuator.gear, ending, model)?;
        let found = found.and_then(|pulled| {
            let damped = actuator.damped(|| {
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
            model.inputs.push(None);
            return Ok(());
        }
    };
    for says in &actuator.lost {
        let says = format!("{says}: does not act here");
        model.context.findings.ignored(element.at, label.as_str(), says);
    }
    let name = match element.value("name") {
        Some(name) => format!("{name}{ending}"),
        None => format!("{} {}", pulled.label, element.name),
    };
    laws(&name, &actuator, &pulled, model);
    Ok(())
}

/// The input, the signals that follow from it, and the effort that follows from those.
fn laws(name: &str, actuator: &Actuator, pulled: &Transmission, model: &mut Model<'_, '_, '_>) {
    let gear = pulled.gear;
    let on = match &pulled.terms[..] {
        [only] if only.factor == 1.0 && only.line.is_empty() => Target::Coordinate(only.of.clone()),
        terms => Target::Sum(terms.to_vec()),
    };
    own(name, actuator, pulled, &on, model);
    let control = control_range(actuator, pulled, model);
    let force =
        actuator.force.filter(|_| actuator.force_limited.unwrap_or(model.compiler.auto_limits));
    let gain = actuator.gain.first().copied().unwrap_or(1.0);
    let bias = |i: usize| actuator.bias.get(i).copied().unwrap_or(0.0);
    let has_bias = actuator.bias_kind == "affine" && (0..3).any(|i| bias(i) != 0.0);
    let is_plain = pulled.pushes.is_empty()
        && control.is_none()
        && force.is_none()
        && pulled.effort.is_none()
        && !has_bias;
    if is_plain && gain * gear == 1.0 && !actuator.lags() {
        model.inputs.push(Some((model.robot.laws.len(), 1.0)));
        model.law(name, What::Input { on, value: 0.0 });
        return;
    }
    model.inputs.push(Some((model.robot.laws.len(), 1.0)));
    let mut signal = model.signal(name, Signal::Set { value: 0.0, unit: "" });
    if let Some([lower, upper]) = control {
        signal =
            model.signal(&format!("{name} control"), Signal::Clamp { of: signal, lower, upper });
    }
    if actuator.lags() {
        signal = model
            .signal(&format!("{name} activation"), Signal::Lag { of: signal, time: actuator.time });
    }
    let mut sum = vec![(signal, gain)];
    if has_bias {
        add_bias(name, actuator, pulled, &mut sum, model);
    }
    // without a limit of its force, the gear goes into the same sum
    let clamp = force.is_some();
    let share = if clamp { 1.0 } else { gear };
    let of: Vec<_> = sum.into_iter().map(|(signal, factor)| (signal, factor * share)).collect();
    signal = model.signal(&format!("{name} force"), Signal::Sum { of });
    if let Some([lower, upper]) = force {
        signal =
            model.signal(&format!("{name} limited"), Signal::Clamp { of: signal, lower, upper });
        if gear != 1.0 {
            signal =
                model.signal(&format!("{name} geared"), Signal::Sum { of: vec![(signal, gear)] });
        }
    }
    if let Some([lower, upper]) = pulled.effort {
        signal =
            model.signal(&format!("{name} effort"), Signal::Clamp { of: signal, lower, upper });
    }
    if pulled.pushes.is_empty() {
        model.law(&format!("{name} drive"), What::Driven { on, signal });
    } else {
        push(&format!("{name} drive"), &signal, &pulled.pushes, model);
    }
}

/// Inertia and damping of the actuator itself.
fn own(
    name: &str,
    actuator: &Actuator,
    pulled: &Transmission,
    on: &Target,
    model: &mut Model<'_, '_, '_>,
) {
    let gear = pulled.gear;
    // inertia and damping of the actuator are on its length, which is gear times what it pulls
    if actuator.damping > 0.0 {
        let damping = actuator.damping * gear * gear;
        let what = What::Spring { on: on.clone(), stiffness: 0.0, damping, free: 0.0 };
        model.law(&format!("{name} damping"), what);
    }
    if let ([only], true) = (&pulled.terms[..], actuator.armature > 0.0)
        && only.line.is_empty()
    {
        let inertia = actuator.armature * (gear * only.factor).powi(2);
        let on = Target::Coordinate(only.of.clone());
        model.law(&format!("{name} armature"), What::Rotor { on, inertia });
    }
}

/// b₀ + b₁ l + b₂ l̇ as signals, with l = gear times the length that is pulled.
fn add_bias(
    name: &str,
    actuator: &Actuator,
    pulled: &Transmission,
    sum: &mut Vec<(String, f64)>,
    model: &mut Model<'_, '_, '_>,
) {
    let gear = pulled.gear;
    let bias = |i: usize| actuator.bias.get(i).copied().unwrap_or(0.0);
    // a measured length is whole, a measured coordinate counts from the reference configuration
    let is_line = pulled.terms.iter().any(|term| !term.line.is_empty());
    let drawn = if is_line { 0.0 } else { pulled.drawn };
    let constant = bias(0) + bias(1) * gear * drawn;
    if constant != 0.0 {
        let signal =
            model.signal(&format!("{name} constant"), Signal::Constant { value: constant });
        sum.push((signal, 1.0));
    }
    for (factor, is_rate, word) in [(bias(1), false, "value"), (bias(2), true, "rate")] {
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
}

/// Limits of the control.
fn control_range(
    actuator: &Actuator,
    pulled: &Transmission,
    model: &Model<'_, '_, '_>,
) -> Option<[f64; 2]> {
    if !model.compiler.acts.clamp {
        return None;
    }
    if let (Some([lower, upper]), true) = (pulled.range, actuator.inherit > 0.0) {
        let (middle, half) = ((lower + upper) / 2.0, (upper - lower) / 2.0 * actuator.inherit);
        return Some([middle - half, middle + half]);
    }
    actuator.control.filter(|_| actuator.control_limited.unwrap_or(model.compiler.auto_limits))
}

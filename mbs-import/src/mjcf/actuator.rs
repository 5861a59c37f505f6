//! Actuators of the file, before they become laws of the scene.

use super::size::Size;
use super::strength::Strength;
use super::transmission::Transmission;
use crate::element::{Attribute, Element};
use crate::source::Read;

/// An actuator with force = (g₀ + g₁ l + g₂ l̇) u + b₀ + b₁ l + b₂ l̇. Here l is its length, and u is its control or activation.
#[derive(Debug, Clone)]
pub(super) struct Actuator {
    /// Name of the last element that set gain and bias, without regard to `general` elements; `general` if there is no other.
    by: String,
    /// Name of the element whose attributes were applied last.
    word: String,
    gain: [f64; 3],
    bias: [f64; 3],
    gain_kind: String,
    bias_kind: String,
    dynamics: String,
    time: f64,
    pub(super) gear: [f64; 6],
    control: Option<[f64; 2]>,
    control_limited: Option<bool>,
    activation: Option<[f64; 2]>,
    activation_limited: Option<bool>,
    force: Option<[f64; 2]>,
    force_limited: Option<bool>,
    pub(super) armature: f64,
    pub(super) damping: Strength,
    inherit: f64,
    /// Length of the rod between a crank and its slider [m].
    pub(super) crank_length: Option<f64>,
    /// Descriptions of the attributes that affect the force but have no counterpart in the scene.
    pub(super) lost: Vec<String>,
}

/// Dynamics between the control and the activation that acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Dynamics {
    /// The control acts without delay.
    None,
    /// A delay of first order, with a time constant.
    Lag,
    /// The activation is the integral of the control.
    Integral,
}

impl Actuator {
    pub(super) fn new() -> Self {
        Self {
            by: "general".into(),
            word: "general".into(),
            gain: [1.0, 0.0, 0.0],
            bias: [0.0; 3],
            gain_kind: "fixed".into(),
            bias_kind: "none".into(),
            dynamics: "none".into(),
            time: 1.0,
            gear: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            control: None,
            control_limited: None,
            activation: None,
            activation_limited: None,
            force: None,
            force_limited: None,
            armature: 0.0,
            damping: Strength::NONE,
            inherit: 0.0,
            crank_length: None,
            lost: Vec::new(),
        }
    }

    /// The actuator of an element: the defaults are applied first, from the outermost class inwards, then the element. Each default is given
    /// with the depth of its class; `depth` is the depth of the element's class.
    pub(super) fn of(
        element: &Element,
        (defaults, depth): (&[(usize, &Element)], usize),
    ) -> Read<Self> {
        let (mut actuator, mut outer) = (Self::new(), Vec::new());
        for (at, element) in defaults.iter().copied().chain([(depth, element)]) {
            while outer.len() < at {
                outer.push(actuator.clone());
            }
            actuator.apply(element, &outer)?;
        }
        Ok(actuator)
    }

    /// Applies the attributes of an element or of a default. `outer` has the actuator as each enclosing class left it.
    ///
    /// Attributes of different kinds of actuators do not combine. For another kind, the values begin as in the innermost entry of `outer`
    /// whose last element has that kind or `general`.
    fn apply(&mut self, element: &Element, outer: &[Self]) -> Read<()> {
        let word = element.name.as_str();
        let is_alike = |own: &str| own == word || own == "general";
        if !is_alike(&self.word) && word != "general" {
            let like = outer.iter().rev().find(|outer| is_alike(&outer.word));
            let like = like.cloned().unwrap_or_else(Self::new);
            (self.gain, self.bias, self.inherit) = (like.gain, like.bias, like.inherit);
            (self.gain_kind, self.bias_kind) = (like.gain_kind, like.bias_kind);
            (self.dynamics, self.time) = (like.dynamics, like.time);
        }
        word.clone_into(&mut self.word);
        if word != "general" {
            word.clone_into(&mut self.by);
        }
        self.common(element)?;
        match word {
            "general" => self.general(element),
            "motor" => {
                (self.gain, self.bias) = ([1.0, 0.0, 0.0], [0.0; 3]);
                self.kinds(["fixed", "none", "none"]);
                Ok(())
            }
            "position" | "intvelocity" => self.servo(element, word == "intvelocity"),
            "velocity" => {
                let damping = element.number_or("kv", self.gain[0])?;
                (self.gain, self.bias) = ([damping, 0.0, 0.0], [0.0, 0.0, -damping]);
                self.kinds(["fixed", "affine", "none"]);
                Ok(())
            }
            "damper" => {
                // The force −kv u l̇ is a product of control and rate.
                let damping = element.number_or("kv", -self.gain[2])?;
                (self.gain, self.bias) = ([0.0, 0.0, -damping], [0.0; 3]);
                self.kinds(["affine", "none", "none"]);
                Ok(())
            }
            "cylinder" => self.cylinder(element),
            // Kinds with their own laws of force.
            _ => {
                self.gain_kind = word.to_owned();
                Ok(())
            }
        }
    }

    fn kinds(&mut self, [gain, bias, dynamics]: [&str; 3]) {
        gain.clone_into(&mut self.gain_kind);
        bias.clone_into(&mut self.bias_kind);
        dynamics.clone_into(&mut self.dynamics);
    }

    /// Reads a position servo, whose target is the control or its integral.
    fn servo(&mut self, element: &Element, is_integral: bool) -> Read<()> {
        let stiffness = element.number_or("kp", self.gain[0])?;
        let damping = element.number_or("kv", -self.bias[2])?;
        // A positive third bias is a damping ratio.
        let damping = element.number_or("dampratio", -damping)?;
        (self.gain, self.bias) = ([stiffness, 0.0, 0.0], [0.0, -stiffness, damping]);
        self.inherit = element.number_or("inheritrange", self.inherit)?;
        let dynamics = match element.attribute("timeconst").map(|time| time.number()).transpose()? {
            _ if is_integral => "integrator",
            None if self.dynamics == "filterexact" => "filterexact",
            Some(time) if time > 0.0 => {
                self.time = time;
                "filterexact"
            }
            _ => "none",
        };
        self.kinds(["fixed", "affine", dynamics]);
        Ok(())
    }

    /// Reads a pneumatic cylinder, whose pressure follows the control with a delay.
    fn cylinder(&mut self, element: &Element) -> Read<()> {
        let area = element.number_or("area", self.gain[0])?;
        let area = match element.attribute("diameter") {
            Some(diameter) => core::f64::consts::FRAC_PI_4 * diameter.number()?.powi(2),
            None => area,
        };
        self.gain = [area, 0.0, 0.0];
        self.bias = element.numbers_or("bias", self.bias)?;
        self.time = element.number_or("timeconst", self.time)?;
        self.kinds(["fixed", "affine", "filter"]);
        Ok(())
    }

    /// Reads gain, bias and dynamics, which a `general` actuator has as attributes.
    fn general(&mut self, element: &Element) -> Read<()> {
        let text = |name: &str, value: &mut String| {
            if let Some(word) = element.value(name) {
                word.clone_into(value);
            }
        };
        text("gaintype", &mut self.gain_kind);
        text("biastype", &mut self.bias_kind);
        text("dyntype", &mut self.dynamics);
        for (name, own) in [("gainprm", &mut self.gain), ("biasprm", &mut self.bias)] {
            // A shorter list leaves the other values unchanged. Further values belong to other laws.
            if let Some(list) = element.attribute(name) {
                own.iter_mut().zip(list.list()?).for_each(|(own, written)| *own = written);
            }
        }
        if let Some(first) = element.attribute("dynprm").map(Attribute::list).transpose()? {
            self.time = first.first().copied().unwrap_or(self.time);
        }
        Ok(())
    }

    /// Reads the attributes that all kinds of actuators have.
    fn common(&mut self, element: &Element) -> Read<()> {
        for name in ["name", "class", "group", "user"] {
            element.attribute(name);
        }
        if let Some(gear) = element.attribute("gear") {
            gear.merge(&mut self.gear)?;
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
        limited("actlimited", &mut self.activation_limited)?;
        for (name, range) in [
            ("ctrlrange", &mut self.control),
            ("actrange", &mut self.activation),
            ("forcerange", &mut self.force),
        ] {
            if let Some(written) = element.attribute(name) {
                *range = Some(written.numbers()?);
            }
        }
        self.armature = element.number_or("armature", self.armature)?;
        if let Some(damping) = element.attribute("damping") {
            damping.merge(&mut self.damping.0)?;
        }
        if let Some(length) = element.attribute("cranklength") {
            self.crank_length = Some(length.number()?);
        }
        if element.number_or("delay", 0.0)? > 0.0 {
            self.lost.push("delay".into());
        }
        Ok(())
    }

    pub(super) fn dynamics(&self) -> Dynamics {
        match self.dynamics.as_str() {
            "integrator" => Dynamics::Integral,
            "filter" | "filterexact" if self.time > 0.0 => Dynamics::Lag,
            _ => Dynamics::None,
        }
    }

    /// The time constant of its delay [s].
    pub(super) const fn time(&self) -> f64 {
        self.time
    }

    /// Number of activation values in a keyframe; `None` when the number is not known here.
    pub(super) fn activations(&self) -> Option<usize> {
        match (self.by.as_str(), self.dynamics.as_str()) {
            ("muscle", _) => Some(1),
            ("plugin" | "pid" | "dcmotor" | "orientation", _) | (_, "user" | "dcmotor") => None,
            (_, "none") => Some(0),
            _ => Some(1),
        }
    }

    /// The gains g₀, g₁ and g₂ of the force.
    pub(super) fn gains(&self) -> [f64; 3] {
        let [constant, rest @ ..] = self.gain;
        let [length, rate] = if self.gain_kind == "affine" { rest } else { [0.0; 2] };
        [constant, length, rate]
    }

    /// The biases b₀, b₁ and b₂ of the force.
    pub(super) fn biases(&self) -> [f64; 3] {
        if self.bias_kind == "affine" { self.bias } else { [0.0; 3] }
    }

    /// Limits of the control. With `auto`, limits that are written apply even without `ctrllimited`.
    pub(super) fn control_range(
        &self,
        of_length: Option<[f64; 2]>,
        auto: bool,
    ) -> Option<[f64; 2]> {
        let inherited = self.inherited(of_length).filter(|_| self.by == "position");
        inherited.or(self.control).filter(|_| self.control_limited.unwrap_or(auto))
    }

    /// Limits of the activation, if they apply.
    pub(super) fn activation_range(
        &self,
        of_length: Option<[f64; 2]>,
        auto: bool,
    ) -> Option<[f64; 2]> {
        let inherited = self.inherited(of_length).filter(|_| self.by == "intvelocity");
        inherited.or(self.activation).filter(|_| self.activation_limited.unwrap_or(auto))
    }

    /// The limits of the joint or tendon, scaled by `inheritrange`.
    fn inherited(&self, of_length: Option<[f64; 2]>) -> Option<[f64; 2]> {
        let [lower, upper] = of_length.filter(|_| self.inherit > 0.0)?;
        let (middle, half) = ((lower + upper) / 2.0, (upper - lower) / 2.0 * self.inherit);
        Some([middle - half, middle + half])
    }

    /// Limits of the force, if they apply.
    pub(super) fn force_range(&self, auto: bool) -> Option<[f64; 2]> {
        self.force.filter(|_| self.force_limited.unwrap_or(auto))
    }

    /// Returns the reason why the scene cannot have the force of this actuator, if there is one.
    pub(super) fn refusal(&self, auto: bool) -> Option<String> {
        if !matches!(self.gain_kind.as_str(), "fixed" | "affine") {
            let other = if self.by == "general" { &self.gain_kind } else { &self.by };
            return Some(format!("`{other}`: its force is no sum of control, length and rate"));
        }
        if !matches!(self.bias_kind.as_str(), "none" | "affine") {
            return Some(format!("the bias `{}` is not read", self.bias_kind));
        }
        if self.dynamics() == Dynamics::Lag && self.activation_range(None, auto).is_some() {
            return Some(
                "`actrange` of an activation that follows with a delay is not read".into(),
            );
        }
        if !matches!(self.dynamics.as_str(), "none" | "integrator" | "filter" | "filterexact") {
            return Some(format!(
                "the dynamics `{}` of its activation are not read",
                self.dynamics
            ));
        }
        None
    }

    /// True if the damping is given by a damping ratio and the inertia that the actuator moves.
    pub(super) fn has_ratio(&self) -> bool {
        let ([stiffness, ..], [_, bias, ratio]) = (self.gain, self.biases());
        stiffness == -bias && ratio > 0.0
    }

    /// Returns the actuator with the damping of its ratio d: c = 2 d √(k m), where m is the inertia that it moves in the reference
    /// configuration.
    pub(super) fn damped(&self, moved: impl FnOnce() -> Option<f64>) -> Result<Self, String> {
        if !self.has_ratio() {
            return Ok(self.clone());
        }
        let ([stiffness, ..], [.., ratio]) = (self.gain, self.biases());
        let Some(moved) = moved().filter(|moved| moved.is_finite()) else {
            return Err("its damping follows from the mass that it moves, and that is open".into());
        };
        let mut damped = self.clone();
        damped.bias[2] = -2.0 * ratio * (stiffness * moved).sqrt();
        Ok(damped)
    }

    /// Returns the actuator of a hinge or a slide, scaled by the size factors of the frames that contain it. `None` when the scene cannot
    /// have it.
    pub(super) fn grown(&self, size: Size, is_slide: bool) -> Option<Self> {
        if size == Size::ONE {
            return Some(self.clone());
        }
        if self.by == "cylinder" {
            return None;
        }
        let mut grown = self.clone();
        let by = |power| if is_slide { size.force_by(power) } else { size.moment() };
        let is_servo = self.is_servo();
        // The control of a servo is a length, or the rate of a length.
        let powers = [i32::from(is_servo), 1, 1];
        grown.gain.iter_mut().zip(powers).for_each(|(gain, power)| *gain *= by(power));
        // A positive third bias is a damping ratio, which is not scaled.
        let factors = [by(0), by(1), if grown.bias[2] > 0.0 { 1.0 } else { by(1) }];
        grown.bias.iter_mut().zip(factors).for_each(|(bias, factor)| *bias *= factor);
        grown.force = self.force.map(|range| range.map(|end| end * by(0)));
        grown.armature *= by(1);
        grown.damping = self.damping.grown(by);
        let length = self.control_factor((size, is_slide));
        for range in [&mut grown.control, &mut grown.activation] {
            *range = range.map(|range| range.map(|end| end * length));
        }
        Some(grown)
    }

    /// Factor that converts the control in the file. The control of a servo on a slide is a length or a rate of a length, and scales with the
    /// lengths.
    pub(super) fn control_factor(&self, (size, is_slide): (Size, bool)) -> f64 {
        if is_slide && self.is_servo() { size.length } else { 1.0 }
    }

    fn is_servo(&self) -> bool {
        matches!(self.by.as_str(), "position" | "velocity" | "intvelocity")
    }

    /// Returns the reason why the scene cannot have the actuator at this transmission, if there is one. A force on a body has no length to
    /// measure.
    pub(super) fn refusal_of(&self, pulled: &Transmission) -> Option<String> {
        if pulled.pushes.is_empty() {
            return None;
        }
        let follows =
            |[_, length, rate]: [f64; 3]| rate != 0.0 || (length != 0.0 && pulled.has_length);
        if follows(self.biases())
            || follows(self.gains())
            || self.damping != Strength::NONE
            || self.armature > 0.0
        {
            return Some("its force follows a length or a rate that is no coordinate".into());
        }
        None
    }
}

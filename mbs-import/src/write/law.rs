//! Writes the text of effects and signals.

use super::{Writer, list, number, vector};
use crate::pose::V3;
use crate::robot::{Piece, Signal, Target, Term, What};
use mbs_scene::quoted;

impl Writer<'_> {
    fn numbers(&mut self, keys: &[(&str, f64)]) {
        for (key, x) in keys {
            self.key(key, number(*x));
        }
    }

    pub(super) fn law(&mut self, name: &str, what: &What) {
        match what {
            What::Spring { on, stiffness, damping, free } => {
                self.effect(name, "torsion-spring", on);
                self.numbers(&[("stiffness", *stiffness), ("damping", *damping)]);
                if *free != 0.0 {
                    self.key("free_value", number(*free));
                }
            }
            What::Pull { on, stiffness, free } => {
                self.effect(name, "torsion-spring", on);
                self.numbers(&[("stiffness", *stiffness), ("free_value", *free)]);
                self.key("pulls_only", "true");
            }
            What::Polynomial { terms, pieces, of_rate } => {
                self.polynomial(name, terms, pieces, *of_rate);
            }
            What::Friction { on, coulomb } => {
                self.effect(name, "friction", on);
                self.key("coulomb", number(*coulomb));
            }
            What::Rotor { on, inertia } => {
                self.effect(name, "rotor", on);
                self.numbers(&[("inertia", *inertia), ("ratio", 1.0)]);
            }
            What::Limit { on, lower, upper, stiffness, damping } => {
                self.effect(name, "limit", on);
                self.numbers(&[("lower", *lower), ("upper", *upper)]);
                self.numbers(&[("stiffness", *stiffness), ("damping", *damping)]);
            }
            What::RangeLimit { on, stiffness } => {
                self.effect(name, "limit", on);
                self.key("range", "true");
                if let Some([stiffness, damping]) = stiffness {
                    self.numbers(&[("stiffness", *stiffness), ("damping", *damping)]);
                }
            }
            What::Input { on, value } => {
                self.drive(name, on, *value);
                self.key("input", "true");
            }
            What::Driven { on, signal } => {
                self.effect(name, "torque", on);
                self.key("signal", quoted(signal));
            }
            What::Push { link, at, turns, signals } => {
                self.push((name, *link), at.as_ref(), *turns, signals);
            }
            What::Bushing { links, place, stiffness, damping } => {
                self.bushing(name, (*links, place), [stiffness, damping]);
            }
            What::Signal(signal) => self.signal_law(name, signal),
        }
    }

    fn polynomial(&mut self, name: &str, terms: &[Term], pieces: &[Piece], of_rate: bool) {
        let kind = if of_rate { "polynomial-damper" } else { "polynomial-spring" };
        let terms = self.terms(terms);
        self.table("effect");
        self.key("name", quoted(name));
        self.key("kind", quoted(kind));
        self.key("terms", terms);
        let pieces = pieces
            .iter()
            .map(|piece| list([piece.lower, piece.upper].into_iter().chain(piece.coefficients)));
        self.key("coefficients", format!("[{}]", pieces.collect::<Vec<_>>().join(", ")));
    }

    /// Writes a signal of kind `clamp` or `limit-ratio`, with its limits.
    fn within(&mut self, name: &str, kind: &str, of: &str, limits: [f64; 2]) {
        self.signal(name, kind);
        self.key("of", quoted(of));
        self.numbers(&[("lower", limits[0]), ("upper", limits[1])]);
    }

    fn names(&mut self, of: &[String]) {
        let names: Vec<_> = of.iter().map(|name| quoted(name)).collect();
        self.key("of", format!("[{}]", names.join(", ")));
    }

    fn bushing(
        &mut self,
        name: &str,
        (links, place): ([usize; 2], &V3),
        [stiffness, damping]: [&[f64; 6]; 2],
    ) {
        let bodies = links.map(|link| self.body(link)).join(", ");
        self.table("effect");
        self.key("name", quoted(name));
        self.key("kind", quoted("bushing"));
        self.key("bodies", format!("[{bodies}]"));
        self.key("at", vector(place));
        self.key("stiffness", list(*stiffness));
        self.key("damping", list(*damping));
    }

    /// Writes a force at a point, or without a point a moment, whose components are signals.
    fn push(
        &mut self,
        (name, link): (&str, usize),
        at: Option<&V3>,
        turns: bool,
        signals: &[String; 3],
    ) {
        let (body, kind) = (self.body(link), if at.is_some() { "force" } else { "torque" });
        self.table("effect");
        self.key("name", quoted(name));
        self.key("kind", quoted(kind));
        self.key("body", body);
        if let Some(at) = at {
            self.key("at", vector(at));
        }
        let signals = signals.each_ref().map(|signal| quoted(signal)).join(", ");
        self.key("signal", format!("[{signals}]"));
        if turns {
            self.key("frame", quoted("body"));
        }
    }

    /// Writes a force or moment of constant value.
    fn drive(&mut self, name: &str, on: &Target, value: f64) {
        self.effect(name, "torque", on);
        self.key("value", number(value));
    }

    /// Writes the initial value of a signal with a state.
    fn started(&mut self, value: f64) {
        if value != 0.0 {
            self.key("value", number(value));
        }
    }

    fn signal_law(&mut self, name: &str, signal: &Signal) {
        match signal {
            Signal::Set { value, unit } => {
                self.signal(name, "input");
                self.key("value", number(*value));
                if !unit.is_empty() {
                    self.key("unit", quoted(unit));
                }
            }
            Signal::Measure { of, is_rate } => {
                self.signal(name, "measure");
                self.target(&Target::Coordinate(of.clone()));
                if *is_rate {
                    self.key("quantity", quoted("rate"));
                }
            }
            Signal::MeasureLine { line, is_rate } => {
                let points = self.line_points(line);
                self.signal(name, "measure");
                self.key("points", points);
                if *is_rate {
                    self.key("quantity", quoted("rate"));
                }
            }
            Signal::Constant { value } => {
                self.signal(name, "constant");
                self.key("value", number(*value));
            }
            Signal::Sum { of } => {
                self.signal(name, "sum");
                let names: Vec<_> = of.iter().map(|(name, _)| quoted(name)).collect();
                self.key("of", format!("[{}]", names.join(", ")));
                self.key("factors", list(of.iter().map(|(_, factor)| *factor)));
            }
            Signal::Clamp { of, lower, upper } => self.within(name, "clamp", of, [*lower, *upper]),
            Signal::Lag { of, time, value } => {
                self.signal(name, "lag");
                self.key("of", quoted(of));
                self.key("time", number(*time));
                self.started(*value);
            }
            Signal::Product { of } => {
                self.signal(name, "product");
                self.names(of);
            }
            Signal::LimitRatio { of, lower, upper } => {
                self.within(name, "limit-ratio", of, [*lower, *upper]);
            }
            Signal::Integral { of, range, value } => {
                self.signal(name, "integral");
                self.key("of", quoted(of));
                if let Some([lower, upper]) = range {
                    self.numbers(&[("lower", *lower), ("upper", *upper)]);
                }
                self.started(*value);
            }
        }
    }
}

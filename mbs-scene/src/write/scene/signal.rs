//! Writes `[[signal]]`, and other functions of time.

use super::{Keys, Node, WriteError, Writer, curve, list};
use mbs_core::scene::{Motion, NamedSignal, Number, SignalId, SignalKind, TableEnds};

impl Writer<'_> {
    pub(super) fn signal_name(self, id: SignalId) -> Result<Node, WriteError> {
        let signal = self.scene.signals.get(id.index());
        Ok(signal.ok_or(WriteError::UnknownReference("signal"))?.name.as_str().into())
    }

    /// Adds the keys of a function of time.
    pub(super) fn motion(self, keys: &mut Keys, law: &Motion<Number>) -> Result<(), WriteError> {
        let mut parts = Keys::default();
        match law {
            Motion::Table { rows, ends } | Motion::Monotone { rows, ends } => {
                keys.push("table", list(rows.iter().map(Node::from)));
                if matches!(law, Motion::Monotone { .. }) {
                    keys.push("interpolation", "monotone");
                }
                if *ends == TableEnds::Level {
                    keys.push("ends", "level");
                }
            }
            Motion::Sine { amplitude, frequency, phase } => {
                parts.push("amplitude", amplitude);
                parts.push("frequency", frequency);
                parts.push("phase", phase);
                keys.push("sine", parts);
            }
            Motion::Ramp { rate } => {
                parts.push("rate", rate);
                keys.push("ramp", parts);
            }
            Motion::Input([value, rate, acceleration]) => {
                parts.push("value", value);
                parts.push("rate", rate);
                parts.push("acceleration", acceleration);
                keys.push("input", parts);
            }
            Motion::Signal(signal) => keys.push("signal", self.signal_name(*signal)?),
        }
        Ok(())
    }

    pub(super) fn signal(self, signal: &NamedSignal<Number>) -> Result<Keys, WriteError> {
        let mut keys = Keys::default();
        keys.push("name", signal.name.as_str());
        let mut numbers = |kind, list: &[(&str, &Number)]| {
            keys.push("kind", kind);
            list.iter().for_each(|(key, x)| keys.push(key, *x));
        };
        match &signal.kind {
            SignalKind::Constant(value) => numbers("constant", &[("value", value)]),
            SignalKind::Table { rows, interpolation, periodic } => {
                numbers("table", &[]);
                keys.push("table", list(rows.iter().map(Node::from)));
                keys.push("interpolation", interpolation.name());
                if *periodic {
                    keys.push("periodic", Node::Bool(true));
                }
                if interpolation.ends() == Some(TableEnds::Level) {
                    keys.push("ends", "level");
                }
            }
            SignalKind::Sine { amplitude, frequency, phase, offset } => numbers(
                "sine",
                &[
                    ("amplitude", amplitude),
                    ("frequency", frequency),
                    ("phase", phase),
                    ("offset", offset),
                ],
            ),
            SignalKind::Chirp { amplitude, frequency, to_frequency, duration, phase, offset } => {
                numbers(
                    "chirp",
                    &[
                        ("amplitude", amplitude),
                        ("frequency", frequency),
                        ("to_frequency", to_frequency),
                        ("duration", duration),
                        ("phase", phase),
                        ("offset", offset),
                    ],
                );
            }
            SignalKind::Ramp { rate, start, end, rounding } => {
                numbers("ramp", &[("rate", rate), ("start", start), ("rounding", rounding)]);
                keys.push_some("end", end.as_ref());
            }
            SignalKind::Step { from, to, at, rise } => {
                numbers("step", &[("from", from), ("to", to), ("at", at), ("rise", rise)]);
            }
            SignalKind::Input { value, unit } => {
                numbers("input", &[("value", value)]);
                keys.push_some("unit", Some(unit.as_str()).filter(|unit| !unit.is_empty()));
            }
            _ => self.combination(signal, &mut keys)?,
        }
        Ok(keys)
    }

    /// Adds the keys of a signal that depends on the motion or has a state.
    fn feedback(self, signal: &NamedSignal<Number>, keys: &mut Keys) -> Result<(), WriteError> {
        match &signal.kind {
            SignalKind::Measure { of, is_rate } => {
                keys.push("kind", "measure");
                self.measure(of, keys)?;
                keys.push("quantity", if *is_rate { "rate" } else { "value" });
            }
            SignalKind::Lag { of, time, value } => {
                keys.push("kind", "lag");
                keys.push("time", time);
                keys.push("value", value);
                keys.push("of", self.signal_name(*of)?);
            }
            SignalKind::Integral { of, lower, upper, value } => {
                keys.push("kind", "integral");
                keys.push("value", value);
                keys.push_some("lower", lower.as_ref());
                keys.push_some("upper", upper.as_ref());
                keys.push("of", self.signal_name(*of)?);
            }
            SignalKind::Pid { of: [target, measured], p, i, d, limit } => {
                keys.push("kind", "pid");
                for (key, x) in [("p", p), ("i", i), ("d", d)] {
                    keys.push(key, x);
                }
                keys.push_some("limit", limit.as_ref());
                keys.push("target", self.signal_name(*target)?);
                keys.push("measured", self.signal_name(*measured)?);
            }
            _ => return Err(WriteError::InCode(format!("signal `{}`", signal.name))),
        }
        Ok(())
    }

    /// Adds the keys of a signal that is computed from other signals.
    fn combination(self, signal: &NamedSignal<Number>, keys: &mut Keys) -> Result<(), WriteError> {
        let names = |of: &[SignalId]| {
            let names: Result<Vec<_>, _> = of.iter().map(|of| self.signal_name(*of)).collect();
            names.map(list)
        };
        match &signal.kind {
            SignalKind::Sum { of, factors } => {
                keys.push("kind", "sum");
                keys.push("of", names(of)?);
                keys.push("factors", list(factors.iter().map(Node::from)));
            }
            SignalKind::Product { of } => {
                keys.push("kind", "product");
                keys.push("of", names(of)?);
            }
            SignalKind::Curve { of, curve: function } => {
                keys.push("kind", "curve");
                keys.push("of", self.signal_name(*of)?);
                curve(keys, function);
            }
            SignalKind::LimitRatio { of, lower, upper } => {
                keys.push("kind", "limit-ratio");
                keys.push("lower", lower);
                keys.push("upper", upper);
                keys.push("of", self.signal_name(*of)?);
            }
            SignalKind::Clamp { of, lower, upper } => {
                keys.push("kind", "clamp");
                keys.push("lower", lower);
                keys.push("upper", upper);
                keys.push("of", self.signal_name(*of)?);
            }
            _ => return self.feedback(signal, keys),
        }
        Ok(())
    }
}

//! Writes `[[effect]]`: an effect of any kind with its keys, by the table of mbs-core.

use super::{Keys, Node, WriteError, Writer, list};
use mbs_core::effects::{Default, Field, Form, Value};
use mbs_core::scene::{
    AxisFrame, CalspanCoefficients, Effect, LongitudinalSlip, Number, PolynomialPiece, Signal,
};

impl Writer<'_> {
    pub(super) fn effect(self, effect: &Effect<Number>) -> Result<Keys, WriteError> {
        let row = effect.kind.row();
        let Some(first) = row.names.first() else {
            return Err(WriteError::InCode(format!("effect `{}`", effect.name)));
        };
        let values = effect.kind.values();
        let entries = || row.fields.iter().zip(&values);
        let named = entries().find_map(|(field, value)| match (field.form, value) {
            (Form::Name(name), Value::Name(true)) => Some(name),
            _ => None,
        });
        let mut keys = Keys::default();
        keys.push("name", effect.name.as_str());
        if !effect.enabled {
            keys.push("enabled", Node::Bool(false));
        }
        keys.push("kind", named.unwrap_or(first));
        entries().try_for_each(|(field, value)| self.field(&mut keys, field, value))?;
        Ok(keys)
    }

    /// Adds the key of a field. A key whose value equals the default that follows from other keys is left out.
    fn field(
        self,
        keys: &mut Keys,
        field: &Field,
        value: &Value<Number>,
    ) -> Result<(), WriteError> {
        let key = field.key;
        match value {
            Value::Bodies(bodies) => keys.push(key, self.pair(*bodies)?),
            Value::Body(body) => keys.push(key, self.body_name(*body)?),
            Value::Joint(joint) => keys.push(key, self.joint_name(*joint)?),
            Value::Coordinate(number) => {
                keys.push_some(key, number.map(|number| Node::Number(number.to_string())));
            }
            Value::Terms(terms) => keys.push(key, self.terms(terms)?),
            Value::Point(x) | Value::Axis(x) => keys.push(key, self.vector(x)),
            Value::Points(x) => keys.push(key, self.two(x)),
            Value::Line(points) => keys.push(key, self.line(points)?),
            Value::Length(x) => keys.push_some(key, x.as_ref()),
            Value::MaybeAxis(x) => keys.push_some(key, x.as_ref().map(|x| self.vector(x))),
            Value::Number(x) => {
                keys.push_some(key, (!x.is_computed() && !x.is_open()).then_some(x));
            }
            Value::Flag(is) => keys.push_some(key, is.then_some(Node::Bool(true))),
            Value::Six(x) => keys.push(key, self.six(x)),
            Value::Pieces(pieces) => {
                let piece = |PolynomialPiece { lower, upper, coefficients }: &_| {
                    list([lower, upper].into_iter().chain(coefficients).map(Node::from))
                };
                keys.push(key, list(pieces.iter().map(piece)));
            }
            Value::Signal(signal) if is_default(field, signal) => {}
            Value::Signal(signal) => {
                let is_scalar = match field.form {
                    Form::Signal(form) => form.n_components(self.scene.dimension) == 1,
                    _ => true,
                };
                self.course(keys, signal, is_scalar)?;
            }
            Value::Frame(frame) => {
                keys.push_some(key, (*frame == AxisFrame::Body).then_some("body"))
            }
            Value::Side(side) => {
                keys.push_some(key, side.as_ref().map(|_| "calspan"));
                let given = side.as_ref().filter(|side| **side != CalspanCoefficients::of_iltis());
                keys.push_some("coefficients", given.map(coefficients));
            }
            Value::Spin(joint) => {
                let name = joint.map(|joint| self.joint_name(joint)).transpose()?;
                keys.push_some(key, name);
            }
            Value::Slip(slip) => keys.push_some(key, slip.as_ref().map(slip_keys)),
            // The name of the kind already has this value.
            _ => {}
        }
        Ok(())
    }

    /// The list of six numbers: along and about x, y, z. In the plane it has three: along x, along y and about z.
    fn six(self, numbers: &[Number; 6]) -> Node {
        let [x, y, .., about] = numbers;
        if self.is_planar() { list([x, y, about].map(Node::from)) } else { numbers.into() }
    }

    /// Adds the keys of a signal: `value`, a `table` over time, or `signal` by name. An input is written with its value at the start.
    fn course(
        self,
        keys: &mut Keys,
        signal: &Signal<Number>,
        is_scalar: bool,
    ) -> Result<(), WriteError> {
        let value = |x: &[Number; 3]| if is_scalar { Node::from(&x[0]) } else { self.vector(x) };
        match signal {
            Signal::Constant(x) => keys.push("value", value(x)),
            Signal::Table(rows) => {
                keys.push("table", list(rows.iter().map(|(t, x)| list([t.into(), value(x)]))));
            }
            Signal::Input(x) => {
                keys.push("value", value(x));
                keys.push("input", Node::Bool(true));
            }
            Signal::Named(signals) => {
                let names = signals.iter().flatten().map(|signal| self.signal_name(*signal));
                let mut names = names.collect::<Result<Vec<_>, _>>()?;
                let only = if is_scalar { names.pop() } else { None };
                keys.push("signal", only.unwrap_or_else(|| list(names)));
            }
        }
        Ok(())
    }
}

/// True if the signal is the constant that the reader assumes when no key is written.
fn is_default(field: &Field, signal: &Signal<Number>) -> bool {
    let Default::Number(text) = field.default else { return false };
    matches!(signal, Signal::Constant([x, ..]) if Number::from_decimal(text).as_ref() == Some(x))
}

fn slip_keys(slip: &LongitudinalSlip<Number>) -> Keys {
    let mut keys = Keys::default();
    keys.push("stiffness", &slip.stiffness);
    keys.push("friction", &slip.friction);
    keys
}

fn coefficients(side: &CalspanCoefficients<Number>) -> Keys {
    let mut keys = Keys::default();
    keys.push("a", &side.a);
    keys.push("omega", &side.omega);
    keys.push("b", &side.b);
    keys.push("skid", &side.skid);
    keys.push("trail", &side.trail);
    keys
}

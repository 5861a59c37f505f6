//! Example of each kind of effect, generated from the fields of the kind, for tests and measurements of all kinds.

use super::{EFFECTS, Field, Form, Sign, SignalForm, Value};
use crate::effects::EffectKind;
use crate::scene::{
    AxisFrame, BodyId, CouplingMeasure, CouplingTerm, JointId, PolynomialPiece, Signal,
};
use alloc::vec;
use alloc::vec::Vec;

/// Bodies, places and joint on which an example acts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Places {
    /// Pair of bodies, and a place on each in the reference configuration [m].
    pub pair: ([BodyId; 2], [[f64; 3]; 2]),
    /// Single body, and a place on it [m].
    pub body: (BodyId, [f64; 3]),
    /// Joint that has one rotation.
    pub joint: JointId,
}

impl EffectKind<f64> {
    /// Returns an example of the kind `EFFECTS[row]`. Its first number is 1, and each further number is larger by 0.1. `None` for a
    /// user-defined law.
    #[must_use]
    pub fn example(row: usize, places: &Places) -> Option<Self> {
        let fields = EFFECTS.get(row)?.fields;
        let mut number = 0.9;
        let value = |field: &Field| {
            Some(match field.form {
                Form::Bodies => Value::Bodies(places.pair.0),
                Form::Body => Value::Body(places.body.0),
                Form::Joint(_) => Value::Joint(places.joint),
                Form::Coordinate => Value::Coordinate(None),
                Form::Terms => {
                    let of = CouplingMeasure::Coordinate { joint: places.joint, number: 0 };
                    let (bodies, points) = places.pair;
                    let points = vec![(bodies[0], points[0]), (bodies[1], points[1])];
                    let line = CouplingMeasure::Length { points };
                    let term = |(factor, of)| CouplingTerm { factor, of, curve: None };
                    Value::Terms([(1.5, of), (-0.5, line)].map(term).to_vec())
                }
                Form::Point => Value::Point(places.body.1),
                Form::Points(_) => Value::Points(places.pair.1),
                Form::Line => {
                    let (bodies, [first, second]) = places.pair;
                    let middle = (places.body.0, [first[0] + 0.3, first[1] + 0.3, first[2]]);
                    Value::Line(vec![(bodies[0], first), middle, (bodies[1], second)])
                }
                Form::Axis => Value::Axis([1.0, 0.0, 0.0]),
                Form::MaybeAxis => Value::MaybeAxis(None),
                Form::Number(Sign::Any | Sign::NotNegative | Sign::Positive) => {
                    number += 0.1;
                    Value::Number(number)
                }
                Form::Length => Value::Length(None),
                Form::Flag => Value::Flag(false),
                // In the plane only x, y and the rotation about z are used.
                Form::Six => Value::Six([1.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
                Form::Pieces => Value::Pieces(vec![PolynomialPiece {
                    lower: 0.0,
                    upper: 9.0,
                    coefficients: vec![1.0, 1.0],
                }]),
                Form::Signal(
                    SignalForm::Scalar
                    | SignalForm::Vector
                    | SignalForm::Moment
                    | SignalForm::Three,
                ) => Value::Signal(Signal::Input([1.0, 0.0, 0.0])),
                Form::Frame => Value::Frame(AxisFrame::Body),
                Form::Side => Value::Side(None),
                Form::Spin => Value::Spin(None),
                Form::Slip => Value::Slip(None),
                Form::Name(_) => Value::Name(false),
                Form::ForceLaw | Form::BodyLaw => return None,
            })
        };
        Self::of(row, fields.iter().map(value).collect::<Option<Vec<_>>>()?)
    }
}

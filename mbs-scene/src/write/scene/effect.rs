//! `[[effect]]`: each kind with its keys.

use super::{Keys, Node, WriteError, Writer, list};
use mbs_core::scene::{
    AxisFrame, BodyId, CalspanCoefficients, Effect, EffectKind, JointId, Number, PolynomialPiece,
    Signal,
};

impl Writer<'_> {
    pub(super) fn effect(self, effect: &Effect<Number>) -> Result<Keys, WriteError> {
        let mut keys = Keys::default();
        keys.push("name", effect.name.as_str());
        if !effect.enabled {
            keys.push("enabled", Node::Bool(false));
        }
        match &effect.kind {
            EffectKind::SpringDamper { .. }
            | EffectKind::Bumper { .. }
            | EffectKind::Polynomial { .. }
            | EffectKind::Actuator { .. }
            | EffectKind::Bushing { .. } => self.between(&mut keys, &effect.kind)?,
            EffectKind::TorsionSpring { .. }
            | EffectKind::JointTorque { .. }
            | EffectKind::Limit { .. }
            | EffectKind::Friction { .. } => self.on_joint(&mut keys, &effect.kind)?,
            EffectKind::Own { .. } => return Err(WriteError::InCode(effect.name.clone())),
            EffectKind::Force { .. }
            | EffectKind::BodyTorque { .. }
            | EffectKind::AeroDrag { .. }
            | EffectKind::SpeedHold { .. }
            | EffectKind::Tire { .. } => self.on_body(&mut keys, &effect.kind)?,
        }
        Ok(keys)
    }

    /// Kind, bodies, and what stands where.
    fn line(
        self,
        keys: &mut Keys,
        kind: &str,
        (bodies, points): (&[BodyId; 2], &[[Number; 3]; 2]),
    ) -> Result<(), WriteError> {
        keys.push("kind", kind);
        keys.push("bodies", self.pair(*bodies)?);
        keys.push("points", self.two(points));
        Ok(())
    }

    fn between(self, keys: &mut Keys, kind: &EffectKind<Number>) -> Result<(), WriteError> {
        match kind {
            EffectKind::SpringDamper { bodies, points, stiffness, damping, free_length } => {
                self.line(keys, "spring-damper", (bodies, points))?;
                keys.push("stiffness", stiffness);
                keys.push("damping", damping);
                keys.push("free_length", free_length);
            }
            EffectKind::Bumper { bodies, points, stiffness, damping, clearance } => {
                self.line(keys, "bumper", (bodies, points))?;
                keys.push("stiffness", stiffness);
                keys.push("damping", damping);
                keys.push("clearance", clearance);
            }
            EffectKind::Polynomial { bodies, points, direction, of_rate, pieces } => {
                let name = if *of_rate { "polynomial-damper" } else { "polynomial-spring" };
                self.line(keys, name, (bodies, points))?;
                let piece = |PolynomialPiece { lower, upper, coefficients }: &_| {
                    list([lower, upper].into_iter().chain(coefficients).map(Node::from))
                };
                keys.push("coefficients", list(pieces.iter().map(piece)));
                keys.push_some("direction", direction.as_ref().map(|d| self.vector(d)));
            }
            EffectKind::Actuator { bodies, points, course } => {
                self.line(keys, "actuator", (bodies, points))?;
                self.course(keys, course, true);
            }
            EffectKind::Bushing { bodies, at, stiffness, damping } => {
                keys.push("kind", "bushing");
                keys.push("bodies", self.pair(*bodies)?);
                keys.push("at", self.vector(at));
                keys.push("stiffness", self.six(stiffness));
                keys.push("damping", self.six(damping));
            }
            _ => {}
        }
        Ok(())
    }

    /// Along and about x, y, z; in the plane along x, y and about z.
    fn six(self, numbers: &[Number; 6]) -> Node {
        let [x, y, .., about] = numbers;
        if self.is_planar() { list([x, y, about].map(Node::from)) } else { numbers.into() }
    }

    fn on_joint(self, keys: &mut Keys, kind: &EffectKind<Number>) -> Result<(), WriteError> {
        let head = |keys: &mut Keys, kind: &str, joint: &JointId| {
            keys.push("kind", kind);
            keys.push("joint", self.joint_name(*joint)?);
            Ok(())
        };
        match kind {
            EffectKind::TorsionSpring { joint, stiffness, damping, free_value } => {
                head(keys, "torsion-spring", joint)?;
                keys.push("stiffness", stiffness);
                keys.push("damping", damping);
                keys.push("free_value", free_value);
            }
            EffectKind::JointTorque { joint, course } => {
                head(keys, "torque", joint)?;
                self.course(keys, course, true);
            }
            EffectKind::Limit { joint, lower, upper, stiffness, damping } => {
                head(keys, "limit", joint)?;
                keys.push("lower", lower);
                keys.push("upper", upper);
                keys.push("stiffness", stiffness);
                keys.push("damping", damping);
            }
            EffectKind::Friction {
                joint,
                coulomb,
                r#static,
                stribeck,
                viscous,
                regularisation,
            } => {
                head(keys, "friction", joint)?;
                keys.push("coulomb", coulomb);
                keys.push("static", r#static);
                keys.push_some("stribeck", (!stribeck.is_computed()).then_some(stribeck));
                keys.push("viscous", viscous);
                keys.push("regularisation", regularisation);
            }
            _ => {}
        }
        Ok(())
    }

    fn on_body(self, keys: &mut Keys, kind: &EffectKind<Number>) -> Result<(), WriteError> {
        let head = |keys: &mut Keys, kind: &str, body: &BodyId| {
            keys.push("kind", kind);
            keys.push("body", self.body_name(*body)?);
            Ok(())
        };
        match kind {
            EffectKind::Force { body, at, course, frame } => {
                head(keys, "force", body)?;
                keys.push("at", self.vector(at));
                self.course(keys, course, false);
                if *frame == AxisFrame::Body {
                    keys.push("frame", "body");
                }
            }
            EffectKind::BodyTorque { body, course } => {
                head(keys, "torque", body)?;
                self.course(keys, course, self.is_planar());
            }
            EffectKind::AeroDrag { body, at, area_coefficient, density } => {
                head(keys, "aero-drag", body)?;
                keys.push("at", self.vector(at));
                keys.push("area_coefficient", area_coefficient);
                keys.push("density", density);
            }
            EffectKind::SpeedHold { body, direction, speed, gain, limit } => {
                head(keys, "speed-hold", body)?;
                keys.push("direction", self.vector(direction));
                keys.push("speed", speed);
                keys.push("gain", gain);
                keys.push("limit", limit);
            }
            EffectKind::Tire {
                body,
                center,
                axis,
                radius,
                stiffness,
                damping,
                rolling_resistance,
                side,
            } => {
                head(keys, "tire", body)?;
                keys.push("center", self.vector(center));
                keys.push_some("axis", axis.as_ref().map(|axis| self.vector(axis)));
                keys.push("radius", radius);
                keys.push("stiffness", stiffness);
                keys.push("damping", damping);
                keys.push("rolling_resistance", rolling_resistance);
                keys.push_some("side", side.as_ref().map(|_| "calspan"));
                let given = side.as_ref().filter(|side| **side != CalspanCoefficients::of_iltis());
                keys.push_some("coefficients", given.map(coefficients));
            }
            _ => {}
        }
        Ok(())
    }

    /// `value`, or `table` over time; an input by its value at the start.
    fn course(self, keys: &mut Keys, course: &Signal<Number>, is_scalar: bool) {
        let value = |x: &[Number; 3]| if is_scalar { Node::from(&x[0]) } else { self.vector(x) };
        match course {
            Signal::Constant(x) => keys.push("value", value(x)),
            Signal::Table(rows) => {
                keys.push("table", list(rows.iter().map(|(t, x)| list([t.into(), value(x)]))));
            }
            Signal::Input(x) => {
                keys.push("value", value(x));
                keys.push("input", Node::Bool(true));
            }
        }
    }
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

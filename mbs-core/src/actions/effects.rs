//! The effects that Cargo features bring, each in the build only with its own.
#![cfg_attr(
    not(feature = "effects"),
    allow(dead_code, unused_imports, unused_variables, clippy::match_single_binding),
    allow(clippy::unused_self, reason = "what one effect asks for is idle without it")
)]

use super::Action;
use super::compile::{Compiler, ends};
use crate::Real;
use crate::algebra::{Vector, norm, unit};
use crate::cluster::mass_properties;
use crate::inputs::SignalInput;
use crate::laws;
use crate::laws::body::BodyLaw;
use crate::laws::scalar::Law;
use crate::scene::{BodyId, Dimension, EffectKind, Freedom, JointId, PolynomialPiece, UserLaw};

impl<T: Real> Compiler<'_, T> {
    /// A law along a length or about an angle.
    pub(super) fn add_law(&mut self, kind: &EffectKind<T>) {
        match kind {
            #[cfg(feature = "polynomial")]
            EffectKind::Polynomial { bodies, points, direction, of_rate, pieces } => {
                let law = Law::Polynomial { pieces: self.pieces(pieces), of_rate: *of_rate };
                let ends = ends(bodies, points);
                self.push(match direction {
                    None => Action::Length { ends, law },
                    Some(d) => {
                        let direction = direction_of(*d);
                        Action::Along { ends, direction, offset: T::ZERO, law }
                    }
                });
            }
            #[cfg(feature = "bumper")]
            EffectKind::Bumper { bodies, points, stiffness, damping, clearance } => {
                let law = [*stiffness, *damping];
                let [p, q] = points.map(Vector::<T, 3>::from);
                let touch = norm(&(q - p)) - *clearance;
                let law = Law::Bumper { law, touch };
                self.push(Action::Length { ends: ends(bodies, points), law });
            }
            #[cfg(feature = "limit")]
            EffectKind::Limit { joint, lower, upper, stiffness, damping } => {
                let (lower, upper) = (*lower, *upper);
                let limit =
                    laws::limit::Limit { lower, upper, stiffness: *stiffness, damping: *damping };
                self.on_joint(*joint, Law::Limit(limit));
            }
            #[cfg(feature = "friction")]
            EffectKind::Friction {
                joint,
                coulomb,
                r#static,
                stribeck,
                viscous,
                regularisation,
            } => {
                let law = laws::friction::Friction {
                    coulomb: *coulomb,
                    r#static: *r#static,
                    stribeck: *stribeck,
                    viscous: *viscous,
                    regularisation: *regularisation,
                };
                self.on_joint(*joint, Law::Friction(law));
            }
            #[cfg(feature = "bushing")]
            EffectKind::Bushing { bodies, at, stiffness, damping } => {
                self.bushing(*bodies, *at, (stiffness, damping));
            }
            _ => {}
        }
    }

    /// A law on one body, or a user's own.
    pub(super) fn add_law_on_body(&mut self, kind: &EffectKind<T>) {
        match kind {
            #[cfg(feature = "drag")]
            EffectKind::AeroDrag { body, at, area_coefficient, density } => {
                let Some(body) = body.index() else { return };
                let (area_coefficient, density) = (*area_coefficient, *density);
                let law = BodyLaw::Drag { area_coefficient, density };
                self.push(Action::OnBody { at: (body, *at), axis: unit(0).into(), law });
            }
            #[cfg(feature = "speed-hold")]
            EffectKind::SpeedHold { body, direction, speed, gain, limit } => {
                let Some(body) = body.index() else { return };
                let (speed, gain, limit) = (*speed, *gain, *limit);
                let law = BodyLaw::SpeedHold(laws::speed_hold::SpeedHold { speed, gain, limit });
                let at = (body, mass_properties(self.scene, body).1.into());
                self.push(Action::OnBody { at, axis: direction_of(*direction), law });
            }
            #[cfg(feature = "tire")]
            EffectKind::Tire {
                body,
                center,
                axis: given,
                radius,
                stiffness,
                damping,
                rolling_resistance,
                side,
            } => {
                let Some(body) = body.index() else { return };
                let (roads, travel) = self.roads();
                let law = BodyLaw::Tire(laws::tire::Tire {
                    radius: *radius,
                    radial: [*stiffness, *damping],
                    rolling: *rolling_resistance,
                    side: *side,
                    road: roads[usize::from(center[1] < T::ZERO && !self.is_planar())],
                    travel,
                    up: self.scene.dimension.count() - 1,
                    leans: given.is_some() && !self.is_planar(),
                });
                let axis = given.map_or_else(|| unit(2).into(), direction_of);
                self.push(Action::OnBody { at: (body, *center), axis, law });
            }
            #[cfg(feature = "own-laws")]
            EffectKind::Own { law, course } => {
                let course = self.course(SignalInput::new(course));
                match *law {
                    UserLaw::Length { bodies, points, law } => {
                        let law = Law::Own { law, course };
                        self.push(Action::Length { ends: ends(&bodies, &points), law });
                    }
                    UserLaw::Joint { joint, law } => self.on_joint(joint, Law::Own { law, course }),
                    UserLaw::Body { body, at, axis, law } => {
                        let Some(body) = body.index() else { return };
                        let law = BodyLaw::Own { law, course };
                        self.push(Action::OnBody { at: (body, at), axis: direction_of(axis), law });
                    }
                }
            }
            _ => {}
        }
    }

    fn is_planar(&self) -> bool {
        self.scene.dimension == Dimension::Planar
    }

    /// A law of a joint's one coordinate: the scene's check refuses joints with none or several.
    fn on_joint(&mut self, id: JointId, law: Law<T>) {
        let joint = &self.scene.joints[id];
        match joint.kind.single(self.scene.dimension) {
            Some(Freedom::Slide(axis)) => {
                let direction = direction_of(joint.direction(axis).into());
                let ends = [0, 1].map(|i| (joint.bodies[i], joint.points[i]));
                self.push(Action::Along { ends, direction, offset: T::ZERO, law });
            }
            Some(Freedom::Turn(axis)) => self.push(Action::Angle { joint: id.index(), axis, law }),
            Some(Freedom::Ball) | None => {}
        }
    }

    fn bushing(&mut self, bodies: [BodyId; 2], at: [T; 3], (k, c): (&[T; 6], &[T; 6])) {
        let acts = |i: usize| !(k[i].is_zero() && c[i].is_zero());
        let law = |i| Law::SpringDamper { stiffness: k[i], damping: c[i], free: T::ZERO };
        let ends = bodies.map(|body| (body, at));
        for i in (0..self.scene.dimension.count()).filter(|&i| acts(i)) {
            let direction = unit(i).into();
            self.push(Action::Along { ends, direction, offset: T::ZERO, law: law(i) });
        }
        if self.is_planar() {
            if acts(5) {
                self.push(Action::Turn { bodies, law: law(5) });
            }
        } else if (3..6).any(acts) {
            // All three: a rotation is remembered as a whole.
            for number in 0..3_u32 {
                self.push(Action::Rotation { bodies, number, law: law(3 + number as usize) });
            }
        }
    }

    #[cfg(feature = "polynomial")]
    fn pieces(&mut self, pieces: &[PolynomialPiece<T>]) -> laws::Part {
        let all = &mut self.actions.tables.pieces;
        let first = all.len();
        all.extend(
            pieces
                .iter()
                .filter_map(|p| laws::polynomial::Piece::new([p.lower, p.upper], &p.coefficients)),
        );
        laws::polynomial::link(&mut all[first..]);
        super::compile::part(first, all.len())
    }
}

/// The direction of length one, each component divided by the length.
fn direction_of<T: Real>(d: [T; 3]) -> [T; 3] {
    let size = norm(&Vector::from(d));
    d.map(|x| x / size)
}

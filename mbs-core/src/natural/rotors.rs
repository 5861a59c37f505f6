//! Rotors: each has an unknown that equals the joint's coordinate, so that the mass matrix stays constant.
//!
//! ```text
//! E = inertia x'^2 / 2,   x - q = 0          inertia: the rotor's inertia times its squared ratio, x: the unknown
//! ```
//!
//! Unknowns are components of vectors. The unknown x is the first component of a vector, and rows hold its other components at
//! zero. The rotor's angle is ratio times x. The unknown x has the size of the joint coordinate q, so that no tolerance depends on
//! the ratio.

use super::build::Builder;
use super::model::{NaturalModel, NaturalRotor};
use super::row_builder::{CoupledDraft, GroupDraft, MeasureDraft, RowDraft};
use super::sharing::{Entity, EntityKind};
use crate::Real;
use crate::algebra::{Coef, Vector, unit};
use crate::elements::{
    CoupledForm, Measurand, Signed, Span, combine, measured_value, rate_and_bias,
};
use crate::measure::PreparedCurve;
use crate::mechanism::RotorInput;
use crate::model::{Owner, State};
use crate::scene::BodyId;
use alloc::vec;
use alloc::vec::Vec;

impl<T: Real> Builder<'_, T> {
    /// Adds a group for each rotor: its mass, and the rows of its unknown.
    pub(super) fn add_rotors(&mut self) {
        let scene = self.scene;
        for rotor in RotorInput::all(scene) {
            let Some(of) = self.coordinate_measure(rotor.joint, rotor.number) else { continue };
            self.entities.push(Entity {
                kind: EntityKind::Direction,
                at: Vector::zeros(),
                is_constant: false,
            });
            let entity = self.entities.len() - 1;
            let x = || vec![(entity, Coef::one())];
            let axes: Vec<_> = (0..scene.dimension.count())
                .map(|i| self.direction(BodyId::Ground, unit(i)))
                .collect();
            let term = |factor, measure| CoupledDraft {
                factor,
                measures: vec![measure],
                curve: PreparedCurve::new(None),
            };
            let own = MeasureDraft::Slide { x: x(), y: axes[0].clone() };
            let mut group = GroupDraft::new(Owner::Effect(rotor.effect));
            group.mass = Some((vec![entity], vec![Coef::real(rotor.inertia)]));
            group.rows.push(RowDraft::Coupled {
                terms: vec![term(T::ONE, own), term(-T::ONE, of)],
                inverse: T::ONE,
                guide: None,
                form: CoupledForm::Linear,
            });
            group.rows.extend(axes.into_iter().skip(1).map(|y| RowDraft::Dot {
                x: x(),
                y,
                scale: T::ONE,
                constant: T::ZERO,
            }));
            self.groups.push(group);
            self.rotors.push((entity, rotor));
        }
    }
}

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Finds the unknowns and the measures of rotors, after all tables are filled.
    pub(super) fn place_rotors(&mut self, rotors: &[(usize, RotorInput<T>)]) {
        for &(entity, RotorInput { effect, inertia, .. }) in rotors {
            let of = |row: u32| self.row_owner.get(row as usize) == Some(&Owner::Effect(effect));
            let row = self.coupled.iter().find(|row| of(row.row));
            let term = row.and_then(|row| row.terms.of(&self.coupled_terms).last());
            let Some(term) = term else { continue };
            let (unknown, measure) =
                (self.entity_at[entity] as usize, term.measures.start as usize);
            self.rotors.push(NaturalRotor { effect, unknown, inertia, measure });
        }
    }

    /// Rotors of the scene.
    #[must_use]
    pub fn rotors(&self) -> &[NaturalRotor<T>] {
        &self.rotors
    }

    /// Writes the unknowns of rotors from the bodies' coordinates, with the angles that the state remembers.
    pub(crate) fn write_rotors(&self, s: &mut State<T>) {
        for rotor in &self.rotors {
            let Signed { sign, of } = &self.coupled_measures[rotor.measure];
            let at = |x: Span| combine::<T, D>(x.of(&self.pool), &s.q);
            let value = measured_value(of, at, &s.memory);
            let [rate, bias] =
                rate_and_bias(of, at, |x: Span| combine::<T, D>(x.of(&self.pool), &s.v));
            let [along, _] =
                rate_and_bias(of, at, |x: Span| combine::<T, D>(x.of(&self.pool), &s.a));
            s.q[rotor.unknown] = *sign * value;
            s.v[rotor.unknown] = *sign * rate;
            s.a[rotor.unknown] = *sign * (along + bias);
        }
    }

    /// Unknowns of rotors on slides, which are lengths of the size of the scene.
    pub(super) fn rotors_on_slides(&self) -> impl Iterator<Item = usize> + '_ {
        let measures = &self.coupled_measures;
        let is_slide = |rotor: &&NaturalRotor<T>| {
            matches!(measures[rotor.measure].of, Measurand::Slide { .. })
        };
        self.rotors.iter().filter(is_slide).map(|rotor| rotor.unknown)
    }
}

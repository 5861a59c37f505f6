//! Evaluation of a [`NaturalModel`]: constraints, forces, blocks and residuals, element by element.

use super::forces::Measure;
use super::group::index;
use super::model::NaturalModel;
use crate::Real;
use crate::algebra::norm;
use crate::elements::{Coupled, CoupledForm, Measurand, Span, combine, measured_value};
use crate::inputs::Prescribed;
use crate::measure::PreparedCurve;
use crate::model::{Load, Model, Owner, ScalarForce, SignalValues, State, Tangent, Terms};
use crate::step::StepError;
use crate::team::Alone;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// Calls a kernel with the number of a group's unknowns as a constant, for the numbers that bodies, joints and effects often have.
/// For other numbers the constant is zero.
macro_rules! sized {
    ($k:expr, $self:ident.$kernel:ident($($argument:expr),*)) => {
        match $k {
            2 => $self.$kernel::<2>($($argument),*),
            4 => $self.$kernel::<4>($($argument),*),
            6 => $self.$kernel::<6>($($argument),*),
            8 => $self.$kernel::<8>($($argument),*),
            9 => $self.$kernel::<9>($($argument),*),
            12 => $self.$kernel::<12>($($argument),*),
            15 => $self.$kernel::<15>($($argument),*),
            18 => $self.$kernel::<18>($($argument),*),
            21 => $self.$kernel::<21>($($argument),*),
            24 => $self.$kernel::<24>($($argument),*),
            _ => $self.$kernel::<0>($($argument),*),
        }
    };
}

/// Least diagonal mass for the scaling of rows, relative to the largest [-]. It keeps every inverse mass finite. Chosen, not tuned.
const LIFTED: f64 = 1e-6;

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Writes the effective mass of each row, 1 / (J_k M^-1 J_k^T), with a diagonal M.
    pub(crate) fn row_masses(&self, diagonal: &[T], terms: &Terms<T>, masses: &mut [T]) {
        for group in &self.groups {
            let clique = group.clique.of(&self.cliques);
            let (mut at, width) = (group.jacobian as usize, group.width as usize);
            for row in group.rows.range() {
                let mobility = clique
                    .iter()
                    .zip(&terms.jacobian[at..])
                    .fold(T::ZERO, |sum, (&u, &g)| sum + g * g / diagonal[u as usize]);
                masses[row] = if mobility > T::ZERO { T::ONE / mobility } else { T::ONE };
                at += width;
            }
        }
    }

    /// Writes the largest change of each row when the coordinates change by `sizes`; one for a row that does not change.
    pub(crate) fn row_spreads(&self, sizes: &[T], terms: &Terms<T>, spreads: &mut [T]) {
        for group in &self.groups {
            let clique = group.clique.of(&self.cliques);
            let (mut at, width) = (group.jacobian as usize, group.width as usize);
            for row in group.rows.range() {
                let products = clique.iter().zip(&terms.jacobian[at..]);
                let spread =
                    products.fold(T::ZERO, |s, (&u, &g)| s.max(g.abs() * sizes[u as usize]));
                spreads[row] = if spread > T::ZERO { spread } else { T::ONE };
                at += width;
            }
        }
    }
}

/// Cotangents of angles [-]: the angle is between the path of a point and the line to the point that it passes. Effects whose
/// points pass each other are evaluated at these angles. Chosen, not tuned: powers of four from 86° to 14°.
const OBLIQUE: [f64; 4] = [0.0625, 0.25, 1.0, 4.0];

impl<T: Real, const D: usize> Model<T> for NaturalModel<T, D> {
    fn n_extended(&self) -> usize {
        self.reference.len()
    }
    fn n_constraints(&self) -> usize {
        self.n_rows
    }
    fn n_memory(&self) -> usize {
        self.n_memory
    }
    fn has_forces(&self) -> bool {
        self.n_measures > 0
            || !self.feedback.is_empty()
            || !(self.point_forces.is_empty() && self.torques.is_empty())
    }
    fn has_guides(&self) -> bool {
        !self.guided.is_empty() || self.driven().next().is_some()
    }

    fn n_signal_states(&self) -> usize {
        self.feedback.starts.len()
    }

    fn signal_states(&self) -> SignalValues<T> {
        self.feedback.states()
    }

    fn inputs(&self) -> Option<&Prescribed<T>> {
        Some(&self.prescribed)
    }

    fn terms(&self) -> Terms<T> {
        let zeros = |n| vec![T::ZERO; n];
        let mut jacobian = zeros(self.n_jacobian);
        for linear in &self.linears {
            linear.write_gradient::<T, D>(&self.pool, &mut jacobian);
        }
        Terms {
            phi: zeros(self.n_rows),
            phi_t: zeros(self.n_rows),
            phi_bias: zeros(self.n_rows),
            jacobian,
            force: self.constant_force.clone(),
            measures: vec![ScalarForce::default(); self.n_measures],
            guides: vec![[T::ZERO; 3]; self.prescribed.n_guides()],
            courses: vec![[T::ZERO; 3]; self.prescribed.n_courses()],
            angles: zeros(self.n_memory),
            signals: self.feedback.states(),
            signal_starts: self.feedback.states(),
            signal_dt: T::ZERO,
            course_slopes: self.feedback.slopes(self.prescribed.n_courses()),
        }
    }

    fn write_reference(&self, q: &mut [T]) {
        q.copy_from_slice(&self.reference);
    }

    fn write_sizes(&self, sizes: &mut [T]) {
        sizes.copy_from_slice(&self.sizes());
    }

    fn approaches(&self, q: &[T], to: &[T], mut take: impl FnMut(T)) {
        for element in self.measures.iter().filter(|element| element.law.may_push()) {
            let Measure::Length { x } = element.gauge else { continue };
            let [from, to] = [q, to].map(|q| combine::<T, D>(x.of(&self.pool), q));
            // the distance |r + x (r' - r)| is least at x = -r.(r' - r) / |r' - r|^2
            let way = to - from;
            let [length, speed] = [norm(&from), norm(&way)];
            let closest = -from.dot(&way) / (speed * speed);
            if !(closest > T::ZERO && closest < T::ONE) {
                continue;
            }
            let passed = norm(&(from + way * closest)) / speed;
            // Times shortly before the closest approach, because a force has no direction at distance zero. At some of these times
            // the line is oblique to the path.
            let hair = length / speed * T::EPSILON.sqrt();
            for share in OBLIQUE {
                let before = closest - passed * T::from_f64(share) - hair;
                if before > T::ZERO {
                    take(before);
                }
            }
        }
    }

    fn set_inputs(&self, t: T, state: &State<T>, terms: &mut Terms<T>) {
        terms.angles.copy_from_slice(&state.memory);
        terms.begin_signals(t - state.t, state);
        self.prescribed.write(t, &state.inputs, &mut terms.guides, &mut terms.courses);
        terms.measures.iter_mut().for_each(|measure| measure.rate = T::ZERO);
    }

    fn evaluate(&self, q: &[T], terms: &mut Terms<T>) {
        self.evaluate_on(&Alone, q, terms);
    }

    fn advance(&self, q: &[T], dq: &[T], phi_n: &[T], terms: &mut Terms<T>) {
        self.advance_on(&Alone, (q, dq), phi_n, terms);
    }

    fn evaluate_forces(&self, q: &[T], v: &[T], terms: &mut Terms<T>) {
        self.evaluate_forces_on(&Alone, (q, v), terms);
    }

    fn remember(&self, q: &[T], terms: &Terms<T>, memory: &mut [T]) {
        for measure in self.coupled_measures.iter().chain(&self.measured) {
            if let Measurand::Angle { memory: place, .. } | Measurand::Twist { memory: place, .. } =
                measure.of
            {
                let at = |x: Span| combine::<T, D>(x.of(&self.pool), q);
                memory[place as usize] = measured_value(&measure.of, at, &terms.angles);
            }
        }
        for (element, measure) in self.measures.iter().zip(&terms.measures) {
            match element.gauge {
                Measure::Angle { memory: place, .. } => memory[place as usize] = measure.value,
                Measure::Rotation { number, memory: place, .. } => {
                    memory[(place + number) as usize] = measure.value;
                }
                // the angles of a sum are remembered by the loops over measures above
                Measure::Length { .. } | Measure::Along { .. } | Measure::Sum { .. } => {}
            }
        }
    }

    fn evaluate_phi_t(&self, q: &[T], terms: &mut Terms<T>) {
        for row in &self.guided {
            terms.phi_t[row.row as usize] = row.phi_t::<T, D>(&self.pool, q, &terms.guides);
        }
        for row in self.driven() {
            terms.phi_t[row.row as usize] = row.phi_t(terms.guides[row.guide as usize]);
        }
    }

    fn has_velocity_rows(&self) -> bool {
        !self.rollings.is_empty()
    }

    fn is_velocity_row(&self, row: usize) -> bool {
        self.rollings.iter().any(|rolling| rolling.slip_rows().contains(&row))
    }

    fn evaluate_rates(&self, v: &[T], unit: T, terms: &mut Terms<T>) {
        self.write_slips(v, unit, terms);
    }

    fn evaluate_bias(&self, q: &[T], v: &[T], terms: &mut Terms<T>) {
        self.evaluate_bias_on(&Alone, (q, v), terms);
    }

    fn multiply_jacobian(&self, terms: &Terms<T>, x: &[T], rates: &mut [T]) {
        self.multiply_jacobian_on(&Alone, terms, x, rates);
    }

    fn effective_masses(&self, terms: &Terms<T>, masses: &mut [T]) {
        self.row_masses(&self.mass_diagonal(T::from_f64(LIFTED)), terms, masses);
    }

    fn rows(&self, element: usize) -> Range<usize> {
        self.groups[element].rows.range()
    }

    fn write_jacobian(&self, terms: &Terms<T>, element: usize, rows: &mut [T]) {
        let group = &self.groups[element];
        let (k, width) = (group.clique.len(), group.width as usize);
        let jacobian = terms.jacobian[group.jacobian as usize..].chunks_exact(width.max(1));
        for (to, from) in rows.chunks_exact_mut(k.max(1)).zip(jacobian).take(group.rows.len()) {
            to.copy_from_slice(&from[..k]);
        }
    }

    fn may_be_level(&self, row: usize) -> bool {
        let is_sum =
            |of: &&Coupled<T>| of.row as usize == row && matches!(of.form, CoupledForm::Sum);
        let mut sums = self.coupled.iter().filter(is_sum);
        sums.any(|sum| {
            let mut terms = sum.terms.of(&self.coupled_terms).iter();
            terms.any(|term| {
                self.curves.get(term.curve as usize).is_some_and(PreparedCurve::may_be_level)
            })
        })
    }

    #[inline]
    fn write_block(
        &self,
        terms: &Terms<T>,
        tangent: &Tangent<'_, T>,
        element: usize,
        block: &mut [T],
    ) {
        let group = &self.groups[element];
        sized!(group.clique.len(), self.write_sized_block(terms, tangent, group, block));
    }

    fn row_curvature(
        &self,
        q: &[T],
        terms: &Terms<T>,
        weights: (&[T], T),
        element: usize,
    ) -> Vec<T> {
        self.coupled_curvature((q, terms), weights, element)
    }

    #[inline]
    fn has_block(&self, terms: &Terms<T>, tangent: &Tangent<'_, T>, element: usize) -> bool {
        let group = &self.groups[element];
        let has_rows = !group.rows.is_empty();
        !group.block.is_empty()
            || (has_rows && !(tangent.penalty.is_empty() && tangent.geometric.is_none()))
            || group.measures.of(&terms.measures).iter().any(|m| tangent.has(m))
    }

    #[inline]
    fn write_residual(
        &self,
        terms: &Terms<T>,
        load: &Load<'_, T>,
        element: usize,
        residual: &mut [T],
    ) {
        let group = &self.groups[element];
        sized!(group.clique.len(), self.write_sized_residual(terms, load, group, residual));
    }

    fn sum_residuals(&self, terms: &Terms<T>, load: &Load<'_, T>, f: &mut [T]) -> bool {
        if let ([group], true) = (&self.groups[..], self.is_whole) {
            match group.clique.len() {
                2 => self.write_whole_residual::<2>(terms, load, group, f),
                4 => self.write_whole_residual::<4>(terms, load, group, f),
                6 => self.write_whole_residual::<6>(terms, load, group, f),
                _ => self.write_whole_residual::<8>(terms, load, group, f),
            }
            return true;
        }
        f.fill(T::ZERO);
        if !self.is_small {
            return false;
        }
        for group in &self.groups {
            if load.force == T::ZERO && group.rows.is_empty() && group.mass.is_empty() {
                continue;
            }
            sized!(group.clique.len(), self.add_sized_residual(terms, load, group, f));
        }
        true
    }

    fn kinetic_energy(&self, v: &[T]) -> T {
        self.kinetic_energy_on(&Alone, v)
    }

    fn potential_energy(&self, q: &[T], terms: &Terms<T>) -> T {
        self.potential_energy_on(&Alone, q, terms)
    }

    fn power(&self, q: &[T], v: &[T], lambda: &[T], terms: &Terms<T>) -> T {
        let mut power = T::ZERO;
        let law_inputs = self.tables.law_inputs(&terms.courses);
        for (element, measure) in self.measures.iter().zip(&terms.measures) {
            power += element.power(measure, &law_inputs);
        }
        for element in &self.body_elements {
            power += element.power(&terms.measures);
        }
        for force in &self.point_forces {
            let value = self.point_force(force, q, terms.courses[force.course as usize]);
            power += value.dot(&combine::<T, D>(force.point.of(&self.pool), v));
        }
        for torque in &self.torques {
            for span in torque.frame {
                power += self.torque_power(torque, span, (q, v), terms);
            }
        }
        // The guide's force on the coordinates is -J^T lambda, and J v = -phi_t: its power is lambda phi_t.
        let rows = self.guided.iter().map(|row| row.row).chain(self.driven().map(|row| row.row));
        for row in rows {
            power += lambda[row as usize] * terms.phi_t[row as usize];
        }
        power
    }

    fn opposite_guide(&self, q: &[T], terms: &Terms<T>) -> Option<usize> {
        let is_opposite =
            |row: &&crate::elements::Guided| row.is_opposite::<T, D>(&self.pool, q, &terms.guides);
        self.guided.iter().find(is_opposite).map(|row| row.row as usize)
    }

    fn overturned(&self, terms: &Terms<T>) -> Option<Owner> {
        let turn = T::TWO * T::PI;
        let is_over = |&&(first, _): &&(u32, Owner)| {
            let parts = terms.measures[first as usize..].iter().take(3);
            let square = parts.fold(T::ZERO, |sum, part| sum + part.value * part.value);
            !(square <= turn * turn)
        };
        self.rotations.iter().find(is_over).map(|&(_, owner)| owner)
    }

    fn without_direction(&self, state: &State<T>, dq: &[T]) -> Option<StepError> {
        let step = (&state.q[..], &state.v[..], dq);
        let held = self.coupled.iter().find_map(|row| {
            let part = index(self.collapsed_part(row.terms, step)?);
            match self.row_owner[row.row as usize] {
                Owner::Coupling(i) => Some(StepError::RopeCollapsed { coupling: index(i), part }),
                _ => None,
            }
        });
        let flat = || self.flat(&state.q).map(|i| StepError::RollingFlat { rolling: index(i) });
        held.or_else(|| self.undirected_effect(state, dq)).or_else(flat)
    }

    fn owner_of_unknown(&self, unknown: usize) -> Owner {
        self.unknown_owner[unknown / D]
    }
    fn owner_of_row(&self, row: usize) -> Owner {
        self.row_owner[row]
    }
}

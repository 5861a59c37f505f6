//! The numbers of a [`NaturalModel`]: constraints, forces, blocks and residuals, element by element.

use super::forces::{Gauge, add_terms, add_torque};
use super::model::NaturalModel;
use crate::Real;
use crate::algebra::Vector;
use crate::elements::combine;
use crate::model::{Load, Measure, Model, Owner, Tangent, Terms};
use alloc::vec;
use core::ops::Range;

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
        self.n_measures > 0 || !(self.point_forces.is_empty() && self.torques.is_empty())
    }
    fn has_guides(&self) -> bool {
        !self.guided.is_empty()
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
            measures: vec![Measure::default(); self.n_measures],
            guides: vec![[T::ZERO; 3]; self.prescribed.n_guides()],
            courses: vec![[T::ZERO; 3]; self.prescribed.n_courses()],
        }
    }

    fn write_reference(&self, q: &mut [T]) {
        q.copy_from_slice(&self.reference);
    }

    fn set_inputs(&self, t: T, terms: &mut Terms<T>) {
        self.prescribed.write(t, &mut terms.guides, &mut terms.courses);
    }

    fn evaluate(&self, q: &[T], terms: &mut Terms<T>) {
        let (phi, jacobian) = (&mut terms.phi[..], &mut terms.jacobian[..]);
        for row in &self.distances {
            row.evaluate::<D>(q, phi, jacobian);
        }
        for row in &self.dots {
            row.evaluate::<D>(&self.pool, q, phi, jacobian);
        }
        for row in &self.linears {
            row.evaluate::<T, D>(&self.pool, q, phi);
        }
        for row in &self.guided {
            let f = terms.guides[row.guide as usize][0];
            row.evaluate::<T, D>(&self.pool, q, f, (phi, jacobian));
        }
    }

    fn advance(&self, q: &[T], dq: &[T], phi_n: &[T], terms: &mut Terms<T>) {
        let (phi, jacobian) = (&mut terms.phi[..], &mut terms.jacobian[..]);
        for row in &self.distances {
            row.advance::<D>((q, dq), phi_n, phi, jacobian);
        }
        for row in &self.dots {
            row.advance::<D>(&self.pool, (q, dq), phi_n, (phi, jacobian));
        }
        for row in &self.linears {
            row.advance::<T, D>(&self.pool, dq, phi_n, phi);
        }
        for row in &self.guided {
            let f = terms.guides[row.guide as usize][0];
            row.evaluate_at_sum::<T, D>(&self.pool, (q, dq), f, (phi, jacobian));
        }
    }

    fn evaluate_forces(&self, q: &[T], v: &[T], memory: &[T], terms: &mut Terms<T>) {
        let supplies = self.tables.supplies(&terms.courses);
        let jacobian = &mut terms.jacobian;
        for (element, measure) in self.measures.iter().zip(&mut terms.measures) {
            *measure = element.evaluate::<D>(&self.pool, (q, v, memory), &supplies, jacobian);
        }
        for element in &self.body_elements {
            let out = (&mut jacobian[..], &mut terms.measures[..]);
            element.evaluate::<D>(&self.pool, (q, v), &supplies, out);
        }
        for force in &self.point_forces {
            let value = self.point_force(force, q, terms.courses[force.course as usize]);
            let local = force.force.of_mut(&mut terms.force);
            local.fill(T::ZERO);
            add_terms(force.point.of(&self.pool), &value, local);
        }
        for torque in &self.torques {
            let local = torque.force.of_mut(&mut terms.force);
            local.fill(T::ZERO);
            let tau = terms.courses[torque.course as usize];
            add_torque::<T, D>(&self.pool, &torque.frame, tau, q, local);
        }
    }

    fn remember(&self, terms: &Terms<T>, memory: &mut [T]) {
        for (element, measure) in self.measures.iter().zip(&terms.measures) {
            if let Gauge::Angle { memory: place, .. } = element.gauge {
                memory[place as usize] = measure.value;
            }
        }
    }

    fn evaluate_phi_t(&self, q: &[T], terms: &mut Terms<T>) {
        for row in &self.guided {
            let f = terms.guides[row.guide as usize];
            terms.phi_t[row.row as usize] = row.phi_t::<T, D>(&self.pool, q, f);
        }
    }

    fn evaluate_bias(&self, q: &[T], v: &[T], terms: &mut Terms<T>) {
        for row in &self.distances {
            terms.phi_bias[row.row as usize] = row.bias::<D>(v);
        }
        for row in &self.dots {
            terms.phi_bias[row.row as usize] = row.bias::<D>(&self.pool, v);
        }
        for row in &self.guided {
            let f = terms.guides[row.guide as usize];
            terms.phi_bias[row.row as usize] = row.bias::<T, D>(&self.pool, (q, v), f);
        }
    }

    fn multiply_jacobian(&self, terms: &Terms<T>, x: &[T], rates: &mut [T]) {
        for group in &self.groups {
            match group.clique.len() {
                2 => self.multiply_sized_jacobian::<2>(group, terms, x, rates),
                4 => self.multiply_sized_jacobian::<4>(group, terms, x, rates),
                6 => self.multiply_sized_jacobian::<6>(group, terms, x, rates),
                9 => self.multiply_sized_jacobian::<9>(group, terms, x, rates),
                12 => self.multiply_sized_jacobian::<12>(group, terms, x, rates),
                _ => self.multiply_sized_jacobian::<0>(group, terms, x, rates),
            }
        }
    }

    fn effective_masses(&self, terms: &Terms<T>, masses: &mut [T]) {
        let diagonal = self.mass_diagonal();
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

    #[inline]
    fn write_block(
        &self,
        terms: &Terms<T>,
        tangent: &Tangent<'_, T>,
        element: usize,
        block: &mut [T],
    ) {
        let group = &self.groups[element];
        match group.clique.len() {
            2 => self.write_sized_block::<2>(terms, tangent, group, block),
            4 => self.write_sized_block::<4>(terms, tangent, group, block),
            6 => self.write_sized_block::<6>(terms, tangent, group, block),
            9 => self.write_sized_block::<9>(terms, tangent, group, block),
            12 => self.write_sized_block::<12>(terms, tangent, group, block),
            _ => self.write_sized_block::<0>(terms, tangent, group, block),
        }
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
        match group.clique.len() {
            2 => self.write_sized_residual::<2>(terms, load, group, residual),
            4 => self.write_sized_residual::<4>(terms, load, group, residual),
            6 => self.write_sized_residual::<6>(terms, load, group, residual),
            9 => self.write_sized_residual::<9>(terms, load, group, residual),
            12 => self.write_sized_residual::<12>(terms, load, group, residual),
            _ => self.write_sized_residual::<0>(terms, load, group, residual),
        }
    }

    fn kinetic_energy(&self, v: &[T]) -> T {
        let mut twice = T::ZERO;
        for group in &self.groups {
            let (g, slots) = (group.mass.of(&self.mass), group.slots.of(&self.slots));
            let nb = if g.is_empty() { 0 } else { group.n_unknown as usize };
            for i in 0..nb {
                let mut sum = Vector::<T, D>::zeros();
                for j in 0..nb {
                    sum += g[i * nb + j].apply(&crate::algebra::load::<T, D>(v, slots[j]));
                }
                twice += sum.dot(&crate::algebra::load::<T, D>(v, slots[i]));
            }
        }
        twice * T::HALF
    }

    fn potential_energy(&self, q: &[T], terms: &Terms<T>) -> T {
        let mut energy = T::ZERO;
        for (&w, &x) in self.weight.iter().zip(q) {
            energy -= w * x;
        }
        let supplies = self.tables.supplies(&terms.courses);
        for (element, measure) in self.measures.iter().zip(&terms.measures) {
            energy += element.energy(measure, &supplies);
        }
        for element in &self.body_elements {
            energy += element.energy(&terms.measures);
        }
        energy
    }

    fn power(&self, q: &[T], v: &[T], lambda: &[T], terms: &Terms<T>) -> T {
        let mut power = T::ZERO;
        let supplies = self.tables.supplies(&terms.courses);
        for (element, measure) in self.measures.iter().zip(&terms.measures) {
            power += element.power(measure, &supplies);
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
        // A guide's force on the coordinates is -J^T lambda and J v = -phi_t: its power is lambda phi_t.
        for row in &self.guided {
            power += lambda[row.row as usize] * terms.phi_t[row.row as usize];
        }
        power
    }

    fn opposite_guide(&self, q: &[T], terms: &Terms<T>) -> Option<usize> {
        let is_opposite = |row: &&crate::elements::Guided| {
            row.is_opposite::<T, D>(&self.pool, q, terms.guides[row.guide as usize][0])
        };
        self.guided.iter().find(is_opposite).map(|row| row.row as usize)
    }

    fn owner_of_unknown(&self, unknown: usize) -> Owner {
        self.unknown_owner[unknown / D]
    }
    fn owner_of_row(&self, row: usize) -> Owner {
        self.row_owner[row]
    }
}

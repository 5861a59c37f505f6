//! The numbers of a [`NaturalModel`]: constraints, forces, blocks and residuals, element by element.

use super::forces::{Gauge, add_terms, add_torque};
use super::group::{Group, add_curvature, add_mass_product, add_multiples, add_squares};
use super::model::NaturalModel;
use crate::Real;
use crate::algebra::Vector;
use crate::elements::combine;
use crate::model::{Load, Measure, Model, Owner, Tangent, Terms};
use alloc::vec;

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
        !(self.measures.is_empty() && self.point_forces.is_empty() && self.torques.is_empty())
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
            measures: vec![Measure::default(); self.measures.len()],
            guides: vec![[T::ZERO; 3]; self.guides.len()],
            courses: vec![[T::ZERO; 3]; self.courses.len()],
        }
    }

    fn write_reference(&self, q: &mut [T]) {
        q.copy_from_slice(&self.reference);
    }

    fn set_inputs(&self, t: T, terms: &mut Terms<T>) {
        for (input, value) in self.guides.iter().zip(&mut terms.guides) {
            *value = input.at(t);
        }
        for (input, value) in self.courses.iter().zip(&mut terms.courses) {
            *value = input.at(t);
        }
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
        for (element, measure) in self.measures.iter().zip(&mut terms.measures) {
            let jacobian = &mut terms.jacobian;
            *measure = element.evaluate::<D>(&self.pool, (q, v, memory), &terms.courses, jacobian);
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
        for (element, measure) in self.measures.iter().zip(&terms.measures) {
            energy += element.energy(measure);
        }
        energy
    }

    fn power(&self, q: &[T], v: &[T], lambda: &[T], terms: &Terms<T>) -> T {
        let mut power = T::ZERO;
        for (element, measure) in self.measures.iter().zip(&terms.measures) {
            power += element.power(measure);
        }
        for force in &self.point_forces {
            let value = self.point_force(force, q, terms.courses[force.course as usize]);
            power += value.dot(&combine::<T, D>(force.point.of(&self.pool), v));
        }
        for torque in &self.torques {
            for (i, span) in torque.frame.iter().enumerate() {
                power += self.torque_power(torque, *span, i, (q, v), terms);
            }
        }
        // A guide's force on the coordinates is -J^T lambda and J v = -phi_t: its power is lambda phi_t.
        for row in &self.guided {
            power += lambda[row.row as usize] * terms.phi_t[row.row as usize];
        }
        power
    }

    fn owner_of_unknown(&self, unknown: usize) -> Owner {
        self.unknown_owner[unknown / D]
    }
    fn owner_of_row(&self, row: usize) -> Owner {
        self.row_owner[row]
    }
}

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Diagonal of M, lifted where it is (nearly) zero so that it can scale: by 1e-6 of the largest entry.
    pub(crate) fn mass_diagonal(&self) -> alloc::vec::Vec<T> {
        let mut diagonal = vec![T::ZERO; self.n_unknowns];
        for group in self.groups.iter().filter(|g| !g.mass.is_empty()) {
            let g = group.mass.of(&self.mass);
            let nb = group.n_unknown as usize;
            for (j, &u) in group.clique.of(&self.cliques).iter().enumerate() {
                diagonal[u as usize] += g[(j / D) * (nb + 1)].re;
            }
        }
        let largest = diagonal.iter().fold(T::ZERO, |a, &b| a.max(b));
        let floor = if largest > T::ZERO { largest * T::from_f64(1e-6) } else { T::ONE };
        for d in &mut diagonal {
            *d = d.max(floor);
        }
        diagonal
    }

    /// The rates of a group of `K` unknowns; `K` = 0: of any number, known at run time only.
    #[inline(always)]
    fn multiply_sized_jacobian<const K: usize>(
        &self,
        group: &Group,
        terms: &Terms<T>,
        x: &[T],
        rates: &mut [T],
    ) {
        let slots = &group.slots.of(&self.slots)[..group.n_unknown as usize];
        let rates = group.rows.of_mut(rates);
        let width = group.width as usize;
        let jacobian = &terms.jacobian[group.jacobian as usize..][..width * rates.len()];
        if K == 0 {
            for (rate, g) in rates.iter_mut().zip(jacobian.chunks_exact(width.max(1))) {
                let terms = slots.iter().zip(g.chunks_exact(D));
                *rate = terms.fold(T::ZERO, |sum, (&slot, g)| {
                    (0..D).fold(sum, |sum, i| sum + g[i] * x[slot as usize + i])
                });
            }
            return;
        }
        let mut local = [T::ZERO; K];
        for (to, &slot) in local.chunks_exact_mut(D).zip(slots) {
            to.copy_from_slice(&x[slot as usize..slot as usize + D]);
        }
        for (rate, g) in rates.iter_mut().zip(jacobian.chunks_exact(width.max(1))) {
            let g = &g[..K];
            *rate = (0..K).fold(T::ZERO, |sum, i| sum + g[i] * local[i]);
        }
    }

    /// The block of a group of `K` unknowns; `K` = 0: of any number, known at run time only.
    #[inline(always)]
    fn write_sized_block<const K: usize>(
        &self,
        terms: &Terms<T>,
        tangent: &Tangent<'_, T>,
        group: &Group,
        block: &mut [T],
    ) {
        let k = if K == 0 { group.clique.len() } else { K };
        let block = &mut block[..k * (k + 1) / 2];
        if group.block.is_empty() {
            block.fill(T::ZERO);
        } else {
            block.copy_from_slice(&group.block.of(&self.blocks)[..k * (k + 1) / 2]);
        }
        let width = group.width as usize;
        let mut jacobian = &terms.jacobian[group.jacobian as usize..];
        let mut penalty = group.rows.of(tangent.penalty);
        while let [w1, w2, w3, rest @ ..] = penalty {
            let g = [jacobian, &jacobian[width..], &jacobian[2 * width..]];
            add_squares(block, k, g, [*w1, *w2, *w3]);
            (jacobian, penalty) = (&jacobian[3 * width..], rest);
        }
        for &w in penalty {
            add_squares(block, k, [jacobian], [w]);
            jacobian = &jacobian[width..];
        }
        if !group.measures.is_empty() {
            for measure in group.measures.of(&terms.measures) {
                let stiffness = measure.stiffness - measure.transverse;
                let w = tangent.stiffness * stiffness + tangent.damping * measure.damping;
                add_squares(block, k, [jacobian], [w]);
                jacobian = &jacobian[width..];
            }
            self.add_transverse(terms, tangent, group, block);
        }
        if let Some(lambda) = tangent.geometric {
            self.add_geometric(lambda, group, block);
        }
    }

    /// The residual of a group of `K` unknowns; `K` = 0: of any number, known at run time only.
    #[inline(always)]
    fn write_sized_residual<const K: usize>(
        &self,
        terms: &Terms<T>,
        load: &Load<'_, T>,
        group: &Group,
        residual: &mut [T],
    ) {
        let clique = group.clique.of(&self.cliques);
        let k = if K == 0 { clique.len() } else { K };
        let (clique, residual) = (&clique[..k], &mut residual[..k]);
        residual.fill(T::ZERO);
        if let (Some(x), false) = (load.mass, group.mass.is_empty()) {
            add_mass_product::<T, D>(group.mass.of(&self.mass), clique, x, residual);
        }
        let width = group.width as usize;
        let mut jacobian = &terms.jacobian[group.jacobian as usize..];
        if let Some(mu) = load.multipliers {
            let mut mu = group.rows.of(mu);
            while let [m1, m2, m3, rest @ ..] = mu {
                let g = [jacobian, &jacobian[width..], &jacobian[2 * width..]];
                add_multiples(residual, g, [*m1, *m2, *m3]);
                (jacobian, mu) = (&jacobian[3 * width..], rest);
            }
            for &m in mu {
                add_multiples(residual, [jacobian], [m]);
                jacobian = &jacobian[width..];
            }
        } else {
            jacobian = &jacobian[width * group.rows.len()..];
        }
        if load.force == T::ZERO {
            return;
        }
        for measure in group.measures.of(&terms.measures) {
            add_multiples(residual, [jacobian], [measure.tension * load.force]);
            jacobian = &jacobian[width..];
        }
        for (r, &f) in residual.iter_mut().zip(group.force.of(&terms.force)) {
            *r -= f * load.force;
        }
    }

    #[cold]
    fn add_transverse(
        &self,
        terms: &Terms<T>,
        tangent: &Tangent<'_, T>,
        group: &Group,
        block: &mut [T],
    ) {
        for m in group.measures.range() {
            let (Gauge::Length { x }, t) = (self.measures[m].gauge, terms.measures[m].transverse)
            else {
                continue;
            };
            if t > T::ZERO {
                self.add_pairs(
                    (x.of(&self.pool), x.of(&self.pool)),
                    t * tangent.stiffness * T::HALF,
                    group,
                    block,
                );
            }
        }
    }

    /// K_geo = sum lambda_k d2 phi_k / dq2.
    fn add_geometric(&self, lambda: &[T], group: &Group, block: &mut [T]) {
        let k = group.clique.len();
        for row in &self.distances[group.distances.range()] {
            let s = lambda[row.row as usize] * row.inverse * T::HALF;
            let base = group.jacobian + (row.row - group.rows.start) * group.width;
            let ends = [
                ((row.places[0] - base) as usize, crate::algebra::Coef::real(-T::ONE)),
                ((row.places[1] - base) as usize, crate::algebra::Coef::one()),
            ];
            for i in ends {
                for j in ends {
                    add_curvature::<T, D>(block, k, i, j, s);
                }
            }
        }
        for row in &self.dots[group.dots.range()] {
            let s = lambda[row.row as usize] * row.scale;
            self.add_pairs((row.x.of(&self.pool), row.y.of(&self.pool)), s, group, block);
        }
    }

    fn add_pairs(
        &self,
        (x, y): (&[crate::elements::Term<T>], &[crate::elements::Term<T>]),
        s: T,
        group: &Group,
        block: &mut [T],
    ) {
        let k = group.clique.len();
        for i in x {
            for j in y {
                let (pi, pj) = (i.column as usize, j.column as usize);
                add_curvature::<T, D>(block, k, (pi, i.coef), (pj, j.coef), s);
            }
        }
    }

    fn point_force(
        &self,
        force: &super::forces::PointForce,
        q: &[T],
        value: [T; 3],
    ) -> Vector<T, D> {
        match force.frame {
            None => Vector::from_fn(|i, _| value[i]),
            Some(frame) => {
                let mut f = Vector::<T, D>::zeros();
                for i in 0..D {
                    f += combine::<T, D>(frame[i].of(&self.pool), q) * value[i];
                }
                f
            }
        }
    }

    /// Share of one body direction u in the power of a torque: 1/2 (tau x u).u'.
    fn torque_power(
        &self,
        torque: &super::forces::BodyTorque,
        span: crate::elements::Span,
        _direction: usize,
        (q, v): (&[T], &[T]),
        terms: &Terms<T>,
    ) -> T {
        let tau = Vector::<T, 3>::from(terms.courses[torque.course as usize]);
        let lift =
            |x: Vector<T, D>| Vector::<T, 3>::from_fn(|i, _| if i < D { x[i] } else { T::ZERO });
        let u = lift(combine::<T, D>(span.of(&self.pool), q));
        let w = lift(combine::<T, D>(span.of(&self.pool), v));
        crate::algebra::cross(&tau, &u).dot(&w) * T::HALF
    }
}

/// A model's number of unknowns, rows and elements, for reports.
pub fn sizes<T: Real>(model: &impl Model<T>) -> (usize, usize, usize) {
    (model.n_unknowns(), model.n_constraints(), model.n_elements())
}

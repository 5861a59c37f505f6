//! Evaluation of a [`NaturalModel`] by a thread team, part by part, and a model together with its team.

use super::element_ranges::Out;
use super::forces::{add_terms, add_torque};
use super::group::Group;
use super::model::NaturalModel;
use crate::Real;
use crate::algebra::Vector;
use crate::blocks::Cliques;
use crate::elements::{CoupledForm, Span, combine};
use crate::model::{Model, Terms};
use crate::team::{Team, sum};

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Combines this model with a thread team. The team evaluates the model and works on the vectors of a step. Results are bitwise
    /// equal for every team.
    pub fn with_team<'a, W: Team>(&'a self, team: &'a W) -> Threaded<'a, T, D, W> {
        Threaded { model: self, team }
    }

    pub(super) fn evaluate_on<W: Team>(&self, team: &W, q: &[T], terms: &mut Terms<T>) {
        let Terms { phi, jacobian, guides, angles, .. } = terms;
        let (guides, angles) = (&guides[..], &angles[..]);
        let out = Out { rows: phi, jacobian, ..Out::default() };
        self.on_parts(team, out, |part, Out { rows: phi, jacobian, .. }| {
            for row in part.distances(&self.distances) {
                part.distance(row).evaluate::<D>(q, phi, jacobian);
            }
            for row in part.dots(&self.dots) {
                part.dot(row).evaluate::<D>(&self.pool, q, phi, jacobian);
            }
            for row in part.linears(&self.linears) {
                part.linear(row).evaluate::<T, D>(&self.pool, q, phi);
            }
            for row in part.guided(&self.guided) {
                part.guide(row).evaluate::<T, D>(&self.pool, q, guides, (phi, jacobian));
            }
            for row in part.coupled(&self.coupled) {
                let [sum, ..] = Self::sum_of(row.guide, guides);
                let (row, out) = (part.coupling(row), (&mut phi[..], &mut jacobian[..]));
                if let CoupledForm::Relation(number) = row.form {
                    let at = |x: Span| combine::<T, D>(x.of(&self.pool), q);
                    let related = (&self.coupled_tables(), &self.codes().relation(number));
                    row.evaluate_relation(related, at, (angles, sum), out);
                    continue;
                }
                row.evaluate::<D>(&self.coupled_tables(), (q, angles), sum, out);
            }
            for row in part.rollings(&self.rollings) {
                part.rolling(row).evaluate::<D>(&self.pool, q, (phi, jacobian));
            }
        });
    }

    pub(super) fn advance_on<W: Team>(
        &self,
        team: &W,
        (q, dq): (&[T], &[T]),
        phi_n: &[T],
        terms: &mut Terms<T>,
    ) {
        let Terms { phi, jacobian, guides, angles, .. } = terms;
        let (guides, angles) = (&guides[..], &angles[..]);
        let out = Out { rows: phi, jacobian, ..Out::default() };
        self.on_parts(team, out, |part, Out { rows: phi, jacobian, .. }| {
            let phi_n = &phi_n[part.rows()];
            for row in part.distances(&self.distances) {
                part.distance(row).advance::<D>((q, dq), phi_n, phi, jacobian);
            }
            for row in part.dots(&self.dots) {
                part.dot(row).advance::<D>(&self.pool, (q, dq), phi_n, (phi, jacobian));
            }
            for row in part.linears(&self.linears) {
                part.linear(row).advance::<T, D>(&self.pool, dq, phi_n, phi);
            }
            for row in part.guided(&self.guided) {
                let out = (&mut phi[..], &mut jacobian[..]);
                part.guide(row).evaluate_at_sum::<T, D>(&self.pool, (q, dq), guides, out);
            }
            for row in part.coupled(&self.coupled) {
                let [sum, ..] = Self::sum_of(row.guide, guides);
                let (from, out) = ((q, dq, angles), (&mut phi[..], &mut jacobian[..]));
                let row = part.coupling(row);
                if let CoupledForm::Relation(number) = row.form {
                    let of = |x: Span, q: &[T]| combine::<T, D>(x.of(&self.pool), q);
                    let related = (&self.coupled_tables(), &self.codes().relation(number));
                    row.evaluate_relation(related, |x| of(x, q) + of(x, dq), (angles, sum), out);
                    continue;
                }
                row.advance::<D>(&self.coupled_tables(), from, (phi_n, sum), out);
            }
            for row in part.rollings(&self.rollings) {
                let out = (&mut phi[..], &mut jacobian[..]);
                part.rolling(row).advance::<D>(&self.pool, (q, dq), out);
            }
        });
    }

    pub(super) fn evaluate_forces_on<W: Team>(
        &self,
        team: &W,
        (q, v): (&[T], &[T]),
        terms: &mut Terms<T>,
    ) {
        self.follow_motion((q, v), terms);
        let Terms { jacobian, force, measures, courses, angles, .. } = terms;
        let (courses, angles) = (&courses[..], &angles[..]);
        let (measures, body_measures) = measures.split_at_mut(self.measures.len());
        let out = Out { jacobian, force, measures, body_measures, ..Out::default() };
        self.on_parts(team, out, |part, out| {
            let (law_inputs, tables) = (self.tables.law_inputs(courses), self.coupled_tables());
            let Out { jacobian, force, measures, body_measures, .. } = out;
            for (element, measure) in part.measures(&self.measures).iter().zip(measures) {
                let mut element = *element;
                element.place = part.place(element.place);
                let before = *measure;
                *measure = element.evaluate::<D>(&tables, (q, v, angles), &law_inputs, jacobian);
                element.law.look_back(measure, &before, &law_inputs);
            }
            for element in part.body_elements(&self.body_elements) {
                let mut element = *element;
                element.place = part.place(element.place);
                element.measures = part.body_measures(element.measures);
                let out = (&mut jacobian[..], &mut body_measures[..]);
                element.evaluate::<D>(&self.pool, (q, v), &law_inputs, out);
            }
            for effect in part.point_forces(&self.point_forces) {
                let value = self.point_force(effect, q, courses[effect.course as usize]);
                let local = part.force(effect.force).of_mut(force);
                local.fill(T::ZERO);
                add_terms(effect.point.of(&self.pool), &value, local);
            }
            for torque in part.torques(&self.torques) {
                let local = part.force(torque.force).of_mut(force);
                local.fill(T::ZERO);
                let tau = courses[torque.course as usize];
                add_torque::<T, D>(&self.pool, &torque.frame, tau, q, local);
            }
        });
    }

    pub(super) fn evaluate_bias_on<W: Team>(
        &self,
        team: &W,
        (q, v): (&[T], &[T]),
        terms: &mut Terms<T>,
    ) {
        let Terms { phi_bias, guides, angles, .. } = terms;
        let (guides, angles) = (&guides[..], &angles[..]);
        let out = Out { rows: phi_bias, ..Out::default() };
        self.on_parts(team, out, |part, Out { rows: bias, .. }| {
            let first = part.from.row;
            for row in part.distances(&self.distances) {
                bias[row.row as usize - first] = row.bias::<D>(v);
            }
            for row in part.dots(&self.dots) {
                bias[row.row as usize - first] = row.bias::<D>(&self.pool, v);
            }
            for row in part.guided(&self.guided) {
                bias[row.row as usize - first] = row.bias::<T, D>(&self.pool, (q, v), guides);
            }
            for row in part.coupled(&self.coupled) {
                let (sum, at) = (Self::sum_of(row.guide, guides), row.row as usize - first);
                let (tables, here) = (self.coupled_tables(), (q, v, angles));
                bias[at] = match row.form {
                    CoupledForm::Relation(number) => {
                        let related = (&tables, &self.codes().relation(number));
                        row.relation_bias::<D>(related, here, sum)
                    }
                    _ => row.bias::<D>(&tables, here, sum),
                };
            }
            for row in part.rollings(&self.rollings) {
                row.bias::<D>(&self.pool, (q, v), &mut bias[row.row as usize - first..]);
            }
        });
    }

    pub(super) fn multiply_jacobian_on<W: Team>(
        &self,
        team: &W,
        terms: &Terms<T>,
        x: &[T],
        rates: &mut [T],
    ) {
        if let ([group], true) = (&self.groups[..], self.is_whole) {
            return match group.clique.len() {
                2 => multiply_dense::<T, 2>(group, terms, x, rates),
                4 => multiply_dense::<T, 4>(group, terms, x, rates),
                6 => multiply_dense::<T, 6>(group, terms, x, rates),
                _ => multiply_dense::<T, 8>(group, terms, x, rates),
            };
        }
        let out = Out { rows: rates, ..Out::default() };
        self.on_parts(team, out, |part, Out { rows: rates, .. }| {
            self.incidence.multiply::<T, D>((&terms.jacobian, x), part.from.row, rates);
        });
    }

    pub(super) fn kinetic_energy_on<W: Team>(&self, team: &W, v: &[T]) -> T {
        let twice = self.sum_of_parts(team, |part| {
            let groups = part.groups(&self.groups).iter().filter(|group| !group.mass.is_empty());
            groups.fold(T::ZERO, |twice, group| {
                twice
                    + match group.clique.len() {
                        4 => self.twice_kinetic_energy::<4>(group, v),
                        6 => self.twice_kinetic_energy::<6>(group, v),
                        8 => self.twice_kinetic_energy::<8>(group, v),
                        12 => self.twice_kinetic_energy::<12>(group, v),
                        _ => self.twice_kinetic_energy::<0>(group, v),
                    }
            })
        });
        twice * T::HALF
    }

    /// Twice the kinetic energy, v^T M v, of a group of `K` unknowns with mass. With `K` = 0 the number is known at run time only.
    fn twice_kinetic_energy<const K: usize>(&self, group: &Group, v: &[T]) -> T {
        let (g, clique) = (group.mass.of(&self.mass), group.clique.of(&self.cliques));
        let k = if K == 0 { clique.len() } else { K };
        let (nb, clique) = (k / D, &clique[..k]);
        let g = &g[..nb * nb];
        let mut twice = T::ZERO;
        for i in 0..nb {
            let mut sum = Vector::<T, D>::zeros();
            for j in 0..nb {
                sum += g[i * nb + j].apply(&crate::algebra::load::<T, D>(v, clique[j * D]));
            }
            twice += sum.dot(&crate::algebra::load::<T, D>(v, clique[i * D]));
        }
        twice
    }

    pub(super) fn potential_energy_on<W: Team>(&self, team: &W, q: &[T], terms: &Terms<T>) -> T {
        let weight = &self.weight;
        let n = weight.len().min(q.len());
        let mut energy = -sum(team, n, |from, to| {
            let pairs = weight[from..to].iter().zip(&q[from..to]);
            pairs.fold(T::ZERO, |sum, (&w, &x)| sum + w * x)
        });
        let law_inputs = self.tables.law_inputs(&terms.courses);
        for (element, measure) in self.measures.iter().zip(&terms.measures) {
            energy += element.energy(measure, &law_inputs);
        }
        for element in &self.body_elements {
            energy += element.energy(&terms.measures);
        }
        energy
    }
}

/// Computes rates = J x of a group that has all `K` unknowns in their order. Products are added in sequence: with two parallel
/// sums, the energy of `two-four-bars` drifts 1.5 times as much in ten million steps of 1e-6 s.
#[inline(always)]
fn multiply_dense<T: Real, const K: usize>(
    group: &Group,
    terms: &Terms<T>,
    x: &[T],
    rates: &mut [T],
) {
    let (width, x) = (group.width as usize, &x[..K]);
    let mut rows = &terms.jacobian[group.jacobian as usize..];
    for rate in rates {
        let g = &rows[..K];
        let mut sum = T::ZERO;
        for i in 0..K {
            sum += g[i] * x[i];
        }
        *rate = sum;
        rows = &rows[width..];
    }
}

/// A natural-coordinate model with its team: [`NaturalModel::with_team`].
#[derive(Debug)]
pub struct Threaded<'a, T: Real, const D: usize, W> {
    model: &'a NaturalModel<T, D>,
    team: &'a W,
}

impl<T: Real, const D: usize, W: Team> Cliques for Threaded<'_, T, D, W> {
    crate::delegate_cliques!(model);
}

impl<T: Real, const D: usize, W: Team> Model<T> for Threaded<'_, T, D, W> {
    crate::delegate_model!(T, model);
    fn team(&self) -> &impl Team {
        self.team
    }
    fn evaluate(&self, q: &[T], terms: &mut Terms<T>) {
        self.model.evaluate_on(self.team, q, terms);
    }
    fn advance(&self, q: &[T], dq: &[T], phi_n: &[T], terms: &mut Terms<T>) {
        self.model.advance_on(self.team, (q, dq), phi_n, terms);
    }
    fn evaluate_forces(&self, q: &[T], v: &[T], terms: &mut Terms<T>) {
        self.model.evaluate_forces_on(self.team, (q, v), terms);
    }
    fn evaluate_bias(&self, q: &[T], v: &[T], terms: &mut Terms<T>) {
        self.model.evaluate_bias_on(self.team, (q, v), terms);
    }
    fn multiply_jacobian(&self, terms: &Terms<T>, x: &[T], rates: &mut [T]) {
        self.model.multiply_jacobian_on(self.team, terms, x, rates);
    }
    fn kinetic_energy(&self, v: &[T]) -> T {
        self.model.kinetic_energy_on(self.team, v)
    }
    fn potential_energy(&self, q: &[T], terms: &Terms<T>) -> T {
        self.model.potential_energy_on(self.team, q, terms)
    }
}

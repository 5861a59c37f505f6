//! Arithmetic of one element: its block, residual and rates, with a number of unknowns that the compiler knows, and the curvature
//! parts of its tangent.

use super::coordinate_sets::add_rows;
use super::forces::Measure;
use super::group::{
    Group, add_curvature, add_mass_product, add_multiples, add_squares, write_square,
};
use super::model::NaturalModel;
use crate::Real;
use crate::algebra::{Vector, cross, raised};
use crate::elements::combine;
use crate::model::{Load, ScalarForce, Tangent, Terms};
use alloc::vec;

/// Largest number of unknowns of a group with dense rows, and of a mechanism whose bodies and joints form one element [-]. The work
/// of a dense row grows like the square of this number. At eight it equals the work of separate parts with two and four unknowns.
pub(super) const DENSE: usize = 8;

/// Largest number of unknowns of a group whose residual fits on the stack [-]: that of an effect between two bodies.
pub(super) const ROOM: usize = 24;

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Diagonal of the mass matrix M. Entries below `floor` times the largest entry are raised to it, so that the diagonal can
    /// scale rows. Entries of points and of directions are compared after scaling with the scene's length.
    pub(crate) fn mass_diagonal(&self, floor: T) -> alloc::vec::Vec<T> {
        let mut diagonal = vec![T::ZERO; self.n_unknowns];
        for group in self.groups.iter().filter(|g| !g.mass.is_empty()) {
            let g = group.mass.of(&self.mass);
            let nb = group.n_unknown as usize;
            for (j, &u) in group.clique.of(&self.cliques).iter().enumerate() {
                diagonal[u as usize] += g[(j / D) * (nb + 1)].re;
            }
        }
        let sizes = self.sizes();
        let largest = sizes.iter().zip(&diagonal).fold(T::ZERO, |a, (&s, &d)| a.max(d * s * s));
        let least = if largest > T::ZERO { largest * floor } else { T::ONE };
        for (d, s) in diagonal.iter_mut().zip(sizes) {
            *d = d.max(least / (s * s));
        }
        diagonal
    }

    /// Writes the block of a group of `K` unknowns. With `K` = 0 the number is known at run time only.
    #[inline(always)]
    pub(super) fn write_sized_block<const K: usize>(
        &self,
        terms: &Terms<T>,
        tangent: &Tangent<'_, T>,
        group: &Group,
        block: &mut [T],
    ) {
        let k = if K == 0 { group.clique.len() } else { K };
        let block = &mut block[..k * (k + 1) / 2];
        if group.block.is_empty() && group.rows.is_empty() {
            return self.write_effect_block(terms, tangent, group, (block, k));
        }
        if group.block.is_empty() {
            block.fill(T::ZERO);
        } else {
            block.copy_from_slice(&group.block.of(&self.blocks)[..k * (k + 1) / 2]);
        }
        let width = group.width as usize;
        let mut jacobian = &terms.jacobian[group.jacobian as usize..];
        if tangent.penalty.is_empty() {
            jacobian = &jacobian[width * group.rows.len()..];
        } else {
            let penalty = group.rows.of(tangent.penalty);
            // Every row uses all entities of a group of two. In a small group, adding zeros costs no more than skipping them.
            let is_small = K > 0 && K <= DENSE;
            let reach = if is_small { &[][..] } else { group.rows.of(&self.coordinate_sets) };
            add_rows::<T, D>(block, k, (jacobian, width), (penalty, reach));
            jacobian = &jacobian[width * penalty.len()..];
        }
        if !group.measures.is_empty() {
            let laws = group.measures.of(&terms.measures);
            add_laws(tangent, (block, k), laws, (jacobian, width));
            self.add_transverse(terms, tangent, group, block);
        }
        if let Some(lambda) = tangent.geometric {
            self.add_geometric(lambda, group, block);
        }
    }

    /// Writes the block of an effect with `k` unknowns, without mass and rows. The first product g g^T is written, and the others
    /// are added.
    #[inline(always)]
    fn write_effect_block(
        &self,
        terms: &Terms<T>,
        tangent: &Tangent<'_, T>,
        group: &Group,
        (block, k): (&mut [T], usize),
    ) {
        let (gradients, width) = (&terms.jacobian[group.jacobian as usize..], group.width as usize);
        let [first, others @ ..] = group.measures.of(&terms.measures) else {
            return block.fill(T::ZERO);
        };
        write_square(block, k, gradients, tangent.weight(first));
        add_laws(tangent, (block, k), others, (&gradients[width..], width));
        self.add_transverse(terms, tangent, group, block);
    }

    /// Writes the residual of a group of `K` unknowns. With `K` = 0 the number is known at run time only.
    #[inline(always)]
    pub(super) fn write_sized_residual<const K: usize>(
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
            let g = group.mass.of(&self.mass);
            if D == 2 && group.is_mass_turned {
                add_mass_product::<T, D>((g, true), clique, x, residual);
            } else {
                add_mass_product::<T, D>((g, false), clique, x, residual);
            }
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

    /// Adds the residual of a group of `K` unknowns to `f`. With `K` = 0 the number is known at run time only, at most [`ROOM`].
    #[inline(always)]
    pub(super) fn add_sized_residual<const K: usize>(
        &self,
        terms: &Terms<T>,
        load: &Load<'_, T>,
        group: &Group,
        f: &mut [T],
    ) {
        if K == 0 {
            let mut room = [T::ZERO; ROOM];
            let residual = &mut room[..group.clique.len()];
            self.write_sized_residual::<0>(terms, load, group, residual);
            return self.scatter(group, residual, f);
        }
        self.scatter(group, &self.sized_residual::<K>(terms, load, group), f);
    }

    /// Writes the residual of the only group, which has all `K` unknowns, to f. A separate function, because inlined code in the
    /// loop over groups costs more than the arithmetic of one small group.
    #[inline(never)]
    pub(super) fn write_whole_residual<const K: usize>(
        &self,
        terms: &Terms<T>,
        load: &Load<'_, T>,
        group: &Group,
        f: &mut [T],
    ) {
        f[..K].copy_from_slice(&self.sized_residual::<K>(terms, load, group));
    }

    /// The residual of a group of `K` unknowns.
    #[inline(always)]
    fn sized_residual<const K: usize>(
        &self,
        terms: &Terms<T>,
        load: &Load<'_, T>,
        group: &Group,
    ) -> [T; K] {
        let mut residual = [T::ZERO; K];
        if let (None, Some(mu), true) = (load.mass, load.multipliers, load.force == T::ZERO) {
            // J^T mu alone, row by row; mu: the multipliers
            let width = group.width as usize;
            let mut rows = &terms.jacobian[group.jacobian as usize..];
            for &mu in group.rows.of(mu) {
                let g = &rows[..K];
                for i in 0..K {
                    residual[i] += g[i] * mu;
                }
                rows = &rows[width..];
            }
        } else {
            self.write_sized_residual::<K>(terms, load, group, &mut residual);
        }
        residual
    }

    /// Adds the residual of a group to f.
    #[inline(always)]
    fn scatter(&self, group: &Group, residual: &[T], f: &mut [T]) {
        let slots = &group.slots.of(&self.slots)[..residual.len() / D];
        for (&slot, r) in slots.iter().zip(residual.chunks_exact(D)) {
            let f = &mut f[slot as usize..][..D];
            for i in 0..D {
                f[i] += r[i];
            }
        }
    }

    #[cold]
    pub(super) fn add_transverse(
        &self,
        terms: &Terms<T>,
        tangent: &Tangent<'_, T>,
        group: &Group,
        block: &mut [T],
    ) {
        if group.has_body_law {
            return;
        }
        for m in group.measures.range() {
            let (Measure::Length { x }, t) = (self.measures[m].gauge, terms.measures[m].transverse)
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

    /// Adds the geometric stiffness of a group, K_geo = sum lambda_k d2 phi_k / dq2, to its block.
    pub(super) fn add_geometric(&self, lambda: &[T], group: &Group, block: &mut [T]) {
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

    /// Adds K_geo of the guided rows, with the guide values in `terms`. The tangent of a step leaves this part out.
    pub(crate) fn add_guided_curvature(
        &self,
        terms: &Terms<T>,
        lambda: &[T],
        element: usize,
        block: &mut [T],
    ) {
        let group = &self.groups[element];
        for row in self.guided.iter().filter(|row| group.rows.range().contains(&(row.row as usize)))
        {
            let s = lambda[row.row as usize];
            row.each_pair(&terms.guides, |x, y, factor| {
                let (x, y) = (x.of(&self.pool), y.of(&self.pool));
                self.add_pairs((x, y), s * factor, group, block);
            });
        }
    }

    pub(super) fn add_pairs(
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

    pub(super) fn point_force(
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

    /// Part of one body direction u in the power of a torque: 1/2 (tau x u).u'.
    pub(super) fn torque_power(
        &self,
        torque: &super::forces::BodyTorque,
        span: crate::elements::Span,
        (q, v): (&[T], &[T]),
        terms: &Terms<T>,
    ) -> T {
        let tau = Vector::<T, 3>::from(terms.courses[torque.course as usize]);
        let u = raised(&combine::<T, D>(span.of(&self.pool), q));
        let w = raised(&combine::<T, D>(span.of(&self.pool), v));
        cross(&tau, &u).dot(&w) * T::HALF
    }
}

/// Adds sum w g g^T over scalar laws to a block of `k` unknowns. The gradients g are `width` long.
#[inline(always)]
fn add_laws<T: Real>(
    tangent: &Tangent<'_, T>,
    (block, k): (&mut [T], usize),
    laws: &[ScalarForce<T>],
    (mut gradients, width): (&[T], usize),
) {
    for law in laws {
        add_squares(block, k, [gradients], [tangent.weight(law)]);
        gradients = &gradients[width..];
    }
}

//! Start problem as a sum of elements: the elements of the model, a row for each prescribed coordinate, and a small mass for each unknown.
//!
//! ```text
//! W = M + E + C + J^T S J,   S = P m_k for each row, of the model or of a prescribed coordinate
//! f = M (x - x*) + J^T mu
//! ```
//!
//! M is the mass matrix, S the penalties of the rows, P the penalty factor, m_k the effective mass of a row, mu the multipliers. C is the
//! curvature of the rows where it is used, and E a small mass. E and the damping of an iteration are in the matrix only. They make it
//! regular, and do not influence the converged result.

use super::hold::StartRow;
use crate::Real;
use crate::blocks::{BlockSource, Cliques};
use crate::elements::Span;
use crate::model::{Load, Model, Tangent, Terms};
use crate::natural::NaturalModel;
use alloc::vec;
use alloc::vec::Vec;

/// Largest number of sweeps at each level and stage [-].
pub(super) const MAX_SWEEPS: u32 = 60;
/// Factor on all penalties after a slow sweep [-]. In long chains of light links the penalties hardly act on some combinations of rows.
pub(super) const RAISE: f64 = 30.0;
/// Ratio of residuals above which a sweep is slow [-].
pub(super) const SLOW_RATIO: f64 = 0.3;

/// True if the scalar has at least double precision.
pub(super) fn is_fine<T: Real>() -> bool {
    /// Machine precision [-] between that of single precision (1e-7) and that of double precision (2e-16).
    const FINE: f64 = 1e-12;
    T::EPSILON < T::from_f64(FINE)
}

/// Penalty of a start row in effective masses [-]: the middle of the range that the precision allows. A sweep reduces a violation by the
/// factor 1 / penalty, and adds an error of penalty times machine precision.
pub(super) fn penalty<T: Real>() -> T {
    T::from_f64(if is_fine::<T>() { 1e6 } else { 500.0 })
}

/// Smallest mass for the scaling of rows, relative to the largest [-]. The penalties of a light body's rows between heavy bodies are then
/// similar to those of the neighbouring rows.
fn lifted<T: Real>() -> T {
    T::from_f64(if is_fine::<T>() { 1e-4 } else { 1e-2 })
}

/// Mass that is added to the matrix only, relative to the largest [-]: a hundred times the rounding error of the stiffest rows.
fn lent<T: Real>() -> T {
    lifted::<T>() * penalty::<T>() * T::EPSILON * T::from_f64(100.0)
}

/// Structure of a start problem, for which its solver is analysed.
#[derive(Debug)]
pub struct Problem<'a, T: Real, const D: usize> {
    pub(super) model: &'a NaturalModel<T, D>,
    pub(super) holds: Vec<StartRow<T, D>>,
    cliques: Vec<u32>,
    spans: Vec<Span>,
    /// Size of each unknown: the scene's length, or one for directions.
    pub(super) sizes: Vec<T>,
    /// Diagonal of M for the scaling of rows. Smaller entries are raised to the smallest mass for scaling.
    pub(super) mass: Vec<T>,
    lent: Vec<T>,
    pub(super) terms: Terms<T>,
    /// Gradients of the start rows, each over its clique.
    gradients: Vec<T>,
    /// Residuals of the start rows, in values or in rates.
    pub(super) residuals: Vec<T>,
    /// Penalties of the model's rows, then of the start rows.
    pub(super) penalty: Vec<T>,
    /// Penalty of all rows, in effective masses.
    pub(super) alpha: T,
    /// Largest change of each row for changes of the coordinates by their sizes. The order of rows is that of the penalties.
    pub(super) spreads: Vec<T>,
    scratch: Vec<T>,
}

/// Level of the assembly, which determines the start rows that act.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Level {
    Position,
    Velocity,
}

impl<'a, T: Real, const D: usize> Problem<'a, T, D> {
    pub(super) fn new(model: &'a NaturalModel<T, D>, holds: Vec<StartRow<T, D>>) -> Self {
        let n = model.n_unknowns();
        let (mut cliques, mut spans) = (Vec::new(), Vec::new());
        let mut add = |unknowns: &mut dyn Iterator<Item = u32>| {
            let start = crate::natural::index(cliques.len());
            cliques.extend(unknowns);
            spans.push(Span { start, end: crate::natural::index(cliques.len()) });
        };
        for hold in &holds {
            let unknown = hold.entities().into_iter().filter(|&e| (e as usize) < n);
            add(&mut unknown.flat_map(|e| (0..crate::natural::index(D)).map(move |i| e + i)));
        }
        for unknown in 0..n {
            add(&mut core::iter::once(crate::natural::index(unknown)));
        }
        let sizes = model.sizes();
        let mass = model.mass_diagonal(lifted());
        let largest = sizes.iter().zip(&mass).fold(T::ZERO, |a, (&s, &m)| a.max(m * s * s));
        let n_gradient = spans[..holds.len()].iter().map(|s| s.len()).sum();
        let n_rows = model.n_constraints() + holds.len();
        Self {
            model,
            residuals: vec![T::ZERO; holds.len()],
            holds,
            cliques,
            spans,
            lent: sizes.iter().map(|&s| largest * lent() / (s * s)).collect(),
            sizes,
            mass,
            terms: model.terms(),
            gradients: vec![T::ZERO; n_gradient],
            penalty: vec![T::ONE; n_rows],
            alpha: penalty(),
            spreads: vec![T::ONE; n_rows],
            scratch: vec![T::ZERO; model.n_extended()],
        }
    }

    /// Scales all rows at the configuration that was last evaluated.
    pub(super) fn scale_rows(&mut self) {
        let m = self.model.n_constraints();
        self.model.row_masses(&self.mass, &self.terms, &mut self.penalty[..m]);
        self.model.row_spreads(&self.sizes, &self.terms, &mut self.spreads[..m]);
        let mut at = 0;
        for (h, clique) in self.spans[..self.holds.len()].iter().enumerate() {
            let clique = clique.of(&self.cliques);
            let (mut mobility, mut spread) = (T::ZERO, T::ZERO);
            for (&u, &g) in clique.iter().zip(&self.gradients[at..]) {
                mobility += g * g / self.mass[u as usize];
                spread = spread.max(g.abs() * self.sizes[u as usize]);
            }
            self.penalty[m + h] = if mobility > T::ZERO { T::ONE / mobility } else { T::ONE };
            self.spreads[m + h] = if spread > T::ZERO { spread } else { T::ONE };
            at += clique.len();
        }
        for p in &mut self.penalty {
            *p *= self.alpha;
        }
    }

    /// Evaluates model rows and start rows at `q`, except rows that restrict velocities only. Guides must be set in `terms`.
    pub(super) fn evaluate(&mut self, q: &[T], tau: T) {
        self.model.evaluate(q, &mut self.terms);
        self.model.release_slips(&mut self.terms);
        let mut at = 0;
        for (h, hold) in self.holds.iter().enumerate() {
            let clique = self.spans[h].of(&self.cliques);
            self.residuals[h] = hold.evaluate(q, tau, &mut self.scratch);
            for (g, &u) in self.gradients[at..].iter_mut().zip(clique) {
                *g = self.scratch[u as usize];
            }
            // Only the coordinates of this row are cleared, so that the cost does not depend on the size of the model.
            for e in hold.entities() {
                self.scratch[e as usize..e as usize + D].fill(T::ZERO);
            }
            at += clique.len();
        }
    }

    /// Rates of all rows for the velocity `v`: those of the model, then those of the active start rows.
    pub(super) fn multiply(&self, v: &[T], level: Level, rates: &mut [T]) {
        let m = self.model.n_constraints();
        self.model.multiply_jacobian(&self.terms, v, &mut rates[..m]);
        for (h, rate) in rates[m..].iter_mut().enumerate() {
            let products = self.spans[h].of(&self.cliques).iter().zip(self.gradient(h));
            let sum = products.fold(T::ZERO, |sum, (&u, &g)| sum + g * v[u as usize]);
            *rate = if self.acts(h, level) { sum } else { T::ZERO };
        }
    }

    fn gradient(&self, h: usize) -> &[T] {
        // The start rows come first among the cliques, so their gradients are at the same places.
        self.spans[h].of(&self.gradients)
    }

    pub(super) fn acts(&self, h: usize, level: Level) -> bool {
        match level {
            Level::Position => self.holds[h].value.is_some(),
            Level::Velocity => self.holds[h].rate.is_some(),
        }
    }

    /// Raises all penalties after a slow sweep.
    pub(super) fn raise_penalties(&mut self) {
        let factor = T::from_f64(RAISE);
        self.alpha *= factor;
        self.penalty.iter_mut().for_each(|p| *p *= factor);
    }

    /// Resets the penalties to the value for the precision.
    pub(super) fn lower_penalties(&mut self) {
        self.alpha = penalty();
        self.scale_rows();
    }
}

impl<T: Real, const D: usize> Cliques for Problem<'_, T, D> {
    fn n_unknowns(&self) -> usize {
        self.model.n_unknowns()
    }
    fn n_elements(&self) -> usize {
        self.model.n_elements() + self.spans.len()
    }
    fn clique(&self, element: usize) -> &[u32] {
        match element.checked_sub(self.model.n_elements()) {
            None => self.model.clique(element),
            Some(extra) => self.spans[extra].of(&self.cliques),
        }
    }
}

/// Start problem with the vectors of one sweep.
pub(super) struct Sweep<'p, 'a, T: Real, const D: usize> {
    pub(super) problem: &'p Problem<'a, T, D>,
    pub(super) level: Level,
    /// Change x - x* of the unknowns, over all coordinates.
    pub(super) change: &'p [T],
    /// Multipliers of the model's rows, then of the start rows.
    pub(super) multipliers: &'p [T],
    /// Coordinates and multipliers for the curvature of the rows; `None`: the matrix has no curvature.
    pub(super) curvature: Option<(&'p [T], &'p [T])>,
    /// Damping: factor of the masses that are added to the matrix.
    pub(super) damping: T,
}

impl<T: Real, const D: usize> BlockSource<T> for Sweep<'_, '_, T, D> {
    fn write_block(&self, element: usize, block: &mut [T]) {
        let p = self.problem;
        let m = p.model.n_constraints();
        let Some(extra) = element.checked_sub(p.model.n_elements()) else {
            let tangent = Tangent {
                stiffness: T::ZERO,
                damping: T::ZERO,
                penalty: &p.penalty[..m],
                geometric: self.curvature.map(|(_, sigma)| &sigma[..m]),
            };
            p.model.write_block(&p.terms, &tangent, element, block);
            if let Some((q, sigma)) = self.curvature {
                p.model.add_guided_curvature(&p.terms, &sigma[..m], element, block);
                p.model.add_coupled_curvature((q, &p.terms), &sigma[..m], element, block);
            }
            return;
        };
        block.fill(T::ZERO);
        if let Some(u) = extra.checked_sub(p.holds.len()) {
            block[0] = p.lent[u] + self.damping * p.mass[u];
        } else if p.acts(extra, self.level) {
            let g = p.gradient(extra);
            crate::natural::add_squares(block, g.len(), [g], [p.penalty[m + extra]]);
            if let Some((q, sigma)) = self.curvature {
                let clique = p.spans[extra].of(&p.cliques);
                p.holds[extra].add_curvature(q, sigma[m + extra], clique, block);
            }
        }
    }

    fn write_residual(&self, element: usize, residual: &mut [T]) {
        let p = self.problem;
        let m = p.model.n_constraints();
        let Some(extra) = element.checked_sub(p.model.n_elements()) else {
            let (mass, multipliers) = (Some(self.change), Some(&self.multipliers[..m]));
            let load = Load { mass, multipliers, force: T::ZERO };
            p.model.write_residual(&p.terms, &load, element, residual);
            return;
        };
        residual.fill(T::ZERO);
        if extra < p.holds.len() && p.acts(extra, self.level) {
            let mu = self.multipliers[m + extra];
            for (r, &g) in residual.iter_mut().zip(p.gradient(extra)) {
                *r = g * mu;
            }
        }
    }
}

/// Number of times that penalties may be raised [-]. In double precision they reach 1e9 effective masses, in single precision 15,000.
pub(super) fn raises<T: Real>() -> u32 {
    if T::EPSILON < T::from_f64(1e-12) { 2 } else { 1 }
}

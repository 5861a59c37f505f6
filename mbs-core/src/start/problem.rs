//! The start problem as a sum of elements: those of the model, one row for each held coordinate, and a little mass where
//! there is none.

use super::hold::Hold;
use crate::Real;
use crate::blocks::{BlockSource, Cliques};
use crate::elements::Span;
use crate::model::{Load, Model, Tangent, Terms};
use crate::natural::NaturalModel;
use alloc::vec;
use alloc::vec::Vec;

/// Penalty of a start row in effective masses: the middle of the range that works in double precision.
const PENALTY: f64 = 1e6;
/// Mass lent to massless coordinates, relative to the largest: it only picks one of many equally small changes.
const LENT: f64 = 1e-6;

/// The structure of a start problem: what a solver is analysed for.
#[derive(Debug)]
pub struct Problem<'a, T: Real, const D: usize> {
    pub(super) model: &'a NaturalModel<T, D>,
    pub(super) holds: Vec<Hold<T, D>>,
    cliques: Vec<u32>,
    spans: Vec<Span>,
    /// Unknowns that get a lent mass, and that mass.
    lent: Vec<u32>,
    lent_mass: T,
    pub(super) terms: Terms<T>,
    /// Gradients of the holds, each over its clique.
    gradients: Vec<T>,
    /// Residuals of the holds, of values or of rates.
    pub(super) residuals: Vec<T>,
    /// Penalties of the model's rows, then of the holds.
    pub(super) penalty: Vec<T>,
    hold_mass: T,
    scratch: Vec<T>,
}

/// Which level is being made consistent: it says which holds act.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Level {
    Position,
    Velocity,
}

impl<'a, T: Real, const D: usize> Problem<'a, T, D> {
    pub(super) fn new(model: &'a NaturalModel<T, D>, holds: Vec<Hold<T, D>>) -> Self {
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
        let diagonal = model.mass_diagonal();
        let largest = diagonal.iter().fold(T::ZERO, |a, &b| a.max(b));
        let small = largest * T::from_f64(LENT * 1.001);
        let lent: Vec<u32> =
            (0..n).filter(|&u| diagonal[u] <= small).map(crate::natural::index).collect();
        for &unknown in &lent {
            add(&mut core::iter::once(unknown));
        }
        let typical = diagonal.iter().fold(T::ZERO, |a, &b| a + b) / T::from_f64(n.max(1) as f64);
        let n_gradient = spans[..holds.len()].iter().map(|s| s.len()).sum();
        Self {
            model,
            residuals: vec![T::ZERO; holds.len()],
            holds,
            cliques,
            spans,
            lent,
            lent_mass: largest * T::from_f64(LENT),
            terms: model.terms(),
            gradients: vec![T::ZERO; n_gradient],
            penalty: vec![T::ONE; model.n_constraints()],
            hold_mass: typical * T::from_f64(PENALTY),
            scratch: vec![T::ZERO; model.n_extended()],
        }
    }

    /// Scales the penalties of the model's rows at the configuration last evaluated.
    pub(super) fn scale_penalties(&mut self) {
        self.model.effective_masses(&self.terms, &mut self.penalty);
        for p in &mut self.penalty {
            *p *= T::from_f64(PENALTY);
        }
    }

    /// Evaluates rows and holds at `q`; guides must have been set in `terms`.
    pub(super) fn evaluate(&mut self, q: &[T], tau: T) {
        self.model.evaluate(q, &mut self.terms);
        let mut at = 0;
        for (h, hold) in self.holds.iter().enumerate() {
            let clique = self.spans[h].of(&self.cliques);
            self.residuals[h] = hold.evaluate(q, tau, &mut self.scratch);
            for (g, &u) in self.gradients[at..].iter_mut().zip(clique) {
                *g = self.scratch[u as usize];
            }
            // Only the touched entities are cleared, so that a large model pays for its holds alone.
            for e in hold.entities() {
                self.scratch[e as usize..e as usize + D].fill(T::ZERO);
            }
            at += clique.len();
        }
    }

    /// Residuals of the holds at velocity `v`: gradient times v less the held rate.
    pub(super) fn hold_rates(&mut self, v: &[T]) {
        let mut at = 0;
        for (h, hold) in self.holds.iter().enumerate() {
            let clique = self.spans[h].of(&self.cliques);
            let rate = clique
                .iter()
                .zip(&self.gradients[at..])
                .fold(T::ZERO, |sum, (&u, &g)| sum + g * v[u as usize]);
            self.residuals[h] = hold.rate.map_or(T::ZERO, |wanted| rate - wanted);
            at += clique.len();
        }
    }

    fn gradient(&self, h: usize) -> &[T] {
        // Holds come first among the cliques, so that the gradients stand at the same places.
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
        let factor = T::from_f64(super::assemble::RAISE);
        self.penalty.iter_mut().for_each(|p| *p *= factor);
        self.hold_mass *= factor;
    }

    pub(super) fn hold_penalty(&self) -> T {
        self.hold_mass
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

/// A start problem with the vectors of one sweep.
pub(super) struct Sweep<'p, 'a, T: Real, const D: usize> {
    pub(super) problem: &'p Problem<'a, T, D>,
    pub(super) level: Level,
    /// x - x*.
    pub(super) change: &'p [T],
    /// Multipliers of the model's rows, then of the holds.
    pub(super) multipliers: &'p [T],
}

impl<T: Real, const D: usize> BlockSource<T> for Sweep<'_, '_, T, D> {
    fn write_block(&self, element: usize, block: &mut [T]) {
        let p = self.problem;
        let Some(extra) = element.checked_sub(p.model.n_elements()) else {
            let tangent = Tangent {
                stiffness: T::ZERO,
                damping: T::ZERO,
                penalty: &p.penalty,
                geometric: None,
            };
            p.model.write_block(&p.terms, &tangent, element, block);
            return;
        };
        block.fill(T::ZERO);
        if extra >= p.holds.len() {
            block[0] = p.lent_mass;
        } else if p.acts(extra, self.level) {
            let g = p.gradient(extra);
            crate::natural::add_squares(block, g.len(), [g], [p.hold_mass]);
        }
    }

    fn write_residual(&self, element: usize, residual: &mut [T]) {
        let p = self.problem;
        let Some(extra) = element.checked_sub(p.model.n_elements()) else {
            let m = p.model.n_constraints();
            let (mass, multipliers) = (Some(self.change), Some(&self.multipliers[..m]));
            let load = Load { mass, multipliers, force: T::ZERO };
            p.model.write_residual(&p.terms, &load, element, residual);
            return;
        };
        residual.fill(T::ZERO);
        if extra >= p.holds.len() {
            residual[0] = p.lent_mass * self.change[p.lent[extra - p.holds.len()] as usize];
        } else if p.acts(extra, self.level) {
            let mu = self.multipliers[p.model.n_constraints() + extra];
            for (r, &g) in residual.iter_mut().zip(p.gradient(extra)) {
                *r = g * mu;
            }
        }
    }
}

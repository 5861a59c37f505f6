//! Scenes with their equilibria and eigenvalues, for the tests of this crate.

use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::BodyId;
use mbs_linear::{
    Equilibrium, EquilibriumError, Instant, Linear, LinearError, LinearOptions, Options, Saddle,
    Workspace, eigenvalues, equilibrium, equilibrium_near, linearise,
};
use mbs_sparse::Indefinite;
use mbs_testkit::{scene, start};

/// A model with its assembled state.
pub(crate) struct Case<const D: usize> {
    pub(crate) model: NaturalModel<f64, D>,
    pub(crate) state: State<f64>,
    pub(crate) w: Workspace<f64, Indefinite<f64>>,
}

impl<const D: usize> Case<D> {
    pub(crate) fn new(text: &str) -> Self {
        let (model, state) = start(&scene(text));
        let analyse = mbs_sparse::Options::default();
        let w = Workspace::new(&model, Indefinite::analyse(&Saddle::new(&model), analyse));
        Self { model, state, w }
    }

    /// Moves the mechanism to the equilibrium at rest.
    pub(crate) fn settle(&mut self) -> Result<Equilibrium<f64>, EquilibriumError> {
        self.state.v.fill(0.0);
        equilibrium(&self.model, &Options::default(), &mut self.state, &mut self.w)
    }

    /// Moves the mechanism to the equilibrium at rest that Newton's method finds.
    pub(crate) fn approach(&mut self) -> Result<Equilibrium<f64>, EquilibriumError> {
        self.state.v.fill(0.0);
        equilibrium_near(&self.model, &Options::default(), &mut self.state, &mut self.w)
    }

    pub(crate) fn linear(&mut self, instant: Instant) -> Result<Linear<f64>, LinearError> {
        let how = (instant, &LinearOptions::default());
        linearise(&self.model, how, &self.state, &mut self.w)
    }

    /// Returns the eigenvalues (real, imaginary) with an imaginary part of zero or more, sorted by size, then by real part.
    pub(crate) fn eigenvalues(&mut self, instant: Instant) -> Vec<(f64, f64)> {
        let linear = self.linear(instant).unwrap_or_else(|e| panic!("{e}"));
        let (n, a) = (linear.order(), linear.state_matrix());
        let values = eigenvalues(n, &a).expect("the eigenvalues converge");
        let mut all: Vec<(f64, f64)> =
            values.iter().filter(|x| x[1] >= 0.0).map(|x| (x[0], x[1])).collect();
        all.sort_by(|a, b| a.0.hypot(a.1).total_cmp(&b.0.hypot(b.1)).then(a.0.total_cmp(&b.0)));
        all
    }

    /// Returns the position of a material point of a body.
    pub(crate) fn point(&self, body: usize, at: [f64; 3]) -> [f64; D] {
        self.model.point(BodyId::Body(body), at).value(&self.state.q).into()
    }
}

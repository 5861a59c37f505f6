//! Helpers that the test binaries share: scenes of the repository, and stepping without recording.
pub(crate) mod files;
pub(crate) mod oracle;

pub(crate) use files::{SCENES, path};
use mbs::augmented::StepReport;
use mbs::core::natural::Affine;
use mbs::core::scene::{BodyId, Dimension, Scene};
use mbs::typed::Simulation;
use mbs::{FormulationKind, Method, Outcome, ResolvedMethod, StopError};
pub(crate) use mbs_testkit::file as scene;
pub(crate) use mbs_testkit::{allocations, random};

/// The augmented formulations, by name.
pub(crate) const FORMULATIONS: [&str; 2] = ["index-3", "index-1"];

/// Settings of a scene with a formulation and a step. Default: the scene's step.
pub(crate) fn settings(scene: &Scene<f64>, formulation: &str, step: Option<f64>) -> ResolvedMethod {
    let formulation = Some(formulation.to_owned());
    let overrides = Method { formulation, step, ..Method::default() };
    ResolvedMethod::new(scene, &overrides).expect("the settings are built")
}

/// Runs a scene with given settings.
pub(crate) fn run_by(scene: &Scene<f64>, settings: &ResolvedMethod) -> Outcome {
    match scene.dimension {
        Dimension::Planar => mbs::typed::run::<f64, 2>(scene, settings, &mut ()),
        Dimension::Spatial => mbs::typed::run::<f64, 3>(scene, settings, &mut ()),
    }
}

/// Runs a scene by a method. Settings that it leaves open are the scene's.
pub(crate) fn run(scene: &Scene<f64>, method: &Method) -> Outcome {
    run_by(scene, &ResolvedMethod::new(scene, method).expect("the settings are built"))
}

/// Runs a scene with a formulation and a step. Default: the scene's step.
pub(crate) fn run_in(scene: &Scene<f64>, formulation: &str, step: Option<f64>) -> Outcome {
    run_by(scene, &settings(scene, formulation, step))
}

/// Makes a method of a formulation. All other settings are the scene's.
pub(crate) fn by(formulation: &str) -> Method {
    Method { formulation: Some(formulation.to_owned()), ..Method::default() }
}

/// Formulations whose steps have the requested length.
pub(crate) fn with_fixed_steps() -> impl Iterator<Item = &'static str> {
    FormulationKind::ALL.map(FormulationKind::name).into_iter().filter(|f| *f != "multi-index")
}

/// Simulation that the test steps itself.
pub(crate) struct Bench<const D: usize> {
    pub(crate) simulation: Simulation<f64, D>,
    pub(crate) step: f64,
    initial: f64,
}

impl<const D: usize> Bench<D> {
    pub(crate) fn new(name: &str, formulation: &str, step: f64) -> Self {
        Self::of_scene(&scene(name), formulation, step)
    }

    pub(crate) fn of_scene(scene: &Scene<f64>, formulation: &str, step: f64) -> Self {
        let settings = settings(scene, formulation, Some(step));
        let simulation = Simulation::new(scene, &settings).expect("the scene assembles");
        let [kinetic, potential, _] = simulation.initial_energies();
        Self { simulation, step, initial: kinetic + potential }
    }

    pub(crate) fn step(&mut self) -> Result<StepReport<f64>, StopError> {
        self.simulation.step(self.step)
    }

    /// Makes steps until `duration`, and calls `look` after each. `Err` has the time at which a step failed.
    pub(crate) fn run(
        &mut self,
        duration: f64,
        mut look: impl FnMut(&Self),
    ) -> Result<(), (f64, StopError)> {
        for k in 1..=steps(duration, self.step) {
            self.step().map_err(|e| (k as f64 * self.step, e))?;
            self.simulation.set_time(k as f64 * self.step);
            look(self);
        }
        Ok(())
    }

    /// Error of the energy invariant Pi, |Pi - Pi(0)| [J].
    pub(crate) fn energy_error(&self) -> f64 {
        let [kinetic, potential, work] = self.simulation.energies();
        (kinetic + potential - work - self.initial).abs()
    }

    /// A material point of a body.
    pub(crate) fn point(&self, body: usize, at: [f64; 3]) -> Affine<f64, D> {
        self.simulation.model().point(BodyId::Body(body), at)
    }

    pub(crate) fn position(&self, point: &Affine<f64, D>) -> [f64; D] {
        point.value(&self.simulation.state().q).into()
    }

    pub(crate) fn velocity(&self, point: &Affine<f64, D>) -> [f64; D] {
        point.rate(&self.simulation.state().v).into()
    }

    pub(crate) fn acceleration(&self, point: &Affine<f64, D>) -> [f64; D] {
        point.rate(&self.simulation.state().a).into()
    }
}

/// Number of steps of a duration that is a multiple of the step.
pub(crate) fn steps(duration: f64, step: f64) -> u64 {
    (duration / step).round() as u64
}

/// Distance of two points.
pub(crate) fn distance<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt()
}

/// The larger of two values; NaN if either is.
pub(crate) fn worst(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

//! Every item of a simulation's checkpoint affects the following steps.

use super::layout::Parts;
use crate::common::scene;
use mbs::core::scene::{
    BodyId, BodyTorque, Effect, EffectKind, JointId, Scene, Signal, TorsionSpring,
};
use mbs::typed::Simulation;
use mbs::{Method, ResolvedMethod};

/// How a simulation is made and stepped before its checkpoint and after it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Case {
    pub(super) scene: &'static str,
    pub(super) formulation: &'static str,
    pub(super) integrator: &'static str,
    pub(super) control: &'static str,
    pub(super) step: f64,
    /// Steps before the checkpoint, and after it.
    pub(super) steps: [u32; 2],
    /// Number of checkpoints: the first is after `steps[0]` steps, then one after each further step.
    pub(super) places: u32,
}

/// Base case, from which the other cases differ.
pub(super) const CASE: Case = Case {
    scene: "double-pendulum",
    formulation: "index-3",
    integrator: "trapezoidal",
    control: "fixed",
    step: 1e-3,
    steps: [40, 40],
    places: 12,
};

impl Case {
    pub(super) fn scene(&self) -> Scene<f64> {
        let mut scene = scene(self.scene);
        let course = Signal::Input([0.0; 3]);
        let kind = EffectKind::BodyTorque(BodyTorque { body: BodyId::Body(0), course });
        let motor = Effect { name: "motor".into(), enabled: true, kind };
        if self.scene == "guided-four-bar" {
            let (stiffness, damping, free_value) = (2.0, 0.0, 0.0);
            let kind = EffectKind::TorsionSpring(TorsionSpring {
                joint: JointId::new(0),
                coordinate: None,
                stiffness,
                damping,
                free_value,
            });
            scene.effects.push(Effect { name: "spring".into(), enabled: true, kind });
        }
        scene.effects.push(motor);
        scene
    }

    pub(super) fn overrides(&self) -> Method {
        let text = |text: &str| Some(text.to_owned());
        Method {
            formulation: text(self.formulation),
            integrator: text(self.integrator),
            step_control: (self.control != "fixed").then(|| self.control.to_owned()),
            step: Some(self.step),
            step_max: (self.control != "fixed").then_some(20.0 * self.step),
            energy_tolerance: (self.control == "energy").then_some([1e-7, 1e-9]),
            ..Method::default()
        }
    }

    pub(super) fn settings(&self, scene: &Scene<f64>) -> ResolvedMethod {
        ResolvedMethod::new(scene, &self.overrides()).expect("good settings")
    }

    fn simulation<const D: usize>(&self) -> Simulation<f64, D> {
        let scene = self.scene();
        let settings = self.settings(&scene);
        Simulation::new(&scene, &settings).expect("it starts")
    }

    /// Returns the simulation at the time of its checkpoint.
    pub(super) fn before<const D: usize>(&self) -> Simulation<f64, D> {
        let mut simulation = self.simulation();
        let motor = self.scene().effects.len() - 1;
        simulation.set_input(motor, [0.3, 0.0, 0.3]).expect("an input");
        for _ in 0..self.steps[0] {
            simulation.advance(self.rest()).expect("a regular step");
        }
        simulation
    }

    /// Time left to the end of the run if steps are controlled, otherwise one step [s].
    pub(super) fn rest(&self) -> f64 {
        if self.control == "fixed" { self.step } else { 1e3 }
    }

    /// Bits of all results of the following steps.
    fn after<const D: usize>(&self, simulation: &mut Simulation<f64, D>) -> Vec<u64> {
        let mut seen: Vec<u64> = simulation.energies().map(f64::to_bits).to_vec();
        for _ in 0..self.steps[1] {
            let Ok(accepted) = simulation.advance(self.rest()) else {
                seen.push(u64::MAX);
                return seen;
            };
            let report = accepted.attempt.report;
            let (index, changes) = simulation.index().unwrap_or_default();
            let counts = [report.iterations, report.factorizations, report.solves, report.rejected];
            seen.extend(counts.map(u64::from));
            seen.extend([u64::from(index), u64::from(changes), accepted.step.to_bits()]);
            let s = simulation.state();
            for numbers in [&s.q[..], &s.q_low, &s.v, &s.a, &s.lambda, &s.reaction, &s.memory] {
                seen.extend(numbers.iter().map(|x| x.to_bits()));
            }
            seen.extend([s.t, s.work, s.power].map(f64::to_bits));
            seen.extend(simulation.energies().map(f64::to_bits));
            seen.extend(simulation.invariant().history().map(f64::to_bits));
        }
        seen
    }
}

/// The bytes of a simulation's checkpoint.
pub(super) fn saved<const D: usize>(
    simulation: &Simulation<f64, D>,
    whose: (&Scene<f64>, &ResolvedMethod),
) -> Vec<u8> {
    let mut bytes = Vec::new();
    simulation.save(whose, &mut bytes).expect("memory");
    bytes
}

/// Part of the file that is replaced, and its replacement.
type Item = (&'static str, Left);

#[derive(Debug, Clone, Copy)]
enum Left {
    /// Bytes of a simulation that has made no step.
    Fresh,
    /// Bytes that are given here.
    Bytes(&'static [u8]),
    /// Bytes that a function computes from the original ones.
    Of(fn(&[u8]) -> Vec<u8>),
}

/// Asserts that restoring a checkpoint does not change the following bits, at all places. If one of the items is replaced, the bits must
/// change at some of the places at least.
fn every_item_matters<const D: usize>(case: Case, items: &[Item]) {
    let scene = case.scene();
    let settings = case.settings(&scene);
    let whose = (&scene, &settings);
    let fresh = Parts::of_simulation(saved(&case.simulation::<D>(), whose), &settings);
    let mut left: Vec<Item> = items.to_vec();
    for offset in 0..case.places {
        let case = Case { steps: [case.steps[0] + offset, case.steps[1]], ..case };
        let mut first = case.before::<D>();
        let kept = Parts::of_simulation(saved(&first, whose), &settings);
        let seen = case.after(&mut first);

        let mut second = case.simulation::<D>();
        second.restore(whose, kept.bytes()).expect("it is ours");
        assert!(seen == case.after(&mut second), "{case:?}: what is kept is not all");
        left.retain(|(name, item)| {
            let lost = match item {
                Left::Fresh => kept.with(name, fresh.part(name)),
                Left::Bytes(bytes) => kept.with(name, bytes),
                Left::Of(part) => kept.with(name, &part(kept.part(name))),
            };
            let mut third = case.simulation::<D>();
            third.restore(whose, &lost[..]).unwrap_or_else(|error| panic!("{name}: {error}"));
            seen == case.after(&mut third)
        });
    }
    let names: Vec<&str> = left.iter().map(|(name, _)| *name).collect();
    assert!(names.is_empty(), "{case:?}: nothing is lost without {names:?}");
}

/// Returns a list with all numbers replaced by `x`.
fn all(part: &[u8], x: f64) -> Vec<u8> {
    let mut bytes = part.to_vec();
    bytes[8..].chunks_exact_mut(8).for_each(|place| place.copy_from_slice(&x.to_le_bytes()));
    bytes
}

/// Items that every formulation in natural coordinates needs.
const STATE: [Item; 7] = [
    ("time", Left::Fresh),
    ("positions", Left::Fresh),
    ("velocities", Left::Fresh),
    ("work", Left::Fresh),
    ("power", Left::Fresh),
    ("invariant", Left::Fresh),
    ("inputs", Left::Fresh),
];

/// Further items of the formulations that store rounding errors and multipliers.
const CARRIED: [Item; 6] = [
    ("length of the last step", Left::Fresh),
    ("rounding of positions", Left::Fresh),
    ("auxiliary accelerations", Left::Fresh),
    ("multipliers", Left::Fresh),
    ("multipliers before", Left::Fresh),
    ("residuals", Left::Fresh),
];

/// Bytes of an energy rule without history: a flag that the rule is present, no change of energy, and a count of zero.
const NO_ENERGY: &[u8] = &[1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
/// Bytes of an error control without history: it is present, with no error, not rejected.
const NO_ERROR: &[u8] = &[1, 0, 0];

#[test]
fn every_item_of_the_natural_state_matters() {
    let inputs = [("inputs of the state", Left::Fresh)];
    every_item_matters::<2>(CASE, &[&STATE[..], &CARRIED, &inputs].concat());
    for formulation in ["classical", "index-1"] {
        every_item_matters::<2>(Case { formulation, ..CASE }, &STATE);
    }
    // the trapezoidal rule uses auxiliary accelerations, which are stored elsewhere
    let items = [("accelerations", Left::Fresh)];
    every_item_matters::<2>(Case { integrator: "hht", ..CASE }, &items);
    // the spring at the crank has been wound by more than half a revolution
    let items = [&STATE[..], &[("memory", Left::Fresh), ("springs", Left::Fresh)]].concat();
    for formulation in ["index-3", "classical", "state-space"] {
        let case = Case { scene: "guided-four-bar", formulation, steps: [1500, 40], ..CASE };
        every_item_matters::<2>(case, &items);
    }
}

#[test]
fn what_the_penalty_remembers_matters() {
    // the steps pass the singular position of two four-bar linkages
    let items = [
        ("penalty", Left::Of(|_| 1.0_f64.to_le_bytes().to_vec())),
        // the value that a failed step leaves
        ("strength of penalties", Left::Of(|_| 16_384.0_f64.to_le_bytes().to_vec())),
        ("combination of constraints", Left::Of(|part| all(part, 1.0))),
        ("what is left of the combination", Left::Bytes(&[0; 8])),
    ];
    let case = Case { scene: "two-four-bars", ..CASE };
    let scene = case.scene();
    let settings = case.settings(&scene);
    let mut simulation = case.before::<2>();
    let mut steps = case.steps[0];
    let parts = |simulation: &Simulation<f64, 2>| {
        Parts::of_simulation(saved(simulation, (&scene, &settings)), &settings)
    };
    let is_raised = |parts: &Parts| {
        parts.number("penalty") > 1.0 && parts.number("what is left of the combination") >= 0.001
    };
    while !is_raised(&parts(&simulation)) {
        simulation.advance(case.step).expect("a step that passes");
        steps += 1;
        assert!(steps < 5000, "no penalty is raised");
    }
    // further checkpoints are made on the way to the singular position
    every_item_matters::<2>(Case { steps: [steps - 8, 100], places: 60, ..case }, &items);
}

#[test]
fn what_the_control_remembers_matters() {
    // the rule remembers an energy error that passes zero
    let case = Case { control: "energy", places: 700, ..CASE };
    let items = [("next step", Left::Fresh), ("energy rule", Left::Bytes(NO_ENERGY))];
    every_item_matters::<2>(case, &items);
    let items = [("energy rule", Left::Bytes(NO_ENERGY))];
    let (step, steps) = (1e-5, [2, 20]);
    every_item_matters::<2>(Case { control: "energy-printed", step, steps, ..CASE }, &items);
    let case = Case { control: "error", ..CASE };
    every_item_matters::<2>(case, &[("error control", Left::Bytes(NO_ERROR))]);
}

#[test]
fn what_the_change_of_index_remembers_matters() {
    let case = Case { formulation: "multi-index", control: "energy", step: 2e-5, ..CASE };
    let more = |part: &[u8]| {
        let changes = u32::from_le_bytes(part.try_into().expect("four bytes"));
        (changes + 1).to_le_bytes().to_vec()
    };
    // the byte 1 means index-1
    let items = [("index", Left::Bytes(&[1])), ("changes", Left::Of(more))];
    every_item_matters::<2>(case, &items);
}

#[test]
fn what_state_space_chose_matters() {
    // after this number of steps, other independent coordinates have been chosen
    let case = Case { formulation: "state-space", steps: [2500, 400], step: 1e-2, ..CASE };
    let scene = case.scene();
    let settings = case.settings(&scene);
    let bytes = saved(&case.before::<2>(), (&scene, &settings));
    assert!(Parts::of_simulation(bytes, &settings).count("choices") > 0);
    every_item_matters::<2>(case, &[("order", Left::Fresh)]);
}

#[test]
fn what_relative_coordinates_keep_matters() {
    let items = [
        ("coordinates", Left::Fresh),
        ("rates", Left::Fresh),
        ("second rates", Left::Fresh),
        ("time of the tree", Left::Bytes(&[0; 8])),
        ("energies", Left::Bytes(&[0; 16])),
    ];
    let case = Case { formulation: "recursive", ..CASE };
    every_item_matters::<2>(case, &items);
    every_item_matters::<3>(Case { scene: "spatial-four-bar", ..case }, &items);
    every_item_matters::<2>(Case { integrator: "hht", ..case }, &[("auxiliary", Left::Fresh)]);
    let items = [("pivots", Left::Of(|part| all(part, 0.0)))];
    every_item_matters::<2>(Case { scene: "two-four-bars", ..case }, &items);
    for integrator in ["rk54", "rk853", "gbs", "radau5"] {
        let step = 0.1;
        let items = [("error control of the tree", Left::Fresh)];
        every_item_matters::<2>(Case { integrator, step, ..case }, &items);
    }
}

//! That every item of a checkpoint matters, and that no bytes do harm.

use super::engine::EngineKept;
use super::tape::{Eye, Pen, Tape};
use super::*;
use crate::fingerprint::fingerprint;
use crate::{InSpace, Overrides, Plane, Settings, Simulation};
use mbs_core::scene::{Course, Effect, EffectKind, Scene};
use mbs_scene::Document;
use proptest::prelude::*;

fn scene(name: &str) -> Scene<f64> {
    let path = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let bytes = std::fs::read(path).expect("the scene is in the repository");
    Document::from_bytes(&bytes, name).and_then(|d| d.scene()).expect("a good scene")
}

/// How a simulation is made and stepped.
#[derive(Debug, Clone, Copy)]
struct Case {
    scene: &'static str,
    formulation: &'static str,
    integrator: &'static str,
    control: &'static str,
    step: f64,
    /// Steps before the checkpoint, and after it.
    steps: [u32; 2],
    /// Checkpoints that are tried: after so many steps, and after each of the next ones.
    places: u32,
}

const CASE: Case = Case {
    scene: "double-pendulum",
    formulation: "index-3",
    integrator: "trapezoidal",
    control: "fixed",
    step: 1e-3,
    steps: [40, 40],
    places: 12,
};

impl Case {
    fn scene(&self) -> Scene<f64> {
        let mut scene = scene(self.scene);
        let course = Course::Input([0.0; 3]);
        let kind = EffectKind::BodyTorque { body: 0, course };
        let motor = Effect { name: "motor".into(), enabled: true, kind };
        if self.scene == "guided-four-bar" {
            let (stiffness, damping, free_value) = (2.0, 0.0, 0.0);
            let kind = EffectKind::TorsionSpring { joint: 0, stiffness, damping, free_value };
            scene.effects.push(Effect { name: "spring".into(), enabled: true, kind });
        }
        scene.effects.push(motor);
        scene
    }

    fn settings(&self, scene: &Scene<f64>) -> Settings {
        let text = |text: &str| Some(text.to_owned());
        let overrides = Overrides {
            formulation: text(self.formulation),
            integrator: text(self.integrator),
            step_control: (self.control != "fixed").then(|| self.control.to_owned()),
            step: Some(self.step),
            step_max: (self.control != "fixed").then_some(20.0 * self.step),
            energy_tolerance: (self.control == "energy").then_some([1e-7, 1e-9]),
            ..Overrides::default()
        };
        Settings::new(scene, &overrides).expect("good settings")
    }

    fn simulation<const D: usize>(&self) -> Simulation<f64, D>
    where
        Plane<D>: InSpace<f64>,
    {
        let scene = self.scene();
        let settings = self.settings(&scene);
        Simulation::new(&scene, &settings).expect("it starts")
    }

    /// The simulation as it is when its checkpoint is made.
    fn before<const D: usize>(&self) -> Simulation<f64, D>
    where
        Plane<D>: InSpace<f64>,
    {
        let mut simulation = self.simulation();
        simulation.set_input(simulation_motor(&simulation), [0.3, 0.0, 0.3]);
        for _ in 0..self.steps[0] {
            simulation.advance(self.rest()).expect("a regular step");
        }
        simulation
    }

    /// What is left to the end of the run, where lengths are controlled; else a step.
    fn rest(&self) -> f64 {
        if self.control == "fixed" { self.step } else { 1e3 }
    }

    /// Everything that can be seen of the steps that follow, in bits.
    fn after<const D: usize>(&self, simulation: &mut Simulation<f64, D>) -> Vec<u64>
    where
        Plane<D>: InSpace<f64>,
    {
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

/// The effect that [`Case::scene`] adds.
fn simulation_motor<const D: usize>(simulation: &Simulation<f64, D>) -> usize
where
    Plane<D>: InSpace<f64>,
{
    simulation.kept().inputs[0].last().expect("it has an input").0
}

/// Leaves one item out: it is then as in a simulation that has made no step.
type Leave = fn(&mut Kept<f64>, &Kept<f64>);

/// That the bits after a checkpoint are those without it, wherever it is, and that they are not where one of the items is left
/// out, at some of the places: not every one matters everywhere.
fn every_item_matters<const D: usize>(case: Case, items: &[(&str, Leave)])
where
    Plane<D>: InSpace<f64>,
{
    let fresh = case.simulation::<D>().kept();
    let mut left: Vec<_> = items.to_vec();
    for offset in 0..case.places {
        let case = Case { steps: [case.steps[0] + offset, case.steps[1]], ..case };
        let mut first = case.before::<D>();
        let mut kept = first.kept();
        let mut pen = Pen::default();
        kept.walk(&mut pen).expect("memory");
        let seen = case.after(&mut first);

        let mut second = case.simulation::<D>();
        second.restore_from(&mut Eye(&pen.0)).expect("it is ours");
        assert!(seen == case.after(&mut second), "{case:?}: what is kept is not all");
        left.retain(|(name, leave)| {
            let mut lost = kept.clone();
            leave(&mut lost, &fresh);
            let mut third = case.simulation::<D>();
            assert!(third.go_on(&lost), "{name}");
            seen == case.after(&mut third)
        });
    }
    let names: Vec<&str> = left.iter().map(|(name, _)| *name).collect();
    assert!(names.is_empty(), "{case:?}: nothing is lost without {names:?}");
}

/// What every formulation in natural coordinates goes on from.
const STATE: [(&str, Leave); 7] = [
    ("time", |k, f| k.state.t = f.state.t),
    ("positions", |k, f| k.state.q.clone_from(&f.state.q)),
    ("velocities", |k, f| k.state.v.clone_from(&f.state.v)),
    ("work", |k, f| k.state.work = f.state.work),
    ("power", |k, f| k.state.power = f.state.power),
    ("invariant", |k, f| k.invariant = f.invariant),
    ("inputs", |k, f| k.inputs.clone_from(&f.inputs)),
];

/// What those add that carry rounding and multipliers.
const CARRIED: [(&str, Leave); 6] = [
    ("length of the last step", |k, f| k.state.dt = f.state.dt),
    ("rounding of positions", |k, f| k.state.q_low.clone_from(&f.state.q_low)),
    ("auxiliary accelerations", |k, f| k.state.a_aux.clone_from(&f.state.a_aux)),
    ("multipliers", |k, f| k.state.lambda.clone_from(&f.state.lambda)),
    ("multipliers before", |k, f| k.state.lambda_previous.clone_from(&f.state.lambda_previous)),
    ("residuals", |k, f| k.state.phi.clone_from(&f.state.phi)),
];

fn augmented(kept: &mut Kept<f64>) -> &mut mbs_augmented::History<f64> {
    match &mut kept.engine {
        EngineKept::Augmented(history, ..) => history,
        other => panic!("{other:?}"),
    }
}

fn index_change(kept: &mut Kept<f64>) -> &mut mbs_augmented::IndexHistory<f64> {
    match &mut kept.engine {
        EngineKept::Augmented(_, Some(change), _) => change,
        other => panic!("{other:?}"),
    }
}

fn choice(kept: &mut Kept<f64>) -> &mut mbs_statespace::History<f64> {
    match &mut kept.engine {
        EngineKept::StateSpace(history, _) => history,
        other => panic!("{other:?}"),
    }
}

fn tree(kept: &mut Kept<f64>) -> &mut TreeKept<f64> {
    match &mut kept.engine {
        EngineKept::Recursive(tree) => tree,
        other => panic!("{other:?}"),
    }
}

fn springs(kept: &mut Kept<f64>, fresh: &Kept<f64>) {
    match (&mut kept.engine, &fresh.engine) {
        (EngineKept::Augmented(.., a), EngineKept::Augmented(.., b))
        | (EngineKept::Classical(a), EngineKept::Classical(b))
        | (EngineKept::StateSpace(_, a), EngineKept::StateSpace(_, b)) => a.clone_from(b),
        other => panic!("{other:?}"),
    }
}

fn driver(kept: &mut Kept<f64>) -> &mut mbs_core::control::DriverHistory<f64> {
    &mut kept.control.as_mut().expect("it is controlled").driver
}

fn all(lists: &[&[(&'static str, Leave)]]) -> Vec<(&'static str, Leave)> {
    lists.concat()
}

#[test]
fn every_item_of_the_natural_state_matters() {
    every_item_matters::<2>(CASE, &all(&[&STATE, &CARRIED]));
    for formulation in ["classical", "index-1"] {
        every_item_matters::<2>(Case { formulation, ..CASE }, &STATE);
    }
    // the trapezoidal rule goes on from auxiliary accelerations, which are the same
    let items: [(&str, Leave); 1] = [("accelerations", |k, f| k.state.a.clone_from(&f.state.a))];
    every_item_matters::<2>(Case { integrator: "hht", ..CASE }, &items);
    // the spring at the crank has been wound by more than half a turn
    let memory: Leave = |k, f| k.state.memory.clone_from(&f.state.memory);
    let items = all(&[&STATE, &[("memory", memory), ("springs", springs)]]);
    for formulation in ["index-3", "classical", "state-space"] {
        let case = Case { scene: "guided-four-bar", formulation, steps: [1500, 40], ..CASE };
        every_item_matters::<2>(case, &items);
    }
}

#[test]
fn what_the_penalty_remembers_matters() {
    // through the singular position of two four-bar linkages
    let items: [(&str, Leave); 3] = [
        ("penalty", |k, _| augmented(k).boost = 1.0),
        ("combination of constraints", |k, _| augmented(k).probe.fill(1.0)),
        ("what is left of it", |k, _| augmented(k).rho = 0.0),
    ];
    let case = Case { scene: "two-four-bars", ..CASE };
    let mut simulation = case.before::<2>();
    let mut steps = case.steps[0];
    while augmented(&mut simulation.kept()).boost <= 1.0
        || augmented(&mut simulation.kept()).rho < 0.001
    {
        simulation.advance(case.step).expect("a step that passes");
        steps += 1;
        assert!(steps < 5000, "no penalty is raised");
    }
    // and where it is going to be
    every_item_matters::<2>(Case { steps: [steps - 8, 100], places: 60, ..case }, &items);
}

#[test]
fn what_the_control_remembers_matters() {
    // an error that passes through zero is remembered
    let case = Case { control: "energy", places: 700, ..CASE };
    let items: [(&str, Leave); 2] = [
        ("next step", |k, f| driver(k).next = f.control.as_ref().map_or(0.0, |c| c.driver.next)),
        ("energy rule", |k, _| driver(k).energy = Some((0.0, 0))),
    ];
    every_item_matters::<2>(case, &items);
    let items: [(&str, Leave); 1] =
        [("printed energy rule", |k, _| driver(k).energy = Some((0.0, 0)))];
    let (step, steps) = (1e-5, [2, 20]);
    every_item_matters::<2>(Case { control: "energy-printed", step, steps, ..CASE }, &items);
    let case = Case { control: "error", ..CASE };
    let items: [(&str, Leave); 1] =
        [("error control", |k, _| driver(k).error = Some((None, false)))];
    every_item_matters::<2>(case, &items);
}

#[test]
fn what_the_change_of_index_remembers_matters() {
    let case = Case { formulation: "multi-index", control: "energy", step: 2e-5, ..CASE };
    let items: [(&str, Leave); 2] = [
        ("index", |k, _| index_change(k).index = mbs_augmented::Index::One),
        ("changes", |k, _| index_change(k).changes += 1),
    ];
    every_item_matters::<2>(case, &items);
}

#[test]
fn what_state_space_chose_matters() {
    // so many steps that other coordinates were chosen
    let case = Case { formulation: "state-space", steps: [2500, 400], step: 1e-2, ..CASE };
    let kept = &mut case.before::<2>().kept();
    assert!(choice(kept).choices > 0);
    let items: [(&str, Leave); 1] = [("order", |k, f| {
        let mut fresh = f.clone();
        choice(k).order = choice(&mut fresh).order.clone();
    })];
    every_item_matters::<2>(case, &items);
}

#[test]
fn what_relative_coordinates_keep_matters() {
    let items: [(&str, Leave); 5] = [
        ("coordinates", |k, f| tree(k).state.z = tree(&mut f.clone()).state.z.clone()),
        ("velocities", |k, f| tree(k).state.v = tree(&mut f.clone()).state.v.clone()),
        ("accelerations", |k, f| tree(k).state.a = tree(&mut f.clone()).state.a.clone()),
        ("time", |k, _| tree(k).state.t = 0.0),
        ("energies", |k, _| tree(k).energies = [0.0; 2]),
    ];
    let case = Case { formulation: "recursive", ..CASE };
    every_item_matters::<2>(case, &items);
    every_item_matters::<3>(Case { scene: "spatial-four-bar", ..case }, &items);
    let items: [(&str, Leave); 1] = [("pivots", |k, _| tree(k).history.pivots.fill(0.0))];
    every_item_matters::<2>(Case { scene: "two-four-bars", ..case }, &items);
    for integrator in ["rk54", "rk853", "gbs", "radau5"] {
        let items: [(&str, Leave); 1] = [("error control", |k, f| {
            let fresh = &tree(&mut f.clone()).history.clone();
            let history = &mut tree(k).history;
            (history.pair, history.eighth) = (fresh.pair, fresh.eighth);
            (history.extrapolation, history.radau) = (fresh.extrapolation, fresh.radau.clone());
        })];
        let step = 0.1;
        every_item_matters::<2>(Case { integrator, step, ..case }, &items);
    }
}

/// The bytes of a checkpoint with another body, made whole again.
fn sealed(bytes: &[u8]) -> Vec<u8> {
    let mut sealed = bytes.to_vec();
    if let Some((head, rest)) = sealed.split_at_mut_checked(28) {
        head[12..20].copy_from_slice(&(rest.len() as u64).to_le_bytes());
        head[20..28].copy_from_slice(&fingerprint(rest).to_le_bytes());
    }
    sealed
}

#[test]
fn a_checkpoint_of_another_version_is_refused_with_its_name() {
    let (scene, case) = (CASE.scene(), CASE);
    let settings = case.settings(&scene);
    let mut bytes = Vec::new();
    case.before::<2>().save((&scene, &settings), &mut bytes).expect("memory");
    // the version stands first, after its length
    let version = env!("CARGO_PKG_VERSION").as_bytes();
    assert_eq!(&bytes[36..36 + version.len()], version);
    bytes[36] = b'9';
    match Checkpoint::read(&sealed(&bytes)[..]) {
        Err(CheckpointError::Version(found)) => assert!(found.starts_with('9')),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_list_is_never_longer_than_what_is_left() {
    let mut pen = Pen::default();
    pen.count(&mut (1 << 59)).expect("a count");
    pen.bytes(&mut [0; 64]).expect("memory");
    let mut list: Vec<f64> = Vec::new();
    let read = Eye(&pen.0).list(&mut list, 8, Tape::float);
    assert!(read.is_err() && list.capacity() == 0);
}

/// Cases that reach every part of the format, short enough to be tried many times.
const TRIED: [Case; 5] = [
    CASE,
    Case { formulation: "multi-index", control: "both", ..CASE },
    Case { formulation: "state-space", ..CASE },
    Case { formulation: "recursive", integrator: "rk54", ..CASE },
    Case { formulation: "recursive", control: "energy", ..CASE },
];

/// A run of 30 steps, kept; the bytes of its checkpoint in the middle.
fn run_bytes(case: Case) -> (Scene<f64>, Settings, Vec<u8>) {
    let scene = case.scene();
    let settings = Settings { duration: 0.03, ..case.settings(&scene) };
    let name = format!("mbs-checkpoint-{}-{:?}", std::process::id(), std::thread::current().id());
    let out = std::env::temp_dir().join(name);
    std::fs::create_dir_all(&out).expect("a scratch directory");
    let mut keeping = Keeping::new(&out, 0.01).expect("a directory of ours");
    let done = crate::run_kept::<f64, 2>(&scene, &settings, &mut (), (None, Some(&mut keeping)));
    assert!(done.is_ok_and(|outcome| outcome.summary.completed));
    let bytes = std::fs::read(keeping.path()).expect("it is there");
    std::fs::remove_dir_all(&out).expect("it is ours");
    (scene, settings, bytes)
}

#[test]
fn no_bytes_do_harm() {
    for case in TRIED {
        let (scene, settings, bytes) = run_bytes(case);
        assert!(Checkpoint::read(&bytes[..]).is_ok());
        let strategy = (prop::collection::vec((0..bytes.len(), any::<u8>()), 1..4), 0..bytes.len());
        let config = ProptestConfig { cases: 300, failure_persistence: None, ..Default::default() };
        let mut runner = proptest::test_runner::TestRunner::new_with_rng(
            config,
            proptest::test_runner::TestRng::deterministic_rng(Default::default()),
        );
        let tried = runner.run(&strategy, |(changes, length)| {
            let mut changed = bytes.clone();
            for (place, byte) in changes {
                changed[place] = byte;
            }
            if length % 4 == 0 {
                changed.truncate(length);
            }
            prop_assert!(changed == bytes || Checkpoint::read(&changed[..]).is_err());
            // with length and sum put right everything is read: a state that no run could have must end in an error at worst
            let Ok(checkpoint) = Checkpoint::read(&sealed(&changed)[..]) else { return Ok(()) };
            let mut simulation = case.simulation::<2>();
            let is_taken = simulation.restore_from(&mut checkpoint.body()).is_ok();
            if case.control != "fixed" && is_taken {
                // to the end it may be far, in steps that suit such a state
                let _ = (0..20).try_for_each(|_| simulation.advance(case.rest()).map(|_| ()));
            } else if case.integrator == "trapezoidal" {
                let from = (Some(&checkpoint), None);
                let _ = crate::run_kept::<f64, 2>(&scene, &settings, &mut (), from);
            }
            Ok(())
        });
        tried.unwrap_or_else(|error| panic!("{case:?}: {error}"));
    }
}

//! Prescribed motions, and a driver that cuts steps at their events.
//!
//! ```text
//! trial of length h whose end is no event: h <- share h;   at an event, or without one: the next step begins there
//! ```

use mbs_core::Real;
use mbs_core::algebra::{Vector, rotation};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::outputs::Events;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::Scene;
use mbs_scene::SceneFile;

/// Places and angles of the scene's bodies at a time, and their rates: x, up or y, and the angle about z or the wheel's axis.
pub(crate) type Signal = dyn Fn(f64) -> Vec<[[f64; 3]; 2]>;

/// Event at which a step ended.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Landing {
    pub(crate) t: f64,
    pub(crate) effect: usize,
    pub(crate) trials: u32,
}

/// Largest number of trials of the driver for one event.
const MOST_TRIALS: u32 = 6;

/// Prescribed motions of a scene, with its events.
pub(crate) struct Given<'a, T: Real, const D: usize> {
    scene: Scene<T>,
    model: NaturalModel<T, D>,
    pub(crate) state: State<T>,
    pub(crate) events: Events<T, D>,
    course: &'a Signal,
}

impl<'a, T: Real, const D: usize> Given<'a, T, D> {
    pub(crate) fn new(text: &str, course: &'a Signal) -> Self {
        let document =
            SceneFile::parse(text, "events").unwrap_or_else(|e| panic!("{}", e.render()));
        let scene: Scene<T> = document.scene().unwrap_or_else(|e| panic!("{}", e.render()));
        let model = NaturalModel::new(&scene).expect("a model");
        let events = Events::new(&scene, &model).expect("the effects are compiled");
        let state = State::at_rest(&model);
        let mut given = Self { scene, model, state, events, course };
        given.go(0.0);
        given.events.start(&given.state);
        given
    }

    /// Sets the state at a time.
    pub(crate) fn go(&mut self, t: f64) {
        let place = (self.course)(t);
        let up = D - 1;
        let motions: Vec<RigidMotion<T>> = self
            .scene
            .bodies
            .iter()
            .zip(place)
            .map(|(body, at)| {
                let mut motion = RigidMotion::at_rest(Vector::from(body.center));
                let [[x, z, angle], [vx, vz, spin]] = at.map(|x| x.map(T::from_f64));
                (motion.position[0], motion.position[up]) = (x, z);
                (motion.velocity[0], motion.velocity[up]) = (vx, vz);
                let axis = Vector::<T, 3>::from_fn(|i, _| if i == 2 { T::ONE } else { T::ZERO });
                (motion.rotation, motion.omega) = (rotation(&(axis * angle)), axis * spin);
                motion
            })
            .collect();
        self.state.t = T::from_f64(t);
        self.model.write_motions(&motions, &mut self.state);
    }

    /// Makes steps of length `h` between two times, cut at events. Returns the events.
    pub(crate) fn run(&mut self, [from, to]: [f64; 2], h: f64) -> Vec<Landing> {
        let (mut t, mut landings) = (from, Vec::new());
        while t < to {
            let (mut step, mut trials) = (h.min(to - t), 0);
            loop {
                self.go(t + step);
                let Some(crossing) = self.events.first_event(&self.state) else { break };
                if crossing.is_landed {
                    landings.push(Landing { t: t + step, effect: crossing.effect, trials });
                    break;
                }
                trials += 1;
                assert!(trials <= MOST_TRIALS, "{crossing:?} at {t} of {step}");
                assert!(crossing.share > 0.0 && crossing.share <= 1.05, "{crossing:?}");
                step *= crossing.share;
            }
            self.events.accept(&self.state);
            t += step;
        }
        landings
    }
}

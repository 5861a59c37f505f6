//! The stick figure of a scene: which points are drawn and what lines join them.

use crate::checkpoint::tape::{Tape, Walked, holds};
use crate::record::{Animation, Polyline, Trace};
use mbs_core::Real;
use mbs_core::natural::{Affine, NaturalModel};
use mbs_core::scene::{BodyId, Dimension, Inertia, Joint, Quantity, Scene, Translation};

/// Most pictures kept of a run. Chosen, not tuned.
const MOST_FRAMES: f64 = 600.0;
/// Time by which a picture may be early, relative to the interval of two [-]: times are rounded. Chosen, not tuned.
const EARLY: f64 = 1e-6;
/// Half length of the strokes of a body without inertia, relative to the scene's length [-].
const POINT_SIZE: f64 = 0.05;
/// Most numbers in all pictures: eighty megabytes. Scenes of some thousand bodies get fewer pictures.
const MOST_NUMBERS: f64 = 1e7;

/// Points of the figure, and the animation they fill.
#[derive(Debug)]
pub(crate) struct AnimationRecorder<T: Real, const D: usize> {
    points: Vec<Affine<T, D>>,
    pub(crate) animation: Animation,
    /// Time between pictures, and of the next one [s].
    every: f64,
    next: f64,
    /// Room for pictures that must not be allocated when they are taken.
    spare: Vec<Vec<f64>>,
}

impl<T: Real, const D: usize> AnimationRecorder<T, D> {
    /// Lays out the figure of a run of the given duration [s].
    pub(crate) fn new(scene: &Scene<T>, model: &NaturalModel<T, D>, duration: f64) -> Self {
        let mut layout = Layout { scene, model, points: Vec::new(), used: used(scene) };
        let bodies = (0..scene.bodies.len()).map(|b| layout.body(b)).collect();
        let traces = layout.traces();
        let up = scene.gravity.map_or([0.0; 3], |g| g.map(|x| -x.to_f64()));
        let ground = scene.joints.iter().filter(|j| rail(j, scene.dimension).is_none());
        let ground = ground.flat_map(|j| {
            (0..2).filter(|&k| j.bodies[k] == BodyId::Ground).map(|k| j.points[k].map(Real::to_f64))
        });
        let animation = Animation {
            dimension: D,
            up: if scene.dimension == Dimension::Spatial { up } else { [0.0; 3] },
            bodies,
            traces,
            ground: ground.collect(),
            rails: scene.joints.iter().filter_map(|j| rail(j, scene.dimension)).collect(),
            ..Animation::default()
        };
        let points = layout.points;
        #[allow(clippy::cast_precision_loss, reason = "numbers of points are far below 2^53")]
        let frames = (MOST_NUMBERS / (points.len() * D).max(1) as f64).clamp(1.0, MOST_FRAMES);
        Self { points, animation, every: duration / frames, next: 0.0, spare: Vec::new() }
    }

    /// Makes room for all pictures of a run, so that none is allocated when it is taken.
    pub(crate) fn reserve(&mut self, duration: f64) {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most the number of pictures"
        )]
        let n = (duration / self.every).clamp(0.0, MOST_FRAMES) as usize + 3;
        let size = self.points.len() * D;
        self.spare = (0..n).map(|_| Vec::with_capacity(size)).collect();
        self.animation.frames.reserve(n);
        self.animation.times.reserve(n);
    }

    /// Writes the pictures so far, or reads them back.
    pub(crate) fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        let n = self.points.len() * D;
        tape.float(&mut self.next)?;
        tape.list(&mut self.animation.times, 8, Tape::float)?;
        tape.list(&mut self.animation.frames, 8 * n.max(1), |tape, frame| {
            frame.resize(n, 0.0);
            tape.floats(frame)
        })?;
        holds(self.animation.times.len() == self.animation.frames.len())
    }

    /// Takes a picture where one is due.
    pub(crate) fn offer(&mut self, t: f64, q: &[T], is_last: bool) {
        if t >= self.next || is_last {
            let numbers = self.points.iter().flat_map(|p| {
                let x = p.value(q);
                (0..D).map(move |i| x[i].to_f64())
            });
            let mut frame = self.spare.pop().unwrap_or_default();
            frame.extend(numbers);
            self.animation.frames.push(frame);
            self.animation.times.push(t);
            self.next = ((t / self.every + EARLY).floor() + 1.0 - EARLY) * self.every;
        }
    }
}

/// The straight guide of a joint on the ground that slides along a line: place and direction.
fn rail<T: Real>(joint: &Joint<T>, dimension: Dimension) -> Option<[[f64; 3]; 2]> {
    match joint.kind.translation(dimension) {
        Translation::Along(axis) if joint.bodies.contains(&BodyId::Ground) => {
            let direction = joint.direction(axis).into();
            Some([joint.points[0], direction].map(|p: [T; 3]| p.map(Real::to_f64)))
        }
        Translation::Along(_) | Translation::Fixed | Translation::Across(_) | Translation::Free => {
            None
        }
    }
}

struct Layout<'a, T: Real, const D: usize> {
    scene: &'a Scene<T>,
    model: &'a NaturalModel<T, D>,
    points: Vec<Affine<T, D>>,
    /// Places of joints, then of outputs, on each body.
    used: Vec<Vec<[T; 3]>>,
}

/// Places of joints, then of outputs, on each body, each in file order.
fn used<T: Real>(scene: &Scene<T>) -> Vec<Vec<[T; 3]>> {
    let mut used = vec![Vec::new(); scene.bodies.len()];
    for joint in &scene.joints {
        for (body, point) in joint.bodies.iter().zip(joint.points) {
            if let BodyId::Body(b) = *body {
                used[b].push(point);
            }
        }
    }
    for output in &scene.outputs {
        if let Quantity::Position { body: BodyId::Body(body), at } = output.quantity {
            used[body].push(at);
        }
    }
    used
}

impl<T: Real, const D: usize> Layout<'_, T, D> {
    fn add(&mut self, body: BodyId, at: [T; 3]) -> usize {
        self.points.push(self.model.point(body, at));
        self.points.len() - 1
    }

    /// Places worth drawing on a body: joints, rod ends, springs, outputs; the centre where there are fewer than two. A point has one.
    fn places(&self, body: usize) -> Vec<[T; 3]> {
        let data = &self.scene.bodies[body];
        if data.is_point() {
            return vec![data.center];
        }
        let mut places: Vec<[T; 3]> = Vec::new();
        let mut visit = |p: [T; 3]| {
            if !places.contains(&p) {
                places.push(p);
            }
        };
        if let Inertia::Rod { from, to } = self.scene.bodies[body].inertia {
            visit(from);
            visit(to);
        }
        self.used[body].iter().for_each(|place| visit(*place));
        if places.len() < 2 {
            let center = self.scene.bodies[body].center;
            if !places.contains(&center) {
                places.push(center);
            }
        }
        places
    }

    fn body(&mut self, body: usize) -> Polyline {
        let places = self.places(body);
        let name = self.scene.bodies[body].name.clone();
        let mut chain: Vec<usize> =
            places.iter().map(|p| self.add(BodyId::Body(body), *p)).collect();
        if self.scene.bodies[body].is_point() {
            return Polyline { name, chains: vec![chain] };
        }
        if chain.len() == 1 {
            return Polyline { name, chains: self.cross(body, places[0]) };
        }
        if chain.len() > 2 && D == 2 {
            chain.push(chain[0]);
        }
        if chain.len() > 2 && D == 3 {
            return Polyline { name, chains: self.star(body, &chain) };
        }
        Polyline { name, chains: vec![chain] }
    }

    /// A spatial body with many places: strokes from its centre to each.
    fn star(&mut self, body: usize, places: &[usize]) -> Vec<Vec<usize>> {
        let center = self.add(BodyId::Body(body), self.scene.bodies[body].center);
        places.iter().map(|&place| vec![center, place]).collect()
    }

    /// A body with one place only: three (two) strokes as long as its radius of gyration.
    fn cross(&mut self, body: usize, at: [T; 3]) -> Vec<Vec<usize>> {
        let data = &self.scene.bodies[body];
        let moment = match data.inertia {
            Inertia::Planar(i) => i,
            Inertia::Spatial([xx, yy, zz, ..]) => xx.max(yy).max(zz),
            Inertia::Rod { .. } | Inertia::Point => T::ZERO,
        };
        let reach = if data.mass > T::ZERO { (moment / data.mass).sqrt() } else { T::ZERO };
        let reach =
            if reach > T::ZERO { reach } else { self.model.length() * T::from_f64(POINT_SIZE) };
        (0..D)
            .map(|i| {
                let (mut a, mut b) = (at, at);
                a[i] -= reach;
                b[i] += reach;
                vec![self.add(BodyId::Body(body), a), self.add(BodyId::Body(body), b)]
            })
            .collect()
    }

    fn traces(&mut self) -> Vec<Trace> {
        let scene = self.scene;
        let mut traces = Vec::new();
        for output in &scene.outputs {
            if let Quantity::Position { body, at } = output.quantity {
                let point = self.add(body, at);
                traces.push(Trace { name: output.name.clone(), point });
            }
        }
        traces
    }
}

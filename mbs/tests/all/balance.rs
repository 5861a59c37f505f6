//! Balance of momentum of every body of random machines. Gravity, reactions, effects and couplings must explain the change of its momenta.
//! Forces are computed from the laws and points in the file alone.

use crate::common::{run, run_in};
use mbs::core::scene::{BodyId, CouplingKind, CouplingMeasure, Inertia, Joint, Scene};
use mbs::{Method, Outcome};
use mbs_testkit::machines::kinds::{COUPLED, machine};
use mbs_testkit::machines::{Machine, Ways, Wording};
use mbs_testkit::{Random, scene};

type Vector = [f64; 3];

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn plus(a: Vector, s: f64, b: Vector) -> Vector {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

fn size(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

fn unit(a: Vector) -> Vector {
    a.map(|x| x / size(a))
}

fn three(row: &[f64]) -> Vector {
    [row[0], row[1], row[2]]
}

/// State of a body at an instant, and the sum of the forces on it.
#[derive(Debug, Clone, Default)]
struct Placed {
    center: Vector,
    /// Centre of the body in the reference configuration.
    drawn: Vector,
    /// Rows of the rotation matrix from the reference configuration.
    rotation: [Vector; 3],
    force: Vector,
    /// Moment on the body about its centre.
    moment: Vector,
    /// Largest force on the body [N], or moment divided by a metre.
    largest: f64,
}

impl Placed {
    fn turned(&self, a: Vector) -> Vector {
        self.rotation.map(|row| dot(row, a))
    }

    /// Position of a point of the body, which is given in the reference configuration.
    fn at(&self, point: Vector) -> Vector {
        plus(self.center, 1.0, self.turned(plus(point, -1.0, self.drawn)))
    }

    fn take(&mut self, at: Vector, force: Vector, moment: Vector) {
        self.force = plus(self.force, 1.0, force);
        let of_force = cross(plus(at, -1.0, self.center), force);
        self.moment = plus(plus(self.moment, 1.0, moment), 1.0, of_force);
        self.largest = self.largest.max(size(force)).max(size(moment));
    }
}

/// Number of output columns of a body and of a joint.
const OF_BODY: usize = 21;
const OF_JOINT: usize = 8;

fn outputs(machine: &Machine) -> String {
    let one = |of: &str, name: &str, quantity: &str| {
        format!(
            "[[output]]\nname = \"{of} {name} {quantity}\"\n{of} = \"{name}\"\nquantity = \"{quantity}\"\n"
        )
    };
    let of_body =
        ["position", "rotation-matrix", "acceleration", "angular-velocity", "angular-acceleration"];
    let bodies =
        machine.joints.iter().flat_map(|joint| of_body.map(|q| one("body", joint.bodies[1], q)));
    let joints = machine.joints.iter().flat_map(|joint| {
        ["value", "rate", "reaction"].map(|quantity| one("joint", joint.name, quantity))
    });
    let rest =
        one("coupling", "link", "effort") + "[[output]]\nname = \"asked\"\nsignal = \"asked\"\n";
    bodies.chain(joints).collect::<String>() + &rest
}

/// State of a machine at the end of a run.
struct Instant<'a> {
    scene: &'a Scene<f64>,
    machine: &'a Machine,
    wording: &'a Wording,
    row: &'a [f64],
    /// Bodies of the machine; the last one is the ground.
    bodies: Vec<Placed>,
}

impl<'a> Instant<'a> {
    fn new(
        scene: &'a Scene<f64>,
        machine: &'a Machine,
        wording: &'a Wording,
        row: &'a [f64],
    ) -> Self {
        let rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let ground = Placed { rotation, ..Placed::default() };
        let mut bodies = vec![ground; scene.bodies.len() + 1];
        for (k, joint) in machine.joints.iter().enumerate() {
            let of = &row[OF_BODY * k..];
            let body =
                scene.bodies.iter().position(|body| body.name == joint.bodies[1]).expect("a body");
            bodies[body] = Placed {
                center: three(of),
                drawn: scene.bodies[body].center,
                rotation: [3, 6, 9].map(|i| three(&of[i..])),
                ..Placed::default()
            };
        }
        Self { scene, machine, wording, row, bodies }
    }

    fn number(&self, body: BodyId) -> usize {
        body.index().unwrap_or(self.scene.bodies.len())
    }

    fn named(&self, body: &str) -> usize {
        let place = self.scene.bodies.iter().position(|of| of.name == body);
        place.unwrap_or(self.scene.bodies.len())
    }

    /// Returns a joint with its value, rate and reaction.
    fn joint(&self, name: &str) -> (&'a Joint<f64>, &'a [f64]) {
        let place =
            self.machine.joints.iter().position(|joint| joint.name == name).expect("a joint");
        let joint = self.scene.joints.iter().find(|joint| joint.name == name).expect("a joint");
        (joint, &self.row[OF_BODY * self.machine.joints.len() + OF_JOINT * place..])
    }

    /// The axis of a joint.
    fn axis(&self, joint: &Joint<f64>) -> Vector {
        self.bodies[self.number(joint.bodies[0])].turned(unit(joint.axes[0].expect("an axis")))
    }

    /// Applies a wrench to the second of two bodies, and its opposite to the first.
    fn between(&mut self, bodies: [usize; 2], at: Vector, (force, moment): (Vector, Vector)) {
        self.bodies[bodies[1]].take(at, force, moment);
        self.bodies[bodies[0]].take(at, force.map(|x| -x), moment.map(|x| -x));
    }

    /// Applies a force along a coordinate at the joint's point: to the second body, and its opposite to the first.
    fn along(&mut self, name: &str, effort: f64) {
        let (joint, _) = self.joint(name);
        let bodies = joint.bodies.map(|body| self.number(body));
        let at = self.bodies[bodies[1]].at(joint.points[1]);
        let axis = self.axis(joint).map(|x| effort * x);
        let drawn = self.machine.joints.iter().find(|of| of.name == name).expect("a joint");
        let wrench = if drawn.is_turn { ([0.0; 3], axis) } else { (axis, [0.0; 3]) };
        self.between(bodies, at, wrench);
    }

    fn reactions(&mut self) {
        for k in 0..self.machine.joints.len() {
            let (joint, of) = self.joint(self.machine.joints[k].name);
            let bodies = joint.bodies.map(|body| self.number(body));
            let at = self.bodies[bodies[1]].at(joint.points[1]);
            self.between(bodies, at, (three(&of[2..]), three(&of[5..])));
        }
    }

    /// Applies the springs and the motor of the machine.
    fn effects(&mut self) {
        let (_, swing) = self.joint("swing");
        self.along("swing", -30.0 * swing[0] - 0.3 * swing[1]);
        self.along("one", *self.row.last().expect("a signal"));
        let [from, to] = [[1.0, 2.0, 0.5], [0.2, 1.1, 0.1]];
        let free = 0.8 * size(plus(from, -1.0, to));
        let (frame, ground) = (self.named("frame"), self.named("ground"));
        let from = self.wording.place(from);
        let at = self.bodies[frame].at(self.wording.place(to));
        let way = plus(at, -1.0, from);
        let pull = unit(way).map(|x| -40.0 * (size(way) - free) * x);
        self.bodies[frame].take(at, pull, [0.0; 3]);
        self.bodies[ground].take(from, pull.map(|x| -x), [0.0; 3]);
    }

    /// Applies the force of the coupling at its point of action. Where the machine does not determine the point, the effort acts on the
    /// coordinates.
    fn coupling(&mut self, kind: usize) {
        let effort = self.row[self.row.len() - 2];
        match kind {
            0 | 4 => self.teeth(effort),
            5 | 6 => self.strands(effort, kind == 6),
            11 => self.thread(effort),
            14 => self.rope(effort),
            _ => {
                let coupling = &self.scene.couplings[0];
                let by = if (7..11).contains(&kind) { 1.0 } else { coupling.terms[0].factor };
                for term in &coupling.terms {
                    let joint = term.of.coordinate().expect("a coordinate").0;
                    let name = self.scene.joints[joint.index()].name.clone();
                    self.along(&name, term.factor * effort / by);
                }
            }
        }
    }

    /// The bodies of both wheels.
    fn wheels(&self) -> [usize; 2] {
        [self.named("one"), self.named("two")]
    }

    /// Position of a joint of the frame.
    fn on_frame(&self, joint: &Joint<f64>) -> Vector {
        self.bodies[self.named("frame")].at(joint.points[0])
    }

    /// The axis of the first wheel, and the sense of its joint's coordinate as a motion of the wheel.
    fn first(&self) -> (&'a Joint<f64>, Vector, f64) {
        let one = self.joint("one").0;
        (one, self.axis(one), self.sense(one, self.named("one")))
    }

    fn sense(&self, joint: &Joint<f64>, body: usize) -> f64 {
        if self.number(joint.bodies[1]) == body { 1.0 } else { -1.0 }
    }

    /// Applies the tooth force at the pitch point: a tangential part, and a separating part at 20 degrees.
    fn teeth(&mut self, effort: f64) {
        let (one, n, about) = self.first();
        let two = self.joint("two").0;
        let CouplingKind::Mesh(mesh) = &self.scene.couplings[0].kind else { panic!("no mesh") };
        let pitch = self.bodies[self.named("frame")].at(mesh.at);
        let [r1, r2] = [one, two].map(|joint| plus(pitch, -1.0, self.on_frame(joint)));
        let force = cross(n, r1).map(|x| about * effort * x / dot(r1, r1));
        let smaller = if size(r1) <= size(r2) { unit(r1).map(|x| -x) } else { unit(r2) };
        let apart = size(force) * 20.0_f64.to_radians().tan();
        let [one, two] = self.wheels();
        self.between([two, one], pitch, (plus(force, apart, smaller), [0.0; 3]));
    }

    /// Applies the belt forces along both common tangents: 200 N each, plus and minus half of the difference.
    fn strands(&mut self, effort: f64, is_crossed: bool) {
        let (one, n, about) = self.first();
        let [c1, c2] = [one, self.joint("two").0].map(|joint| self.on_frame(joint));
        let [r1, r2] = [0, 1].map(|k| self.scene.couplings[0].terms[k].factor.abs());
        let r2 = if is_crossed { -r2 } else { r2 };
        let way = plus(c2, -1.0, c1);
        let c = (r1 - r2) / size(way);
        let wheels = self.wheels();
        for side in [1.0, -1.0] {
            let across = cross(n, unit(way)).map(|x| side * x);
            let m = plus(unit(way).map(|x| c * x), (1.0 - c * c).sqrt(), across);
            let ends = [plus(c1, r1, m), plus(c2, r2, m)];
            let along = unit(plus(ends[1], -1.0, ends[0]));
            let turns = dot(n, cross(m, along)).signum() * about;
            let pull = along.map(|x| (200.0 + 0.5 * effort * turns) * x);
            self.bodies[wheels[0]].take(ends[0], pull, [0.0; 3]);
            self.bodies[wheels[1]].take(ends[1], pull.map(|x| -x), [0.0; 3]);
        }
    }

    /// Applies the thread force along the axis of the screw to its nut, and the moment about the axis.
    fn thread(&mut self, effort: f64) {
        let (one, n, about) = self.first();
        let (two, wheels) = (self.joint("two").0, self.wheels());
        let [per_turn, lead] = [0, 1].map(|k| self.scene.couplings[0].terms[k].factor);
        let along = self.sense(two, wheels[1]);
        let force = self.axis(two).map(|x| along * effort * x);
        let moment = n.map(|x| -about * effort * lead / per_turn * x);
        self.between(wheels, self.on_frame(one), (force, moment));
    }

    /// Applies the tension of the rope along its line, and at the rim of the drum.
    fn rope(&mut self, effort: f64) {
        let CouplingMeasure::Length { points } = &self.scene.couplings[0].terms[0].of else {
            panic!("no line")
        };
        let [rim, weight] = [0, 1].map(|k| self.bodies[self.number(points[k].0)].at(points[k].1));
        let pull = unit(plus(weight, -1.0, rim)).map(|x| effort * x);
        let wheels = self.wheels();
        self.bodies[wheels[0]].take(rim, pull, [0.0; 3]);
        self.bodies[wheels[1]].take(weight, pull.map(|x| -x), [0.0; 3]);
    }

    /// Largest missing force or moment on a body, relative to the largest force on any body [-].
    fn missing(&self) -> f64 {
        let largest = self.bodies.iter().fold(0.0_f64, |most, body| most.max(body.largest));
        let mut worst = 0.0_f64;
        for (k, joint) in self.machine.joints.iter().enumerate() {
            let of = &self.row[OF_BODY * k..];
            let body = self.named(joint.bodies[1]);
            let (data, placed) = (&self.scene.bodies[body], &self.bodies[body]);
            let gravity = self.scene.gravity.expect("gravity");
            let [a, w, alpha] = [12, 15, 18].map(|i| three(&of[i..]));
            let force = plus(placed.force, data.mass, plus(gravity, -1.0, a));
            let Inertia::Spatial([xx, yy, zz, xy, yz, zx]) = data.inertia else {
                panic!("inertia")
            };
            let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
            // `times` is the product of the rotated inertia R I R^T and a vector
            let r = &placed.rotation;
            let times = |x: Vector| {
                let own: Vector = core::array::from_fn(|i| (0..3).map(|j| r[j][i] * x[j]).sum());
                placed.turned(rows.map(|row| dot(row, own)))
            };
            let momentum = plus(times(alpha), 1.0, cross(w, times(w)));
            let moment = plus(placed.moment, -1.0, momentum);
            worst = worst.max(size(force) / largest).max(size(moment) / largest);
        }
        worst
    }
}

/// Largest relative missing force on a body of `machines` random machines, by a method.
fn worst(machines: u64, method: &dyn Fn(&Scene<f64>) -> Outcome) -> f64 {
    let mut worst = 0.0_f64;
    for seed in 0..machines {
        let mut random = Random::new(5000 + seed);
        let kind = seed as usize % COUPLED;
        let machine = machine(&mut random, kind);
        let wording = Wording::new(&mut random, &machine, Ways::ALL);
        let text = wording.moving_with(&machine, seed, &outputs(&machine));
        let scene = scene(&text);
        let outcome = method(&scene);
        assert_eq!(outcome.error, None, "{}\n{text}", machine.what);
        let row = &outcome.rows().last().expect("a row").1;
        let mut now = Instant::new(&scene, &machine, &wording, row);
        now.reactions();
        now.effects();
        now.coupling(kind);
        let missing = now.missing();
        println!("{seed} {}: {missing:.1e}", machine.what);
        worst = worst.max(missing);
    }
    worst
}

#[test]
fn every_body_is_in_balance_in_relative_coordinates() {
    let method = Method {
        formulation: Some("recursive".to_owned()),
        integrator: Some("rk853".to_owned()),
        step_max: Some(0.05),
        tolerance: Some(1e-11),
        ..Method::default()
    };
    let worst = worst(20 * COUPLED as u64, &|scene| run(scene, &method));
    assert!(worst < 1e-9, "{worst:e} of the largest force");
}

#[test]
fn every_body_is_in_balance_by_fixed_steps() {
    for formulation in mbs::FormulationKind::ALL.map(mbs::FormulationKind::name) {
        let worst = worst(2 * COUPLED as u64, &|scene| run_in(scene, formulation, Some(1e-3)));
        println!("{formulation}: {worst:e}");
        // augmented formulations satisfy velocities and accelerations only to the tolerance of their iterations
        let allowed =
            if formulation == "state-space" || formulation == "recursive" { 1e-9 } else { 1e-6 };
        assert!(worst < allowed, "{formulation}: {worst:e} of the largest force");
    }
}

//! Couplings that are drawn, against velocities where their parts touch: places and axes alone, by an oracle of its own.

use mbs_core::scene::Scene;
use mbs_scene::SceneFile;
use mbs_testkit::Random;

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

/// A joint as it is drawn: its second body moves against its first along its axis, or about it.
#[derive(Debug, Clone)]
struct Drawn {
    name: &'static str,
    bodies: [&'static str; 2],
    is_turn: bool,
    at: Vector,
    axis: Vector,
}

fn turn(name: &'static str, bodies: [&'static str; 2], at: Vector) -> Drawn {
    Drawn { name, bodies, is_turn: true, at, axis: [0.0, 0.0, 1.0] }
}

fn slide(name: &'static str, bodies: [&'static str; 2], at: Vector) -> Drawn {
    Drawn { name, bodies, is_turn: false, at, axis: [1.0, 0.0, 0.0] }
}

/// How far parts slip where they touch, by the velocities of the bodies.
type Slip = Box<dyn Fn(&dyn Fn(&str) -> Twist) -> f64>;

/// A machine, and what it has to keep at zero: how far its parts slip where they touch, by the velocities of its bodies.
struct Machine {
    what: &'static str,
    joints: Vec<Drawn>,
    coupling: String,
    slip: Slip,
}

/// Angular velocity, and the velocity of the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Twist(Vector, Vector);

impl Twist {
    fn at(self, place: Vector) -> Vector {
        plus(self.1, 1.0, cross(self.0, place))
    }
}

/// Velocities of the bodies from rates of the joints as they are drawn, outward from the ground.
fn twists(joints: &[Drawn], rates: &[f64]) -> Vec<(&'static str, Twist)> {
    let mut known = vec![("ground", Twist([0.0; 3], [0.0; 3]))];
    while known.len() <= joints.len() {
        for (joint, &rate) in joints.iter().zip(rates) {
            let of = |body: &str| known.iter().find(|(name, _)| *name == body).map(|(_, t)| *t);
            if let (Some(own), None) = (of(joint.bodies[0]), of(joint.bodies[1])) {
                let twist = if joint.is_turn {
                    let way = cross(joint.at, joint.axis);
                    Twist(plus(own.0, rate, joint.axis), plus(own.1, rate, way))
                } else {
                    Twist(own.0, plus(own.1, rate, joint.axis))
                };
                known.push((joint.bodies[1], twist));
            }
        }
    }
    known
}

const Z: Vector = [0.0, 0.0, 1.0];
/// From one wheel to the next, and across.
const WAY: Vector = [0.8, 0.6, 0.0];
const ACROSS: Vector = [-0.6, 0.8, 0.0];

/// Sizes of two parts, and where the first stands.
#[derive(Debug, Clone, Copy)]
struct Parts {
    r1: f64,
    r2: f64,
    one: Vector,
}

impl Parts {
    /// A place so far from the first part.
    fn apart(&self, distance: f64) -> Vector {
        plus(self.one, distance, WAY)
    }

    fn radii(&self) -> String {
        format!("joints = [\"one\", \"two\"]\nradii = [{:?}, {:?}]", self.r1, self.r2)
    }

    fn one(&self) -> Drawn {
        turn("one", ["frame", "one"], self.one)
    }
}

/// The velocity of one body against another at a place, along a direction.
fn touching(bodies: [&'static str; 2], place: Vector, along: Vector) -> Slip {
    Box::new(move |v| {
        let [a, b] = bodies.map(|body| v(body).at(place));
        dot(plus(a, -1.0, b), along)
    })
}

/// Two wheels in mesh.
fn gears(of: Parts, kind: usize) -> Machine {
    let other = of.apart(of.r1 + of.r2);
    let coupling = format!("kind = \"gear\"\n{}", of.radii());
    let arm = turn("arm", ["frame", "arm"], of.one);
    let slip = touching(["one", "two"], of.apart(of.r1), ACROSS);
    let (what, joints) = match kind {
        0 => ("gears", vec![of.one(), turn("two", ["frame", "two"], other)]),
        1 => ("planet on an arm", vec![of.one(), arm, turn("two", ["arm", "two"], other)]),
        2 => (
            "arms about both axes",
            vec![
                of.one(),
                arm,
                turn("fork", ["arm", "fork"], other),
                turn("two", ["fork", "two"], other),
            ],
        ),
        3 => {
            let joints =
                vec![turn("one", ["frame", "arm"], of.one), turn("two", ["arm", "two"], other)];
            let slip = touching(["frame", "two"], of.apart(of.r1), ACROSS);
            return Machine { what: "sun held by the frame", joints, coupling, slip };
        }
        _ => {
            let inside = Parts { r2: 0.4 * of.r1, ..of };
            let joints = vec![of.one(), turn("two", ["frame", "two"], of.apart(0.6 * of.r1))];
            let coupling = format!("kind = \"gear\"\n{}\nmesh = \"internal\"", inside.radii());
            return Machine { what: "wheel in a ring", joints, coupling, slip };
        }
    };
    Machine { what, joints, coupling, slip }
}

/// Two wheels whose strand runs straight from rim to rim.
fn belt(of: Parts, is_crossed: bool) -> Machine {
    let d = of.r1 + of.r2 + 0.5;
    let r2 = if is_crossed { -of.r2 } else { of.r2 };
    // a normal to the strand, which both rims have
    let c = (of.r1 - r2) / d;
    let n = plus(plus([0.0; 3], c, WAY), (1.0 - c * c).sqrt(), ACROSS);
    let ends = [plus(of.one, of.r1, n), plus(of.apart(d), r2, n)];
    let strand = plus(ends[1], -1.0, ends[0]);
    Machine {
        what: if is_crossed { "crossed belt" } else { "belt" },
        joints: vec![of.one(), turn("two", ["frame", "two"], of.apart(d))],
        coupling: format!("kind = \"belt\"\n{}\ncrossed = {is_crossed}", of.radii()),
        slip: Box::new(move |v| {
            dot(v("one").at(ends[0]), strand) - dot(v("two").at(ends[1]), strand)
        }),
    }
}

/// A pinion with a rack along x, above it or below.
fn rack(of: Parts, kind: usize) -> Machine {
    let side = if kind == 0 { -of.r1 } else { of.r1 };
    let line = plus(of.one, side, [0.0, 1.0, 0.0]);
    let coupling = format!("kind = \"rack\"\njoints = [\"one\", \"two\"]\nradius = {:?}", of.r1);
    let along = plus(line, 0.7, [1.0, 0.0, 0.0]);
    let on_cart = turn("one", ["cart", "one"], of.one);
    let (what, joints, other) = match kind {
        0 | 1 => ("rack", vec![of.one(), slide("two", ["frame", "two"], along)], "two"),
        2 => (
            "pinion on a cart, rack on the frame",
            vec![
                slide("cart", ["frame", "cart"], of.one),
                on_cart,
                slide("two", ["frame", "two"], along),
            ],
            "two",
        ),
        _ => (
            "pinion on a cart that runs along a rack",
            vec![slide("two", ["frame", "cart"], line), on_cart],
            "frame",
        ),
    };
    Machine { what, joints, coupling, slip: touching(["one", other], line, [1.0, 0.0, 0.0]) }
}

/// A screw that turns and a nut that slides.
fn screw(of: Parts) -> Machine {
    let lead = of.r1;
    Machine {
        what: "screw",
        joints: vec![of.one(), Drawn { axis: Z, ..slide("two", ["frame", "two"], of.apart(1.0)) }],
        coupling: format!("kind = \"screw\"\njoints = [\"one\", \"two\"]\nlead = {lead:?}"),
        slip: Box::new(move |v| {
            let frame = v("frame");
            let turns = dot(plus(v("one").0, -1.0, frame.0), Z) / core::f64::consts::TAU;
            let at = of.apart(1.0);
            dot(plus(v("two").at(at), -1.0, frame.at(at)), Z) - lead * turns
        }),
    }
}

/// Wheels beside a cage, on the frame or one of them on the cage.
fn differential(of: Parts, is_on_cage: bool) -> Machine {
    let own = if is_on_cage { "cage" } else { "frame" };
    Machine {
        what: if is_on_cage { "sun on the carrier" } else { "half shafts" },
        joints: vec![
            turn("cage", ["frame", "cage"], of.one),
            turn("one", [own, "one"], plus(of.one, 1.0, Z)),
            turn("two", ["frame", "two"], plus(of.one, -1.0, Z)),
        ],
        coupling:
            "kind = \"differential\"\njoints = [\"one\", \"two\", \"cage\"]\nteeth = [20, 30]"
                .to_owned(),
        slip: Box::new(move |v| {
            let [a, b] = ["one", "two"].map(|wheel| dot(plus(v(wheel).0, -1.0, v("cage").0), Z));
            20.0 * a + 30.0 * b
        }),
    }
}

/// A machine of one of the kinds, with parts of random sizes, on a frame that turns on a base that slides.
fn machine(random: &mut Random, kind: usize) -> Machine {
    let mut size = || 0.6 + 0.4 * random.next();
    let of = Parts { r1: size(), r2: size(), one: [0.3, size(), 0.0] };
    let base = slide("base", ["ground", "base"], [0.0, size(), 0.0]);
    let swing = turn("swing", ["base", "frame"], [-3.0, size(), 0.0]);
    let mut machine = match kind {
        0..5 => gears(of, kind),
        5 | 6 => belt(of, kind == 6),
        7..11 => rack(of, kind - 7),
        11 => screw(of),
        _ => differential(of, kind == 13),
    };
    machine.joints.splice(0..0, [base, swing]);
    machine
}

/// The machine as a file may have it: joints in any order, their bodies too, axes of any length and sense, the whole turned.
fn scene(random: &mut Random, machine: &Machine) -> (Scene<f64>, Vec<(String, f64)>) {
    let mut frame = [[0.0; 3]; 3];
    let any = |random: &mut Random| [0; 3].map(|_| random.next());
    let unit = |a: Vector| plus([0.0; 3], 1.0 / dot(a, a).sqrt(), a);
    frame[0] = unit(any(random));
    let second = any(random);
    frame[1] = unit(plus(second, -dot(second, frame[0]), frame[0]));
    frame[2] = cross(frame[0], frame[1]);
    let turned = |a: Vector| (0..3).fold([0.0; 3], |sum, i| plus(sum, a[i], frame[i]));
    let mut order: Vec<usize> = (0..machine.joints.len()).collect();
    for i in (1..order.len()).rev() {
        order.swap(i, random.below(i + 1));
    }
    let mut text = "[scene]\ndimension = 3\nduration = 1.0\n".to_owned();
    let (mut joints, mut signs) = (String::new(), Vec::new());
    for joint in order.into_iter().map(|i| &machine.joints[i]) {
        let body = joint.bodies[1];
        text += &format!(
            "[[body]]\nname = \"{body}\"\nmass = 1.0\ncenter = [0, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n"
        );
        let is_swapped = random.next() > 0.0;
        let size = 2.0 * random.next();
        let [mut a, mut b] = joint.bodies;
        if is_swapped {
            (a, b) = (b, a);
        }
        let kind = if joint.is_turn { "revolute" } else { "prismatic" };
        joints += &format!(
            "[[joint]]\nname = \"{}\"\nkind = \"{kind}\"\nbodies = [\"{a}\", \"{b}\"]\nat = {:?}\naxis = {:?}\n",
            joint.name,
            turned(joint.at),
            turned(plus([0.0; 3], size, joint.axis)),
        );
        signs.push((joint.name.to_owned(), if is_swapped == (size > 0.0) { -1.0 } else { 1.0 }));
    }
    let text = format!("{text}{joints}[[coupling]]\n{}\n", machine.coupling);
    let file = SceneFile::parse(&text, "x.toml").unwrap_or_else(|e| panic!("{}", e.render()));
    let scene = file.scene().unwrap_or_else(|e| panic!("{}: {}", machine.what, e.render()));
    (scene, signs)
}

#[test]
fn parts_of_what_is_drawn_do_not_slip_where_they_touch() {
    let mut random = Random::new(22);
    for k in 0..700 {
        let machine = machine(&mut random, k % 14);
        let (scene, signs) = scene(&mut random, &machine);
        let mut factor = None;
        for _ in 0..6 {
            let rates: Vec<f64> = machine.joints.iter().map(|_| random.next()).collect();
            let known = twists(&machine.joints, &rates);
            let of = |body: &str| known.iter().find(|(name, _)| *name == body).expect("a body").1;
            let slip = (machine.slip)(&of);
            // the same rates in the coordinates of the file
            let rate = |joint: usize| {
                let name = &scene.joints[joint].name;
                let place = machine.joints.iter().position(|joint| joint.name == name);
                let sign = signs.iter().find(|(of, _)| of == name).expect("a joint").1;
                sign * rates[place.expect("a joint")]
            };
            let terms = scene.couplings[0].terms.iter();
            let sum: f64 = terms
                .map(|term| {
                    term.factor * rate(term.of.coordinate().expect("a coordinate").0.index())
                })
                .sum();
            let scale: f64 = *factor.get_or_insert(slip / sum);
            assert!(
                (slip - scale * sum).abs() < 1e-9 * (1.0 + slip.abs()),
                "{}: {slip} and {sum}, {:?}",
                machine.what,
                scene.couplings[0]
            );
        }
    }
}

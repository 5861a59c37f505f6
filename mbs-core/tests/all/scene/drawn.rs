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

/// A machine, and what it has to keep at zero: how far its parts slip where they touch, by the velocities of its bodies.
struct Machine {
    what: &'static str,
    joints: Vec<Drawn>,
    coupling: String,
    slip: Box<dyn Fn(&dyn Fn(&str) -> Twist) -> f64>,
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

/// A machine of one of the kinds, with parts of random sizes, on a body that moves, or on the ground.
fn machine(random: &mut Random, kind: usize) -> Machine {
    let mut size = || 0.6 + 0.4 * random.next();
    let (r1, r2) = (size(), size());
    // a base that turns elsewhere, and a cart
    let base = slide("base", ["ground", "base"], [0.0, size(), 0.0]);
    let swing = turn("swing", ["base", "frame"], [-3.0, size(), 0.0]);
    let (first, z) = ([0.3, size(), 0.0], [0.0, 0.0, 1.0]);
    let apart = move |d: f64| plus(first, d, [0.8, 0.6, 0.0]);
    let (one, other) = (first, apart(r1 + r2));
    let along = [-0.6, 0.8, 0.0];
    let pitch = |p: Vector, t: Vector| {
        move |v: &dyn Fn(&str) -> Twist| dot(plus(v("one").at(p), -1.0, v("two").at(p)), t)
    };
    let frames = vec![base, swing];
    let with = |joints: Vec<Drawn>| [frames.clone(), joints].concat();
    let radii = format!("radii = [{r1:?}, {r2:?}]");
    let gear = |more: &str| format!("kind = \"gear\"\njoints = [\"one\", \"two\"]\n{radii}{more}");
    let arm = |at: Vector| turn("arm", ["frame", "arm"], at);
    match kind {
        0 => Machine {
            what: "gears",
            joints: with(vec![
                turn("one", ["frame", "one"], one),
                turn("two", ["frame", "two"], other),
            ]),
            coupling: gear(""),
            slip: Box::new(pitch(apart(r1), along)),
        },
        1 => {
            let r2 = r1 * 0.4;
            let centre = apart(r1 - r2);
            Machine {
                what: "wheel in a ring",
                joints: with(vec![
                    turn("one", ["frame", "one"], one),
                    turn("two", ["frame", "two"], centre),
                ]),
                coupling: format!(
                    "kind = \"gear\"\njoints = [\"one\", \"two\"]\nradii = [{r1:?}, {r2:?}]\nmesh = \"internal\""
                ),
                slip: Box::new(pitch(apart(r1), along)),
            }
        }
        2 => Machine {
            what: "planet on an arm",
            joints: with(vec![
                turn("one", ["frame", "one"], one),
                arm(one),
                turn("two", ["arm", "two"], other),
            ]),
            coupling: gear(""),
            slip: Box::new(pitch(apart(r1), along)),
        },
        3 => Machine {
            what: "sun held by the arm's joint",
            joints: with(vec![
                turn("one", ["frame", "arm"], one),
                turn("two", ["arm", "two"], other),
            ]),
            coupling: gear(""),
            slip: Box::new(move |v| {
                let p = apart(r1);
                dot(plus(v("frame").at(p), -1.0, v("two").at(p)), along)
            }),
        },
        4 => Machine {
            what: "arms about both axes",
            joints: with(vec![
                turn("one", ["frame", "one"], one),
                arm(one),
                turn("fork", ["arm", "fork"], other),
                turn("two", ["fork", "two"], other),
            ]),
            coupling: gear(""),
            slip: Box::new(pitch(apart(r1), along)),
        },
        5 | 6 => {
            let is_crossed = kind == 6;
            let d = r1 + r2 + 0.5;
            let centre = apart(d);
            // the strand leaves the wheels at angles ± acos((r1 ∓ r2)/d) from the way between the axes
            let share: f64 = if is_crossed { (r1 + r2) / d } else { (r1 - r2) / d };
            let (c, s) = (share, (1.0 - share * share).sqrt());
            let n = plus(plus([0.0; 3], c, [0.8, 0.6, 0.0]), s, along);
            let on_first = plus(one, r1, n);
            let on_second = plus(centre, if is_crossed { -r2 } else { r2 }, n);
            let strand = plus(on_second, -1.0, on_first);
            let length = dot(strand, strand).sqrt();
            Machine {
                what: if is_crossed { "crossed belt" } else { "belt" },
                joints: with(vec![
                    turn("one", ["frame", "one"], one),
                    turn("two", ["frame", "two"], centre),
                ]),
                coupling: format!(
                    "kind = \"belt\"\njoints = [\"one\", \"two\"]\n{radii}\ncrossed = {is_crossed}"
                ),
                slip: Box::new(move |v| {
                    let u = plus([0.0; 3], 1.0 / length, strand);
                    dot(v("one").at(on_first), u) - dot(v("two").at(on_second), u)
                }),
            }
        }
        7 | 8 => {
            let side = if kind == 7 { r1 } else { -r1 };
            let line = plus(one, side, [0.0, 1.0, 0.0]);
            Machine {
                what: "rack",
                joints: with(vec![
                    turn("one", ["frame", "one"], one),
                    slide("two", ["frame", "two"], plus(line, 0.7, [1.0, 0.0, 0.0])),
                ]),
                coupling: format!("kind = \"rack\"\njoints = [\"one\", \"two\"]\nradius = {r1:?}"),
                slip: Box::new(pitch(line, [1.0, 0.0, 0.0])),
            }
        }
        9 => {
            let line = plus(one, r1, [0.0, 1.0, 0.0]);
            Machine {
                what: "pinion on a cart, rack on the frame",
                joints: with(vec![
                    slide("cart", ["frame", "cart"], one),
                    turn("one", ["cart", "one"], one),
                    slide("two", ["frame", "two"], line),
                ]),
                coupling: format!("kind = \"rack\"\njoints = [\"one\", \"two\"]\nradius = {r1:?}"),
                slip: Box::new(pitch(line, [1.0, 0.0, 0.0])),
            }
        }
        10 => {
            let line = plus(one, r1, [0.0, 1.0, 0.0]);
            Machine {
                what: "pinion on a cart that runs along a rack",
                joints: with(vec![
                    slide("two", ["frame", "cart"], line),
                    turn("one", ["cart", "one"], one),
                ]),
                coupling: format!("kind = \"rack\"\njoints = [\"one\", \"two\"]\nradius = {r1:?}"),
                slip: Box::new(move |v| plus(v("one").at(line), -1.0, v("frame").at(line))[0]),
            }
        }
        11 => Machine {
            what: "screw that turns, nut that slides",
            joints: with(vec![
                turn("one", ["frame", "one"], one),
                Drawn { axis: z, ..slide("two", ["frame", "two"], other) },
            ]),
            coupling: format!("kind = \"screw\"\njoints = [\"one\", \"two\"]\nlead = {r1:?}"),
            slip: Box::new(move |v| {
                let turns = dot(plus(v("one").0, -1.0, v("frame").0), z) / core::f64::consts::TAU;
                dot(plus(v("two").at(other), -1.0, v("frame").at(other)), z) - r1 * turns
            }),
        },
        12 => Machine {
            what: "half shafts on the housing",
            joints: with(vec![
                turn("one", ["frame", "one"], plus(one, 1.0, z)),
                turn("two", ["frame", "two"], plus(one, -1.0, z)),
                turn("cage", ["frame", "cage"], one),
            ]),
            coupling:
                "kind = \"differential\"\njoints = [\"one\", \"two\", \"cage\"]\nteeth = [20, 30]"
                    .to_owned(),
            slip: Box::new(move |v| {
                let [a, b] = ["one", "two"].map(|w| dot(plus(v(w).0, -1.0, v("cage").0), z));
                20.0 * a + 30.0 * b
            }),
        },
        _ => Machine {
            what: "sun and ring on the carrier",
            joints: with(vec![
                turn("cage", ["frame", "cage"], one),
                turn("one", ["cage", "one"], plus(one, 1.0, z)),
                turn("two", ["frame", "two"], plus(one, -1.0, z)),
            ]),
            coupling: "kind = \"differential\"\njoints = [\"one\", \"two\", \"cage\"]".to_owned(),
            slip: Box::new(move |v| {
                let [a, b] = ["one", "two"].map(|w| dot(plus(v(w).0, -1.0, v("cage").0), z));
                a + b
            }),
        },
    }
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

//! Random machines with couplings, as a user may write them: each can be told in several ways that mean the same.

use crate::Random;

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
pub struct Drawn {
    /// Its name.
    pub name: &'static str,
    /// Its bodies, the first nearer to the ground.
    pub bodies: [&'static str; 2],
    /// Is it a turn? Otherwise a slide.
    pub is_turn: bool,
    /// Its place.
    pub at: Vector,
    /// Its axis.
    pub axis: Vector,
}

fn turn(name: &'static str, bodies: [&'static str; 2], at: Vector) -> Drawn {
    Drawn { name, bodies, is_turn: true, at, axis: [0.0, 0.0, 1.0] }
}

fn slide(name: &'static str, bodies: [&'static str; 2], at: Vector) -> Drawn {
    Drawn { name, bodies, is_turn: false, at, axis: [1.0, 0.0, 0.0] }
}

/// How far parts slip where they touch, by the velocities of the bodies.
pub type Slip = Box<dyn Fn(&dyn Fn(&str) -> Twist) -> f64>;

/// The text of a coupling as it is told.
pub type Written = Box<dyn Fn(&Telling) -> String>;

/// A machine, and what it has to keep at zero: how far its parts slip where they touch, by the velocities of its bodies.
pub struct Machine {
    /// What it is.
    pub what: &'static str,
    /// Its joints.
    pub joints: Vec<Drawn>,
    /// Its coupling.
    pub coupling: Written,
    /// How far its parts slip.
    pub slip: Slip,
}

impl core::fmt::Debug for Machine {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Machine")
            .field("what", &self.what)
            .field("joints", &self.joints)
            .finish_non_exhaustive()
    }
}

/// Angular velocity, and the velocity of the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist(pub Vector, pub Vector);

impl Twist {
    /// The velocity at a place.
    #[must_use]
    pub fn at(self, place: Vector) -> Vector {
        plus(self.1, 1.0, cross(self.0, place))
    }
}

/// Velocities of the bodies from rates of the joints as they are drawn, outward from the ground.
#[must_use]
pub fn twists(joints: &[Drawn], rates: &[f64]) -> Vec<(&'static str, Twist)> {
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

    /// Wheels of these radii in mesh, with their pitch point.
    fn in_mesh(self, head: &'static str) -> Written {
        let wheels = self.by_radii(head);
        Box::new(move |told| {
            format!("{}\nat = {:?}", wheels(told), told.place(self.apart(self.r1)))
        })
    }

    /// A belt on wheels of these radii.
    fn with_strands(self, head: &'static str) -> Written {
        let wheels = self.by_radii(head);
        Box::new(move |told| format!("{}\npretension = {:?}", wheels(told), 200.0 * told.metre))
    }

    /// A coupling of both parts by their radii.
    fn by_radii(self, head: &'static str) -> Written {
        Box::new(move |told| {
            let [r1, r2] = [self.r1, self.r2].map(|r| r * told.metre);
            format!("{head}\njoints = [\"one\", \"two\"]\nradii = [{r1:?}, {r2:?}]")
        })
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
    let coupling = of.by_radii("kind = \"gear\"");
    let arm = turn("arm", ["frame", "arm"], of.one);
    let slip = touching(["one", "two"], of.apart(of.r1), ACROSS);
    let (what, joints) = match kind {
        0 => {
            let joints = vec![of.one(), turn("two", ["frame", "two"], other)];
            let coupling = of.in_mesh("kind = \"gear\"");
            return Machine { what: "gears", joints, coupling, slip };
        }
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
            let coupling = inside.in_mesh("kind = \"gear\"\nmesh = \"internal\"");
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
        coupling: of.with_strands(if is_crossed {
            "kind = \"belt\"\ncrossed = true"
        } else {
            "kind = \"belt\""
        }),
        slip: Box::new(move |v| {
            dot(v("one").at(ends[0]), strand) - dot(v("two").at(ends[1]), strand)
        }),
    }
}

/// A pinion with a rack along x, above it or below.
fn rack(of: Parts, kind: usize) -> Machine {
    let side = if kind == 0 { -of.r1 } else { of.r1 };
    let line = plus(of.one, side, [0.0, 1.0, 0.0]);
    let coupling = Box::new(move |told: &Telling| {
        let radius = of.r1 * told.metre;
        format!("kind = \"rack\"\njoints = [\"one\", \"two\"]\nradius = {radius:?}")
    });
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
        coupling: Box::new(move |told| {
            let lead = lead * told.metre;
            format!("kind = \"screw\"\njoints = [\"one\", \"two\"]\nlead = {lead:?}")
        }),
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
        coupling: Box::new(|_| {
            "kind = \"differential\"\njoints = [\"one\", \"two\", \"cage\"]\nteeth = [20, 30]"
                .to_owned()
        }),
        slip: Box::new(move |v| {
            let [a, b] = ["one", "two"].map(|wheel| dot(plus(v(wheel).0, -1.0, v("cage").0), Z));
            20.0 * a + 30.0 * b
        }),
    }
}

/// A drum and a weight on a slide, on a rope that leaves the drum at its rim.
fn winch(of: Parts) -> Machine {
    let (rim, weight) = (of.apart(of.r1), plus(of.apart(of.r1), -3.0, ACROSS));
    Machine {
        what: "winch",
        joints: vec![of.one(), Drawn { axis: ACROSS, ..slide("two", ["frame", "two"], weight) }],
        coupling: Box::new(move |told| {
            // the line grows down from the rim as the drum turns against the sense of z
            let radius = of.r1 * told.metre * told.sense("one");
            format!(
                "kind = \"rope\"\npoints = [{{ body = \"frame\", at = {:?} }}, {{ body = \"two\", at = {:?} }}]\n\
                 drum = {{ joint = \"one\", radius = {radius:?} }}",
                told.place(rim),
                told.place(weight)
            )
        }),
        slip: Box::new(move |v| {
            let [drum, weight, frame] =
                [("one", rim), ("two", weight), ("frame", weight)].map(|(body, at)| v(body).at(at));
            let carried = v("frame").at(rim);
            dot(plus(drum, -1.0, carried), ACROSS) - dot(plus(weight, -1.0, frame), ACROSS)
        }),
    }
}

/// How many kinds of machines there are.
pub const KINDS: usize = 15;

/// A machine of one of the kinds, with parts of random sizes, on a frame that turns on a base that slides.
///
/// # Panics
/// Never.
pub fn machine(random: &mut Random, kind: usize) -> Machine {
    let mut size = || 0.6 + 0.4 * random.next();
    let of = Parts { r1: size(), r2: size(), one: [0.3, size(), 0.0] };
    let base = slide("base", ["ground", "base"], [0.0, size(), 0.0]);
    let swing = turn("swing", ["base", "frame"], [-3.0, size(), 0.0]);
    let mut machine = match kind {
        0..5 => gears(of, kind),
        5 | 6 => belt(of, kind == 6),
        7..11 => rack(of, kind - 7),
        11 => screw(of),
        12 | 13 => differential(of, kind == 13),
        _ => winch(of),
    };
    machine.joints.splice(0..0, [base, swing]);
    machine
}

/// In which ways a machine is told otherwise than it is drawn.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ways {
    /// The bodies of joints in either order.
    pub swaps: bool,
    /// Axes of any length and sense.
    pub reverses: bool,
    /// Bodies and joints in any order.
    pub shuffles: bool,
    /// The whole turned.
    pub turns: bool,
    /// Lengths in millimetres.
    pub millimetres: bool,
}

impl Ways {
    /// All but the unit of length.
    pub const ALL: Self =
        Self { swaps: true, reverses: true, shuffles: true, turns: true, millimetres: false };
}

/// A machine in words: joints in any order, their bodies too, axes of any length and sense, the whole turned, in another unit.
#[derive(Debug, Clone)]
pub struct Telling {
    /// Units of length in a metre.
    pub metre: f64,
    /// The axes of the machine.
    axes: [Vector; 3],
    /// Of each joint its name, whether its bodies are swapped, and the length of its axis.
    joints: Vec<(&'static str, bool, f64)>,
}

impl Telling {
    /// Tells a machine in some ways.
    pub fn new(random: &mut Random, machine: &Machine, ways: Ways) -> Self {
        let unit = |a: Vector| plus([0.0; 3], 1.0 / dot(a, a).sqrt(), a);
        let mut any = || [0; 3].map(|_| random.next());
        let (first, second) = (unit(any()), any());
        let second = unit(plus(second, -dot(second, first), first));
        let turned = [first, second, cross(first, second)];
        let axes = if ways.turns { turned } else { [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], Z] };
        let mut joints: Vec<_> = machine
            .joints
            .iter()
            .map(|joint| {
                let (swap, size) = (random.next() > 0.0, 2.0 * random.next());
                let size = if ways.reverses { size } else { 1.0 };
                (joint.name, ways.swaps && swap, size)
            })
            .collect();
        if ways.shuffles {
            for i in (1..joints.len()).rev() {
                joints.swap(i, random.below(i + 1));
            }
        }
        Self { metre: if ways.millimetres { 1000.0 } else { 1.0 }, axes, joints }
    }

    /// A direction.
    #[must_use]
    pub fn turned(&self, a: Vector) -> Vector {
        (0..3).fold([0.0; 3], |sum, i| plus(sum, a[i], self.axes[i]))
    }

    /// A place.
    #[must_use]
    pub fn place(&self, at: Vector) -> Vector {
        self.turned(at).map(|x| x * self.metre)
    }

    /// A direction as it was drawn.
    #[must_use]
    pub fn back(&self, a: Vector) -> Vector {
        self.axes.map(|axis| dot(axis, a))
    }

    /// The sign of a joint's coordinate beside that of the drawn one.
    ///
    /// # Panics
    /// Without such a joint.
    #[must_use]
    pub fn sense(&self, joint: &str) -> f64 {
        let (_, swap, size) = self.joints.iter().find(|(of, ..)| *of == joint).expect("a joint");
        if *swap == (*size > 0.0) { -1.0 } else { 1.0 }
    }

    /// The joints in their order, each with its body; bodies by `body`, which is given the name and the joint's place.
    ///
    /// # Panics
    /// Never: it has the joints of its machine.
    #[must_use]
    pub fn parts(&self, machine: &Machine, body: impl Fn(&str, Vector) -> String) -> String {
        let (mut bodies, mut joints) = (String::new(), String::new());
        for &(name, swap, size) in &self.joints {
            let of = |joint: &&Drawn| joint.name == name;
            let joint = machine.joints.iter().find(of).expect("a joint of the machine");
            bodies += &body(joint.bodies[1], joint.at);
            let [mut a, mut b] = joint.bodies;
            if swap {
                (a, b) = (b, a);
            }
            let kind = if joint.is_turn { "revolute" } else { "prismatic" };
            joints += &format!(
                "[[joint]]\nname = \"{name}\"\nkind = \"{kind}\"\nbodies = [\"{a}\", \"{b}\"]\nat = {:?}\naxis = {:?}\n",
                self.place(joint.at),
                self.turned(plus([0.0; 3], size, joint.axis)),
            );
        }
        format!("{bodies}{joints}[[coupling]]\nname = \"link\"\n{}\n", (machine.coupling)(self))
    }

    /// The machine with masses, weight, springs, a motor on a controller, and speeds: of the same seed the same in whatever way it is told.
    #[must_use]
    pub fn moving(&self, machine: &Machine, seed: u64) -> String {
        let outputs = machine.joints.iter().map(|joint| {
            let body = joint.bodies[1];
            ["position", "angular-velocity"].map(|quantity| {
                format!("[[output]]\nname = \"{body} {quantity}\"\nbody = \"{body}\"\nquantity = \"{quantity}\"\n")
            })
        });
        self.moving_with(machine, seed, &outputs.flatten().collect::<String>())
    }

    /// The same with other outputs.
    #[must_use]
    pub fn moving_with(&self, machine: &Machine, seed: u64, outputs: &str) -> String {
        let m = self.metre;
        let body = |name: &str, at: Vector| self.body(name, at, seed);
        let parts = self.parts(machine, body);
        let (damping, sense) = (0.3 * m * m, self.sense("one"));
        let gravity = self.place([0.7, -9.0, 2.0]);
        let [from, to] = [[1.0, 2.0, 0.5], [0.2, 1.1, 0.1]];
        let free = 0.8 * dot(plus(from, -1.0, to), plus(from, -1.0, to)).sqrt() * m;
        let rates = [("base", 0.4 * m), ("swing", 0.7), ("one", 3.0)].map(|(joint, rate)| {
            let (value, rate) = (0.0, rate * self.sense(joint));
            format!("[[initial]]\njoint = \"{joint}\"\nvalue = {value:?}\nrate = {rate:?}\n")
        });
        format!(
            "[scene]\ndimension = 3\nduration = 0.2\ngravity = {gravity:?}\n{parts}{}\
             [[effect]]\nkind = \"torsion-spring\"\njoint = \"swing\"\nstiffness = {:?}\ndamping = {damping:?}\n\
             [[effect]]\nkind = \"spring-damper\"\nbodies = [\"ground\", \"frame\"]\npoints = [{:?}, {:?}]\nstiffness = 40.0\n\
             free_length = {free:?}\n\
             [[signal]]\nname = \"turn\"\nkind = \"measure\"\njoint = \"one\"\n\
             [[signal]]\nname = \"wanted\"\nkind = \"constant\"\nvalue = {:?}\n\
             [[signal]]\nname = \"asked\"\nkind = \"pid\"\ntarget = \"wanted\"\nmeasured = \"turn\"\np = {:?}\ni = {:?}\nd = {:?}\n\
             [[effect]]\nkind = \"torque\"\njoint = \"one\"\nsignal = \"asked\"\n{outputs}",
            rates.concat(),
            30.0 * m * m,
            self.place(from),
            self.place(to),
            0.4 * sense,
            6.0 * m * m,
            2.0 * m * m,
            0.2 * m * m,
        )
    }

    /// A body near a place, with mass and axes of inertia by its name.
    fn body(&self, name: &str, at: Vector, seed: u64) -> String {
        let sum = name.bytes().fold(seed, |sum, byte| sum.wrapping_mul(31) + u64::from(byte));
        let mut random = Random::new(sum);
        let mass = 1.5 + random.next();
        let center = plus(at, 0.3, [0; 3].map(|_| random.next()));
        let [a, b, c] =
            [0; 3].map(|_| mass * (0.06 + 0.02 * random.next()) * self.metre * self.metre);
        // principal moments about the drawn axes
        let entry = |i: usize, j: usize| {
            let products = self.axes.map(|axis| axis[i] * axis[j]);
            a * products[0] + b * products[1] + c * products[2]
        };
        let [xx, yy, zz] = [0, 1, 2].map(|i| entry(i, i));
        format!(
            "[[body]]\nname = \"{name}\"\nmass = {mass:?}\ncenter = {:?}\ninertia = {:?}\n",
            self.place(center),
            [xx, yy, zz, entry(0, 1), entry(1, 2), entry(2, 0)]
        )
    }
}

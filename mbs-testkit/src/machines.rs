//! Random machines with a coupling or a wheel that rolls, as a user may write them: each can be worded in several ways that mean the same.

pub mod kinds;

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
    /// Name of the joint.
    pub name: &'static str,
    /// Bodies of the joint, the first nearer to the ground.
    pub bodies: [&'static str; 2],
    /// Is it a turn? Otherwise a slide.
    pub is_turn: bool,
    /// Place of the joint.
    pub at: Vector,
    /// Axis of the joint.
    pub axis: Vector,
}

fn turn(name: &'static str, bodies: [&'static str; 2], at: Vector) -> Drawn {
    Drawn { name, bodies, is_turn: true, at, axis: [0.0, 0.0, 1.0] }
}

fn slide(name: &'static str, bodies: [&'static str; 2], at: Vector) -> Drawn {
    Drawn { name, bodies, is_turn: false, at, axis: [1.0, 0.0, 0.0] }
}

/// Slip of parts where they touch, by the velocities of the bodies.
pub type Slip = Box<dyn Fn(&dyn Fn(&str) -> Twist) -> f64>;

/// The text of a coupling, or of what rolls, in a wording.
pub type Written = Box<dyn Fn(&Wording) -> String>;

/// A machine, and what it has to keep at zero: how far its parts slip where they touch, by the velocities of its bodies.
pub struct Machine {
    /// Description of the machine.
    pub what: &'static str,
    /// Joints of the machine.
    pub joints: Vec<Drawn>,
    /// Coupling of the machine, or what rolls.
    pub coupling: Written,
    /// Slip of the parts of the machine where they touch.
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

/// Ways in which a machine is worded otherwise than it is drawn.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ways {
    /// The bodies of joints in either order.
    pub swaps: bool,
    /// Axes of any length and sense.
    pub reverses: bool,
    /// Bodies and joints in any order.
    pub shuffles: bool,
    /// The whole machine turned.
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
pub struct Wording {
    /// Units of length in a metre.
    pub metre: f64,
    /// The axes of the machine.
    axes: [Vector; 3],
    /// Joints, each with its name, whether its bodies are swapped, and the length of its axis.
    joints: Vec<(&'static str, bool, f64)>,
}

impl Wording {
    /// Returns the wording of a machine in some ways.
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

    /// A direction in the axes of the wording.
    #[must_use]
    pub fn turned(&self, a: Vector) -> Vector {
        (0..3).fold([0.0; 3], |sum, i| plus(sum, a[i], self.axes[i]))
    }

    /// A place in the axes and the unit of the wording.
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
        format!("{bodies}{joints}{}\n", (machine.coupling)(self))
    }

    /// The machine with masses, weight, springs, a motor on a controller, and speeds: of the same seed the same in whatever way it is wording.
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

    /// The machine of [`Self::moving`] with other outputs.
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

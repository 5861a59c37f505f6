//! Coordinates that can be states of a linear motion: first the coordinates of joints, then positions and rotations of bodies.

use crate::record::Channel;
use mbs_core::outputs::Target;
use mbs_core::scene::{BodyId, Dimension, Freedom, JointId, Output, Quantity, Scene};

/// Index of the first coordinate of a ball joint, and the two bodies of the joint; `None` stands for the ground.
pub(super) type Ball = (usize, [Option<usize>; 2]);

/// The coordinates that can be states.
pub(super) struct Coordinates {
    /// Value, rate and acceleration of each coordinate or vector.
    pub(super) quantities: Vec<[Output<f64>; 3]>,
    /// For each component: its name, its unit, and whether it belongs to a rotation vector.
    pub(super) names: Vec<String>,
    pub(super) units: Vec<&'static str>,
    pub(super) turns: Vec<bool>,
    pub(super) n_of_joints: usize,
    /// True for each joint coordinate that belongs to a ball joint or to a joint with two translations.
    pub(super) of_vectors: Vec<bool>,
    /// First index and number of components of each vector in global axes.
    pub(super) vectors: Vec<[usize; 2]>,
    /// Index of the first rotation coordinate of each body.
    pub(super) rotations: Vec<usize>,
    pub(super) balls: Vec<Ball>,
}

impl Coordinates {
    /// Lists the coordinates of all joints, then the centres of mass and rotations of all bodies.
    pub(super) fn new(scene: &Scene<f64>) -> Self {
        let mut all = Self {
            quantities: Vec::new(),
            names: Vec::new(),
            units: Vec::new(),
            turns: Vec::new(),
            n_of_joints: 0,
            of_vectors: Vec::new(),
            vectors: Vec::new(),
            rotations: Vec::new(),
            balls: Vec::new(),
        };
        let joints = scene.joint_outputs();
        let channels = Channel::of_outputs(joints.clone(), scene);
        for (output, channel) in joints.iter().zip(&channels) {
            let Target::Joint(joint) = output.quantity.target() else { continue };
            all.add_joint(scene, joint, channel);
        }
        all.n_of_joints = all.names.len();
        for (b, body) in scene.bodies.iter().enumerate() {
            let (of, at, axes) = (BodyId::Body(b), body.center, ["x", "y", "z"]);
            let n = scene.dimension.count();
            all.quantities.push([
                Output::new(Quantity::Position { body: of, at }),
                Output::new(Quantity::Velocity { body: of, at }),
                Output::new(Quantity::Acceleration { body: of, at }),
            ]);
            all.vectors.push([all.names.len(), n]);
            all.name(axes[..n].iter().map(|x| format!("{}.{x}", body.name)), false);
            all.quantities.push([
                Output::new(Quantity::RotationVector { body: of }),
                Output::new(Quantity::AngularVelocity { body: of }),
                Output::new(Quantity::AngularAcceleration { body: of }),
            ]);
            let (about, turns) = match scene.dimension {
                Dimension::Planar => (&axes[2..], false),
                Dimension::Spatial => (&axes[..], true),
            };
            all.rotations.push(all.names.len());
            if turns {
                all.vectors.push([all.names.len(), 3]);
            }
            all.name(about.iter().map(|x| format!("{}.r{x}", body.name)), turns);
            let n = all.units.len();
            all.units[n - about.len()..].fill("rad");
        }
        all
    }

    fn add_joint(&mut self, scene: &Scene<f64>, joint: JointId, channel: &Channel) {
        self.quantities.push([
            Output::new(Quantity::JointValue { joint }),
            Output::new(Quantity::JointRate { joint }),
            Output::new(Quantity::JointAcceleration { joint }),
        ]);
        let of = &scene.joints[joint.index()];
        let freedoms = of.freedoms(scene.dimension);
        let slides = freedoms.iter().filter(|freedom| matches!(freedom, Freedom::Slide(_))).count();
        let has_vector = slides > 1 || freedoms.contains(&Freedom::Ball);
        for freedom in freedoms {
            let n = freedom.n_coordinates();
            if *freedom == Freedom::Ball {
                let number = |body| if let BodyId::Body(body) = body { Some(body) } else { None };
                self.balls.push((self.turns.len(), of.bodies.map(number)));
            }
            self.turns.extend(core::iter::repeat_n(*freedom == Freedom::Ball, n));
            self.units.extend(core::iter::repeat_n(freedom.unit(), n));
            self.of_vectors.extend(core::iter::repeat_n(has_vector, n));
        }
        self.names.extend(channel.columns());
    }

    fn name(&mut self, names: impl Iterator<Item = String>, turns: bool) {
        let unit = if turns { "rad" } else { "m" };
        self.names.extend(names);
        self.turns.resize(self.names.len(), turns);
        self.units.resize(self.names.len(), unit);
    }
}

//! Scene of a mechanism, [`Scene`]: bodies, joints, effects, outputs and the solver's settings. Handles index the entries of its lists.

use crate::effects::EffectKind;
use crate::joint::Dimension;
use crate::scene::{
    Body, BodyFrame, BodyId, BodyShape, Coupling, CouplingId, EffectId, Guide, GuideId,
    InitialCondition, InitialId, Joint, JointId, NamedSignal, OutputId, Quantity, Road, Rolling,
    RollingId, SignalId, SolverTable, Start, Surroundings,
};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::ops::{Index, IndexMut};

/// A mechanism with its effects, and the outputs and solver settings of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene<T> {
    /// Name of the scene, for reports.
    pub name: String,
    /// Dimension of the scene: planar or spatial.
    pub dimension: Dimension,
    /// Acceleration of gravity [m/s^2]; `None`: no gravity and no gravity code.
    pub gravity: Option<[T; 3]>,
    /// Length of the run [s].
    pub duration: T,
    /// Bodies of the scene; the ground is not among them.
    pub bodies: Vec<Body<T>>,
    /// Joints of the scene.
    pub joints: Vec<Joint<T>>,
    /// Conditions that hold exactly at the start. All other start values follow.
    pub initials: Vec<InitialCondition<T>>,
    /// Guides: prescribed motions of joint coordinates.
    pub guides: Vec<Guide<T>>,
    /// Couplings: relations between joint coordinates and lengths.
    pub couplings: Vec<Coupling<T>>,
    /// Bodies that roll without slipping, and blades.
    pub rollings: Vec<Rolling<T>>,
    /// Named signals over time, for guides, couplings and effects.
    pub signals: Vec<NamedSignal<T>>,
    /// Road under the tires. Empty: level ground at height zero.
    pub road: Road<T>,
    /// Configuration from which the run starts.
    pub start: Start,
    /// Named places on bodies.
    pub frames: Vec<BodyFrame<T>>,
    /// Shapes of bodies for pictures. A body without a shape is drawn by its inertia.
    pub shapes: Vec<BodyShape<T>>,
    /// Effects of the scene. A model leaves out effects with `enabled: false`.
    pub effects: Vec<Effect<T>>,
    /// Outputs that are recorded. Empty: every joint coordinate.
    pub outputs: Vec<Output<T>>,
    /// Settings of the scene for the solver.
    pub solver: SolverTable<T>,
}

impl<T: Default> Scene<T> {
    /// An empty scene with a name, dimension and duration [s], without gravity.
    #[must_use]
    pub fn empty(name: &str, dimension: Dimension, duration: T) -> Self {
        Self {
            name: String::from(name),
            dimension,
            gravity: None,
            duration,
            bodies: Vec::new(),
            joints: Vec::new(),
            initials: Vec::new(),
            guides: Vec::new(),
            couplings: Vec::new(),
            rollings: Vec::new(),
            signals: Vec::new(),
            road: Road::default(),
            start: Start::default(),
            frames: Vec::new(),
            shapes: Vec::new(),
            effects: Vec::new(),
            outputs: Vec::new(),
            solver: SolverTable::default(),
        }
    }
}

/// An effect of the scene, with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Effect<T> {
    /// Unique name among the effects (as given, or `effect-N`).
    pub name: String,
    /// True if the effect is in the model.
    pub enabled: bool,
    /// Kind of the effect, with its data.
    pub kind: EffectKind<T>,
}

/// An output channel: the recorded quantity and its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Output<T> {
    /// Unique name of the channel.
    pub name: String,
    /// Quantity that is measured.
    pub quantity: Quantity<T>,
    /// Body in whose axes vectors have their components; the ground for global axes. `None`: the default axes of the quantity. A thin rod
    /// between ball joints turns by the smallest rotation that carries its line.
    pub frame: Option<BodyId>,
    /// True if the output adds a column with the magnitude of each vector.
    pub magnitude: bool,
    /// True if angles, angular rates and angular accelerations of the output are in degrees instead of radians.
    pub is_in_degrees: bool,
}

impl<T> Output<T> {
    /// An output without a name, in its default axes and units.
    #[must_use]
    pub const fn new(quantity: Quantity<T>) -> Self {
        let name = String::new();
        Self { name, quantity, frame: None, magnitude: false, is_in_degrees: false }
    }
}

impl<T> Scene<T> {
    /// Parts of the scene to which its effects refer.
    pub(crate) fn surroundings(&self) -> Surroundings<'_, T> {
        let Self { dimension, ref bodies, ref joints, ref road, ref signals, .. } = *self;
        Surroundings { dimension, bodies, joints, road, signals }
    }
}

impl<T> Scene<T> {
    /// Flag of each body: true if a joint or a rolling contact names the body. The other bodies move freely.
    #[must_use]
    pub fn held_bodies(&self) -> Vec<bool> {
        let mut held = alloc::vec![false; self.bodies.len()];
        let joints = self.joints.iter().map(|joint| joint.bodies);
        let rollings = self.rollings.iter().map(|rolling| [rolling.body, rolling.on]);
        for body in joints.chain(rollings).flatten().filter_map(BodyId::index) {
            held[body] = true;
        }
        held
    }
}

impl<T> Scene<T> {
    /// True if the body is a point mass.
    #[must_use]
    pub fn is_point(&self, body: BodyId) -> bool {
        body.index().and_then(|body| self.bodies.get(body)).is_some_and(Body::is_point)
    }

    /// True if a joint measures a rotation of a point mass, which has no orientation.
    #[must_use]
    pub fn turns_point(&self, joint: &Joint<T>) -> bool {
        joint.kind.n_rotations(self.dimension) > 0
            && joint.bodies.into_iter().any(|body| self.is_point(body))
    }

    /// Replaces the kind of joints that name a point mass by the [kind](crate::scene::JointKind::of_points) for point masses.
    pub(crate) fn name_points(&mut self) {
        for i in 0..self.joints.len() {
            let bodies = self.joints[i].bodies;
            if bodies.into_iter().any(|body| self.is_point(body)) {
                self.joints[i].kind = self.joints[i].kind.of_points();
            }
        }
    }
}

impl<T: Clone> Scene<T> {
    /// Outputs of the scene. If there are none: the coordinates of every joint with coordinates, under the joint's name. Joints that
    /// measure a rotation of a point mass have none.
    #[must_use]
    pub fn channels(&self) -> Vec<Output<T>> {
        if !self.outputs.is_empty() {
            return self.outputs.clone();
        }
        self.joint_outputs()
    }

    /// Outputs of the coordinates of every joint with coordinates, under the joint's name.
    #[must_use]
    pub fn joint_outputs(&self) -> Vec<Output<T>> {
        let moves = |joint: &Joint<T>| {
            joint.kind.n_coordinates(self.dimension) > 0 && !self.turns_point(joint)
        };
        let joints = self.joints.iter().enumerate().filter(|(_, joint)| moves(joint));
        let value = |index| Quantity::JointValue { joint: JointId::new(index) };
        joints.map(|(i, joint)| Output::new(value(i)).named(&joint.name)).collect()
    }

    /// Adds value, rate and reaction of every joint, and the force of every enabled effect, unless an output measures them already. The
    /// value has the name of the joint. The others add `rate`, `reaction` or `force` to the name. If a name exists already, a number is
    /// appended.
    pub fn show_all(&mut self)
    where
        T: PartialEq,
    {
        for i in 0..self.joints.len() {
            let (joint, at) = (JointId::new(i), &self.joints[i]);
            let name = at.name.clone();
            if at.kind.n_coordinates(self.dimension) > 0 && !self.turns_point(at) {
                self.show(name.clone(), Quantity::JointValue { joint });
                self.show(format!("{name} rate"), Quantity::JointRate { joint });
            }
            self.show(format!("{name} reaction"), Quantity::Reaction { joint });
        }
        for i in 0..self.effects.len() {
            if self.effects[i].enabled {
                let name = format!("{} force", self.effects[i].name);
                self.show(name, Quantity::EffectForce { effect: EffectId::new(i) });
            }
        }
    }

    /// Adds an output unless the scene has one of the same quantity.
    fn show(&mut self, name: String, quantity: Quantity<T>)
    where
        T: PartialEq,
    {
        if self.outputs.iter().any(|output| output.quantity == quantity) {
            return;
        }
        // one of these names is free, since there are more of them than outputs
        let numbered = (2..self.outputs.len() + 3).map(|i| format!("{name} {i}"));
        let is_free = |name: &String| self.outputs.iter().all(|output| output.name != *name);
        let name = core::iter::once(name.clone()).chain(numbered).find(is_free);
        self.outputs.push(Output::new(quantity).named(&name.unwrap_or_default()));
    }
}

macro_rules! by_handle {
    ($($id:ident of $entry:ident),*) => {$(
        impl<T> Index<$id> for Vec<$entry<T>> {
            type Output = $entry<T>;

            fn index(&self, id: $id) -> &$entry<T> {
                &self[id.index()]
            }
        }

        impl<T> IndexMut<$id> for Vec<$entry<T>> {
            fn index_mut(&mut self, id: $id) -> &mut $entry<T> {
                &mut self[id.index()]
            }
        }
    )*};
}

by_handle!(JointId of Joint, InitialId of InitialCondition, GuideId of Guide, CouplingId of Coupling, RollingId of Rolling, SignalId of NamedSignal, EffectId of Effect, OutputId of Output);

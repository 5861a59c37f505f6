//! Parts of a mechanism and their handles.

use super::{Body, Coupling, Effect, Guide, InitialCondition, Joint, NamedSignal, Output, Rolling};
use mbs_core::scene::{
    BodyId, CouplingId, EffectId, GuideId, InitialId, InitialTarget, JointId, Number, OutputId,
    RollingId, Scene, SignalId, StartedJoint,
};

/// Part that [`Mechanism::add`](crate::Mechanism::add) accepts: a body, joint, initial condition, guide, coupling, rolling, signal, effect or
/// output.
pub trait Part: sealed::Part {
    /// Type of the handle of this part.
    type Id: Id;
}

/// A handle of a part.
pub trait Id: Copy + sealed::Id {}

pub(super) mod sealed {
    use mbs_core::scene::{Number, Scene};

    pub trait Part: Sized {
        fn add_to(self, scene: &mut Scene<Number>) -> usize;
    }

    pub trait Id: Sized {
        /// Word for a part of this kind in messages, and in the name of a part that the user did not name.
        const WORD: &'static str;
        type Part: 'static;
        fn new(index: usize) -> Self;
        fn place(self) -> Option<usize>;
        fn parts(scene: &Scene<Number>) -> &[Self::Part];
        fn parts_mut(scene: &mut Scene<Number>) -> &mut Vec<Self::Part>;
        fn name<'a>(part: &'a Self::Part, scene: &'a Scene<Number>) -> &'a str;
    }
}

macro_rules! part {
    ($part:ident, $id:ident, $word:literal, $list:ident, $name:expr, $set_name:expr, $place:expr) => {
        impl Part for $part {
            type Id = $id;
        }

        impl Id for $id {}

        impl sealed::Part for $part {
            fn add_to(mut self, scene: &mut Scene<Number>) -> usize {
                if <$id as sealed::Id>::name(&self, scene).is_empty() {
                    let set_name: fn(&mut $part, String) = $set_name;
                    set_name(&mut self, free_name::<$id>(scene));
                }
                let list = &mut scene.$list;
                list.push(self);
                list.len() - 1
            }
        }

        impl sealed::Id for $id {
            const WORD: &'static str = $word;
            type Part = $part;

            fn new(index: usize) -> Self {
                Self::new(index)
            }
            fn place(self) -> Option<usize> {
                let place: fn($id) -> Option<usize> = $place;
                place(self)
            }
            fn parts(scene: &Scene<Number>) -> &[$part] {
                &scene.$list
            }
            fn parts_mut(scene: &mut Scene<Number>) -> &mut Vec<$part> {
                &mut scene.$list
            }
            fn name<'a>(part: &'a $part, scene: &'a Scene<Number>) -> &'a str {
                let name: for<'b> fn(&'b $part, &'b Scene<Number>) -> &'b str = $name;
                name(part, scene)
            }
        }
    };
}

part!(Body, BodyId, "body", bodies, |p, _| &p.name, |p, n| p.name = n, BodyId::index);
part!(Joint, JointId, "joint", joints, |p, _| &p.name, |p, n| p.name = n, |id| Some(id.index()));
part!(Effect, EffectId, "effect", effects, |p, _| &p.name, |p, n| p.name = n, |id| Some(
    id.index()
));
part!(Output, OutputId, "output", outputs, |p, _| &p.name, |p, n| p.name = n, |id| Some(
    id.index()
));
part!(Coupling, CouplingId, "coupling", couplings, |p, _| &p.name, |p, n| p.name = n, |id| Some(
    id.index()
));
part!(Rolling, RollingId, "rolling", rollings, |p, _| &p.name, |p, n| p.name = n, |id| Some(
    id.index()
));
part!(NamedSignal, SignalId, "signal", signals, |p, _| &p.name, |p, n| p.name = n, |id| Some(
    id.index()
));
part!(Guide, GuideId, "guide", guides, |p, s| of_joint(p.joint, s), |_, _| {}, |id| Some(
    id.index()
));
part!(
    InitialCondition,
    InitialId,
    "initial",
    initials,
    |p, s| match p.target {
        InitialTarget::Joint { joint, .. } => of_joint(joint, s),
        InitialTarget::Body { body, .. } => of_body(body, s),
    },
    |_, _| {},
    |id| Some(id.index())
);

/// Returns a name that no part of this kind has: the word of the kind and the next free number.
fn free_name<I: Id>(scene: &Scene<Number>) -> String {
    let parts = I::parts(scene);
    let is_free = |name: &String| !parts.iter().any(|p| I::name(p, scene) == name);
    let mut names = (parts.len() + 1..).map(|n| format!("{}-{n}", I::WORD));
    names.find(is_free).unwrap_or_default()
}

fn of_joint(id: JointId, scene: &Scene<Number>) -> &str {
    scene.joints.get(id.index()).map_or("", |joint| &joint.name)
}

pub(super) fn of_body(id: BodyId, scene: &Scene<Number>) -> &str {
    match id.index() {
        None => "ground",
        Some(index) => scene.bodies.get(index).map_or("", |body| &body.name),
    }
}

impl Part for StartedJoint {
    type Id = JointId;
}

impl sealed::Part for StartedJoint {
    fn add_to(self, scene: &mut Scene<Number>) -> usize {
        let Self { joint, value, rate } = self;
        let index = sealed::Part::add_to(joint, scene);
        let (value, rate) = (Some(vec![value]), Some(vec![rate]));
        let initial = InitialCondition::joint(JointId::new(index), value, rate);
        sealed::Part::add_to(initial, scene);
        index
    }
}

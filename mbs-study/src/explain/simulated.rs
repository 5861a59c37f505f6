//! Simulated parts of a scene: bodies, joints, guides, and the sizes of the model in both kinds of coordinates.

use super::explanation::{
    ControllerStep, GuideEntry, JointsByKind, Relative, Simulated, Sizes, ThinRod,
};
use mbs::typed::Simulation;
use mbs::{FormulationKind, IntegratorKind, Names, ResolvedMethod, StopError};
use mbs_core::Real;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{BodyId, Dimension, Inertia, JointKind, Motion, Scene};
use mbs_recursive::space::Space;
use mbs_recursive::{Planar, Spatial, TreeModel};

/// Lists the simulated parts of a scene and the sizes of its models.
pub(super) fn simulated<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
) -> Simulated {
    let sizes = |formulation| {
        let settings = ResolvedMethod {
            formulation,
            integrator: IntegratorKind::Trapezoidal,
            penalty: None,
            ..settings.clone()
        };
        Simulation::<T, D>::new(scene, &settings).map(|simulation| Sizes::new(simulation.sizes()))
    };
    let natural = sizes(FormulationKind::DEFAULT).ok();
    let of_tree = if const { D == 2 } { relative::<T, Planar> } else { relative::<T, Spatial> };
    let relative = sizes(FormulationKind::RELATIVE).and_then(|sizes| of_tree(scene, sizes));
    let (relative, relative_error) = match relative {
        Ok(relative) => (Some(relative), None),
        Err(error) => (None, Some(error.report(0.0, &Names::new(scene)))),
    };
    Simulated {
        bodies: scene.bodies.iter().map(|body| body.name.clone()).collect(),
        joints: joints(scene),
        guides: guides(scene),
        couplings: scene.couplings.iter().map(|coupling| coupling.name.clone()).collect(),
        rollings: scene.rollings.iter().map(|rolling| rolling.name.clone()).collect(),
        gravity: scene.gravity.map(|g| g[..D].iter().map(|x| x.to_f64()).collect()),
        dof: natural.map(|sizes| sizes.dof),
        natural,
        relative,
        relative_error,
        rods: rods::<T, D>(scene),
    }
}

fn relative<T: Real, S: Space<T>>(scene: &Scene<T>, sizes: Sizes) -> Result<Relative, StopError> {
    let tree = TreeModel::<T, S>::new(scene).map_err(StopError::tree)?;
    let cut_joints: Vec<_> =
        tree.cut_joints().map(|joint| scene.joints[joint].name.clone()).collect();
    let controller = mbs::export::operation_bound(&tree).map(|bound| ControllerStep {
        products: bound.products,
        sums: bound.sums,
        quotients: bound.quotients,
        roots: bound.roots,
        turns: bound.turns,
        instructions: [false, true].map(|is_double| bound.instructions(is_double)),
    });
    Ok(Relative { sizes, loops: cut_joints.len(), cut_joints, controller })
}

fn joints<T>(scene: &Scene<T>) -> Vec<JointsByKind> {
    let group = |kind: JointKind| {
        let joints = scene.joints.iter().filter(|joint| joint.kind.name() == kind.name());
        let names = joints.map(|joint| joint.name.clone()).collect();
        JointsByKind { kind: kind.name().to_owned(), names }
    };
    JointKind::ALL.map(group).into_iter().filter(|group| !group.names.is_empty()).collect()
}

/// Guided joints, each with the law of its guide.
fn guides<T>(scene: &Scene<T>) -> Vec<GuideEntry> {
    let mut entries = Vec::<GuideEntry>::new();
    for guide in &scene.guides {
        let law = match guide.law {
            Motion::Table { .. } | Motion::Monotone { .. } => "table",
            Motion::Sine { .. } => "sine",
            Motion::Input(_) => "input",
            Motion::Ramp { .. } => "ramp",
            Motion::Signal(_) => "signal",
        };
        match entries.last_mut().filter(|_| guide.number > 0) {
            Some(entry) if entry.law.split(", ").any(|known| known == law) => {}
            Some(entry) => entry.law = format!("{}, {law}", entry.law),
            None => {
                let joint = scene.joints[guide.joint].name.clone();
                entries.push(GuideEntry { joint, law: law.to_owned() });
            }
        }
    }
    entries
}

/// Thin rods of a spatial scene; a planar scene has no rotation about a rod's axis.
fn rods<T: Real, const D: usize>(scene: &Scene<T>) -> Vec<ThinRod> {
    let is_rod = |inertia: &Inertia<T>| matches!(inertia, Inertia::Rod { .. });
    if scene.dimension == Dimension::Planar || !scene.bodies.iter().any(|b| is_rod(&b.inertia)) {
        return Vec::new();
    }
    let Ok(model) = NaturalModel::<T, D>::new(scene) else { return Vec::new() };
    let bodies = scene.bodies.iter().enumerate().filter(|(_, body)| is_rod(&body.inertia));
    bodies
        .map(|(i, body)| ThinRod {
            body: body.name.clone(),
            idle_spin_carried: model.has_full_rotation(BodyId::Body(i)),
        })
        .collect()
}

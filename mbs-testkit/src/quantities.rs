//! Every quantity that an output of a scene can have.

use mbs_core::outputs::{
    QUANTITIES, Quantity, RelativePoint, Target, TargetKind, VehicleSide, WheelCarrier,
};
use mbs_core::scene::{
    BodyId, CouplingId, Dimension, EffectId, Inertia, JointId, Output, RollingId, Scene, SignalId,
};

/// Returns all quantities of bodies, joints, couplings, effects and the scene, in the order of the table. Quantities of a run are left out.
#[must_use]
pub fn every(scene: &Scene<f64>) -> Vec<Quantity<f64>> {
    let center = |body: usize| match scene.bodies[body].inertia {
        Inertia::Rod { from, to } => [0, 1, 2].map(|i| 0.5 * (from[i] + to[i])),
        _ => scene.bodies[body].center,
    };
    let bodies = || (0..scene.bodies.len()).map(|body| (BodyId::Body(body), center(body)));
    let ground = [(BodyId::Ground, [0.0, 0.0, 0.0])];
    let all = QUANTITIES.iter().filter(|row| !row.is_of_run).flat_map(|row| {
        let targets: Vec<_> = match row.target {
            TargetKind::Point => bodies().map(|(body, at)| Target::Point(body, at)).collect(),
            TargetKind::RelativePoint => {
                let seen = |((body, at), (relative_to, origin))| {
                    Target::RelativePoint(RelativePoint { body, at, relative_to, origin })
                };
                bodies().zip(bodies().skip(1).chain(ground)).map(seen).collect()
            }
            TargetKind::RelativeBody => {
                let others = bodies().skip(1).chain(ground);
                bodies().zip(others).map(|(a, b)| Target::RelativeBody(a.0, b.0)).collect()
            }
            TargetKind::WheelCarrier if scene.dimension == Dimension::Planar => Vec::new(),
            TargetKind::WheelCarrier => {
                let (up, forward) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
                let of = |((body, _), (relative_to, _)): ((BodyId, _), (BodyId, [f64; 3]))| {
                    let side = VehicleSide::Left;
                    WheelCarrier { body, relative_to, side, up, forward, axis: None }
                };
                let pairs = bodies().zip(bodies().skip(1).chain(ground));
                pairs.map(of).map(Target::WheelCarrier).collect()
            }
            TargetKind::Body => bodies().map(|(body, _)| Target::Body(body)).collect(),
            TargetKind::Joint => {
                (0..scene.joints.len()).map(|joint| Target::Joint(JointId::new(joint))).collect()
            }
            TargetKind::Coupling => {
                (0..scene.couplings.len()).map(|i| Target::Coupling(CouplingId::new(i))).collect()
            }
            TargetKind::Rolling => {
                (0..scene.rollings.len()).map(|i| Target::Rolling(RollingId::new(i))).collect()
            }
            TargetKind::Effect => {
                (0..scene.effects.len()).map(|i| Target::Effect(EffectId::new(i))).collect()
            }
            TargetKind::Signal => {
                (0..scene.signals.len()).map(|i| Target::Signal(SignalId::new(i))).collect()
            }
            TargetKind::Scene => [Target::Scene].into(),
        };
        targets.into_iter().filter_map(|target| Quantity::of(row.name, target))
    });
    all.filter(|quantity| !quantity.components(scene).is_empty()).collect()
}

/// Sets quantities as the outputs of a scene. The name of an output is its number.
pub fn show(scene: &mut Scene<f64>, quantities: impl IntoIterator<Item = Quantity<f64>>) {
    let named = |(i, quantity)| Output::new(quantity).named(&format!("channel-{i}"));
    scene.outputs = quantities.into_iter().enumerate().map(named).collect();
}

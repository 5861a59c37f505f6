//! What settings of the whole model do to the inertias of its bodies.

use super::model::Model;
use crate::inertia::{Mass, SLACK};
use crate::pose::{M3, v3};
use crate::robot::{Target, What};
use crate::source::Read;

/// Bounds, balances and scales the masses of all bodies, and gives them to the links.
pub(super) fn settle(model: &mut Model<'_, '_, '_>) -> Read<()> {
    let mut masses = std::mem::take(&mut model.masses);
    for (link, mass, _) in &mut masses {
        bound(mass, model.compiler.bound_mass, model.compiler.bound_inertia);
        if model.compiler.balance && balance(mass) {
            let link = &model.robot.links[*link];
            let says =
                "moments that no body has: all three are their mean, as `balanceinertia` asks";
            model.context.findings.approximated(link.at, format!("body[{}]", link.name), says);
        }
    }
    if let Some(total) = model.compiler.total_mass {
        let sum: f64 = masses.iter().map(|(_, mass, _)| mass.mass).sum();
        let share = total / sum;
        if share.is_finite() {
            for (_, mass, _) in &mut masses {
                mass.mass *= share;
                mass.tensor *= share;
            }
        }
    }
    for (link, mass, lift) in masses {
        if mass != Mass::none() {
            model.robot.links[link].mass = Some(mass);
        }
        if lift != 0.0 && mass.mass > 0.0 {
            // a force against gravity at the centre of mass
            let weight = v3(model.compiler.gravity) * (-lift * mass.mass);
            let name = format!("{} gravcomp", model.robot.links[link].name);
            let on = Target::Point { link, place: mass.center, direction: weight };
            model.law(&name, What::Held { on, value: 1.0 });
        }
    }
    Ok(())
}

/// Raises mass and principal moments to the least that settings allow.
fn bound(mass: &mut Mass, least_mass: f64, least_moment: f64) {
    mass.mass = mass.mass.max(least_mass);
    if least_moment > 0.0 {
        let eigen = mass.tensor.symmetric_eigen();
        if eigen.eigenvalues.min() < least_moment {
            let moments = M3::from_diagonal(&eigen.eigenvalues.map(|x| x.max(least_moment)));
            mass.tensor = eigen.eigenvectors * moments * eigen.eigenvectors.transpose();
        }
    }
}

/// Sets moments that no body has to their mean; did it?
fn balance(mass: &mut Mass) -> bool {
    let moments = mass.tensor.symmetric_eigen().eigenvalues;
    let is_possible = 2.0 * moments.max() <= moments.sum() + SLACK * moments.max();
    if !is_possible {
        mass.tensor = M3::identity() * (moments.sum() / 3.0);
    }
    !is_possible
}

//! Bodies of a model: links that are welded together form one body.

use crate::findings::Findings;
use crate::inertia::{Mass, SLACK};
use crate::options::ImportOptions;
use crate::pose::M3;
use crate::robot::{Kind, Robot};
use crate::source::{Fault, Read};

/// Radius of gyration below which a body counts as a point mass [m]. It is far smaller than any part, and far larger than rounding errors.
/// A leg of a published humanoid has 2e-9 m.
const NEGLIGIBLE: f64 = 1.0e-7;

/// Links that are welded together and form one body.
#[derive(Debug, Clone)]
pub(crate) struct Lump {
    /// Link to which the other links are welded. The body gets the name of this link.
    pub(crate) carrier: usize,
    pub(crate) mass: Mass,
    /// Factor of gravity, equal for all links that have mass [-].
    pub(crate) gravity_scale: f64,
}

/// The bodies of a model, with the links in them.
#[derive(Debug, Clone)]
pub(crate) struct Lumps {
    /// Index of the body of each link.
    pub(crate) of: Vec<usize>,
    /// Bodies, with the ground first. The others are in the order of their carriers in the file.
    pub(crate) lumps: Vec<Lump>,
}

/// Joins links that are connected by `Fixed` joints, and checks the inertia of moving bodies. An impossible inertia is an error; options
/// may correct it or leave it out.
pub(crate) fn lumps(
    robot: &Robot,
    options: &ImportOptions,
    findings: &mut Findings,
) -> Read<Lumps> {
    let carriers = robot.carriers(|joint| joint.kind == Kind::Fixed);
    let mut found = Lumps { of: vec![0; robot.links.len()], lumps: Vec::new() };
    let mut number = vec![usize::MAX; robot.links.len()];
    for link in 0..robot.links.len() {
        if carriers[link] == link {
            number[link] = found.lumps.len();
            found.lumps.push(Lump { carrier: link, mass: Mass::none(), gravity_scale: 1.0 });
        }
    }
    for (link, carrier) in carriers.iter().enumerate() {
        found.of[link] = number[*carrier];
        if let Some(mass) = &robot.links[link].mass {
            let lump = &mut found.lumps[number[*carrier]];
            lump.mass = lump.mass.with(mass);
            if mass.mass > 0.0 {
                lump.gravity_scale = robot.links[link].gravity_scale;
            }
        }
    }
    for lump in &mut found.lumps[1..] {
        match check(robot, lump, options.balance, findings) {
            Err(fault) if options.geometry_alone => {
                lump.mass = Mass::none();
                let label = format!("link[{}]", robot.links[lump.carrier].name);
                findings.ignored(fault.at, label, format!("{}: left out", fault.message));
            }
            checked => checked?,
        }
    }
    Ok(found)
}

/// Checks that the inertia of a body is possible, or corrects it when `balance` is true.
fn check(robot: &Robot, lump: &mut Lump, balance: bool, findings: &mut Findings) -> Read<()> {
    let link = &robot.links[lump.carrier];
    let size = lump.mass.tensor.abs().max();
    if size == 0.0 {
        return Ok(());
    }
    if size < lump.mass.mass * NEGLIGIBLE * NEGLIGIBLE {
        let says = format!(
            "moments of {size:e} kg m^2 are nothing beside {} kg: taken as zero",
            lump.mass.mass
        );
        findings.approximated(link.at, format!("link[{}]", link.name), says);
        lump.mass.tensor = M3::zeros();
        return Ok(());
    }
    if lump.mass.mass == 0.0 {
        return Err(Fault::new(
            link.at,
            format!("link `{}` has inertia and no mass, and it moves", link.name),
            "write its mass, or delete its inertia; a massless link must be moved by others",
        ));
    }
    let eigen = (lump.mass.tensor / size).symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let [least, middle, largest] = order.map(|i| eigen.eigenvalues[i]);
    if least >= -SLACK && largest <= least + middle + SLACK {
        return Ok(());
    }
    let moments = [least, middle, largest].map(|x| x * size);
    let raise = (largest - least - middle) / 2.0;
    let axis = eigen.eigenvectors.column(order[2]);
    let is_mended = raise > 0.0 && least + raise >= -SLACK;
    if balance && is_mended {
        lump.mass.tensor += (M3::identity() - axis * axis.transpose()) * (raise * size);
        let raise = raise * size;
        findings.approximated(
            link.at,
            format!("link[{}]", link.name),
            format!("principal moments {moments:?} are of no body: the two smaller ones raised by {raise:e} kg m^2 (--balance)"),
        );
        return Ok(());
    }
    let hint = if is_mended {
        "write the inertia of the part, or let --balance raise the two smaller moments until the inequality holds"
    } else {
        "write the inertia of the part: principal moments are not negative, and none is larger than the sum of the others"
    };
    let message = format!(
        "link `{}`, with all that is fixed to it, has principal moments {moments:?}, which no body has",
        link.name
    );
    Err(Fault::new(link.at, message, hint))
}

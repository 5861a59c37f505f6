//! Robots of published models, evaluated by the tree of the public interface.

use crate::clock::{STATES, time_of};
use crate::line::{Failure, print_line};
use mbs::core::scene::{BodyId, Scene};
use mbs::{JointId, Tree};
use mbs_core::Real;
use mbs_core::real::DoubleDouble as Pair;
use mbs_recursive::own::{EffortSlopes, MovingColumns, OwnFreedoms};
use mbs_recursive::{EffortTerms, Spatial, TreeModel, TreeState, Workspace};
use std::hint::black_box;
use std::path::PathBuf;

/// Rate and acceleration of every joint, with the same number [rad/s or m/s, and per second].
const RATE: f64 = 0.5;

/// Angle or displacement of every joint in state `k` [rad or m].
fn angle(k: usize) -> f64 {
    0.2 + 0.1 * k as f64
}

/// A robot file that the script of the robots has made, and the joint whose body's Jacobian is evaluated.
struct Robot {
    file: mbs_scene::SceneFile,
    last: String,
}

impl Robot {
    fn read(n: usize) -> Result<Self, Failure> {
        let folder = PathBuf::from(std::env::var("PEERS_DIR")?).join("robots");
        let text = std::fs::read_to_string(folder.join(format!("{n}.txt")))?;
        let last = text.lines().last().and_then(|line| line.split(' ').nth(2));
        let last = last.ok_or("no joints")?.to_owned();
        Ok(Self { file: mbs::models::read(folder.join(format!("{n}.urdf")))?, last })
    }

    /// Reads the robot's scene without effects, so that gravity alone acts. Also returns the last joint's body and the joint's place on it.
    fn scene<T: Real>(&self) -> Result<(Scene<T>, BodyId, [T; 3]), Failure> {
        let mut scene = self.file.scene::<T>()?;
        scene.effects.clear();
        let joint = scene.joints.iter().find(|joint| joint.name == self.last);
        let joint = joint.ok_or_else(|| format!("no joint {}", self.last))?;
        let (body, at) = (joint.bodies[1], joint.points[1]);
        Ok((scene, body, at))
    }
}

/// Times a problem, and prints its value with 32 digits as reference.
pub(crate) fn robot(problem: &str, n: usize, seconds: f64) -> Result<(), Failure> {
    let robot = Robot::read(n)?;
    print_line("reference", 0.0, reference(&robot, problem)?, "exact");
    let (scene, body, at) = robot.scene::<f64>()?;
    let mut tree = Tree::new(&scene)?;
    let joints: Vec<usize> = (0..scene.joints.len())
        .filter_map(|j| tree.coordinates_of(JointId::new(j)).ok())
        .filter(|range| range.v.len() == 1)
        .map(|range| range.v.start)
        .collect();
    let n = tree.velocities().len();
    let (mut step, mut rates) = (vec![0.0; n], vec![0.0; n]);
    joints.iter().for_each(|&j| rates[j] = RATE);
    let mut states = Vec::new();
    for k in 0..STATES {
        joints.iter().for_each(|&j| step[j] = angle(k));
        let mut q = tree.coordinates().to_vec();
        tree.integrate(tree.coordinates(), &step, &mut q)?;
        states.push(q);
    }
    let asked = Asked { problem, none: vec![0.0; n], rates, at: (body, at) };
    tree.set(&states[0], &asked.rates)?;
    let value = value(problem, asked.answer(&mut tree)?, (n, &joints));
    let time = time_of(seconds, |k| {
        black_box(tree.set(&states[k], &asked.rates).is_ok());
        black_box(asked.answer(&mut tree).is_ok());
    });
    print_line("Tree", time, value, "exact");
    Ok(())
}

struct Asked<'a> {
    problem: &'a str,
    none: Vec<f64>,
    rates: Vec<f64>,
    /// The point whose Jacobian is evaluated.
    at: (BodyId, [f64; 3]),
}

impl Asked<'_> {
    fn answer<'t>(&self, tree: &'t mut Tree) -> Result<&'t [f64], Failure> {
        Ok(match self.problem {
            "robot-mass" => &tree.mass_matrix().data,
            "robot-forward" => tree.forward_dynamics(&self.none)?,
            "robot-inverse" => tree.inverse_dynamics(&self.rates)?,
            "robot-jacobian" => &tree.jacobian_at(self.at.0, self.at.1).data,
            _ => &tree.forward_dynamics_derivatives(&self.none)?.q.data,
        })
    }
}

/// Value of an answer: a sum over the joints, so that their order does not matter.
fn value(problem: &str, answer: &[f64], (n, joints): (usize, &[usize])) -> f64 {
    let of = |j: usize| match problem {
        "robot-mass" => answer[j * (n + 1)],
        "robot-jacobian" => (0..6).map(|i| answer[i * n + j].powi(2)).sum(),
        "robot-derivatives" => joints.iter().map(|&i| answer[i * n + j]).sum(),
        _ => answer[j],
    };
    joints.iter().map(|&j| of(j)).sum()
}

/// The value of the first state, by the same equations with 32 digits.
fn reference(robot: &Robot, problem: &str) -> Result<f64, Failure> {
    let (scene, body, at) = robot.scene::<Pair>()?;
    let model = TreeModel::<Pair, Spatial>::new(&scene)?;
    let (mut state, mut workspace) = (TreeState::at_rest(&model), Workspace::new(&model));
    let n = state.v.len();
    let mut joints = Vec::new();
    for link in model.mechanism().links.iter().skip(1) {
        if link.kind.n_freedoms::<Pair, Spatial>() == 1 {
            joints.push(link.v as usize);
            state.z[link.z as usize] = Pair::from_f64(angle(0));
            state.v[link.v as usize] = Pair::from_f64(RATE);
        }
    }
    let mut freedoms = OwnFreedoms::of_tree(&model);
    let (zero, mut efforts) = (vec![Pair::ZERO; n], vec![Pair::ZERO; n]);
    let mut sum = Pair::ZERO;
    match problem {
        "robot-mass" => {
            let mut mass = vec![Pair::ZERO; n * n];
            freedoms.write_mass_matrix(&model, &state, &mut workspace, &mut mass);
            joints.iter().for_each(|&j| sum += mass[j * (n + 1)]);
        }
        "robot-forward" => {
            model.accelerate_under(&zero, &mut state, &mut workspace)?;
            joints.iter().for_each(|&j| sum += state.a[j]);
        }
        "robot-inverse" => {
            state.a.copy_from_slice(&state.v);
            let terms = EffortTerms::WithoutEffects;
            model.write_efforts((&state, terms), &mut workspace, &mut efforts);
            joints.iter().for_each(|&j| sum += efforts[j]);
        }
        "robot-jacobian" => {
            let mut rows = vec![Pair::ZERO; 6 * n];
            freedoms.write_jacobian(&model, (&state, body, at), &mut workspace, &mut rows);
            let entry = |(i, j): (usize, usize)| rows[i * n + j] * rows[i * n + j];
            (0..6).for_each(|i| joints.iter().for_each(|&j| sum += entry((i, j))));
        }
        "robot-derivatives" => {
            model.accelerate_under(&zero, &mut state, &mut workspace)?;
            let [mut q, mut v, mut mass] = [0; 3].map(|_| vec![Pair::ZERO; n * n]);
            let mut slopes = EffortSlopes { q: &mut q, v: &mut v, a: &mut mass };
            let scratch = (&mut workspace, &mut MovingColumns::new(&model));
            freedoms.write_effort_slopes(&model, &state, scratch, &mut slopes);
            freedoms.factor(&mut mass).map_err(|link| format!("no inertia beyond link {link}"))?;
            freedoms.solve(&mass, &mut q);
            joints.iter().for_each(|&i| joints.iter().for_each(|&j| sum -= q[i * n + j]));
        }
        _ => return Err(format!("no problem {problem} of robots").into()),
    }
    Ok(sum.to_f64())
}

//! Inverse kinematics: positions of a [`Tree`] at which a body has a target position and rotation.
//!
//! ```text
//! δ = Aᵀ y,   (A Aᵀ + diag(μ, 0)) y = (e, 0),   A = (J; G)        μ = λ e·e        [Sugihara 2011 (9), (23)]
//! ```
//! The step δ of the coordinates follows from the error e, the difference between target and body; lengths are divided by the scene's
//! length. J is the Jacobian of the body's point, G has the rows of closed loops, and μ is a damping. If a step would move a coordinate out
//! of its range, the coordinate remains at the end of the range. After a step the loops are closed to machine precision. A step that does
//! not reduce the error is rejected, and λ increases.

use super::inner::{Inner, with};
use super::{Tree, TreeError, TreeErrorKind, checked, fictitious};
use crate::erased::values::rows;
use mbs_core::algebra::{Matrix as Square, Vector, cross, rotation_vector};
use mbs_core::scene::{BodyId, JointId};

/// Largest number of steps of a search [-]. A reachable target needs about ten.
const MOST_STEPS: u32 = 200;
/// Largest error at which the target counts as reached, relative to the scene's length and to 1 rad [-]. The rounding errors of a chain of
/// joints add up to less.
const REACHED: f64 = 1e-12;
/// Damping λ at which the search ends [-], because then no step reduces the error.
const MOST_DAMPING: f64 = 1e12;
/// Damping λ of the first step [-], its factor after an accepted step, and its factor after a rejected step. Chosen, not tuned.
const DAMPING: [f64; 3] = [1e-3, 0.2, 8.0];
/// Largest change of a coordinate in one step [rad, scene lengths].
const LARGEST_STEP: f64 = 1.0;
/// Tolerance of the orthogonality of a target rotation [-]. It accepts a matrix that is written with six digits.
const ORTHOGONAL: f64 = 1e-5;
/// Number added to the diagonal of the matrix, relative to its largest entry [-], because redundant rows of loops have zero pivots.
const REPEATED: f64 = 1e-13;

/// Target position and target rotation of a body. A part that is `None` is not prescribed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FrameTarget {
    /// Target position of the point in global axes [m].
    pub position: Option<[f64; 3]>,
    /// Rotation matrix of the body relative to the reference configuration, by rows.
    pub rotation: Option<[[f64; 3]; 3]>,
}

/// Reason why a search for a position ended.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum InverseKinematicsEnd {
    /// The body has reached the target.
    Reached,
    /// No motion of the joints reduces the error. The target is out of reach, or the search needs another start.
    Nearest,
    /// No motion of the joints reduces the error, and these joints are at an end of their range.
    AtRange(Vec<JointId>),
    /// The largest number of steps was reached while the error was still decreasing.
    Unfinished,
}

/// Result of a search for a position. The tree then has the found position and zero velocity.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct InverseKinematics {
    /// Reason why the search ended.
    pub end: InverseKinematicsEnd,
    /// Distance between the point and its target [m]; zero without a target position.
    pub distance: f64,
    /// Angle between the rotation and its target [rad]; zero without a target rotation.
    pub angle: f64,
    /// Number of steps that were accepted or rejected.
    pub steps: u32,
}

impl Tree {
    /// Moves the joints until a point of a body and the body's rotation match the target, or are as close as possible. The search starts at
    /// the current position. `at` is the point in the reference configuration [m]. Afterwards the tree is at rest at the found position.
    /// The result has the remaining error and the reason why the search ended.
    ///
    /// Loops remain closed. A joint with a `range` remains within it, if it starts within it. No other function of the tree uses ranges. If
    /// there are several solutions, the search usually finds the one closest to the start. Guided joints have their positions at the time
    /// of [`set_time`](Self::set_time). If the body is the ground, the joints cannot change the error.
    ///
    /// Cost: some tens of outward passes, and the cube of the number of rows of target and loops; allocates.
    ///
    /// # Errors
    /// [`TreeErrorKind::NotFinite`] and [`TreeErrorKind::NotOrthogonal`] for an invalid target, [`TreeErrorKind::OpenLoops`] if the loops
    /// cannot be closed at the start; the tree is unchanged then.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// use mbs::{BodyId, FrameTarget, InverseKinematicsEnd};
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// tree.set(&[0.3, 0.3], &[0.0, 0.0])?;
    /// // two rods of 1 m: the tip at a distance of √2 needs a right angle between them
    /// let target = FrameTarget { position: Some([1.0, 1.0, 0.0]), ..FrameTarget::default() };
    /// let found = tree.inverse_kinematics(BodyId::new(1), [2.0, 0.0, 0.0], &target)?;
    /// assert_eq!(found.end, InverseKinematicsEnd::Reached);
    /// assert!((tree.coordinates()[1] - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
    /// // three metres away is too far
    /// let far = FrameTarget { position: Some([3.0, 0.0, 0.0]), ..FrameTarget::default() };
    /// let found = tree.inverse_kinematics(BodyId::new(1), [2.0, 0.0, 0.0], &far)?;
    /// assert!(found.end == InverseKinematicsEnd::Nearest && (found.distance - 1.0).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn inverse_kinematics(
        &mut self,
        body: BodyId,
        at: [f64; 3],
        target: &FrameTarget,
    ) -> Result<InverseKinematics, TreeError> {
        let position = target.position.unwrap_or_default();
        checked("position", &position, 3)?;
        checked("rotation", &target.rotation.unwrap_or_default().concat(), 9)?;
        if !target.rotation.is_none_or(|rows| is_rotation(&rows)) {
            return Err(TreeErrorKind::NotOrthogonal.into());
        }
        let start = self.q.clone();
        let rest = vec![0.0; self.v.len()];
        self.close_loops(&start)?;
        let search = Search::new(self, (body, at), *target);
        let (mut here, mut best) = (self.q.clone(), search.error(self));
        let [mut damping, better, worse] = DAMPING;
        let mut found = InverseKinematics {
            end: InverseKinematicsEnd::Unfinished,
            distance: 0.0,
            angle: 0.0,
            steps: 0,
        };
        while found.steps < MOST_STEPS {
            if norm(&best) <= REACHED {
                found.end = InverseKinematicsEnd::Reached;
                break;
            }
            if damping > MOST_DAMPING {
                let held = search.held(&here);
                found.end = if held.is_empty() {
                    InverseKinematicsEnd::Nearest
                } else {
                    InverseKinematicsEnd::AtRange(held)
                };
                break;
            }
            let step = search.step(self, (&here, &best), damping);
            found.steps += 1;
            let mut there = here.clone();
            self.layout.integrate(&step, &mut there);
            search.keep(&mut there);
            let is_closed = self.close_loops(&there).is_ok() && search.is_kept(&self.q);
            let error = search.error(self);
            if is_closed && norm(&error) < norm(&best) {
                (here, best) = (self.q.clone(), error);
                damping *= better;
            } else {
                self.set(&here, &rest)?;
                damping *= worse;
            }
        }
        let three = |first: usize| norm(best.get(first..first + 3).unwrap_or(&[]));
        let turns = if target.position.is_some() { 3 } else { 0 };
        found.distance = if target.position.is_some() { three(0) * search.length } else { 0.0 };
        found.angle = three(turns);
        Ok(found)
    }

    /// Moves the joints as [`inverse_kinematics`](Self::inverse_kinematics) does, for the frame that has the given name in
    /// [`frame`](Self::frame). The target has the position of the frame's origin and the rotation of its axes, both in global axes.
    ///
    /// # Errors
    /// As for [`inverse_kinematics`](Self::inverse_kinematics); [`TreeErrorKind::UnknownFrame`] for an unknown name.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// use mbs::{FrameTarget, InverseKinematicsEnd};
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// tree.set(&[0.3, 0.3], &[0.0, 0.0])?;
    /// let target = FrameTarget { position: Some([1.0, 1.0, 0.0]), ..FrameTarget::default() };
    /// // without a frame of that name it is the body's centre of mass
    /// let found = tree.inverse_kinematics_of("lower", &target)?;
    /// assert_eq!(found.end, InverseKinematicsEnd::Reached);
    /// assert!((tree.frame("lower")?.position[0] - 1.0).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn inverse_kinematics_of(
        &mut self,
        frame: &str,
        target: &FrameTarget,
    ) -> Result<InverseKinematics, TreeError> {
        let frame = self.named(frame)?;
        // Rotation of the body relative to the reference configuration.
        let of_body = |rows| matrix(&rows) * frame.axes.transpose();
        let rotation = target.rotation.map(|axes| rows(&of_body(axes)));
        self.inverse_kinematics(frame.body, frame.at, &FrameTarget { rotation, ..*target })
    }

    /// Sets a position at rest, and closes the loops at this position.
    fn close_loops(&mut self, q: &[f64]) -> Result<(), TreeError> {
        let (before, v) = (self.q.clone(), self.v.clone());
        let rest = vec![0.0; v.len()];
        self.set(q, &rest)?;
        if self.loops.rows == 0 {
            return Ok(());
        }
        let closed = match &mut self.closing {
            None => fictitious::close(&mut self.inner),
            Some(closing) => {
                closing.state().copy_from(self.inner.state());
                let closed = fictitious::close(closing);
                self.inner.state().z.copy_from_slice(&closing.state().z);
                closed
            }
        };
        if let Err(reason) = closed {
            self.set(&before, &v)?;
            return Err(TreeError::of_model(TreeErrorKind::OpenLoops, (reason, &self.names)));
        }
        let mut q = core::mem::take(&mut self.q);
        self.layout.coordinates_outward(&self.inner.state().z, &mut q);
        self.q = q;
        Ok(())
    }
}

/// Target of a search, and the ranges that the joints must not leave.
struct Search {
    body: BodyId,
    at: [f64; 3],
    target: FrameTarget,
    length: f64,
    /// Ranges that joints must not leave. Each entry has the index of the coordinate in q and in v, the joint, and both ends of the range.
    ranges: Vec<([usize; 2], JointId, [f64; 2])>,
}

impl Search {
    fn new(tree: &Tree, (body, at): (BodyId, [f64; 3]), target: FrameTarget) -> Self {
        let joints = tree.scene.joints.iter().enumerate();
        let ranges = joints.filter_map(|(j, joint)| {
            let (range, own) = (joint.limits.range?, tree.layout.range(j)?);
            let q = tree.q[own.q.start];
            let is_inside = own.v.len() == 1 && (range[0]..=range[1]).contains(&q);
            is_inside.then_some(([own.q.start, own.v.start], JointId::new(j), range))
        });
        let length = with!(&tree.inner, tree => tree.model.length());
        Self { body, at, target, length, ranges: ranges.collect() }
    }

    /// Difference between target and body [-]: position divided by the scene's length, then a rotation vector.
    fn error(&self, tree: &mut Tree) -> Vec<f64> {
        let mut error = Vec::with_capacity(6);
        if let Some(target) = self.target.position {
            let now = tree.point(self.body, self.at).position;
            error.extend(target.iter().zip(now).map(|(x, y)| (x - y) / self.length));
        }
        if let Some(target) = self.target.rotation {
            let now = matrix(&tree.pose(self.body).rotation);
            error.extend(rotation_vector(&(matrix(&target) * now.transpose())).iter());
        }
        error
    }

    /// Computes a step δ from a position, such that to first order no coordinate leaves its range.
    fn step(&self, tree: &mut Tree, (q, error): (&[f64], &[f64]), damping: f64) -> Vec<f64> {
        let jacobian = tree.jacobian_at(self.body, self.at).clone();
        let loops = tree.loop_jacobian().clone();
        let mut rows: Vec<Vec<f64>> = Vec::new();
        if self.target.position.is_some() {
            rows.extend((0..3).map(|i| jacobian.row(i).iter().map(|x| x / self.length).collect()));
        }
        if self.target.rotation.is_some() {
            rows.extend((3..6).map(|i| jacobian.row(i).to_vec()));
        }
        let asked = rows.len();
        rows.extend((0..loops.rows).map(|i| loops.row(i).to_vec()));
        let mu = damping * dot(error, error);
        let mut right = error.to_vec();
        right.resize(rows.len(), 0.0);
        // Each range becomes active at most once, which limits the number of repetitions.
        for _ in 0..=self.ranges.len() {
            let mut square: Vec<Vec<f64>> =
                rows.iter().map(|a| rows.iter().map(|b| dot(a, b)).collect()).collect();
            (0..asked).for_each(|i| square[i][i] += mu);
            let y = solve(square, right.clone());
            let mut step = vec![0.0; jacobian.columns];
            for (row, y) in rows.iter().zip(&y) {
                step.iter_mut().zip(row).for_each(|(step, x)| *step += x * y);
            }
            let largest = step.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
            let scale = if largest > LARGEST_STEP { LARGEST_STEP / largest } else { 1.0 };
            step.iter_mut().for_each(|x| *x *= scale);
            let mut is_inside = true;
            for &([place, number], _, [lower, upper]) in &self.ranges {
                let is_out = (q[place] <= lower && step[number] < 0.0)
                    || (q[place] >= upper && step[number] > 0.0);
                if is_out {
                    rows.iter_mut().for_each(|row| row[number] = 0.0);
                    is_inside = false;
                }
            }
            if is_inside {
                return step;
            }
        }
        vec![0.0; jacobian.columns]
    }

    /// Moves coordinates that left their range to the end of the range.
    fn keep(&self, q: &mut [f64]) {
        for &([place, _], _, [lower, upper]) in &self.ranges {
            q[place] = q[place].clamp(lower, upper);
        }
    }

    /// True if all coordinates are in their ranges, to machine precision.
    fn is_kept(&self, q: &[f64]) -> bool {
        let is_in = |q: f64, [lower, upper]: [f64; 2]| {
            let room = (upper - lower) * REACHED;
            q >= lower - room && q <= upper + room
        };
        self.ranges.iter().all(|&([place, _], _, range)| is_in(q[place], range))
    }

    /// Lists the joints that are at an end of their range.
    fn held(&self, q: &[f64]) -> Vec<JointId> {
        let is_at = |q: f64, [lower, upper]: [f64; 2]| q <= lower || q >= upper;
        let at = self.ranges.iter().filter(|&&([place, _], _, range)| is_at(q[place], range));
        at.map(|&(_, joint, _)| joint).collect()
    }
}

/// True if the matrix is orthogonal and right-handed, to six digits.
fn is_rotation(rows: &[[f64; 3]; 3]) -> bool {
    let rotation = matrix(rows);
    let off = (rotation * rotation.transpose() - Square::<f64, 3>::identity()).amax();
    let third = cross(&Vector::from(rows[0]), &Vector::from(rows[1]));
    off < ORTHOGONAL && third.dot(&Vector::from(rows[2])) > 0.0
}

fn matrix(rows: &[[f64; 3]; 3]) -> Square<f64, 3> {
    Square::<f64, 3>::from_fn(|i, j| rows[i][j])
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// Solves a symmetric positive semidefinite system by L D Lᵀ; redundant rows get a tiny pivot instead of zero.
fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    let size = (0..n).fold(0.0_f64, |s, i| s.max(a[i][i]));
    for k in 0..n {
        a[k][k] += REPEATED * size;
        let pivot = if a[k][k] > 0.0 { a[k][k] } else { f64::INFINITY };
        for i in k + 1..n {
            let factor = a[i][k] / pivot;
            for j in k + 1..n {
                let x = a[k][j];
                a[i][j] -= factor * x;
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        let rest: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = if a[k][k] > 0.0 { (b[k] - rest) / a[k][k] } else { 0.0 };
    }
    b
}

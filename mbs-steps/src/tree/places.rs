//! Positions of bodies and frames of a [`Tree`], and the momentum of all bodies.

use super::Tree;
use super::inner::{Inner, with};
use crate::erased::error::UnknownName;
use crate::erased::values::{Pose, rows};
use crate::motion::frame;
use mbs_core::algebra::{Matrix, Vector, cross};
use mbs_core::cluster::mass_properties;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::BodyId;

/// Motion of a frame at an instant, in global axes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FrameMotion {
    /// Origin of the frame [m].
    pub position: [f64; 3],
    /// Rotation matrix of the frame, by rows: its columns are the directions of the axes x, y and z.
    pub rotation: [[f64; 3]; 3],
    /// Velocity of its origin [m/s].
    pub velocity: [f64; 3],
    /// Angular velocity of the frame [rad/s].
    pub angular_velocity: [f64; 3],
}

/// Momentum of all bodies, in global axes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TotalMomentum {
    /// Linear momentum: total mass times velocity of the centre of mass [kg m/s].
    pub linear: [f64; 3],
    /// Angular momentum about the centre of mass of all bodies [kg m²/s].
    pub angular: [f64; 3],
}

/// A frame in the reference configuration.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    pub body: BodyId,
    pub at: [f64; 3],
    pub axes: Matrix<f64, 3>,
}

impl Tree {
    /// Centre of mass of a body, and its rotation from the reference configuration. For the ground the position is the origin.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// tree.set(&[std::f64::consts::FRAC_PI_2, 0.0], &[0.0, 0.0])?;
    /// assert!((tree.pose(mbs::BodyId::new(1)).position[1] - 1.5).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn pose(&mut self, body: BodyId) -> Pose {
        let Some(b) = body.index() else { return Pose::default() };
        let center = self.shares[b].1;
        let motion = self.motions()[b];
        Pose { position: motion.point(&center.into())[0].into(), rotation: rows(&motion.rotation) }
    }

    /// Motion of a `[[frame]]` of the scene, by name. If there is no such frame, but a body has the name, it is the motion of the body's
    /// centre of mass, as in [`centers`](Self::centers). The axes are then the body axes that were the global axes in the reference
    /// configuration.
    ///
    /// # Errors
    /// [`UnknownName`], which suggests the most similar name.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// tree.set(&[0.0, 0.0], &[2.0, 0.0])?;
    /// let lower = tree.frame("lower")?;
    /// assert_eq!((lower.velocity, lower.angular_velocity), ([0.0, 3.0, 0.0], [0.0, 0.0, 2.0]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn frame(&mut self, name: &str) -> Result<FrameMotion, UnknownName> {
        self.motions();
        self.named(name).map(|frame| self.moved(frame))
    }

    /// Motions of all frames of the scene, each with its name. Then follow all bodies that have no frame of their name, as in
    /// [`frame`](Self::frame).
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// let names: Vec<&str> = tree.frames().map(|(name, _)| name).collect();
    /// assert_eq!(names, ["upper", "lower"]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn frames(&mut self) -> impl Iterator<Item = (&str, FrameMotion)> {
        self.motions();
        self.placed()
    }

    /// Motions of the centres of mass of all bodies, each with the body's name. Their axes are the body axes that were the global axes in
    /// the reference configuration.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// let places: Vec<_> = tree.centers().map(|(name, center)| (name, center.position[0])).collect();
    /// assert_eq!(places, [("upper", 0.5), ("lower", 1.5)]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn centers(&mut self) -> impl Iterator<Item = (&str, FrameMotion)> {
        self.motions();
        self.bodies().map(|(name, frame)| (name, self.moved(frame)))
    }

    /// Motions of all frames, from the body motions that were evaluated last.
    fn placed(&self) -> impl Iterator<Item = (&str, FrameMotion)> {
        self.known().map(|(name, frame)| (name, self.moved(frame)))
    }

    /// Motion of a frame, from the body motions that were evaluated last.
    fn moved(&self, Frame { body, at, axes }: Frame) -> FrameMotion {
        let motions = with!(&self.inner, tree => &tree.motions);
        let at_rest = RigidMotion::at_rest(at.into());
        let motion = body.index().map_or(at_rest, |b| motions[b]);
        let [position, velocity, _] = motion.point(&at.into()).map(Into::into);
        let (rotation, angular_velocity) = (rows(&(motion.rotation * axes)), motion.omega.into());
        FrameMotion { position, rotation, velocity, angular_velocity }
    }

    /// All frames of the scene with their names. Then follow all bodies that have no frame of their name.
    fn known(&self) -> impl Iterator<Item = (&str, Frame)> {
        let bodies = self.bodies().zip(&self.has_frame);
        let bodies = bodies.filter_map(|(body, &has_frame)| (!has_frame).then_some(body));
        self.own_frames().chain(bodies)
    }

    /// Frames of the scene with their names.
    fn own_frames(&self) -> impl Iterator<Item = (&str, Frame)> {
        self.scene.frames.iter().map(|x| {
            let frame = Frame { body: x.body, at: x.at, axes: axes(x.axes) };
            (x.name.as_str(), frame)
        })
    }

    /// Centres of mass of all bodies as frames, with the names of the bodies.
    fn bodies(&self) -> impl Iterator<Item = (&str, Frame)> {
        self.scene.bodies.iter().zip(&self.shares).map(|(x, &(body, at, _))| {
            (x.name.as_str(), Frame { body, at, axes: Matrix::<f64, 3>::identity() })
        })
    }

    /// Returns the frame with this name, which is a frame of the scene or a body.
    pub fn named(&self, name: &str) -> Result<Frame, UnknownName> {
        let found = self.known().find(|(known, _)| *known == name);
        found.map(|(_, frame)| frame).ok_or_else(|| {
            let known = self.known().map(|(name, _)| name.to_owned()).collect();
            UnknownName { word: "frame", name: name.to_owned(), known }
        })
    }

    /// Linear and angular momentum of all bodies.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// tree.set(&[0.0, 0.0], &[1.0, 0.0])?;
    /// // a rod of 2 kg and 2 m that turns about its end: m v, and m l²/12
    /// let momentum = tree.momentum();
    /// assert!((momentum.linear[1] - 2.0).abs() < 1e-12 && (momentum.angular[2] - 2.0 / 3.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn momentum(&mut self) -> TotalMomentum {
        let center = Vector::<f64, 3>::from(self.center_of_mass().position);
        // The call above evaluated the motions of all bodies.
        let motions = with!(&self.inner, tree => &tree.motions);
        let (mut linear, mut angular) = (Vector::<f64, 3>::zeros(), Vector::<f64, 3>::zeros());
        for (b, motion) in motions.iter().enumerate() {
            let (mass, own, inertia) = mass_properties(&self.scene, b);
            let [at, velocity, _] = motion.point(&own);
            let inertia = motion.rotation * inertia * motion.rotation.transpose();
            linear += velocity * mass;
            angular += inertia * motion.omega + cross(&(at - center), &velocity) * mass;
        }
        TotalMomentum { linear: linear.into(), angular: angular.into() }
    }
}

/// Axes of a frame, as columns of a matrix; the global axes if the scene gives none.
fn axes(axes: Option<[[f64; 3]; 2]>) -> Matrix<f64, 3> {
    axes.map_or_else(Matrix::<f64, 3>::identity, |axes| {
        Matrix::<f64, 3>::from_columns(&frame(axes).map(Vector::<f64, 3>::from))
    })
}

//! Options for reading a model.

use std::path::{Path, PathBuf};

/// Base of a model: its root link is fixed to the ground or moves freely.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BaseKind {
    /// The root link is fixed to the ground.
    Fixed,
    /// The root link moves freely.
    Free,
}

/// Stiffness and damping of the stops at the limits of joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stops {
    /// Values estimated from the mass that the joint moves.
    ByMass,
    /// Given stiffness and damping [N m/rad and N m s/rad, or N/m and N s/m].
    Given {
        /// Stiffness of the stop.
        stiffness: f64,
        /// Damping of the stop.
        damping: f64,
    },
}

/// Environment variables with folders of packages and models, as in ROS and Gazebo.
const SEARCH_PATHS: [&str; 3] = ["ROS_PACKAGE_PATH", "SDF_PATH", "GZ_SIM_RESOURCE_PATH"];

/// Options for reading a model.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ImportOptions {
    /// Base of the model. With `None`, the file decides; a URDF without this information gets a fixed base.
    pub base: Option<BaseKind>,
    /// Stops at limits that have no stiffness in the file. With `None`, such limits are written as data, without stops.
    pub limits: Option<Stops>,
    /// True if impossible inertias are corrected. The two smaller principal moments are then raised by the least amount that is needed.
    pub balance: bool,
    /// Fixed joints that become weld joints of the scene, so that their reaction is available.
    pub keep_fixed: Vec<String>,
    /// Name of the MJCF keyframe that gives the initial state.
    pub key: Option<String>,
    /// Folder of the file, to which includes are relative; `None` refuses includes.
    pub folder: Option<PathBuf>,
    /// True if files outside the folder of the model are refused.
    pub no_outside: bool,
    /// Folder of the scene, to which paths of meshes are relative. With `None`, they are relative to the folder of the model.
    pub scene_folder: Option<PathBuf>,
    /// Folders of packages, each with the package's name.
    pub packages: Vec<(String, PathBuf)>,
    /// Folders that contain packages and models.
    pub package_path: Vec<PathBuf>,
    /// True if each moving joint gets an input, unless an actuator of the file drives it.
    pub motors: bool,
    /// True if a mesh whose mass is needed counts as massless. A finding then reports it.
    pub massless_meshes: bool,
    /// True if impossible inertias are left out and reported. The scene then serves for positions, Jacobians and inverse kinematics.
    pub geometry_alone: bool,
}

impl ImportOptions {
    /// Options for a model in a folder, with the search paths of the environment variables `ROS_PACKAGE_PATH`, `SDF_PATH` and
    /// `GZ_SIM_RESOURCE_PATH`.
    #[must_use]
    pub fn in_folder(folder: PathBuf) -> Self {
        let paths = SEARCH_PATHS.into_iter().filter_map(std::env::var_os);
        let paths = paths.flat_map(|paths| std::env::split_paths(&paths).collect::<Vec<_>>());
        Self { folder: Some(folder), package_path: paths.collect(), ..Self::default() }
    }

    /// Folder to which paths in the scene are relative, if it is known.
    pub(crate) fn scene_home(&self) -> Option<&Path> {
        self.scene_folder.as_deref().or(self.folder.as_deref())
    }
}

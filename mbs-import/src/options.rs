//! Options that a user may give a reader.

use std::path::{Path, PathBuf};

/// Whether the root of a model stands on the ground or moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BaseKind {
    /// The root is fixed to the ground.
    Fixed,
    /// The root moves freely.
    Free,
}

/// Choice of the stiffness and damping of stops at the ends of joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stops {
    /// Stiffness and damping by the mass that they move.
    ByMass,
    /// Given stiffness and damping [N m/rad and N m s/rad, or N/m and N s/m].
    Given {
        /// Stiffness of the stop.
        stiffness: f64,
        /// Damping of the stop.
        damping: f64,
    },
}

/// Folders of packages and models, as other programs have them.
const SEARCH_PATHS: [&str; 3] = ["ROS_PACKAGE_PATH", "SDF_PATH", "GZ_SIM_RESOURCE_PATH"];

/// Options that a user may give a reader.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ImportOptions {
    /// Base of the model; `None`: as the file says, and fixed where a URDF says nothing.
    pub base: Option<BaseKind>,
    /// Stops at the ends of ranges that have no stiffness in the file; `None`: the ranges are data.
    pub limits: Option<Stops>,
    /// Whether impossible inertias are mended by the least raise of the two smaller moments.
    pub balance: bool,
    /// Fixed joints that stay joints, so that they have a reaction.
    pub keep_fixed: Vec<String>,
    /// The keyframe of an MJCF from which it starts.
    pub key: Option<String>,
    /// The folder of the file, from which it includes others; `None` refuses includes.
    pub folder: Option<PathBuf>,
    /// Whether a file outside of that folder is refused.
    pub no_outside: bool,
    /// The folder of the scene, from which it names files of meshes; `None`: that of the model.
    pub scene_folder: Option<PathBuf>,
    /// Folders of packages by their names.
    pub packages: Vec<(String, PathBuf)>,
    /// Folders in which packages and models lie.
    pub package_path: Vec<PathBuf>,
    /// Whether each joint that moves gets an input, where no actuator of the file drives it.
    pub motors: bool,
    /// Whether meshes whose mass is needed count as massless, and are reported.
    pub massless_meshes: bool,
    /// Whether inertias that no body has are left out, and reported: for places, Jacobians and inverse kinematics.
    pub geometry_alone: bool,
}

impl ImportOptions {
    /// Options for a model in a folder, with the search paths of the environment: `ROS_PACKAGE_PATH`, `SDF_PATH`, `GZ_SIM_RESOURCE_PATH`.
    #[must_use]
    pub fn in_folder(folder: PathBuf) -> Self {
        let paths = SEARCH_PATHS.into_iter().filter_map(std::env::var_os);
        let paths = paths.flat_map(|paths| std::env::split_paths(&paths).collect::<Vec<_>>());
        Self { folder: Some(folder), package_path: paths.collect(), ..Self::default() }
    }

    /// Folder from which the scene names files, if that is known.
    pub(crate) fn scene_home(&self) -> Option<&Path> {
        self.scene_folder.as_deref().or(self.folder.as_deref())
    }
}

//! Shapes on bodies and on the ground, in the reference configuration. Pictures show them; they have no mass.

use crate::scene::BodyId;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// Shape that moves with its body, or is fixed to the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyShape<T> {
    /// Unique name among the shapes.
    pub name: String,
    /// Body that the shape moves with, or the ground.
    pub body: BodyId,
    /// Form of the shape, with its dimensions.
    pub form: ShapeKind<T>,
    /// Red, green and blue, each from 0 to 255; `None`: the colour of the body.
    pub colour: Option<[u8; 3]>,
    /// Opacity from 0 (invisible) to 1 (opaque) [-].
    pub opacity: T,
    /// True if the shape is for pictures only.
    pub is_visual: bool,
}

impl<T> BodyShape<T> {
    /// Colour of the shape as `#rrggbb`.
    #[must_use]
    pub fn colour_code(&self) -> Option<String> {
        self.colour.map(|[red, green, blue]| format!("#{red:02x}{green:02x}{blue:02x}"))
    }
}

/// Form of a shape. Places and lengths are in the reference configuration [m].
#[derive(Debug, Clone, PartialEq)]
pub enum ShapeKind<T> {
    /// Box in a spatial scene.
    Box {
        /// Centre of the box.
        center: [T; 3],
        /// Lengths of the box along its axes.
        size: [T; 3],
        /// First and second axis of the box, of any length; `None`: x and y.
        axes: Option<[[T; 3]; 2]>,
    },
    /// Sphere in a spatial scene.
    Sphere {
        /// Centre of the sphere.
        center: [T; 3],
        /// Radius of the sphere.
        radius: T,
    },
    /// Cylinder with hemispherical ends. In the plane, a bar with semicircular ends.
    Capsule {
        /// Centre of one end.
        from: [T; 3],
        /// Centre of the other end.
        to: [T; 3],
        /// Radius of the capsule.
        radius: T,
    },
    /// Cylinder with flat ends in a spatial scene.
    Cylinder {
        /// Centre of one end.
        from: [T; 3],
        /// Centre of the other end.
        to: [T; 3],
        /// Radius of the cylinder.
        radius: T,
    },
    /// Disc in a planar scene.
    Disc {
        /// Centre of the disc.
        center: [T; 3],
        /// Radius of the disc.
        radius: T,
    },
    /// Polygon in a planar scene.
    Polygon {
        /// Corners of the polygon, in order.
        points: Vec<[T; 3]>,
    },
    /// Surface of triangles in a spatial scene, from a file that only pictures read.
    Mesh {
        /// File with the triangles: STL, OBJ or MSH.
        file: String,
        /// Place of the origin of the file.
        at: [T; 3],
        /// First and second axis of the file, of any length; `None`: x and y.
        axes: Option<[[T; 3]; 2]>,
        /// Scale factors along the axes of the file; a negative one mirrors [-].
        scale: [T; 3],
    },
}

impl<T> ShapeKind<T> {
    /// Key of the form in scene files.
    #[must_use]
    pub const fn key(&self) -> &'static str {
        match self {
            Self::Box { .. } => "box",
            Self::Sphere { .. } => "sphere",
            Self::Capsule { .. } => "capsule",
            Self::Cylinder { .. } => "cylinder",
            Self::Disc { .. } => "disc",
            Self::Polygon { .. } => "polygon",
            Self::Mesh { .. } => "mesh",
        }
    }

    /// Returns whether planar scenes can have the form, then whether spatial scenes can.
    #[must_use]
    pub const fn dimensions(&self) -> [bool; 2] {
        match self {
            Self::Box { .. } | Self::Sphere { .. } | Self::Cylinder { .. } | Self::Mesh { .. } => {
                [false, true]
            }
            Self::Capsule { .. } => [true, true],
            Self::Disc { .. } | Self::Polygon { .. } => [true, false],
        }
    }
}

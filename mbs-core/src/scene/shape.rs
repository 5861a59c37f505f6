//! Forms on bodies and on the ground, in the reference configuration: pictures draw them, and they carry no mass.

use crate::scene::BodyId;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// A form that moves with its body, or stands on the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyShape<T> {
    /// Unique name among the shapes.
    pub name: String,
    /// Body that the form moves with, or the ground.
    pub body: BodyId,
    /// Form of the shape, with its sizes.
    pub form: ShapeKind<T>,
    /// Red, green and blue, each up to 255; `None`: those of its body.
    pub colour: Option<[u8; 3]>,
    /// From 0, not seen, to 1 [-].
    pub opacity: T,
    /// Is it for pictures alone?
    pub is_visual: bool,
}

impl<T> BodyShape<T> {
    /// Colour of the shape as `#rrggbb`.
    #[must_use]
    pub fn colour_code(&self) -> Option<String> {
        self.colour.map(|[red, green, blue]| format!("#{red:02x}{green:02x}{blue:02x}"))
    }
}

/// Form of a shape; places and lengths in the reference configuration [m].
#[derive(Debug, Clone, PartialEq)]
pub enum ShapeKind<T> {
    /// A box of space.
    Box {
        /// Centre of the box.
        center: [T; 3],
        /// Lengths of the box along its axes.
        size: [T; 3],
        /// First and second axis of the box, any length; `None`: x and y.
        axes: Option<[[T; 3]; 2]>,
    },
    /// A sphere of space.
    Sphere {
        /// Centre of the sphere.
        center: [T; 3],
        /// Radius of the sphere.
        radius: T,
    },
    /// A cylinder with round ends; in the plane a bar with round ends.
    Capsule {
        /// The centre of one end.
        from: [T; 3],
        /// The centre of the other end.
        to: [T; 3],
        /// Radius of the capsule.
        radius: T,
    },
    /// A cylinder of space with flat ends.
    Cylinder {
        /// The centre of one end.
        from: [T; 3],
        /// The centre of the other end.
        to: [T; 3],
        /// Radius of the cylinder.
        radius: T,
    },
    /// A disc of the plane.
    Disc {
        /// Centre of the disc.
        center: [T; 3],
        /// Radius of the disc.
        radius: T,
    },
    /// A polygon of the plane.
    Polygon {
        /// Corners of the polygon, one after the other.
        points: Vec<[T; 3]>,
    },
    /// A surface of triangles of space, from a file that only pictures read.
    Mesh {
        /// File with the triangles: STL, OBJ or MSH.
        file: String,
        /// Place of the origin of the file.
        at: [T; 3],
        /// The file's first and second axis, any length; `None`: x and y.
        axes: Option<[[T; 3]; 2]>,
        /// Factors of the file's numbers along its axes; a negative one mirrors [-].
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

    /// Whether planar scenes have it, and whether spatial ones do.
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

//! Kinds of joint as data: the relative motions that each one allows. Equations and coordinates follow from this table, which needs no
//! allocation.
//!
//! The vector p leads from the first body's point to the second's. u is a direction perpendicular to all slides, a and b are axes of the
//! two bodies. v and w are perpendicular to the common axis, v in the first body and w in the second. x is a direction of the first body
//! in the plane, y one of the second.
//!
//! | freedoms | equations |
//! |---|---|
//! | no slide; slides | p = 0; p.u = 0 for each u across all slides |
//! | no turn | space: the axis is common, and v.w = 0; plane: x.y = 0 |
//! | one turn | space: the axis is common; plane: none |
//! | two turns | a.b = const |
//! | ball | none |
//!
//! A link connects two points at a fixed distance. It has no freedoms in the table, since it has no joint coordinates; its equation is
//! separate. A joint can transmit the wrenches of its equations. In relative coordinates it is one link of the tree for each freedom.

use super::Dimension;
use Axis::{First, Second, Third, X, Y, Z};
use Freedom::{Ball, Slide, Turn};
use core::mem::discriminant;

/// Direction that belongs to a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// The joint's first axis.
    First,
    /// The joint's second axis. For a slide: its component perpendicular to the first axis.
    Second,
    /// Vector product of the first and the second axis.
    Third,
    /// Global x in the reference configuration.
    X,
    /// Global y in the reference configuration.
    Y,
    /// Global z in the reference configuration.
    Z,
}

/// Relative motion of the second body relative to the first that a joint allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Freedom {
    /// Translation along a direction of the first body; one coordinate.
    Slide(Axis),
    /// Rotation about an axis; one coordinate. If there are two, the first axis is fixed in the first body and the second axis in the
    /// second body.
    Turn(Axis),
    /// Any rotation of a ball. Its coordinates are the components of the rotation vector in global axes of the reference configuration.
    Ball,
}

impl Freedom {
    /// Number of coordinates of the freedom.
    #[must_use]
    pub const fn n_coordinates(self) -> usize {
        match self {
            Slide(_) | Turn(_) => 1,
            Ball => 3,
        }
    }

    /// Unit of the coordinates of the freedom.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Slide(_) => "m",
            Turn(_) | Ball => "rad",
        }
    }

    /// Number of rotations among the coordinates of the freedom.
    #[must_use]
    pub const fn n_rotations(self) -> usize {
        match self {
            Slide(_) => 0,
            Turn(_) | Ball => self.n_coordinates(),
        }
    }

    /// Axis of the freedom; `None` for a ball.
    #[must_use]
    pub const fn axis(self) -> Option<Axis> {
        match self {
            Slide(axis) | Turn(axis) => Some(axis),
            Ball => None,
        }
    }
}

/// Constraint on the translation of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Translation {
    /// The points of the joint coincide.
    Fixed,
    /// The points move along a line.
    Along(Axis),
    /// The points move in the plane perpendicular to a direction.
    Across(Axis),
    /// The translation is not constrained.
    Free,
}

/// Constraint on the rotation of a joint. In a planar scene the rotation is fixed or free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rotation {
    /// The bodies do not rotate relative to each other.
    Fixed,
    /// The bodies have an axis in common.
    About(Axis),
    /// An axis of the first body has a constant angle with an axis of the second body.
    Universal([Axis; 2]),
    /// The rotation is not constrained.
    Free,
}

/// Form of a kind of joint: its name and its freedoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct JointForm {
    /// Name in scene files.
    pub name: &'static str,
    /// Freedoms in a planar scene, in the order of the joint's coordinates; `None`: the kind is spatial only.
    pub planar: Option<&'static [Freedom]>,
    /// Freedoms in a spatial scene, slides first.
    pub spatial: &'static [Freedom],
    /// Whether the joint is a link: two points at a fixed distance. In space an axis makes it a hinge at the first body.
    pub is_link: bool,
    /// Whether the second body is a point mass, which has no orientation. Such a joint has slides only and constrains nothing.
    pub is_of_point: bool,
}

const fn form(
    name: &'static str,
    planar: Option<&'static [Freedom]>,
    spatial: &'static [Freedom],
) -> JointForm {
    JointForm { name, planar, spatial, is_link: false, is_of_point: false }
}

macro_rules! kinds {
    ($($(#[$meta:meta])* $kind:ident = $form:expr;)* [$(#[$of_meta:meta])* $of_kind:ident = $of_form:expr;]) => {
        /// Kinds of joint that a scene may have.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum JointKind {
            $($(#[$meta])* $kind,)*
            $(#[$of_meta])* $of_kind,
        }

        impl JointKind {
            /// All kinds that scene files can name, in the order of the scene format.
            pub const ALL: [Self; JOINTS.len()] = [$(Self::$kind),*];

            /// Form of the kind: its name and its freedoms.
            #[must_use]
            pub const fn form(self) -> &'static JointForm {
                const FORMS: &[JointForm] = &[$($form,)* $of_form];
                &FORMS[self as usize]
            }
        }

        /// Forms of the kinds in [`JointKind::ALL`], in the same order.
        pub const JOINTS: [JointForm; [$(stringify!($kind)),*].len()] = [$($form),*];
    };
}

kinds! {
    /// Hinge: a common point and axis; rotation about the axis.
    Revolute = form("revolute", Some(&[Turn(Z)]), &[Turn(First)]);
    /// Ball joint: a common point (spatial).
    Spherical = form("spherical", None, &[Ball]);
    /// Universal joint: a common point and two axes at a constant angle (spatial).
    Universal = form("universal", None, &[Turn(First), Turn(Second)]);
    /// Translation along an axis.
    Prismatic = form("prismatic", Some(&[Slide(First)]), &[Slide(First)]);
    /// Translation along an axis and rotation about it (spatial).
    Cylindrical = form("cylindrical", None, &[Slide(First), Turn(First)]);
    /// Plane that slides and rotates on a plane (spatial).
    Planar = form("planar", None, &[Slide(Second), Slide(Third), Turn(First)]);
    /// Pin of the second body in a straight slot of the first: translation along an axis, and any rotation.
    PinInSlot = form("pin-in-slot", Some(&[Slide(First), Turn(Z)]), &[Slide(First), Ball]);
    /// Rigid connection without relative motion.
    Weld = form("weld", Some(&[]), &[]);
    /// All relative motions: the joint has coordinates, but constrains nothing.
    Free = form(
        "free",
        Some(&[Slide(X), Slide(Y), Turn(Z)]),
        &[Slide(X), Slide(Y), Slide(Z), Ball],
    );
    /// Massless link between two points at a fixed distance, with two balls, or with a hinge at the first body.
    Distance = JointForm { is_link: true, ..form("distance", Some(&[]), &[]) };
    [
        /// All motions of a point mass relative to a body: the kind of a `free` joint if the second body is a point mass.
        FreePoint = JointForm {
            is_of_point: true,
            ..form("free", Some(&[Slide(X), Slide(Y)]), &[Slide(X), Slide(Y), Slide(Z)])
        };
    ]
}

impl JointKind {
    /// The name used in scene files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.form().name
    }

    /// True if the kind is allowed in spatial scenes only.
    #[must_use]
    pub const fn is_spatial_only(self) -> bool {
        self.form().planar.is_none()
    }

    /// True if the kind is a link between two points at a fixed distance.
    #[must_use]
    pub const fn is_link(self) -> bool {
        self.form().is_link
    }

    /// True if the kind connects two bodies rigidly.
    #[must_use]
    pub const fn is_rigid(self) -> bool {
        self.form().spatial.is_empty() && !self.is_link()
    }

    /// True if the kind is free of constraints.
    #[must_use]
    pub fn is_free(self) -> bool {
        self.is_of_point() || self.n_coordinates(Dimension::Spatial) == 6
    }

    /// Kind that the same name denotes if one of the bodies is a point mass.
    #[must_use]
    pub fn of_points(self) -> Self {
        if self.is_free() { Self::FreePoint } else { self }
    }

    /// True if the second body is a point mass, which has no orientation.
    #[must_use]
    pub const fn is_of_point(self) -> bool {
        self.form().is_of_point
    }

    /// True if the kind holds two points together and leaves the rotation free.
    #[must_use]
    pub fn is_ball(self, dimension: Dimension) -> bool {
        self.translation(dimension) == Translation::Fixed
            && self.rotation(dimension) == Rotation::Free
    }

    /// Freedoms of the kind in a scene of that dimension, in the order of the joint's coordinates.
    #[must_use]
    pub const fn freedoms(self, dimension: Dimension) -> &'static [Freedom] {
        match (dimension, self.form()) {
            (Dimension::Planar, JointForm { planar: Some(freedoms), .. }) => freedoms,
            (_, JointForm { spatial, .. }) => spatial,
        }
    }

    /// Freedoms of the kind in a scene of that dimension, each with the number of its first coordinate.
    pub fn numbered(self, dimension: Dimension) -> impl Iterator<Item = (usize, Freedom)> {
        self.freedoms(dimension).iter().scan(0, |next, &freedom| {
            let number = *next;
            *next += freedom.n_coordinates();
            Some((number, freedom))
        })
    }

    /// Number of joint coordinates in a scene of that dimension.
    #[must_use]
    pub fn n_coordinates(self, dimension: Dimension) -> usize {
        self.freedoms(dimension).iter().map(|freedom| freedom.n_coordinates()).sum()
    }

    /// Number of rotations among the joint coordinates in a scene of that dimension.
    #[must_use]
    pub fn n_rotations(self, dimension: Dimension) -> usize {
        self.freedoms(dimension).iter().map(|freedom| freedom.n_rotations()).sum()
    }

    /// Freedom of a kind with a single coordinate; `None` for other kinds.
    #[must_use]
    pub fn single(self, dimension: Dimension) -> Option<Freedom> {
        match self.freedoms(dimension) {
            [one] if one.n_coordinates() == 1 => Some(*one),
            _ => None,
        }
    }

    /// Freedom with a single coordinate of this number; `None` for a component of a rotation vector.
    #[must_use]
    pub fn freedom(self, dimension: Dimension, number: usize) -> Option<Freedom> {
        let mut freedoms = self.numbered(dimension);
        freedoms.find(|(at, freedom)| *at == number && *freedom != Ball).map(|(_, freedom)| freedom)
    }

    /// Name of a coordinate. A single slide is `slide`, a single turn `turn`. Several slides are `x`, `y`, `z`; several turns are `first`,
    /// `second`. A component of a rotation vector has no name.
    #[must_use]
    pub fn coordinate_name(self, dimension: Dimension, number: usize) -> Option<&'static str> {
        let freedom = self.freedom(dimension, number)?;
        let is_alike = |other: &&Freedom| discriminant(*other) == discriminant(&freedom);
        let mut alike = self.freedoms(dimension).iter().filter(is_alike);
        let place = alike.clone().position(|other| *other == freedom)?;
        match (freedom, alike.nth(1)) {
            (Slide(_), None) => Some("slide"),
            (Slide(_), Some(_)) => ["x", "y", "z"].get(place).copied(),
            (_, None) => Some("turn"),
            (_, Some(_)) => ["first", "second"].get(place).copied(),
        }
    }

    /// Names of the joint coordinates, each with its index.
    pub fn coordinate_names(
        self,
        dimension: Dimension,
    ) -> impl Iterator<Item = (usize, &'static str)> {
        let name = move |number| Some((number, self.coordinate_name(dimension, number)?));
        (0..self.n_coordinates(dimension)).filter_map(name)
    }

    /// Coordinate on which an effect acts by default: the only one, or else the first turn.
    #[must_use]
    pub fn default_coordinate(self, dimension: Dimension) -> Option<usize> {
        let only = self.single(dimension).map(|_| 0);
        only.or_else(|| self.turn(dimension).map(|(number, _)| number))
    }

    /// Coordinate `given`, or the [default](Self::default_coordinate) if it is `None`.
    #[must_use]
    pub fn coordinate_or_default(
        self,
        given: Option<usize>,
        dimension: Dimension,
    ) -> Option<usize> {
        given.or_else(|| self.default_coordinate(dimension))
    }

    /// Index of the first turn about an axis, with the axis.
    #[must_use]
    pub fn turn(self, dimension: Dimension) -> Option<(usize, Axis)> {
        self.numbered(dimension).find_map(|(number, freedom)| match freedom {
            Turn(axis) => Some((number, axis)),
            Slide(_) | Ball => None,
        })
    }

    /// Index of the first component of the rotation vector, if the kind has one.
    #[must_use]
    pub fn ball(self, dimension: Dimension) -> Option<usize> {
        let mut freedoms = self.numbered(dimension);
        freedoms.find(|(_, freedom)| *freedom == Ball).map(|(number, _)| number)
    }

    /// Constraint of the joint on translation; a [link](Self::is_link) has a separate equation.
    #[must_use]
    pub fn translation(self, dimension: Dimension) -> Translation {
        let mut slides = self.freedoms(dimension).iter().filter_map(|freedom| match freedom {
            Slide(axis) => Some(*axis),
            Turn(_) | Ball => None,
        });
        match (slides.next(), slides.next(), slides.next(), dimension) {
            _ if self.is_link() => Translation::Free,
            (None, ..) => Translation::Fixed,
            (Some(axis), None, ..) => Translation::Along(axis),
            (Some(a), Some(b), None, Dimension::Spatial) => Translation::Across(across(a, b)),
            (Some(_), Some(_), ..) => Translation::Free,
        }
    }

    /// Constraint of the joint on rotation; a [link](Self::is_link) has a separate equation.
    #[must_use]
    pub fn rotation(self, dimension: Dimension) -> Rotation {
        let mut turns = self.freedoms(dimension).iter().filter(|freedom| freedom.n_rotations() > 0);
        match (turns.next(), turns.next(), dimension) {
            _ if self.is_link() || self.is_of_point() => Rotation::Free,
            (None, ..) => Rotation::Fixed,
            (Some(Turn(axis)), None, Dimension::Spatial) => Rotation::About(*axis),
            (Some(Turn(a)), Some(Turn(b)), Dimension::Spatial) => Rotation::Universal([*a, *b]),
            (Some(_), ..) => Rotation::Free,
        }
    }

    /// Flags of the first and of the second axis: true if the joint needs the axis in a scene of that dimension.
    #[must_use]
    pub fn needs_axes(self, dimension: Dimension) -> [bool; 2] {
        let needs = |own| {
            let axes = self.freedoms(dimension).iter().filter_map(|freedom| freedom.axis());
            axes.into_iter().any(|axis| axis == own || axis == Third)
        };
        // a slide along the second axis uses its component perpendicular to the first, and needs both axes
        let [first, second] = [First, Second].map(needs);
        [first || self.slides_along(Second, dimension), second]
    }

    /// Keys of the two axes in scene files.
    #[must_use]
    pub fn axis_keys(self, dimension: Dimension) -> [&'static str; 2] {
        match self.needs_axes(dimension) {
            [_, false] => ["axis"; 2],
            [_, true] if self.slides_along(Second, dimension) => ["axis", "direction"],
            [_, true] => ["axes"; 2],
        }
    }

    /// True if the joint slides along this axis.
    #[must_use]
    pub fn slides_along(self, axis: Axis, dimension: Dimension) -> bool {
        self.freedoms(dimension).contains(&Slide(axis))
    }
}

/// Third direction of the frame to which the two given directions belong.
fn across(a: Axis, b: Axis) -> Axis {
    let frame = match a {
        First | Second | Third => [First, Second, Third],
        X | Y | Z => [X, Y, Z],
    };
    frame.into_iter().find(|&axis| axis != a && axis != b).unwrap_or(a)
}

//! The list of quantities: all that the rest of the workspace knows of them.
//!
//! A line has what the quantity is, its kind and its module, under what it is of; the first line of a body's or a joint's is the
//! quantity where a scene file names none. The module is the constructor's name.

/// Hands the list of quantities to a macro of `table`.
macro_rules! list {
    ($then:ident) => {
        crate::outputs::quantity::table::$then! {
            point {
                /// Position of a point of a body [m], global axes.
                Position in position;
                /// Velocity of a point of a body [m/s], global axes.
                Velocity in velocity;
                /// Acceleration of a point of a body [m/s^2], global axes.
                Acceleration in acceleration;
            }
            body {
                /// Angular velocity of a body [rad/s], global axes; in the plane one number. Of a thin rod that balls alone hold, the part across it.
                AngularVelocity in angular_velocity;
            }
            joint {
                /// Coordinates of a joint [rad or m], turns counted.
                JointValue in value;
                /// Rates of a joint [rad/s or m/s].
                JointRate in rate;
                /// What a joint's first body does to the second at the joint's place [N, N m]: planar [Fx, Fy, Mz], spatial [Fx, Fy, Fz, Mx, My, Mz].
                Reaction in reaction;
            }
        }
    };
}

pub(super) use list;

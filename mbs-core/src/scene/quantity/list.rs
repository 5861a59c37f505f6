//! List of quantities: all data from which the rest of the workspace derives its quantities.
//!
//! Each line has the description of a quantity, its kind and its module, below the kind of its target. For a body, joint, coupling
//! or effect, the first line is the default quantity of an output in a scene file. The module, in `outputs/quantity`, has the
//! constructor's name.

/// Passes the list of quantities to a macro, which is given by its path.
macro_rules! list {
    ($($then:tt)+) => {
        $($then)+! {
            point {
                /// Position of a point of a body [m], global axes.
                Position in position;
                /// Velocity of a point of a body [m/s], global axes.
                Velocity in velocity;
                /// Acceleration of a point of a body [m/s^2], global axes.
                Acceleration in acceleration;
                /// Acceleration of a point of a body less gravity [m/s^2], global axes, as an accelerometer measures it.
                ProperAcceleration in proper_acceleration;
            }
            relative {
                /// Position of a point of a body from the origin of another body, in that body's axes [m].
                RelativePosition in relative_position;
                /// Velocity of a point of a body relative to another body that moves and rotates, in that body's axes [m/s].
                RelativeVelocity in relative_velocity;
                /// Acceleration of a point of a body relative to another body that moves and rotates, in that body's axes [m/s^2].
                RelativeAcceleration in relative_acceleration;
                /// Distance of a point of a body from the origin of another body [m].
                Distance in distance;
            }
            turning {
                /// Angular velocity of a body relative to another body, in that body's axes [rad/s]; in the plane one number.
                RelativeAngularVelocity in relative_angular_velocity;
            }
            carrier {
                /// Camber of a wheel by ISO 8855 [rad]: angle of its axis against the plane perpendicular to the vehicle's up
                /// direction. It is positive if the top of the wheel leans outwards.
                Camber in camber;
                /// Toe of a wheel by ISO 8855 [rad]: rotation of its axis about the vehicle's up direction, positive if its front
                /// points inwards.
                Toe in toe;
                /// Caster of a wheel by ISO 8855 [rad]: inclination of its steering axis in the side view, positive if the top is
                /// tilted backwards.
                Caster in caster;
            }
            of Body(body: BodyId) {
                /// Angular velocity of a body [rad/s], global axes; in the plane one number. For a thin rod held by ball joints,
                /// the part across it.
                AngularVelocity in angular_velocity;
                /// Angular acceleration of a body [rad/s^2], global axes; in the plane one number. For a thin rod held by ball
                /// joints, the part across it.
                AngularAcceleration in angular_acceleration;
                /// Orientation of a body relative to the reference configuration. In the plane it is the angle with full turns
                /// [rad]. In space it is a unit quaternion, scalar part first, whose sign is chosen so that it is continuous.
                Orientation in orientation;
                /// Rotation of a body relative to the reference configuration as a vector along its axis [rad], continuous over
                /// full turns. In the plane it is the angle.
                RotationVector in rotation_vector;
                /// Rotation of a body relative to the reference configuration as a matrix, row by row. Its columns are the body's
                /// axes.
                RotationMatrix in rotation_matrix;
                /// Kinetic energy of a body [J].
                BodyKineticEnergy in body_kinetic_energy;
            }
            of Joint(joint: JointId) {
                /// Coordinates of a joint [rad or m], with full turns.
                JointValue in value;
                /// Rates of a joint's coordinates [rad/s or m/s].
                JointRate in rate;
                /// Accelerations of a joint's coordinates [rad/s^2 or m/s^2]. For a ball joint, the difference of angular
                /// accelerations in global axes.
                JointAcceleration in joint_acceleration;
                /// Force or torque of a guide on the coordinate of a joint [N m or N], from the first body on the second. Zero
                /// without a guide.
                JointEffort in joint_effort;
                /// Power that a guide supplies through a joint [W]; zero without a guide.
                JointPower in joint_power;
                /// Reaction of a joint: wrench of its first body on the second at the joint's place [N, N m]. Planar [Fx, Fy, Mz],
                /// spatial [Fx, Fy, Fz, Mx, My, Mz].
                Reaction in reaction;
            }
            of Coupling(coupling: CouplingId) {
                /// Effort of a coupling. Gear and differential: torque on the first wheel [N m]. Belt: difference of its strands
                /// [N]. Rack and screw: force along the slide [N]. Rope: tension, positive where it pulls [N]. Other couplings:
                /// generalised force on a term over the term's factor [N m, or N with slides or lengths].
                Effort in effort;
                /// Sum of a coupling, with full turns [rad, or m with slides or lengths].
                CouplingValue in coupling_value;
                /// Length of the lines of a coupling [m], such as that of a rope between its points. Other couplings have none.
                CouplingLength in coupling_length;
                /// Rate of the sum of a coupling [rad/s or m/s].
                CouplingRate in coupling_rate;
                /// Power of a coupling [W]. Driven coupling: supplied power. Gear, differential, belt, rack and screw: power
                /// transmitted to the first wheel or the slide. Other couplings: zero.
                CouplingPower in coupling_power;
            }
            of Rolling(rolling: RollingId) {
                /// Force on a rolling body at its lowest point, or on a blade at its point [N], global axes.
                RollingForce in rolling_force;
            }
            of Effect(effect: EffectId) {
                /// Force of an effect [N or N m]. Along a length it is the tension, positive where it pulls the ends together. On a
                /// joint it is positive against growth of the coordinate. For an effect on a body it is the wrench on the body, and
                /// for a bushing on the second body. Its point is the point of attack there: planar [Fx, Fy, Mz], spatial [Fx, Fy,
                /// Fz, Mx, My, Mz].
                EffectForce in effect_force;
                /// Length or coordinate of an effect along a line or on a joint [m or rad], with full turns.
                EffectValue in effect_value;
                /// Rate of the length or coordinate of an effect [m/s or rad/s].
                EffectRate in effect_rate;
                /// Deflection of an effect [m or rad]: difference from its free length or value. For a bumper, a limit or a tire,
                /// the depth of contact.
                EffectDeflection in effect_deflection;
                /// Energy stored in an effect [J]. Constant force: minus its product with the position of its point. Rotor: its
                /// kinetic energy.
                EffectEnergy in effect_energy;
                /// Power that an effect supplies to bodies [W]; negative if it takes power from them.
                EffectPower in effect_power;
                /// Contact of a bumper, a limit or a tire [-]: one if one of its gaps is below zero, else zero.
                EffectContact in effect_contact;
                /// Load of a tire [N]: force of the road along its normal.
                TireLoad in tire_load;
                /// Lateral force of the road on a tire [N], along the tire's axis.
                TireSideForce in tire_side_force;
                /// Longitudinal force of the road on a tire [N], from rolling resistance and slip, in the direction of axis times
                /// normal.
                TireLongitudinalForce in tire_longitudinal_force;
                /// Slip angle of a tire with a side force [rad]: angle between its velocity and its plane. It is zero above the
                /// road, and regularised at standstill as the side force is.
                TireSlipAngle in tire_slip_angle;
                /// Moment of the road on a tire about the road's normal [N m].
                TireAligningTorque in tire_aligning_torque;
                /// Point of a tire nearest to the road, in the tire's plane, global axes [m]. Above the road it is the road's point
                /// below the tire.
                TireContactPoint in tire_contact_point;
            }
            of Signal(signal: SignalId) {
                /// Value of a signal, in the signal's unit.
                SignalValue in signal_value;
                /// Rate of a signal, if it is known. It is zero for a measured rate and for the output of a controller.
                SignalRate in signal_rate;
            }
            scene {
                /// Kinetic energy of all bodies and rotors [J].
                KineticEnergy in kinetic_energy;
                /// Potential energy of gravity, zero at the origin, and of all effects [J].
                PotentialEnergy in potential_energy;
                /// Sum of kinetic and potential energy [J].
                Energy in energy;
                /// Centre of mass of all bodies [m].
                CenterOfMass in center_of_mass;
                /// Momentum of all bodies [kg m/s]; rotors have none.
                Momentum in momentum;
                /// Angular momentum of all bodies about their centre of mass [kg m^2/s], global axes; in the plane one number.
                /// Rotors do not contribute.
                AngularMomentum in angular_momentum;
                /// Error of the energy invariant that a run watches [J]. It is the kinetic and potential energy, less their sum at
                /// the start. The work of dampers, motors, guides and inputs since the start is also subtracted. Zero without a
                /// run.
                InvariantError in invariant_error;
            }
        }
    };
}

pub(crate) use list;

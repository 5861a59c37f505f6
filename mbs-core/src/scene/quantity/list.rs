//! The list of quantities: all that the rest of the workspace knows of them.
//!
//! A line has what the quantity is, its kind and its module, under what it is of; the first line of a body's, a joint's, a coupling's or an
//! effect's is the quantity where a scene file names none. The module, in `outputs/quantity`, is the constructor's name.

/// Hands the list of quantities to a macro, which is given by its path.
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
                /// Acceleration of a point of a body less gravity [m/s^2], global axes: what an accelerometer measures.
                ProperAcceleration in proper_acceleration;
            }
            relative {
                /// Position of a point of a body from the origin of another body, in that body's axes [m].
                RelativePosition in relative_position;
                /// Velocity of a point of a body against another body that moves and turns, in that body's axes [m/s].
                RelativeVelocity in relative_velocity;
                /// Acceleration of a point of a body against another body that moves and turns, in that body's axes [m/s^2].
                RelativeAcceleration in relative_acceleration;
                /// Distance of a point of a body from the origin of another body [m].
                Distance in distance;
            }
            turning {
                /// Angular velocity of a body against another body, in that body's axes [rad/s]; in the plane one number.
                RelativeAngularVelocity in relative_angular_velocity;
            }
            carrier {
                /// Camber of a wheel, by ISO 8855 [rad]: how far its axis is from the plane across the vehicle's up, positive where the top of the
                /// wheel leans outwards.
                Camber in camber;
                /// Toe of a wheel, by ISO 8855 [rad]: the turn of its axis about the vehicle's up, positive where the front of the wheel points inwards.
                Toe in toe;
                /// Caster of a wheel, by ISO 8855 [rad]: the lean of its steering axis as seen from the side, positive where its top leans backwards.
                Caster in caster;
            }
            of Body(body: BodyId) {
                /// Angular velocity of a body [rad/s], global axes; in the plane one number. Of a thin rod that balls alone hold, the part across it.
                AngularVelocity in angular_velocity;
                /// Angular acceleration of a body [rad/s^2], global axes; in the plane one number. Of a thin rod that balls alone hold, the part across it.
                AngularAcceleration in angular_acceleration;
                /// Orientation of a body against the reference configuration: in the plane its angle, turns counted [rad]; in space a unit quaternion,
                /// its scalar part first, whose sign follows from step to step.
                Orientation in orientation;
                /// Rotation of a body against the reference configuration as a vector along its axis [rad], which grows continuously; in the plane the
                /// angle.
                RotationVector in rotation_vector;
                /// Rotation of a body against the reference configuration as a matrix, row by row: its columns are the body's axes.
                RotationMatrix in rotation_matrix;
                /// Kinetic energy of a body [J].
                BodyKineticEnergy in body_kinetic_energy;
            }
            of Joint(joint: JointId) {
                /// Coordinates of a joint [rad or m], turns counted.
                JointValue in value;
                /// Rates of a joint [rad/s or m/s].
                JointRate in rate;
                /// Accelerations of a joint's coordinates [rad/s^2 or m/s^2]; of a rotation, the difference of angular accelerations in global axes.
                JointAcceleration in joint_acceleration;
                /// What a guide puts on the coordinate of a joint [N m or N], of the first body on the second; zero without a guide.
                JointEffort in joint_effort;
                /// Power that a guide gives through a joint [W]; zero without a guide.
                JointPower in joint_power;
                /// What a joint's first body does to the second at the joint's place [N, N m]: planar [Fx, Fy, Mz], spatial [Fx, Fy, Fz, Mx, My, Mz].
                Reaction in reaction;
            }
            of Coupling(coupling: CouplingId) {
                /// Effort of a coupling: of a gear and a differential the torque on the first wheel [N m], of a belt the difference of its strands
                /// [N], of a rack and a screw the force along the slide [N], of a rope its tension, positive where it pulls [N]; else the generalised
                /// force on each of its terms over the term's factor [N m, or N where it has slides or lengths].
                Effort in effort;
                /// The sum of a coupling, turns counted [rad, or m where it has slides or lengths].
                CouplingValue in coupling_value;
                /// The length of the lines of a coupling [m], such as that of a rope between its points; of no other coupling.
                CouplingLength in coupling_length;
                /// The rate of the sum of a coupling [rad/s or m/s].
                CouplingRate in coupling_rate;
                /// Power that a driven coupling gives [W]; of a gear, a differential, a belt, a rack and a screw what it passes on to its first wheel
                /// or its slide; zero of others.
                CouplingPower in coupling_power;
            }
            of Rolling(rolling: RollingId) {
                /// Force on a body that rolls, at its lowest point, of a blade at its point [N], global axes.
                RollingForce in rolling_force;
            }
            of Effect(effect: EffectId) {
                /// Force of an effect [N or N m]: along a length it is the tension, positive where it pulls the ends together; on a joint it is
                /// positive against growth of the coordinate. Of an effect on a body and of a bushing, what it does to the body, or the second
                /// of two, at its point there: planar [Fx, Fy, Mz], spatial [Fx, Fy, Fz, Mx, My, Mz].
                EffectForce in effect_force;
                /// The length or coordinate of an effect along a line or on a joint [m or rad], turns counted.
                EffectValue in effect_value;
                /// The rate of the length or coordinate of an effect [m/s or rad/s].
                EffectRate in effect_rate;
                /// How far an effect with a free length or value is from it, and how deep a bumper, a limit or a tire is in contact [m or rad].
                EffectDeflection in effect_deflection;
                /// Energy stored in an effect [J]; of a constant force, minus its product with the position of its point; of a rotor its kinetic energy.
                EffectEnergy in effect_energy;
                /// Power that an effect gives to bodies [W]; negative where it takes.
                EffectPower in effect_power;
                /// Whether a bumper, a limit or a tire is in contact [-]: one where a gap of it is below zero, else zero.
                EffectContact in effect_contact;
                /// Load of a tire [N]: the force of the road along its normal.
                TireLoad in tire_load;
                /// Force of the road on a tire across its plane [N], along its axis.
                TireSideForce in tire_side_force;
                /// Force of the road on a tire along its plane [N], by rolling resistance and slip: along its axis times the normal.
                TireLongitudinalForce in tire_longitudinal_force;
                /// Angle between the motion of a tire with a side force and its plane [rad]; zero above the road. At standstill it is regularised as
                /// the side force is.
                TireSlipAngle in tire_slip_angle;
                /// Moment of the road on a tire about the road's normal [N m].
                TireAligningTorque in tire_aligning_torque;
                /// Point of a tire that is nearest to the road, in its plane [m], global axes; above the road, the point below it on the road.
                TireContactPoint in tire_contact_point;
            }
            of Signal(signal: SignalId) {
                /// The value of a signal, in its unit.
                SignalValue in signal_value;
                /// The rate of a signal, where it is known; zero of a measured rate and of what a controller asks for.
                SignalRate in signal_rate;
            }
            scene {
                /// Kinetic energy of all bodies and rotors [J].
                KineticEnergy in kinetic_energy;
                /// Potential energy of gravity, zero at the origin, and of all effects [J].
                PotentialEnergy in potential_energy;
                /// Kinetic and potential energy [J].
                Energy in energy;
                /// Centre of mass of all bodies [m].
                CenterOfMass in center_of_mass;
                /// Momentum of all bodies [kg m/s]; a rotor has none.
                Momentum in momentum;
                /// Angular momentum of all bodies about their centre of mass [kg m^2/s], global axes; in the plane one number. Rotors are left out.
                AngularMomentum in angular_momentum;
                /// Kinetic and potential energy less what dampers, motors, guides and inputs gave since the start, minus the energy at the start [J]:
                /// the error of the energy invariant that the run watches. Zero without a run.
                InvariantError in invariant_error;
            }
        }
    };
}

pub(crate) use list;

//! List of the kinds of effect. Each kind has a file with its data and keys, checks, actions, and its law with tangent, numbers and
//! operation bound.
//!
//! The rest of the workspace knows the kinds only by the list below. A line has a kind, its module, the gate of its Cargo
//! feature (`all()`: every build has it), and the laws of the file. `tension` is a law along a length or about an angle, and `body`
//! is a law on one body. Each law has its number in the tables of controllers. A law whose feature is off is not compiled. An
//! effect whose feature is off is refused when a model is built.

/// Passes the list of effects to a macro of `table`.
macro_rules! list {
    ($then:ident) => {
        crate::effects::table::$then! {
            SpringDamper in spring_damper (all()) tension SpringDamper(SpringDamperLaw<T>) = 0;
            JointTorque in joint_torque (all()) tension Torque(TorqueLaw) = 1;
            BodyTorque in body_torque (all());
            Force in force (all());
            TorsionSpring in torsion_spring (all());
            Bumper in bumper (feature = "bumper") tension Bumper(BumperLaw<T>) = 3;
            Polynomial in polynomial (feature = "polynomial") tension Polynomial(PolynomialLaw) = 2;
            Actuator in actuator (all());
            Limit in limit (feature = "limit") tension Limit(LimitLaw<T>) = 4;
            Friction in friction (feature = "friction") tension Friction(FrictionLaw<T>) = 5;
            Rotor in rotor (all());
            Bushing in bushing (feature = "bushing");
            AeroDrag in drag (feature = "drag") body Drag(DragLaw<T>) = 0;
            SpeedHold in speed_hold (feature = "speed-hold") body SpeedHold(SpeedHoldLaw<T>) = 1;
            Tire in tire (feature = "tire") body Tire(TireLaw<T>) = 2;
            LineSpring in line_spring (all()) tension Pull(PullLaw<T>) = 8;
            LineActuator in line_actuator (all());
            LinePolynomial in line_polynomial (feature = "polynomial");
            SumSpring in sum_spring (all());
            SumTorque in sum_torque (all());
            SumLimit in sum_limit (feature = "limit");
            SumFriction in sum_friction (feature = "friction");
            SumPolynomial in sum_polynomial (feature = "polynomial");
            Own in user (feature = "own-laws") tension Own(UserScalarEntry<T>) = 6 body Own(UserBodyEntry<T>) = 3;
            LawOnLine in law_on_line (feature = "own-laws") tension Code(CodeLaw<T>) = 7;
            LawOnJoint in law_on_joint (feature = "own-laws");
            LawOnBody in law_on_body (feature = "own-laws") body Code(CodeBodyLaw<T>) = 4;
        }
    };
}

pub(super) use list;

//! Forward dynamics of revolute chains by Rust crates: chains (dynibo | phyz) N SECONDS

use phyz_math::{Mat3, SpatialInertia, SpatialTransform, Vec3};
use phyz_model::ModelBuilder;
use rust_peers::{asked, print_line, states, time_of};
use std::error::Error;
use std::fmt::Write;
use std::hint::black_box;

/// The chain as URDF text, the format that dynibo reads.
fn urdf(n: usize) -> Result<String, std::fmt::Error> {
    let mut text = String::from("<robot name=\"chain\"><link name=\"base\"/>");
    for i in 0..n {
        let (parent, x) = if i == 0 { ("base".to_owned(), 0) } else { (format!("l{}", i - 1), 1) };
        let inertia = 1.0 / 12.0;
        write!(
            text,
            "<link name=\"l{i}\"><inertial><origin xyz=\"0.5 0 0\"/><mass value=\"1\"/><inertia ixx=\"0.001\" ixy=\"0\" \
             ixz=\"0\" iyy=\"{inertia}\" iyz=\"0\" izz=\"{inertia}\"/></inertial></link><joint name=\"j{i}\" \
             type=\"revolute\"><parent link=\"{parent}\"/><child link=\"l{i}\"/><origin xyz=\"{x} 0 0\"/><axis xyz=\"0 0 \
             1\"/><limit lower=\"-1000\" upper=\"1000\" effort=\"1000\" velocity=\"1000\"/></joint>"
        )?;
    }
    Ok(text + "</robot>")
}

/// Times dynibo on a chain. Its gravity always points along -z, so that a chain about z moves without gravity.
fn dynibo(n: usize, seconds: f64) -> Result<(), Box<dyn Error>> {
    let path = std::env::temp_dir().join(format!("peers-chain-{n}-{}.urdf", std::process::id()));
    std::fs::write(&path, urdf(n)?)?;
    let robot = dynibo::Robot::from_urdf(&path);
    std::fs::remove_file(&path)?;
    let (mut robot, states) = (robot?, states(n));
    let (none, mut out) = (vec![0.0; n], vec![0.0; n]);
    let [q, v] = &states[0];
    robot.forward_dynamics(q, v, &none, &[], &mut out)?;
    let value = out[0];
    let time = time_of(seconds, |k| {
        let [q, v] = &states[k];
        let done = robot.forward_dynamics(q, v, &none, &[], &mut out);
        black_box((&done.is_ok(), &out));
    });
    print_line("dynibo", time, value, "weightless");
    Ok(())
}

fn phyz(n: usize, seconds: f64) {
    let mut builder = ModelBuilder::new().gravity(Vec3::new(0.0, -9.81, 0.0)).dt(1e-3);
    for i in 0..n {
        let x = if i > 0 { 1.0 } else { 0.0 };
        let inertia = Mat3::from_diagonal(&Vec3::new(1e-3, 1.0 / 12.0, 1.0 / 12.0));
        builder = builder.add_revolute_body(
            &format!("l{i}"),
            i as i32 - 1,
            SpatialTransform::from_translation(Vec3::new(x, 0.0, 0.0)),
            SpatialInertia::new(1.0, Vec3::new(0.5, 0.0, 0.0), inertia),
        );
    }
    let model = builder.build();
    let state = |[q, v]: &[Vec<f64>; 2]| {
        let mut state = model.default_state();
        for i in 0..n {
            (state.q[i], state.v[i]) = (q[i], v[i]);
        }
        state
    };
    let states: Vec<_> = states(n).iter().map(state).collect();
    let value = phyz_rigid::aba(&model, &states[0])[0];
    let time = time_of(seconds, |k| {
        black_box(phyz_rigid::aba(&model, &states[k]));
    });
    print_line("phyz-rigid", time, value, "exact");
}

fn main() -> Result<(), Box<dyn Error>> {
    let (problem, n, seconds) = asked("chains chain N SECONDS")?;
    if problem == "chain" {
        dynibo(n, seconds)?;
        phyz(n, seconds);
    }
    Ok(())
}

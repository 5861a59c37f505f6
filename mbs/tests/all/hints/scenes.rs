//! Scenes that run, as bases for changes that cause hints.

pub(super) const PLANAR: &str = r#"
[scene]
dimension = 2
duration = 0.02
gravity = [0.0, -9.81]
[[body]]
name = "crank"
mass = 1.0
rod = { from = [0.0, 0.0], to = [1.0, 0.0] }
[[body]]
name = "arm"
mass = 2.0
center = [1.5, 0.0]
inertia = 0.1
[[joint]]
name = "pin"
kind = "revolute"
bodies = ["ground", "crank"]
at = [0.0, 0.0]
[[joint]]
name = "elbow"
kind = "revolute"
bodies = ["crank", "arm"]
at = [1.0, 0.0]
[[initial]]
joint = "elbow"
rate = 0.5
[[effect]]
name = "spring"
kind = "spring-damper"
bodies = ["arm", "ground"]
points = [[1.5, 0.0], [1.5, 1.0]]
stiffness = 100.0
free_length = 0.8
[[effect]]
name = "load"
kind = "torque"
joint = "pin"
table = [[0.0, 0.0], [1.0, 2.0]]
[[output]]
name = "tip"
body = "arm"
at = [2.0, 0.0]
quantity = "position"
[solver]
step = 1e-3
"#;

pub(super) const SPATIAL: &str = r#"
[scene]
dimension = 3
duration = 0.02
gravity = [0.0, 0.0, -9.81]
[[body]]
name = "arm"
mass = 2.0
center = [0.5, 0.0, 0.0]
inertia = [0.01, 0.1, 0.1, 0.0, 0.0, 0.0]
[[joint]]
name = "pin"
kind = "revolute"
bodies = ["ground", "arm"]
at = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
[[body]]
name = "tip"
mass = 0.5
center = [1.0, 0.0, 0.0]
inertia = [0.001, 0.001, 0.001, 0.0, 0.0, 0.0]
[[joint]]
name = "end"
kind = "weld"
bodies = ["arm", "tip"]
at = [1.0, 0.0, 0.0]
[[output]]
name = "pin"
joint = "pin"
quantity = "value"
"#;

/// Scene of a slide that follows a table whose slope is not zero at the end of the run.
pub(super) const GUIDED: &str = r#"
[scene]
dimension = 2
duration = 0.3
[[body]]
name = "a"
mass = 1.0
center = [0.0, 0.0]
inertia = 0.05
[[joint]]
name = "slide"
kind = "prismatic"
bodies = ["ground", "a"]
at = [0.0, 0.0]
axis = [1.0, 0.0]
[[guide]]
joint = "slide"
table = [[0.0, 0.0], [0.25, 0.1], [0.5, 0.3]]
"#;

/// Scene of a double-rocker linkage whose crank is driven.
pub(super) const LOCKING: &str = r#"
[scene]
dimension = 2
duration = 0.15
[[body]]
name = "crank"
rod = { from = [0.0, 0.0], to = [0.0, 1.0] }
mass = 1.0
[[body]]
name = "coupler"
rod = { from = [0.0, 1.0], to = [1.0, 1.0] }
mass = 1.0
[[body]]
name = "rocker"
rod = { from = [2.0, 0.0], to = [1.0, 1.0] }
mass = 1.0
[[joint]]
name = "a"
kind = "revolute"
bodies = ["ground", "crank"]
at = [0.0, 0.0]
[[joint]]
name = "b"
kind = "revolute"
bodies = ["crank", "coupler"]
at = [0.0, 1.0]
[[joint]]
name = "c"
kind = "revolute"
bodies = ["coupler", "rocker"]
at = [1.0, 1.0]
[[joint]]
name = "d"
kind = "revolute"
bodies = ["ground", "rocker"]
at = [2.0, 0.0]
[[guide]]
joint = "a"
ramp = { rate = 1.0 }
"#;

#!/bin/bash
# MuJoCo 4.0.0: `boundmass` puts the mass that it gives to a body without mass at the body's `pos`, taken once more in the body's own frame, and the
# axes of inertia are turned by its `quat` once more. One would guess the origin of the body's frame. An `inertial` of too small a mass stays in place.
# So an empty body 1 m from its parent has its mass 2 m from it, and an empty hinged body is a pendulum in gravity.
# Seen: bodies at 1 2 3 have 0.01 kg at 1 2 3 of their own frames: empty, turned, and with a massless geom at 0.3 0 0. With an `inertial` of 0.001 kg
# at 0.1 0 0: there. An empty body at 1 0 0 that turns about y at its origin: a moment of gravity of 0.0981 N m, where one would guess 0.
set -e
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco==4.0.0
cd "$folder"
"$folder/venv/bin/python" -W error - <<'PYTHON'
import os

import mujoco

FORM = """<mujoco><compiler boundmass="0.01" boundinertia="1e-5"/><worldbody>
<body name="empty" pos="1 2 3"/>
<body name="turned" pos="1 2 3" quat="0.6 0.8 0 0"/>
<body name="geom" pos="1 2 3"><geom size="0.1" mass="0" pos="0.3 0 0"/></body>
<body name="inertial" pos="1 2 3"><inertial pos="0.1 0 0" mass="0.001" diaginertia="1e-6 1e-6 1e-6"/></body>
<body name="hinged" pos="1 0 0"><joint axis="0 1 0"/></body>
</worldbody></mujoco>"""
# Mass, its place in the body's own frame, its global place, and how its axes are turned in the body's own frame.
EXPECTED = {
    "empty": [0.01, 1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 1.0, 0.0, 0.0, 0.0],
    "turned": [0.01, 1.0, 2.0, 3.0, 2.0, -1.44, 4.08, 0.6, 0.8, 0.0, 0.0],
    "geom": [0.01, 1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 1.0, 0.0, 0.0, 0.0],
    "inertial": [0.01, 0.1, 0.0, 0.0, 1.1, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0],
    "hinged": [0.01, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
}
model = mujoco.MjModel.from_xml_string(FORM)
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
print("mujoco", mujoco.__version__)
seen = {}
for name in EXPECTED:
    body = model.body(name).id
    values = (model.body_mass[body], *model.body_ipos[body], *data.xipos[body], *model.body_iquat[body])
    seen[name] = [round(float(value), 12) for value in values]
    print(f"{name}: mass {seen[name][0]}, in its own frame {seen[name][1:4]}, global {seen[name][4:7]}, quat {seen[name][7:]}")
moment = -round(float(data.qfrc_bias[0]), 12)
has_warned = os.path.exists("MUJOCO_LOG.TXT")
print("moment of gravity about the hinge", moment, "warned:", has_warned)
assert seen == EXPECTED and moment == 0.0981 and not has_warned
PYTHON

#!/bin/bash
# MuJoCo 4.0.0: of `stiffness="k0 k1 k2"` of a joint the second term is even: the force is -(k0 x + k1 x^2 + k2 x^3). One would guess k1 x |x|,
# as `damping="b0 b1 b2"` has b1 v |v|. So a spring with k1 alone pushes the same way on both sides, and has no energy minimum at zero.
# Seen: forces of k = (0, 10, 0) at 0.1 and -0.1 are -0.1 and -0.1; of the damping (0, 10, 0) at rates 0.1 and -0.1 they are -0.1 and 0.1.
set -e
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco==4.0.0
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import mujoco

FORM = """<mujoco><option gravity="0 0 0"/><worldbody><body><joint name="x" type="slide" {}/><geom size="0.1"/></body></worldbody></mujoco>"""


def forces(law, at):
    model = mujoco.MjModel.from_xml_string(FORM.format(law))
    data = mujoco.MjData(model)
    found = []
    for x in (0.1, -0.1):
        setattr(data, at, [x])
        mujoco.mj_forward(model, data)
        found.append(round(float(data.qfrc_passive[0]), 12))
    return found


spring, damper = forces('stiffness="0 10 0"', "qpos"), forces('damping="0 10 0"', "qvel")
print("mujoco", mujoco.__version__, "spring", spring, "damper", damper)
assert spring == [-0.1, -0.1] and damper == [-0.1, 0.1]
PYTHON

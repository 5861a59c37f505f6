#!/bin/bash
# A `limit` of a revolute joint in a URDF with neither `lower` nor `upper`: the format says that each is 0 by default, so that the joint is held.
# Pinocchio 4.1.0 keeps 0 to 0. MuJoCo 4.0.0 gives the joint no range, without a word. With lower="0" upper="0" both do the same, MuJoCo with a warning.
# One would guess that two programs that read the format keep the same range. Exporters write such files for joints that turn freely.
# Seen: pin [0, 0] and [0, 0]; mujoco not limited, and not limited.
set -e
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco==4.0.0 pin==4.1.0
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import mujoco
import pinocchio

FORM = """<robot name="flap"><link name="base"/><link name="leaf"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="pivot" type="revolute"><parent link="base"/><child link="leaf"/><axis xyz="0 1 0"/><limit effort="1" velocity="1" {}/></joint></robot>"""
for ends in ("", 'lower="0" upper="0"'):
    text = FORM.format(ends)
    range_of = pinocchio.buildModelFromXML(text)
    kept = [float(range_of.lowerPositionLimit[0]), float(range_of.upperPositionLimit[0])]
    is_limited = bool(mujoco.MjModel.from_xml_string(text).jnt_limited[0])
    print(f"limit {ends!r}: pin {pinocchio.__version__} {kept}, mujoco {mujoco.__version__} limited {is_limited}")
    assert kept == [0.0, 0.0] and not is_limited
PYTHON

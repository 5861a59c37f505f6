#!/bin/bash
# MuJoCo 4.0.0: a default class with `<position kp="10"/>` and then `<motor/>` gives a `position` kp 1. With the `<motor/>` in a child class instead,
# a `position` of the child has kp 10. `velocity` does the same as `motor`. A `<general gainprm="4"/>` after that `motor` makes kp 4.
# One would guess that a child class continues its parent, so that both give the same kp, or that a default of `motor` does not concern a `position`.
# So a `motor` that moves between a class and its child changes the force of a `position` by a factor of ten here, without a word.
# Seen: gain and bias of a `position` for the nine pairs of classes below. A `motor` has gain 1 and no bias for all of them.
set -e
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco==4.0.0
cd "$folder"
"$folder/venv/bin/python" -W error - <<'PYTHON'
import os

import mujoco

FORM = """<mujoco><default>{}<default class="child">{}</default></default>
<worldbody><body><joint name="a"/><geom size="0.1"/></body></worldbody>
<actuator><{} class="child" joint="a"/></actuator></mujoco>"""
# Parent class, child class, kp of a position of the child class.
CASES = [
    ('<position kp="10"/>', "", 10.0),
    ('<position kp="10"/>', "<motor/>", 10.0),
    ('<position kp="10"/>', "<velocity/>", 10.0),
    ('<position kp="10"/>', '<velocity kv="3"/>', 10.0),
    ('<position kp="10"/><motor/>', "", 1.0),
    ('<position kp="10"/><velocity kv="3"/>', "", 1.0),
    ("", '<position kp="10"/><motor/>', 1.0),
    ('<motor/><position kp="10"/>', "", 10.0),
    ('<position kp="10"/>', '<motor/><general gainprm="4"/>', 4.0),
]


def gain_and_bias(parent, child, kind):
    model = mujoco.MjModel.from_xml_string(FORM.format(parent, child, kind))
    return [float(model.actuator_gainprm[0, 0])] + [float(value) for value in model.actuator_biasprm[0, :3]]


print("mujoco", mujoco.__version__)
is_same = True
for parent, child, kp in CASES:
    position, motor = gain_and_bias(parent, child, "position"), gain_and_bias(parent, child, "motor")
    print(f"parent {parent!r}, child {child!r}: gain and bias of position {position}, of motor {motor}")
    is_same = is_same and position == [kp, 0.0, -kp, 0.0] and motor == [1.0, 0.0, 0.0, 0.0]
has_warned = os.path.exists("MUJOCO_LOG.TXT")
print("warned:", has_warned)
assert is_same and not has_warned
PYTHON

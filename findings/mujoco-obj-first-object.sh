#!/bin/bash
# MuJoCo 4.0.0: of an OBJ file with two objects (`o`, or `g`) the faces of the first alone make the mass and centre of a mesh, without a word.
# With `inertia="convex"` the vertices of both objects are taken. One would guess that the file is one mesh, as without `o` and `g`, or a warning.
# So a part that a modeller exported as two objects is too light, and a program that reads all faces gets another mass of the same file.
# Seen: two tetrahedra of 1/6 m^3, the second 5 m along x, at 1 kg/m^3. Legacy and exact: 0.166667 kg at 0.25 0.25 0.25. Convex: 2.666667 kg.
# The same faces without `o` and `g`: exact 0.333333 kg at 2.75 0.25 0.25, convex as above. Legacy is for connected meshes, and gives 1.869219 kg there.
set -e
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco==4.0.0
cd "$folder"
"$folder/venv/bin/python" -W error - <<'PYTHON'
import os

import mujoco

FORM = """<mujoco><asset><mesh name="m" file="two.obj" inertia="{}"/></asset><worldbody><body><joint/>
<geom type="mesh" mesh="m" density="1"/></body></worldbody></mujoco>"""


def tetrahedron(x, first):
    """A corner of a cube with its vertices from number `first` on."""
    vertices = [(x, 0, 0), (x + 1, 0, 0), (x, 1, 0), (x, 0, 1)]
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
    lines = ["v {} {} {}".format(*v) for v in vertices] + ["f {} {} {}".format(*(first + i for i in f)) for f in faces]
    return "\n".join(lines) + "\n"


def mass_and_centre(word, inertia):
    names = [f"{word} first\n", f"{word} second\n"] if word else ["", ""]
    file = names[0] + tetrahedron(0, 1) + names[1] + tetrahedron(5, 5)
    model = mujoco.MjModel.from_xml_string(FORM.format(inertia), assets={"two.obj": file.encode()})
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return [round(float(value), 6) for value in (model.body_mass[1], *data.xipos[1])]


EXPECTED = {
    ("", "legacy"): [1.869219, 2.685119, 0.303829, 0.303829],
    ("", "exact"): [0.333333, 2.75, 0.25, 0.25],
    ("", "convex"): [2.666667, 2.671875, 0.328125, 0.328125],
    ("o", "legacy"): [0.166667, 0.25, 0.25, 0.25],
    ("o", "exact"): [0.166667, 0.25, 0.25, 0.25],
    ("o", "convex"): [2.666667, 2.671875, 0.328125, 0.328125],
    ("g", "legacy"): [0.166667, 0.25, 0.25, 0.25],
    ("g", "exact"): [0.166667, 0.25, 0.25, 0.25],
    ("g", "convex"): [2.666667, 2.671875, 0.328125, 0.328125],
}
print("mujoco", mujoco.__version__)
seen = {case: mass_and_centre(*case) for case in EXPECTED}
for (word, inertia), value in seen.items():
    print(f"{word or 'no word'}, {inertia}: mass and centre {value}")
has_warned = os.path.exists("MUJOCO_LOG.TXT")
print("warned:", has_warned)
assert seen == EXPECTED and not has_warned
PYTHON

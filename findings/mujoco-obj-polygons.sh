#!/bin/bash
# MuJoCo 4.0.0: the mass of a mesh from an OBJ file with polygons depends on where the mesh lies in its own file, without a word. A polygon of more
# than 100 corners is left out whole. One would guess that a solid weighs the same wherever it lies, and that 101 corners are read as 100 are.
# A modeller exports flat faces as polygons, not triangles: the base of a published quadruped is a twentieth lighter than with all its triangles.
# Seen: an L of 3 m^3 as a prism over a hexagon, at 1 kg/m^3: 3 kg, and with all vertices moved by -3 m along x 2.825262 kg.
# A prism of 1 m over a regular polygon in a circle of 1 m: of 100 corners 3.139526 kg (right), of 101 corners 2.093044 kg (right: 3.139567).
set -e
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco==4.0.0
cd "$folder"
"$folder/venv/bin/python" -W error - <<'PYTHON'
import math
import os

import mujoco

FORM = """<mujoco><asset><mesh name="m" file="m.obj" inertia="exact"/></asset><worldbody><body><joint/>
<geom type="mesh" mesh="m" density="1"/></body></worldbody></mujoco>"""

L = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]


def circle(n):
    return [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n)) for i in range(n)]


def mass(ring, x=0):
    """A prism of 1 m over a polygon, moved along x, all faces turned outwards."""
    n = len(ring)
    vertices = [(x + a, b, z) for z in (0, 1) for a, b in ring]
    faces = [list(range(n, 0, -1)), list(range(n + 1, 2 * n + 1))]
    faces += [[1 + i, 1 + (i + 1) % n, n + 1 + (i + 1) % n, n + 1 + i] for i in range(n)]
    lines = ["v {} {} {}".format(*v) for v in vertices] + ["f " + " ".join(map(str, face)) for face in faces]
    model = mujoco.MjModel.from_xml_string(FORM, assets={"m.obj": "\n".join(lines).encode() + b"\n"})
    return round(float(model.body_mass[1]), 6)


EXPECTED = {"L": 3.0, "L moved": 2.825262, "100 corners": 3.139526, "101 corners": 2.093044}
seen = {"L": mass(L), "L moved": mass(L, -3), "100 corners": mass(circle(100)), "101 corners": mass(circle(101))}
has_warned = os.path.exists("MUJOCO_LOG.TXT")
print("mujoco", mujoco.__version__, seen, "warned:", has_warned)
assert seen == EXPECTED and not has_warned
PYTHON

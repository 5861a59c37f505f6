#!/bin/bash
# MuJoCo 4.0.0: the mass of an ellipsoid with `shellinertia="true"` is not its density times its area: the area is Thomsen's formula with
# p = 1.6075, off by up to 1.06 %. For half axes of 0.1, 0.2 and 0.3 m and 1 kg/m^2 one would guess 0.4888 kg, by quadrature.
# Seen: the mass by the formula, and a relative difference above 1e-4.
set -e
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco==4.0.0 scipy==1.17.1
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import mujoco
import numpy as np
from scipy.integrate import dblquad

a, b, c = 0.1, 0.2, 0.3
model = mujoco.MjModel.from_xml_string(
    f'<mujoco><worldbody><body><joint/><geom type="ellipsoid" size="{a} {b} {c}" density="1" shellinertia="true"/></body></worldbody></mujoco>'
)


def element(theta, phi):
    s, k = np.sin(theta), np.cos(theta)
    return s * np.sqrt((b * c * s * np.cos(phi)) ** 2 + (a * c * s * np.sin(phi)) ** 2 + (a * b * k) ** 2)


exact = dblquad(element, 0, 2 * np.pi, 0, np.pi, epsabs=1e-13)[0]
p = 1.6075
formula = 4 * np.pi * (((a * b) ** p + (a * c) ** p + (b * c) ** p) / 3) ** (1 / p)
mass = float(model.body_mass[1])
print("mujoco", mujoco.__version__, "mass", mass, "area", exact, "by the formula", formula)
assert abs(mass / formula - 1) < 1e-9 and abs(mass / exact - 1) > 1e-4
PYTHON

"""The model that MuJoCo compiled, as an MJCF again: a second opinion on what an importer reads of the first file."""

import re

import mujoco

# Digits of the numbers that are written: MuJoCo's own are six.
DIGITS = 16


def text(path):
    """Every body has its inertia written, so meshes are for the eye alone: they are left out with their forms."""
    spec = mujoco.MjSpec.from_file(str(path))
    spec.compiler.saveinertial = True
    spec.compile()
    written = spec.to_xml()
    written = re.sub(r'<geom [^>]*\bmesh="[^"]*"[^>]*/>', "", written)
    written = re.sub(r"<(mesh|hfield|texture|skin) [^>]*/>", "", written)
    return re.sub(r'\s(material|hfield)="[^"]*"', "", written)

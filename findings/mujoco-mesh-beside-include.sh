#!/bin/bash
# MuJoCo 4.0.0: a mesh that an included file of another folder names is found beside that file when the model is opened by an absolute path, or by its
# name alone in its folder. By a relative path with a folder the model is refused, and the message names a path that is there.
# One would guess that the way a path is written changes nothing. So a model opens from its own folder, and does not from the one above.
# Seen: robot/main.xml includes parts/part.xml, which names tip.obj in parts. Opened as /.../robot/main.xml and, in robot, as main.xml. Refused:
# robot/main.xml in the folder above, and ../main.xml in parts. A mesh that main.xml itself names as parts/tip.obj is found in all four ways.
set -e
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco==4.0.0
cd "$folder"
"$folder/venv/bin/python" -W error - <<'PYTHON'
import os

import mujoco

TOP = os.getcwd()
BODY = '<worldbody><body><geom type="mesh" mesh="tip"/></body></worldbody>'
FILES = {
    "robot/main.xml": f'<mujoco><include file="parts/part.xml"/>{BODY}</mujoco>',
    "robot/direct.xml": f'<mujoco><asset><mesh name="tip" file="parts/tip.obj"/></asset>{BODY}</mujoco>',
    "robot/parts/part.xml": '<mujocoinclude><asset><mesh name="tip" file="tip.obj"/></asset></mujocoinclude>',
    "robot/parts/tip.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n",
}
os.makedirs("robot/parts")
for name, text in FILES.items():
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)


def message(place, path):
    """What opening `path` in the folder `place` says; empty when it opens."""
    os.chdir(os.path.join(TOP, place))
    try:
        mujoco.MjModel.from_xml_path(path)
    except ValueError as error:
        return str(error).strip()
    return ""


print("mujoco", mujoco.__version__)
is_same = True
for name in ("main.xml", "direct.xml"):
    # The folder, the path, and the file that the message names.
    for place, path, refused in (
        ("", f"{TOP}/robot/{name}", None),
        ("robot", name, None),
        ("", f"robot/{name}", "robot/parts/tip.obj"),
        ("robot/parts", f"../{name}", "../parts/tip.obj"),
    ):
        said = message(place, path)
        print(f"in {place or '.'}, {path.replace(TOP, '/...')}: {said or 'opens'}")
        if name == "direct.xml" or refused is None:
            is_same = is_same and not said
        else:
            is_same = is_same and f"'{refused}'" in said and os.path.exists(refused)
assert is_same
PYTHON

"""What the programs of this folder share: where the models are, and which there are."""

import hashlib
import os
import re
from pathlib import Path
from xml.etree import ElementTree

HERE = Path(__file__).resolve().parent

# A thousand single bodies of pybullet without a joint: they judge nothing here.
LEFT_OUT = "random_urdfs"

ROOTS = {"robot": "urdf", "mujoco": "mjcf", "sdf": "sdf", "mujocoinclude": "fragment"}

ENDINGS = (".urdf", ".xml", ".sdf", ".mjcf", ".world")


def folder():
    """The folder that setup.sh fills."""
    target = os.environ.get("CARGO_TARGET_DIR", HERE / "../../target")
    return Path(os.environ.get("MODELS_DIR", Path(target) / "models")).resolve()


def data():
    return folder() / "data"


def collections():
    """Where fetch.py unpacks the packages of packages.txt."""
    return folder() / "collections"


def tree(path):
    """The root element; prefixes that nobody declared and blanks before the XML line are let through."""
    text = path.read_bytes().decode("utf-8-sig").lstrip()
    used = set(re.findall(r"<([A-Za-z_]\w*):", text)) | set(re.findall(r"\s([A-Za-z_]\w*):\w+\s*=", text))
    missing = [name for name in sorted(used - {"xml", "xmlns"}) if f"xmlns:{name}=" not in text]
    declared = "".join(f' xmlns:{name}="{name}"' for name in missing)
    text = re.sub(r"<(robot|sdf|mujoco)\b", lambda tag: tag.group(0) + declared, text, count=1)
    return ElementTree.fromstring(text.encode())


def root_of(path):
    """The name of the root element, None where the file is no XML."""
    try:
        return tree(path).tag
    except (ElementTree.ParseError, UnicodeDecodeError):
        return None


def format_of(path):
    """urdf, mjcf, sdf, fragment (of MJCF), or None for other XML."""
    kind = ROOTS.get(root_of(path))
    if kind is None and path.suffix == ".urdf":
        return "urdf"
    return kind


def models(folder=None):
    """All (package, path, format) of a folder of packages, by name; the path is inside the package."""
    found = []
    for package in sorted((folder or data()).iterdir()):
        for path in sorted(package.rglob("*")):
            if path.suffix in ENDINGS and LEFT_OUT not in path.parts:
                kind = format_of(path)
                if kind:
                    found.append((package.name, path.relative_to(package).as_posix(), kind))
    return found


def short_name(package, path):
    """A name for files of results: the package and the last folders of the path."""
    skip = {"cmeel.prefix", "share", "robots", "urdf", "example-robot-data", "assets", "envs", "data"}
    parts = [part for part in path.split("/") if part not in skip]
    return "-".join([package] + parts[-2:]).replace(" ", "_")


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16]

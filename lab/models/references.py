"""Writes what Pinocchio and MuJoCo say of a model at a random state: references.py [--out FOLDER] [--free] [WORD...]

WORDs choose models by parts of package/path; without any, all that move. `--committed` writes the few that the
repository keeps. One JSON file a model; README.md says what its numbers mean.
"""

import argparse
import json
import sys
import zlib
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin

import common
import motion
import rotation
from mjcf_model import Mjcf
from urdf_model import Urdf

COMMITTED = common.HERE / "references"

# Ends of the free motion [s].
TIMES = (0.1, 0.3, 1.0)

# Larger matrices are written for no committed model, and are of no use to find a fault.
MAX_ROWS = 60

# Derivatives are three full matrices: for small robots.
MAX_DERIVED = 12


def plain(thing):
    """Lists and floats from arrays, whatever is nested; the shortest text that gives the same number."""
    if isinstance(thing, dict):
        return {key: plain(value) for key, value in thing.items()}
    if isinstance(thing, (list, tuple)):
        return [plain(value) for value in thing]
    if isinstance(thing, np.ndarray):
        return thing.tolist()
    return thing.item() if isinstance(thing, np.generic) else thing


def by_joint(model, y, rates):
    """{joint: {value, rate}} of one state."""
    out, i, k = {}, 0, 0
    for name, kind in zip(model.names, model.kinds):
        size, rows = rotation.SIZE[kind], rotation.ROWS[kind]
        out[name] = {"value": y[i:i + size], "rate": rates[k:k + rows]}
        i, k = i + size, k + rows
    return out


def by_name(model, rows):
    out, k = {}, 0
    for name, kind in zip(model.names, model.kinds):
        out[name] = rows[k:k + rotation.ROWS[kind]]
        k += rotation.ROWS[kind]
    return out


def judge(model, seed, with_motion):
    """All numbers of one model; a mass matrix without inverse leaves the accelerations out."""
    y, rates, wanted = rotation.random_state(model.kinds, seed)
    mass = model.mass_matrix(y)
    out = {"seed": seed, "gravity": model.gravity, "joints": dict(zip(model.names, model.kinds))}
    out |= {"followers": model.followers, "off": getattr(model, "off", []), "state": by_joint(model, y, rates)}
    out |= model.report(y, rates)
    out["effort"] = {"acceleration": by_name(model, wanted), "effort": by_name(model, model.effort(y, rates, wanted))}
    if len(mass) <= MAX_ROWS:
        out["mass_matrix"] = [mass[i, :i + 1] for i in range(len(mass))]
    scale = np.sqrt(np.abs(np.diag(mass)))
    with np.errstate(all="ignore"):
        out["condition"] = float(np.linalg.cond(mass / np.outer(scale, scale))) if np.all(scale > 0) else None
    if out["condition"] is None or not out["condition"] < 1e15:
        return out | {"singular": True}
    out["acceleration"] = by_name(model, model.acceleration(y, rates))
    moved = model.acceleration
    if isinstance(model, Urdf) and set(model.all_kinds) <= {"turn", "slide"} and not model.followers and len(mass) <= MAX_DERIVED:
        out["derivatives"] = model.derivatives(y, rates)
    if isinstance(model, Mjcf) and model.model.nu:
        actuated = lambda y, rates: model.acceleration(y, rates, actuators=True)
        out["acceleration_actuated"] = by_name(model, actuated(y, rates))
        # Actuators with a state of their own are left out of the motion: its initial value is a convention.
        out["ends_actuated"] = model.model.na == 0
        moved = actuated if model.model.na == 0 else moved
    if with_motion:
        ends, fault = motion.motion(model, moved, y, rates, TIMES)
        out["ends"] = [{"time": t, "spread": s, "state": by_joint(model, a, b)} for t, a, b, s in ends]
        out["ends_fault"] = fault
    return out


def write(folder, package, path, kind, free, with_motion):
    full = common.data() / package / path
    seed = zlib.crc32(f"{package}/{path}".encode())
    model = Urdf(full, free) if kind == "urdf" else Mjcf(full)
    if not model.kinds:
        return "nothing moves"
    by = f"pinocchio {pin.__version__}" if kind == "urdf" else f"mujoco {mujoco.__version__}"
    head = {"package": package, "path": path, "sha256": common.digest(full), "by": by, "format": kind}
    head["base"] = "free" if free else "as the file says"
    name = common.short_name(package, path) + ("-free" if free else "")
    text = json.dumps(plain(head | judge(model, seed, with_motion)), separators=(",", ":"))
    (folder / f"{name}.json").write_text(text + "\n")
    return f"{len(model.names)} joints, {len(text) // 1000} kB"


def chosen(options):
    keep = (common.HERE / "committed.txt").read_text().split("\n") if options.committed else []
    for package, path, kind in common.models():
        whole = f"{package}/{path}"
        wanted = not options.words or any(word in whole for word in options.words)
        if kind in ("urdf", "mjcf") and wanted and (not keep or whole in keep):
            yield package, path, kind


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("words", nargs="*")
    parser.add_argument("--out", type=Path)
    parser.add_argument("--free", action="store_true", help="URDF alone, with a free base")
    parser.add_argument("--committed", action="store_true")
    parser.add_argument("--no-motion", action="store_true")
    parser.add_argument("--new", action="store_true", help="leave models out that have a file")
    parser.add_argument("--patience", type=float, help="seconds of computing for a part of a motion")
    options = parser.parse_args()
    motion.PATIENCE = options.patience or motion.PATIENCE
    folder = options.out or (COMMITTED if options.committed else common.folder() / "references")
    folder.mkdir(parents=True, exist_ok=True)
    for package, path, kind in chosen(options):
        there = folder / f"{common.short_name(package, path)}{'-free' * options.free}.json"
        if (options.free and kind != "urdf") or (options.new and there.exists()):
            continue
        try:
            says = write(folder, package, path, kind, options.free, not options.no_motion)
        except Exception as fault:  # each program has its own
            says = "no: " + (str(fault).strip().splitlines() or [type(fault).__name__])[0][:100]
        print(f"{package}/{path}: {says}", flush=True)


if __name__ == "__main__":
    sys.exit(main())

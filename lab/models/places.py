"""Compares the places of all links of each URDF of the packages with Pinocchio, masses or none: places.py [--mbs COMMAND] [--packages WORD...]

Each moving joint has a value by seed, followers those of their leaders. Prints what differs or is refused, then the counts.
"""

import argparse
import json
import subprocess
import zlib
from collections import Counter

import numpy as np
import pinocchio as pin

import common
import guard
import urdf_model

# Differences of places and of directions up to which two programs agree, relative to the size of the model.
NEAR = 1e-9

# Seconds for each program.
LONG = 60


def reference(path, seed):
    """Values of the joints that are free to choose, and the pose of each link."""
    model = urdf_model.Urdf(path)
    if set(model.all_kinds) - {"slide", "turn"}:
        raise ValueError("a joint of several coordinates is not compared")
    values = np.random.default_rng(seed).uniform(-0.7, 0.7, len(model.names))
    q, _, _ = model.place(values, np.zeros(len(values)))
    pin.framesForwardKinematics(model.model, model.data, q)
    links = {
        frame.name: model.data.oMf[i].homogeneous[:3].tolist()
        for i, frame in enumerate(model.model.frames)
        if frame.type == pin.FrameType.BODY
    }
    return dict(zip(model.names, values.tolist())), links


def found(command, path, values):
    """The pose of each link here, or why there is none."""
    given = [word for name, value in values.items() for word in ("--joint", f"{name}={value!r}")]
    words = [command, "inspect", str(path), "--what", "frames", "--json", *given]
    done = subprocess.run(words, capture_output=True, text=True, timeout=LONG)
    if done.returncode:
        return None, done.stderr.strip().splitlines()[0]
    frames = json.loads(done.stdout)["frames"]
    # the name of what does not move is taken here
    frames |= {"ground": frames["ground-link"]} if "ground-link" in frames else {}
    return {n: np.column_stack([f["rotation"], f["position"]]) for n, f in frames.items()}, None


def outcome(command, path):
    answered, answer = guard.call(reference, (path, zlib.crc32(path.name.encode())), LONG)
    if not answered:
        return "not compared", answer
    values, links = answer
    frames, refused = found(command, path, values)
    if refused:
        return "refused", refused
    missing = sorted(set(links) - set(frames) - {"world", "universe"})
    if missing:
        return "differs", f"no frame {missing[0]}"
    links = {name: np.array(pose) for name, pose in links.items() if name in frames}
    size = max([1.0, *(np.abs(pose).max() for pose in links.values())])
    far = {name: np.abs(pose - frames[name]).max() / size for name, pose in links.items()}
    name = max(far, key=far.get, default=None)
    if name and far[name] > NEAR:
        return "differs", f"{name}: {far[name]:.2g}"
    return "agrees", f"{len(links)} links"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--mbs", default="mbs")
    parser.add_argument("--packages", nargs="*", default=[])
    given = parser.parse_args()
    counts = Counter()
    for package, path, kind in common.models(common.collections()):
        if kind != "urdf" or given.packages and not any(word in package for word in given.packages):
            continue
        says, why = outcome(given.mbs, common.collections() / package / path)
        counts[says] += 1
        if says != "agrees":
            print(says, package, path, why, flush=True)
    print(*(f"{n} {says}" for says, n in counts.most_common()))


if __name__ == "__main__":
    main()

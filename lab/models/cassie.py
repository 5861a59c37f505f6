"""Writes the references of a biped with four loops (Cassie, SDF): cassie.py [--out FILE] [--states N] [--duration T]; T = 0: no motion

Ten states by seed: knees at -1.2 to 0 rad, hips within 0.2 rad, rates within 0.5; the rest closes the loops. What follows
is the saddle-point acceleration of sdf_model.py and its motion.
"""

import argparse
import json
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

import common
import motion
import rotation
from references import COMMITTED, by_joint, by_name, plain
from sdf_model import REDUNDANT, Sdf

PACKAGE = "example_robot_data"
FILE = "cmeel.prefix/share/example-robot-data/robots/cassie_description/robots/cassie_v2.sdf"
FOLLOWING = ("shin-tarsus-joint", "tarsus-spring-joint", "achilles-spring-joint", "crank-rod-joint", "foot-op")

# Seconds of computing for one part of a motion: saddle points in Python are slow.
PATIENCE = 400.0

# Axes are off by less, since they are written with six digits; left so, the tilts would lock the legs [rad].
MEANT = 1e-6

# Parts of the way from the drawn configuration to a state: the loops stay on the branch that is drawn.
WAY = 24


def close(model, y, rates, follow):
    """Newton's method on the following joints, the others held; their rates by the rows of the loops."""
    for _ in range(30):
        gap, jacobian, _ = model.rows(y, rates)
        change = np.linalg.lstsq(jacobian[:, follow], -gap, REDUNDANT)[0]
        y = y.copy()
        y[follow + 1] += change
        if np.max(np.abs(change)) < 1e-15:
            break
    gap, jacobian, _ = model.rows(y, rates)
    held = np.setdiff1d(np.arange(len(rates)), follow)
    rates = rates.copy()
    rates[follow] = np.linalg.lstsq(jacobian[:, follow], -jacobian[:, held] @ rates[held], REDUNDANT)[0]
    return y, rates, np.max(np.abs(gap)), np.max(np.abs(jacobian @ rates))


def start(model, seed, follow):
    """A state on the loops. The base has its seven values first, so value i + 1 belongs to row i."""
    draw = np.random.default_rng(seed)
    rows = len(model.names) + 5
    target, rates = np.zeros(rows), draw.uniform(-0.5, 0.5, rows)
    for i, name in enumerate(model.names[1:]):
        reach = {"knee-op": (-1.2, 0.0), "roll-op": (-0.2, 0.2), "yaw-op": (-0.2, 0.2), "pitch-op": (-0.2, 0.2),
                 "crank-joint": (-0.2, 0.2)}
        for end, (low, high) in reach.items():
            if name.endswith(end):
                target[6 + i] = draw.uniform(low, high)
    base = np.concatenate([draw.uniform(-0.2, 0.2, 3), rotation.of_vector(draw.uniform(-0.3, 0.3, 3))])
    y = np.concatenate([base, np.zeros(rows - 6)])
    held = np.setdiff1d(np.arange(6, rows), follow)
    for part in range(1, WAY + 1):
        y[held + 1] = target[held] * part / WAY
        for i, name in enumerate(model.names):
            # The foot's parallelogram is drawn flat, where it may fold over; this guess keeps it open.
            if name.endswith("crank-joint"):
                crank = y[i + 6]
                y[model.names.index(name.replace("tarsus-crank-joint", "foot-op")) + 6] = crank
                y[model.names.index(name.replace("tarsus-crank-joint", "crank-rod-joint")) + 6] = -crank
        y, found, gap, slip = close(model, y, rates, follow)
    return y, found, gap, slip


def state(seed, times, follow):
    """All numbers of one state."""
    model = Sdf(common.data() / PACKAGE / FILE, MEANT)
    y, rates, gap, slip = start(model, seed, follow)
    jacobian = model.rows(y, rates)[1]
    sizes = np.linalg.svd(jacobian, compute_uv=False)
    out = {"seed": seed, "gap": gap, "slip": slip, "rows": len(sizes)}
    out |= {"rank": int(np.sum(sizes > REDUNDANT * sizes[0])), "singular_values": sizes}
    out |= {"state": by_joint(model, y, rates), "acceleration": by_name(model, model.acceleration(y, rates))}
    report = model.report(y, rates)
    out |= {key: report[key] for key in ("mass", "center", "kinetic", "potential")}
    motion.PATIENCE = PATIENCE
    ends, fault = motion.motion(model, model.acceleration, y, rates, times)
    out["ends"] = []
    for time, a, b, spread in ends:
        drift = np.max(np.abs(model.rows(a, b)[0]))
        out["ends"].append({"time": time, "spread": spread, "gap": drift, "state": by_joint(model, a, b)})
    return out | {"ends_fault": fault}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", type=Path, default=COMMITTED / "cassie_v2.sdf.json")
    parser.add_argument("--states", type=int, default=10)
    parser.add_argument("--duration", type=float, default=1.0)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    path = common.data() / PACKAGE / FILE
    model = Sdf(path, MEANT)
    named = [name.endswith(FOLLOWING) for name in model.names]
    follow = np.array([i + 5 for i, yes in enumerate(named) if yes])
    out = {"package": PACKAGE, "path": FILE, "sha256": common.digest(path), "by": "saddle point on pinocchio's terms"}
    out |= {"gravity": model.gravity, "base": "pelvis is free", "cut": [joint["name"] for joint in model.cuts]}
    # With crank and foot both given, the parallelogram cannot fold over.
    out["independent"] = [name for name, yes in zip(model.names, named) if not yes or name.endswith("foot-op")]
    times = [part * options.duration for part in (0.1, 0.3, 1.0) if options.duration > 0]
    out["states"] = []
    with ProcessPoolExecutor(options.jobs) as pool:
        for found in pool.map(partial(state, times=times, follow=follow), range(options.states)):
            out["states"].append(found)
            knees = [found["state"][f"{side}-knee-op"]["value"][0] for side in ("left", "right")]
            ends = [(end["time"], f"{end['spread']:.1e}", f"{end['gap']:.1e}") for end in found["ends"]]
            print(found["seed"], np.round(knees, 3), f"{found['gap']:.1e}", found["rank"], ends, found["ends_fault"], flush=True)
    options.out.write_text(json.dumps(plain(out), separators=(",", ":")) + "\n")


if __name__ == "__main__":
    main()

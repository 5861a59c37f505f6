"""What a file's own program says of it: whether it reads it, accelerations at a state by seed, and the free motion from there.

MuJoCo for MJCF, Pinocchio for URDF, Drake for SDF; contacts, limits and dry friction are off. Equalities of an MJCF are exact.
"""

import zlib

import mujoco
import numpy as np
import pinocchio as pin

import motion
import rotation
from mjcf_model import Mjcf
from mjcf_rows import Rows
from references import by_joint, by_name, plain
from urdf_model import Urdf

# Duration of the motion [s], tolerances of its two integrations, and seconds of computing for each.
TIME, TOLERANCES, PATIENCE = 0.2, (1e-10, 1e-9), 6.0

# Condition of the scaled mass matrix beyond which accelerations have no six digits.
SINGULAR = 1e10

# Larger gaps of a state on rows [m, rad] say that Newton's method found none.
CLOSED = 1e-9

# Rates below this are rounding of zero, where equalities leave no motion.
STILL = 1e-13

# Parts of a random state that are tried where equalities bind it, and steps of the way there.
PARTS, WAY = (0.5, 0.1, 0.02), 24


def reads(kind, path):
    """Raises what the program raises."""
    if kind == "mjcf":
        mujoco.MjModel.from_xml_path(str(path))
    elif kind == "urdf":
        pin.buildModelFromUrdf(str(path))
    else:
        from drake_model import Drake
        Drake(path)
    return True


def condition(mass):
    scale = np.sqrt(np.abs(np.diag(mass)))
    if not len(mass) or not np.all(scale > 0):
        return None
    with np.errstate(all="ignore"):
        found = float(np.linalg.cond(mass / np.outer(scale, scale)))
    return found if found < SINGULAR else None


def on_rows(model, seed):
    """A state by seed that equalities allow, with its gap."""
    y, rates, _ = rotation.random_state(model.kinds, seed)
    rest = np.concatenate([REST[kind] for kind in model.kinds])
    for part in PARTS:
        near = rest + part * (y - rest)
        found, speed, gap = model.closed(near, part * rates, WAY)
        if gap < CLOSED:
            return found, np.where(np.abs(speed) < STILL, 0.0, speed), gap
    return y, rates, gap


REST = {"turn": [0.0], "slide": [0.0], "planar": [0.0] * 3, "ball": [1.0, 0, 0, 0], "free": [0.0, 0, 0, 1, 0, 0, 0]}


def moved(model, out, acceleration, y, rates):
    motion.PATIENCE = PATIENCE
    ends, fault = motion.motion(model, acceleration, y, rates, [TIME], TOLERANCES)
    return out | {"ends": [{"time": t, "spread": s, "state": by_joint(model, a, b)} for t, a, b, s in ends], "ends_fault": fault}


def begun(model, y, rates):
    return {"gravity": model.gravity, "joints": dict(zip(model.names, model.kinds)), "followers": model.followers,
            "state": by_joint(model, y, rates)}


def mjcf(path, seed):
    model = Mjcf(path)
    if not model.kinds:
        return {"why": "nothing moves"}
    is_tied = bool(model.model.neq and np.any(model.model.eq_active0))
    y, rates, _ = rotation.random_state(model.kinds, seed)
    out = {"off": [word for word in model.off if word != "equality"]}
    if is_tied:
        tied = Rows(path)
        found = on_rows(tied, seed)
        if found[2] < CLOSED and tied.is_regular():
            model, (y, rates, gap) = tied, found
            out |= {"hard": {}, "gap": gap}
        else:
            out["off"].append("equality")
    out |= begun(model, y, rates)
    model.place(y, rates)
    out["on"] = {name: model.body_name(model.model.jnt_bodyid[j]) for j, name in enumerate(model.names)}
    out["axes"] = {name: model.axes[j] for j, name in enumerate(model.names)}
    out["condition"] = condition(model.mass_matrix(y))
    if out["condition"] is None:
        return out | {"why": "singular masses"}
    driven = lambda y, rates: model.acceleration(y, rates, actuators=True)
    first = driven(y, rates)
    out["acceleration"] = by_name(model, first)
    model.place(y, rates, actuators=True)
    if np.any(model.data.act_dot):
        return out | {"ends": [], "ends_fault": "actuators with a state that changes"}
    return moved(model, out, driven, y, rates)


def urdf(path, seed):
    model = Urdf(path)
    if not model.kinds:
        return {"why": "nothing moves"}
    y, rates, _ = rotation.random_state(model.kinds, seed)
    out = begun(model, y, rates) | {"frames": model.report(y, rates)["frames"], "condition": condition(model.mass_matrix(y))}
    if out["condition"] is None:
        return out | {"why": "singular masses"}
    return moved(model, out | {"acceleration": by_name(model, model.acceleration(y, rates))}, model.acceleration, y, rates)


def sdf(path, seed):
    from drake_model import Drake
    from judge import by_drake
    model = Drake(path)
    if not model.joints:
        return {"why": "nothing moves"}
    found = by_drake(plain(model.numbers(np.random.default_rng(seed))))
    if found is None:
        return {"why": "a joint of a kind that is not judged"}
    return found | {"ends": [], "ends_fault": "no motion by Drake"}


def ask(kind, path, name):
    """A reference for judge.py, or `why` there is none. Raises where the program does not read the file."""
    return plain({"mjcf": mjcf, "urdf": urdf, "sdf": sdf}[kind](path, zlib.crc32(name.encode())))

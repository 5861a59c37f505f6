"""Which joint of a scene is which of a reference. Readers may write several joints of a body as one, or name the nameless."""

import numpy as np

import rotation


def vector(quaternion):
    """Rotation vector of w x y z."""
    w, v = quaternion[0], np.array(quaternion[1:])
    if w < 0:
        w, v = -w, -v
    s = np.linalg.norm(v)
    return v * (2 * np.arctan2(s, w) / s if s > 1e-300 else 2.0)


class Pair:
    """One joint of the scene and the joints of the reference that it stands for."""

    def __init__(self, name, parts, kinds, turn=None):
        self.name, self.parts, self.kinds = name, parts, kinds
        # Of several joints that are one: its coordinates are `turn` times those of the parts.
        self.turn = turn

    def rows(self, numbers):
        """Rates or accelerations as the scene's joint has them."""
        whole = np.concatenate([np.array(numbers[part], float) for part in self.parts])
        return whole if self.turn is None else self.turn @ whole

    def value(self, numbers):
        """Values as the scene's joint has them: rotations as vectors."""
        whole = np.concatenate([np.array(numbers[part], float) for part in self.parts])
        if self.kinds[-1] in ("ball", "free"):
            slides = whole[:-4] if self.turn is None else self.turn[:3, :3] @ whole[:-4]
            return np.concatenate([slides, vector(whole[-4:])])
        return whole if self.turn is None else self.turn @ whole

    def comparable(self, value):
        """Values with rotations as matrices: vectors jump at pi."""
        value = np.array(value, float)
        if self.kinds[-1] in ("ball", "free"):
            return np.concatenate([value[:-3], rotation.matrix(rotation.of_vector(value[-3:])).ravel()])
        return value


def planar(joint, parts, reference):
    """Two slides and a turn as one planar joint: its directions by those of the parts."""
    normal = np.array(joint["axis"], float) / np.linalg.norm(joint["axis"])
    first = np.array(joint["direction"], float) / np.linalg.norm(joint["direction"])
    second = np.cross(normal, first)
    axes = np.array([reference["axes"][part] for part in parts])
    turn = np.array([[first @ axes[0], first @ axes[1], 0], [second @ axes[0], second @ axes[1], 0], [0, 0, normal @ axes[2]]])
    return Pair(joint["name"], parts, ["slide", "slide", "turn"], turn)


def free(joint, parts, kinds, reference):
    """Three slides and a ball as one free joint: its displacements are along the global axes."""
    turn = np.zeros((6, 6))
    turn[3:, 3:] = np.eye(3)
    for k, part in enumerate(parts[:3]):
        turn[:3, k] = reference["axes"][part]
    return Pair(joint["name"], parts, kinds, np.round(turn, 12))


# How many joints of a body the reader writes as one joint of a kind.
MERGED = {"planar": 3, "free": 4}


def on_body(body, joints, reference):
    """Pairs for the joints of the reference on one body, by their order on it; some of them are one joint of the scene."""
    parts = [part for part, where in reference["on"].items() if where == body]
    ours = [joint for joint in joints if joint["bodies"][1].split("~")[0] == body and joint["kind"] != "weld"]
    # The first joint of a body carries it; later ones close loops.
    ours = [joint for i, joint in enumerate(ours) if joint["bodies"][1] not in [other["bodies"][1] for other in ours[:i]]]
    spare, found = len(parts) - len(ours), []
    for joint in sorted(ours, key=lambda joint: chain(joint, body)):
        size = MERGED.get(joint["kind"], 1)
        size = size if size - 1 <= spare else 1
        spare -= size - 1
        some, parts = parts[:size], parts[size:]
        kinds = [reference["joints"][part] for part in some]
        merge = {"planar": lambda: planar(joint, some, reference), "free": lambda: free(joint, some, kinds, reference)}
        found.append(merge[joint["kind"]]() if size > 1 else Pair(joint["name"], some, kinds))
    if parts or spare:
        raise ValueError(f"the joints of body {body} are not those of the reference")
    return found


def chain(joint, body):
    """Its place among the joints of a body: massless links between have numbers."""
    end = joint["bodies"][1]
    return (1, 0) if end == body else (0, int(end.rsplit("~", 1)[1]))


def pairs(scene, reference):
    """A pair for every joint of the reference, by name, by the free base, or by body."""
    joints = scene.get("joint", [])
    names = {joint["name"] for joint in joints}
    free = [joint["name"] for joint in joints if joint["kind"] == "free"]
    found, bodies = [], []
    for part, kind in reference["joints"].items():
        if part in names:
            found.append(Pair(part, [part], [kind]))
        elif part == "base" and len(free) == 1:
            found.append(Pair(free[0], [part], [kind]))
        elif any(name.endswith(f"::{part}") for name in names):
            found.append(Pair(next(name for name in names if name.endswith(f"::{part}")), [part], [kind]))
        elif "on" not in reference:
            raise ValueError(f"no joint {part}")
        elif reference["on"][part] not in bodies:
            bodies.append(reference["on"][part])
    # A body with one joint that is not found by its name is matched as a whole.
    found = [pair for pair in found if reference.get("on", {}).get(pair.parts[0]) not in bodies]
    for body in bodies:
        found += on_body(body, joints, reference)
    return found

"""Imports models, runs them, and compares with the references: judge.py [--mbs COMMAND] [--references FOLDER] [WORD...]

A row says: imported or refused, ran 1 s or stopped, and the largest relative differences of accelerations, of kinetic energy
and of the free motion. Dry friction, contacts and limits are taken out of the scene, as they are out of the references.
"""

import argparse
import csv
import json
import re
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import numpy as np

import common
import rotation
from references import COMMITTED

# Effects that no reference has.
LEFT_OUT = {"friction", "limit", "contact"}

# Spreads below this say that a reference's end is worth comparing.
WORTH = 1e-10

RUN = ["--formulation", "recursive", "--integrator", "rk853", "--tolerance", "1e-12", "--energy-alarm", "1e9"]


def run(command, timeout):
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout)
    except subprocess.TimeoutExpired:
        return 124, f"longer than {timeout} s"
    return done.returncode, done.stderr + done.stdout


def vector(quaternion):
    """Rotation vector of w x y z."""
    w, v = quaternion[0], np.array(quaternion[1:])
    if w < 0:
        w, v = -w, -v
    s = np.linalg.norm(v)
    return v * (2 * np.arctan2(s, w) / s if s > 1e-300 else 2.0)


def own_value(kind, value):
    """A value of the references as a scene has it: rotations as vectors."""
    if kind in ("ball", "free"):
        return list(value[:-4]) + list(vector(value[-4:]))
    return list(value)


def blocks(text):
    """The tables of a scene's text, each with its lines."""
    parts = [[]]
    for line in text.splitlines(keepends=True):
        if line.startswith("["):
            parts.append([])
        parts[-1].append(line)
    return ["".join(part) for part in parts]


def without(text):
    """The scene without the effects and starts that no reference has."""
    kept = []
    for block in blocks(text):
        head = block.lstrip()
        if head.startswith("[[effect]]"):
            if tomllib.loads(block)["effect"][0].get("kind") in LEFT_OUT:
                continue
        if head.startswith(("[[initial]]", "[[output]]", "[[contact]]")):
            continue
        kept.append(block)
    return "".join(kept)


def base_name(scene, reference):
    """The free joint of the scene that stands for the reference's `base`."""
    free = [joint["name"] for joint in scene.get("joint", []) if joint["kind"] == "free"]
    return {"base": free[0]} if len(free) == 1 and "base" in reference["joints"] else {}


def names_of(scene, reference):
    """{joint of the reference: joint of the scene}, None where one has no partner."""
    there = {joint["name"] for joint in scene.get("joint", [])}
    own = base_name(scene, reference)
    found = {name: own.get(name, name) for name in reference["joints"]}
    missing = [name for name, ours in found.items() if ours not in there]
    return found, missing


def prepared(text, reference):
    """Scene text with the reference's state, and with channels of all joints."""
    scene = tomllib.loads(text)
    names, missing = names_of(scene, reference)
    if missing:
        raise ValueError("no joint " + ", ".join(missing[:3]))
    lines = [without(text)]
    held = reference.get("independent", names)
    for name, kind in reference["joints"].items():
        ours, state = json.dumps(names[name], ensure_ascii=False), reference["state"][name]
        value = [float(number) for number in own_value(kind, state["value"])]
        rate = [float(number) for number in state["rate"]]
        one = len(rate) == 1
        if name in held:
            lines.append(f"\n[[initial]]\njoint = {ours}\nvalue = {value[0] if one else value}\nrate = {rate[0] if one else rate}\n")
        for i, quantity in enumerate(("value", "rate", "acceleration")):
            lines.append(f'\n[[output]]\nname = "{list(names).index(name)}:{i}"\njoint = {ours}\nquantity = "{quantity}"\n')
    return "".join(lines), names


def read_rows(folder):
    """The first and last row of run.csv: {(joint number, quantity): numbers}."""
    with open(folder / "run.csv", newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    head, first, last = rows[0], rows[1], rows[-1]
    out = []
    for row in (first, last):
        found = {}
        for key, number in zip(head, row):
            parts = key.split(".")[0].split(" ")[0].split(":")
            if len(parts) == 2 and all(part.isdigit() for part in parts):
                found.setdefault((int(parts[0]), int(parts[1])), []).append(float(number))
        out.append(found)
    return out


def difference(found, wanted):
    """Largest difference by the largest of all numbers, or by 1 where all are smaller: rates of the states are up to 1."""
    a, b = np.concatenate(found), np.concatenate(wanted)
    return float(np.max(np.abs(a - b)) / max(1.0, np.max(np.abs(b))))


def turned_alike(kind, found, wanted):
    """Values, with rotations as matrices: vectors jump at pi."""
    if kind not in ("ball", "free"):
        return np.array(found), np.array(wanted)
    mine = rotation.matrix(rotation.of_vector(np.array(found[-3:]))).ravel()
    theirs = rotation.matrix(np.array(wanted[-4:])).ravel()
    return np.concatenate([found[:-3], mine]), np.concatenate([wanted[:-4], theirs])


def compare(reference, first, last, end):
    kinds = list(reference["joints"].items())
    out = {"acceleration": None, "motion": None}
    wanted = reference.get("acceleration_actuated") or reference.get("acceleration")
    if wanted:
        out["acceleration"] = difference([first[i, 2] for i in range(len(kinds))], [wanted[name] for name, _ in kinds])
    if end:
        pairs = [turned_alike(kind, last[i, 0], end["state"][name]["value"]) for i, (name, kind) in enumerate(kinds)]
        pairs += [(last[i, 1], end["state"][name]["rate"]) for i, (name, _) in enumerate(kinds)]
        out["motion"] = difference(*[[pair[k] for pair in pairs] for k in (0, 1)])
    return out


def first_line(text):
    """The line that says why: one with a place, else the first."""
    lines = [line for line in text.strip().splitlines() if line.strip()]
    errors = [line for line in lines if re.search(r":\d+:\d+: ", line)] or lines
    return errors[0][:200].replace(str(common.folder()) + "/", "") if errors else "nothing said"


def cases(options):
    """(name, model, reference) of the references, of the files on conventions, and of the states of the biped."""
    if options.conventions:
        found = json.loads((common.HERE / "conventions/conventions.json").read_text())["files"]
        for name, reference in found.items():
            yield name, common.HERE / "conventions" / name, reference | reference.get("hard", {})
        return
    for path in sorted(options.references.glob("*.json")):
        reference = json.loads(path.read_text())
        model = common.data() / reference["package"] / reference["path"]
        if "states" not in reference:
            yield path.stem, model, reference
        for state in reference.get("states", []):
            kinds = {1: "turn", 6: "free"}
            joints = {name: kinds[len(rows["rate"])] for name, rows in state["state"].items()}
            yield f"{path.stem}-{state['seed']}", model, reference | state | {"joints": joints}


def one(name, model, reference, options, work):
    """A row of the table."""
    row = {"model": name, "imported": "no", "ran": "", "says": ""}
    scene = work / f"{name}.toml"
    extra = ["--base", "free"] if reference.get("base") == "free" else []
    started = time.monotonic()
    code, said = run([*options.importer, "import", str(model), "-o", str(scene), *extra, *options.options], 60)
    row["ms"] = round(1000 * (time.monotonic() - started))
    if code:
        return row | {"says": first_line(said)}
    row["imported"] = "yes"
    text = scene.read_text()
    code, said = run([options.mbs, "run", str(scene), "--out", str(work / "plain"), "--duration", "1"], options.patience)
    row["ran"] = "no" if code else "yes"
    row["says"] = first_line(said) if code else ""
    try:
        changed, _ = prepared(text, reference)
    except ValueError as fault:
        return row | {"says": row["says"] or str(fault)}
    ends = [end for end in reference.get("ends", []) if end["spread"] < WORTH]
    scene.write_text(changed)
    length = str(ends[-1]["time"] if ends else 1e-3)
    folder = work / "judged"
    code, said = run([options.mbs, "run", str(scene), "--out", str(folder), "--duration", length, *RUN], options.patience)
    if code:
        return row | {"says": row["says"] or first_line(said)}
    return row | compare(reference, *read_rows(folder), ends[-1] if ends else None) | {"time": length}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("words", nargs="*")
    parser.add_argument("--mbs", default="mbs")
    parser.add_argument("--importer", help="a command with `import`, if it is another one")
    parser.add_argument("--references", type=Path, default=COMMITTED)
    parser.add_argument("--conventions", action="store_true", help="the files on conventions in place of robots")
    parser.add_argument("--options", nargs="*", default=[], help="further options of `mbs import`")
    parser.add_argument("--patience", type=float, default=120)
    parser.add_argument("--table", type=Path)
    options = parser.parse_args()
    options.importer = [options.importer or options.mbs]
    options.options = [f"--{word}" for word in options.options]
    work = common.folder() / "judged"
    work.mkdir(parents=True, exist_ok=True)
    rows = []
    for name, model, reference in cases(options):
        if options.words and not any(word in name for word in options.words):
            continue
        rows.append(one(name, model, reference, options, work))
        show = {key: f"{value:.1e}" if isinstance(value, float) else value for key, value in rows[-1].items()}
        print(*(f"{key}={value}" for key, value in show.items() if value not in ("", None)), flush=True)
    yes = lambda key: sum(row.get(key) == "yes" for row in rows)
    near = lambda key: sum(row.get(key) is not None and row[key] <= 1e-9 for row in rows)
    print(f"{len(rows)} models: {yes('imported')} imported, {yes('ran')} ran 1 s, within 1e-9: "
          f"{near('acceleration')} accelerations, {near('motion')} motions")
    if options.table:
        with open(options.table, "w", newline="") as file:
            table = csv.DictWriter(file, ["model", "imported", "ran", "acceleration", "motion", "time", "ms", "says"], restval="")
            table.writeheader()
            table.writerows(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())

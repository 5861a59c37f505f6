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
import match
from references import COMMITTED

# Effects that no reference has.
LEFT_OUT = {"friction", "limit", "contact"}

# Spreads below this say that a reference's end is worth comparing.
WORTH = 1e-10

# The accelerations that a reference has, those first in which most acts.
ACCELERATIONS = ["acceleration_ctrl", "acceleration_actuated", "acceleration"]

RUN = ["--formulation", "recursive", "--integrator", "rk853", "--tolerance", "1e-12", "--energy-alarm", "1e9"]


def run(command, timeout):
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout)
    except subprocess.TimeoutExpired:
        return 124, f"longer than {timeout} s"
    return done.returncode, done.stderr + done.stdout


def blocks(text):
    """The tables of a scene's text, each with its lines."""
    parts = [[]]
    for line in text.splitlines(keepends=True):
        if line.startswith("["):
            parts.append([])
        parts[-1].append(line)
    return ["".join(part) for part in parts]


def without(text, reference):
    """The scene without the effects and starts that no reference has, and without couplings and loops where equalities are off."""
    kept, loose, carried = [], "equality" in reference.get("off", []) and "hard" not in reference, set()
    for block in blocks(text):
        head = block.lstrip()
        if head.startswith("[[effect]]"):
            if tomllib.loads(block)["effect"][0].get("kind") in LEFT_OUT:
                continue
        if loose and head.startswith("[[coupling]]"):
            continue
        if loose and head.startswith("[[joint]]"):
            child = tomllib.loads(block)["joint"][0]["bodies"][1]
            if child in carried:
                continue
            carried.add(child)
        if head.startswith(("[[initial]]", "[[output]]", "[[contact]]")):
            continue
        kept.append(block)
    return "".join(kept)


def prepared(text, reference):
    """Scene text with the reference's state, and with channels of all joints; and the pairs of joints."""
    found = match.pairs(tomllib.loads(text), reference)
    lines, held = [without(text, reference)], reference.get("independent", reference["joints"])
    values = {name: rows["value"] for name, rows in reference["state"].items()}
    rates = {name: rows["rate"] for name, rows in reference["state"].items()}
    for i, pair in enumerate(found):
        joint = f"joint = {json.dumps(pair.name, ensure_ascii=False)}"
        value, rate = ([float(n) for n in numbers] for numbers in (pair.value(values), pair.rows(rates)))
        if len(rate) == 1:
            value, rate = value[0], rate[0]
        if pair.parts[0] in held:
            lines.append(f"\n[[initial]]\n{joint}\nvalue = {value}\nrate = {rate}\n")
        for k, quantity in enumerate(("value", "rate", "acceleration")):
            lines.append(f'\n[[output]]\nname = "{i}:{k}"\n{joint}\nquantity = "{quantity}"\n')
    return "".join(lines), found


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


def compare(reference, found, first, last, end):
    out = {"acceleration": None, "motion": None}
    wanted = next((reference[key] for key in ACCELERATIONS if reference.get(key)), None)
    if wanted:
        out["acceleration"] = difference([first[i, 2] for i in range(len(found))], [pair.rows(wanted) for pair in found])
    if end:
        values = {name: rows["value"] for name, rows in end["state"].items()}
        rates = {name: rows["rate"] for name, rows in end["state"].items()}
        ours = [pair.comparable(last[i, 0]) for i, pair in enumerate(found)] + [last[i, 1] for i in range(len(found))]
        theirs = [pair.comparable(pair.value(values)) for pair in found] + [pair.rows(rates) for pair in found]
        out["motion"] = difference(ours, theirs)
    return out


def first_line(text):
    """The line that says why: one with a place, else the first."""
    lines = [line for line in text.strip().splitlines() if line.strip()]
    errors = [line for line in lines if re.search(r":\d+:\d+: ", line)] or lines
    return errors[0][:300].replace(str(common.folder()) + "/", "") if errors else "nothing said"


def by_drake(found):
    """A reference from what Drake says; its free bodies stand as they are drawn."""
    kinds = {"revolute": "turn", "prismatic": "slide", "universal": "universal", "quaternion_floating": "free", "ball_rpy": "ball",
             "screw": "cylinder"}
    out = {"joints": {}, "state": {}, "acceleration": {}}
    for name, joint in found["joints"].items():
        kind = kinds.get(joint["type"])
        if kind is None:
            return None
        counted = joint.get("ours", joint)
        value, rate, acceleration = counted["value"], counted["rate"], counted["acceleration"]
        if kind == "free":
            name, value = "base", [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]
            rate, acceleration = rate[3:] + rate[:3], acceleration[3:] + acceleration[:3]
        out["joints"][name] = kind
        out["state"][name] = {"value": value, "rate": rate}
        out["acceleration"][name] = acceleration
    return out


def conventions():
    """(name, model, reference) of the files on conventions."""
    folder = common.HERE / "conventions"
    for name, found in json.loads((folder / "conventions.json").read_text())["files"].items():
        yield name, folder / name, found | found.get("hard", {})
    for name, found in json.loads((folder / "sdf.json").read_text())["files"].items():
        reference = by_drake(found)
        if reference:
            yield name, folder / name, reference


def cases(options):
    """(name, model, reference) of the references, of the files on conventions, and of the states of the biped."""
    if options.conventions:
        yield from conventions()
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
    if "ctrl" in reference:
        extra += ["--key", "on"]
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
        changed, found = prepared(text, reference)
    except ValueError as fault:
        return row | {"says": row["says"] or str(fault)}
    ends = [end for end in reference.get("ends", []) if end["spread"] < WORTH]
    scene.write_text(changed)
    length = str(ends[-1]["time"] if ends else 1e-3)
    folder = work / "judged"
    code, said = run([options.mbs, "run", str(scene), "--out", str(folder), "--duration", length, *RUN], options.patience)
    if code:
        return row | {"says": row["says"] or first_line(said)}
    return row | compare(reference, found, *read_rows(folder), ends[-1] if ends else None) | {"time": length}


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

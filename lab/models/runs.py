"""Which models of the packages run by the settings that the command chooses: runs.py [--mbs COMMAND] [--duration T] PACKAGE...

Models that their own program reads and in which something moves. `runs.csv` in `agreement` of the folder of models has those that do not
run, with what the command said.
"""

import argparse
import csv
import sys
import time

import ask
import common
import guard
import judge

# Seconds for reading by the own program, and for import and run by the command.
READ, RUN = 60, 120


def moves(kind, path):
    """Whether the own program reads the file, and finds coordinates in it."""
    if kind == "mjcf":
        return ask.mujoco.MjModel.from_xml_path(str(path)).nv > 0
    if kind == "urdf":
        return ask.pin.buildModelFromUrdf(str(path)).nv > 0
    return bool(ask.reads(kind, path))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("packages", nargs="+")
    parser.add_argument("--mbs", default="mbs")
    parser.add_argument("--duration", default="0.2")
    options = parser.parse_args()
    folder, counts, rows = common.folder() / "agreement", {}, []
    folder.mkdir(parents=True, exist_ok=True)
    for package, path, kind in common.models(common.collections()):
        full = common.collections() / package / path
        if kind == "fragment" or not package.startswith(tuple(options.packages)) or guard.call(moves, (kind, full), READ) != (True, True):
            continue
        started = time.monotonic()
        code, said = judge.run([options.mbs, "run", str(full), "--duration", options.duration, "--out", str(folder / "run")], RUN)
        tally = counts.setdefault((package, kind), [0, 0])
        tally[0] += 1
        tally[1] += code == 0
        if code:
            rows.append({"package": package, "path": path, "format": kind, "seconds": round(time.monotonic() - started, 1)})
            rows[-1]["says"] = judge.first_line(said)
            print(package, path, rows[-1]["says"], flush=True)
    with open(folder / "runs.csv", "w", newline="") as file:
        table = csv.DictWriter(file, ["package", "path", "format", "seconds", "says"], lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    for (package, kind), (tried, ran) in sorted(counts.items()):
        print(f"{package} {kind}: {ran} of {tried} ran {options.duration} s")


if __name__ == "__main__":
    sys.exit(main())

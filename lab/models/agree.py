"""Compares the import of every model of the packages with its own program: agree.py [--mbs COMMAND] [--packages WORD...] [--files WORD...]

A file is asked of its own program (ask.py), imported, and run for 0.2 s from the same state. Each file is a JSON of its own under
`agreement` of the folder of models, and is computed anew where the file, this program or the command has changed. `--show` prints each.
"""

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
import time
import zlib
from pathlib import Path

import acts
import ask
import common
import guard
import judge
import saved
import tally

# Differences of accelerations and of the motion up to which programs agree, relative to the largest number.
NEAR = 1e-6

# The same for a model that MuJoCo has written with six digits.
NEAR_SAVED = 1e-5

# Spread of a reference's own end, between two tolerances, beyond which it judges nothing: its error is a tenth of that.
WORTH = 1e-7

# Seconds for reading, for the whole answer of the own program, for an import, and for a run.
READ, ASK, IMPORT, RUN = 60, 90, 60, 60

# What of the own program's answer is computed here: files of that are asked anew after a change.
ASKING = ["ask.py", "mjcf_model.py", "mjcf_rows.py", "urdf_model.py", "drake_model.py", "motion.py", "rotation.py"]


# And of what is done with the command.
JUDGING = ["agree.py", "judge.py", "match.py", "saved.py", "acts.py"]


def fingerprint(paths):
    return hashlib.sha256(b"".join(Path(path).read_bytes() for path in paths)).hexdigest()[:12]


# The mark of whatever there is.
ANY = "any"


def cached(path, mark, compute):
    """What a file holds, computed anew unless it was with the same mark."""
    if path.exists():
        found = json.loads(path.read_text())
        if found.get("mark") == mark or ANY in mark:
            return found
    found = compute() | {"mark": mark}
    path.write_text(json.dumps(found))
    return found


def asked(kind, path, name):
    """The reference, with `sound` and the reason where there is none."""
    is_sound, says = guard.call(ask.reads, (kind, path), READ)
    if not is_sound:
        return {"sound": False, "why": says}
    is_known, found = guard.call(ask.ask, (kind, path, name), ASK)
    return {"sound": True} | (found if is_known else {"why": found})


def imported(mbs, path, scene):
    """`--json` of the import, or the line that refuses."""
    command = [mbs, "import", str(path), "-o", str(scene), "--json"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=IMPORT)
    except subprocess.TimeoutExpired:
        return None, f"longer than {IMPORT} s"
    if done.returncode:
        return None, judge.first_line(done.stderr)
    return json.loads(done.stdout), ""


def compared(mbs, reference, scene, work):
    """{acceleration, motion} as relative differences, or `says` why there are none."""
    if "acceleration" not in reference:
        return {"says": reference.get("why", "")}
    try:
        text, found = judge.prepared(scene.read_text(), reference)
    except (ValueError, KeyError) as fault:
        return {"says": f"joints: {fault}", "broken": True}
    changed = work / "changed.toml"
    changed.write_text(text)
    ends = [end for end in reference.get("ends", []) if end["spread"] < WORTH]
    says = ""
    for end, settings in [*((end, RECURSIVE) for end in ends), (None, RECURSIVE), (None, EXPLICIT), (None, [])]:
        length = str(end["time"]) if end else "1e-4"
        code, said = judge.run([mbs, "run", str(changed), "--out", str(work / "out"), "--duration", length, *settings], RUN)
        if code == 0:
            return judge.compare(reference, found, *judge.read_rows(work / "out"), end) | {"says": says}
        says = says or judge.first_line(said)
    return {"says": says, "broken": True}


# Exact to about ten digits; where it stops, accelerations alone are compared, by the settings that the command chooses.
EXPLICIT = ["--formulation", "state-space"]
RECURSIVE = ["--formulation", "recursive", "--integrator", "rk853", "--tolerance", "1e-11", "--energy-alarm", "1e9"]


def agrees(row, near=NEAR):
    return not row.get("broken") and all(row.get(key) is None or row[key] <= near for key in ("acceleration", "motion"))


def second(mbs, kind, path, reference, work):
    """What the import of the model that MuJoCo writes gives."""
    if kind != "mjcf" or "acceleration" not in reference:
        return {}
    is_written, text = guard.call(saved.text, (path,), READ)
    if not is_written:
        return {"saved": f"no: {text}"}
    file, scene = work / "saved.xml", work / "saved.toml"
    file.write_text(text)
    found, says = imported(mbs, file, scene)
    if found is None:
        return {"saved": f"refused: {says}"}
    row = compared(mbs, reference, scene, work)
    if not row.get("broken") and "acceleration" in row:
        return {"saved": "yes" if agrees(row, NEAR_SAVED) else "no", "saved_difference": row["acceleration"]}
    return {"saved": f"no: {row['says']}"}


def judged(mbs, kind, path, reference, work):
    """The row of one file, the command's part of it."""
    scene = work / "scene.toml"
    found, says = imported(mbs, path, scene)
    if found is None:
        row = {"imported": "no", "says": says}
        return row | (second(mbs, kind, path, reference, work) if reference["sound"] else {})
    row = {"imported": "yes", "acts": acts.lines(kind, found), "faults": [fault["code"] for fault in found["faults"] or []]}
    if not reference["sound"]:
        return row
    row |= compared(mbs, reference, scene, work)
    row["agrees"] = agrees(row)
    return row if row["agrees"] else row | second(mbs, kind, path, reference, work)


def one(options, folder, package, path, kind):
    full = common.collections() / package / path
    name, digest = f"{package}/{path}", common.digest(full)
    key = f"{zlib.crc32(name.encode()):08x}-{digest}"
    if options.known and not (folder / "rows" / f"{key}.json").exists():
        return None
    if options.known:
        options.asking = options.judging = ANY
    reference = cached(folder / "asked" / f"{key}.json", options.asking, lambda: asked(kind, full, name))
    started = time.monotonic()
    row = cached(folder / "rows" / f"{key}.json", f"{options.judging} {options.asking}",
                 lambda: judged(options.mbs, kind, full, reference, folder / f"work-{os.getpid()}"))
    row |= {"package": package, "path": path, "format": kind, "sha256": digest, "sound": reference["sound"], "key": key}
    row["why"] = reference.get("why", reference.get("ends_fault") or "")
    row["seconds"] = round(time.monotonic() - started, 1)
    return row


def chosen(options):
    """Files of the packages, each text once: some packages are copies of others."""
    seen, here = set(), {"-".join(path.name.split("-")[:-1]): path.name for path in common.collections().iterdir()}
    for package, path, kind in common.models(common.collections()):
        digest = common.digest(common.collections() / package / path)
        if kind == "fragment" or package not in here.values() or digest in seen:
            continue
        seen.add(digest)
        is_meant = not options.packages or any(package.startswith(word) for word in options.packages)
        if is_meant and (not options.files or any(word in path for word in options.files)) and kind in options.formats:
            yield package, path, kind


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--mbs", default="mbs")
    parser.add_argument("--packages", nargs="*", default=[])
    parser.add_argument("--files", nargs="*", default=[])
    parser.add_argument("--formats", nargs="*", default=["mjcf", "urdf", "sdf"])
    parser.add_argument("--every", type=int, default=1, help="one file of so many")
    parser.add_argument("--known", action="store_true", help="only tables, of the files that have a row by whatever program")
    parser.add_argument("--show", action="store_true")
    options = parser.parse_args()
    folder = common.folder() / "agreement"
    for part in ("asked", "rows", f"work-{os.getpid()}"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    options.asking = fingerprint([common.HERE / name for name in ASKING])
    options.judging = fingerprint([shutil.which(options.mbs), *(common.HERE / name for name in JUDGING)])
    rows = []
    for package, path, kind in list(chosen(options))[::options.every]:
        row = one(options, folder, package, path, kind)
        rows += [row] if row else []
        if options.show and row:
            print(tally.line(rows[-1]), flush=True)
    tally.write(folder, rows)
    shutil.rmtree(folder / f"work-{os.getpid()}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Compares the verdicts of `oriel validate` and val3dity on every geometry of every object, as read and as written.

  bench/judge.py VAL3DITY [DATA] [WORD...]

VAL3DITY is the path of its executable, built outside of the project, DATA the folder of the data sets (../shared/data).
Every CityJSON file and stream of DATA is judged as it is, and so is what `oriel repair` and `oriel generalise` make of each
file, at six scales and three levels of detail. WORDs select runs by parts of their names: `input`, `3dbag`, `1:500`, `cases/geometry`.
$ORIEL is the command. The exit code is 1 if an object that val3dity refuses was written without a word or with the exit
code 0, or if the verdicts differ beyond the differences that docs/validate.md lists."""
import collections
import json
import os
import re
import subprocess
import sys
import tempfile

TARGETS = {"input": None, "repair": ["repair"], "repair any": ["repair", "--close", "any"],
           **{f"1:{s}": ["generalise", "--scale", f"1:{s}"] for s in (500, 1000, 2500, 5000, 10000, 25000)},
           **{f"LoD {lod}": ["generalise", "--to-lod", lod] for lod in ("2.0", "1.2", "1.0")}}
# 902 and below 101 are about files; 501 to 503 are judged, too, but stand for a relation of solids of one object.
JUDGED = range(101, 602)


def records(path):
    """The objects of a file, or of each line of a stream."""
    with open(path, encoding="utf-8") as file:
        if not path.endswith(".jsonl"):
            yield json.load(file)["CityObjects"]
            return
        for line in file:
            yield json.loads(line)["CityObjects"]


def lod_text(lod):
    return f"{lod:g}" if isinstance(lod, (int, float)) else lod


class Objects:
    """The geometries of a file: of each object the levels of detail by number, and the head of its family."""

    def __init__(self, path):
        self.lods, self.head, self.buildings = {}, {}, set()
        for objects in records(path):
            for name, one in objects.items():
                self.lods[name] = [lod_text(g.get("lod", "")) for g in one.get("geometry", [])]
                if one["type"] in ("Building", "BuildingPart"):
                    self.buildings.add(name)
                if one["type"] == "BuildingPart":
                    self.head[name] = (one.get("parents") or [name])[0]

    def levels_drawn(self, name, target):
        """Those that generalise is asked for: of an object as read the highest."""
        levels = self.lods.get(name, [])
        return {target[4:]} if target.startswith("LoD") else set(sorted(levels)[-1:])

    def family(self, name):
        while name in self.head and self.head[name] != name:
            name = self.head[name]
        return name


def by_val3dity(val3dity, path, objects, work):
    """The codes by object and level of detail; 601 by the head of the family. None if val3dity fails."""
    report = os.path.join(work, "report.json")
    done = subprocess.run([val3dity, path, "--report", report], capture_output=True, text=True, check=False)
    if not os.path.exists(report):
        return None if done.returncode else {}
    with open(report, encoding="utf-8") as file:
        told = json.load(file)
    os.remove(report)
    if told["input_errors"] if "input_errors" in told else told.get("dataset_errors"):
        return None
    found = collections.defaultdict(set)
    for feature in told["features"]:
        for error in feature["errors"]:
            if error["code"] not in JUDGED:
                continue
            place = re.search(r"coid=(.*?)\|geom=(\d+)", error["id"])
            name, number = (place[1], int(place[2])) if place else (feature["id"], 0)
            if error["code"] == 601:
                name = objects.family(name)
            lod = objects.lods.get(name, [""])[number] if error["code"] != 601 else "parts"
            found[name, lod].add(error["code"])
    return found


def by_oriel(oriel, path, objects):
    done = subprocess.run([oriel, "validate", "--lod", "all", "--json", path], capture_output=True, text=True, check=False)
    found = collections.defaultdict(set)
    for line in map(json.loads, done.stdout.splitlines()):
        for finding in line["findings"]:
            code = finding.get("val3dity", 0)
            if code not in JUDGED:
                code = finding["code"]
            key = (objects.family(line["id"]), "parts") if code == 601 else (line["id"], line.get("lod", ""))
            found[key].add(code)
    return found, done.returncode


def inputs(data):
    for folder, _, names in sorted(os.walk(data)):
        for name in sorted(names):
            if name.endswith((".city.json", ".city.jsonl")):
                yield os.path.join(folder, name)


class Table:
    """Counts of geometries by set and target, and the lines of those on which the judges differ."""

    def __init__(self):
        self.counts = collections.defaultdict(collections.Counter)
        self.faults = 0

    def add(self, key, kind, line=None):
        self.counts[key][kind] += 1
        if line:
            self.faults += 1
            print(f"  {kind}: {line}", flush=True)


def judge(oriel, val3dity, path, output, target, said, work, table, key):
    """Compares the verdicts on one file; of an output also whether what is invalid was named. Other levels of detail than
    those asked for stay as they were: they are counted by themselves."""
    objects = Objects(output)
    theirs, (ours, _) = by_val3dity(val3dity, output, objects, work), by_oriel(oriel, output, objects)
    if theirs is None:
        table.add(key, "not read by val3dity")
        return
    for name, lods in objects.lods.items():
        for lod in set(lods):
            table.counts[key]["geometries"] += lods.count(lod)
    for place in sorted(set(theirs) | set(ours)):
        name, lod = place
        a, b = theirs.get(place, set()), ours.get(place, set())
        text = f"{target} {path} {name} lod {lod}: val3dity {sorted(a)} validate {sorted(map(str, b))}"
        if a:
            table.counts[key]["refused"] += 1
        if a and not b:
            table.add(key, "only val3dity", text)
        elif b and not a:
            table.add(key, "only validate", text)
        elif a and a != b:
            table.add(key, "other codes")
            print(f"  other codes: {text}")
        if a and said is not None:
            code, stderr = said
            if lod != "parts" and lod not in objects.levels_drawn(name, target):
                table.counts[key]["other levels"] += 1
            elif target.startswith("repair") and (lod == "parts" or name not in objects.buildings):
                pass  # repair is about buildings, one by one
            elif code == 0 or name not in stderr:
                table.add(key, "not named", f"{text}; exit code {code}")


def run(oriel, path, target, work):
    output = os.path.join(work, os.path.basename(path))
    done = subprocess.run([oriel, *TARGETS[target], path, "-o", output, "--progress", "none", "-v"],
                          capture_output=True, text=True, check=False)
    return output if os.path.exists(output) else None, (done.returncode, done.stderr)


def main():
    val3dity, *rest = sys.argv[1:] or sys.exit(__doc__)
    data = rest[0] if rest else "../shared/data"
    oriel, table = os.path.abspath(os.environ.get("ORIEL", "build/release/cli/oriel")), Table()
    for target in TARGETS:
        for path in inputs(data):
            short = os.path.relpath(path, data)
            if rest[1:] and not any(word in f"{target} {short}" for word in rest[1:]):
                continue
            key = (os.path.dirname(short), target)
            with tempfile.TemporaryDirectory() as work:
                output, said = (path, None) if target == "input" else run(oriel, path, target, work)
                if output is None:
                    table.add(key, "nothing written")
                else:
                    judge(oriel, val3dity, short, output, target, said, work, table, key)
    kinds = ["geometries", "refused", "only val3dity", "only validate", "other codes", "other levels", "not named",
             "nothing written", "not read by val3dity"]
    print("| set | target | " + " | ".join(kinds) + " |\n|" + "---|" * (len(kinds) + 2))
    for (folder, target), counts in sorted(table.counts.items()):
        print(f"| {folder} | {target} | " + " | ".join(str(counts[kind]) for kind in kinds) + " |")
    sys.exit(1 if table.faults else 0)


if __name__ == "__main__":
    main()

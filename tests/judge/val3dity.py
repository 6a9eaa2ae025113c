#!/usr/bin/env python3
"""What tests/judge/val3dity.sh runs: val3dity.py ORIEL VAL3DITY DATA [WORD...]. Exit code 1 if a solid that was written is
not valid to val3dity or to `oriel validate`, or is not the same in a file, in a stream and alone."""
import collections
import glob
import json
import os
import subprocess
import sys
import tempfile

from city_files import by_transform, city_json, city_json_seq, geometries

COMMANDS = {"repair": ["repair"], "repair-any": ["repair", "--close", "any"]}
for scale in (500, 1000, 2500, 5000, 10000):
    COMMANDS[f"generalise-{scale}"] = ["generalise", "--scale", f"1:{scale}"]
for level in ("1.0", "1.2", "2.0"):
    COMMANDS[f"to-lod-{level}"] = ["generalise", "--to-lod", level]


def data_sets(data):
    """Name, files and level of detail of each set."""
    yield "delfshaven", [f"{data}/delfshaven/delfshaven.city.json"], None
    for lod in ("1.2", "1.3", "2.2"):
        yield f"3dbag-{lod}", [f"{data}/3dbag/tile_5910.city.jsonl"], lod
    for folder in ("ingolstadt", "houses/clean", "houses/noisy", "houses/triangles", "delft-blocks", "random3dcity",
                   "ogc-simple-house"):
        yield folder, sorted(glob.glob(f"{data}/{folder}/*.stripped.city.json")), None
    yield "faults", sorted(glob.glob(f"{data}/faults/*.city.json*")), None


class Judge:
    def __init__(self, oriel, val3dity, work):
        self.oriel, self.val3dity, self.work = oriel, val3dity, work

    def written(self, name, texts):
        path = f"{self.work}/{name}"
        with open(path, "w") as file:
            file.writelines(json.dumps(text) + "\n" for text in texts)
        return path

    def refused(self, buildings):
        """By building the errors of val3dity (numbers) and of `oriel validate` (codes)."""
        found = collections.defaultdict(set)
        for group in by_transform(buildings):
            path, report = self.written("judged.city.json", [city_json(group)]), f"{self.work}/report.json"
            subprocess.run([self.val3dity, path, "--report", report], capture_output=True, check=False)
            with open(report) as file:
                features = json.load(file)["features"]
            os.remove(report)
            for feature in features:
                errors = feature["errors"]
                found[feature["id"]] |= {str(e["code"]) for e in errors}
            lines = subprocess.run([self.oriel, "validate", "--json", path], capture_output=True, text=True, check=False)
            for line in map(json.loads, lines.stdout.splitlines()):
                found[line["id"]] |= {f["code"] for f in line["findings"]}
        return {name: sorted(codes) for name, codes in found.items() if codes}

    def outputs(self, command, inputs):
        """By building what was written."""
        found = {}
        level = command[2] if "--to-lod" in command else None  # the others stay in the file
        with tempfile.TemporaryDirectory(dir=self.work) as folder:
            done = subprocess.run([self.oriel, *command, *inputs, "-o", folder + "/", "--progress", "none"],
                                  capture_output=True, text=True, check=False)
            if done.returncode not in (0, 3):
                sys.exit(f"{command}: exit code {done.returncode}: {done.stderr[-400:]}")
            for path in inputs:
                found |= geometries(f"{folder}/{os.path.basename(path)}", level)
        return found

    def alone(self, buildings):
        return [self.written(f"{i}.city.json", [city_json({name: one})]) for i, (name, one) in enumerate(buildings.items())]


def judge_set(judge, name, command, before):
    """One command on one set; the number of faults."""
    in_files, streams = [], []
    for i, group in enumerate(by_transform(before)):
        in_files.append(judge.written(f"file-{i}.city.json", [city_json(group)]))
        streams.append(judge.written(f"stream-{i}.city.jsonl", city_json_seq(group)))
    after = judge.outputs(command, in_files)
    # The input has no attributes; what is repaired has, also where no number changes.
    written = {n: one for n, one in after.items() if one.numbers() != before[n].numbers() or
               (command[0] == "repair" and one.object.get("attributes"))}
    faults = [f"{n}: {' '.join(codes)}" for n, codes in judge.refused(written).items()]
    ways = {"in a stream": judge.outputs(command, streams), "alone": judge.outputs(command, judge.alone(before))}
    for way, other in ways.items():
        faults += [f"{n}: another one {way}" for n in sorted(after.keys() | other.keys())
                   if n not in after or n not in other or other[n].numbers() != after[n].numbers()]
    print(f"{name}: {len(before)} buildings, {len(written)} written, {len(faults)} faults", flush=True)
    for fault in faults:
        print("  " + fault, flush=True)
    return len(faults)


def main():
    oriel, val3dity, data, *words = sys.argv[1:]
    faults = 0
    with tempfile.TemporaryDirectory() as work:
        judge = Judge(os.path.abspath(oriel), val3dity, work)
        for set_name, files, lod in data_sets(data):
            for command_name, command in COMMANDS.items():
                name = f"{set_name}/{command_name}"
                if words and not any(word in name for word in words):
                    continue
                before = {}
                for path in files:
                    before |= geometries(path, lod)
                faults += judge_set(judge, name, command, before)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""tests/fuzz/campaign.py ORIEL [--geometry N] [--text N] [--seed S] [--keep FOLDER]: a campaign over the samples and the shared data.

Geometry: buildings of the files with corners moved and made one, polygons left out, doubled and turned, and lists emptied (rings, polygons,
shells, solids). A hundred of them are one stream, which every command works through in one process; a run is one building in one command.
Text: files of every format with bytes changed, cut out and repeated, each read by one command.

Prints what was run and what was found: a signal, E901, a process that takes more than 10 s of CPU for one building or file, an id that is
in no output though no message names it, an output that is no JSON, a temporary file that is left. Exit code 1 if anything was. The same seed
makes the same inputs."""
import argparse
import json
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("ORIEL_SHARED", ROOT / ".." / "shared"))
BATCH = 100
LONGEST_S = 10
MOST_BYTES = 3 << 29
MOST_VERTICES = 150  # of a building: what is larger is for bounds, not for numbers
COMMANDS = [
    ["label", "-o", "o.city.jsonl"],
    ["segment", "--json", "--faces", "-o", "o.jsonl"],
    ["generalise", "--scale", "1:2500", "-o", "o.city.jsonl"],
    ["generalise", "--to-lod", "2.0,1.2", "-o", "o.city.jsonl"],
    ["repair", "-o", "o.city.jsonl"],
    ["validate", "--json"],
]
READERS = [["label", "-o", "out"], ["segment", "--json"], ["validate", "--json"], ["generalise", "--scale", "1:1000", "-o", "out"]]


def limited():
    resource.setrlimit(resource.RLIMIT_CPU, (limited.seconds, limited.seconds))
    resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(words, folder, seconds):
    """(code, stdout, stderr); a code below 0 is a signal."""
    limited.seconds = seconds
    done = subprocess.run(words, cwd=folder, capture_output=True, preexec_fn=limited, stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout, done.stderr.decode(errors="replace")


def inputs():
    return sorted(p for folder in (ROOT / "examples" / "samples", SHARED / "data", SHARED / "data" / "cases")
                  if folder.is_dir() for p in folder.glob("**/*") if p.is_file() and p.stat().st_size < 300_000)


def buildings():
    """(geometry type, boundaries, vertices, transform) of the buildings in the files, each with its own vertices."""
    found = []
    for path in inputs():
        if not path.name.endswith((".city.json", ".city.jsonl")):
            continue
        try:
            lines = [json.loads(line) for line in path.read_text().splitlines()] if path.suffix == ".jsonl" else [json.loads(path.read_text())]
        except ValueError:
            continue
        transform = lines[0].get("transform")
        for city in lines:
            for thing in city.get("CityObjects", {}).values():
                for geometry in thing.get("geometry", [])[-1:]:
                    if geometry.get("type") not in ("Solid", "MultiSurface", "MultiSolid", "CompositeSolid", "CompositeSurface"):
                        continue
                    numbers = {}
                    boundaries = renumbered(geometry["boundaries"], numbers, len(city["vertices"]))
                    if 3 < len(numbers) <= MOST_VERTICES and transform:
                        found.append((geometry["type"], boundaries, [city["vertices"][v] for v in numbers], transform))
    return found


def renumbered(item, numbers, count):
    if isinstance(item, list):
        return [renumbered(part, numbers, count) for part in item]
    return numbers.setdefault(item % count if count else 0, len(numbers))


def lists_in(boundaries, depth):
    """The lists that stand so deep, with what holds each: rings are the innermost ones."""
    level = [boundaries]
    for _ in range(depth):
        level = [part for item in level for part in item if isinstance(part, list)]
    return level


def depth_of(kind):
    return {"MultiSurface": 2, "CompositeSurface": 2, "Solid": 3}.get(kind, 4)


def changed(rng, building):
    kind, boundaries, vertices, transform = building
    boundaries, vertices = json.loads(json.dumps(boundaries)), [list(v) for v in vertices]
    scale = transform["scale"][0] or 1
    deep = depth_of(kind)
    for _ in range(rng.randint(1, 6)):
        way = rng.randrange(9)
        rings = [ring for ring in lists_in(boundaries, deep) if ring]
        shells = [shell for shell in lists_in(boundaries, deep - 2) if shell]
        if way <= 1:  # a corner moves, a little or far
            step = max(1, round(rng.choice([0.0005, 0.001, 0.002, 0.01, 0.1, 1, 4]) / scale))
            vertex = rng.choice(vertices)
            vertex[rng.randrange(3)] += rng.choice([-step, step])
        elif way == 2:  # two corners are one
            vertices[rng.randrange(len(vertices))] = list(rng.choice(vertices))
        elif way == 3 and rings:  # a ring names another corner
            ring = rng.choice(rings)
            ring[rng.randrange(len(ring))] = rng.randrange(len(vertices))
        elif way == 4 and shells:
            shell = rng.choice(shells)
            shell.pop(rng.randrange(len(shell)))
        elif way == 5 and shells:
            shell = rng.choice(shells)
            shell.append([list(ring) for ring in rng.choice(shell)])
        elif way == 6 and rings:
            rng.choice(rings).reverse()
        elif way == 7 and shells and rings:  # a ring is a hole of another polygon
            rng.choice(rng.choice(shells)).append(list(rng.choice(rings)))
        else:  # a list is emptied
            some = lists_in(boundaries, rng.randint(0 if rng.random() < 0.1 else 1, deep))
            if some:
                rng.choice(some).clear()
    return kind, boundaries, vertices, transform


def stream(some, names):
    """A CityJSONSeq of the buildings; each line has its vertices on the grid of the first one's transform scale."""
    header = {"type": "CityJSON", "version": "2.0", "transform": {"scale": [0.001] * 3, "translate": [0, 0, 0]}, "CityObjects": {}, "vertices": []}
    lines = [json.dumps(header)]
    for name, (kind, boundaries, vertices, transform) in zip(names, some):
        first = vertices[0] if vertices else [0, 0, 0]
        own = [[round((v[i] - first[i]) * transform["scale"][i] * 1000) for i in range(3)] for v in vertices]
        thing = {"type": "Building", "geometry": [{"type": kind, "lod": "2", "boundaries": boundaries}]}
        lines.append(json.dumps({"type": "CityJSONFeature", "id": name, "CityObjects": {name: thing}, "vertices": own}))
    return "\n".join(lines) + "\n"


def faults_of(words, names, code, out, err, folder):
    """What must not be after a command worked on a stream of those ids."""
    faults = []
    if code < 0 or code > 5:
        faults.append(f"ended with {code}")
    if "E901" in err or b"E901" in out:
        faults.append("E901")
    if "PolyMesh" in err:
        faults.append("OpenMesh speaks")
    written = b"".join(p.read_bytes() for p in folder.iterdir() if p.name in ("o.city.jsonl", "o.jsonl")) + out
    if code in (0, 3):
        said = written.decode(errors="replace") + err
        lost = [name for name in names if not re.search(rf"\b{name}\b", said)]
        if lost:
            faults.append(f"lost {lost[:3]}")
        for line in written.splitlines():
            if line[:1] in (b"{", b"["):
                try:
                    json.loads(line)
                except ValueError:
                    faults.append("no JSON")
                    break
    if any(".tmp" in p.name for p in folder.iterdir()):
        faults.append("a temporary file is left")
    return faults


class Campaign:
    def __init__(self, oriel, keep):
        self.oriel, self.keep, self.runs, self.found = str(oriel), keep, {}, []

    def report(self, what, words, path):
        self.keep.mkdir(parents=True, exist_ok=True)
        kept = self.keep / f"{len(self.found)}-{words[0]}{''.join(path.suffixes)}"
        shutil.copy(path, kept)
        self.found.append(f"{' '.join(words)}: {what}: {kept}")
        print(self.found[-1], flush=True)

    def stream_of(self, some, names, words):
        """Runs a command over buildings; where that goes wrong, over each of them by itself."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            path = folder / "in.city.jsonl"
            path.write_text(stream(some, names))
            seconds = LONGEST_S if len(some) == 1 else LONGEST_S * 6
            faults = faults_of(words, names, *run([self.oriel, *words, "-v", str(path)] if words[0] != "validate" else [self.oriel, *words, str(path)],
                                                  folder, seconds), folder)
            if not faults:
                return False
            if len(some) == 1:
                self.report(", ".join(faults), words, path)
                return True
        if sum(self.stream_of([one], [name], words) for one, name in zip(some, names)) == 0:
            print(f"only together: {' '.join(words)}: {', '.join(faults)}: {names[0]} …", flush=True)
        return True

    def geometry(self, count, seed):
        sources = buildings()
        print(f"{len(sources)} buildings to start from", flush=True)
        for batch in range(-(-count // (BATCH * len(COMMANDS)))):
            rng = random.Random(f"{seed}-geometry-{batch}")
            some = [changed(rng, rng.choice(sources)) for _ in range(BATCH)]
            names = [f"b{batch}x{i}" for i in range(BATCH)]
            for words in COMMANDS:
                self.stream_of(some, names, words)
                self.runs[words[0]] = self.runs.get(words[0], 0) + BATCH
            if batch % 10 == 9:
                print(f"{(batch + 1) * BATCH * len(COMMANDS)} runs", flush=True)

    def text(self, count, seed):
        sources = [p for p in inputs() if p.name.endswith((".json", ".jsonl", ".gml", ".obj", ".off", ".ply", ".stl")) and p.stat().st_size < 60_000]
        rng = random.Random(f"{seed}-text")
        for _ in range(count):
            source = rng.choice(sources)
            data = bytearray(source.read_bytes())
            for _ in range(rng.randint(1, 3)):
                at, size = rng.randrange(len(data) + 1), rng.choice([1, 1, 2, 8, 64, 512])
                way = rng.randrange(5)
                if way == 0:
                    data[at:at + size] = b""
                elif way == 1:
                    data[at:at] = data[at:at + size]
                elif way == 2:
                    data[at:at + 1] = bytes([rng.randrange(256)])
                elif way == 3:
                    data[at:at + 1] = rng.choice([b"-1", b"1e999", b"[]", b"{}", b"null", b"\"\"", b"<", b">", b"9" * 20, b"\n", b"\0"])
                else:
                    del data[at:]
            words = rng.choice(READERS)
            suffix = next(end for end in (".city.jsonl", ".city.json", source.suffix) if source.name.endswith(end))
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                path = folder / ("in" + suffix)
                path.write_bytes(data)
                own = [word if word != "out" else "o" + (suffix if suffix.startswith(".city") else ".city.json") for word in words]
                code, out, err = run([self.oriel, *own, str(path)], folder, LONGEST_S)
                faults = faults_of(own, [], code, out, err, folder)
                self.runs["text"] = self.runs.get("text", 0) + 1
                if faults:
                    self.report(", ".join(faults), own, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("oriel", type=Path)
    parser.add_argument("--geometry", type=int, default=50_000)
    parser.add_argument("--text", type=int, default=5_000)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--keep", type=Path, default=ROOT / "build" / "campaign")
    arguments = parser.parse_args()
    campaign = Campaign(arguments.oriel.resolve(), arguments.keep)
    campaign.text(arguments.text, arguments.seed)
    campaign.geometry(arguments.geometry, arguments.seed)
    print(f"runs: {campaign.runs}; found: {len(campaign.found)}")
    return 1 if campaign.found else 0


if __name__ == "__main__":
    sys.exit(main())

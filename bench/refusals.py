#!/usr/bin/env python3
"""What the operators of a pack are refused, and why, over the samples and ../shared (or $ORIEL_SHARED).

    python3 bench/refusals.py PROGRAM [PACK]     PACK: cartographic if not given

Prints two tables in Markdown: operator by scale (features asked for, changed or gone, refused, their share), and
operator by cause. "Asked for" counts the features that a step of the plan names, without those that need nothing
(outcome "kept"): large enough, alone in their row, and without those that were pushed by others. Results that are not valid when they are read back are counted
at the end; `omit` is counted as any other operator.
"""
import collections
import glob
import json
import os
import re
import subprocess
import sys
import tempfile

SCALES = (1000, 2500, 5000)


def files_of(root):
    shared = os.environ.get("ORIEL_SHARED", os.path.join(root, "..", "shared"))
    for name in ("houses/clean", "houses/noisy", "houses/triangles", "random3dcity"):
        yield name, sorted(glob.glob(os.path.join(shared, "data", name, "*.stripped.city.json")))
    yield "samples", sorted(glob.glob(os.path.join(root, "examples", "samples", "*.stripped.city.json")))


def outcomes(program, pack, scale, files, folder):
    why = os.path.join(folder, "why.jsonl")
    out = os.path.join(folder, "out")
    subprocess.run([program, "generalise", *files, "--scale", f"1:{scale}", "--rules", pack, "-o", out + "/",
                    "--explain", why], stderr=subprocess.DEVNULL, check=False)
    with open(why, encoding="utf-8") as lines:
        return [json.loads(line) for line in lines], sorted(glob.glob(out + "/*"))


def invalid_of(program, files):
    run = subprocess.run([program, "validate", *files, "--json"], capture_output=True, text=True, check=False)
    return run.returncode


def main():
    program = os.path.abspath(sys.argv[1])
    pack = sys.argv[2] if len(sys.argv) > 2 else "cartographic"
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    asked, causes, invalid = collections.defaultdict(collections.Counter), collections.Counter(), []
    for name, files in files_of(root):
        if not files:
            sys.exit(f"no buildings of {name}: set ORIEL_SHARED")
        for scale in SCALES:
            with tempfile.TemporaryDirectory() as folder:
                found, written = outcomes(program, pack, scale, files, folder)
                if invalid_of(program, written) != 0:
                    invalid.append(f"{name} at 1:{scale}")
            for one in found:
                if not one["operation"] or one["outcome"] == "kept" or one["reason"].startswith("pushed by "):
                    continue
                asked[one["operation"], scale][one["outcome"]] += 1
                if one["outcome"] == "refused":
                    cause = re.split(r", beside |; it would ", one["reason"])[0]
                    causes[one["operation"], re.sub(r"\d+(\.\d+)?", "…", cause)] += 1
    print("| operator | scale | asked for | refused | share |\n|---|---|---|---|---|")
    for (operation, scale), counts in sorted(asked.items()):
        total, refused = sum(counts.values()), counts["refused"]
        print(f"| `{operation}` | 1:{scale} | {total} | {refused} | {100 * refused / total:.0f} % |")
    print("\n| operator | cause | refused |\n|---|---|---|")
    for (operation, cause), count in sorted(causes.items(), key=lambda item: (item[0][0], -item[1], item[0][1])):
        print(f"| `{operation}` | {cause} | {count} |")
    print("\nNot all valid when read back: " + (", ".join(invalid) or "none"))


if __name__ == "__main__":
    main()

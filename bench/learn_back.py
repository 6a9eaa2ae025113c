#!/usr/bin/env python3
"""Does `oriel learn` find its way back? Packs whose params were moved at random are learnt again, and compared with the shipped one.

    learn_back.py ORIEL DATA OUT [SEED...]

DATA has the folders ingolstadt, random3dcity and houses/clean; OUT gets the features, the packs and what learn says of them (one
JSON file each; those that are there are not made again). Each pack extends `residential`; every param that has a range is moved
to a value drawn evenly from it, with which the pack is still a pack. Prints a line of a table for each set and seed: the objective
(macro-F1 of the held-out folds together) of the shipped pack, of the moved one, and of what was learnt from it without the fold;
then what learn says of the shipped pack, and its knife edges. ORIEL_LEARN_JOBS are the threads.
"""
import json
import os
import pathlib
import random
import re
import subprocess
import sys

SETS = {"houses": ("houses/clean", []), "random3dcity": ("random3dcity", []), "ingolstadt": ("ingolstadt", ["--leave-one-out"])}
DIGITS = 4  # of a moved value


def run(words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)


def ranges_of(oriel):
    """(name, low, high, unit) of the params of the shipped pack, as its page states them."""
    rows = re.findall(r"^\| `(\w+)` \|[^|]*\|([^|]*)\| ([\d.]+)[^|]* \.\. ([\d.]+)[^|]*\|", run([oriel, "rules", "doc", "residential"]).stdout, re.M)
    return [(name, float(low), float(high), unit.strip().replace("none", "")) for name, unit, low, high in rows]


def moved_pack(oriel, seed, path):
    """Writes a pack that loads; each param is tried until it does."""
    draws = random.Random(seed)
    lines = [f"# Every param moved at random, seed {seed}.", "schema: oriel/1",
             f"pack: {{name: moved_{seed}, version: 1.0.0}}", "extends: residential", "params:"]
    for name, low, high, unit in ranges_of(oriel):
        while True:
            value = round(low + (high - low) * draws.random(), DIGITS)
            line = f"  {name}: {{value: {value} {unit}".rstrip() + "}"
            path.write_text("\n".join([*lines, line]) + "\n", encoding="utf-8")
            if run([oriel, "rules", "check", path]).returncode == 0:
                break
        lines.append(line)


def learnt(oriel, data, out, name, rules, called):
    """What learn says of a pack on a set."""
    folder, split = SETS[name]
    said, records = out / f"{name}-{called}.json", out / f"{name}.jsonl"
    if not records.exists():
        run([oriel, "segment", *sorted((data / folder).glob("*.stripped.city.json")), "--features", records, "-j", 2])
    if not said.exists():
        words = [oriel, "learn", records, "--truth", data / folder, "--rules", rules, "--json", "-o", out / f"{name}-{called}.yaml", *split]
        done = run([*words, "-j", os.environ.get("ORIEL_LEARN_JOBS", "2")])
        if done.returncode not in (0, 3):
            sys.exit(done.stderr)
        said.write_text(done.stdout, encoding="utf-8")
    return json.loads(said.read_text(encoding="utf-8"))


def main():
    oriel, data, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    out.mkdir(parents=True, exist_ok=True)
    print("| set | seed | shipped | moved | learnt | learnt - shipped | params |\n|---|---|---|---|---|---|---|")
    for name in SETS:
        shipped = learnt(oriel, data, out, name, "residential", "shipped")
        before = shipped["held_out_before"]
        print(f"| {name} | shipped | {before:.4f} | | {shipped['held_out_after']:.4f} | {shipped['held_out_after'] - before:+.4f} | {len(shipped['params'])} |", flush=True)
        for seed in sys.argv[4:] or ["1", "2", "3"]:
            pack = out / f"moved-{seed}.yaml"
            if not pack.exists():
                moved_pack(oriel, int(seed), pack)
            back = learnt(oriel, data, out, name, pack, f"moved-{seed}")
            print(f"| {name} | {seed} | {before:.4f} | {back['held_out_before']:.4f} | {back['held_out_after']:.4f} | "
                  f"{back['held_out_after'] - before:+.4f} | {len(back['params'])} |", flush=True)
        for edge in shipped["knife_edges"]:
            print(f"    knife edge on {name}: {edge['param']} = {edge['value']} {edge['unit']}: {edge['change']:+.4f} at {edge['flip']:.4f}"
                  f" ({edge['objects']} objects)")


if __name__ == "__main__":
    main()

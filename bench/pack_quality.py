#!/usr/bin/env python3
"""How well packs and profiles generalise: the figures of `generalise --metrics`, compared.

    python3 bench/pack_quality.py PROGRAM [--houses N] [--scales 1000,2500,5000] [PACK[+PROFILE] ...]

Without packs: residential, cartographic, residential+map and cartographic+map. The buildings are the first N
(40) of houses/clean, random3dcity and the samples in ../shared (or $ORIEL_SHARED). Prints a table in Markdown for
each scale; docs/generalisation.md#quality defines the figures. Counts are sums over all buildings, shares are of
these sums, symmetry is the mean over buildings that have openings before and after.
"""
import argparse
import glob
import json
import os
import subprocess
import tempfile
import time

PACKS = ("residential", "cartographic", "residential+map", "cartographic+map")
COLUMNS = ("short edges", "narrow gaps", "openings too near", "narrow features", "openings kept", "area kept",
           "rows aligned", "rows even", "symmetry", "labels found again", "facets", "Hausdorff m")


def files_of(root, houses):
    shared = os.environ.get("ORIEL_SHARED", os.path.join(root, "..", "shared"))
    for pattern, count in (("houses/clean", houses), ("random3dcity", None)):
        files = sorted(glob.glob(os.path.join(shared, "data", pattern, "*.stripped.city.json")))
        yield from files[:count]
    yield from sorted(glob.glob(os.path.join(root, "examples", "samples", "*.stripped.city.json")))


def figures_of(program, choice, scale, files):
    pack, _, profile = choice.partition("+")
    with tempfile.TemporaryDirectory() as folder:
        metrics = os.path.join(folder, "metrics.jsonl")
        call = [program, "generalise", *files, "--scale", f"1:{scale}", "--rules", pack, "-o", folder + "/out/",
                "--metrics", metrics] + (["--profile", profile] if profile else [])
        subprocess.run(call, stderr=subprocess.DEVNULL, check=False)
        with open(metrics, encoding="utf-8") as lines:
            return [json.loads(line) for line in lines]


def share(part, whole):
    return f"{100 * part / whole:.0f} %" if whole else "-"


def row_of(figures):
    total = lambda name: sum(one[name] for one in figures)
    labels = [label for one in figures for label in one["labels"].values()]
    both = [one for one in figures if one["openings_before"] and one["openings_after"]]
    kept = f"{sum(one['symmetry_before'] for one in both) / len(both):.2f} → " \
           f"{sum(one['symmetry_after'] for one in both) / len(both):.2f}" if both else "-"
    change = lambda name: f"{total(name + '_before')} → {total(name + '_after')}"
    of_rows = lambda part, whole: f"{share(total(part + '_before'), total(whole + '_before'))} → " \
                                  f"{share(total(part + '_after'), total(whole + '_after'))}"
    return (change("short_edges"), change("gaps_below"), change("opening_gaps_below"), change("widths_below"),
            share(total("openings_after"), total("openings_before")),
            share(total("openings_m2_after"), total("openings_m2_before")),
            of_rows("aligned_rows", "rows"), of_rows("even_rows", "long_rows"), kept,
            share(sum(label["found"] for label in labels), sum(label["drawn"] for label in labels)),
            change("facets"), f"{sum(one['hausdorff_m'] for one in figures) / len(figures):.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("packs", nargs="*", default=PACKS)
    parser.add_argument("--houses", type=int, default=40)
    parser.add_argument("--scales", default="1000,2500,5000")
    arguments = parser.parse_args()
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    files = list(files_of(root, arguments.houses))
    print(f"{len(files)} files")
    for scale in arguments.scales.split(","):
        print(f"\n1:{scale}\n\n| pack | buildings | {' | '.join(COLUMNS)} | s |\n|{'---|' * (len(COLUMNS) + 3)}")
        for pack in arguments.packs:
            start = time.monotonic()
            figures = figures_of(os.path.abspath(arguments.program), pack, scale, files)
            took = time.monotonic() - start
            if figures:
                print(f"| `{pack}` | {len(figures)} | {' | '.join(row_of(figures))} | {took:.1f} |", flush=True)


if __name__ == "__main__":
    main()

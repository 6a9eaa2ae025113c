#!/usr/bin/env python3
"""Draws how the F1 of a class depends on one threshold of a rule pack.

    oriel-generate --count 40 --seed 1 -o houses.city.jsonl --truth houses.truth.jsonl
    python3 f1_over_threshold.py houses.city.jsonl --truth houses.truth.jsonl --param widest_leaf --label door -o f1.svg

The buildings are cut once; then only rules run, for each value within the range that the pack states. The table is
printed in any case, the picture is drawn with -o by matplotlib (Debian: python3-matplotlib).
"""
import argparse
import sys

import numpy as np

import oriel


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", help="buildings, in any format that oriel reads")
    parser.add_argument("--truth", required=True, nargs="+", help="*.truth.json, *.truth.jsonl, or folders of them")
    parser.add_argument("--rules", default="residential", help="a rule pack: a file, or the name of a built-in pack")
    parser.add_argument("--param", default="widest_leaf", help="the threshold: a param of the pack with a range")
    parser.add_argument("--label", default="door", help="the class whose F1 is drawn beside the mean of all")
    parser.add_argument("--steps", type=int, default=13, help="how many values, from end to end of the range")
    parser.add_argument("-o", "--output", help="the picture: .svg, .png or .pdf")
    return parser.parse_args()


def curve(features, truth, pack, param, label, steps):
    """For each value of the param: the value, the F1 of the label, the mean F1 of all classes.

    Values that do not go with the pack's other numbers are passed over.
    """
    rows = []
    for value in np.linspace(*param.range, steps):
        try:
            changed = pack.with_params(**{param.name: value})
        except oriel.Error as error:
            print(f"passed over: {error}", file=sys.stderr)
            continue
        score = oriel.score(oriel.interpret(features, changed), truth)
        rows.append((value, score.classes[label].f1, score.macro_f1))
    return np.array(rows)


def draw(rows, pack, param, label, path):
    import matplotlib

    matplotlib.use("svg" if path.endswith(".svg") else "agg")
    matplotlib.rcParams["svg.hashsalt"] = "oriel"  # the same picture has the same bytes
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    axes.plot(rows[:, 0], rows[:, 1], marker="o", label=label)
    axes.plot(rows[:, 0], rows[:, 2], marker="s", label="mean of all classes")
    axes.axvline(param.value, linestyle=":", color="grey", label=f"value in {pack.name}")
    axes.set_xlabel(f"{param.name} in {param.unit}" if param.unit else param.name)
    axes.set_ylabel("F1")
    axes.legend()
    figure.savefig(path, metadata={"Date": None} if path.endswith(".svg") else None)


def main():
    args = arguments()
    pack = oriel.Pack(args.rules)
    param = pack.params[args.param]
    if param.range is None:
        sys.exit(f"{param.name} has no range in {pack.file}")
    features = oriel.features(oriel.segment(args.model, jobs=0))
    rows = curve(features, oriel.read_truth(args.truth), pack, param, args.label, args.steps)
    print(f"{args.param:>12}  {'F1 ' + args.label:>10}  {'mean F1':>8}")
    for value, f1, macro_f1 in rows:
        print(f"{value:12.3f}  {f1:10.4f}  {macro_f1:8.4f}")
    if not len(rows):
        sys.exit(f"no value of {param.name} goes with the other numbers of {pack.file}")
    best = rows[np.argmax(rows[:, 1])]
    print(f"best: {best[0]:.3f} {param.unit}, the pack has {param.value:g} {param.unit}: {param.why}")
    if args.output:
        try:
            draw(rows, pack, param, args.label, args.output)
        except ImportError:
            sys.exit("the picture needs matplotlib: apt install python3-matplotlib")


if __name__ == "__main__":
    try:
        main()
    except oriel.Error as error:
        sys.exit(f"error: {error}")
    except KeyError as error:
        sys.exit(f"error: there is no param or class {error}")

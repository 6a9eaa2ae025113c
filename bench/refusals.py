#!/usr/bin/env python3
"""How often each operator is refused, and why.

    bench/refusals.py ORIEL [--rules PACK] [--scales 1000,2500,5000] INPUT...

For each scale and operator a line of Markdown: features that it was asked for, those it changed,
those that were as it wants them already, those refused with the share of all, and the causes.
What is omitted along with something else was not asked for.
"""

import argparse
import collections
import json
import pathlib
import re
import subprocess
import tempfile

# The operators that draw; omit is refused for reasons of its own.
OPERATORS = ("aggregate", "collapse", "displace", "enlarge", "flatten", "symbolise", "typify")


def outcomes(oriel, inputs, pack, scale, folder):
    """The records of --explain at one scale."""
    why = folder / f"why-{scale}.jsonl"
    call = [oriel, "generalise", *inputs, "--scale", f"1:{scale}", "--rules", pack, "--explain", why,
            "-o", f"{folder}/{scale}/", "--progress", "none",
            "--allow-bad", "100%"]
    subprocess.run([str(word) for word in call], check=True, stderr=subprocess.DEVNULL)
    return [json.loads(line) for line in why.read_text().splitlines()]


def cause_of(record):
    """The reason without its numbers."""
    return re.sub(r"[0-9][0-9.,]*", "…", record.get("reason", ""))


def print_operator(scale, operator, records):
    asked = [r for r in records if r["outcome"] in ("changed", "kept", "refused")]
    if not asked:
        return
    count = collections.Counter(r["outcome"] for r in asked)
    causes = collections.Counter(cause_of(r) for r in asked if r["outcome"] == "refused")
    why = "; ".join(f"{cause} ({n})" for cause, n in causes.most_common(3))
    print(f"| 1:{scale} | {operator} | {len(asked)} | {count['changed']} | {count['kept']} | "
          f"{count['refused']} ({100 * count['refused'] / len(asked):.0f} %) | {why} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("oriel")
    parser.add_argument("--rules", default="cartographic")
    parser.add_argument("--scales", default="1000,2500,5000")
    parser.add_argument("inputs", nargs="+")
    options = parser.parse_args()
    print("| scale | operator | asked for | changed | is so already | refused | why |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        for scale in options.scales.split(","):
            records = outcomes(options.oriel, options.inputs, options.rules, scale,
                               pathlib.Path(name))
            for operator in OPERATORS:
                print_operator(scale, operator,
                               [r for r in records if r.get("operation") == operator])


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""How many true objects have a feature with their box: recall.py RECORDS.jsonl CLASSES TRUTH...

RECORDS.jsonl is what `oriel segment --features` wrote, TRUTH files end with .truth.json or .jsonl. An object is found if
some feature of its building, at any level of the tree, has a box with an IoU of 0.8 or more. Objects that fell out of the
shell and openings that are flush are not asked for. Standard library only.
"""
import collections
import json
import sys

LIMIT = 0.8


def volume(box):
    return max(0, box[3] - box[0]) * max(0, box[4] - box[1]) * max(0, box[5] - box[2])


def iou(p, q):
    both = volume([max(a, b) for a, b in zip(p[:3], q[:3])] + [min(a, b) for a, b in zip(p[3:], q[3:])])
    return both / (volume(p) + volume(q) - both)


def lines_of(path):
    with open(path) as file:
        return [json.loads(line) for line in file] if path.endswith(".jsonl") else [json.load(file)]


def main(records, classes, truths):
    boxes = collections.defaultdict(list)
    for record in lines_of(records):
        boxes[record["building"]].append(record["aabb_m"])
    objects, found = collections.Counter(), collections.Counter()
    for truth in (line for path in truths for line in lines_of(path)):
        for item in truth["objects"]:
            name = item["class"]
            if name not in classes or not item.get("faces") or item.get("detectable") is False:
                continue
            box = item.get("feature_aabb") or item["aabb"]
            objects[name] += 1
            found[name] += any(iou(box, other) >= LIMIT for other in boxes[truth["building"]])
    for name in classes:
        share = 100 * found[name] / objects[name] if objects[name] else float("nan")
        print(f"  {name:<10} {found[name]:>5} of {objects[name]:>5}  {share:6.2f} %")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2].split(","), sys.argv[3:])

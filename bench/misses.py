"""Why openings are missed: for every missed window and door, and for every false one, its box and what is there instead.

misses.py RECORDS.jsonl TRUTH_FOLDER, records of `oriel label --features`. Matching as in docs/results.md. Reasons:
no feature (nothing overlaps by IoU 0.2), other box (by 0.5), unlabelled, wrong label, taken (by a better match)."""
import collections
import glob
import json
import sys

CLASSES = ("window", "door")


def grown(box, by=0.05):
    return [c - by for c in box[:3]] + [c + by for c in box[3:]]


def volume(box):
    size = [box[k + 3] - box[k] for k in range(3)]
    return size[0] * size[1] * size[2] if min(size) > 0 else 0


def iou(p, q):
    p, q = grown(p), grown(q)
    shared = volume([max(p[k], q[k]) for k in range(3)] + [min(p[k], q[k]) for k in range(3, 6)])
    return shared / (volume(p) + volume(q) - shared)


def box_of(truth):
    return truth.get("feature_aabb") or truth["aabb"]


def size_of(box):
    return " x ".join(f"{box[k + 3] - box[k]:.2f}" for k in range(3))


def told(record):
    numbers = "  ".join(f"{name} {record[key]:.2f}" for name, key in (("w", "width_m"), ("h", "height_m"), (
        "d", "depth_m"), ("recess", "recess_m"), ("z", "base_height_m"), ("score", "score")) if isinstance(record.get(key), float))
    return f"{record['id']} {record['label'] or 'unknown'} ({record['rule'] or '-'}) {record['sense']} {numbers} in {record['host'] or '-'}"


def matched(truth, records):
    pairs = [(iou(box_of(t), r["aabb_m"]), t["id"], r["id"]) for t in truth for r in records
             if t["faces"] and t["class"] == r["label"]]
    done = set()
    for overlap, t, r in sorted(pairs, key=lambda p: (-p[0], p[1], p[2])):
        if overlap >= 0.5 and t not in done and r not in done:
            done |= {t, r}
    return done


def reason(best, truth):
    if best is None or best[0] < 0.2:
        return "no feature"
    if best[0] < 0.5:
        return "other box"
    if not best[1]["label"]:
        return "unlabelled"
    return "wrong label" if best[1]["label"] != truth["class"] else "taken"


def main(records_file, folder):
    records = collections.defaultdict(list)
    with open(records_file, encoding="utf-8") as lines:
        for line in lines:
            record = json.loads(line)
            records[record["building"]].append(record)
    counts = collections.Counter()
    for name in sorted(glob.glob(folder + "/*.truth.json")):
        with open(name, encoding="utf-8") as file:
            truth = json.load(file)
        objects, there = truth["objects"], records[truth["building"]]
        done = matched(objects, there)
        for t in objects:
            if t["class"] not in CLASSES or not t["faces"] or t["id"] in done:
                continue
            near = sorted(((iou(box_of(t), r["aabb_m"]), r) for r in there), key=lambda p: -p[0])[:2]
            why = reason(near[0] if near else None, t)
            counts[t["class"], why] += 1
            print(f"missed {truth['building']} {t['class']} {t['id']}: {why}; {size_of(box_of(t))}, recess {t.get('recess_m')}")
            for overlap, r in near:
                print(f"    {overlap:.2f} {told(r)}")
        left_out = [t for t in objects if not t["faces"] or t.get("subclass") == "installation"]
        for r in there:
            if r["label"] in CLASSES and r["id"] not in done and all(iou(box_of(t), r["aabb_m"]) < 0.5 for t in left_out):
                counts["false", r["label"]] += 1
                near = max(objects, key=lambda t: iou(box_of(t), r["aabb_m"]))
                print(f"false {truth['building']} {told(r)}; nearest: {near['class']} {near['id']}")
    for (kind, why), count in sorted(counts.items()):
        print(f"{count:4} {kind} {why}")


main(*sys.argv[1:])

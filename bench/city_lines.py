"""Reads CityJSONSeq for the scripts of bench/."""
import json


def records(path):
    """Each line as an object, with its vertices in metres."""
    transform = None
    for line in open(path):
        record = json.loads(line)
        transform = record.get("transform", transform)
        scale, shift = transform["scale"], transform["translate"]
        yield record, [[v[i] * scale[i] + shift[i] for i in range(3)] for v in record["vertices"]]

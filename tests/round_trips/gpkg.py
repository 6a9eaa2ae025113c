"""A GeoPackage beside the CityJSON that it was made with, read by SQLite."""
import collections
import json
import sqlite3
import struct

import city_text

HEADER = 8  # bytes of a geometry before its envelope
ENVELOPES = (0, 32, 48, 48, 64)


def polygons_of(blob):
    """The polygons of a MultiPolygon Z, their rings without the last point."""
    if blob is None:
        return []
    at = HEADER + ENVELOPES[blob[3] >> 1 & 7]
    _, kind, count = struct.unpack_from("<BII", blob, at)
    assert kind == 1006, kind
    at += 9
    polygons = []
    for _ in range(count):
        _, kind, rings = struct.unpack_from("<BII", blob, at)
        assert kind == 1003, kind
        at += 9
        polygon = []
        for _ in range(rings):
            (points,) = struct.unpack_from("<I", blob, at)
            numbers = struct.unpack_from(f"<{3 * points}d", blob, at + 4)
            at += 4 + 24 * points
            ring = [tuple(round(x, 6) for x in numbers[3 * i:3 * i + 3]) for i in range(points)]
            assert ring[0] == ring[-1]
            polygon.append(city_text.without_repeats(ring))
        polygons.append(tuple(polygon))
    return polygons


def rows_of(path):
    package = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    package.row_factory = sqlite3.Row
    assert package.execute("PRAGMA integrity_check").fetchone()[0] == "ok"
    return {table: [dict(row) for row in package.execute(f"SELECT * FROM {table}")] for table in ("buildings", "surfaces", "features")}


def expected_surfaces(objects):
    """How often a surface of a building occurs with these polygons, type and label."""
    out = collections.Counter()
    for name, one in objects.items():
        if one["type"] == "BuildingInstallation" or not one["geometries"]:
            continue
        geometry = city_text.chosen(one["geometries"])
        of_surface = collections.defaultdict(list)
        for rings, value in geometry.polygons:
            of_surface[value].append(rings)
        for number, surface in enumerate(geometry.surfaces):
            out[(name, surface["type"], surface.get("oriel_id"), surface.get("oriel_label"), surface.get("oriel_score"),
                 tuple(sorted(of_surface[number])))] += 1
    return out


def expected_features(objects):
    """The features of each building with their labels: those that surfaces or installations are named after."""
    out = {}
    for name, one in objects.items():
        host = name
        if one["type"] == "BuildingInstallation":
            host = one["parents"][0]
            out[(host, one["attributes"].get("oriel_id", name))] = one["attributes"].get("oriel_label")
        geometry = city_text.chosen(one["geometries"])
        for surface in geometry.surfaces if geometry else ():
            if "oriel_id" in surface:
                out.setdefault((host, surface["oriel_id"]), surface.get("oriel_label"))
    return out


def compare(what, before, after):
    for key in sorted(set(before) | set(after), key=str):
        if before.get(key) != after.get(key):
            yield f"{what} {str(key)[:200]}: {before.get(key)} became {after.get(key)}"


def differences(path, objects, counts):
    """What the package has otherwise, as sentences."""
    rows = rows_of(path)
    for table, some in rows.items():
        counts[table] += len(some)
    buildings = {name: one for name, one in objects.items() if one["type"] != "BuildingInstallation"}
    yield from compare("building", {name: 1 for name in buildings}, collections.Counter(row["building"] for row in rows["buildings"]))
    for row in rows["buildings"]:
        geometry = city_text.chosen(objects[row["building"]]["geometries"])
        polygons = geometry.plain() if geometry else []
        if polygons_of(row["geom"]) != polygons:
            yield f"polygons of {row['building']}: {len(polygons)} became {len(polygons_of(row['geom']))}, or others"
        for key, value in objects[row["building"]]["attributes"].items():
            if isinstance(value, (str, int, float)) and key in row and str(row[key]) != str(value) and row[key] != value:
                yield f"{row['building']}: {key} was {json.dumps(value)}, is {row[key]!r}"
    found = collections.Counter((row["building"], row["surface"], row["id"], row["label"], row.get("score"),
                                 tuple(sorted(polygons_of(row["geom"])))) for row in rows["surfaces"])
    yield from list(compare("surface", expected_surfaces(objects), found))[:3]
    features = {(row["building"], row["id"]): row["label"] for row in rows["features"]}
    if len(features) != len(rows["features"]):
        yield f"{len(rows['features'])} rows of {len(features)} features"
    yield from list(compare("feature", expected_features(objects), features))[:3]
    labels = collections.Counter(row["label"] for row in rows["features"] if row["label"])
    for label, count in labels.items():
        total = sum(row.get(f"count_{label}") or 0 for row in rows["buildings"])
        if total != count:
            yield f"count_{label} adds up to {total}, but {count} features have the label"
